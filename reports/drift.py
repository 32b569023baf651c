"""By which law an error grows over a long run, told from the run's own samples.

The samples are cut into blocks, evenly in time. An error is

* exponential, if over the run an exponential fits it four times better than a line (sums of squares), grows
  by more than e², and makes the last quarter's mean more than four times the second's (a line: 2.3 times);
* linear, if from block to block its mean changes by the same amount, five standard errors away from none,
  and comes in all to a tenth of what it swings by within a block;
* bounded, if it swings as widely within a block as over all blocks;
* come to rest, if over the second half it changes by less than a fifth of what it does over the run: whatever
  it gnawed at may be gone, so that there is no more to lose;
* else it wanders as a random walk does, whose range over n blocks is √n times that in one.
"""

from dataclasses import dataclass

import numpy as np

from ..reference.checked import Array, finite
from ..reference.errors import InputError

BOUNDED, RESTED, ROOT, LINEAR, EXPONENTIAL = "bounded", "came to rest", "√t", "linear", "exponential"
BLOCKS = 16
#: The thresholds of the module's text: in tests/reports/test_drift.py 97 of 100 runs of each law are told.
BETTER, FOLDS, QUARTERS = 4.0, 2.0, 4.0
STANDARD_ERRORS, SHARE = 5.0, 0.1
#: A random walk's range is 4 times as wide over 16 blocks as in one; that of a bounded error 1 to 1.5 times.
WIDER, SETTLED = 2.0, 0.2


@dataclass(frozen=True)
class Drift:
    """The ``law`` of an error, its ``rate`` and the ``largest`` error.

    ``rate`` is what the error gains per second if linear, per root of a second if √t, its e-folds per second
    if exponential, and 0 if bounded or come to rest.
    """

    law: str
    rate: float
    largest: float


def drift(t: Array, error: Array) -> Drift:
    """The law by which ``error`` (n,) grows over times ``t`` (n,) [s], evenly spaced; it may have a sign.

    Raises ``InputError`` for fewer than eight samples a block, or times that are not evenly spaced.
    """
    t = finite("t", t, (-1,))
    error = finite("error", error, t.shape)
    steps = np.diff(t)
    if len(t) < 8 * BLOCKS or not np.allclose(steps, steps[0], rtol=1e-6) or steps[0] <= 0:
        raise InputError(f"t: got {len(t)} times, expected at least {8 * BLOCKS}, evenly spaced")
    largest, span = float(np.abs(error).max()), float(t[-1] - t[0])
    blocks = [error[part] for part in np.array_split(np.arange(len(t)), BLOCKS)]
    folds = _folds(t, error)
    if folds:
        return Drift(EXPONENTIAL, folds / span, largest)
    if _linear(blocks):
        return Drift(LINEAR, float(np.polyfit(t - t[0], error, 1)[0]), largest)
    whole = float(np.ptp(error))
    if whole <= WIDER * float(np.mean([np.ptp(block) for block in blocks])):
        return Drift(BOUNDED, 0.0, largest)
    if float(np.ptp(error[len(error) // 2 :])) < SETTLED * whole:
        return Drift(RESTED, 0.0, largest)
    lag = len(t) // BLOCKS
    walked = float(np.sqrt(np.mean((error[lag:] - error[:-lag]) ** 2)))
    return Drift(ROOT, walked / float(np.sqrt(lag * steps[0])), largest)


def _folds(t: Array, error: Array) -> float:
    """How many e-folds an exponential error grows by over the run; 0 if it is none."""
    u = (t - t[0]) / (t[-1] - t[0])
    quarter = len(t) // 4
    second, last = abs(error[quarter : 2 * quarter].mean()), abs(error[-quarter:].mean())
    if last <= QUARTERS * second:
        return 0.0
    line = _left(error, u)
    tried = {folds: _left(error, np.exp(folds * (u - 1))) for folds in np.geomspace(1.0, 500.0, 100)}
    best = min(tried, key=lambda folds: tried[folds])
    return float(best) if best > FOLDS and BETTER * tried[best] < line else 0.0


def _left(error: Array, shape: Array) -> float:
    """Sum of squares that a constant and a multiple of ``shape`` leave of ``error``."""
    e, s = error - error.mean(), shape - shape.mean()
    rest = e - s * (float(e @ s) / float(s @ s))
    return float(rest @ rest)


def _linear(blocks: list[Array]) -> bool:
    means = np.array([block.mean() for block in blocks])
    gains = np.diff(means)
    scatter = float(gains.std(ddof=1)) / np.sqrt(len(gains))
    within = float(np.mean([np.ptp(block) for block in blocks]))
    steady = abs(float(gains.mean())) > STANDARD_ERRORS * scatter
    return bool(steady and abs(means[-1] - means[0]) > SHARE * within)
