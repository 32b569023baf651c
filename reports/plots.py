"""Figures as data: plotly traces for error against cost, packed curves for pictures of motion."""

import base64
import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..reference.checked import Array
from ..scenarios.pictures import Picture
from ..scenarios.scene import Scene
from ..scenarios.trajectory import Trajectory
from .cheapest import pareto_front
from .digest import Column, Record
from .results import TIMES
from .wording import count, number

#: Points of the truth: a hundred a turn for twenty turns, more than a page can show.
TRUTH_POINTS = 2001
#: Points of an engine's curve: they are drawn as dots, and more of them hide the truth beneath.
RUN_POINTS = 400
#: A curve that goes this many times further out than the truth is cut off there.
FAR = 4.0
#: A run that is further from another of its order than this part of the truth's size is shown at first.
APART = 0.1
SYMBOLS = ("circle", "square", "diamond", "triangle-up", "cross", "x", "triangle-down", "pentagon", "star")
DASHES = ("solid", "dash", "dot", "dashdot", "longdash", "longdashdot")

Figure = dict[str, Any]


@dataclass(frozen=True)
class Motion:
    """A scene, and what it became in engines: one trajectory a scheme, each with its provenance."""

    scene: Scene
    runs: tuple[Trajectory, ...] = ()


def cost_figure(rows: Iterable[Record], columns: Iterable[Column]) -> Figure | None:
    """Error against run time and against the step, each for every observable of one scene.

    ``rows`` are those of ``work_precision`` for that scene. The result holds ``lines``, one a scheme: how
    plotly draws it, and its configurations from the finest step on (``x`` by axis, ``least`` run time [s],
    ``told`` on hover); ``axes``: what errors stand against; ``observables``: the ``errors`` of every line at
    its configurations, and for each axis the Pareto ``fronts`` and ``notes`` on whatever has no place there.
    What all views share is thus said once. ``None`` where there are no rows, or but one step and no time.
    """
    table = list(rows)
    timed = any(row["seconds_min"] is not None for row in table)
    if not timed and len({row["dt"] for row in table}) < 2:
        return None
    axes = (["seconds_min"] if timed else []) + ["dt"]
    lines = _lines(table, columns)
    observables: dict[tuple[str, str], list[Record]] = {}
    for row in table:
        observables.setdefault((row["observable"], row["unit"]), []).append(row)
    return {
        "timed": timed,
        "axes": [{"key": key, "label": _AXES[key][0], "title": _AXES[key][1]} for key in axes],
        "lines": [_line(column, axes, points) for column, points in lines.items()],
        "observables": [_errors(*named, axes, mine, lines) for named, mine in observables.items()],
    }


_AXES = {"seconds_min": ("run time", "run time, least [s]"), "dt": ("step", "step dt [s]")}
#: What makes a configuration: the errors of several observables belong to one where these are equal.
_CONFIGURATION = (
    "dt", "steps", "seconds_min", "seconds_median", "repeats", "us_per_call", "own_loop", "scaled",
    "timed_steps",
)  # fmt: skip

Lines = dict[Column, list[tuple[Any, ...]]]


def _lines(table: list[Record], columns: Iterable[Column]) -> Lines:
    """The configurations of each scheme that has an error to draw, finest step first."""
    styles = {(column.engine, column.version, column.scheme): column for column in columns}
    found: dict[Column, dict[tuple[Any, ...], None]] = {}
    for row in table:
        if _on_log_axis(row["error"]):
            found.setdefault(styles[_place(row)], {})[_configuration(row)] = None
    ordered = sorted(found, key=lambda column: column.place)
    return {column: sorted(found[column], key=lambda each: float(each[0])) for column in ordered}


def _place(row: Record) -> tuple[str, str, str]:
    return row["engine"], row["engine_version"] or "", row["scheme"]


def _configuration(row: Record) -> tuple[Any, ...]:
    return tuple(row.get(key) for key in _CONFIGURATION)


def _errors(name: str, unit: str, axes: list[str], rows: list[Record], lines: Lines) -> Figure:
    """What one observable adds to the lines; an error that no logarithmic axis takes is ``None``."""
    drawn = [row for row in rows if _on_log_axis(row["error"])]
    found = {(_place(row), _configuration(row)): _digits(row["error"]) for row in drawn}
    of = [((column.engine, column.version, column.scheme), points) for column, points in lines.items()]
    return {
        "label": f"{name} [{unit}]",
        "title": f"error of {name} [{unit}]",
        "unit": unit,
        "errors": [[found.get((place, point)) for point in points] for place, points in of],
        "fronts": [_front(x, [row for row in drawn if _on_log_axis(row[x])]) for x in axes],
        "notes": [_not_drawn(rows, x) for x in axes],
    }


def _front(x: str, rows: list[Record]) -> Figure | None:
    """Where nothing is both cheaper and nearer, as a stair; of steps there is none."""
    if x not in TIMES:
        return None
    best = pareto_front(rows, x)
    return {"x": [_digits(row[x]) for row in best], "y": [_digits(row["error"]) for row in best]}


def _on_log_axis(value: float | None) -> bool:
    return value is not None and math.isfinite(value) and value > 0


def _line(column: Column, axes: list[str], points: list[tuple[Any, ...]]) -> Figure:
    """One scheme over its steps; the page gives it its engine's colour and the errors it is to show."""
    engine, scheme = column.place
    rows = [dict(zip(_CONFIGURATION, point, strict=True)) for point in points]
    return {
        "trace": {
            "type": "scatter",
            "mode": "lines+markers",
            "name": column.label,
            "meta": engine,
            "marker": {"symbol": SYMBOLS[scheme % len(SYMBOLS)], "size": 7},
            "line": {"dash": DASHES[scheme % len(DASHES)], "width": 1.5},
        },
        "who": f"{column.engine} {column.version}, {column.scheme}",
        "x": {key: [_digits(row[key]) if _on_log_axis(row[key]) else None for row in rows] for key in axes},
        "least": [_digits(row["seconds_min"]) if row["seconds_min"] else None for row in rows],
        "told": [[number(row["dt"]), row["steps"], _time(row)] for row in rows],
    }


def _digits(value: float) -> float:
    """Enough digits for any screen, few enough for a small file."""
    return float(f"{value:.5e}")


def _time(row: Record) -> str:
    if row["seconds_min"] is None:
        return "not timed"
    least, median = number(row["seconds_min"]), number(row["seconds_median"])
    lines = [f"least {least} s, median {median} s, {count(row['repeats'], 'repeat')}"]
    if row.get("scaled"):
        lines.append(f"scaled from {count(row['timed_steps'], 'step')} of another dt")
    lines += _pace(row["seconds_min"], row["steps"], row["dt"])
    if row.get("us_per_call") is not None:
        lines.append(f"{row['us_per_call']:.2f} µs of Python in a call")
    if row.get("own_loop") is False:
        lines.append("steps asked for one by one: part of their time is Python's")
    return "<br>".join(lines)


def _pace(seconds: float | None, steps: int, dt: float) -> list[str]:
    """How fast that is, a step and against the clock, in one line or none."""
    if not seconds or not steps:
        return []
    each = seconds / steps
    return [f"{each * 1e6:.3g} µs a step, {1 / each:.3g} steps a second, {dt / each:.3g} × real time"]


def _not_drawn(rows: list[Record], x: str) -> str:
    """What a logarithmic plot cannot show, in words."""
    words: dict[str, dict[str, None]] = {}
    for row in rows:
        if _on_log_axis(row[x]) and _on_log_axis(row["error"]):
            continue
        reason = _odd(row) if row.get("message") or _on_log_axis(row[x]) else "not timed"
        words.setdefault(reason, {})[f"{row['engine']} {row['scheme']} (dt {number(row['dt'])} s)"] = None
    said = "; ".join(f"{reason}: {', '.join(who)}" for reason, who in words.items())
    return f"Not drawn: {said}." if said else ""


def _odd(row: Record) -> str:
    if row.get("message"):
        return "no motion"
    return "error exactly 0" if row["error"] == 0 else "error not finite"


def motion_figures(motion: Motion, columns: Iterable[Column]) -> list[Figure]:
    """One figure for each picture of the scene: the truth as a line, every run as dots over it.

    A figure holds its ``title``, ``axes``, ``equal``, the ``box`` that the truth fills (lowest and
    highest corner) and ``curves``; these hold t and each axis as ``_packed`` has them.
    """
    if not motion.scene.pictures:
        return []
    truth = motion.scene.truth(motion.scene, np.linspace(0.0, motion.scene.duration, TRUTH_POINTS))
    placed = {(column.engine, column.version, column.scheme): column for column in columns}
    runs = [(placed[_scheme_of(run)], run) for run in motion.runs]
    runs.sort(key=lambda pair: pair[0].place)
    return [_picture(motion.scene, picture, truth, runs) for picture in motion.scene.pictures]


def _scheme_of(run: Trajectory) -> tuple[str, str, str]:
    source = run.provenance
    assert source is not None, "a run's trajectory says where it came from"  # noqa: S101 (a caller's slip)
    return source.engine, source.engine_version, source.scheme


def _picture(
    scene: Scene, picture: Picture, truth: Trajectory, runs: list[tuple[Column, Trajectory]]
) -> Figure:
    exact = _points(scene, picture, truth)
    low, high = exact[:, 1:].min(axis=0), exact[:, 1:].max(axis=0)
    reach = FAR * _reach(high - low, picture.equal)
    drawn = [(column, _points(scene, picture, run)) for column, run in runs]
    shown = _first_shown(drawn, APART / FAR * reach)
    curves = [_curve(column, points, (low + high) / 2, reach) for column, points in drawn]
    for curve, (column, _) in zip(curves, runs, strict=True):
        curve["shown"] = column in shown
    return {
        "title": picture.title,
        "axes": list(picture.axes),
        "equal": picture.equal,
        "box": [_corner(corner, np.maximum(abs(low), abs(high))) for corner in (low, high)],
        "curves": [{"name": "truth", "engine": -1, "shown": True, **_packed(exact)}, *curves],
    }


def _corner(corner: Array, size: Array) -> list[float]:
    """The corner to the digits that are shown; what is only round-off beside the largest is zero."""
    return [_digits(x) for x in np.where(abs(corner) < 1e-12 * size.max(), 0.0, corner).tolist()]


def _reach(extent: Array, equal: bool) -> Array:
    """Size of the truth along each axis; an axis along which it rests takes the largest of the others."""
    largest = float(extent.max()) or 1.0
    return np.full_like(extent, largest) if equal else np.where(extent > 0, extent, largest)


def _curve(column: Column, points: Array, middle: Array, reach: Array) -> Figure:
    """A run's dots, thinned, up to where it goes too far out or stops being finite."""
    with np.errstate(invalid="ignore"):
        near = (np.abs(points[:, 1:] - middle) <= reach).all(axis=1)
    kept = points if near.all() else points[: int(np.argmin(near))]
    left = "" if near.all() else f", leaves at {number(points[len(kept), 0])} s"
    return {
        "name": column.label + left,
        "engine": column.place[0],
        "symbol": SYMBOLS[column.place[1] % len(SYMBOLS)],
        **_packed(kept[:: max(1, math.ceil(len(kept) / RUN_POINTS))]),
    }


def _points(scene: Scene, picture: Picture, motion: Trajectory) -> Array:
    """Time and the picture's coordinates, (n, 1 + axes)."""
    return np.column_stack([motion.t, picture.points(scene, motion)])


def _first_shown(drawn: list[tuple[Column, Array]], apart: Array) -> list[Column]:
    """What a reader sees before choosing: a scheme of the lowest order, one of the highest, and what differs.

    That is what is anywhere further than ``apart`` (k,) from the one of its own order.
    """
    ordered = sorted(drawn, key=lambda pair: pair[0].order or 0)
    typical = {column.order: (column, points) for column, points in (*ordered[-1:], *ordered[:1])}
    found = [typical[column.order][0] for column, _ in (*ordered[:1], *ordered[-1:])]
    for column, points in drawn:
        _, usual = typical.get(column.order, (column, points))
        with np.errstate(invalid="ignore"):
            near = len(points) == len(usual) and (abs(points - usual)[:, 1:] <= apart).all()
        found += [] if near else [column]
    return list(dict.fromkeys(found))


def _packed(points: Array) -> Figure:
    """(n, k) as little-endian 16-bit fractions of each column's range, column by column.

    Columns that run evenly from their least to their greatest, as times do, are ``even`` and hold no data.
    """
    if not len(points):
        return {"n": 0, "low": [], "high": [], "even": [], "data": ""}
    low, high = points.min(axis=0), points.max(axis=0)
    span = np.where(high > low, high - low, 1.0)
    fractions = (points - low) / span * 65535
    straight = np.outer(np.linspace(0.0, 65535.0, len(points)), high > low)
    even = (abs(fractions - straight) <= 0.5).all(axis=0)
    return {
        "n": len(points),
        "low": [_digits(x) for x in low.tolist()],
        "high": [_digits(x) for x in high.tolist()],
        "even": np.flatnonzero(even).tolist(),
        "data": base64.b64encode(np.rint(fractions.T[~even]).astype("<u2").tobytes()).decode(),
    }
