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
#: What never falls, and rises at this part of all looks or more to so many times the start, grows as well,
#: however slowly: taken explicitly, a gyroscopic torque adds the same part of the energy at each step, if
#: only while a body tumbles. What oscillates, or is damped, falls again; what jumps once rises seldom.
RISING, RISE, ROUNDING = 1 / 3, 1.001, 1e-12
#: Energy, in units of the start's, past which no more steps are needed. Semi-implicit Euler's may rise to
#: 4/ε within a part ε of its limit, and stay bounded.
BEYOND = 1e6
#: Steps between two looks at the energies: looking costs as much as several steps.
AT_ONCE = 20
#: The steps between which the answer lies differ by this part at most.
PRECISION = 5e-3
#: Each trial's step is so many times the one before, until one grows or this many have not.
FACTOR, TRIALS = 4.0, 11
#: Where the first step grows already, so many are tried that are each smaller by the same factor.
SMALLER = 3


class StableStep(NamedTuple):
    """The largest step [s] that was seen to hold, and the smallest above it that was seen to grow.

    ``held`` is 0 if all that were tried grew, ``grew`` infinite if none did.
    """

    held: float
    grew: float


def stable_step(machine: Engine, scene: Scene, scheme: Scheme) -> StableStep:
    """Where ``scene`` begins to grow: tried at its own step, at larger ones, then halved between two.

    If it grows at its own step, smaller ones are tried over the same time.
    """
    held, grew = 0.0, float("inf")
    step = scene.dt
    for _ in range(TRIALS):
        if grows(machine, scene, scheme, step):
            grew = step
            break
        held, step = step, step * FACTOR
    for _ in range(0 if held else SMALLER):
        step = grew / FACTOR
        if not grows(machine, scene, scheme, step):
            held = step
            break
        grew = step
    while 0 < held < grew / (1 + PRECISION) < float("inf"):
        middle = float(np.sqrt(held * grew))
        if grows(machine, scene, scheme, middle):
            grew = middle
        else:
            held = middle
    return StableStep(held, grew)


def grows(machine: Engine, scene: Scene, scheme: Scheme, dt: float) -> bool:
    """Whether the energy grows over ``STEPS`` steps of ``dt`` [s], or the engine can tell no state any more.

    Below the scene's own step so many more are taken that the time is the same, and slow growth counts.
    Raises what ``Engine.build`` raises if the engine does not take the scene.
    """
    machine.build(scene, scheme, dt)
    stride = max(1, round(scene.dt / dt))
    energies = _energies(machine, scene, 0)
    while len(energies) <= STEPS:
        try:
            energies += _energies(machine, scene, AT_ONCE, stride)
        # ValueError and ArithmeticError: Python's own mathematics of what is not finite.
        except (EngineError, ValueError, ArithmeticError):
            return True
        if beyond(energies):
            return True
    return grown(energies) or (dt < scene.dt and rises(energies))


def beyond(energies: Sequence[float]) -> bool:
    """Whether an energy is not finite, or so much more than the first that no stable scheme reaches it."""
    return not max(energies) <= BEYOND * abs(energies[0]) or any(math.isnan(energy) for energy in energies)


def grown(energies: Sequence[float]) -> bool:
    """Whether energies, one a sample, end far above where they began."""
    third = len(energies) // 3
    return beyond(energies) or max(energies[-third:]) > GROWTH * max(energies[:third])


def rises(energies: Sequence[float]) -> bool:
    """Whether energies, one a sample, never fall, beyond rounding, and often rise."""
    found = np.array(energies)
    rounding = ROUNDING * np.abs(found[:-1])
    gains = np.diff(found)
    steady = np.all(gains >= -rounding) and np.mean(gains > rounding) >= RISING
    return bool(steady and found[-1] > RISE * found[0])


def _energies(machine: Engine, scene: Scene, looks: int, stride: int = 1) -> list[float]:
    """Energy [J] at each of so many looks, ``stride`` steps apart; where it is now if there are none."""
    states = []
    # A run past its limit leaves the range of doubles, which is what is looked for.
    with np.errstate(all="ignore"):
        for _ in range(max(looks, 1)):
            if looks:
                machine.step(stride)
            states.append(looked(machine)[0])
        parts = (np.array(part) for part in zip(*states, strict=True))
        motion = Trajectory(np.zeros(len(states)), *State(*parts))
        found: list[float] = mechanics.energy(scene, motion).tolist()
    return found
