"""The comparator: trajectories in, verdicts out, with no engine in sight."""

from collections import defaultdict
from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence

from ..scenarios.registry import scenes as all_scenes
from ..scenarios.scene import Scene
from ..scenarios.trajectory import Provenance, Trajectory
from . import acceleration, deviations, order, setup, stability, truth, twin
from .cell import Cell
from .deviations import Deviation
from .verdict import Status, Verdict, ladder_of


def judge(
    trajectories: Iterable[Trajectory],
    scenes: Mapping[str, Scene] | None = None,
    known: Iterable[Deviation] | None = None,
) -> list[Verdict]:
    """Every verdict that these trajectories allow, in their order.

    One trajectory is held against the truth, its invariants, its setup and itself; order needs
    several steps of one scheme, twin several engines at one step. ``scenes`` are those of Poinsot
    unless given, ``known`` the deviations on record. Raises ``InputError`` for a trajectory of
    unknown origin.
    """
    there = dict(all_scenes() if scenes is None else scenes)
    return judge_cells([Cell.of(trajectory, there) for trajectory in trajectories], known)


def judge_cells(cells: Sequence[Cell], known: Iterable[Deviation] | None = None) -> list[Verdict]:
    """As ``judge``, of trajectories beside what is true of them."""
    broken = [verdict for cell in cells for verdict in _finite(cell)]
    sound = [cell for cell in cells if cell.trajectory.first_not_finite() is None]
    checks = (truth.check, setup.check, setup.determinism, acceleration.check, stability.check)
    alone = [verdict for cell in sound for check in checks for verdict in check(cell)]
    ladders = [v for group in _grouped(sound, ladder_of) for v in order.check(group)]
    on_record = tuple(deviations.recorded() if known is None else known)
    partly = order.partly(cells)
    first = deviations.applied([*broken, *alone, *ladders], on_record, partly)
    suspects = {ladder_of(verdict) for verdict in first if verdict.status is not Status.PASS}
    twins = _grouped([c for c in sound if c.provenance.twin], lambda p: (p.scene, p.dt, p.twin))
    second = [v for group in twins for v in twin.check(group, suspects, on_record)]
    return [*first, *deviations.applied(second, on_record, partly)]


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
