"""The largest step at which a scheme keeps a scene's energy bounded, by halving an interval.

Energy is ours, from the states; what the engine says of itself is not asked.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..scenarios import mechanics
from ..scenarios.scene import Scene
from ..scenarios.trajectory import Trajectory
from .engine import Engine, EngineError, Scheme, State
from .looked import looked

#: Steps of one trial. Just past its limit by a part ε, semi-implicit Euler's energy grows by exp(4√(2ε)) a
#: step and Runge-Kutta's by exp(14ε), so that at 1e-3 past it the last third is at least 6 times the first;
#: just below it, a beat of semi-implicit Euler's energy lasts π/(2√(2ε)) steps, 35 of the 66 of a third.
STEPS = 200
#: The largest energy of the last third over that of the first from which on it counts as growing. A sampled
#: oscillation that stays bounded shows less than 2, as two samples of it never both miss its height.
GROWTH = 4.0
#: Energy, in units of the start's, past which no more steps are needed. Semi-implicit Euler's may rise to
#: 4/ε within a part ε of its limit, and stay bounded.
BEYOND = 1e6
#: Steps between two looks at the energies: looking costs as much as several steps.
AT_ONCE = 20
#: The steps between which the answer lies differ by this part at most.
PRECISION = 5e-3
#: Each trial's step is so many times the one before, until one grows or this many have not.
FACTOR, TRIALS = 4.0, 11


class StableStep(NamedTuple):
    """The largest step [s] that was seen to hold, and the smallest above it that was seen to grow.

    ``held`` is 0 if the first step tried grew already, ``grew`` infinite if none did.
    """

    held: float
    grew: float


def stable_step(machine: Engine, scene: Scene, scheme: Scheme) -> StableStep:
    """Where ``scene`` begins to grow: tried at its own step, at larger ones, then halved between two."""
    held, grew = 0.0, float("inf")
    step = scene.dt
    for _ in range(TRIALS):
        if grows(machine, scene, scheme, step):
            grew = step
            break
        held, step = step, step * FACTOR
    while 0 < held < grew / (1 + PRECISION) < float("inf"):
        middle = float(np.sqrt(held * grew))
        if grows(machine, scene, scheme, middle):
            grew = middle
        else:
            held = middle
    return StableStep(held, grew)


def grows(machine: Engine, scene: Scene, scheme: Scheme, dt: float) -> bool:
    """Whether the energy grows over ``STEPS`` steps of ``dt`` [s], or the engine can tell no state any more.

    Raises what ``Engine.build`` raises if the engine does not take the scene.
    """
    machine.build(scene, scheme, dt)
    energies = _energies(machine, scene, 0)
    while len(energies) <= STEPS:
        try:
            energies += _energies(machine, scene, AT_ONCE)
        # ValueError and ArithmeticError: Python's own mathematics of what is not finite.
        except (EngineError, ValueError, ArithmeticError):
            return True
        if beyond(energies):
            return True
    return grown(energies)


def beyond(energies: Sequence[float]) -> bool:
    """Whether an energy is not finite, or so much more than the first that no stable scheme reaches it."""
    return not max(energies) <= BEYOND * abs(energies[0]) or any(math.isnan(energy) for energy in energies)


def grown(energies: Sequence[float]) -> bool:
    """Whether energies, one a sample, end far above where they began."""
    third = len(energies) // 3
    return beyond(energies) or max(energies[-third:]) > GROWTH * max(energies[:third])


def _energies(machine: Engine, scene: Scene, steps: int) -> list[float]:
    """Energy [J] after each of so many steps; of where it is now if there are none."""
    states = []
    # A run past its limit leaves the range of doubles, which is what is looked for.
    with np.errstate(all="ignore"):
        for _ in range(max(steps, 1)):
            if steps:
                machine.step(1)
            states.append(looked(machine)[0])
        parts = (np.array(part) for part in zip(*states, strict=True))
        motion = Trajectory(np.zeros(len(states)), *State(*parts))
        found: list[float] = mechanics.energy(scene, motion).tolist()
    return found
