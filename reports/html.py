"""The report as one HTML file: opens offline, reads on a phone and on paper, asks for nothing."""

from collections.abc import Mapping, Sequence
from functools import cache
from itertools import groupby
from math import log
from pathlib import Path
from typing import Any
from urllib.parse import quote

from jinja2 import Environment
from markupsafe import Markup, escape
from plotly.offline.offline import get_plotlyjs

from ..scenarios.features import FEATURES
from . import templating
from .cheapest import cheapest
from .common_causes import spoken
from .digest import Column, Digest, Group, Record
from .findings import findings
from .plots import Figure, cost_figure
from .verdict import Status
from .wording import NOT_RUN, PARTIAL, count, number, printable, steps


def render(results: Record, pictures: Mapping[str, Sequence[Figure]], out: Path) -> None:
    """Write the report on ``results`` (the content of results.json) to the file ``out``.

    ``pictures`` are those of ``plots.motion_figures``, by scene. Equal input gives equal bytes. Raises
    ``InputError`` if ``results`` has another schema.
    """
    digest = Digest(results)
    text = (
        _environment()
        .get_template("report.html.j2")
        .render(
            digest=digest,
            findings=[
                (status, list(found)) for status, found in groupby(findings(digest), lambda f: f.status)
            ],
            pictures=pictures,
            costs=_costs(digest),
            cheapest=_cheapest(digest),
            rates=_rates(digest),
            weights=_weights(digest),
            settings=_settings(digest),
            plotly=_library(),
        )
    )
    out.write_text(text, encoding="utf-8")


@cache
def _library() -> Markup:
    """plotly.js, which goes into the page once and unescaped: it is a library, not data."""
    code: str = get_plotlyjs()  # type: ignore[no-untyped-call]  # plotly has no types
    return Markup(code)  # noqa: S704 (see above)


@cache
def _environment() -> Environment:
    environment = templating.environment()
    environment.policies["json.dumps_kwargs"] = {"allow_nan": False, "separators": (",", ":")}
    environment.filters |= {
        "number": number,
        "count": count,
        "steps": steps,
        "breakable": _breakable,
        "reference": lambda text: quote(printable(text)),
        "verdict_rows": _verdict_rows,
        "spoken": spoken,
        "in_words": lambda feature: FEATURES.get(feature, feature),
    }
    environment.globals |= {
        "Status": Status,
        "NOT_RUN": NOT_RUN,
        "PARTIAL": PARTIAL,
        "OPEN": (Status.ERROR, Status.FAIL, Status.FIXED),
    }
    return environment


def _breakable(name: str) -> Markup:
    """A scene's name that may break after an underscore and before its variant."""
    pause = Markup("<wbr>")
    return escape(printable(name)).replace("_", "_" + pause).replace("[", pause + "[")


def _costs(digest: Digest) -> dict[str, Any]:
    """The figure of error against cost of each scene that has one."""
    rows: dict[str, list[Record]] = {}
    for row in digest.work_precision:
        rows.setdefault(row["scene"], []).append(row)
    return {scene: cost_figure(mine, digest.columns) for scene, mine in rows.items()}


def _cheapest(digest: Digest) -> dict[str, list[Record]]:
    """What each accuracy of a scene's first observable costs, if any of its configurations has it."""
    found: dict[str, list[Record]] = {}
    for row in cheapest(digest.work_precision):
        mine = found.setdefault(row["scene"], [])
        if not mine or mine[0]["observable"] == row["observable"]:
            mine.append(row)
    return {scene: rows for scene, rows in found.items() if any(row["engine"] for row in rows)}


def _rates(digest: Digest) -> dict[str, Record]:
    """What was fitted to the motions of each scene at its own step: the exact rates, and each scheme's."""
    rows: dict[str, list[Record]] = {}
    for row in digest.work_precision:
        if row.get("fitted") is not None:
            rows.setdefault(row["scene"], []).append(row)
    return {scene: _fitted(mine, digest) for scene, mine in rows.items()}


def _fitted(rows: Sequence[Record], digest: Digest) -> Record:
    own = digest.scenes[rows[0]["scene"]].get("dt") or rows[0]["dt"]
    dt = min((row["dt"] for row in rows), key=lambda step: abs(log(step / own)))
    rates = {row["observable"]: row for row in rows}
    found = {(row["engine"], row["scheme"], row["observable"]): row for row in rows if row["dt"] == dt}
    lines = [
        (column, [found.get((column.engine, column.scheme, name)) for name in rates])
        for column in digest.columns
    ]
    return {"dt": dt, "rates": list(rates.values()), "lines": [line for line in lines if any(line[1])]}


def _weights(digest: Digest) -> dict[str, str]:
    """Of each scene in words how much memory its cells took at the most, and how large their logs are."""
    found: dict[str, str] = {}
    for scene in digest.scenes:
        cells = [cell for cell in digest.cells if cell["scene"] == scene]
        sizes = [cell["log_bytes"] for cell in cells if cell.get("log_bytes")]
        memory = [cell["memory_bytes"] for cell in cells if cell.get("memory_bytes")]
        said = [f"at most {max(memory) / 1e6:.0f} MB held by the process of a cell"] if memory else []
        if sizes:
            least, most, total = min(sizes) / 1e3, max(sizes) / 1e3, sum(sizes) / 1e6
            size = f"{least:.0f} to {most:.0f}" if round(least) < round(most) else f"{most:.0f}"
            said += [f"logs of {size} kB, {total:.2f} MB in all"]
        if said:
            found[scene] = "; ".join(said)
    return found


def _settings(digest: Digest) -> list[tuple[str, str, str]]:
    """Every setting that a cell names, as (schemes that have it so, setting, value)."""
    found: dict[tuple[str, str], dict[Column, None]] = {}
    for group in digest.groups.values():
        for cell in group.cells:
            for name, value in cell["settings"].items():
                found.setdefault((name, str(value)), {})[group.column] = None
    return [(digest.named(columns), name, value) for (name, value), columns in found.items()]


def _verdict_rows(group: Group) -> list[tuple[str, str, str, list[Record | None]]]:
    """Check, observable, unit and the verdict of each of the group's other cells, where there is one."""
    units: dict[tuple[str, str], dict[str, None]] = {}
    for verdict in (verdict for cell in group.others for verdict in cell["verdicts"]):
        units.setdefault((verdict["check"], verdict["observable"]), {})[verdict["unit"]] = None
    by_cell = [{(v["check"], v["observable"]): v for v in cell["verdicts"]} for cell in group.others]
    # A verdict without a number has no unit either.
    return [
        (*kind, " or ".join(filter(None, named)), [verdicts.get(kind) for verdicts in by_cell])
        for kind, named in units.items()
    ]
