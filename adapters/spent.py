"""Seconds of the processor that this process spent on each part of a piece of work, all of it told apart."""

from collections import defaultdict
from collections.abc import Iterator
from contextlib import contextmanager
from time import process_time

#: What no part was named for.
REST = "rest"

_spent: defaultdict[str, float] = defaultdict(float)
_within: list[str] = []
_begun = 0.0


def forget() -> None:
    """Begin a new piece of work."""
    global _begun
    _spent.clear()
    _begun = process_time()


def so_far() -> dict[str, float]:
    """Seconds by part since the work began, with what is left over as ``REST``."""
    left = process_time() - _begun - sum(_spent.values())
    return {**_spent, REST: max(0.0, left)}


@contextmanager
def on(part: str) -> Iterator[None]:
    """Count what the block takes to ``part``; of a block within another, to the outer one's."""
    if _within:
        yield
        return
    _within.append(part)
    begun = process_time()
    try:
        yield
    finally:
        _spent[part] += process_time() - begun
        _within.pop()
