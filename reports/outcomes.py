"""What became of a run, told by its motion alone: what the engine says of itself is noted, not believed."""

from dataclasses import dataclass
from enum import Enum

import numpy as np

from ..adapters.observed import SAMPLES, Observed
from ..adapters.stable_step import BEYOND, GROWTH, RISE, grown, rises
from ..reference.checked import Array
from ..scenarios import mechanics
from ..scenarios.scene import Scene
from ..scenarios.trajectory import Trajectory

#: A run is accurate while no state observable is further from the truth than this part of its size.
ACCURATE = 0.05
#: Steps within which a run that was cut short is run to its end, if its outcome is in doubt: the schemes of
#: first order cease to be accurate on tops at steps of which the scenes last less than this.
LONGEST = 70_000
#: A clamp holds a speed at one value: so long a part of the run, to rounding, and so far from the truth's.
HELD, ROUNDING, APART = 0.5, 1e-12, 0.1
#: What has died down to this part of the truth's largest may stay at one value for want of smaller numbers.
NEGLIGIBLE = 1e-9
#: A clamp is met at once, not approached: from one sample to the next a speed changes by at least this part.
ABRUPT = 1e-6


class Outcome(Enum):
    """How a run ended."""

    ACCURATE = "accurate"
    BOUNDED = "inaccurate but bounded"
    GROWING = "growing"
    CLAMPED = "clamped"
    RESET = "reset"
    NOT_FINITE = "not finite"
    REFUSED = "refused"
    TIMED_OUT = "timed out"
    CRASHED = "crashed"

    @property
    def sentence(self) -> str:
        """What this outcome means, and how it is told."""
        return _SENTENCES[self]


_SENTENCES = {
    Outcome.ACCURATE: f"within {ACCURATE:.0%} of the exact motion, in every observable, at every sample",
    Outcome.BOUNDED: "further from the exact motion, but its energy does not grow",
    Outcome.GROWING: f"energy rises: its largest in the last third of the run is over {GROWTH:g} times that "
    f"in the first, or {BEYOND:g} times that of the start, or it rises steadily, by {RISE - 1:.1%} or more",
    Outcome.CLAMPED: "a speed stays at one value, reached at once and far from the exact one",
    Outcome.RESET: "everything falls back to the start, or to rest, or comes back from what is not finite",
    Outcome.NOT_FINITE: "a position or velocity is infinite or no number",
    Outcome.REFUSED: "the engine or its adapter does not take the scene at this step",
    Outcome.TIMED_OUT: "stopped by the time limit",
    Outcome.CRASHED: "the process died",
}


@dataclass(frozen=True)
class Found:
    """An outcome with its numbers, each ``None`` where there is none or it is not finite.

    ``error`` is the largest, relative to each observable's size; ``energy_most`` and ``energy_last`` are in
    units of the start's energy. ``said``: the engine's own words. ``covered``: how much of the scene's
    duration the run has seen, 1 if all.
    """

    outcome: Outcome
    error: float | None = None
    energy_most: float | None = None
    energy_last: float | None = None
    said: str = ""
    covered: float | None = None

    @property
    def so_far(self) -> bool:
        """Whether the run was cut short in a state of which a longer one might tell another outcome."""
        return unfinished(self.outcome, self.covered)

    @property
    def doubtful(self) -> bool:
        """Whether it was accurate so far, and is not at its end if its error grows as the time squared.

        So errors grow of first order whose rates drift: the phase is off by what the rates lost, summed up.
        """
        if not self.so_far or self.error is None or not self.covered:
            return False
        return self.outcome is Outcome.ACCURATE and self.error > ACCURATE * self.covered**2


def unfinished(outcome: Outcome, covered: float | None) -> bool:
    """Whether an outcome is one that the rest of the scene might change, and there is a rest."""
    return outcome in (Outcome.ACCURATE, Outcome.BOUNDED) and covered is not None and covered < 1


def judged(scene: Scene, observed: Observed) -> Found:
    """What became of a run of ``scene``."""
    motion = observed.motion
    if motion is None or len(motion.t) < 2:
        return Found(Outcome.REFUSED, said=observed.said)
    with np.errstate(all="ignore"):
        truth = scene.truth(scene, motion.t)
        energies = mechanics.energy(scene, motion) / mechanics.energy(scene, truth)[0]
        error = _error(scene, motion, truth)
        # States that end before the run does: the engine's arithmetic failed, so that there are none.
        ended = len(motion.t) > SAMPLES
        outcome = _outcome(motion, truth, energies, error, ended)
    most, last = float(np.max(energies)), float(energies[-1])
    covered = float(motion.t[-1]) / scene.duration
    covered = covered if covered < 1 - 1e-9 else 1.0
    return Found(outcome, _finite(error), _finite(most), _finite(last), observed.said, covered)


def _outcome(motion: Trajectory, truth: Trajectory, energies: Array, error: float, ended: bool) -> Outcome:
    if _reset(motion, truth, energies):
        return Outcome.RESET
    if motion.first_not_finite() is not None or not ended:
        return Outcome.NOT_FINITE
    if _clamped(motion, truth):
        return Outcome.CLAMPED
    if _starts_again(motion, energies):
        return Outcome.RESET
    if error <= ACCURATE:
        return Outcome.ACCURATE
    seen = energies.tolist()
    return Outcome.GROWING if grown(seen) or rises(seen) else Outcome.BOUNDED


def _error(scene: Scene, motion: Trajectory, truth: Trajectory) -> float:
    states = [observable for observable in scene.observables if observable.kind == "state"]
    worst = [np.max(o.distance(scene, motion, truth)) / (o.scale(scene, truth) or 1.0) for o in states]
    return float(np.max(worst))


def _speeds(motion: Trajectory) -> Array:
    """Every velocity component, (n, k)."""
    n = len(motion.t)
    return np.hstack([part.reshape(n, -1) for part in (motion.velocity, motion.omega, motion.joint_velocity)])


def _places(motion: Trajectory) -> Array:
    n = len(motion.t)
    parts = (motion.position, motion.quaternion, motion.joint_position)
    return np.hstack([part.reshape(n, -1) for part in parts])


def _reset(motion: Trajectory, truth: Trajectory, energies: Array) -> bool:
    """Whether it comes back from what is not finite, stands still at once, or stays at its start."""
    finite = np.asarray(np.isfinite(np.hstack([_speeds(motion), _places(motion)])).all(axis=1))
    if np.any(finite[1:] & ~finite[:-1]):
        return True
    moving = np.asarray(_speeds(truth).any(axis=1))
    still = np.asarray(~_speeds(motion).any(axis=1))
    # What is damped away gets there by and by; below a tenth of its energy it may well be at rest next. A
    # damper may stop a body at once, but not where all its joints are at zero.
    zero = np.asarray(~motion.joint_position.any(axis=1))
    stopped = still[1:] & zero[1:] & (energies[:-1] > 0.1) & (moving[1:] | (energies[:-1] > GROWTH))
    everything = np.hstack([_speeds(motion), _places(motion)])
    as_at_start = np.asarray((everything == everything[0]).all(axis=1))
    stays = as_at_start[1:] & as_at_start[:-1] & moving[1:]
    return bool(stopped.any() or stays.any())


def _starts_again(motion: Trajectory, energies: Array) -> bool:
    """Whether energy beyond what any stable scheme reaches is followed by states from before, bit for bit.

    That it falls again is not enough: where rounding changes what grows, a scheme may calm down by itself.
    """
    storm = np.flatnonzero(energies > BEYOND)
    if not storm.size:
        return False
    states = np.hstack([_speeds(motion), _places(motion)])
    before = {state.tobytes() for state in states[: storm[0]]}
    return any(state.tobytes() in before for state in states[storm[0] :])


def _clamped(motion: Trajectory, truth: Trajectory) -> bool:
    """Whether a speed stays at one size from some sample on, reached at once, far from the truth's."""
    n = len(motion.t)
    for speed, exact in zip(np.abs(_speeds(motion)).T, np.abs(_speeds(truth)).T, strict=True):
        value = speed[-1]
        elsewhere = np.flatnonzero(np.abs(speed - value) > ROUNDING * value)
        first = int(elsewhere[-1]) + 1 if elsewhere.size else 0
        held = n - first >= HELD * n and value > NEGLIGIBLE * exact.max()
        abrupt = first <= 1 or abs(speed[first - 1] - value) > ABRUPT * value
        far = np.mean(np.abs(exact[first:] - value) > APART * value) > HELD
        if held and abrupt and far:
            return True
    return False


def _finite(value: float) -> float | None:
    return value if np.isfinite(value) else None
