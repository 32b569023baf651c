"""Figures as data: plotly traces for error against cost, packed curves for pictures of motion."""

import base64
import math
from collections.abc import Iterable, Mapping
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

    ``rows`` are those of ``work_precision`` for that scene. The result holds ``views``: label of
    the observable, label of the x axis, plotly ``data``, the axes' titles, the Pareto ``front``, and a note
    on whatever has no place on these axes. ``None`` where there are no rows, or but one step and no time.
    """
    table = list(rows)
    timed = any(row["seconds_median"] is not None for row in table)
    if not timed and len({row["dt"] for row in table}) < 2:
        return None
    styles = {(column.engine, column.version, column.scheme): column for column in columns}
    abscissae = (["seconds_median"] if timed else []) + ["dt"]
    observables = dict.fromkeys((row["observable"], row["unit"]) for row in table)
    views = [
        _view(name, unit, x, [row for row in table if row["observable"] == name], styles)
        for name, unit in observables
        for x in abscissae
    ]
    return {"timed": timed, "views": views}


_X = {"seconds_median": ("run time", "run time, median [s]"), "dt": ("step", "step dt [s]")}


def _view(
    name: str, unit: str, x: str, rows: list[Record], styles: Mapping[tuple[str, str, str], Column]
) -> Figure:
    lines: dict[Column, list[Record]] = {}
    lost: list[Record] = []
    for row in rows:
        column = styles[row["engine"], row["engine_version"] or "", row["scheme"]]
        fits = _on_log_axis(row[x]) and _on_log_axis(row["error"])
        (lines.setdefault(column, []) if fits else lost).append(row)
    ordered = sorted(lines, key=lambda column: column.place)
    label, title = _X[x]
    return {
        "observable": f"{name} [{unit}]",
        "against": label,
        "x": title,
        "y": f"error of {name} [{unit}]",
        "data": [_line(column, x, lines[column], unit) for column in ordered],
        "front": _front(x, [row for mine in lines.values() for row in mine]),
        "note": _not_drawn(lost, x),
    }


def _front(x: str, rows: list[Record]) -> Figure | None:
    """Where nothing is both cheaper and nearer, as a stair; of steps there is none."""
    if x not in TIMES:
        return None
    best = pareto_front(rows, x)
    return {"x": [_digits(row[x]) for row in best], "y": [_digits(row["error"]) for row in best]}


def _on_log_axis(value: float | None) -> bool:
    return value is not None and math.isfinite(value) and value > 0


def _line(column: Column, x: str, rows: list[Record], unit: str) -> Figure:
    """One scheme over its steps, finest first; the page gives it its engine's colour."""
    rows = sorted(rows, key=lambda row: float(row["dt"]))
    engine, scheme = column.place
    return {
        "type": "scatter",
        "mode": "lines+markers",
        "name": column.label,
        "meta": engine,
        "x": [_digits(row[x]) for row in rows],
        "y": [_digits(row["error"]) for row in rows],
        "customdata": [[number(row["dt"]), row["steps"], _time(row)] for row in rows],
        "marker": {"symbol": SYMBOLS[scheme % len(SYMBOLS)], "size": 7},
        "line": {"dash": DASHES[scheme % len(DASHES)], "width": 1.5},
        "hovertemplate": f"<b>{column.engine} {column.version}, {column.scheme}</b><br>"
        "dt %{customdata[0]} s, %{customdata[1]} steps<br>"
        f"error %{{y:.2e}} {unit}<br>%{{customdata[2]}}<extra></extra>",
    }


def _digits(value: float) -> float:
    """Enough digits for any screen, few enough for a small file."""
    return float(f"{value:.5e}")


def _time(row: Record) -> str:
    if row["seconds_median"] is None:
        return "not timed"
    spread = f"least {number(row['seconds_min'])} s" if row["seconds_min"] is not None else "least not kept"
    call = f"; {row['us_per_call']:.2f} µs of Python in a call" if row.get("us_per_call") is not None else ""
    return f"median {number(row['seconds_median'])} s, {spread}, {count(row['repeats'], 'repeat')}{call}"


def _not_drawn(lost: list[Record], x: str) -> str:
    """What a logarithmic plot cannot show, in words."""
    if not lost:
        return ""
    words: dict[str, dict[str, None]] = {}
    for row in lost:
        reason = "not timed" if not _on_log_axis(row[x]) else _odd(row["error"])
        words.setdefault(reason, {})[f"{row['engine']} {row['scheme']} (dt {number(row['dt'])} s)"] = None
    return "Not drawn: " + "; ".join(f"{reason}: {', '.join(who)}" for reason, who in words.items()) + "."


def _odd(error: float | None) -> str:
    return "error exactly 0" if error == 0 else "error not finite"


def motion_figures(motion: Motion, columns: Iterable[Column]) -> list[Figure]:
    """One figure for each picture of the scene: the truth as a line, every run as dots over it.

    A figure holds its ``title``, ``axes``, ``equal``, the ``box`` that the truth fills (lowest and
    highest corner) and ``curves``; these hold t and each axis as 16-bit fractions of their own range.
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
    """(n, k) as little-endian 16-bit fractions of each column's range, column by column."""
    if not len(points):
        return {"n": 0, "low": [], "high": [], "data": ""}
    low, high = points.min(axis=0), points.max(axis=0)
    span = np.where(high > low, high - low, 1.0)
    fractions = np.rint((points - low) / span * 65535).astype("<u2")
    return {
        "n": len(points),
        "low": [_digits(x) for x in low.tolist()],
        "high": [_digits(x) for x in high.tolist()],
        "data": base64.b64encode(fractions.T.tobytes()).decode(),
    }
