"""Stability: the largest step at which a scheme's energy stays bounded is the one that theory gives."""

import math

from ..adapters.runner import Failure
from ..adapters.stable_step import StableStep
from .cell import Cell
from .stability_results import Sweep
from .verdict import Status, Verdict

#: The limit is sought to 5e-3; a scheme that is another one by a part in a hundred is another one.
TOLERANCE = 0.01
NAME = "largest stable step"


def check(cell: Cell) -> list[Verdict]:
    """One verdict on the largest stable step, where it was sought."""
    found, theory = cell.provenance.stable_step, cell.scene.stable_step
    if theory is None or not found:
        return []
    held, grew = found
    status, measured, message = told(held, grew, theory(cell.scene, cell.provenance.twin))
    allowed = None if measured is None else TOLERANCE
    return [cell.verdict("stability", NAME, status, message, measured, allowed, "1")]


def verdict(scene: str, sweep: Sweep, dt: float, found: StableStep | Failure, limit: float | None) -> Verdict:
    """The verdict on a limit that a sweep found, or did not, in ``scene`` from a step of ``dt`` [s] on."""
    cell = (scene, sweep.engine, sweep.engine_version, sweep.scheme, dt, "stability", NAME)
    if isinstance(found, Failure):
        return Verdict(*cell, Status.ERROR, None, None, "1", None, str(found))
    status, measured, message = told(found.held, found.grew, limit)
    allowed = None if measured is None else TOLERANCE
    return Verdict(*cell, status, measured, allowed, "1", None, message)


def told(held: float, grew: float, limit: float | None) -> tuple[Status, float | None, str]:
    """Status, deviation and a sentence on what ``held`` and ``grew`` [s], for a theory's ``limit``."""
    seen = _seen(held, grew)
    if limit is None:
        return Status.UNSUPPORTED, None, f"no theory is known here for the scheme; measured: {seen}"
    error = deviation(held, grew, limit)
    status = Status.PASS if error <= TOLERANCE else Status.FAIL
    return status, error, f"{seen}; by theory {_limit(limit)}{_suspicion(held, grew, limit)}"


def deviation(held: float, grew: float, limit: float) -> float:
    """How far the limit between ``held`` and ``grew`` [s] is from that of theory, as a part of it.

    Infinite where one of the two has a limit and the other has none, or none of the same kind.
    """
    measured = between(held, grew)
    if limit in (0.0, math.inf) or measured in (0.0, math.inf):
        return 0.0 if measured == limit else math.inf
    return abs(measured / limit - 1)


def between(held: float, grew: float) -> float:
    """The limit [s] that was seen: 0 if every step grew, infinite if none did, else between the two."""
    return grew if math.isinf(grew) else math.sqrt(held * grew)


def bracket(held: float, grew: float) -> float:
    """How far from the middle the limit may be, as a part of it: half of what the halving left open.

    0 where no step that holds, or none that grows, was seen.
    """
    return 0.0 if not held or math.isinf(grew) else math.sqrt(grew / held) - 1


def _seen(held: float, grew: float) -> str:
    if math.isinf(grew):
        return f"energy stays bounded at every step up to {held:.4g} s, the largest tried"
    if not held:
        return f"energy grows already at a step of {grew:.4g} s, the smallest tried"
    return f"energy stays bounded up to a step of {held:.5g} s and grows from {grew:.5g} s on"


def _limit(limit: float) -> str:
    if limit == 0:
        return "it grows at any step"
    return "at any step" if math.isinf(limit) else f"up to {limit:.5g} s"


def _suspicion(held: float, grew: float, limit: float) -> str:
    """Better than theory is no praise."""
    if held <= limit * (1 + TOLERANCE):
        return ""
    return "; beyond what the scheme can do: smaller steps taken in secret, a clamp, a reset or damping"
