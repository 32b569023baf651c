"""Twins: engines that run the same scheme at the same step must agree to rounding."""

from collections.abc import Callable, Collection, Iterable, Sequence
from dataclasses import replace

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
    twins: Sequence[Cell],
    suspects: Collection[Ladder] = (),
    known: Iterable[Deviation] = (),
    follows: Callable[[Ladder], bool] = lambda ladder: False,
) -> list[Verdict]:
    """Verdicts on cells of one scene, one step and one twin name.

    A cell is held against the nearer half of the other engines' cells, so that where three run
    the scheme and one is wrong, only that one fails. ``suspects`` are those that fail checks of
    their own: no other is held against them. Where a cell has no other twin than one that is
    ``known`` to deviate so far, the failure is known too: it is not the cell's own. Where some fail
    that nothing else speaks against, all are held against those alone whose samples ``follows`` says
    to follow from one another, if there are such: it is not asked of any where twins agree.
    """
    if len({cell.provenance.engine for cell in twins}) < 2:
        return []
    A = growth(twins[0].scene)
    if A > CHAOTIC:
        return [cell.verdict("twin", "state", Status.PASS, _too_chaotic(A)) for cell in twins]
    allowed = BASE + PER_GROWTH * A
    deviations = tuple(known)
    found = [_judged(cell, _held_against(cell, twins, suspects), allowed, deviations) for cell in twins]
    trusted = {ladder_of(cell.provenance) for cell in twins} - set(suspects)
    if not any(ladder_of(verdict) in trusted and _unexplained(verdict, deviations) for verdict in found):
        return found
    sound = {ladder for ladder in trusted if follows(ladder)}
    if not sound or sound == trusted:
        return [_one_of_two(verdict, twins) for verdict in found]
    witnesses = [cell for cell in twins if ladder_of(cell.provenance) in sound]
    return [
        _beside_sound(cell, witnesses, before, allowed, deviations)
        for cell, before in zip(twins, found, strict=True)
    ]


def _unexplained(verdict: Verdict, known: Iterable[Deviation]) -> bool:
    if verdict.status is not Status.FAIL or verdict.measured is None:
        return False
    return not any(d.applies(verdict) and verdict.measured <= d.bound for d in known)


def _one_of_two(verdict: Verdict, twins: Sequence[Cell]) -> Verdict:
    """Where two engines differ and nothing tells which is wrong, both fail; it is said that one is meant."""
    if verdict.status is not Status.FAIL or len({twin.provenance.engine for twin in twins}) > 2:
        return verdict
    return replace(verdict, message=f"{verdict.message}; one of the two is wrong: nothing here tells which")


def _beside_sound(
    cell: Cell, sound: Sequence[Cell], before: Verdict, allowed: float, known: Sequence[Deviation]
) -> Verdict:
    """The verdict on a cell among twins that differ, ``before`` it was asked whose samples are right."""
    others = [twin for twin in sound if twin.provenance.engine != cell.provenance.engine]
    if cell not in sound:
        if not others:
            return before
        verdict = _judged(cell, others, allowed, known)
        if verdict.status is not Status.FAIL:
            return verdict
        return replace(
            verdict, message=f"{verdict.message}; its samples follow from one another, these do not"
        )
    if others:
        return _judged(cell, others, allowed, known)
    message = "no twin check: of this scheme's engines only this one's samples follow from one another"
    return cell.verdict("twin", "state", Status.PASS, message)


def _held_against(cell: Cell, twins: Sequence[Cell], suspects: Collection[Ladder]) -> list[Cell]:
    """The cells of other engines, and of those only the sound ones unless the cell is suspect itself."""
    others = [twin for twin in twins if twin.provenance.engine != cell.provenance.engine]
    if ladder_of(cell.provenance) in suspects:
        return others
    return [twin for twin in others if ladder_of(twin.provenance) not in suspects]


def _judged(cell: Cell, others: Sequence[Cell], allowed: float, known: Iterable[Deviation]) -> Verdict:
    if not others:
        message = (
            "no twin check: every engine with the same scheme fails checks of its own, or as is on record"
        )
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
            # What is no number is farther than any: the largest of numbers would leave it out.
            distances = np.where(np.isnan(distances), np.inf, distances)
            place = int(np.argmax(distances))
            worst = max(worst, (float(distances[place]), observable.name, float(cell.trajectory.t[place])))
    return worst


def _relative(cell: Cell, other: Cell, observable: Observable) -> Array:
    scale = cell.scale(observable) or 1.0
    return observable.distance(cell.scene, cell.trajectory, other.trajectory) / scale


def _too_chaotic(A: float) -> str:
    return f"no twin check: a kick grows {A:.3g}-fold, more than {CHAOTIC:g}; rounding alone separates twins"
