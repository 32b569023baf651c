"""The results of a run as rows (scenes), columns (schemes) and what is found where they meet."""

import math
import re
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from ..reference.errors import InputError
from .results import GRAVITY, SCHEMA
from .verdict import Status
from .wording import count, listed

#: A part of results.json: a cell, a verdict, a scene's own words.
Record = Mapping[str, Any]

#: What the headline names scheme by scheme and scene by scene.
_WRONG = (Status.ERROR, Status.FAIL, Status.FIXED)


def gravest(statuses: Collection[Status]) -> Status:
    """The worst of several statuses, where what could not be looked at does not outweigh a pass."""
    shown = set(statuses) - {Status.UNSUPPORTED} if Status.PASS in statuses else statuses
    return min(shown, key=GRAVITY.index)


@dataclass(frozen=True)
class Column:
    """A scheme of an engine. ``place`` counts engines, then the schemes of this one, from 0."""

    engine: str
    version: str
    scheme: str
    twin: str
    order: int | None
    label: str
    place: tuple[int, int]


@dataclass(frozen=True, eq=False)
class Group:
    """One scene in one scheme: its cells, from the coarsest step to the finest.

    ``main`` is the cell at the scene's own step, the one whose verdicts are shown first.
    """

    scene: str
    column: Column
    cells: tuple[Record, ...]
    main: Record

    @cached_property
    def statuses(self) -> frozenset[Status]:
        """Every status that a cell or a verdict of it has."""
        return frozenset(Status(part["status"]) for cell in self.cells for part in (cell, *cell["verdicts"]))

    @cached_property
    def status(self) -> Status:
        """The worst status; checks that could not be made do not hide the passes of the others."""
        return gravest(self.statuses)

    @property
    def partial(self) -> bool:
        """Whether it passes, but for checks that could not be made."""
        return self.status is Status.PASS and Status.UNSUPPORTED in self.statuses

    @cached_property
    def messages(self) -> dict[tuple[Status, str], list[float]]:
        """What the cells themselves say, and at which steps."""
        found: dict[tuple[Status, str], list[float]] = {}
        for cell in self.cells:
            if cell["message"]:
                found.setdefault((Status(cell["status"]), cell["message"]), []).append(cell["dt"])
        return found

    @property
    def others(self) -> tuple[Record, ...]:
        """The cells at every step but the main one."""
        return tuple(cell for cell in self.cells if cell is not self.main)

    @property
    def anchor(self) -> str:
        """Where the report speaks of this group: an HTML id."""
        return re.sub(r"\s", "_", f"{self.scene}/{self.column.label}")

    @property
    def name(self) -> str:
        """For sentences: scheme on scene."""
        return f"{self.column.label} on {self.scene}"

    @cached_property
    def told(self) -> str:
        """How many cells and checks there were, and how those ended."""
        found = [Status(verdict["status"]) for cell in self.cells for verdict in cell["verdicts"]]
        counts = [f"{found.count(status)} {status.value}" for status in GRAVITY if status in found]
        checks = f", {count(len(found), 'check')}: {', '.join(counts)}" if found else ""
        return count(len(self.cells), "cell") + checks

    @cached_property
    def closest(self) -> tuple[float, str] | None:
        """How much of its allowance the main cell's tightest check used, and which check that is."""
        shares = [
            (verdict["measured"] / verdict["allowed"], f"{verdict['check']} of {verdict['observable']}")
            for verdict in self.main["verdicts"]
            # An order is not better for being smaller: its share of what is allowed says nothing.
            if verdict["check"] != "order" and verdict["measured"] and verdict["allowed"]
        ]
        return max(shares, default=None)


class Digest:
    """What ``results`` (the content of results.json) holds, in the order of every report.

    Scenes keep their order; schemes stand engine by engine, in the order in which the cells first
    name them. Raises ``InputError`` if ``results`` has another schema than this version writes.
    """

    def __init__(self, results: Record) -> None:
        if results.get("schema") != SCHEMA:
            raise InputError(f"results: got schema {results.get('schema')!r}, expected {SCHEMA!r}")
        self.cells: tuple[Record, ...] = tuple(results["cells"])
        self.command, self.started, self.seconds, self.facts = _facts(results["environment"])
        # Results of an earlier version say nothing of causes.
        self.likely_causes: tuple[Record, ...] = tuple(results.get("likely_causes", ()))
        self.notes: tuple[str, ...] = tuple(results["notes"])
        self.work_precision: tuple[Record, ...] = tuple(results["work_precision"])
        # A scene that only the cells know is shown too, without words of its own.
        self.scenes: dict[str, Record] = dict(results["scenes"])
        for cell in self.cells:
            self.scenes.setdefault(cell["scene"], {})
        self.columns = columns(self.cells)
        self.groups = self._grouped()

    def _grouped(self) -> dict[tuple[str, Column], Group]:
        """Every scene in every scheme that it was run in, row by row."""
        named = {(column.engine, column.version, column.scheme): column for column in self.columns}
        cells: dict[tuple[str, Column], list[Record]] = {}
        for cell in self.cells:
            cells.setdefault((cell["scene"], named[_scheme_of(cell)]), []).append(cell)
        places = [(scene, column) for scene in self.scenes for column in self.columns]
        return {place: _group(*place, cells[place], self.scenes) for place in places if place in cells}

    def row(self, scene: str) -> list[Group | None]:
        """What each column holds for a scene; ``None`` where it was not run."""
        return [self.groups.get((scene, column)) for column in self.columns]

    @cached_property
    def engines(self) -> dict[str, list[Column]]:
        """Columns by engine, in order."""
        result: dict[str, list[Column]] = {}
        for column in self.columns:
            result.setdefault(column.engine, []).append(column)
        return result

    def named(self, columns: Collection[Column]) -> str:
        """``columns`` in words; an engine all of whose schemes are among them stands for itself."""
        words = []
        for engine, every in self.engines.items():
            mine = [column for column in every if column in columns]
            whole = mine == every and len(every) > 1
            words += [f"{engine} (every scheme)"] if whole else [column.label for column in mine]
        return ", ".join(words)

    @cached_property
    def counts(self) -> dict[Status, int]:
        """How many cells have each status, best first; those that none has are left out."""
        found = [Status(cell["status"]) for cell in self.cells]
        return {status: found.count(status) for status in reversed(GRAVITY) if status in found}

    @property
    def conforms(self) -> bool:
        """Whether every cell may stay as it is."""
        return all(status.conforms for status in self.counts)

    @property
    def headline(self) -> str:
        """The run in one sentence: whether it conforms, how many cells pass, and what does not."""
        if not self.cells:
            return "Nothing was run: there are no cells to judge."
        verdict = "The run conforms" if self.conforms else "The run does not conform"
        passed, total = self.counts.get(Status.PASS, 0), count(len(self.cells), "cell")
        share = f"all {total} pass" if passed == len(self.cells) else f"{passed} of {total} pass"
        wrong = [group for group in self.groups.values() if group.status in _WRONG]
        wrong.sort(key=lambda group: GRAVITY.index(group.status))
        named = (
            [f"{listed(group.name for group in wrong)} {'does' if len(wrong) == 1 else 'do'} not"]
            if wrong
            else []
        )
        return "; ".join([f"{verdict}: {share}", *named, *self._absent()]) + "."

    def _absent(self) -> list[str]:
        gone = dict.fromkeys(c["engine"] for c in self.cells if c["status"] == Status.UNAVAILABLE.value)
        return [f"{listed(gone)} {'is' if len(gone) == 1 else 'are'} not installed"] if gone else []


def _facts(environment: Record) -> tuple[str, str, float, dict[str, Any]]:
    """Command, start, seconds, and everything else the environment says; versions of engines too."""
    rest = dict(environment)
    command, started = str(rest.pop("command", "")), str(rest.pop("started", ""))
    seconds, engines = float(rest.pop("seconds", 0.0)), rest.pop("engines", {})
    return command, started, seconds, {**rest, **engines}


def _scheme_of(cell: Record) -> tuple[str, str, str]:
    return cell["engine"], cell["engine_version"] or "", cell["scheme"]


def columns(cells: Iterable[Record]) -> tuple[Column, ...]:
    """What the cells of results.json were run in, engine by engine, in the order in which they name them."""
    by_engine: dict[str, dict[tuple[str, str, str], Record]] = {}
    for cell in cells:
        by_engine.setdefault(cell["engine"], {}).setdefault(_scheme_of(cell), cell)
    result = []
    for nth, schemes in enumerate(by_engine.values()):
        several = len({version for _, version, _ in schemes}) > 1
        for mth, ((engine, version, scheme), cell) in enumerate(schemes.items()):
            label = f"{engine} {version} {scheme}" if several else f"{engine} {scheme}"
            result.append(Column(engine, version, scheme, cell["twin"], cell["order"], label, (nth, mth)))
    return tuple(result)


def _group(scene: str, column: Column, cells: list[Record], scenes: Mapping[str, Record]) -> Group:
    ordered = tuple(sorted(cells, key=lambda cell: -float(cell["dt"])))
    return Group(scene, column, ordered, _main(ordered, scenes[scene].get("dt")))


def _main(cells: tuple[Record, ...], dt: float | None) -> Record:
    """The cell nearest to the scene's own step; where that is not said, the one most was asked of."""
    if dt is not None:
        return min(cells, key=lambda cell: abs(math.log(cell["dt"] / dt)))
    return max(cells, key=lambda cell: (len(cell["verdicts"]), -cell["dt"]))
