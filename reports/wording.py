"""How every report writes a number, a list, a status: fixed precision, the same words everywhere."""

import math
import re
from collections.abc import Iterable

from .verdict import Status

#: One character for each status, so that no table depends on colour.
GLYPHS = {
    Status.PASS: "✓",
    Status.FAIL: "✗",
    Status.KNOWN: "K",
    Status.FIXED: "!",
    Status.UNSUPPORTED: "–",
    Status.UNAVAILABLE: "?",
    Status.ERROR: "E",
}

NOT_RUN = "This scene was not run in this scheme."
PARTIAL = "What was checked passes; some checks could not be made."

#: What neither XML, HTML nor a terminal takes: controls, odd line ends, surrogates, noncharacters.
_UNPRINTABLE = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u2028\u2029\ud800-\udfff\ufffe\uffff]")


def number(value: float | None) -> str:
    """Three significant digits in scientific form, so that columns align and diffs are clean."""
    if value is None:
        return "–"
    return f"{value:.2e}" if math.isfinite(value) else "not finite"


def steps(every: Iterable[float]) -> str:
    """Step sizes with their name and unit."""
    return f"dt {', '.join(number(dt) for dt in every)} s"


def printable(text: str) -> str:
    r"""``text`` with every character that no reader can be given spelt out, as in ``\x1b``."""
    return _UNPRINTABLE.sub(lambda found: f"\\x{ord(found[0]):02x}", text)


def count(n: int, noun: str) -> str:
    """How many there are: 1 cell, 2 cells."""
    return f"{n} {noun}" if n == 1 else f"{n} {noun}s"


def listed(words: Iterable[str], most: int = 4) -> str:
    """The first ``most`` of ``words``, and how many more there are."""
    every = list(words)
    if len(every) > most + 1:
        every = [*every[:most], f"{len(every) - most} more"]
    return " and ".join([", ".join(every[:-1]), every[-1]]) if len(every) > 1 else "".join(every)


def share(x: float) -> str:
    """A relative change in words: 0.1 % high."""
    return f"{abs(100 * x):.3g} % {'high' if x > 0 else 'low'}"
