"""A body on a fixed axle along z: its angular momentum, what its bearings must do, and how to balance it.

Vectors are in axes that turn with the body, whose origin lies on the axle; tensors are about that
origin, with I_xz = −Σ m x z. Gravity is left out.

Source: Taylor, *Classical Mechanics*, § 10.2 (products of inertia) and §§ 10.3, 10.7 (Euler's equations);
Goldstein, *Classical Mechanics*, § 5.5 and its exercises on dynamic balance.
"""

import numpy as np
import numpy.typing as npt

from .checked import Array, finite, number, positive
from .errors import InputError
from .inertia import physical


def angular_momentum(inertia: npt.ArrayLike, omega: float) -> Array:
    """L = ω (I_xz, I_yz, I_zz) (3,) [kg m²/s] at ω [rad/s] about z: along the axle only if balanced.

    Raises InputError for a tensor that is no body's. Source: Taylor § 10.2.
    """
    return number("omega", omega) * physical(inertia)[:, 2]


def bearing_torque(inertia: npt.ArrayLike, omega: float, alpha: float = 0.0) -> Array:
    """Torque (3,) [N m] about the origin that axle and bearings exert on the body; it returns the opposite.

    dL/dt = Iα + ω×(Iω): at constant ω it is ω² (−I_yz, I_xz, 0), turning with the body. ``alpha`` is the
    angular acceleration [rad/s²]. Raises InputError for a tensor that is no body's.
    Source: Goldstein § 5.5, Euler's equations before the axes are made principal.
    """
    (Ixz, Iyz, Izz), w, a = physical(inertia)[:, 2], number("omega", omega), number("alpha", alpha)
    return np.array([Ixz * a - Iyz * w**2, Iyz * a + Ixz * w**2, Izz * a])


def axle_force(mass: float, centre: npt.ArrayLike, omega: float, alpha: float = 0.0) -> Array:
    """Force (3,) [N] that the bearings exert on the body: M(α×c + ω×(ω×c)), c (3,) its centre [m].

    0 when the centre is on the axle: static balance. Raises InputError for a mass not above 0.
    Source: Newton's second law for the centre of mass.
    """
    x, y, _ = finite("centre", centre, (3,))
    w, a = number("omega", omega), number("alpha", alpha)
    return positive("mass", mass) * np.array([-a * y - w**2 * x, a * x - w**2 * y, 0.0])


def bearing_forces(
    inertia: npt.ArrayLike,
    mass: float,
    centre: npt.ArrayLike,
    bearings: npt.ArrayLike,
    omega: float,
    alpha: float = 0.0,
) -> Array:
    """Transverse forces (2, 2) [N], rows (F_x, F_y), that two bearings at z (2,) [m] exert on the body.

    F1 + F2 is `axle_force`; −z1 F1y − z2 F2y and z1 F1x + z2 F2x are the torque of `bearing_torque`.
    Raises InputError as those two, or if the bearings are at one place.
    """
    force = axle_force(mass, centre, omega, alpha)
    return shared(bearings, force, bearing_torque(inertia, omega, alpha))


def shared(bearings: npt.ArrayLike, force: npt.ArrayLike, torque: npt.ArrayLike) -> Array:
    """Transverse forces (…, 2, 2) [N] of bearings at z (2,) [m] that make this force and torque together.

    ``force`` (…, 3) [N] and ``torque`` (…, 3) [N m] about the origin, on the body; rows as in
    `bearing_forces`. Raises InputError if the bearings are at one place or the shapes differ.
    """
    planes, total = _planes("bearings", bearings), finite("force", force, np.shape(force))
    turn = finite("torque", torque, total.shape)
    moment = np.stack([turn[..., 1], -turn[..., 0]], axis=-1)
    return _shared(planes, total[..., :2], moment)


def correction(inertia: npt.ArrayLike, mass: float, centre: npt.ArrayLike, planes: npt.ArrayLike) -> Array:
    """Unbalances Σ m (x, y) to add (2, 2) [kg m], a row for each plane at z (2,) [m], that balance it.

    Then the centre is on the axle and the axle is a principal axis: no force or torque at any speed.
    Raises InputError as `bearing_forces`. Source: two-plane balancing; I_xz = I_yz = 0 and c_x = c_y = 0.
    """
    tensor, c = physical(inertia), finite("centre", centre, (3,))
    return _shared(_planes("planes", planes), -positive("mass", mass) * c[:2], tensor[:2, 2])


def _planes(name: str, value: npt.ArrayLike) -> Array:
    planes = finite(name, value, (2,))
    if planes[0] == planes[1]:
        raise InputError(f"{name}: got both at z = {planes[0]}, expected two different places")
    return planes


def _shared(planes: Array, total: Array, moment: Array) -> Array:
    # Two rows u1, u2 with u1 + u2 = total and z1 u1 + z2 u2 = moment.
    first, second = planes
    rows = np.stack([second * total - moment, moment - first * total], axis=-2)
    return np.asarray(rows / float(second - first))
