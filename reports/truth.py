"""Truth and invariants at a finite step: no further from the exact motion than the scheme's own error."""

from ..scenarios.observables import Observable
from .cell import Cell
from .verdict import Status, Verdict

#: A recorded error constant is granted this factor: the next term of the error's expansion in dt.
MARGIN = 1.5


def check(cell: Cell) -> list[Verdict]:
    """Verdicts on every observable of the scene for which the scheme's own error is known."""
    verdicts = [verdict for observable in cell.scene.observables for verdict in _judged(cell, observable)]
    return [verdict for verdict in verdicts if verdict is not None]


def blind(cell: Cell, in_order: bool) -> list[Verdict]:
    """A verdict that says so where nothing of the motion at this step can be judged.

    ``in_order`` says whether the order of its ladder was.
    """
    p, missing = cell.provenance, without_constant(cell)
    states = {o.name for o in cell.scene.observables if o.kind == "state"}
    if not states <= set(missing) or (in_order and _on_ladder(cell)):
        return []
    message = (
        f"no error of {p.engine} {p.scheme} is recorded for {', '.join(missing)} at this step, and its order "
        "was not measured with it: what they may be off by is not known"
    )
    return [cell.verdict("truth", "state", Status.UNSUPPORTED, message)]


def without_constant(cell: Cell) -> list[str]:
    """Observables whose error at a finite step nothing is recorded of, for this scheme."""
    return [o.name for o in cell.scene.observables if own_error(cell, o) is None]


def own_error(cell: Cell, observable: Observable) -> float | None:
    """How far the scheme itself is from the truth at this step; ``None`` where nothing is known of it."""
    if cell.predicted is not None:
        return cell.own_error(observable)
    p = cell.provenance
    if observable.always and not cell.scene.errs_in(observable):
        return 0.0
    constant = cell.scene.error_constant(p.twin, observable)
    if constant is None or not _on_ladder(cell):
        # A constant holds on the ladder it was measured on and below it, not at coarser steps.
        return None
    return constant * p.dt**p.order


def _on_ladder(cell: Cell) -> bool:
    p = cell.provenance
    return p.dt <= max(cell.scene.ladder(p.order, p.twin)) * (1 + 1e-9)


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
    if constant is None or not own:
        return floor, f"{_WORDS[observable.kind]}; only round-off is allowed{cell.granted}"
    reason = f"{MARGIN} × {constant:.3g}·dt^{p.order}, the scheme's own error as recorded, and round-off"
    return MARGIN * own + floor, f"{_WORDS[observable.kind]}; {reason} are allowed{cell.granted}"


_WORDS = {
    "state": "distance from the exact motion",
    "rate": "difference from the exact rate",
    "invariant": "change from the exact value at the start",
}
