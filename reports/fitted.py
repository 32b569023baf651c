"""What a rate is found to be in a motion, and how well the looks at it tell that."""

from dataclasses import fields, replace
from typing import NamedTuple

from ..reference.checked import EPSILON
from ..scenarios.observables import Observable
from ..scenarios.trajectory import Trajectory
from .cell import Cell

#: Fewest samples of which every other one still makes a motion to fit to.
FEWEST = 5


class Fitted(NamedTuple):
    """A number that was fitted, how far off it may be for the looks taken, and its closed form."""

    value: float
    uncertainty: float | None
    exact: float


def fitted(cell: Cell, observable: Observable) -> Fitted | None:
    """The ``observable`` of a cell; ``None`` unless it is a rate.

    Its uncertainty is what it changes by if every other look is left out, and its own rounding at the least;
    ``None`` where too few looks would be left.
    """
    if observable.kind != "rate" or observable.exact is None:
        return None
    exact = float(observable.exact(cell.scene))
    off = _difference(cell, observable, cell.trajectory, cell.truth)
    if len(cell.trajectory.t) < FEWEST:
        return Fitted(exact + off, None, exact)
    half = _difference(cell, observable, _halved(cell.trajectory), _halved(cell.truth))
    return Fitted(exact + off, max(abs(half - off), EPSILON * cell.scale(observable)), exact)


def _difference(cell: Cell, observable: Observable, motion: Trajectory, truth: Trajectory) -> float:
    return float(observable.difference(cell.scene, motion, truth)[0, 0])


def _halved(motion: Trajectory) -> Trajectory:
    """Every other sample, from the first on."""
    arrays = [part.name for part in fields(motion) if part.name != "provenance"]
    return replace(motion, **{name: getattr(motion, name)[::2] for name in arrays})
