"""One cell: a scene built in an engine, stepped, and looked at."""

import hashlib
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from ..reference.checked import Array
from ..reference.errors import InputError
from ..scenarios.equations import states
from ..scenarios.features import FEATURES
from ..scenarios.scene import Scene
from ..scenarios.trajectory import Provenance, Trajectory
from . import spent
from .engine import Engine, EngineError, Reacting, Scheme, State, settings_in
from .stable_step import stable_step


class UnsupportedError(InputError):
    """An engine or a scheme lacks a feature that the scene needs; the message says which."""


def unsupported(scene: Scene, engine: type[Engine], scheme: Scheme) -> str:
    """Why this scheme cannot run this scene, or an empty text if it can."""
    lacking = sorted(scene.features - engine.features)
    if lacking:
        return f"{engine.name} has no {', no '.join(FEATURES[name] for name in lacking)}"
    reasons = dict.fromkeys(scheme.lacks[name] for name in sorted(scene.features) if name in scheme.lacks)
    return "; ".join(reasons)


def simulate(
    scene: Scene,
    engine: type[Engine],
    scheme: Scheme,
    dt: float,
    repeats: int = 1,
    asked: bool | None = None,
) -> tuple[Trajectory, Mapping[str, str]]:
    """Run one cell in this process: its trajectory with provenance, and the model text by file name.

    The cell is built and run ``repeats`` times; the hashes of all of them go into the provenance. Where it
    is ``asked``, and unless told otherwise where it is repeated, so do the engine's accelerations, and its
    largest stable step where theory has one.
    ``dt`` [s] is rounded to a whole number of steps between samples. Raises ``UnsupportedError``
    if the engine lacks a feature or no scheme can take such a step, ``EngineError`` if it breaks down,
    ``InputError`` for a step out of range.
    """
    dt = scene.whole_step(dt)
    reason = unsupported(scene, engine, scheme) or scene.unfit(dt)
    if reason:
        raise UnsupportedError(f"scene {scene.full_name} with {engine.name} {scheme.name}: {reason}")
    asked = repeats > 1 if asked is None else asked
    machine = engine()
    try:
        with spent.on("building"):
            machine.build(scene, scheme, dt)
            model = machine.model_text()
        with spent.on("setup"):
            setup = machine.readback()
        with spent.on("accelerations"):
            accelerations = _accelerations(machine, scene, scheme) if asked else ()
        first = _record(machine, scene, dt)
        digests = [digest(first)]
        with spent.on("repeat"):
            for _ in range(repeats - 1):
                machine.build(scene, scheme, dt)
                digests.append(digest(_record(machine, scene, dt)))
        with spent.on("stable step"):
            sought = asked and scene.stable_step is not None
            limit = tuple(stable_step(machine, scene, scheme)) if sought else ()
    finally:
        machine.close()
    provenance = Provenance(
        scene=scene.full_name,
        engine=engine.name,
        engine_version=engine.version(),
        scheme=scheme.name,
        order=scheme.order,
        twin=scheme.twin,
        dt=dt,
        steps=scene.samples * scene.steps_per_sample(dt),
        setup=_plain(setup.values),
        probed=tuple(setup.probed),
        digests=tuple(digests),
        accelerations=accelerations,
        stable_step=limit,
        settings=settings_in(engine, scene),
    )
    return replace(first, provenance=provenance), dict([model])


def digest(motion: Trajectory) -> str:
    """Hash of every bit of the states."""
    hasher = hashlib.sha256()
    for array in (motion.position, motion.quaternion, motion.velocity, motion.omega):
        hasher.update(np.ascontiguousarray(array).tobytes())
    hasher.update(np.ascontiguousarray(motion.joint_position).tobytes())
    hasher.update(np.ascontiguousarray(motion.joint_velocity).tobytes())
    hasher.update(np.ascontiguousarray(motion.reaction).tobytes())
    return hasher.hexdigest()


def _accelerations(machine: Engine, scene: Scene, scheme: Scheme) -> tuple[tuple[float, ...], ...]:
    """The engine's accelerations at the states of ``scenarios.equations``; none where bodies may touch."""
    if scene.contacts or "acceleration" in scheme.lacks:
        return ()
    return tuple(tuple(machine.acceleration(q, v).tolist()) for q, v in zip(*states(scene), strict=True))


def _record(machine: Engine, scene: Scene, dt: float) -> Trajectory:
    stride = scene.steps_per_sample(dt)
    columns = State(*(np.empty((scene.samples + 1, *np.shape(part))) for part in machine.state()))
    reaction = np.empty((scene.samples + 1, len(scene.reactions), 6))
    for sample in range(scene.samples + 1):
        if sample:
            with spent.on("stepping"):
                machine.step(stride)
        # Assigned, so copied: an engine may hand out views of arrays that its next step overwrites.
        for column, part in zip(columns, machine.state(), strict=True):
            column[sample] = part
        if scene.reactions:
            reaction[sample] = _reactions(machine, scene)
    t = np.asarray(np.arange(scene.samples + 1) * stride * dt)
    motion = Trajectory(t, **columns._asdict(), reaction=reaction)
    broken = motion.first_not_finite()
    if broken is not None:
        raise EngineError(f"the state is not finite at t = {broken:g} s")
    return motion


def _reactions(machine: Engine, scene: Scene) -> Array:
    if not isinstance(machine, Reacting):
        raise EngineError(f"{machine.name} names the feature 'reaction' but has no reactions() to ask for it")
    found = np.asarray(machine.reactions())
    if found.shape != (len(scene.reactions), 6):
        raise EngineError(
            f"{machine.name} reactions(): got shape {found.shape}, expected ({len(scene.reactions)}, 6)"
        )
    return found


def _plain(values: Mapping[str, Any]) -> dict[str, Any]:
    """Numbers and lists of them in place of arrays, so that the log gives back what went in."""
    return {name: np.asarray(value).tolist() for name, value in values.items()}
