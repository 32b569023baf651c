"""Every wrong engine that Poinsot is measured by: each a few lines around a real one, wrong in one way.

``CATALOGUE`` holds them all, by name. The tests ask that each is caught by the checks that are meant to,
and ``benchmarks/discernment.py`` publishes how many are, and down to what size.
"""

from . import (
    bodies,
    clocks,
    contacts,
    defaults,
    gravity,
    reactions,
    schemes,
    springs,
    stability,
    starts,
    telling,
    terms,
    whims,
)
from .entry import Family, Sight, Wrong

__all__ = ["CATALOGUE", "FAMILIES", "Family", "Sight", "Wrong"]

_FILES = (
    bodies,
    gravity,
    terms,
    defaults,
    springs,
    starts,
    contacts,
    telling,
    reactions,
    clocks,
    schemes,
    stability,
    whims,
)
CATALOGUE: dict[str, Wrong] = {wrong.name: wrong for file in _FILES for wrong in file.WRONG}
#: Faults of any size, each once.
FAMILIES: tuple[Family, ...] = tuple(
    dict.fromkeys(wrong.family for wrong in CATALOGUE.values() if wrong.family is not None)
)
