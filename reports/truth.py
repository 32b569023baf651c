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
    return [o.name for o in cell.scene.observables if _allowed(cell, o) is None]


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
                "truth", observable, distances, cell.round_off(observable),
                "distance from the scheme's own exact motion; only round-off is allowed",
                name=f"{observable.name}, scheme's own",
            )
        )  # fmt: skip
    return verdicts


def _allowed(cell: Cell, observable: Observable) -> tuple[float, str] | None:
    """Largest distance allowed, and why."""
    floor = cell.round_off(observable)
    if cell.predicted is not None:
        own = float(observable.distance(cell.scene, cell.predicted, cell.truth).max())
        return own * (1 + 1e-6) + floor, "error of the scheme, predicted in closed form, and round-off"
    p = cell.provenance
    constant = cell.scene.error_constant(p.twin, observable)
    if constant is None or p.dt > max(cell.scene.ladder(p.order, p.twin)) * (1 + 1e-9):
        # A constant holds on the ladder it was measured on and below it, not at coarser steps.
        return None
    return (
        MARGIN * constant * p.dt**p.order + floor,
        f"{MARGIN} × {constant:.3g}·dt^{p.order}, as recorded, and round-off",
    )
