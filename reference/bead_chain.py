"""A line of N equal beads joined by equal springs, moving along the line.

Source: Fetter & Walecka, *Theoretical Mechanics of Particles and Continua*, ch. 4 (small oscillations,
many degrees of freedom); the waves are those of a lattice, e.g. Kittel, *Introduction to Solid State
Physics*, ch. 4 (one atom per cell).
"""

from typing import Literal

import numpy as np

from .checked import Array, positive
from .errors import InputError

#: What holds the two ends: walls by a spring each, a wall on the left only, nothing, or each other.
Ends = Literal["walls", "wall", "free", "ring"]

ENDS: tuple[Ends, ...] = ("walls", "wall", "free", "ring")


def energies(beads: int, m: float, k: float, ends: Ends = "walls") -> tuple[Array, Array]:
    """T and V (N, N) [kg, N/m] for beads of mass m [kg] and springs k [N/m].

    Raises InputError for fewer than one bead (three in a ring), m or k not positive, or other ends.
    Source: Fetter & Walecka ch. 4.
    """
    beads = _count(beads, ends)
    m, k = positive("m", m), positive("k", k)
    # One row for each spring: its stretch as a function of the beads' displacements.
    stretch = np.eye(beads + 1, beads) - np.eye(beads + 1, beads, k=-1)
    if ends == "ring":
        stretch[0, -1] = -1
    first = 1 if ends == "free" else 0
    last = beads + 1 if ends == "walls" else beads
    springs = stretch[first:last]
    return m * np.eye(beads), k * (springs.T @ springs)


def frequencies(beads: int, m: float, k: float, ends: Ends = "walls") -> Array:
    """All N frequencies (N,) [rad/s], ascending: ω = 2√(k/m) sin(κ/2), κ the phase step per bead.

    κ = jπ/(N + 1) between walls, (2j − 1)π/(2N + 1) on one wall (j = 1 … N); jπ/N when free and
    2πj/N in a ring (j = 0 … N − 1, a ring's pairs equal).

    Raises as `energies` does. Source: Fetter & Walecka ch. 4.
    """
    beads = _count(beads, ends)
    m, k = positive("m", m), positive("k", k)
    from_zero, from_one = np.arange(beads), np.arange(1, beads + 1)
    step = {
        "walls": from_one * np.pi / (beads + 1),
        "wall": (2 * from_one - 1) * np.pi / (2 * beads + 1),
        "free": from_zero * np.pi / beads,
        # 0, 1, 1, 2, 2 …: waves that run either way round are equally fast.
        "ring": (from_zero + 1) // 2 * 2 * np.pi / beads,
    }[ends]
    return np.asarray(2 * np.sqrt(k / m) * np.sin(step / 2))


def _count(beads: int, ends: Ends) -> int:
    if ends not in ENDS:
        raise InputError(f"ends: got {ends!r}, expected one of {', '.join(ENDS)}")
    fewest = 3 if ends == "ring" else 1
    if int(beads) != beads or beads < fewest:
        raise InputError(f"beads: got {beads!r}, expected a whole number from {fewest} up")
    return int(beads)
