"""Changes to the record of known deviations that a run suggests, for somebody to read and to complete."""

import json
from collections.abc import Iterable, Mapping
from typing import Any

from .deviations import FILE, Deviation

#: A bound that the measured value stays below by this factor may be tightened to twice that value.
SLACK = 4.0
#: Room between what was measured and the bound of a new entry.
ROOM = 2.0

_Failure = tuple[str, str, str, str, str, str]


def proposed(results: Mapping[str, Any], recorded: Iterable[Deviation]) -> str:
    """What ``results`` (the content of results.json) suggest, as TOML with comments.

    A failure without a record becomes an entry whose ``reason`` is empty: it is refused until somebody
    has found one. A record that is gone, matches nothing, or grants far more than was measured is
    named. A bound that was exceeded is only told: none is ever widened here.
    """
    on_record = list(recorded)
    told = [*results["stale_deviations"], *_exceeded(results), *_gone(results), *_loose(results, on_record)]
    parts = [f"# Proposed for {FILE}.", *(f"# {line}" for line in told)]
    parts += [_entry(failure, found) for failure, found in _unrecorded(results).items()]
    return "\n".join(parts) + "\n" if len(parts) > 1 else ""


def _unrecorded(results: Mapping[str, Any]) -> dict[_Failure, tuple[float, float]]:
    """Largest measured value and step of every failure that no record speaks of."""
    found: dict[_Failure, tuple[float, float]] = {}
    for cell, verdict in _verdicts(results, "fail"):
        if verdict["measured"] is None or _is_exceeded(verdict):
            continue
        key = (
            cell["scene"], cell["engine"], cell["engine_version"], cell["scheme"], verdict["check"],
            verdict["observable"],
        )  # fmt: skip
        worst, coarsest = found.get(key, (0.0, 0.0))
        found[key] = max(worst, verdict["measured"]), max(coarsest, cell["dt"])
    return found


def _entry(failure: _Failure, found: tuple[float, float]) -> str:
    scene, engine, version, scheme, check, observable = failure
    worst, coarsest = found
    fields = {
        "scene": scene,
        "engine": engine,
        "scheme": scheme,
        "versions": f"=={version}",
        "check": check,
        "observable": observable,
        "dt": coarsest,
        "bound": float(f"{ROOM * worst:.1e}"),
        "reason": "",
    }
    lines = [f"{name} = {json.dumps(value, ensure_ascii=False)}" for name, value in fields.items()]
    return "\n".join(["", "# The reason is missing: a link or a measurement.", "[[deviation]]", *lines])


def _exceeded(results: Mapping[str, Any]) -> list[str]:
    return [
        f"Beyond its bound, which stays: {_place(cell, verdict)}, {verdict['measured']:.3g} "
        f"{verdict['unit']}: {verdict['message']}"
        for cell, verdict in _verdicts(results, "fail")
        if _is_exceeded(verdict)
    ]


def _gone(results: Mapping[str, Any]) -> list[str]:
    places = (_place(cell, verdict) for cell, verdict in _verdicts(results, "fixed"))
    return [f"Gone, remove its record: {place}" for place in dict.fromkeys(places)]


def _loose(results: Mapping[str, Any], recorded: list[Deviation]) -> list[str]:
    """Records whose bound is far above all that was measured under them."""
    lines = []
    for deviation in recorded:
        measured = [
            verdict["measured"]
            for cell, verdict in _verdicts(results, "known")
            if deviation.speaks_of(cell["scene"], cell["engine"], cell["engine_version"], cell["scheme"])
            and (verdict["check"], cell["dt"] <= deviation.dt) == (deviation.check, True)
            and deviation.names(verdict["observable"])
        ]
        if measured and max(measured) * SLACK < deviation.bound:
            lines.append(
                f"{deviation.engine} {deviation.scheme} in {deviation.scene}, {deviation.check} of "
                f"{deviation.observable}: the bound {deviation.bound:.2g} may come down to "
                f"{ROOM * max(measured):.1e}"
            )
    return lines


def _verdicts(results: Mapping[str, Any], status: str) -> list[tuple[Mapping[str, Any], Mapping[str, Any]]]:
    return [
        (cell, verdict)
        for cell in results["cells"]
        for verdict in cell["verdicts"]
        if verdict["status"] == status
    ]


def _is_exceeded(verdict: Mapping[str, Any]) -> bool:
    return "beyond the recorded bound" in verdict["message"]


def _place(cell: Mapping[str, Any], verdict: Mapping[str, Any]) -> str:
    return (
        f"{cell['engine']} {cell['scheme']} in {cell['scene']} at dt {cell['dt']:g} s, {verdict['check']} of "
        f"{verdict['observable']}"
    )
