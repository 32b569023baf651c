"""Inertia tensors: of point masses, about another point, about an axis, in principal axes.

Tensors (3, 3) [kg m²] are symmetric with I_xy = −Σ m x y off the diagonal, so that L = Iω.
Source: Goldstein, *Classical Mechanics*, §§ 5.3–5.4; Landau & Lifshitz, *Mechanics*, § 32.
"""

import numpy as np
import numpy.typing as npt

from .checked import Array, finite, not_negative, unit_quaternion
from .eigenpairs import Long, eigenpairs, symmetric
from .errors import InputError
from .quaternions import matrix

#: Rounding of a tensor's entries that its least moment and its triangle inequality are forgiven, in
#: units of 2⁻⁵² of the largest moment: an entry is a sum of products, moved and turned a few times.
_FORGIVEN = 16 * float(np.finfo(np.float64).eps)


def of_points(masses: npt.ArrayLike, positions: npt.ArrayLike) -> Array:
    """Tensor about the origin of masses (n,) [kg] at positions (n, 3) [m]: Σ m (r²1 − r rᵀ).

    Raises InputError if shapes do not fit or a mass is not positive. Source: Goldstein eq. (5.17).
    """
    m, r = _masses(masses, positions)
    squares = np.sum(m * r**2, axis=0)
    products = (m * r).T @ r
    # Σ m (y² + z²) and so on as sums: Σ m r² − Σ m x² would lose the small moment of a thin body.
    return np.diag(squares[[1, 2, 0]] + squares[[2, 0, 1]]) - np.where(np.eye(3), 0, products)


def centre_of(masses: npt.ArrayLike, positions: npt.ArrayLike) -> Array:
    """Centre of mass (3,) [m] of masses (n,) [kg] at positions (n, 3) [m]; raises as `of_points`."""
    m, r = _masses(masses, positions)
    return np.asarray(np.sum(m * r, axis=0) / np.sum(m))


def about_point(inertia: npt.ArrayLike, mass: float, offset: npt.ArrayLike) -> Array:
    """Tensor about a point at ``offset`` (3,) [m] from the centre of mass: I + M(a²1 − a aᵀ).

    Every product takes part: −M a_y a_z too, which some notes print as 0. Raises InputError if the
    tensor about the centre is none of a body (`physical`) or the mass is negative.
    Source: Goldstein eq. (5.21) for the whole tensor; Landau & Lifshitz eq. (32.12).
    """
    return physical(inertia) + _displacement(mass, offset)


def about_centre(inertia: npt.ArrayLike, mass: float, offset: npt.ArrayLike) -> Array:
    """Tensor about the centre of mass, of one about a point at ``offset`` (3,) [m] from that centre.

    Raises InputError if what remains is no tensor of a body: the point was too far. Source: `about_point`.
    """
    about = physical(inertia)
    largest = float(np.abs(about).max())
    return _body_tensor("inertia about the centre", about - _displacement(mass, offset), largest)


def turned(inertia: npt.ArrayLike, q: npt.ArrayLike) -> Array:
    """R I Rᵀ: the tensor of a body turned by q (4,), or of body axes seen in the world.

    Raises InputError unless the tensor is a body's and q a unit quaternion. Source: Goldstein § 5.2.
    """
    R = matrix(unit_quaternion("q", q))
    result = R @ physical(inertia) @ R.T
    return np.asarray(result / 2 + result.T / 2)


def about_axis(inertia: npt.ArrayLike, axis: npt.ArrayLike) -> float:
    """Moment n·I·n [kg m²] about an axis (3,) of any length above 0 through the tensor's point.

    Raises InputError for a tensor that is no body's or an axis without direction.
    Source: Goldstein eq. (5.18).
    """
    direction = finite("axis", axis, (3,))
    longest = float(np.abs(direction).max())
    if longest == 0:
        raise InputError("axis: got (0, 0, 0), expected a direction")
    # Scaled first: the square of a tiny component would be 0.
    n = direction / longest
    n = n / np.linalg.norm(n)
    return float(n @ physical(inertia) @ n)


def lamina(plane: npt.ArrayLike) -> Array:
    """Tensor of a flat body from its block ((I_xx, I_xy), (I_xy, I_yy)) in its own plane.

    Perpendicular axes: I_zz = I_xx + I_yy. Raises InputError if a moment in the plane is negative:
    ((1, 2), (2, 3)), which some notes use as an example, is no body's. Source: Goldstein ch. 5.
    """
    block = symmetric("plane", plane)
    if block.shape != (2, 2):
        raise InputError(f"plane: got an array of shape {block.shape}, expected (2, 2)")
    tensor = np.zeros((3, 3))
    tensor[:2, :2], tensor[2, 2] = block, np.trace(block)
    return _body_tensor("plane", tensor, float(np.abs(tensor).max()))


def principal(inertia: npt.ArrayLike) -> tuple[Array, Array]:
    """Principal moments (3,) [kg m²], ascending, and axes (3, 3), one a column, right-handed.

    The moments are correctly rounded but for a unit in the last place, small ones beside large ones
    too; the axes of equal moments are orthogonal and otherwise arbitrary.
    Raises InputError for a tensor that is no body's. Source: Goldstein § 5.4.
    """
    moments, axes = _eigen(physical(inertia))
    if np.linalg.det(axes.astype(np.float64)) < 0:
        axes[:, 2] *= -1
    return np.maximum(moments, 0).astype(np.float64), axes.astype(np.float64)


def physical(inertia: npt.ArrayLike) -> Array:
    """``inertia`` (3, 3), exactly symmetric, if a body can have it; else InputError.

    No moment below 0 and none above the sum of the other two, but for rounding (16 eps of the largest).
    A body on a line (one moment 0) and a lamina pass. Source: Landau & Lifshitz § 32, I1 + I2 ≥ I3.
    """
    tensor = symmetric("inertia", inertia)
    if tensor.shape != (3, 3):
        raise InputError(f"inertia: got an array of shape {tensor.shape}, expected (3, 3)")
    return _body_tensor("inertia", tensor, float(np.abs(tensor).max()))


def _body_tensor(name: str, tensor: Array, scale: float) -> Array:
    moments = _eigen(tensor)[0].astype(np.float64)
    slack = _FORGIVEN * scale
    if moments[0] < -slack:
        raise InputError(f"{name}: got principal moments {moments.tolist()}, expected none below 0")
    if moments[2] - moments[1] - moments[0] > slack:
        raise InputError(
            f"{name}: got principal moments {moments.tolist()}, whose largest exceeds the sum of the other "
            "two; no body has such moments"
        )
    return tensor


def _eigen(tensor: Array) -> tuple[Long, Long]:
    return eigenpairs(np.eye(3), tensor)


def _displacement(mass: float, offset: npt.ArrayLike) -> Array:
    a = finite("offset", offset, (3,))
    return np.asarray(not_negative("mass", mass) * (np.dot(a, a) * np.eye(3) - np.outer(a, a)))


def _masses(masses: npt.ArrayLike, positions: npt.ArrayLike) -> tuple[Array, Array]:
    r = finite("positions", positions, (-1, 3))
    m = finite("masses", masses, (len(r),))
    if len(m) == 0 or np.any(m <= 0):
        raise InputError(f"masses: got {m.tolist()}, expected at least one, all above 0")
    return m[:, None], r
