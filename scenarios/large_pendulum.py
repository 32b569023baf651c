"""A pendulum that swings far beyond the small angles, and one that goes over the top.

The hinge's axis lies askew in the horizontal plane and away from the origin. An engine whose hinge angle is
folded into (−π, π] loses its turns in the variant that goes round, and only there.
"""

from functools import cache

import numpy as np

from ..reference import plane_pendulum
from ..reference.checked import Array
from . import hinged, observables, pictures
from .body import Body, Joint, diagonal
from .scene import Scene, every_scheme
from .trajectory import Trajectory

#: Mass [kg], distance of the centre of mass [m], its moment about any axis [kg m²], g [m/s²].
MASS, ARM, MOMENT, G = 1.2, 0.4, 0.004, 9.81
#: Length [m] of the point pendulum that swings alike, I/(ml).
LENGTH = (MOMENT + MASS * ARM**2) / (MASS * ARM)
AXIS, HINGE = (0.6, 0.8, 0.0), (0.3, -0.2, 0.1)


def _truth(scene: Scene, t: Array) -> Trajectory:
    theta, rate = plane_pendulum.motion(G, LENGTH, scene.q0[0], scene.v0[0], t)
    return hinged.motion(scene.bodies, t, theta[:, None], rate[:, None])


@cache
def _rate(scene: Scene) -> float:
    """Swings or turns of 2π a second [rad/s]."""
    if scene.variant == "round":
        fastest = np.hypot(scene.v0[0], 2 * np.sqrt(G / LENGTH) * np.sin(scene.q0[0] / 2))
        return 2 * np.pi / plane_pendulum.rotation_period(G, LENGTH, float(fastest))
    sine = np.hypot(np.sin(scene.q0[0] / 2), scene.v0[0] / (2 * np.sqrt(G / LENGTH)))
    return 2 * np.pi / plane_pendulum.period(G, LENGTH, float(2 * np.arcsin(sine)))


def _swinging(scene: Scene, motion: Trajectory) -> Array:
    """A closed curve round 0, once a swing or once a turn."""
    angle, speed = motion.joint_position[:, 0], motion.joint_velocity[:, 0]
    if scene.variant == "round":
        return np.asarray(np.exp(1j * angle))
    return np.asarray(angle - 1j * speed / np.sqrt(G / LENGTH))


def _pendulum(variant: str, summary: str, start: tuple[float, float]) -> Scene:
    return Scene(
        name="large_pendulum",
        variant=variant,
        summary=f"A pendulum on a horizontal hinge, {summary}.",
        source="Landau & Lifshitz, Mechanics, § 11 problem 1; Whittaker, Analytical Dynamics, § 44",
        bodies=(
            Body(
                "pendulum",
                MASS,
                diagonal(MOMENT, MOMENT, MOMENT),
                (Joint("hinge", "hinge", AXIS),),
                center_of_mass=(0.0, 0.0, -ARM),
                position=HINGE,
            ),
        ),
        gravity=(0.0, 0.0, -G),
        q0=start[:1],
        v0=start[1:],
        duration=2.5,
        samples=125,
        truth=_truth,
        observables=(
            observables.orientation(),
            observables.omega(),
            observables.position(),
            observables.velocity(),
            hinged.angle(),
            observables.rate("frequency", _swinging, _rate),
            observables.energy(),
            hinged.residual(),
        ),
        pictures=(pictures.against_time("Angle", "θ [rad]", lambda scene, m: m.joint_position[:, 0]),),
        ladders={1: (2e-3, 1e-3, 5e-4, 2.5e-4, 1.25e-4), 4: (1e-2, 5e-3, 2.5e-3, 1.25e-3, 6.25e-4)},
        errors=every_scheme(ERRORS[variant], *ALIKE),
    )


#: On one hinge nothing is gyroscopic and nothing damped: these two are alike.
ALIKE = ("semi-implicit Euler", "implicit gyroscopic")
#: C of C·dt^order of each observable in turn, measured by benchmarks/error_constants.py with MuJoCo 4.0.0.
ERRORS: dict[str, dict[str, tuple[float, ...]]] = {
    "swing": {
        "semi-implicit Euler": (58.0, 170.0, 24.0, 220.0, 58.0, 12.0, 33.0, 0.0),
        "RKMK4": (140.0, 360.0, 54.0, 500.0, 140.0, 25.0, 41.0, 0.0),
    },
    "round": {
        "semi-implicit Euler": (120.0, 290.0, 46.0, 460.0, 120.0, 34.0, 37.0, 0.0),
        "RKMK4": (110.0, 260.0, 43.0, 440.0, 110.0, 30.0, 53.0, 0.0),
    },
}

SCENES = (
    _pendulum("swing", "to and fro between ±2.5 rad", (1.0, -8.0)),
    # Faster, and Runge-Kutta's energy drift of order 5 hides the phase error of order 4 at these steps.
    _pendulum("round", "over the top, round and round", (1.0, 9.0)),
)
