"""Motion of the double pendulum at any amplitude: the equations of `double_pendulum`, integrated.

There is no closed form, and from large angles the motion may be chaotic: every error grows. So each stretch
between two times is stepped in extended precision by Gragg's midpoint rule with 2, 4, … 20 substeps, whose
results are extrapolated to a substep of no length, and halved until the extrapolation has settled.

Source: Hairer, Nørsett & Wanner, *Solving Ordinary Differential Equations I*, § II.9 (extrapolation).
"""

from typing import Any

import numpy as np
import numpy.typing as npt

from .checked import Array, finite, times
from .double_pendulum import Links, in_any_precision
from .errors import InputError

#: States and their rates: extended precision where the machine has any.
_Long = npt.NDArray[np.longdouble]

_SUBSTEPS = range(2, 22, 2)
#: What an extrapolation may still change by, in units of the largest of a state's numbers.
_SETTLED = 8 * float(np.finfo(np.longdouble).eps)
#: Halvings of a stretch before it is given up.
_DEEPEST = 40


def motion(
    links: Links, angles0: npt.ArrayLike, rates0: npt.ArrayLike, t: npt.ArrayLike
) -> tuple[Array, Array]:
    """θ1, θ2 (n, 2) from the vertical [rad] and their rates (n, 2) [rad/s], at the times t (n,) [s].

    From ``angles0`` and ``rates0`` (2,) at t = 0; times from 0 on, ascending. Rounding leaves about 1e-18 of
    the largest number in each stretch of 0.02 s, times what a kick grows to. Raises InputError for other
    times, or where a stretch does not settle. Source: see the module's.
    """
    start = np.concatenate([finite("angles0", angles0, (2,)), finite("rates0", rates0, (2,))])
    moments = times("t", t)
    if np.any(np.diff(moments, prepend=0.0) < 0):
        raise InputError(f"t: got {moments.tolist()}, expected times from 0 on, ascending")
    state, now = start.astype(np.longdouble), np.longdouble(0)
    result = np.empty((len(moments), 4))
    for row, moment in zip(result, moments.astype(np.longdouble), strict=True):
        # Too long a stretch may leave the numbers there are: it has then not settled.
        with np.errstate(over="ignore", invalid="ignore"):
            state, now = _stretch(links, state, moment - now), moment
        row[:] = state.astype(np.float64)
    return result[:, :2], result[:, 2:]


def _stretch(links: Links, state: _Long, length: Any, depth: int = 0) -> _Long:
    """The state ``length`` [s] later."""
    if length == 0:
        return state
    row: list[_Long] = []
    for count in _SUBSTEPS:
        previous, row = row, [_midpoint(links, state, length, count)]
        for back, before in enumerate(previous, start=1):
            ratio = np.longdouble(count) / (count - 2 * back)
            row.append(row[-1] + (row[-1] - before) / (ratio**2 - 1))
        if len(row) > 2 and np.abs(row[-1] - row[-2]).max() <= _SETTLED * np.abs(state).max():
            return row[-1]
    if depth == _DEEPEST:
        raise InputError(f"t: got a stretch of the motion that does not settle in steps of {float(length)} s")
    middle = _stretch(links, state, length / 2, depth + 1)
    return _stretch(links, middle, length / 2, depth + 1)


def _midpoint(links: Links, state: _Long, length: Any, count: int) -> _Long:
    """Gragg's rule with an even number of substeps: its error has even powers of the substep alone."""
    step = length / count
    before: _Long = state
    now: _Long = state + step * _rates(links, state)
    for _ in range(count - 1):
        before, now = now, before + 2 * step * _rates(links, now)
    return now


def _rates(links: Links, state: _Long) -> _Long:
    th1, th2, w1, w2 = state
    return np.array([w1, w2, *in_any_precision(links, th1, th2, w1, w2)])
