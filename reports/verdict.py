"""The outcome of one check on one cell."""

from dataclasses import dataclass
from enum import Enum

from ..scenarios.trajectory import Provenance

#: Scene, engine, its version and scheme: what is right or wrong as a whole, whatever the step.
Ladder = tuple[str, str, str, str]

#: The kinds of check there are.
CHECKS = (
    "truth",
    "order",
    "twin",
    "acceleration",
    "invariant",
    "setup",
    "stability",
    "determinism",
)


class Status(Enum):
    """How a check ended; the description is a sentence for people."""

    PASS = "pass"
    FAIL = "fail"
    KNOWN = "known"
    FIXED = "fixed"
    UNSUPPORTED = "unsupported"
    UNAVAILABLE = "unavailable"
    ERROR = "error"

    @property
    def sentence(self) -> str:
        """What this status means."""
        return _SENTENCES[self]

    @property
    def conforms(self) -> bool:
        """Whether a run that ends so may still exit with 0."""
        return self in (Status.PASS, Status.KNOWN, Status.UNSUPPORTED, Status.UNAVAILABLE)


_SENTENCES = {
    Status.PASS: "The engine does what it must.",
    Status.FAIL: "The engine does not do what it must.",
    Status.KNOWN: "A recorded deviation, inside its recorded bound.",
    Status.FIXED: "A recorded deviation that is gone: remove its record.",
    Status.UNSUPPORTED: "The engine lacks a feature that the scene needs.",
    Status.UNAVAILABLE: "The engine is not installed.",
    Status.ERROR: "The cell crashed, timed out, left the finite numbers, or reset itself.",
}


@dataclass(frozen=True)
class Verdict:
    """What one check found on one cell.

    ``check`` is the kind (truth, order, twin, acceleration, invariant, setup, stability,
    determinism), ``observable`` what was looked at. ``measured`` and ``allowed`` are in ``unit``;
    ``at`` is the time [s] of the worst sample. Each is ``None`` where there is no such number.
    """

    scene: str
    engine: str
    engine_version: str
    scheme: str
    dt: float
    check: str
    observable: str
    status: Status
    measured: float | None
    allowed: float | None
    unit: str
    at: float | None
    message: str


def ladder_of(source: Provenance | Verdict) -> Ladder:
    """The scene, engine, version and scheme of a cell or of a verdict on it."""
    return (source.scene, source.engine, source.engine_version, source.scheme)
