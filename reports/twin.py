"""Twins: engines that run the same scheme at the same step must agree to rounding."""

from collections.abc import Collection, Iterable, Sequence

import numpy as np

from ..reference.checked import Array
from ..scenarios.observables import Observable
from .cell import Cell
from .deviations import Deviation
from .growth import growth
from .verdict import Ladder, Status, Verdict, ladder_of

#: Round-off that twins may differ by, relative to the state's size, and its growth with a kick's.
BASE, PER_GROWTH = 1e-12, 1e-13
#: Above this growth of a kick, rounding alone separates twins: there is nothing to check.
CHAOTIC = 1e6


def check(
    twins: Sequence[Cell], suspects: Collection[Ladder] = (), known: Iterable[Deviation] = ()
) -> list[Verdict]:
    """Verdicts on cells of one scene, one step and one twin name.

    A cell is held against the nearer half of the other engines' cells, so that where three run
    the scheme and one is wrong, only that one fails. ``suspects`` are those that fail checks of
    their own: no other is held against them. Where a cell has no other twin than one that is
    ``known`` to deviate so far, the failure is known too: it is not the cell's own.
    """
    if len({cell.provenance.engine for cell in twins}) < 2:
        return []
    A = growth(twins[0].scene)
    if A > CHAOTIC:
        return [cell.verdict("twin", "state", Status.PASS, _too_chaotic(A)) for cell in twins]
    allowed = BASE + PER_GROWTH * A
    deviations = tuple(known)
    return [_judged(cell, _held_against(cell, twins, suspects), allowed, deviations) for cell in twins]


def _held_against(cell: Cell, twins: Sequence[Cell], suspects: Collection[Ladder]) -> list[Cell]:
    """The cells of other engines, and of those only the sound ones unless the cell is suspect itself."""
    others = [twin for twin in twins if twin.provenance.engine != cell.provenance.engine]
    if ladder_of(cell.provenance) in suspects:
        return others
    return [twin for twin in others if ladder_of(twin.provenance) not in suspects]


def _judged(cell: Cell, others: Sequence[Cell], allowed: float, known: Iterable[Deviation]) -> Verdict:
    if not others:
        message = "no twin check: every engine with the same scheme fails checks of its own"
        return cell.verdict("twin", "state", Status.PASS, message)
    ranked = sorted(((_apart(cell, twin), twin) for twin in others), key=lambda pair: pair[0][0])
    (measured, observable, at), other = ranked[(len(ranked) - 1) // 2]
    name = f"{other.provenance.engine} {other.provenance.scheme}"
    message = (
        f"farthest from its twin {name} in {observable}, relative to its size; "
        f"1e-12 + 1e-13·A is allowed, A = {growth(cell.scene):.3g} being the growth of a kick"
        f"{cell.granted or other.granted}"
    )
    allowed += cell.softness + other.softness
    status = Status.PASS if measured <= allowed else Status.FAIL
    others_own = other.verdict("twin", "state", status, message, measured)
    reasons = [d.reason for d in known if d.applies(others_own) and measured <= d.bound]
    if status is Status.FAIL and reasons:
        status, message = Status.KNOWN, f"{message}; known of {name}: {reasons[0]}"
    return cell.verdict("twin", "state", status, message, measured, allowed, "1", at)


def _apart(cell: Cell, other: Cell) -> tuple[float, str, float]:
    """Largest relative distance over samples and state observables, in which one, and when."""
    worst = (0.0, "nothing", 0.0)
    for observable in cell.scene.observables:
        if observable.kind == "state":
            distances = _relative(cell, other, observable)
            place = int(np.argmax(distances))
            worst = max(worst, (float(distances[place]), observable.name, float(cell.trajectory.t[place])))
    return worst


def _relative(cell: Cell, other: Cell, observable: Observable) -> Array:
    scale = cell.scale(observable) or 1.0
    return observable.distance(cell.scene, cell.trajectory, other.trajectory) / scale


def _too_chaotic(A: float) -> str:
    return f"no twin check: a kick grows {A:.3g}-fold, more than {CHAOTIC:g}; rounding alone separates twins"
