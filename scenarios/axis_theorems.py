"""One rigid body described in four ways, which must all make the same motion, and a cube about its corner.

Two bricks, joined, tumble freely: as one link in its principal axes, as two links welded, in axes turned
against the principal ones, and from an origin off its centre. The cube turns about a corner, where its
tensor Ma²/12 ((8, −3, −3), …) has the principal moments 2, 11, 11. Catches an engine that takes no part of a
tensor from a displacement, or half of one, or a diagonal for the whole.
"""

from collections.abc import Sequence

import numpy as np

from ..reference import inertia, quaternions, torque_free
from ..reference.checked import Array
from . import free_body, observables, pictures
from .body import IDENTITY, Body, Joint, Matrix, Quaternion, Vector, diagonal
from .observables import Observable
from .scene import Scene, every_scheme
from .trajectory import Trajectory, about_fixed_point

#: The bricks: mass [kg], edges [m], centre in the axes of the whole, from its centre of mass [m].
MASSES = (1.2, 0.8)
EDGES: tuple[Vector, Vector] = ((0.30, 0.10, 0.06), (0.10, 0.20, 0.12))
PLACES: tuple[Vector, Vector] = ((-0.08, 0.0, 0.0), (0.12, 0.0, 0.0))
#: Of the whole at the start: its centre [m] and its velocity, its attitude, ω in its principal axes.
CENTRE, VELOCITY = (0.3, -0.2, 0.4), (0.5, 0.2, -0.3)
ATTITUDE, OMEGA = (0.1, 0.7, -0.1, 0.7), (1.5, 0.6, 4.0)
#: How the axes are turned, or the second brick's against the first's; where the other origin is [m].
TURNED: Quaternion = (0.48, -0.36, 0.0, 0.8)
OFFSET: Vector = (0.05, -0.11, 0.07)
#: The cube: mass [kg], edge [m]; ω in the axes of its edges.
CUBE, EDGE, CUBE_OMEGA = 0.9, 0.2, (2.5, 0.5, 3.0)


def brick(which: int) -> Matrix:
    """Inertia of a brick about its centre [kg m²], in the axes of the whole."""
    mass, (x, y, z) = MASSES[which], EDGES[which]
    return diagonal(*(mass * square / 12 for square in (y**2 + z**2, z**2 + x**2, x**2 + y**2)))


def whole(bodies: Sequence[Body]) -> tuple[Array, Array]:
    """Centre of mass (3,) [m] of bodies welded to the first, and inertia (3, 3) about it, in its axes."""
    tensors, masses = [], np.array([body.mass for body in bodies])
    for body in bodies:
        turn = np.array(body.quaternion)
        tensors.append(inertia.turned(body.inertia_array, turn))
    centres = _centres(bodies)
    middle = masses @ centres / masses.sum()
    moved = [
        inertia.about_point(tensor, body.mass, centre - middle)
        for tensor, body, centre in zip(tensors, bodies, centres, strict=True)
    ]
    return middle, np.asarray(sum(moved))


def _centres(bodies: Sequence[Body]) -> Array:
    """Centres of mass (b, 3) [m] in the axes of the first body, the others being welded to it."""
    turns = np.array([body.quaternion for body in bodies])
    places = np.array([body.position for body in bodies])
    return places + quaternions.rotated(turns, np.array([body.center_of_mass for body in bodies]))


def _truth(scene: Scene, t: Array) -> Trajectory:
    middle, tensor = whole(scene.bodies)
    place, turn = np.array(scene.q0[:3]), np.array(scene.q0[3:])
    velocity, spin = np.array(scene.v0[:3]), np.array(scene.v0[3:])
    q, omega = free_body.turning(tensor, turn, spin, t)
    flying = velocity + quaternions.rotated(turn, np.cross(spin, middle))
    centre = place + quaternions.rotated(turn, middle) + np.outer(t, flying)
    arms, turns = _centres(scene.bodies) - middle, np.array([body.quaternion for body in scene.bodies])
    q, omega = q[:, None], omega[:, None]
    none = np.empty((len(t), 0))
    return Trajectory(
        t,
        centre[:, None] + quaternions.rotated(q, arms),
        quaternions.product(q, np.broadcast_to(turns, (len(t), *turns.shape))),
        flying + quaternions.rotated(q, np.cross(omega, arms)),
        quaternions.rotated(quaternions.conjugate(turns), omega),
        none,
        none,
    )


def _about_corner(scene: Scene, t: Array) -> Trajectory:
    body = scene.bodies[0]
    tensor = inertia.about_point(body.inertia_array, body.mass, body.center_of_mass)
    q, omega = free_body.turning(tensor, np.array(scene.q0), np.array(scene.v0), t)
    return about_fixed_point(t, np.array(body.center_of_mass), q, omega)


def _across_diagonal(scene: Scene, motion: Trajectory) -> Array:
    """ω seen along the cube's diagonal, as complex numbers (n,)."""
    diagonals = np.array([[1.0, -1.0, 0.0], [1.0, 1.0, -2.0]]) / np.sqrt([[2.0], [6.0]])
    return np.asarray(motion.omega[:, 0] @ (diagonals[0] + 1j * diagonals[1]))


def _round_diagonal(scene: Scene) -> float:
    """Ω_b of a top whose moments are as 11 to 2 [rad/s]."""
    return torque_free.body_cone_rate(11.0, 2.0, float(np.sum(scene.v0) / np.sqrt(3)))


def _parted(scene: Scene, motion: Trajectory) -> Array:
    """How far the second brick is from where it is welded [m, rad]."""
    first, second = np.moveaxis(motion.quaternion, 1, 0)
    weld = np.array(scene.bodies[1].quaternion)
    turn = quaternions.product(quaternions.conjugate(quaternions.product(first, weld)), second)
    arm = quaternions.rotated(first, np.diff(_centres(scene.bodies), axis=0)[0])
    apart = motion.position[:, 1] - motion.position[:, 0] - arm
    return np.hstack([apart, quaternions.rotation_vector(turn)])


def _in_axes(tensor: Matrix, turn: Quaternion) -> Matrix:
    """Rᵀ I R, in axes turned by ``turn``; `inertia.turned` would load a library to list the scenes."""
    if turn == IDENTITY:
        return tensor
    R = quaternions.matrix(np.array(turn))
    found = R.T @ np.array(tensor) @ R
    (a, b, c), (d, e, f), (g, h, i) = (found / 2 + found.T / 2).tolist()
    return (a, b, c), (d, e, f), (g, h, i)


def _vector(array: Array) -> Vector:
    x, y, z = array.tolist()
    return x, y, z


def _bricks() -> tuple[Body, Body]:
    """Both bricks welded, their axes turned against each other; the first's origin is the centre of both."""
    turn = np.array(TURNED)
    back, position = quaternions.conjugate(turn), (0.02, 0.05, 0.03)
    second = Body(
        "second",
        MASSES[1],
        _in_axes(brick(1), TURNED),
        (),
        center_of_mass=_vector(quaternions.rotated(back, np.subtract(PLACES[1], position))),
        parent="first",
        position=position,
        quaternion=TURNED,
    )
    return Body("first", MASSES[0], brick(0), (FREE,), center_of_mass=PLACES[0]), second


def _one(turn: Quaternion = IDENTITY, offset: Vector = (0.0, 0.0, 0.0)) -> tuple[Body]:
    """Both bricks as one link, in axes turned against the principal ones and from an origin at ``offset``."""
    back = quaternions.conjugate(np.array(turn))
    centre = _vector(quaternions.rotated(back, -np.array(offset)))
    return (Body("whole", sum(MASSES), _in_axes(PRINCIPAL, turn), (FREE,), center_of_mass=centre),)


FREE = Joint("free", "free")
#: Of the whole, in its principal axes [kg m²].
PRINCIPAL = diagonal(
    *(
        sum(
            brick(which)[axis][axis] + (MASSES[which] * PLACES[which][0] ** 2 if axis else 0.0)
            for which in (0, 1)
        )
        for axis in range(3)
    )
)
TUMBLING = (
    observables.orientation(),
    observables.omega(),
    observables.position(),
    observables.velocity(),
    observables.energy(),
    observables.angular_momentum(),
    observables.momentum(),
    observables.unit_norm(),
)
WELD = observables.invariant("weld residual", "1", _parted, lambda scene, b: 1.0)
PICTURES = (pictures.tip(), pictures.body_cone())
LADDERS: dict[int | str, tuple[float, ...]] = {
    1: (8e-3, 4e-3, 2e-3, 1e-3, 5e-4),
    4: (1.6e-2, 8e-3, 4e-3, 2e-3, 1e-3),
}


def _tumbling(
    variant: str,
    words: str,
    bodies: tuple[Body, ...],
    turn: Quaternion = IDENTITY,
    offset: Vector = (0.0, 0.0, 0.0),
    more: tuple[Observable, ...] = (),
) -> Scene:
    attitude = np.array(ATTITUDE)
    place = np.array(CENTRE) + quaternions.rotated(attitude, np.array(offset))
    velocity = np.array(VELOCITY) + quaternions.rotated(attitude, np.cross(OMEGA, offset))
    q = quaternions.product(attitude, np.array(turn))
    omega = quaternions.rotated(quaternions.conjugate(np.array(turn)), np.array(OMEGA))
    return Scene(
        name="axis_theorems",
        variant=variant,
        summary=f"Two bricks joined, tumbling freely, {words}.",
        source="Goldstein, Classical Mechanics, § 5.3; Landau & Lifshitz, Mechanics, § 32",
        bodies=bodies,
        q0=(*place.tolist(), *q.tolist()),
        v0=(*velocity.tolist(), *omega.tolist()),
        duration=1.6,
        samples=100,
        truth=_truth,
        observables=(*TUMBLING, *more),
        pictures=PICTURES,
        ladders=LADDERS,
        errors=every_scheme(ERRORS[variant], like="implicit gyroscopic"),
    )


def _corner() -> Scene:
    return Scene(
        name="axis_theorems",
        variant="corner",
        summary="A cube about a corner of it: principal moments as 2, 11, 11.",
        source="Goldstein, Classical Mechanics, § 5.4; Taylor, Classical Mechanics, § 10.4",
        bodies=(
            Body(
                "cube",
                CUBE,
                diagonal(*(CUBE * EDGE**2 / 6,) * 3),
                (Joint("corner", "ball"),),
                center_of_mass=(EDGE / 2, EDGE / 2, EDGE / 2),
            ),
        ),
        q0=ATTITUDE,
        v0=CUBE_OMEGA,
        duration=1.6,
        samples=100,
        truth=_about_corner,
        observables=(
            observables.orientation(),
            observables.omega(),
            observables.rate("Omega_b", _across_diagonal, _round_diagonal),
            observables.position(),
            observables.velocity(),
            observables.energy(),
            observables.angular_momentum(),
            observables.unit_norm(),
        ),
        pictures=PICTURES,
        ladders=LADDERS,
        errors=every_scheme(ERRORS["corner"], like="semi-implicit Euler"),
    )


#: C of C·dt^order of each observable in turn, measured by benchmarks/error_constants.py with MuJoCo 4.0.0.
ERRORS: dict[str, dict[str, tuple[float, ...]]] = {
    "one": {
        "semi-implicit Euler": (3.7, 11.0, 0.0, 0.0, 0.45, 0.15, 0.0, 0.0),
        "implicit gyroscopic": (2.6, 11.0, 0.0, 0.0, 0.43, 0.24, 0.0, 0.0),
        "RKMK4": (1.7, 2.9, 0.0, 0.0, 0.047, 0.18, 0.0, 0.0),
    },
    "welded": {
        "semi-implicit Euler": (5.2, 15.0, 2.0, 2.3, 0.25, 1.4, 3.0, 0.0, 0.0),
        "implicit gyroscopic": (3.6, 15.0, 1.6, 2.0, 0.8, 1.5, 2.8, 0.0, 0.0),
        "RKMK4": (2.4, 4.1, 0.23, 0.58, 0.18, 0.31, 0.29, 0.0, 0.0),
    },
    "rotated": {
        "semi-implicit Euler": (3.7, 11.0, 0.0, 0.0, 0.45, 0.15, 0.0, 0.0),
        "implicit gyroscopic": (2.6, 11.0, 0.0, 0.0, 0.43, 0.24, 0.0, 0.0),
        "RKMK4": (1.7, 2.9, 0.0, 0.0, 0.047, 0.18, 0.0, 0.0),
    },
    "offset": {
        "semi-implicit Euler": (3.7, 11.0, 0.0, 0.0, 0.45, 0.15, 0.0, 0.0),
        "implicit gyroscopic": (2.6, 11.0, 0.0, 0.0, 0.43, 0.24, 0.0, 0.0),
        "RKMK4": (1.7, 2.9, 0.0, 0.0, 0.047, 0.18, 0.0, 0.0),
    },
    "corner": {
        "semi-implicit Euler": (9.7, 13.0, 0.061, 1.5, 3.9, 0.79, 0.4, 0.0),
        "implicit gyroscopic": (11.0, 13.0, 0.061, 1.8, 3.9, 0.74, 0.46, 0.0),
        "RKMK4": (5.9, 4.6, 1.6, 0.84, 1.1, 0.011, 0.24, 0.0),
    },
}

SCENES = (
    _tumbling("one", "as one link in its principal axes", _one()),
    _tumbling("welded", "as two links welded", _bricks(), more=(WELD,)),
    _tumbling("rotated", "as one link in other axes than its principal ones", _one(TURNED), TURNED),
    _tumbling("offset", "as one link from an origin off its centre", _one(offset=OFFSET), offset=OFFSET),
    _corner(),
)
