"""One stability map as a picture: parameter against step, coloured and marked by outcome, theory over it."""

import math
import re
from collections.abc import Mapping, Sequence
from typing import Any

from markupsafe import Markup

from .outcomes import Outcome, unfinished
from .wording import number, printable

#: A sign and a colour each, told apart without the other: the colours are Okabe and Ito's, and paler ones.
SIGNS: dict[Outcome, tuple[str, str]] = {
    Outcome.ACCURATE: ("✓", "#7fd4b8"),
    Outcome.BOUNDED: ("~", "#a6d8f5"),
    Outcome.GROWING: ("▲", "#e69f00"),
    Outcome.CLAMPED: ("=", "#cc79a7"),
    Outcome.RESET: ("R", "#f0e442"),
    Outcome.NOT_FINITE: ("×", "#d55e00"),
    Outcome.REFUSED: ("–", "#d0d4d9"),
    Outcome.TIMED_OUT: ("T", "#b0b6bd"),
    Outcome.CRASHED: ("!", "#6b7075"),
}
#: Sizes of a cell and of the margins that hold the labels [px].
WIDTH, HEIGHT, LEFT, TOP, BOTTOM, RIGHT = 28, 17, 34, 18, 34, 8
SAID = 120
#: Legs of the white corner of a run that was cut short [px].
CORNER = 9


def picture(found: Mapping[str, Any], family: Mapping[str, Any]) -> Markup:
    """The map ``found``, of ``family``, both as ``stability.json`` has them, as SVG."""
    values, steps = family["values"], family["steps"]
    wide, high = LEFT + WIDTH * len(values) + RIGHT, TOP + HEIGHT * len(steps) + BOTTOM
    parts = [
        *(_cell(point, values, steps) for point in found["points"]),
        *_labels(values, steps, family["parameter"]),
        _theory(found["theory"], values, steps),
        *(_limit(limit, values, steps) for limit in found["limits"]),
    ]
    what = f"{found['engine']} {found['scheme']}: outcome over {family['parameter']} and step"
    return Markup(
        '<svg viewBox="0 0 {0} {1}" style="max-width:{2}px" role="img" aria-label="{3}">{4}</svg>'
    ).format(wide, high, round(1.25 * wide), printable(what), Markup("").join(parts))


def sign(outcome: Outcome) -> Markup:
    """An outcome's square, as in the maps."""
    glyph, colour = SIGNS[outcome]
    return Markup('<span class="sign" style="background:{0}">{1}</span>').format(colour, glyph)


def _cell(point: Mapping[str, Any], values: Sequence[float], steps: Sequence[float]) -> Markup:
    outcome = Outcome(point["outcome"])
    glyph, colour = SIGNS[outcome]
    x, y = _left(values.index(point["value"])), _top(steps.index(point["dt"]), steps)
    told = f"{point['value']:g}, dt {point['dt']:g} s: {outcome.value}"
    if point["covered"] is not None and point["covered"] < 1:
        told += f", after {point['covered']:.2g} of its scene"
    if point["error"] is not None:
        told += f"; error {number(point['error'])}, energy up to {number(point['energy_most'])}"
        told += f" and at the end {number(point['energy_last'])} of the start's"
    if point["said"]:
        told += f"; {printable(point['said'])[:SAID]}"
    right, low = x + WIDTH - 1, y + HEIGHT - 1
    corner = Markup('<path d="M{0} {1}v-{2}l-{2} {2}z" class="so-far"/>').format(right, low, CORNER)
    return Markup(
        '<g><title>{0}</title><rect x="{1}" y="{2}" width="{3}" height="{4}" fill="{5}"/>{9}'
        '<text x="{6}" y="{7}" class="glyph">{8}</text></g>'
    ).format(
        told, x, y, WIDTH - 1, HEIGHT - 1, colour, x + WIDTH / 2, y + HEIGHT - 5, glyph,
        corner if unfinished(outcome, point["covered"]) else "",
    )  # fmt: skip


def _labels(values: Sequence[float], steps: Sequence[float], parameter: str) -> list[Markup]:
    """Decades of the step on the left, values below, and what they are."""
    text = Markup('<text x="{0}" y="{1}" class="{2}">{3}</text>')
    low = TOP + HEIGHT * len(steps)
    rows = [
        text.format(LEFT - 4, _top(row, steps) + HEIGHT - 5, "end", _short(step))
        for row, step in enumerate(steps)
        if math.isclose(math.log10(step), round(math.log10(step)), abs_tol=1e-3)
    ]
    columns = [
        text.format(_left(k) + WIDTH / 2, low + 13, "value", _short(value)) for k, value in enumerate(values)
    ]
    middle = LEFT + WIDTH * len(values) / 2
    return [
        *rows,
        *columns,
        text.format(middle, low + 29, "middle", parameter),
        text.format(LEFT - 4, TOP - 6, "end", "dt [s]"),
    ]


def _theory(theory: Sequence[Mapping[str, Any]], values: Sequence[float], steps: Sequence[float]) -> Markup:
    """Theory's line through the values at which it has a step that the map shows."""
    stairs = [
        (_left(values.index(row["value"])), _height(row["limit"], steps))
        for row in theory
        if isinstance(row["limit"], float | int) and row["limit"] > 0
    ]
    inside = [(x, y) for x, y in stairs if TOP <= y <= TOP + HEIGHT * len(steps)]
    points = " ".join(f"{x + dx:.1f},{y:.1f}" for x, y in inside for dx in (0, WIDTH - 1))
    line = Markup('<polyline points="{0}" class="{1}"/>')
    return line.format(points, "halo") + line.format(points, "theory") if points else Markup("")


def _limit(limit: Mapping[str, Any], values: Sequence[float], steps: Sequence[float]) -> Markup:
    """A measured limit, where there is one inside the map."""
    if limit["grew"] is None or not limit["held"]:
        return Markup("")
    y = _height(math.sqrt(limit["held"] * limit["grew"]), steps)
    if not TOP <= y <= TOP + HEIGHT * len(steps):
        return Markup("")
    x = _left(values.index(limit["value"])) + WIDTH / 2
    return Markup('<circle cx="{0:.1f}" cy="{1:.1f}" r="4" class="measured"/>').format(x, y)


def _left(column: int) -> int:
    return LEFT + WIDTH * column


def _top(row: int, steps: Sequence[float]) -> int:
    return TOP + HEIGHT * (len(steps) - 1 - row)


def _height(step: float, steps: Sequence[float]) -> float:
    """Where a step lies among steps that are evenly spaced in their logarithm; a row's middle is its own."""
    row = (len(steps) - 1) * math.log(step / steps[0]) / math.log(steps[-1] / steps[0])
    return TOP + HEIGHT * (len(steps) - row - 0.5)


def _short(value: float) -> str:
    """A value in few characters."""
    plain = f"{value:g}"
    if len(plain) <= 4 and value >= 0.1:
        return plain
    return re.sub(r"e([-+])0*", r"e\1", f"{value:.0e}").replace("e+", "e")
