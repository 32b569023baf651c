"""Blows: forces that act from one moment to another, and over which steps they do.

A blow acts over whole steps, at every stage of each, and at no stage of any other. Were it asked for at the
time of a stage, it would act at the first stage of a step that begins where it ends, or not at the last one
of a step before, which leaves an error of the first order in the step whatever the scheme.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ..reference.checked import Array, not_negative, number
from ..reference.errors import InputError
from .body import Body
from .forces import Constant, Force


@dataclass(frozen=True)
class Blow(Constant):
    """The same ``force`` (3,) [N] on one body from ``start`` to ``end`` [s], and none before and after.

    ``acting`` is what it does while it lasts; what energy it brings is none of the bodies' own.
    """

    start: float
    end: float

    def __post_init__(self) -> None:
        super().__post_init__()
        not_negative(f"start of the blow on {self.body!r}", self.start)
        if not number(f"end of the blow on {self.body!r}", self.end) > self.start:
            raise InputError(
                f"blow on {self.body!r}: got an end at {self.end} s, expected one after its start"
            )

    def refuse_between(self, apart: float, duration: float) -> None:
        """Raise ``InputError`` unless it starts and ends where samples are, ``apart`` [s]: on steps, then."""
        for name, moment in (("start", self.start), ("end", self.end)):
            off = abs(moment / apart - round(moment / apart))
            if off > 1e-9 or moment > duration * (1 + 1e-9):
                raise InputError(
                    f"blow on {self.body!r}: got its {name} at {moment:g} s, expected a multiple of "
                    f"{apart:g} s, the time between samples, up to {duration:g} s: no step is then cut"
                )

    def potential(self, bodies: Sequence[Body], position: Array) -> Array:
        """See ``Force``."""
        return np.zeros(len(position))


def at_work(forces: Sequence[Force], t: float) -> tuple[Force, ...]:
    """Those of ``forces`` that act from the time ``t`` [s] on."""
    return tuple(force for force in forces if not isinstance(force, Blow) or force.start <= t < force.end)


def lasting(forces: Sequence[Force]) -> tuple[Force, ...]:
    """``forces`` as if blows lasted for ever."""
    return tuple(Constant(f.body, f.force) if isinstance(f, Blow) else f for f in forces)


def over_step(forces: Sequence[Force], dt: float, step: int) -> tuple[Force, ...]:
    """Those of ``forces`` that act over the step of this number, from 0 on, each of ``dt`` [s]."""
    return at_work(forces, (step + 0.5) * dt)


def stretches(
    forces: Sequence[Force], dt: float, first: int, n: int
) -> Iterator[tuple[int, Sequence[Force]]]:
    """The ``n`` steps from the ``first`` on, cut where blows begin and end: how many, and what acts."""
    blows = [force for force in forces if isinstance(force, Blow)]
    if not blows:
        yield n, forces
        return
    edges = {round(t / dt) for blow in blows for t in (blow.start, blow.end)}
    cuts = sorted({first, first + n, *(edge for edge in edges if first < edge < first + n)})
    for begin, end in pairwise(cuts):
        yield end - begin, over_step(forces, dt, begin)
