"""What an accuracy costs: the configurations that nothing beats, and the cheapest for a given error."""

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from math import isfinite
from typing import Any

#: Errors, in an observable's unit, for which the cheapest configuration is told.
TARGETS = (1e-2, 1e-4, 1e-6, 1e-8)

#: What makes a configuration: the first three a scheme, the last its step [s].
_CONFIGURATION = ("engine", "engine_version", "scheme", "dt")

Row = Mapping[str, Any]


def pareto_front(rows: Iterable[Row], time: str = "seconds_min") -> list[Row]:
    """The rows of ``work_precision`` that no other beats in both error and ``time``, the cheapest first.

    ``rows`` are of one scene and one observable; those not timed or without a finite error are left out.
    """
    found: list[Row] = []
    for row in sorted(_comparable(rows), key=lambda row: (row[time], row["error"])):
        if not found or row["error"] < found[-1]["error"]:
            found.append(row)
    return found


def cheapest(rows: Iterable[Row], targets: Sequence[float] = TARGETS) -> list[dict[str, Any]]:
    """The cheapest configuration for each target, of each scene and observable, as plain values.

    ``engine`` and what follows are ``None`` where no configuration reaches the target. ``next_engine``
    and ``ratio`` tell the cheapest of the other engines and how many times as long it takes; ``None``
    where no other reaches it. ``coarsest`` tells that no coarser step of its scheme was tried, which may be
    cheaper still. Times are the least of each row's repeats.
    """
    groups: dict[tuple[str, str, str], list[Row]] = defaultdict(list)
    for row in rows:
        groups[row["scene"], row["observable"], row["unit"]].append(row)
    return [
        {"scene": scene, "observable": observable, "unit": unit, "target": target} | _best(mine, target)
        for (scene, observable, unit), mine in groups.items()
        if _comparable(mine)
        for target in targets
    ]


def _best(rows: Sequence[Row], target: float) -> dict[str, Any]:
    able = sorted(
        (row for row in _comparable(rows) if row["error"] <= target),
        key=lambda row: float(row["seconds_min"]),
    )
    if not able:
        return dict.fromkeys((*_CONFIGURATION, "error", "seconds", "next_engine", "ratio", "coarsest"))
    best = able[0]
    other = next((row for row in able if row["engine"] != best["engine"]), None)
    return {
        **{name: best[name] for name in (*_CONFIGURATION, "error")},
        "seconds": best["seconds_min"],
        "next_engine": other and other["engine"],
        "ratio": other and other["seconds_min"] / best["seconds_min"],
        # What broke down at a coarser step has a row as well, without an error.
        "coarsest": not any(
            row["dt"] > best["dt"]
            for row in rows
            if all(row[name] == best[name] for name in _CONFIGURATION[:3])
        ),
    }


def _comparable(rows: Iterable[Row]) -> list[Row]:
    return [row for row in rows if row["seconds_min"] and row["error"] is not None and isfinite(row["error"])]
