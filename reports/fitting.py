"""How well a supposed model explains what was logged, and the number in it that explains it best."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ..reference.checked import Array
from ..reference.errors import InputError
from .supposed import Model
from .suspects import Suspect

#: Suspects that are fitted in full, of those that explain most in first order.
REFINED = 8
ROUNDS = 5

#: What a model leaves unexplained, in units of rounding.
Residual = Callable[[Model], Array]


@dataclass(frozen=True)
class Explanation:
    """A sentence, and what it leaves of the residual (root mean square).

    ``part`` and ``place`` are those of the suspect: what it is a mistake of, and where in the list it stands.
    """

    sentence: str
    left: float
    part: str = ""
    place: int = -1


def size(residual: Array) -> float:
    """Root mean square; infinite where something is not finite."""
    found = float(np.sqrt(np.mean(np.square(residual)))) if residual.size else 0.0
    return found if np.isfinite(found) else float("inf")


def fitted(model: Model, residual: Residual, every: Sequence[Suspect]) -> list[Explanation]:
    """The most likely of the suspects, best first, each with the number that explains most."""
    start = residual(model)
    ranked = []
    for place, suspect in enumerate(every):
        slope = _slope(model, residual, suspect, 0.0, start)
        if slope is not None and slope @ slope > 0:
            x = -float(slope @ start) / float(slope @ slope)
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
    return Explanation(suspect.words(best), left, suspect.part, place)


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
