"""The outcome of a sweep as plain data: what ``stability.json`` holds and its page is made of."""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from ..adapters.runner import Failure
from ..adapters.stable_step import StableStep
from ..scenarios.families import Family
from . import stored
from .outcomes import Found, Outcome
from .verdict import Status, Verdict

SCHEMA = "poinsot.stability/1"


@dataclass
class Sweep:
    """One scheme over one family: what became of each (value, step), and where each value began to grow."""

    family: str
    engine: str
    engine_version: str
    scheme: str
    twin: str
    points: dict[tuple[float, float], Found] = field(default_factory=dict)
    limits: dict[float, StableStep | Failure] = field(default_factory=dict)

    @property
    def key(self) -> tuple[str, str, str]:
        """What tells this sweep from the others of its run."""
        return (self.family, self.engine, self.scheme)


def results(
    families: Sequence[Family],
    sweeps: Sequence[Sweep],
    verdicts: Iterable[Verdict],
    environment: Mapping[str, Any],
    notes: Sequence[str],
) -> dict[str, Any]:
    """Everything about a sweep as a dictionary of plain values, stable in its order.

    Of a limit, ``held`` and ``grew`` are steps [s], ``grew`` null if none did; ``theory`` is a step [s], 0 if
    there is no stable one, the text "any" if all are, null where it is not known.
    """
    theory = {family.name: _theory(family, sweeps) for family in families}
    return {
        "schema": SCHEMA,
        "environment": dict(environment),
        "families": {family.name: _family(family) for family in families},
        "maps": [_map(sweep, theory[sweep.family]) for sweep in sweeps],
        "verdicts": [_verdict(verdict) for verdict in verdicts],
        "notes": list(notes),
    }


def read(path: Path) -> dict[str, Any]:
    """Read results; raises ``ResultsError`` if the file is not a sweep's, of the schema known here."""
    return stored.read(path, SCHEMA, "a sweep")


def exit_code(found: Mapping[str, Any]) -> int:
    """What a sweep ends with: 3 if an engine crashed or gave no limit, 1 if a verdict fails, else 0."""
    outcomes = {point["outcome"] for every in found["maps"] for point in every["points"]}
    statuses = {Status(verdict["status"]) for verdict in found["verdicts"]}
    if Outcome.CRASHED.value in outcomes or Status.ERROR in statuses:
        return 3
    return 1 if statuses & {Status.FAIL, Status.FIXED} else 0


def _theory(family: Family, sweeps: Sequence[Sweep]) -> dict[tuple[str, float], float | str | None]:
    """By twin and value."""
    twins = {sweep.twin for sweep in sweeps if sweep.family == family.name}
    found: dict[tuple[str, float], float | str | None] = {}
    for value in family.values:
        scene = family.scene(value)
        for twin in sorted(twins):
            limit = scene.stable_step(scene, twin) if scene.stable_step else None
            found[twin, value] = "any" if limit == math.inf else limit
    return found


def _family(family: Family) -> dict[str, Any]:
    names = ("summary", "parameter", "values", "steps", "law", "most")
    return {name: getattr(family, name) for name in names}


def _map(sweep: Sweep, theory: Mapping[tuple[str, float], float | str | None]) -> dict[str, Any]:
    values = dict.fromkeys(value for value, _ in sweep.points)
    return {
        "family": sweep.family,
        "engine": sweep.engine,
        "engine_version": sweep.engine_version,
        "scheme": sweep.scheme,
        "twin": sweep.twin,
        "theory": [{"value": value, "limit": theory[sweep.twin, value]} for value in values],
        "limits": [
            {"value": value, "held": limit.held, "grew": limit.grew if math.isfinite(limit.grew) else None}
            for value, limit in sweep.limits.items()
            if isinstance(limit, StableStep)
        ],
        "points": [
            {"value": value, "dt": dt} | asdict(found) | {"outcome": found.outcome.value}
            for (value, dt), found in sweep.points.items()
        ],
    }


def _verdict(verdict: Verdict) -> dict[str, Any]:
    measured = verdict.measured
    finite = measured is not None and math.isfinite(measured)
    return asdict(verdict) | {"status": verdict.status.value, "measured": measured if finite else None}
