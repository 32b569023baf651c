"""Eigenvalues and vectors of a symmetric pair (T, V) in extended precision: Va = λTa.

Where long double is no wider than double (it is wider on x86-64 Linux) the results are good to a few
units in the last place of double instead of half a unit.

Source: Goldstein, *Classical Mechanics*, § 6.2; the refinement is that of Ogita & Aishima, *Japan J.
Indust. Appl. Math.* 35 (2018) 1007, for one matrix, with T added.
"""

import numpy as np
import numpy.typing as npt

from .checked import Array, finite
from .errors import InputError

Long = npt.NDArray[np.longdouble]

_EPS = float(np.finfo(np.float64).eps)


def eigenpairs(T: Array, V: Array) -> tuple[Long, Long]:
    """λ (n,), ascending, and A (n, n) with AᵀTA = 1, AᵀVA = diag(λ), of what `energy_matrices` returned.

    A λ that rounding the entries of V could have made is 0. Of each column of A, the first entry above
    half its largest is positive. Raises InputError if T is not positive definite.
    """
    import scipy.linalg  # scenes are listed without it

    # Powers of two scale exactly, so matrices that are singular in double stay so.
    scale = np.exp2(np.round(-np.log2(np.diagonal(T)) / 2))
    masses, stiffness = (scale[:, None] * matrix * scale for matrix in (T, V))
    try:
        A = scipy.linalg.eigh(stiffness, masses)[1].astype(np.longdouble)
    except np.linalg.LinAlgError as cause:
        raise InputError(f"T: got {T.tolist()}, expected a positive definite matrix") from cause
    # Each step squares the error, which is 1e-13 or, with masses a million times apart, 1e-9.
    for _ in range(3):
        A = _refined(masses, stiffness, A)
    eigenvalues = _rayleigh(stiffness, A)
    order = np.argsort(eigenvalues, kind="stable")
    A = A[:, order] * scale[:, None].astype(np.longdouble)
    leading = np.argmax(np.abs(A) > 0.5 * np.abs(A).max(axis=0), axis=0)
    return eigenvalues[order], A * np.sign(A[leading, np.arange(len(A))])


def energy_matrices(T: npt.ArrayLike, V: npt.ArrayLike) -> tuple[Array, Array]:
    """T and V (n, n) as symmetric arrays of one size; raises InputError if they are not that."""
    masses, stiffness = symmetric("T", T), symmetric("V", V)
    if masses.shape != stiffness.shape:
        raise InputError(f"T, V: got shapes {masses.shape} and {stiffness.shape}, expected two equal ones")
    if np.any(np.diagonal(masses) <= 0):
        raise InputError(f"T: got diagonal {np.diagonal(masses).tolist()}, expected entries above 0")
    return masses, stiffness


def symmetric(name: str, value: npt.ArrayLike) -> Array:
    """``value`` (n, n) as an exactly symmetric array; raises InputError beyond a rounding of 4 eps."""
    matrix = finite(name, value, (-1, -1))
    if matrix.shape[0] != matrix.shape[1] or matrix.size == 0:
        raise InputError(f"{name}: got an array of shape {matrix.shape}, expected a square matrix")
    if np.any(np.abs(matrix - matrix.T) > 4 * _EPS * np.abs(matrix).max()):
        raise InputError(f"{name}: got {matrix.tolist()}, expected a symmetric matrix")
    return matrix / 2 + matrix.T / 2


def _refined(T: Array, V: Array, A: Long) -> Long:
    # Symmetric to the last bit, or rounding over a small gap would spoil the orthogonality.
    excess = np.eye(len(T)) - _upper(A.T @ (T @ A))
    S = _upper(A.T @ (V @ A))
    eigenvalues = np.diagonal(S)
    gap = eigenvalues - eigenvalues[:, None]
    unsettled = np.linalg.norm((S - np.diag(np.diagonal(S))).astype(np.float64))
    unsettled += np.abs(eigenvalues).max() * np.linalg.norm(excess.astype(np.float64))
    apart = np.abs(gap) > 2 * unsettled
    # Where eigenvalues are equal only orthogonality is left to ask for.
    return A + A @ np.where(apart, (S + eigenvalues * excess) / np.where(apart, gap, 1), excess / 2)


def _upper(matrix: Long) -> Long:
    return np.triu(matrix) + np.triu(matrix, 1).T


def _rayleigh(V: Array, A: Long) -> Long:
    eigenvalues = np.einsum("ik,ij,jk->k", A, V, A)
    # What a relative change of a few eps in the entries of V can do to aᵀVa.
    rounding = len(V) * _EPS * np.einsum("ik,ij,jk->k", np.abs(A), np.abs(V), np.abs(A))
    # And what the rounding of a itself can do to the 0 of a direction that V does not see.
    rounding += (len(V) * np.finfo(np.longdouble).eps * np.abs(A).max(axis=0)) ** 2 * np.abs(V).max()
    return np.where(np.abs(eigenvalues) <= rounding, 0, eigenvalues)
