"""A pendulum in a car that speeds up steadily, and leans back: the engine's own joint terms do the work.

The car slides, drawn by a constant force, and is so heavy that it does not feel the pendulum. Catches an
engine whose hinge does not know that its pivot speeds up.
"""

from functools import cache

import numpy as np

from ..reference import car_pendulum, plane_pendulum, quaternions
from ..reference.checked import Array
from . import observables, pictures
from .body import Body, Joint, Vector, diagonal
from .forces import Constant
from .scene import Scene
from .trajectory import Trajectory

#: Mass of the car [kg]: what the pendulum does to its acceleration is 1e-15 of it, lost in rounding.
CAR, ACCELERATION, G = 1e15, 4.0, 9.81
AHEAD: Vector = (0.6, 0.8, 0.0)
#: The hinge turns the pendulum against AHEAD.
ACROSS: Vector = (-0.8, 0.6, 0.0)
MASS, ARM, MOMENTS = 1.5, 0.5, (0.02, 0.03, 0.04)
PIVOT: Vector = (0.2, -0.1, 0.3)
#: About ACROSS, in body axes [kg m²].
MOMENT = 0.64 * MOMENTS[0] + 0.36 * MOMENTS[1]
#: Length [m] of the point pendulum that swings alike.
LENGTH = (MOMENT + MASS * ARM**2) / (MASS * ARM)


def _truth(scene: Scene, t: Array) -> Trajectory:
    (x0, phi0), (v0, rate0) = scene.q0, scene.v0
    phi, rate = car_pendulum.motion(G, ACCELERATION, LENGTH, phi0, rate0, t)
    x, v = x0 + v0 * t + ACCELERATION * t**2 / 2, v0 + ACCELERATION * t
    ahead, up, n = np.array(AHEAD), np.array((0.0, 0.0, 1.0)), len(t)
    position = np.zeros((n, 2, 3)) + x[:, None, None] * ahead
    velocity = np.zeros((n, 2, 3)) + v[:, None, None] * ahead
    s, c = np.sin(phi)[:, None], np.cos(phi)[:, None]
    position[:, 1] += np.array(PIVOT) - ARM * (s * ahead + c * up)
    velocity[:, 1] += ARM * rate[:, None] * (s * up - c * ahead)
    turn = quaternions.from_rotation_vector(np.stack([0 * phi, phi], axis=1)[:, :, None] * np.array(ACROSS))
    omega = np.stack([0 * rate, rate], axis=1)[:, :, None] * np.array(ACROSS)
    q, qdot = np.column_stack([x, phi]), np.column_stack([v, rate])
    return Trajectory(t, position, turn, velocity, omega, q, qdot)


def _leaning(scene: Scene, motion: Trajectory) -> tuple[Array, Array]:
    """Angle (n,) from where it would hang still, and its rate."""
    tilt = car_pendulum.equilibrium(G, ACCELERATION)
    return motion.joint_position[:, 1] - tilt, motion.joint_velocity[:, 1]


def _swinging(scene: Scene, motion: Trajectory) -> Array:
    angle, rate = _leaning(scene, motion)
    return np.asarray(angle - 1j * rate / car_pendulum.frequency(G, ACCELERATION, LENGTH))


@cache
def _rate(scene: Scene) -> float:
    """Swings of 2π a second [rad/s]: of a plane pendulum about a tilted vertical, in a stronger field."""
    small = car_pendulum.frequency(G, ACCELERATION, LENGTH)
    angle = scene.q0[1] - car_pendulum.equilibrium(G, ACCELERATION)
    sine = np.hypot(np.sin(angle / 2), scene.v0[1] / (2 * small))
    field = float(np.hypot(G, ACCELERATION))
    return 2 * np.pi / plane_pendulum.period(field, LENGTH, float(2 * np.arcsin(sine)))


def _energy_in_the_car(scene: Scene, motion: Trajectory) -> Array:
    """That of the pendulum in the field that the car feels [J], which stays."""
    angle, rate = _leaning(scene, motion)
    return np.asarray(MASS * ARM * (LENGTH * rate**2 / 2 - np.hypot(G, ACCELERATION) * np.cos(angle)))


def _apart(scene: Scene, motion: Trajectory) -> Array:
    """What bodies and joints differ by, in place and in speed."""
    pivot = motion.position[:, 0] + PIVOT
    phi, rate = motion.joint_position[:, 1, None], motion.joint_velocity[:, 1, None]
    ahead, up = np.array(AHEAD), np.array((0.0, 0.0, 1.0))
    return np.column_stack(
        [
            motion.position[:, 0] - motion.joint_position[:, :1] * ahead,
            motion.position[:, 1] - pivot + ARM * (np.sin(phi) * ahead + np.cos(phi) * up),
            motion.velocity[:, 0] - motion.joint_velocity[:, :1] * ahead,
            motion.velocity[:, 1]
            - motion.velocity[:, 0]
            - ARM * rate * (np.sin(phi) * up - np.cos(phi) * ahead),
        ]
    )


#: C of C·dt^order of each observable in turn, measured by benchmarks/error_constants.py with MuJoCo 4.0.0.
ERRORS: dict[str, tuple[float, ...]] = {
    "RKMK4": (8.3, 29.0, 17.0, 56.0, 12.0, 7.8, 0.0),
    **dict.fromkeys(
        # On one hinge and one slide nothing is gyroscopic and nothing damped: alike in all digits kept.
        ("semi-implicit Euler", "implicit gyroscopic", "implicitfast", "discrete"),
        (6.2, 3.0, 1.9, 1.8, 0.5, 6.6, 0.0),
    ),
}

SCENES = (
    Scene(
        name="car_pendulum",
        summary="A pendulum in a car that speeds up steadily: it swings about where it would hang, leaning.",
        source="Taylor, Classical Mechanics, § 9.1, example 9.1",
        bodies=(
            Body("car", CAR, diagonal(CAR, CAR, CAR), (Joint("road", "slide", AHEAD),)),
            Body(
                "pendulum",
                MASS,
                diagonal(*MOMENTS),
                (Joint("hinge", "hinge", ACROSS),),
                center_of_mass=(0.0, 0.0, -ARM),
                parent="car",
                position=PIVOT,
            ),
        ),
        gravity=(0.0, 0.0, -G),
        forces=(Constant("car", (CAR * ACCELERATION * AHEAD[0], CAR * ACCELERATION * AHEAD[1], 0.0)),),
        q0=(0.5, 1.1),
        v0=(-1.0, 0.8),
        duration=2.0,
        samples=50,
        dt=2e-3,
        truth=_truth,
        observables=(
            observables.position(),
            observables.velocity(),
            observables.orientation(),
            observables.omega(),
            observables.rate("frequency", _swinging, _rate),
            observables.invariant(
                "energy in the car", "J", _energy_in_the_car, lambda scene, b: MASS * ARM * G
            ),
            observables.invariant(
                "joint residual", "m", _apart, lambda scene, b: float(np.abs(b.position).max())
            ),
        ),
        pictures=(
            pictures.against_time(
                "Angle from the vertical, to the rear", "φ [rad]", lambda scene, m: m.joint_position[:, 1]
            ),
        ),
        ladders=dict.fromkeys((1, 4), (2e-2, 1e-2, 5e-3, 2.5e-3, 1.25e-3)),
        errors=ERRORS,
    ),
)
