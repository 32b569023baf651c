"""The outcome of a run as plain data: what ``results.json`` holds and every page is made of."""

import math
from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from ..scenarios.observables import Observable
from ..scenarios.scene import Scene
from . import stored
from .cell import Cell
from .cheapest import cheapest
from .common_causes import Localisation, grouped
from .fitted import fitted
from .verdict import Ladder, Status, Verdict

SCHEMA = "poinsot.results/1"
#: From the gravest to the best: a cell is as good as its worst verdict.
GRAVITY = (
    Status.ERROR,
    Status.FAIL,
    Status.FIXED,
    Status.UNAVAILABLE,
    Status.UNSUPPORTED,
    Status.KNOWN,
    Status.PASS,
)

#: What a row of ``work_precision`` says of time.
TIMES = (
    "seconds_min", "seconds_median", "repeats", "timed_steps", "us_per_step", "spread", "us_per_call",
    "own_loop", "scaled",
)  # fmt: skip
#: The same where no time was taken.
UNTIMED: Mapping[str, Any] = dict.fromkeys(TIMES) | {"repeats": 0, "timed_steps": 0, "scaled": False}
#: What a row of ``work_precision`` says of a motion.
FOUND = ("error", "error_final", "round_off", "error_rms", "fitted", "uncertainty", "exact")

Key = tuple[str, str, str, float]


@dataclass(frozen=True)
class CellRecord:
    """One cell of a run, whether it left a log or not: ``status`` is set only where it did not.

    ``log_bytes`` is the size of its log, ``memory`` [bytes] the most that its process held at once.
    """

    scene: str
    engine: str
    engine_version: str
    scheme: str
    twin: str
    order: int
    dt: float
    steps: int
    log: str | None = None
    status: Status | None = None
    message: str = ""
    settings: Mapping[str, str] = field(default_factory=dict)
    log_bytes: int | None = None
    memory: int | None = None

    @property
    def key(self) -> Key:
        """What tells this cell from the others of its run."""
        return (self.scene, self.engine, self.scheme, self.dt)


def results(
    records: Sequence[CellRecord],
    verdicts: Iterable[Verdict],
    work_precision: Sequence[Mapping[str, Any]],
    scenes: Mapping[str, Scene],
    environment: Mapping[str, Any],
    notes: Sequence[str],
    stale: Sequence[str] = (),
    localised: Sequence[Localisation] = (),
) -> dict[str, Any]:
    """Everything about a run as a dictionary of plain values, stable in its order.

    ``stale`` are sentences on recorded deviations that match no check of a whole run, ``localised`` what
    most likely is wrong where checks fail.
    """
    likely = {one.ladder: one.sentence for one in localised}
    by_cell: dict[Key, list[Verdict]] = defaultdict(list)
    for verdict in verdicts:
        by_cell[(verdict.scene, verdict.engine, verdict.scheme, verdict.dt)].append(verdict)
    names = dict.fromkeys(record.scene for record in records)
    return {
        "schema": SCHEMA,
        "environment": dict(environment),
        "scenes": {name: _described(scenes[name]) for name in names},
        "cells": [_cell(record, by_cell[record.key], likely) for record in records],
        "likely_causes": grouped(localised),
        "work_precision": [dict(row) for row in work_precision],
        "cheapest": cheapest(work_precision),
        "notes": list(notes),
        "stale_deviations": list(stale),
    }


def cells(records: Iterable[CellRecord]) -> list[dict[str, Any]]:
    """The cells of results.json before anything was judged."""
    return [_cell(record, (), {}) for record in records]


def precision_rows(cells: Iterable[Cell], seconds: Mapping[Key, Mapping[str, Any]]) -> list[dict[str, Any]]:
    """Error against run time: one row a cell and observable; times are null where none was taken."""
    rows = []
    for cell in cells:
        p = cell.provenance
        time = seconds.get((p.scene, p.engine, p.scheme, p.dt), UNTIMED)
        for observable in cell.scene.observables:
            if observable.kind != "invariant":
                rows.append(with_time(_row(cell, observable), time))  # noqa: PERF401 (two loops read better than one)
    return rows


def broken_rows(
    scene: Scene, engine: str, version: str, scheme: str, dt: float, message: str
) -> list[dict[str, Any]]:
    """Rows of a cell that came to no motion, as ``precision_rows`` has them; ``message`` tells why."""
    cell = {"scene": scene.full_name, "engine": engine, "engine_version": version, "scheme": scheme, "dt": dt}
    cell |= {"steps": scene.samples * scene.steps_per_sample(dt), "samples": scene.samples}
    return [
        with_time(
            {
                **cell,
                "observable": observable.name,
                "unit": observable.unit,
                **dict.fromkeys(FOUND),
                "judged": False,
                "message": message,
            },
            UNTIMED,
        )
        for observable in scene.observables
        if observable.kind != "invariant"
    ]


def with_time(row: Mapping[str, Any], time: Mapping[str, Any]) -> dict[str, Any]:
    """A row with its times, and what follows from them.

    Steps a second, seconds of motion to a second of run time, and the error (largest, in the row's ``unit``)
    that is made in each µs of run time.
    """
    steps, seconds, error = row["steps"], time["seconds_min"], row["error"]
    return {
        **row,
        **time,
        "steps_per_second": steps / seconds if seconds else None,
        "real_time": steps * row["dt"] / seconds if seconds else None,
        "error_per_us": error / (seconds * 1e6) if seconds and error is not None else None,
    }


def read(path: Path) -> dict[str, Any]:
    """Read results; raises ``ResultsError`` if the file is not a run's, of the schema known here."""
    return stored.read(path, SCHEMA, "a run")


def records_of(found: Mapping[str, Any]) -> list[CellRecord]:
    """The cells that results speak of, without their verdicts."""
    return [
        CellRecord(
            scene=cell["scene"],
            engine=cell["engine"],
            engine_version=cell["engine_version"],
            scheme=cell["scheme"],
            twin=cell["twin"],
            order=cell["order"],
            dt=cell["dt"],
            steps=cell["steps"],
            log=cell["log"],
            status=None if cell["log"] else Status(cell["status"]),
            message=cell["message"],
            settings=cell["settings"],
            log_bytes=cell.get("log_bytes"),
            memory=cell.get("memory_bytes"),
        )
        for cell in found["cells"]
    ]


def timings_of(found: Mapping[str, Any]) -> dict[Key, dict[str, Any]]:
    """The run times that results hold, by cell."""
    return {
        (row["scene"], row["engine"], row["scheme"], row["dt"]): {name: row.get(name) for name in TIMES}
        for row in found["work_precision"]
        if row["seconds_min"] is not None
    }


def worst(statuses: Iterable[Status]) -> Status:
    """The gravest of several statuses; a pass if there is none."""
    return min(statuses, key=GRAVITY.index, default=Status.PASS)


def exit_code(found: Mapping[str, Any]) -> int:
    """What a run ends with: 3 if an engine crashed, else 1 if a check fails or a record is stale, else 0."""
    statuses = {Status(cell["status"]) for cell in found["cells"]}
    if Status.ERROR in statuses:
        return 3
    return 1 if statuses & {Status.FAIL, Status.FIXED} or found["stale_deviations"] else 0


def _row(cell: Cell, observable: Observable) -> dict[str, Any]:
    p, distances = cell.provenance, cell.distance(observable)
    rate = fitted(cell, observable)
    return {
        "scene": p.scene,
        "engine": p.engine,
        "engine_version": p.engine_version,
        "scheme": p.scheme,
        "dt": p.dt,
        "steps": p.steps,
        "samples": cell.scene.samples,
        "observable": observable.name,
        "unit": observable.unit,
        "error": _finite(float(distances.max())),
        "error_final": _finite(float(distances[-1])),
        "round_off": _finite(cell.round_off(observable)),
        "error_rms": _finite(float(np.sqrt(np.mean(distances**2)))),
        "fitted": _finite(rate.value) if rate else None,
        "uncertainty": _finite(rate.uncertainty) if rate and rate.uncertainty is not None else None,
        "exact": _finite(rate.exact) if rate else None,
        "judged": True,
        "message": "",
    }


def _cell(record: CellRecord, verdicts: Sequence[Verdict], likely: Mapping[Ladder, str]) -> dict[str, Any]:
    status = record.status or worst(verdict.status for verdict in verdicts)
    ladder = (record.scene, record.engine, record.engine_version, record.scheme)
    return {
        "scene": record.scene,
        "engine": record.engine,
        "engine_version": record.engine_version,
        "scheme": record.scheme,
        "twin": record.twin,
        "order": record.order,
        "dt": record.dt,
        "steps": record.steps,
        "status": status.value,
        "log": record.log,
        "message": record.message,
        "likely_cause": likely.get(ladder, "") if status is Status.FAIL else "",
        "settings": dict(record.settings),
        "log_bytes": record.log_bytes,
        "memory_bytes": record.memory,
        "verdicts": [_verdict(verdict) for verdict in verdicts],
    }


def _verdict(verdict: Verdict) -> dict[str, Any]:
    return {
        "check": verdict.check,
        "observable": verdict.observable,
        "status": verdict.status.value,
        "measured": _finite(verdict.measured),
        "allowed": _finite(verdict.allowed),
        "unit": verdict.unit,
        "at": verdict.at,
        "message": verdict.message,
    }


def _described(scene: Scene) -> dict[str, Any]:
    return {
        "summary": scene.summary,
        "source": scene.source,
        "features": sorted(scene.features),
        "left_out": list(scene.left_out),
        "duration": scene.duration,
        "dt": scene.dt,
        "samples": scene.samples,
    }


def _finite(value: float | None) -> float | None:
    """JSON has no infinity; the sentence beside the number says what happened."""
    return value if value is not None and math.isfinite(value) else None
