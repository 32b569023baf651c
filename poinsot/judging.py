"""Logs judged scene by scene, as many at once as there are cores: no check looks beyond its scene."""

import multiprocessing
from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any

from .adapters import log, spent
from .adapters.one_thread import one_thread_each
from .reference.errors import InputError
from .reports import order, results, truth
from .reports.cell import Cell
from .reports.common_causes import Localisation
from .reports.digest import Column, columns
from .reports.judge import judge_cells
from .reports.plots import Figure, Motion, motion_figures
from .reports.results import CellRecord, Key
from .reports.verdict import Ladder, Status, Verdict
from .scenarios.registry import scenes as all_scenes
from .scenarios.trajectory import Trajectory


@dataclass
class Judged:
    """What the logs of one scene, or of several, came to."""

    verdicts: list[Verdict] = field(default_factory=list)
    localised: list[Localisation] = field(default_factory=list)
    rows: list[dict[str, Any]] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    partly: set[Ladder] = field(default_factory=set)
    pictures: dict[str, list[Figure]] = field(default_factory=dict)
    #: Seconds of the processor by scene and part.
    spent: dict[str, dict[str, float]] = field(default_factory=dict)

    def add(self, other: "Judged") -> None:
        """Append what another scene came to."""
        self.verdicts += other.verdicts
        self.localised += other.localised
        self.rows += other.rows
        self.notes += other.notes
        self.partly |= other.partly
        self.pictures |= other.pictures
        self.spent |= other.spent


def judged(
    folder: Path,
    records: Sequence[CellRecord],
    seconds: Mapping[Key, Mapping[str, Any]],
    workers: int,
    progress: Callable[[int, int], None] = lambda done, of: None,
) -> Judged:
    """Every log of ``records``, read from ``folder`` and judged; ``workers`` processes, or this one alone.

    ``progress`` is told how many scenes of how many are done.
    Raises ``CorruptLog`` for a log that is not what was written, ``InputError`` for one of another scene.
    """
    by_scene: dict[str, list[CellRecord]] = defaultdict(list)
    for record in records:
        if record.log:
            by_scene[record.scene].append(record)
    work = partial(_judged, folder, columns(results.cells(records)), dict(seconds))
    found = Judged()
    scenes = list(by_scene.values())
    for done, one in enumerate(_mapped(work, scenes, min(workers, len(scenes))), start=1):
        found.add(one)
        progress(done, len(scenes))
    return found


def _mapped(
    work: Callable[[list[CellRecord]], Judged], parts: Sequence[list[CellRecord]], workers: int
) -> Iterator[Judged]:
    """``work`` on each part, in order."""
    if workers <= 1:
        yield from map(work, parts)
        return
    with one_thread_each(), ProcessPoolExecutor(workers, multiprocessing.get_context("spawn")) as pool:
        yield from pool.map(work, parts)


def _judged(
    folder: Path,
    every: Sequence[Column],
    seconds: Mapping[Key, Mapping[str, Any]],
    records: Sequence[CellRecord],
) -> Judged:
    spent.forget()
    known = all_scenes()
    with spent.on("reading"):
        cells = [Cell.of(_read(folder, record), known) for record in records]
    with spent.on("errors"):  # first, so that what the truth costs is not put on the checks
        rows = results.precision_rows(cells, seconds)
    with spent.on("checks"):
        verdicts = judge_cells(cells)
        found = Judged(
            verdicts=verdicts,
            localised=_localised(cells, verdicts),
            rows=rows,
            notes=_notes(cells, verdicts),
            partly=order.partly(cells),
        )
    with spent.on("pictures"):
        found.pictures = {records[0].scene: motion_figures(_shown(cells), every)}
    found.spent = {records[0].scene: spent.so_far()}
    return found


def _localised(cells: Sequence[Cell], verdicts: Sequence[Verdict]) -> list[Localisation]:
    """What most likely is wrong where a check fails."""
    if not any(verdict.status is Status.FAIL for verdict in verdicts):
        return []
    from .reports import localisation  # a run without failures does without it

    return localisation.localised(cells, verdicts)


def _shown(cells: Sequence[Cell]) -> Motion:
    """What the pictures of a scene show of its cells: every scheme at the scene's own step, if it was run."""
    scene = cells[0].scene
    own = [cell for cell in cells if cell.provenance.dt == scene.whole_step(scene.dt)]
    return Motion(scene, tuple(cell.trajectory for cell in own or cells))


def _notes(cells: Sequence[Cell], verdicts: Sequence[Verdict]) -> list[str]:
    """What is known of no cell's own step, and judged over its ladder alone."""
    blind = {(v.scene, v.engine, v.scheme, v.dt) for v in verdicts if v.status is Status.UNSUPPORTED}
    found = []
    for cell in cells:
        p, missing = cell.provenance, truth.without_constant(cell)
        if missing and (p.scene, p.engine, p.scheme, p.dt) not in blind:
            found.append(
                f"{p.engine} {p.scheme} in {p.scene} at dt {p.dt:g} s: no error constant is recorded for "
                f"{', '.join(missing)}; judged by order and limit alone."
            )
    return found


def _read(folder: Path, record: CellRecord) -> Trajectory:
    logged = log.read(folder / str(record.log))
    if record.scene not in all_scenes() or logged.scene_json != all_scenes()[record.scene].as_json():
        raise InputError(
            f"{record.log}: got a scene {record.scene} that is not the one this Poinsot knows by that name; "
            "report it with the version that ran it, or run it again"
        )
    return logged.trajectory
