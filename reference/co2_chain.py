"""Longitudinal vibrations of a linear three-atom molecule: m – k – M – k – m.

Source: Goldstein, *Classical Mechanics*, § 6.4 (free vibrations of a linear triatomic molecule);
Landau & Lifshitz, *Mechanics*, § 24 (vibrations of molecules), problem 1.
"""

import numpy as np
import numpy.typing as npt

from .checked import Array, finite, positive
from .errors import InputError


def energies(m: float, M: float, k: float) -> tuple[Array, Array]:
    """T and V (3, 3) [kg, N/m] for end masses m, middle mass M [kg] and springs k [N/m].

    Raises InputError unless all are positive. Source: Goldstein § 6.4.
    """
    m, M, k = positive("m", m), positive("M", M), positive("k", k)
    V = k * np.array([[1.0, -1.0, 0.0], [-1.0, 2.0, -1.0], [0.0, -1.0, 1.0]])
    return np.diag([m, M, m]), V


def frequencies(m: float, M: float, k: float) -> Array:
    """0, √(k/m) and √(k/m · (1 + 2m/M)) (3,) [rad/s]: drift, symmetric, antisymmetric stretch.

    Raises InputError unless all are positive. Source: Goldstein § 6.4.
    """
    m, M, k = positive("m", m), positive("M", M), positive("k", k)
    return np.sqrt([0.0, k / m, k / m + 2 * k / M])


def modes(m: float, M: float) -> Array:
    """Modes as columns (3, 3) [kg^-½] in the order of `frequencies`, AᵀTA = 1.

    All atoms alike; the ends against each other; the ends together against the middle.
    Raises InputError unless both masses are positive. Source: Goldstein § 6.4.
    """
    m, M = positive("m", m), positive("M", M)
    drift = np.ones(3) / np.sqrt(2 * m + M)
    symmetric = np.array([1.0, 0.0, -1.0]) / np.sqrt(2 * m)
    antisymmetric = np.array([1.0, -2 * m / M, 1.0]) / np.sqrt(2 * m * (1 + 2 * m / M))
    return np.column_stack([drift, symmetric, antisymmetric])


def normal_coordinates(m: float, M: float, eta: npt.ArrayLike) -> Array:
    """ξ (..., 3) [m kg^½] of displacements η (..., 3) [m], in the order of `frequencies`.

    ξ1 = (mη1 + Mη2 + mη3)/√(2m + M), ξ2 = √(m/2) (η1 − η3),
    ξ3 = √(mM/(2(2m + M))) (η1 + η3 − 2η2); some notes print ξ3 without the first 2 and with √2 for
    the second, which is not normalised and not free of the drift.

    Raises InputError unless both masses are positive and η ends in three components.
    Source: Goldstein §§ 6.3–6.4.
    """
    m, M = positive("m", m), positive("M", M)
    displaced = finite("eta", eta)
    if displaced.ndim == 0 or displaced.shape[-1] != 3:
        raise InputError(f"eta: got shape {displaced.shape}, expected (..., 3)")
    first, middle, last = np.moveaxis(displaced, -1, 0)
    drift = (m * (first + last) + M * middle) / np.sqrt(2 * m + M)
    symmetric = np.sqrt(m / 2) * (first - last)
    antisymmetric = np.sqrt(m * M / (2 * (2 * m + M))) * ((first - middle) + (last - middle))
    return np.stack([drift, symmetric, antisymmetric], axis=-1)
