"""Volume, centre and inertia of uniform solids, in closed form.

The z axis is the axis of symmetry. A solid of density ρ has mass ρ·volume and, about its centre of mass,
the tensor mass·inertia: ``inertia`` is that of one kilogram [m²].

Source: Landau & Lifshitz, *Mechanics*, § 32, problem 2; Goldstein, *Classical Mechanics*, ch. 5 and its
exercises. Each follows from ∫(r²1 − r rᵀ)dV by hand; lengths are in metres and must be above 0.
"""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from .checked import Array, finite, not_negative, positive
from .errors import InputError
from .inertia import about_point, centre_of, of_points


class Solid(NamedTuple):
    """Volume [m³], centre of mass (3,) [m] and inertia (3, 3) of one kilogram about that centre [m²]."""

    volume: float
    centre: Array
    inertia: Array


def sphere(radius: float) -> Solid:
    """Solid sphere about the origin: 2/5 r². Source: Landau & Lifshitz § 32, problem 2(b)."""
    r = positive("radius", radius)
    return _centred(4 / 3 * np.pi * r**3, 0.4 * r**2, 0.4 * r**2, 0.4 * r**2)


def hollow_sphere(inner: float, outer: float) -> Solid:
    """Sphere about the origin with a hollow: 2/5 (b⁵ − a⁵)/(b³ − a³), a < b, written without difference.

    As a comes to b it is the shell's 2/3 b². Source: sphere less sphere.
    """
    a, b = not_negative("inner", inner), positive("outer", outer)
    if a >= b:
        raise InputError(f"inner: got {a}, expected less than the outer radius {b}")
    squares = a**2 + a * b + b**2
    moment = 0.4 * (a**4 + a**3 * b + a**2 * b**2 + a * b**3 + b**4) / squares
    return _centred(4 / 3 * np.pi * (b - a) * squares, moment, moment, moment)


def box(x: float, y: float, z: float) -> Solid:
    """Box about the origin with these edges: (y² + z²)/12. Source: Landau & Lifshitz § 32, problem 2(f)."""
    x, y, z = positive("x", x), positive("y", y), positive("z", z)
    return _centred(x * y * z, (y**2 + z**2) / 12, (z**2 + x**2) / 12, (x**2 + y**2) / 12)


def cylinder(radius: float, height: float) -> Solid:
    """Cylinder about the origin: r²/4 + h²/12, r²/2. Source: Landau & Lifshitz § 32, problem 2(c)."""
    r, h = positive("radius", radius), positive("height", height)
    across = r**2 / 4 + h**2 / 12
    return _centred(np.pi * r**2 * h, across, across, r**2 / 2)


def capsule(radius: float, height: float) -> Solid:
    """Cylinder of ``height`` (0 or above) between two half spheres, about the origin.

    A half sphere's centre of mass is 3r/8 from its flat side. Source: the parts, by parallel axes.
    """
    r, h = positive("radius", radius), not_negative("height", height)
    straight, round_part = h / (h + 4 / 3 * r), 4 / 3 * r / (h + 4 / 3 * r)
    across = straight * (r**2 / 4 + h**2 / 12) + round_part * (0.4 * r**2 + h**2 / 4 + 3 / 8 * r * h)
    along = straight * r**2 / 2 + round_part * 0.4 * r**2
    return _centred(np.pi * r**2 * (h + 4 / 3 * r), across, across, along)


def ellipsoid(a: float, b: float, c: float) -> Solid:
    """Ellipsoid about the origin with these half axes: (b² + c²)/5. Source: L&L § 32, problem 2(e)."""
    a, b, c = positive("a", a), positive("b", b), positive("c", c)
    moments = (b**2 + c**2) / 5, (c**2 + a**2) / 5, (a**2 + b**2) / 5
    return _centred(4 / 3 * np.pi * a * b * c, *moments)


def cone(radius: float, height: float) -> Solid:
    """Cone with its tip at the origin, opening towards +z; centre 3h/4 from the tip.

    About the tip 3/20 (R² + 4h²) and 3/10 R², about the centre 3/20 (R² + h²/4). Source: Landau &
    Lifshitz § 32, problem 2(d).
    """
    R, h = positive("radius", radius), positive("height", height)
    across = 0.15 * (R**2 + h**2 / 4)
    solid = _centred(np.pi * R**2 * h / 3, across, across, 0.3 * R**2)
    return solid._replace(centre=np.array([0, 0, 0.75 * h]))


def cube_about_corner(mass: float, edge: float) -> Array:
    """Tensor (3, 3) [kg m²] of a cube about a corner, edges along +x, +y, +z.

    Ma²/12 ((8, −3, −3), (−3, 8, −3), (−3, −3, 8)); principal moments 2, 11, 11 of Ma²/12, the first
    about the diagonal. Source: Taylor, *Classical Mechanics*, examples 10.2 and 10.4.
    """
    a = positive("edge", edge)
    return about_point(positive("mass", mass) * box(a, a, a).inertia, mass, [-a / 2, -a / 2, -a / 2])


def molecule(masses: npt.ArrayLike, positions: npt.ArrayLike) -> tuple[Array, Array]:
    """Centre of mass (3,) [m] and tensor about it (3, 3) [kg m²] of atoms (n,) [kg] at (n, 3) [m].

    Over pairs, Σ m_a m_b (r_ab² 1 − r_ab r_abᵀ)/M: no difference of large numbers however far away the
    origin. Raises InputError if shapes do not fit or a mass is not positive.
    Source: Landau & Lifshitz § 32, problem 1.
    """
    m = finite("masses", masses, (-1,))
    r = finite("positions", positions, (len(m), 3))
    first, second = np.triu_indices(len(m), 1)
    centre = centre_of(m, r)
    if len(m) == 1:
        return centre, np.zeros((3, 3))
    return centre, of_points(m[first] * m[second] / np.sum(m), r[second] - r[first])


def _centred(volume: float, *moments: float) -> Solid:
    return Solid(float(volume), np.zeros(3), np.diag(moments))
