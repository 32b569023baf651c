"""A run looked at whatever becomes of it: past the stable step, past the finite numbers."""

import math
from dataclasses import dataclass

import numpy as np

from ..reference.errors import InputError, PoinsotError
from ..scenarios.scene import Scene
from ..scenarios.trajectory import Trajectory
from .engine import Engine, EngineError, Scheme, State
from .looked import looked
from .simulate import unsupported

#: At how many times a run is looked at after its start; of so many steps it has at least.
SAMPLES = 200


@dataclass(frozen=True)
class Observed:
    """What was seen of a run.

    ``motion`` is ``None`` if the engine did not take the scene; it ends early where the engine could tell
    no state any more. ``said`` is the first complaint of the engine or of its adapter, if there was any.
    """

    dt: float
    steps: int
    motion: Trajectory | None
    said: str = ""


def observe(scene: Scene, engine: type[Engine], scheme: Scheme, dt: float, most: int) -> Observed:
    """Run ``scene`` for its duration at ``dt`` [s]: over ``SAMPLES`` steps at least, ``most`` at most.

    Never raises what an engine raises: that is what is observed.
    """
    # Less a rounding error, so that a duration of n steps takes n.
    steps = max(SAMPLES, min(math.ceil(scene.duration / dt * (1 - 1e-12)), most))
    looks = np.arange(SAMPLES + 1) * steps // SAMPLES
    reason = unsupported(scene, engine, scheme)
    if reason:
        return Observed(dt, steps, None, reason)
    machine = engine()
    try:
        machine.build(scene, scheme, dt)
    except PoinsotError as error:
        machine.close()
        return Observed(dt, steps, None, str(error))
    try:
        states, said = _watched(machine, np.diff(looks).tolist())
    finally:
        machine.close()
    t = np.asarray(looks[: len(states)] * dt, dtype=np.float64)
    parts = (np.array(part) for part in zip(*states, strict=True))
    return Observed(dt, steps, Trajectory(t, *State(*parts)), said)


def _watched(machine: Engine, strides: list[int]) -> tuple[list[State], str]:
    """States at the start and after each of ``strides``, numbers of steps."""
    states: list[State] = []
    said = ""
    # Numbers that leave the range of doubles are what is watched for.
    with np.errstate(all="ignore"):
        for stride in [0, *strides]:
            try:
                if stride:
                    machine.step(stride)
                state, complaint = looked(machine)
            except (EngineError, InputError, ArithmeticError, ValueError) as error:
                return states, said or f"{type(error).__name__}: {error}"
            states.append(state)
            said = said or complaint
    return states, said
