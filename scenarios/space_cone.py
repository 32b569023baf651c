"""The cone fixed in space on which the body cone rolls: axis and ω go round L at one rate.

Small bodies, as a plate and a stick thrown by hand, catch an engine that leaves the gyroscopic torque out
where moments are small: Bullet's maximal coordinates do so where their product is below 2.2e-16.
"""

import numpy as np

from ..reference import quaternions, torque_free
from ..reference.checked import Array
from . import free_body, observables, pictures
from .body import Body, Joint, Vector, diagonal
from .scene import Scene, every_scheme
from .trajectory import Trajectory

ATTITUDE = (-0.3, 0.5, 0.1, 0.65**0.5)
VELOCITY = (0.4, 0.1, -0.3)


def _space_cone_rate(scene: Scene) -> float:
    I1, _, I3 = np.diag(scene.bodies[0].inertia_array)
    return torque_free.space_cone_rate(I1, I3, scene.v0[3:])


def _axis(scene: Scene, motion: Trajectory) -> Array:
    axis = quaternions.rotated(motion.quaternion[:, 0], np.array([0.0, 0.0, 1.0]))
    return free_body.around_momentum(scene, axis)


def _omega_world(motion: Trajectory) -> Array:
    return quaternions.rotated(motion.quaternion[:, 0], motion.omega[:, 0])


def _spin(scene: Scene, motion: Trajectory) -> Array:
    return free_body.around_momentum(scene, _omega_world(motion))


def _half_angle(scene: Scene, motion: Trajectory) -> Array:
    """Angle between ω and L, (n,) [rad]: half of what the space cone opens by."""
    along = _omega_world(motion) @ free_body.momentum_direction(scene)
    return np.arctan2(np.abs(_spin(scene, motion)), along)


def _body(variant: str, kind: str, moments: Vector, omega0: Vector) -> Scene:
    return Scene(
        name="space_cone",
        variant=variant,
        summary=f"A thrown {kind}: its axis and ω go round the fixed L at L/I1, {_WORDS[variant]} body cone.",
        source="Landau & Lifshitz, Mechanics, § 33; Goldstein, Classical Mechanics, ch. 5.6",
        bodies=(Body(kind, 0.02, diagonal(*moments), (Joint("free", "free"),)),),
        q0=(0.1, -0.2, 1.0, *ATTITUDE),
        v0=(*VELOCITY, *omega0),
        duration=1.6,
        samples=100,
        truth=free_body.truth,
        observables=(
            observables.orientation(),
            observables.omega(),
            observables.position(),
            observables.rate("space cone, axis", _axis, _space_cone_rate),
            observables.rate("space cone, omega", _spin, _space_cone_rate),
            observables.invariant("space cone, half angle", "rad", _half_angle, lambda scene, b: 1.0),
            observables.energy(),
            observables.angular_momentum(),
            observables.momentum(),
            observables.unit_norm(),
        ),
        pictures=(pictures.tip(), pictures.space_cone()),
        ladders={1: (8e-3, 4e-3, 2e-3, 1e-3, 5e-4), 4: (1.6e-2, 8e-3, 4e-3, 2e-3, 1e-3)},
        errors=every_scheme(ERRORS[variant], like="implicit gyroscopic"),
    )


_WORDS = {"oblate": "inside its", "prolate": "outside its"}

#: C of C·dt^order of each observable in turn, measured by benchmarks/error_constants.py with MuJoCo 4.0.0.
ERRORS: dict[str, dict[str, tuple[float, ...]]] = {
    "oblate": {
        "semi-implicit Euler": (15.0, 98.0, 0.0, 7.3, 6.0, 5.9, 0.0049, 0.00062, 0.0, 0.0),
        "implicit gyroscopic": (12.0, 83.0, 0.0, 6.0, 6.5, 5.2, 0.0035, 0.00029, 0.0, 0.0),
        "RKMK4": (38.0, 480.0, 0.0, 150.0, 150.0, 6.7, 0.0019, 0.0012, 0.0, 0.0),
    },
    "prolate": {
        "semi-implicit Euler": (47.0, 59.0, 0.0, 29.0, 29.0, 4.1, 0.0066, 0.0013, 0.0, 0.0),
        "implicit gyroscopic": (45.0, 56.0, 0.0, 28.0, 28.0, 6.0, 0.006, 0.0012, 0.0, 0.0),
        "RKMK4": (33.0, 44.0, 0.0, 20.0, 19.0, 12.0, 0.00023, 0.0013, 0.0, 0.0),
    },
}

SCENES = (
    _body("oblate", "plate", (2e-5, 2e-5, 4e-5), (2.0, -0.7, 7.0)),
    _body("prolate", "stick", (2e-5, 2e-5, 2e-6), (5.0, 2.0, 4.0)),
)
