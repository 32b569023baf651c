"""How well a supposed model explains what was logged, and the number in it that explains it best."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from ..reference.checked import Array
from ..reference.errors import InputError
from .supposed import Model
from .suspects import Several, Suspect

#: Suspects that are fitted in full, of those that explain most in first order.
REFINED = 8
ROUNDS = 5
#: Step of a finite difference over numbers that are fitted together.
WIDTH = 1e-6

#: What a model leaves unexplained, in units of rounding.
Residual = Callable[[Model], Array]


@dataclass(frozen=True)
class Explanation:
    """A sentence, and what it leaves of the residual (root mean square).

    ``part`` and ``place`` are those of the suspect: what it is a mistake of, and where in the list it stands.
    ``change`` is what it makes of a model; ``digits`` are those of the number that it takes.
    """

    sentence: str
    left: float
    part: str = ""
    place: int = -1
    change: Callable[[Model], Model] = lambda model: model
    digits: int = 0


def size(residual: Array) -> float:
    """Root mean square; infinite where something is not finite."""
    found = float(np.sqrt(np.mean(np.square(residual)))) if residual.size else 0.0
    return found if np.isfinite(found) else float("inf")


def fitted(model: Model, residual: Residual, every: Sequence[Suspect]) -> list[Explanation]:
    """The most likely of the suspects, best first, each with the number that explains most."""
    with np.errstate(all="ignore"):
        return _fitted(model, residual, every)


def _fitted(model: Model, residual: Residual, every: Sequence[Suspect]) -> list[Explanation]:
    start = residual(model)
    ranked = []
    for place, suspect in enumerate(every):
        slope = _slope(model, residual, suspect, 0.0, start)
        if slope is not None and slope @ slope > 0:
            x = -float(slope @ start) / float(slope @ slope)
            if np.isfinite(x):
                ranked.append((size(start + x * slope), x, place))
    ranked.sort(key=lambda found: found[0])
    refined = [_refined(model, residual, every[place], x, place) for _, x, place in ranked[:REFINED]]
    return sorted(refined, key=lambda found: found.left)


def _refined(model: Model, residual: Residual, suspect: Suspect, x: float, place: int) -> Explanation:
    """Newton's iteration on one number."""
    best, left = 0.0, size(residual(model))
    for _ in range(ROUNDS):
        now = _tried(model, residual, suspect, x)
        if now is None or not size(now) < left:
            break
        gained, best, left = left / max(size(now), 1e-300), x, size(now)
        slope = _slope(model, residual, suspect, x, now)
        if slope is None or not slope @ slope > 0 or gained < 1.01:
            break
        x -= float(slope @ now) / float(slope @ slope)
    few = min(digits(best), digits(suspect.value(best)))
    changed = partial(_changed, suspect, best)
    return Explanation(suspect.words(best), left, suspect.part, place, changed, few)


def _changed(suspect: Suspect, x: float, model: Model) -> Model:
    return suspect.change(model, x)


def fitted_together(model: Model, residual: Residual, group: Several) -> Explanation | None:
    """The numbers of a group that explain most, by Newton's iteration on all of them."""
    n = len(group.members)
    best, now = np.zeros(n), residual(model)
    left = size(now)
    for _ in range(ROUNDS):
        columns = [_tried_all(model, residual, group, best + WIDTH * axis) for axis in np.eye(n)]
        if any(column is None for column in columns):
            return None
        slopes = np.stack([(column - now) / WIDTH for column in columns if column is not None], axis=1)
        # Directions that the data do not know are left alone.
        step = np.linalg.lstsq(slopes, -now, rcond=1e-7)[0]
        there = _tried_all(model, residual, group, best + step)
        if there is None or not size(there) < 0.99 * left:
            break
        best, now, left = best + step, there, size(there)
    return Explanation(group.words(best.tolist()), left) if best.any() else None


def digits(value: float) -> int:
    """How many significant digits a number needs, to a part in 10⁵ of it; 7 if more than 4."""
    return next((n for n in range(1, 5) if abs(float(f"{value:.{n - 1}e}") - value) <= 1e-5 * abs(value)), 7)


def _tried_all(model: Model, residual: Residual, group: Several, numbers: Array) -> Array | None:
    def every(m: Model, x: float) -> Model:
        for member, number in zip(group.members, numbers.tolist(), strict=True):
            m = member.change(m, number)
        return m

    return _tried(model, residual, Suspect(every, str), 0.0)


def _slope(model: Model, residual: Residual, suspect: Suspect, x: float, now: Array) -> Array | None:
    width = 1e-3 * max(abs(x), 1e-2)
    there = _tried(model, residual, suspect, x + width)
    return None if there is None else (there - now) / width


def _tried(model: Model, residual: Residual, suspect: Suspect, x: float) -> Array | None:
    """The residual with the suspect's number at x; ``None`` where no such system can be."""
    try:
        with np.errstate(all="ignore"):
            found = residual(suspect.change(model, x))
    except (InputError, np.linalg.LinAlgError):
        return None
    return found if np.isfinite(found).all() else None
