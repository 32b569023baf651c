"""The comparator: trajectories in, verdicts out, with no engine in sight."""

from collections import defaultdict
from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from functools import cache

from ..reference.errors import InputError, PoinsotError
from ..scenarios.registry import scenes as all_scenes
from ..scenarios.scene import Scene
from ..scenarios.trajectory import Provenance, Trajectory
from . import acceleration, deviations, order, setup, stability, told, truth, twin
from .cell import Cell
from .deviations import Deviation
from .verdict import Ladder, Status, Verdict, ladder_of

#: A scheme with such a verdict is nothing to hold others against; a check that could not be made is none.
SUSPICIOUS = (Status.FAIL, Status.ERROR, Status.KNOWN)


def judge(
    trajectories: Iterable[Trajectory],
    scenes: Mapping[str, Scene] | None = None,
    known: Iterable[Deviation] | None = None,
) -> list[Verdict]:
    """Every verdict that these trajectories allow, in their order.

    One trajectory is held against the truth, its invariants, its setup and itself; order needs
    several steps of one scheme, twin several engines at one step. ``scenes`` are those of Poinsot
    unless given, ``known`` the deviations on record. Raises ``InputError`` for a trajectory of
    unknown origin, and for two of one origin.
    """
    there = dict(all_scenes() if scenes is None else scenes)
    return judge_cells([Cell.of(trajectory, there) for trajectory in trajectories], known)


def judge_cells(cells: Sequence[Cell], known: Iterable[Deviation] | None = None) -> list[Verdict]:
    """As ``judge``, of trajectories beside what is true of them."""
    _all_different(cells)
    broken = [verdict for cell in cells for verdict in _finite(cell)]
    sound = [cell for cell in cells if cell.trajectory.first_not_finite() is None]
    checks = (truth.check, setup.check, setup.determinism, acceleration.check, stability.check)
    alone = [verdict for cell in sound for check in checks for verdict in check(cell)]
    fitting = [v for group in _grouped(sound, lambda p: p.scene) for v in told.check(group)]
    by_ladder = {ladder_of(group[0].provenance): group for group in _grouped(sound, ladder_of)}
    ladders = [v for group in by_ladder.values() for v in order.check(group)]
    ordered = {ladder_of(verdict) for verdict in ladders if verdict.status is not Status.UNSUPPORTED}
    blind = [v for cell in sound for v in truth.blind(cell, ladder_of(cell.provenance) in ordered)]
    on_record = tuple(deviations.recorded() if known is None else known)
    partly = order.partly(cells)
    first = deviations.applied([*broken, *alone, *fitting, *ladders, *blind], on_record, partly)
    suspects = {ladder_of(verdict) for verdict in first if verdict.status in SUSPICIOUS}
    twins = _grouped([c for c in sound if c.provenance.twin], lambda p: (p.scene, p.dt, p.twin))
    follows = cache(lambda ladder: _follows(by_ladder[ladder]))
    second = [v for group in twins for v in twin.check(group, suspects, on_record, follows)]
    return [*first, *deviations.applied(second, on_record, partly)]


def _all_different(cells: Iterable[Cell]) -> None:
    seen = set[tuple[Ladder, float]]()
    for cell in cells:
        of, dt = ladder_of(cell.provenance), cell.provenance.dt
        if (of, dt) in seen:
            words = f"{of[0]} in {' '.join(of[1:])} at dt {dt:g} s"
            raise InputError(f"trajectories: got two of {words}, expected one of each step")
        seen.add((of, dt))


def _follows(ladder: Sequence[Cell]) -> bool:
    """Whether each sample of its coarsest run follows from the one before, by equations and scheme."""
    from .evidence import Evidence  # a run in which twins agree does without it

    try:
        return Evidence.of(ladder).right
    except (ArithmeticError, ValueError, PoinsotError):
        return False


def _finite(cell: Cell) -> list[Verdict]:
    since = cell.trajectory.first_not_finite()
    if since is None:
        return []
    return [cell.verdict("truth", "state", Status.ERROR, f"not finite from t = {since:g} s on", at=since)]


def _grouped(cells: Iterable[Cell], key: Callable[[Provenance], Hashable]) -> list[list[Cell]]:
    groups: dict[Hashable, list[Cell]] = defaultdict(list)
    for cell in cells:
        groups[key(cell.provenance)].append(cell)
    return list(groups.values())
