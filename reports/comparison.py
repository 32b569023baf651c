"""What changed between two runs: verdicts, errors, orders, versions; times only on one machine."""

from collections import defaultdict
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from statistics import median
from typing import Any

import numpy as np

from . import order
from .results import GRAVITY
from .verdict import Status

#: An error that differs by more than this part is another: an engine that did not change repeats its bits.
SAME = 0.01
#: A run time that differs by less than this part may be the machine's doing.
NOISE = 0.1

Results = Mapping[str, Any]
_Cell = tuple[str, str, str, float]


@dataclass(frozen=True)
class Comparison:
    """Two runs side by side, in sentences.

    ``versions`` that differ, ``worse`` and ``better`` verdicts, cells only in one run (``gone``,
    ``added``), ``orders``, ``errors`` and ``times`` that changed; ``notes`` say what could not be compared.
    """

    versions: tuple[str, ...]
    worse: tuple[str, ...]
    better: tuple[str, ...]
    gone: tuple[str, ...]
    added: tuple[str, ...]
    orders: tuple[str, ...]
    errors: tuple[str, ...]
    times: tuple[str, ...]
    notes: tuple[str, ...]

    @property
    def same(self) -> bool:
        """Whether nothing got worse, went missing or has another order or error."""
        return not (self.worse or self.gone or self.orders or self.errors)


def compared(old: Results, new: Results) -> Comparison:
    """Hold two ``results.json`` against each other, cell by cell: scene, engine, scheme and step."""
    before, after = _cells(old), _cells(new)
    common = [key for key in before if key in after]
    changes = [change for key in common for change in _changed(key, before[key], after[key])]
    times, notes = _times(old, new)
    return Comparison(
        versions=tuple(_versions(old, new)),
        worse=tuple(text for gravity, text in changes if gravity < 0),
        better=tuple(text for gravity, text in changes if gravity > 0),
        gone=tuple(_place(key) for key in before if key not in after),
        added=tuple(_place(key) for key in after if key not in before),
        orders=tuple(_orders(old, new)),
        errors=tuple(_errors(old, new)),
        times=tuple(times),
        notes=tuple(notes),
    )


def as_text(found: Comparison) -> str:
    """The comparison for a terminal, the gravest first."""
    headings = {
        "worse": "Worse",
        "orders": "Another order than before",
        "gone": "Missing in the new run",
        "errors": "Another error than before",
        "better": "Better",
        "added": "Only in the new run",
        "versions": "Versions",
        "times": "Run times",
        "notes": "Not compared",
    }
    lines = ["The runs agree." if found.same else "The runs differ."]
    for name, heading in headings.items():
        sentences = getattr(found, name)
        if sentences:
            lines += ["", f"{heading} ({len(sentences)})", *(f"  {sentence}" for sentence in sentences)]
    return "\n".join(lines)


def _cells(results: Results) -> dict[_Cell, Mapping[str, Any]]:
    return {(c["scene"], c["engine"], c["scheme"], c["dt"]): c for c in results["cells"]}


def _place(key: tuple[Any, ...]) -> str:
    scene, engine, scheme, dt = key
    return f"{engine} {scheme} in {scene} at dt {dt:g} s"


def _changed(key: _Cell, old: Mapping[str, Any], new: Mapping[str, Any]) -> Iterator[tuple[int, str]]:
    """Below 0 for each verdict that got worse, above 0 for one that got better, with a sentence."""
    before, after = ({(v["check"], v["observable"]): v for v in cell["verdicts"]} for cell in (old, new))
    if not (before and after):
        step = GRAVITY.index(Status(new["status"])) - GRAVITY.index(Status(old["status"]))
        if step:
            yield step, f"{_place(key)}: {old['status']} → {new['status']} {new['message']}".rstrip()
        return
    for name, verdict in before.items():
        what = f"{_place(key)}: {name[0]} of {name[1]}: {_said(verdict)}"
        if name not in after:
            if Status(verdict["status"]) is not Status.UNSUPPORTED:
                yield -1, f"{what} → no longer checked"
        elif step := _gravity(after[name]) - _gravity(verdict):
            yield step, f"{what} → {_said(after[name])}"
    for name in after.keys() - before.keys():
        if not Status(after[name]["status"]).conforms:
            yield -1, f"{_place(key)}: {name[0]} of {name[1]}: not checked → {_said(after[name])}"


def _gravity(verdict: Mapping[str, Any]) -> int:
    return GRAVITY.index(Status(verdict["status"]))


def _said(verdict: Mapping[str, Any]) -> str:
    measured = "" if verdict["measured"] is None else f" ({verdict['measured']:.3g} {verdict['unit']})"
    return f"{verdict['status']}{measured}"


def _errors(old: Results, new: Results) -> Iterator[str]:
    """One sentence a scheme and observable: at the step where its error changed most, round-off apart."""
    before = {_row_key(row): row for row in old["work_precision"]}
    worst: dict[tuple[str, ...], tuple[float, str]] = {}
    for row in new["work_precision"]:
        other = before.get(_row_key(row))
        if other is None or row["error"] is None or other["error"] is None:
            continue
        low, high = sorted((row["error"], other["error"]))
        if high - low <= SAME * low + (row.get("round_off") or 0.0):
            continue
        size = high / low if low else float("inf")
        key = (row["scene"], row["engine"], row["scheme"], row["observable"])
        if size > worst.get(key, (0.0, ""))[0]:
            text = f"error of {row['observable']} {other['error']:.3g} → {row['error']:.3g} {row['unit']}"
            worst[key] = size, f"{_place(_row_key(row)[:4])}: {text}"
    for _, text in worst.values():
        yield text


def _orders(old: Results, new: Results) -> Iterator[str]:
    """One sentence a scheme and observable whose error falls with another power of the step than it did."""
    before = _fitted(old)
    for key, fit in _fitted(new).items():
        was = before.get(key)
        if was is not None and abs(fit.order - was.order) > order.TOLERANCE:
            scene, engine, scheme, observable = key
            yield f"{engine} {scheme} in {scene}: order of {observable} {was.order:.2f} → {fit.order:.2f}"


def _fitted(results: Results) -> dict[tuple[str, ...], order.Fit]:
    """The order of every ladder, of its steps that are clear of round-off, where there are enough of them."""
    ladders = defaultdict[tuple[str, ...], dict[float, float]](dict)
    for row in results["work_precision"]:
        if row.get("judged", True) and (row["error"] or 0.0) > order.ABOVE * (row.get("round_off") or 0.0):
            key = (row["scene"], row["engine"], row["scheme"], row["observable"])
            ladders[key][row["dt"]] = row["error"]
    return {
        key: order.fit(np.array(list(steps)), np.array(list(steps.values())))
        for key, steps in ladders.items()
        if len(steps) >= order.FEWEST
    }


def _row_key(row: Mapping[str, Any]) -> tuple[Any, ...]:
    return (row["scene"], row["engine"], row["scheme"], row["dt"], row["observable"])


def _versions(old: Results, new: Results) -> Iterator[str]:
    one, two = old["environment"], new["environment"]
    for name in [*one, *(name for name in two if name not in one)]:
        if name not in _OF_THE_RUN and one.get(name) != two.get(name):
            yield f"{name} {one.get(name, 'not there')} → {two.get(name, 'not there')}"


#: What of the environment says when and how a run was made, and not in what.
_OF_THE_RUN = ("command", "whole", "started", "workers", "seconds")


def _times(old: Results, new: Results) -> tuple[list[str], list[str]]:
    """Median ratio of the times of each engine's cells; only of runs on one machine."""
    one, two = old["environment"], new["environment"]
    if any(one.get(name) != two.get(name) for name in ("platform", "cpu", "cores")):
        return [], ["Run times: the runs were made on different machines."]
    before = {_row_key(row)[:4]: row["seconds_min"] for row in old["work_precision"]}
    ratios: dict[str, dict[Any, float]] = {}
    for row in new["work_precision"]:
        was = before.get(_row_key(row)[:4])
        if was and row["seconds_min"]:
            ratios.setdefault(row["engine"], {})[_row_key(row)[:4]] = row["seconds_min"] / was
    said = [
        f"{engine}: {median(cells.values()):.2f} × as long, the median of {len(cells)} cells"
        for engine, cells in ratios.items()
        if abs(median(cells.values()) - 1) > NOISE
    ]
    return said, [] if ratios else ["Run times: not taken in both runs."]
