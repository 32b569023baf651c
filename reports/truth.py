"""Truth and invariants at a finite step: no further from the exact motion than the scheme's own error."""

from ..scenarios.observables import Observable
from .cell import Cell
from .verdict import Verdict

#: A recorded error constant is granted this factor: the next term of the error's expansion in dt.
MARGIN = 1.5


def check(cell: Cell) -> list[Verdict]:
    """Verdicts on every observable of the scene for which the scheme's own error is known."""
    verdicts = [verdict for observable in cell.scene.observables for verdict in _judged(cell, observable)]
    return [verdict for verdict in verdicts if verdict is not None]


def without_constant(cell: Cell) -> list[str]:
    """Observables whose error at a finite step nothing is recorded of, for this scheme."""
    return [o.name for o in cell.scene.observables if own_error(cell, o) is None]


def own_error(cell: Cell, observable: Observable) -> float | None:
    """How far the scheme itself is from the truth at this step; ``None`` where nothing is known of it."""
    if cell.predicted is not None:
        return cell.own_error(observable)
    p = cell.provenance
    constant = cell.scene.error_constant(p.twin, observable)
    if constant is None or p.dt > max(cell.scene.ladder(p.order, p.twin)) * (1 + 1e-9):
        # A constant holds on the ladder it was measured on and below it, not at coarser steps.
        return None
    return constant * p.dt**p.order


def _judged(cell: Cell, observable: Observable) -> list[Verdict]:
    kind = "invariant" if observable.kind == "invariant" else "truth"
    found = _allowed(cell, observable)
    verdicts = []
    if found is not None:
        allowed, reason = found
        verdicts.append(cell.compared(kind, observable, cell.distance(observable), allowed, reason))
    if cell.predicted is not None and observable.kind == "state":
        distances = observable.distance(cell.scene, cell.trajectory, cell.predicted)
        verdicts.append(
            cell.compared(
                "truth", observable, distances, cell.floor(observable),
                f"distance from the scheme's own exact motion; only round-off is allowed{cell.granted}",
                name=f"{observable.name}, scheme's own",
            )
        )  # fmt: skip
    return verdicts


def _allowed(cell: Cell, observable: Observable) -> tuple[float, str] | None:
    """Largest distance allowed, and why."""
    own, floor = own_error(cell, observable), cell.floor(observable)
    if own is None:
        return None
    if cell.predicted is not None:
        reason = "the scheme's own error, predicted in closed form, and round-off are allowed"
        return own * (1 + 1e-6) + floor, f"{_WORDS[observable.kind]}; {reason}{cell.granted}"
    p = cell.provenance
    constant = cell.scene.error_constant(p.twin, observable)
    reason = f"{MARGIN} × {constant:.3g}·dt^{p.order}, the scheme's own error as recorded, and round-off"
    return MARGIN * own + floor, f"{_WORDS[observable.kind]}; {reason} are allowed{cell.granted}"


_WORDS = {
    "state": "distance from the exact motion",
    "rate": "difference from the exact rate",
    "invariant": "change from the exact value at the start",
}
