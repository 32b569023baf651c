"""Order of convergence over a ladder of steps, and the limit at which the ladder arrives."""

from collections import defaultdict
from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np

from ..reference.checked import Array
from ..scenarios.observables import Observable
from . import truth
from .cell import Cell
from .verdict import Ladder, Status, Verdict, ladder_of

#: Of two steps nearer to each other than this, a limit leaves out the coarser. 1.25 and 1 ms weigh rounding
#: 2.7 times in a ladder of fourth order that weighs it 1.3 times without them.
APART = 4 / 3
#: Fewest steps that make a ladder.
STEPS = 5
#: Fewest of them whose error must be clear of round-off.
FEWEST = 3
#: How far a fitted order may be from the declared one: less than half of what tells two apart.
TOLERANCE = 0.25
#: Errors this many times above round-off are truncation.
ABOVE = 5.0
#: Of schemes that are of their declared order only in attitudes whose axis of turning moves: the order in all
#: that does not depend on those.
ELSEWHERE = {"RK4 of body velocities": 4}


class Fit(NamedTuple):
    """A fitted order, its standard error, and how many steps it rests on."""

    order: float
    uncertainty: float
    steps: int


def check(ladder: Sequence[Cell]) -> list[Verdict]:
    """Order and limit of every state observable, from cells that differ in their step alone.

    Steps coarser than the scene's own ladder are left out: there the scheme's error need not fall with
    its order yet. Where too few others were run, one verdict says so.
    """
    by_step = {cell.provenance.dt: cell for cell in ladder}
    every = [by_step[dt] for dt in sorted(by_step, reverse=True)]
    if len(every) < STEPS:
        return []
    coarsest = _coarsest(every[0])
    cells = [cell for cell in every if cell.provenance.dt <= coarsest * (1 + 1e-9)]
    if len(cells) < STEPS:
        message = (
            f"order not measured: {len(cells)} of {len(every)} steps are within {coarsest:g} s, up to which "
            f"this scene tells it; {STEPS} are needed"
        )
        return [every[-1].verdict("order", "state", Status.UNSUPPORTED, message)]
    states = [o for o in cells[0].scene.observables if o.kind == "state"]
    return [verdict for o in states for verdict in (_order(cells, o), _limit(cells, o))]


def partly(cells: Iterable[Cell]) -> set[Ladder]:
    """Those of which some step is missing: of the scheme's ladder, or the scene's own."""
    there: dict[Ladder, set[float]] = defaultdict(set)
    asked: dict[Ladder, set[float]] = {}
    for cell in cells:
        scene, p = cell.scene, cell.provenance
        there[ladder_of(p)].add(p.dt)
        asked[ladder_of(p)] = {scene.whole_step(dt) for dt in (*scene.ladder(p.order, p.twin), scene.dt)}
    return {ladder for ladder in there if asked[ladder] - there[ladder]}


def fit(dts: Array, errors: Array) -> Fit:
    """Slope of log error over log dt by least squares, with its standard error."""
    x, y = np.log(dts), np.log(errors)
    x = x - x.mean()
    slope = float(x @ y / (x @ x))
    residual = y - y.mean() - slope * x
    spread = float(np.sqrt(residual @ residual / max(1, len(x) - 2) / (x @ x)))
    return Fit(slope, spread, len(x))


def _coarsest(cell: Cell) -> float:
    """The coarsest step [s] of the ladder of its scene and scheme; infinite where there is none."""
    scene, p = cell.scene, cell.provenance
    ladder = scene.ladder(p.order, p.twin)
    return max(map(scene.whole_step, ladder)) if len(ladder) > 1 else float("inf")


def _order(cells: Sequence[Cell], observable: Observable) -> Verdict:
    errors = np.array([cell.error(observable) for cell in cells])
    dts = np.array([cell.provenance.dt for cell in cells])
    floors = np.array([cell.floor(observable) for cell in cells])
    finest, p = cells[-1], cells[-1].provenance
    elsewhere = ELSEWHERE.get(p.twin)
    if np.all(errors <= floors):
        return _exact(cells, observable)
    clear = errors > ABOVE * floors
    if clear.sum() < FEWEST:
        message = (
            f"only {clear.sum()} of {len(cells)} steps are clear of round-off, expected {FEWEST} or more"
        )
        # The steps are those of the declared order: one that is higher here may well be out of their sight.
        status = Status.UNSUPPORTED if elsewhere else Status.FAIL
        return finest.verdict("order", observable.name, status, message)
    found = fit(dts[clear], errors[clear])
    off = min(abs(found.order - declared) for declared in (p.order, elsewhere or p.order))
    also = f", and {elsewhere} in what no turning axis enters" if elsewhere else ""
    message = (
        f"fitted order {found.order:.3f} ± {found.uncertainty:.3f} over {found.steps} steps "
        f"from {dts[clear][0]:g} s to {dts[clear][-1]:g} s, declared {p.order}{also}"
    )
    status = Status.PASS if off <= TOLERANCE else Status.FAIL
    return finest.verdict("order", observable.name, status, message, off, TOLERANCE, "1")


def _exact(cells: Sequence[Cell], observable: Observable) -> Verdict:
    """No error at any step: right only where the scheme has none, and else not from an integration."""
    finest, steps = cells[-1], f"exact to round-off at all {len(cells)} steps"
    own, coarse = max((truth.own_error(cell, observable) or 0.0, cell.provenance.dt) for cell in cells)
    if own <= ABOVE * finest.floor(observable):
        message = f"{steps}: there is no order to measure"
        return finest.verdict("order", observable.name, Status.PASS, message)
    message = (
        f"{steps}, although the scheme's own error is {own:.2g} {observable.unit} at dt {coarse:g} s: "
        f"too good to be an integration of order {finest.provenance.order}"
    )
    return finest.verdict("order", observable.name, Status.FAIL, message)


def _limit(cells: Sequence[Cell], observable: Observable) -> Verdict:
    """Richardson's limit: signed errors extrapolated to a step of zero."""
    finest, order = cells[-1], cells[0].provenance.order
    apart = _apart(cells)
    cells = apart if len(apart) >= FEWEST else cells
    dts = [cell.provenance.dt for cell in cells]
    differences = [observable.difference(c.scene, c.trajectory, c.truth) for c in cells]
    limit, previous = extrapolated(dts, differences, order)
    # Rounding counts as the extrapolation weighs it: 7.3 times where steps halve and the order is 1.
    weight = max(2.0, float(np.abs(_weights(dts, order)).sum()))
    noise = weight * max(cell.floor(observable) for cell in cells)
    # What the last step of the extrapolation still changed bounds what the next one would.
    last_change = float(np.max(np.linalg.norm(limit - previous, axis=1)))
    raw = finest.error(observable)
    allowed = min(last_change, raw) + noise
    return finest.compared(
        "truth", observable, np.linalg.norm(limit, axis=1), allowed,
        f"distance of the ladder's limit at dt = 0 from the truth; the finest step alone is at {raw:.2e}",
        name=f"{observable.name}, limit",
    )  # fmt: skip


def _apart(cells: Sequence[Cell]) -> Sequence[Cell]:
    """Those whose steps are far enough apart to extrapolate from, the finest first of all."""
    kept = [cells[-1]]
    for cell in reversed(cells):
        if cell.provenance.dt >= APART * (1 - 1e-9) * kept[0].provenance.dt:
            kept.insert(0, cell)
    return kept


def extrapolated(dts: Sequence[float], values: Sequence[Array], order: int) -> tuple[Array, Array]:
    """Limit at dt = 0 of values with an error Σ c_k dt^k, k from ``order``, and the limit before it.

    Steps from the coarsest to the finest; the second result leaves out the coarsest.
    """
    return _fitted(dts, values, order), _fitted(dts[1:], values[1:], order)


def _fitted(dts: Sequence[float], values: Sequence[Array], order: int) -> Array:
    return np.asarray(np.tensordot(_weights(dts, order), np.asarray(values), axes=1))


def _weights(dts: Sequence[float], order: int) -> Array:
    """What each step counts in the limit (n,): their sum is 1."""
    scaled = np.asarray(dts) / dts[0]
    powers = [np.ones_like(scaled), *(scaled ** (order + k) for k in range(len(dts) - 1))]
    return np.asarray(np.linalg.solve(np.column_stack(powers).T, np.eye(len(dts))[0]))
