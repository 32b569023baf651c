"""Closed forms of the solids against quadrature over their volume, which is exact for these integrands."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from poinsot.reference import inertia_of_shapes as shapes
from poinsot.reference.errors import InputError
from poinsot.reference.inertia import about_point, physical, principal
from poinsot.reference.quaternions import matrix

# A few roundings of sums of positive terms; the quadrature has some thousand of them.
ROUNDING = 1e-13
NODES, WEIGHTS = np.polynomial.legendre.leggauss(8)
lengths = st.floats(1e-3, 1e3)


def measured(points, weights):
    """Volume, centre and tensor per unit mass about it, of weighted points."""
    volume = weights.sum()
    centre = weights @ points / volume
    r = points - centre
    second = (r * weights[:, None]).T @ r / volume
    squares = np.diag(second)
    moments = squares[[1, 2, 0]] + squares[[2, 0, 1]]
    return volume, centre, np.where(np.eye(3), np.diag(moments), -second)


def gauss(low, high):
    return (high - low) / 2 * NODES + (high + low) / 2, (high - low) / 2 * WEIGHTS


def revolved(*pieces):
    """Points and weights in a solid of revolution: pieces (low, high, inner², outer²) along z."""
    points, weights = [], []
    angles = np.arange(8) * np.pi / 4
    for low, high, inner, outer in pieces:
        for z, wz in zip(
            (high - low) / 2 * NODES + (high + low) / 2, (high - low) / 2 * WEIGHTS, strict=True
        ):
            a, b = inner(z), outer(z)
            for square, ws in zip((b - a) / 2 * NODES + (a + b) / 2, (b - a) / 2 * WEIGHTS, strict=True):
                # r dr dφ = ½ d(r²) dφ
                ring = np.sqrt(square) * np.array([np.cos(angles), np.sin(angles)])
                points.append(np.column_stack([*ring, np.full(8, z)]))
                weights.append(np.full(8, wz * ws / 2 * np.pi / 4))
    return np.concatenate(points), np.concatenate(weights)


def agree(solid, points, weights):
    volume, centre, inertia = measured(points, weights)
    assert solid.volume == pytest.approx(volume, rel=ROUNDING, abs=0)
    size = np.sqrt(np.abs(inertia).max())
    np.testing.assert_allclose(solid.centre, centre, rtol=0, atol=ROUNDING * size)
    np.testing.assert_allclose(solid.inertia, inertia, rtol=0, atol=ROUNDING * size**2)
    # Each moment by itself too: of a needle, the small one must be as good as the large ones.
    np.testing.assert_allclose(np.diag(solid.inertia), np.diag(inertia), rtol=1e-10)


def nothing(z):
    return 0 * z


@given(lengths)
def test_sphere(r):
    agree(shapes.sphere(r), *revolved((-r, r, nothing, lambda z: r**2 - z**2)))


@given(lengths, st.floats(0, 0.99))
def test_hollow_sphere(b, share):
    a = share * b

    def full(z):
        return b**2 - z**2

    pieces = [(-b, -a, nothing, full), (a, b, nothing, full)]
    if a > 0:
        pieces.append((-a, a, lambda z: a**2 - z**2, full))
    agree(shapes.hollow_sphere(a, b), *revolved(*pieces))


def test_thin_shell_is_exact():
    b, t = 0.3, 1e-13
    shell = shapes.hollow_sphere(b - t, b)
    assert shell.inertia[0, 0] == pytest.approx(2 / 3 * b**2, rel=1e-12, abs=0)
    assert shell.volume == pytest.approx(4 * np.pi * b**2 * (b - (b - t)), rel=1e-12, abs=0)


def test_sphere_without_a_hollow():
    whole, hollow = shapes.sphere(0.7), shapes.hollow_sphere(0, 0.7)
    assert hollow.volume == pytest.approx(whole.volume, rel=1e-15, abs=0)
    np.testing.assert_allclose(hollow.inertia, whole.inertia, rtol=1e-15)


@given(lengths, lengths, lengths)
def test_box(x, y, z):
    grid = np.stack(np.meshgrid(NODES, NODES, NODES, indexing="ij"), axis=-1).reshape(-1, 3)
    weights = np.einsum("i,j,k->ijk", WEIGHTS, WEIGHTS, WEIGHTS).ravel()
    agree(shapes.box(x, y, z), grid * [x / 2, y / 2, z / 2], weights * x * y * z / 8)


@given(lengths, lengths)
def test_cylinder(r, h):
    agree(shapes.cylinder(r, h), *revolved((-h / 2, h / 2, nothing, lambda z: r**2 + 0 * z)))


@given(lengths, st.floats(0, 1e3))
def test_capsule(r, h):
    pieces = [
        (-h / 2 - r, -h / 2, nothing, lambda z: np.maximum(r**2 - (z + h / 2) ** 2, 0)),
        (-h / 2, h / 2, nothing, lambda z: r**2 + 0 * z),
        (h / 2, h / 2 + r, nothing, lambda z: np.maximum(r**2 - (z - h / 2) ** 2, 0)),
    ]
    # h/2 + r is rounded, so of a long thin capsule the quadrature knows the caps to h/r units less.
    if h < 100 * r:
        agree(shapes.capsule(r, h), *revolved(*pieces))


def test_capsule_between_its_limits():
    ball, rod = shapes.capsule(0.3, 0.0), shapes.capsule(1e-6, 2.0)
    np.testing.assert_allclose(ball.inertia, shapes.sphere(0.3).inertia, rtol=1e-15)
    np.testing.assert_allclose(rod.inertia, shapes.cylinder(1e-6, 2.0).inertia, rtol=3e-6)


@given(lengths, lengths, lengths)
def test_ellipsoid(a, b, c):
    points, weights = revolved((-1.0, 1.0, nothing, lambda z: 1 - z**2))
    agree(shapes.ellipsoid(a, b, c), points * [a, b, c], weights * a * b * c)


@given(lengths, lengths)
def test_cone(R, h):
    agree(shapes.cone(R, h), *revolved((0.0, h, nothing, lambda z: (R * z / h) ** 2)))


def test_cone_about_its_tip():
    M, R, h = 1.7, 0.3, 0.8
    cone = shapes.cone(R, h)
    about_tip = about_point(M * cone.inertia, M, cone.centre)
    expected = 3 * M / 20 * np.diag([R**2 + 4 * h**2, R**2 + 4 * h**2, 2 * R**2])
    np.testing.assert_allclose(about_tip, expected, rtol=1e-15, atol=1e-16)
    assert cone.centre[2] == 3 * h / 4
    # One set of notes prints 2h² in the last place.
    assert abs(about_tip[2, 2] - 3 * M / 20 * 2 * h**2) > 0.1


def test_cube_about_its_corner():
    M, a = 1.7, 0.3
    tensor = shapes.cube_about_corner(M, a)
    np.testing.assert_allclose(
        tensor, M * a**2 / 12 * np.array([[8, -3, -3], [-3, 8, -3], [-3, -3, 8]]), rtol=1e-15
    )
    grid = np.stack(np.meshgrid(NODES, NODES, NODES, indexing="ij"), axis=-1).reshape(-1, 3)
    r = (grid + 1) * a / 2
    weights = M * np.einsum("i,j,k->ijk", WEIGHTS, WEIGHTS, WEIGHTS).ravel() / 8
    np.testing.assert_allclose(
        tensor, np.sum(weights[:, None] * r**2) * np.eye(3) - (r * weights[:, None]).T @ r, rtol=1e-13
    )
    moments, axes = principal(tensor)
    np.testing.assert_allclose(moments, M * a**2 / 12 * np.array([2, 11, 11]), rtol=1e-15)
    np.testing.assert_allclose(axes[:, 0], np.ones(3) / np.sqrt(3), rtol=1e-15)


def test_bent_molecule_of_the_lecture():
    # M where the bonds of length d meet at the angle α, two m at their ends, all in the x-y plane.
    M, m, d, alpha = 16.0, 1.008, 0.9572, np.radians(104.52)
    along, across = d * np.cos(alpha / 2), d * np.sin(alpha / 2)
    ends = np.array([[along, across, 0.0], [along, -across, 0.0]])
    centre, tensor = shapes.molecule([M, m, m], [[0.0, 0.0, 0.0], *ends])
    total = M + 2 * m
    np.testing.assert_allclose(centre, [2 * m * along / total, 0, 0], rtol=1e-15, atol=1e-16)
    Ixx, Iyy = 2 * m * across**2, 2 * m * M * along**2 / total
    np.testing.assert_allclose(tensor, np.diag([Ixx, Iyy, Ixx + Iyy]), rtol=1e-14, atol=1e-16)
    # About M itself: 2md² (sin², cos², 1) of half the angle.
    np.testing.assert_allclose(
        about_point(tensor, total, -centre),
        2 * m * d**2 * np.diag([np.sin(alpha / 2) ** 2, np.cos(alpha / 2) ** 2, 1]),
        rtol=1e-14,
        atol=1e-15,
    )
    # Water, u Å² in 1e-47 kg m²; from its spectrum 1.0220, 1.9187, 2.9376 (Herzberg), vibrating a little.
    np.testing.assert_allclose(np.diag(tensor)[[1, 0, 2]] * 1.66054, [1.0220, 1.9187, 2.9376], rtol=2e-3)


def test_linear_molecule_of_three_atoms():
    # Landau & Lifshitz § 32, problem 1a: I1 = I2 = Σ m_a m_b l_ab²/μ, I3 = 0.
    m, z = np.array([3.0, 5.0, 0.7]), np.array([0.1, 1.3, -0.4])
    _, tensor = shapes.molecule(m, np.column_stack([0 * z, 0 * z, z]))
    expected = sum(m[a] * m[b] * (z[a] - z[b]) ** 2 for a in range(3) for b in range(a)) / m.sum()
    np.testing.assert_allclose(tensor, np.diag([expected, expected, 0]), rtol=4e-16, atol=0)


def test_molecule_far_from_the_origin_loses_nothing():
    m, r = np.array([1.0, 2.0, 3.0]), np.array([[0.0, 0, 0], [1, 0, 0], [0, 2, 1]])
    _, near = shapes.molecule(m, r)
    centre, far = shapes.molecule(m, r + 2.0**40)
    np.testing.assert_allclose(far, near, rtol=1e-15, atol=1e-15)
    np.testing.assert_allclose(centre - 2.0**40, shapes.molecule(m, r)[0], atol=1e-3)
    _, atom = shapes.molecule([2.0], [[1.0, 2.0, 3.0]])
    np.testing.assert_array_equal(atom, np.zeros((3, 3)))


SOLIDS = {
    shapes.sphere: 1,
    shapes.box: 3,
    shapes.cylinder: 2,
    shapes.ellipsoid: 3,
    shapes.cone: 2,
    shapes.cube_about_corner: 2,
}


@pytest.mark.parametrize("shape", SOLIDS)
@pytest.mark.parametrize("bad", [0.0, -1.0, np.nan, np.inf])
def test_lengths_must_be_positive(shape, bad):
    for place in range(SOLIDS[shape]):
        with pytest.raises(InputError):
            shape(*[bad if i == place else 1.0 for i in range(SOLIDS[shape])])


def test_other_bad_sizes():
    for arguments in ((1.0, 1.0), (2.0, 1.0), (-0.1, 1.0), (0.0, 0.0)):
        with pytest.raises(InputError):
            shapes.hollow_sphere(*arguments)
    for arguments in ((0.0, 1.0), (1.0, -1.0)):
        with pytest.raises(InputError):
            shapes.capsule(*arguments)
    for masses, positions in (([1.0, 2.0], [[0, 0, 0]]), ([0.0], [[0, 0, 0]]), ([1.0, -1.0], np.eye(2, 3))):
        with pytest.raises(InputError):
            shapes.molecule(masses, positions)


@given(lengths, lengths, lengths)
def test_every_solid_is_physical(a, b, c):
    for solid in (shapes.box(a, b, c), shapes.ellipsoid(a, b, c), shapes.cylinder(a, b), shapes.cone(a, b)):
        physical(solid.inertia)


def test_shell_is_what_a_hollow_sphere_comes_to():
    b, t = 0.3, 1e-13
    np.testing.assert_allclose(
        shapes.shell(b).inertia, shapes.hollow_sphere(b - t, b).inertia, rtol=1e-12, atol=0
    )
    assert shapes.shell(b).volume == pytest.approx(
        shapes.hollow_sphere(b - t, b).volume / (b - (b - t)), rel=1e-12
    )


def test_pyramid_on_a_triangle_and_on_a_square():
    # On an equilateral triangle of edge a: A = √3/4 a², and a²/24 about an axis of the triangle per area.
    a, h = 0.4, 0.7
    three = shapes.pyramid(3, a / np.sqrt(3), h)
    assert three.volume == pytest.approx(np.sqrt(3) / 12 * a**2 * h, rel=1e-15)
    assert three.inertia[2, 2] == pytest.approx(3 / 5 * a**2 / 12, rel=1e-15)
    four = shapes.pyramid(4, a / np.sqrt(2), h)
    assert four.volume == pytest.approx(a**2 * h / 3, rel=1e-15)
    assert four.inertia[2, 2] == pytest.approx(a**2 / 10, rel=1e-15)
    assert four.inertia[0, 0] == pytest.approx(a**2 / 20 + 3 / 80 * h**2, rel=1e-15)


def test_pyramid_on_ever_more_sides_is_a_cone():
    errors = [
        shapes.pyramid(n, 0.3, 0.8).inertia[0, 0] / shapes.cone(0.3, 0.8).inertia[0, 0] - 1 for n in (50, 100)
    ]
    assert errors[0] == pytest.approx(4 * errors[1], rel=1e-2)
    assert abs(errors[1]) < 1e-3
    with pytest.raises(InputError, match="sides: got 2"):
        shapes.pyramid(2, 0.3, 0.8)


def cone_mesh(sides, radius, height):
    """A pyramid as triangles; its tip is no special corner, and its base is a fan from one of its own."""
    turns = 2 * np.pi * np.arange(sides) / sides
    corners = np.column_stack([radius * np.cos(turns), radius * np.sin(turns), np.full(sides, height)])
    around = [(k, sides, (k + 1) % sides) for k in range(sides)]
    return np.vstack([corners, np.zeros(3)]), [*around, *((0, k, k + 1) for k in range(1, sides - 1))]


@pytest.mark.parametrize("sides", [3, 4, 7, 24])
def test_polyhedron_and_pyramid_agree(sides):
    solid, mesh = shapes.pyramid(sides, 0.3, 0.8), shapes.polyhedron(*cone_mesh(sides, 0.3, 0.8))
    assert mesh.volume == pytest.approx(solid.volume, rel=1e-14)
    np.testing.assert_allclose(mesh.centre, solid.centre, atol=1e-15)
    np.testing.assert_allclose(mesh.inertia, solid.inertia, atol=1e-15)


def test_polyhedron_is_the_same_wherever_it_is_and_however_it_is_turned():
    vertices, faces = cone_mesh(5, 0.3, 0.8)
    solid = shapes.polyhedron(vertices, faces)
    turn = matrix(np.array([0.48, -0.36, 0.0, 0.8]))
    moved = shapes.polyhedron(vertices @ turn.T + [1.0, -2.0, 0.5], faces)
    np.testing.assert_allclose(moved.centre, turn @ solid.centre + [1.0, -2.0, 0.5], atol=1e-14)
    np.testing.assert_allclose(moved.inertia, turn @ solid.inertia @ turn.T, atol=1e-14)
    assert np.abs(moved.inertia - np.diag(np.diag(moved.inertia))).max() > 1e-3


def test_a_polyhedron_with_a_hollow():
    # A hollow's faces are counted the other way round.
    vertices, faces = cone_mesh(6, 0.3, 0.8)
    inner = 0.5 * (vertices - [0, 0, 0.6]) + [0.02, 0, 0.6]
    both = shapes.polyhedron(
        np.vstack([vertices, inner]), [*faces, *((a + 7, c + 7, b + 7) for a, b, c in faces)]
    )
    outer, hole = shapes.polyhedron(vertices, faces), shapes.polyhedron(inner, faces)
    assert both.volume == pytest.approx(outer.volume - hole.volume, rel=1e-14)
    mass = both.volume
    about = [
        s.volume * s.inertia + s.volume * (d @ d * np.eye(3) - np.outer(d, d))
        for s in (outer, hole)
        for d in [s.centre - both.centre]
    ]
    np.testing.assert_allclose(mass * both.inertia, about[0] - about[1], atol=1e-15)


@pytest.mark.parametrize("faces", [[(0, 1, 9)], [(0, 1)], [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]])
def test_faces_that_enclose_nothing_are_refused(faces):
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])
    right = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]
    assert shapes.polyhedron(corners, right).volume == pytest.approx(1 / 6)
    if faces == right:
        faces = [(a, c, b) for a, b, c in faces]
    with pytest.raises(InputError, match="faces"):
        shapes.polyhedron(corners, faces)
