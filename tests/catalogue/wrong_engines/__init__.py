"""Every wrong engine that Poinsot is measured by: each a few lines around a real one, wrong in one way.

``CATALOGUE`` holds them all, by name. The tests ask that each is caught by the checks that are meant to,
and ``benchmarks/discernment.py`` publishes how many are, and down to what size.
"""

from . import bodies, clocks, defaults, gravity, reactions, schemes, springs, stability, telling, terms, whims
from .entry import Sight, Wrong

__all__ = ["CATALOGUE", "Sight", "Wrong"]

_FILES = (bodies, gravity, terms, defaults, springs, telling, reactions, clocks, schemes, stability, whims)
CATALOGUE: dict[str, Wrong] = {wrong.name: wrong for file in _FILES for wrong in file.WRONG}
