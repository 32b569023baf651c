"""A body thrown past the origin: L and T split into those of its centre and those about it.

Flying freely each of the four parts is constant by itself; falling only the two about the centre are;
orbiting, pulled towards the origin, those two and L of the centre. Catches an engine whose weight, or pull,
acts beside the centre of mass: the sum over both may still come out.
"""

from collections.abc import Callable

import numpy as np

from ..reference import quaternions
from ..reference.checked import Array
from . import free_body, mechanics, observables, pictures
from .body import Body, Joint, Vector, diagonal
from .observables import Observable
from .scene import Scene, Truth, every_scheme
from .trajectory import Trajectory

MASS, MOMENTS, G = 0.7, (0.004, 0.007, 0.009), 9.81
#: Where it starts and how it flies there [m, m/s]; its attitude, and ω in its own axes [rad/s].
PLACE, VELOCITY = (0.6, -0.9, 0.4), (1.5, 0.8, 2.5)
ATTITUDE, OMEGA = (0.2, -0.4, 0.4, 0.8), (2.0, -1.5, 3.0)
#: Pull towards the origin [N/m], and the rate of the ellipse that it makes, √(k/m) [rad/s].
PULL = 11.2
RATE = float(np.sqrt(PULL / MASS))
FREE = (Joint("free", "free"),)
#: A spring along each axis, and nothing that hinders turning.
PULLED = (
    Joint("along x", "slide", (1.0, 0.0, 0.0), stiffness=PULL),
    Joint("along y", "slide", (0.0, 1.0, 0.0), stiffness=PULL),
    Joint("along z", "slide", (0.0, 0.0, 1.0), stiffness=PULL),
    Joint("turning", "ball"),
)


def _orbit(scene: Scene, t: Array) -> Trajectory:
    """An ellipse about the origin, and free turning: none feels the other."""
    q, omega = free_body.turning(np.diag(MOMENTS), np.array(scene.q0[3:]), np.array(scene.v0[3:]), t)
    place, speed = np.array(scene.q0[:3]), np.array(scene.v0[:3])
    cos, sin = np.cos(RATE * t)[:, None], np.sin(RATE * t)[:, None]
    position, velocity = place * cos + speed / RATE * sin, speed * cos - place * RATE * sin
    return Trajectory(t, position[:, None], q[:, None], velocity[:, None], omega[:, None], position, velocity)


def _circling(scene: Scene, motion: Trajectory) -> Array:
    """One coordinate and its velocity over the rate: a circle."""
    return np.asarray(motion.position[:, 0, 0] - 1j * motion.velocity[:, 0, 0] / RATE)


def _parted(scene: Scene, motion: Trajectory) -> Array:
    """What the joints' own coordinates and the body's place and velocity differ by."""
    places = motion.position[:, 0] - motion.joint_position
    return np.hstack([places, motion.velocity[:, 0] - motion.joint_velocity])


def _orbital(scene: Scene, motion: Trajectory) -> Array:
    """L of the centre about the world's origin, (n, 3)."""
    return np.asarray(MASS * np.cross(motion.position[:, 0], motion.velocity[:, 0]))


def _spin(scene: Scene, motion: Trajectory) -> Array:
    """L about the centre, (n, 3), world axes."""
    return quaternions.rotated(motion.quaternion, mechanics.spin_momentum_body(scene, motion))[:, 0]


def _energy_of_centre(scene: Scene, motion: Trajectory) -> Array:
    return np.asarray(MASS * np.sum(motion.velocity[:, 0] ** 2, axis=1) / 2)


def _energy_about_it(scene: Scene, motion: Trajectory) -> Array:
    return np.asarray(np.sum(motion.omega * mechanics.spin_momentum_body(scene, motion), axis=(1, 2)) / 2)


def _part(name: str, unit: str, value: Callable[[Scene, Trajectory], Array]) -> Observable:
    def size(scene: Scene, exact: Trajectory) -> float:
        return float(np.max(np.linalg.norm(value(scene, exact).reshape(len(exact.t), -1), axis=1)))

    return observables.invariant(name, unit, value, size)


def _fall(scene: Scene, motion: Trajectory) -> float:
    """How fast the upward velocity changes, fitted [m/s²]."""
    return float(np.polyfit(motion.t, motion.velocity[:, 0, 2], 1)[0])


ABOUT_CENTRE = (
    _part("L about the centre", "kg m²/s", _spin),
    _part("T about the centre", "J", _energy_about_it),
)
OF_CENTRE = (_part("L of the centre", "kg m²/s", _orbital), _part("T of the centre", "J", _energy_of_centre))
OWN = {
    "flying": (*OF_CENTRE, observables.momentum(), observables.angular_momentum()),
    "falling": (observables.fitted("fall", "m/s²", _fall, lambda scene: -G),),
    "orbiting": (
        OF_CENTRE[0],
        observables.rate("circling", _circling, lambda scene: RATE),
        observables.invariant(
            "joint residual", "1", _parted, lambda scene, b: float(np.abs(b.velocity).max())
        ),
    ),
}


def _thrown(
    variant: str, gravity: Vector, joints: tuple[Joint, ...] = FREE, truth: Truth = free_body.truth
) -> Scene:
    return Scene(
        name="orbit_and_spin",
        variant=variant,
        summary=f"A spinning body {variant} past the origin: L and T of its centre, and about it.",
        source="Goldstein, Classical Mechanics, ch. 1.2; Taylor, Classical Mechanics, ch. 10.1",
        bodies=(Body("stone", MASS, diagonal(*MOMENTS), joints),),
        gravity=gravity,
        q0=(*PLACE, *ATTITUDE),
        v0=(*VELOCITY, *OMEGA),
        duration=1.6,
        samples=100,
        truth=truth,
        observables=(
            observables.orientation(),
            observables.omega(),
            observables.position(),
            observables.velocity(),
            *OWN[variant],
            *ABOUT_CENTRE,
            observables.energy(),
            observables.unit_norm(),
        ),
        pictures=(
            pictures.against_time(
                "L about the origin: upward part of the centre's",
                "L [kg m²/s]",
                lambda scene, m: _orbital(scene, m)[:, 2],
            ),
            pictures.against_time(
                "L about the centre: upward part", "L [kg m²/s]", lambda scene, m: _spin(scene, m)[:, 2]
            ),
        ),
        ladders={1: (8e-3, 4e-3, 2e-3, 1e-3, 5e-4), 4: (1.6e-2, 8e-3, 4e-3, 2e-3, 1e-3)},
        errors=ERRORS[variant],
    )


#: C of C·dt^order of each observable in turn, measured by benchmarks/error_constants.py with MuJoCo 4.0.0.
ERRORS: dict[str, dict[str, tuple[float, ...]]] = {
    "flying": {
        "semi-implicit Euler": (3.4, 6.3, 0.0, 0.0, 0.0, 0.0, 0.0, 0.036, 0.036, 0.098, 0.098, 0.0),
        "implicit gyroscopic": (3.9, 6.2, 0.0, 0.0, 0.0, 0.0, 0.0, 0.035, 0.035, 0.097, 0.097, 0.0),
        "RKMK4": (0.67, 0.67, 0.0, 0.0, 0.0, 0.0, 0.0, 0.019, 0.018, 0.0018, 0.0018, 0.0),
    },
    "orbiting": {
        "semi-implicit Euler": (3.4, 6.3, 2.4, 6.1, 0.0, 0.49, 0.0, 0.036, 0.098, 18.0, 0.0),
        "implicit gyroscopic": (3.9, 6.2, 2.4, 6.1, 0.0, 0.49, 0.0, 0.035, 0.097, 18.0, 0.0),
        "implicitfast": (3.4, 6.3, 2.4, 6.1, 0.0, 0.49, 0.0, 0.036, 0.098, 18.0, 0.0),
        "RKMK4": (0.66, 0.63, 14.0, 65.0, 3.4, 8.6, 0.0, 0.018, 0.0018, 16.0, 0.0),
        "discrete": (3.4, 6.3, 16.0, 50.0, 59.0, 0.18, 0.0, 0.036, 0.098, 280.0, 0.0),
    },
    "falling": {
        "semi-implicit Euler": (3.4, 6.3, 7.9, 0.0, 0.0, 0.036, 0.098, 54.0, 0.0),
        "implicit gyroscopic": (3.9, 6.2, 7.9, 0.0, 0.0, 0.035, 0.097, 54.0, 0.0),
        "RKMK4": (0.66, 0.68, 0.0, 0.0, 0.0, 0.018, 0.0018, 0.0018, 0.0),
    },
}
for name in ("flying", "falling"):
    ERRORS[name] = every_scheme(ERRORS[name], like="implicit gyroscopic")

SCENES = (
    _thrown("flying", (0.0, 0.0, 0.0)),
    _thrown("falling", (0.0, 0.0, -G)),
    _thrown("orbiting", (0.0, 0.0, 0.0), PULLED, _orbit),
)
