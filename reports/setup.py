"""Setup: what the engine read back is what the scene asked for; and determinism: the same bits twice."""

from collections.abc import Collection, Mapping
from typing import Any

import numpy as np

from ..scenarios.parts import BUILT, PARTS, parts
from ..scenarios.scene import Scene
from .cell import Cell
from .verdict import Status, Verdict

#: Conversions of an inertia between frames cost a few roundings; a wrong setting costs far more.
TOLERANCE = 1e-12
#: A clamp on velocities that no scene comes near.
UNLIMITED = 1e6


def check(cell: Cell) -> list[Verdict]:
    """One verdict on every setting that is not as asked, or one on all of them."""
    got = cell.provenance.setup
    asked = {**expected(cell.scene, cell.provenance.dt), **counted(cell.scene, got)}
    errors = {name: _error(name, got.get(name), value) for name, value in asked.items()}
    wrong = {name: error for name, error in errors.items() if not error <= TOLERANCE}
    if wrong:
        return [
            cell.verdict("setup", name, Status.FAIL, _difference(cell, name, asked), error, TOLERANCE, "1")
            for name, error in wrong.items()
        ]
    return [
        cell.verdict(
            "setup", "all settings", Status.PASS, _praise(asked) + _inferred(cell),
            max(errors.values()), TOLERANCE, "1",
        )
    ]  # fmt: skip


def determinism(cell: Cell) -> list[Verdict]:
    """Whether the same cell, run again, gave the same bits; nothing if it was run only once."""
    digests = cell.provenance.digests
    if len(digests) < 2:
        return []
    same = len(set(digests)) == 1
    message = (
        f"{len(digests)} runs gave {'the same bits' if same else f'{len(set(digests))} different motions'}"
    )
    return [cell.verdict("determinism", "state", Status.PASS if same else Status.FAIL, message)]


def expected(scene: Scene, dt: float) -> Mapping[str, Any]:
    """Every setting a scene asks for, by the names of ``adapters.engine.Setup``."""
    asked: dict[str, Any] = {
        "gravity": scene.gravity,
        "dt": dt,
        "linear_damping": 0.0,
        "angular_damping": 0.0,
        "velocity_limit": float("inf"),
    }
    for body in scene.bodies:
        asked[f"body/{body.name}/mass"] = body.mass
        asked[f"body/{body.name}/center_of_mass"] = body.center_of_mass
        asked[f"body/{body.name}/inertia"] = body.inertia
    for joint in scene.scalar_joints:
        asked[f"joint/{joint.name}/stiffness"] = joint.stiffness
        asked[f"joint/{joint.name}/damping"] = joint.damping
    for contact in scene.contacts:
        asked[f"contact/{contact.name}/friction"] = contact.friction
        asked[f"contact/{contact.name}/restitution"] = contact.restitution
    return asked


def counted(scene: Scene, told: Collection[str]) -> dict[str, int]:
    """What a model of ``scene`` may hold, of those parts that its engine counts: ``scenarios.parts``."""
    return {BUILT + name: number for name, number in parts(scene).items() if BUILT + name in told}


def _praise(asked: Collection[str]) -> str:
    kinds = sum(name.startswith(BUILT) for name in asked)
    lean = f", and of {kinds} kinds of parts the model has what the scene needs and no more" if kinds else ""
    return f"{len(asked) - kinds} settings are as asked{lean}"


def _error(name: str, got: Any, asked: Any) -> float:
    """Difference relative to what was asked for; infinite if there is no comparable answer.

    Of a limit on velocities, which nothing asks for: how many times lower it is than one no scene comes near.
    """
    try:
        have, want = np.asarray(got, dtype=np.float64), np.asarray(asked, dtype=np.float64)
    except (TypeError, ValueError):
        return float("inf")
    if have.shape != want.shape:
        return float("inf")
    if name == "velocity_limit":
        return 0.0 if have >= UNLIMITED else float(UNLIMITED / have) if have > 0 else float("inf")
    difference = float(np.max(np.abs(have - want)))
    return difference / (float(np.max(np.abs(want))) or 1.0)


def _difference(cell: Cell, name: str, asked: Mapping[str, Any]) -> str:
    got = cell.provenance.setup.get(name, "nothing")
    probed = ", inferred from a probe run" if name in cell.provenance.probed else ""
    if name.startswith(BUILT):
        return (
            f"{PARTS[name.removeprefix(BUILT)]}: the model has {got}{probed}, the scene needs {asked[name]}"
        )
    return f"{name}: the engine has {got}{probed}, the scene asks for {asked[name]}"


def _inferred(cell: Cell) -> str:
    probed = cell.provenance.probed
    return f"; inferred from a probe run: {', '.join(probed)}" if probed else ""
