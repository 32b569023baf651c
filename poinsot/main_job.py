"""The main job: scenes in engines, logs, verdicts, a report."""

import os
from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import replace
from datetime import UTC, datetime
from functools import partial
from pathlib import Path
from statistics import median
from time import perf_counter
from typing import Any, Protocol

from . import precision
from .adapters import log, runner
from .adapters.environment import environment
from .adapters.runner import Request
from .adapters.timing import SPREAD, Timing
from .cost import Cost
from .estimate import Estimate
from .judging import judged
from .plan import Extent, Plan, in_turn, not_to_time, to_time
from .reference.errors import InputError
from .reports import deviations, results
from .reports.results import CellRecord, Key
from .reports.verdict import Status
from .reports.wording import listed
from .scenarios.registry import scenes as all_scenes

LOGS = "logs"
#: How many cells a note names.
NAMED = 10


class Progress(Protocol):
    """Told how far a run has come."""

    def __call__(self, phase: str, done: int, of: int) -> None:
        """``done`` of ``of`` cells of ``phase`` are behind us."""
        ...


def output_folder(out: Path | None) -> Path:
    """Make the folder a run goes into, with one for its logs; as ``new_folder``."""
    folder = new_folder(out)
    (folder / LOGS).mkdir()
    return folder


def new_folder(out: Path | None) -> Path:
    """Make the folder ``out``, new or empty, or a new dated one.

    Raises ``InputError`` if it holds something already or cannot be made or written.
    """
    folder = out or Path("poinsot-runs") / f"{datetime.now():%Y-%m-%d_%H-%M-%S}"
    try:
        if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
            raise InputError(f"--out: got {folder}, which is not empty; expected a new or an empty folder")
        folder.mkdir(parents=True, exist_ok=True)
        if not os.access(folder, os.W_OK):
            raise InputError(f"--out: got {folder}, which cannot be written")
    except OSError as error:
        raise InputError(f"--out: got {folder}, which cannot be written ({error.strerror})") from error
    return folder


def run(
    laid: Plan,
    folder: Path,
    command: str,
    workers: int,
    time_limit: float,
    with_timing: bool,
    progress: Progress,
    expected: Estimate | None = None,
) -> dict[str, Any]:
    """Run every cell of the plan, then judge and report it; the results as written to ``folder``.

    What was ``expected`` of its run time is kept beside what it took.
    """
    started, clock, cost = datetime.now(UTC), perf_counter(), Cost(workers, expected)
    with cost.phase("simulating"):
        records = _simulated(laid, folder, workers, time_limit, progress, cost)
    timings: dict[Key, Timing | str] = {}
    if with_timing:
        with cost.phase("timing"):
            timings = _timed(laid, records, time_limit, progress, cost)
    seconds = {key: timing.as_row() for key, timing in timings.items() if isinstance(timing, Timing)}
    noted = [*laid.notes, *_quality({k: t for k, t in timings.items() if isinstance(t, Timing)})]
    noted += not_to_time(laid) if with_timing else []
    untimed = [
        f"{scene} in {engine} {scheme} at dt {dt:g} s: not timed, {reason}"
        for (scene, engine, scheme, dt), reason in timings.items()
        if isinstance(reason, str)
    ]
    beyond: list[dict[str, Any]] = []
    if laid.extent is Extent.FULL:
        sound = {key: timing for key, timing in timings.items() if isinstance(timing, Timing)}
        with cost.phase("steps beyond the ladders"):
            beyond, missing = precision.beyond(laid, sound, workers, time_limit, progress)
        noted += missing
    facts = environment() | {
        "command": command,
        "whole": laid.whole,
        "started": started.isoformat(timespec="seconds"),
        "workers": workers,
        "seconds": round(perf_counter() - clock, 1),
    }
    found = report(folder, records, seconds, facts, [*noted, *untimed], workers, beyond, cost, progress)
    cost.write(folder)
    return found


def report(
    folder: Path,
    records: Sequence[CellRecord],
    seconds: Mapping[Key, Mapping[str, Any]],
    facts: Mapping[str, Any],
    notes: Sequence[str],
    workers: int,
    beyond: Sequence[Mapping[str, Any]] = (),
    cost: Cost | None = None,
    progress: Progress = lambda phase, done, of: None,
) -> dict[str, Any]:
    """Judge the logs of ``folder`` and write every page; needs no engine.

    ``beyond`` are rows of error against run time that have no log, and are not judged. To ``cost`` is
    added what this takes.

    Raises ``CorruptLog`` for a log that is not what was written.
    """
    from .reports import pages  # jinja2 and plotly load only when there is something to show

    cost = cost or Cost(workers)
    with cost.phase("judging"):
        came = judged(folder, records, seconds, workers, partial(progress, "judging"))
    cost.judging = came.spent
    stale = (
        deviations.unmatched(came.verdicts, deviations.recorded(), came.partly) if facts.get("whole") else []
    )
    found = results.results(
        records,
        came.verdicts,
        [*came.rows, *beyond],
        all_scenes(),
        facts,
        list(dict.fromkeys([*notes, *came.notes])),
        stale,
        came.localised,
    )
    with cost.phase("report"):
        pages.write(folder, found, came.pictures)
    return found


def again(folder: Path, workers: int = 1) -> dict[str, Any]:
    """Judge and report the logs of an earlier run once more.

    What left no log, and the run times, are taken from its ``results.json``. Raises ``InputError``
    if there is no run in ``folder``, ``CorruptLog`` or ``ResultsError`` if it is damaged.
    """
    logs = sorted((folder / LOGS).glob("*.mcap")) if folder.is_dir() else []
    earlier = folder / "results.json"
    if not logs and not earlier.is_file():
        raise InputError(
            f"report: got {folder}, which holds no run; expected a folder that `poinsot run` wrote"
        )
    if earlier.is_file():
        found = results.read(earlier)
        return report(
            folder,
            results.records_of(found),
            results.timings_of(found),
            found["environment"],
            found["notes"],
            workers,
            [row for row in found["work_precision"] if not row.get("judged", True)],
        )
    records = [_record_of(path) for path in logs]
    return report(
        folder, records, {}, environment(), ["There was no results.json: run times are not known."], workers
    )


def _simulated(
    laid: Plan, folder: Path, workers: int, time_limit: float, progress: Progress, cost: Cost
) -> list[CellRecord]:
    done = 0

    def count(outcome: runner.Outcome) -> None:
        nonlocal done
        done += 1
        progress("simulating", done, len(laid.requests))

    outcomes = {o.request: o for o in runner.run(in_turn(laid), folder / LOGS, workers, time_limit, count)}
    cost.outcomes = [outcomes[request] for request in laid.requests.values()]
    return [_with_outcome(record, laid, outcomes, folder) for record in laid.records]


def _with_outcome(
    record: CellRecord, laid: Plan, outcomes: Mapping[Request, runner.Outcome], folder: Path
) -> CellRecord:
    if record.key not in laid.requests:
        return record
    outcome = outcomes[laid.requests[record.key]]
    if outcome.log is None:
        return replace(record, status=Status.ERROR, message=outcome.error)
    size = (folder / LOGS / outcome.log).stat().st_size
    return replace(record, log=f"{LOGS}/{outcome.log}", log_bytes=size, memory=outcome.memory)


def _timed(
    laid: Plan, records: Sequence[CellRecord], time_limit: float, progress: Progress, cost: Cost
) -> dict[Key, Timing | str]:
    """Time cells that ran, as ``to_time`` chooses; other steps of their schemes take their time a step."""
    sound = [record for record in records if record.log]
    requests = {laid.requests[record.key]: record.key for record in to_time(laid, sound)}
    cost.timed, done = frozenset(requests), 0

    def count(request: Request) -> None:
        nonlocal done
        done += 1
        progress("timing", done, len(requests))

    timings = {
        requests[request]: timing
        for request, timing in runner.time(list(requests), time_limit, count).items()
    }
    # Where the machine was slow for as long as a cell was timed, its repeats agree and are all too long.
    slow = _slow({key: timing for key, timing in timings.items() if isinstance(timing, Timing)})
    for request, again in runner.time([laid.requests[key] for key in slow], time_limit).items():
        if isinstance(again, Timing):
            timings[requests[request]] = min(slow[requests[request]], again, key=lambda timing: timing.each)
    by_scheme = {key[:3]: timing for key, timing in timings.items() if isinstance(timing, Timing)}
    scaled = {r.key: by_scheme[r.key[:3]].of(r.steps) for r in sound if r.key[:3] in by_scheme}
    return scaled | timings


def _slow(timings: Mapping[Key, Timing]) -> dict[Key, Timing]:
    """Timings of a longer step than the middle one of their scheme in their scene, where all are alike.

    Where bodies touch they are not: steps with contact and without take different times.
    """
    ladders = defaultdict[tuple[str, str, str], list[float]](list)
    for key, timing in timings.items():
        ladders[key[:3]].append(timing.each)
    return {
        key: timing
        for key, timing in timings.items()
        if timing.each > (1 + SPREAD) * median(ladders[key[:3]]) and not all_scenes()[key[0]].contacts
    }


def _quality(timings: Mapping[Key, Timing]) -> list[str]:
    """How far the timings can be trusted, in sentences: those that were taken, not those scaled from them."""
    taken = {key: timing for key, timing in timings.items() if not timing.scaled}
    if not taken:
        return []
    loose = [key for key, timing in taken.items() if timing.spread > SPREAD]
    beats = [timing.beat for timing in taken.values()]
    said = [
        f"Timing: beside the cells, a fixed piece of work took {min(beats) * 1e3:.3g} to "
        f"{max(beats) * 1e3:.3g} ms, so fast was the machine; "
        + (
            f"of {len(taken)} cells, {len(loose)} spread by more than {SPREAD:.0%}, repeated or not: "
            f"{_named(loose)}."
            if loose
            else f"no cell's middle repeat took over {SPREAD:.0%} longer than its fastest."
        )
    ]
    if slow := list(_slow(taken)):
        said.append(
            f"Timing: in {len(slow)} of {len(taken)} cells a step took over {SPREAD:.0%} longer than the "
            f"middle one of its scheme in its scene, timed again or not: {_named(slow)}."
        )
    if not all(timing.pinned for timing in taken.values()):
        said.append("Loose timing: this system keeps no process on one core, so that times spread more.")
    if runner.cores() == 1:
        said.append("Loose timing: there is one core, which whatever else runs here shares.")
    return said


def _named(keys: Sequence[Key]) -> str:
    """Cells, some of them by name."""
    return listed(
        (f"{scene} in {engine} {scheme} at dt {dt:.3g} s" for scene, engine, scheme, dt in keys), NAMED
    )


def _record_of(path: Path) -> CellRecord:
    p = log.read(path).trajectory.provenance
    if p is None:
        raise InputError(f"{path.name}: got a log without provenance, expected one that `poinsot run` wrote")
    return CellRecord(
        p.scene, p.engine, p.engine_version, p.scheme, p.twin, p.order, p.dt, p.steps,
        log=f"{LOGS}/{path.name}", settings=p.settings, log_bytes=path.stat().st_size,
    )  # fmt: skip
