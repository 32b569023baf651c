"""Volume, centre and inertia of uniform solids, in closed form.

The z axis is the axis of symmetry. A solid of density ρ has mass ρ·volume and, about its centre of mass,
the tensor mass·inertia: ``inertia`` is that of one kilogram [m²]. Of a shell ``volume`` is the area.

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
    """Volume [m³], centre of mass (3,) [m] and inertia (3, 3) of one kilogram about that centre [m²].

    Of a shell, all of whose mass is in its surface, the volume is the area [m²].
    """

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


def shell(radius: float) -> Solid:
    """Sphere about the origin that is all surface: 2/3 r². Source: `hollow_sphere` as a comes to b."""
    r = positive("radius", radius)
    return _centred(4 * np.pi * r**2, 2 / 3 * r**2, 2 / 3 * r**2, 2 / 3 * r**2)


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


def pyramid(sides: int, radius: float, height: float) -> Solid:
    """Pyramid, tip at the origin, opening towards +z on a regular polygon of this radius.

    About the centre, which is 3h/4 from the tip, 3/10 R²(2 + cos 2π/n)/3 along the axis, half of that and
    3/80 h² across it; with more and more sides, the cone. Source: the polygon of triangles about its middle.
    """
    R, h = positive("radius", radius), positive("height", height)
    if sides < 3:
        raise InputError(f"sides: got {sides}, expected at least 3")
    angle = 2 * np.pi / sides
    along = 0.1 * R**2 * (2 + np.cos(angle))
    across = along / 2 + 3 / 80 * h**2
    solid = _centred(sides / 6 * R**2 * np.sin(angle) * h, across, across, along)
    return solid._replace(centre=np.array([0, 0, 0.75 * h]))


def polyhedron(vertices: npt.ArrayLike, faces: npt.ArrayLike) -> Solid:
    """Solid within triangular ``faces`` (m, 3), which are numbers of ``vertices`` (n, 3) [m].

    Seen from outside, a face's numbers go against the clock. Each face and the first vertex make a
    tetrahedron, and those add up with their signs. Raises InputError if a face names no vertex or no volume
    is left. Source: ∫x xᵀ dV of a tetrahedron with a corner at the origin and edges a, b, c:
    det(a, b, c)/120 times the sum of a aᵀ, b bᵀ, c cᵀ and (a + b + c)(a + b + c)ᵀ.
    """
    corners = finite("vertices", vertices, (-1, 3))
    numbers = np.asarray(faces)
    if numbers.ndim != 2 or numbers.shape[1] != 3 or not set(numbers.flat) <= set(range(len(corners))):
        raise InputError(f"faces: got {faces!r}, expected triples of numbers from 0 to {len(corners) - 1}")
    edges = (corners - corners[0])[numbers]
    six_volumes, sums = np.linalg.det(edges), edges.sum(axis=1)
    volume = float(six_volumes.sum() / 6)
    middle = six_volumes @ sums / 24 / positive("volume within the faces", volume)
    squares = np.einsum("f,fki,fkj->ij", six_volumes, edges, edges)
    second = (squares + np.einsum("f,fi,fj->ij", six_volumes, sums, sums)) / 120 / volume
    second -= np.outer(middle, middle)
    inertia = np.diag(np.diag(second)[[1, 2, 0]] + np.diag(second)[[2, 0, 1]])
    inertia -= np.where(np.eye(3), 0.0, (second + second.T) / 2)
    return Solid(volume, corners[0] + middle, inertia)


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
