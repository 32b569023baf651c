"""Run every wrong engine there is, and publish how many are caught, by which check, and down to what size.

    python benchmarks/discernment.py                   print the score
    python benchmarks/discernment.py --publish         write reports/published/DISCERNMENT.md
    python benchmarks/discernment.py --check           hold that page against a new run; 1 if it differs
    python benchmarks/discernment.py --only NAME ...   of the wrong engines of these names alone

The wrong engines are those of tests/catalogue/wrong_engines. Each is run over the ladder of steps on the
scenes where it is meant to be seen, and judged by the harness's own functions, with no deviation on record.
Caught means that a check fails or the run is refused, and that no right engine beside it is accused.
Takes some minutes.
"""

import argparse
import multiprocessing
import re
import sys
from collections import Counter, defaultdict
from concurrent.futures import ProcessPoolExecutor
from math import sqrt
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests" / "catalogue"))

from poinsot.adapters.runner import cores
from poinsot.reports.cell import Cell
from poinsot.reports.localisation import NOT_FOUND, localised
from poinsot.reports.verdict import CHECKS
from poinsot.scenarios.registry import scenes
from wrong_engines import CATALOGUE, FAMILIES
from wrong_engines.trial import RIGHT, ladder, tried

PAGE = ROOT / "reports" / "published" / "DISCERNMENT.md"
#: Smallest size tried, and how finely the limit is sought.
NOTHING, FACTOR = 1e-16, 1.2
#: Sizes that differ by less than this are the same: versions and machines round otherwise.
SAME = 2.0
NOT_CAUGHT = "**nothing**"


class Row(NamedTuple):
    """A wrong engine: the kinds of check that caught it, where, and what was said of it."""

    name: str
    kind: str
    size: str
    caught: tuple[str, ...]
    scene: str
    said: str
    named: bool


class Limit(NamedTuple):
    """The smallest size of a fault that is caught, and what catches it there."""

    what: str
    smallest: float
    caught: tuple[str, ...]
    scene: str


def kinds(found):
    """Kinds of check that caught an engine, in the order of the list of checks; none if one was accused."""
    if any(not v.status.conforms for v in found.others):
        return ()
    if found.refused:
        return ("refused",)
    failed = {v.check for v in found.own if not v.status.conforms}
    return tuple(check for check in CHECKS if check in failed)


def looked_at(wrong):
    """The row of a wrong engine, over all scenes where it is meant to be seen."""
    everywhere, said = [], ""
    for sight in wrong.sights:
        found = tried(wrong.engine, sight)
        everywhere.append((kinds(found), sight.scene))
        said = said or _sentence(wrong, sight, found)
    caught = [check for check in (*CHECKS, "refused") if any(check in by for by, _ in everywhere)]
    places = dict.fromkeys(scene for by, scene in everywhere if by)
    size = "" if wrong.size is None else f"{wrong.size:g}"
    named = bool(wrong.located and re.search(wrong.located, said))
    return Row(wrong.name, wrong.kind, size, tuple(caught), ", ".join(places), said, named)


def _sentence(wrong, sight, found):
    """What the report says is wrong."""
    if found.refused:
        return found.refused
    cells = [Cell.of(run, scenes()) for run in ladder(wrong.engine, sight.scene, sight.twin)]
    return "; ".join(one.sentence for one in localised(cells, found.own))


def smallest(family):
    """The smallest size of a fault that is caught, to a factor of 1.2."""
    high, low, caught = family.largest, NOTHING, kinds(tried(family.of_size(family.largest), family.sight))
    while caught and high / low > FACTOR:
        middle = sqrt(low * high)
        found = kinds(tried(family.of_size(middle), family.sight))
        if found:
            high, caught = middle, found
        else:
            low = middle
    return Limit(family.what, high if caught else float("inf"), caught, family.sight.scene)


def one(task):
    """A row or a limit, by what it is of."""
    what, name = task
    if what == "row":
        return looked_at(CATALOGUE[name])
    return smallest(next(family for family in FAMILIES if family.what == name))


def run(names, families, workers):
    """Rows and limits, those of one scene in one process: what right engines did there is known then."""
    by_scene = defaultdict(list)
    for name in names:
        by_scene[CATALOGUE[name].sights[0].scene].append(("row", name))
    tasks = [task for scene in by_scene for task in by_scene[scene]]
    tasks += [("limit", family.what) for family in FAMILIES if family.what in families]
    if workers == 1:
        found = list(map(one, tasks))
    else:
        with ProcessPoolExecutor(workers, multiprocessing.get_context("spawn")) as pool:
            found = list(pool.map(one, tasks, chunksize=4))
    rows = {row.name: row for row in found if isinstance(row, Row)}
    limits = {limit.what: limit for limit in found if isinstance(limit, Limit)}
    return [rows[name] for name in names], [limits[f.what] for f in FAMILIES if f.what in limits]


def score(rows):
    """The score in a sentence."""
    caught, named = sum(bool(row.caught) for row in rows), sum(row.named for row in rows)
    return f"caught {caught} of {len(rows)}, named {named} of {len(rows)}"


def page(rows, limits):
    """The published page."""
    survivors = [row for row in rows if not row.caught]
    twins = [row for row in rows if row.caught == ("twin",)]
    astray = [row for row in rows if not row.named and row.said and not row.said.startswith(NOT_FOUND)]
    count = Counter(check for row in rows for check in row.caught)
    versions = ", ".join(f"{engine.name} {engine.version()}" for engine in RIGHT)
    lines = [
        "# What Poinsot can tell apart",
        "",
        "`python benchmarks/discernment.py --publish` writes this page, and `--check` holds it against a",
        f"new run. Engines: {versions}.",
        "",
        f"**Mutation score: {score(rows)}.**",
        "",
        "Each wrong engine is a few lines around a real one, wrong in one known way. Unless its name says",
        "that it is read back, it repeats what the scene asked for as its setup, so that only its motion or",
        "its accelerations give it away. Caught means that a check fails, or that the run is refused, while",
        "no right engine judged beside it is accused. Named means that the sentence about what is wrong is",
        "the right one.",
        "",
        "Caught by each kind of check: "
        + ", ".join(f"{check} {count[check]}" for check in (*CHECKS, "refused") if count[check])
        + ".",
        "",
        f"Seen only beside another engine that runs the same scheme: {_listed(twins)}.",
        "",
        f"Survivors: {_listed(survivors)}.",
        "",
        f"Given a sentence that is not the one expected: {_listed(astray)}.",
        "",
        "## What cannot be caught",
        "",
        "- An engine that runs another, right one under its own name: nothing is wrong with its answers.",
        "- The whole inertia of a body that nothing turns: it moves as before. A scene with a torque tells.",
        "- The motion of a first-order scheme wrong by less than that scheme's own error, without a second",
        "  engine, a closed form of the scheme or a wrong limit at dt = 0: those are the ones listed as seen",
        "  beside another engine only.",
        "- Anything smaller than below.",
        "",
        "## The smallest fault that is caught",
        "",
        f"By halving, to a factor of {FACTOR}, on the cheapest scene, with no other engine beside it. Sizes",
        "are parts of the right value unless a unit is given.",
        "",
        "| fault | smallest size | caught by | scene |",
        "|---|---|---|---|",
        *(f"| {x.what} | {x.smallest:.1e} | {', '.join(x.caught)} | {x.scene} |" for x in limits),
        "",
        "## Every wrong engine",
        "",
        "| wrong engine | kind | size | caught by | scene | what is said of it |",
        "|---|---|---|---|---|---|",
        *(f"| {r.name} | {r.kind} | {r.size} | {_caught(r)} | {r.scene} | {r.said} |" for r in rows),
    ]
    return "\n".join(lines) + "\n"


def _caught(row):
    return ", ".join(row.caught) or NOT_CAUGHT


def _listed(rows):
    return "; ".join(row.name for row in rows) or "none"


def published(text):
    """What a page says: by name whether each engine is caught, and the smallest size of each fault."""
    limits, rows = text.split("## The smallest fault")[1].split("## Every wrong engine")
    return (
        {row[0]: row[3] != NOT_CAUGHT for row in _table(rows)},
        {row[0]: float(row[1]) for row in _table(limits)},
    )


def _table(text):
    """The rows of a table, without its head."""
    lines = [line.strip("| ").split(" | ") for line in text.splitlines() if line.startswith("| ")]
    return [[cell.strip() for cell in line] for line in lines[1:]]


def differences(text, rows, limits, whole=True):
    """How a page differs from a run, in sentences."""
    caught, sizes = published(text)
    for row in rows:
        if row.name not in caught:
            yield f"{row.name}: not on the page"
        elif caught[row.name] != bool(row.caught):
            yield f"{row.name}: {'not ' if caught[row.name] else ''}caught now"
    for limit in limits:
        was = sizes.get(limit.what, 0.0)
        if not was / SAME <= limit.smallest <= was * SAME:
            yield f"{limit.what}: smallest size {limit.smallest:.2g}, on the page {was:.2g}"
    if whole:
        for name in caught.keys() - {row.name for row in rows}:
            yield f"{name}: on the page, and no longer in the catalogue"
        for what in sizes.keys() - {limit.what for limit in limits}:
            yield f"{what}: on the page, and no longer in the catalogue"


def main(arguments=None):
    """Run, print, and write or compare the page."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--publish", action="store_true")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--only", nargs="+", default=[])
    parser.add_argument("--workers", type=int, default=cores())
    asked = parser.parse_args(arguments)
    names = asked.only or list(CATALOGUE)
    families = {CATALOGUE[name].family.what for name in names if CATALOGUE[name].family}
    rows, limits = run(names, families, asked.workers)
    for row in rows:
        print(f"{', '.join(row.caught) or 'SURVIVES':40s} {row.name}: {row.said}")
    for limit in limits:
        print(f"{limit.smallest:8.1e} {limit.what}: {', '.join(limit.caught)}")
    print(score(rows))
    if asked.publish:
        PAGE.parent.mkdir(exist_ok=True)
        PAGE.write_text(page(rows, limits), encoding="utf-8")
    if asked.check:
        found = list(differences(PAGE.read_text(encoding="utf-8"), rows, limits, whole=not asked.only))
        print("\n".join(found) or "the page agrees")
        return 1 if found else 0
    return 0


if __name__ == "__main__":
    sys.exit(main())
