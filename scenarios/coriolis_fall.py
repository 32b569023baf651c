"""Free flight over a turning planet: dropped from 100 m at Earth's equator, and thrown where it turns fast.

Catches an engine that takes a force from the velocities of the step before (then the prediction of the
scheme's own motion fails, and Runge-Kutta its order), or with the sign or the half of Coriolis' force.
"""

import numpy as np

from ..reference import rotating_frames, schemes
from ..reference.checked import Array
from . import observables, pictures, spheres
from .body import Vector
from .forces import Coriolis
from .observables import Observable
from .scene import Scene
from .trajectory import Trajectory

MASS, G = 2.0, 9.81
#: Turns [rad/s] and colatitude [rad] of each variant: Earth at its equator, and 7000 times as fast elsewhere.
PLANETS = {"dropped": (7.292e-5, np.pi / 2), "thrown": (0.5, 0.7)}
SCHEMES: dict[str, schemes.Scheme] = {
    "semi-implicit Euler": "semi_implicit_euler",
    # No force is treated implicitly, and a sphere has no gyroscopic term.
    "implicit gyroscopic": "semi_implicit_euler",
    "implicitfast": "semi_implicit_euler",
    "discrete": "semi_implicit_euler",
    "RKMK4": "rk4",
}


def _truth(scene: Scene, t: Array) -> Trajectory:
    place, velocity = (part[0] for part in spheres.start(scene))
    r, v = rotating_frames.coriolis_fall(*PLANETS[scene.variant], G, place, velocity, t)
    return spheres.flying(scene, t, r[:, None], v[:, None])


def _scheme_motion(scene: Scene, twin: str, dt: float, t: Array) -> Trajectory | None:
    """r̈ = g + 2ṙ×Ω is r̈ + Cṙ = g with Cv = 2Ω×v."""
    if twin not in SCHEMES:
        return None
    place, velocity = (part[0] for part in spheres.start(scene))
    C = np.cross(2 * rotating_frames.local_rotation(*PLANETS[scene.variant]), np.eye(3)).T
    r, v = schemes.linear_motion(
        SCHEMES[twin], np.eye(3), np.zeros((3, 3)), place, velocity, dt, np.rint(t / dt), C, scene.gravity
    )
    return spheres.flying(scene, t, r[:, None], v[:, None])


def _eastward(scene: Scene, motion: Trajectory) -> float:
    return float(motion.position[-1, 0, 0] - motion.position[0, 0, 0])


def _to_first_order(scene: Scene) -> float:
    return float(rotating_frames.eastward_deflection(*PLANETS["dropped"], G, np.array([scene.duration]))[0])


def _gyrating(scene: Scene, motion: Trajectory) -> Array:
    """Acceleration across the axis, which turns backwards at 2Ω: as complex numbers."""
    omega = rotating_frames.local_rotation(*PLANETS[scene.variant])
    felt = np.array(scene.gravity) + 2 * np.cross(motion.velocity[:, 0], omega)
    inward = np.cross(omega / np.linalg.norm(omega), (1.0, 0.0, 0.0))
    return np.asarray(felt[:, 0] - 1j * (felt @ inward))


def _twice(scene: Scene) -> float:
    return 2 * PLANETS[scene.variant][0]


def _fall(
    variant: str, summary: str, height: float, velocity: Vector, duration: float, own: Observable
) -> Scene:
    """``duration`` [s] of a fall from ``height`` [m], axes east, north and up."""
    omega = tuple(rotating_frames.local_rotation(*PLANETS[variant]).tolist())
    return Scene(
        name="coriolis_fall",
        variant=variant,
        summary=f"A stone {summary}, seen from the ground.",
        source="Taylor, Classical Mechanics, § 9.8; Landau & Lifshitz, Mechanics, § 39, problem 1",
        **spheres.spheres({"stone": MASS}, [(0.0, 0.0, height)], [velocity]),
        gravity=(0.0, 0.0, -G),
        forces=(Coriolis(omega),),
        duration=duration,
        samples=50,
        # The prediction is exact at any step: none asks for a finer one.
        dt=4e-3,
        truth=_truth,
        scheme_motion=_scheme_motion,
        observables=(
            observables.position(),
            observables.velocity(),
            observables.orientation(),
            own,
            observables.turning(),
            observables.energy(),
            observables.unit_norm(),
        ),
        pictures=(
            pictures.Picture("Path", ("east [m]", "north [m]", "up [m]"), lambda scene, m: m.position[:, 0]),
        ),
        ladders=dict.fromkeys((1, 4), (3.2e-2, 1.6e-2, 3.2e-2 / 3, 8e-3, 4e-3)),
    )


SCENES = (
    _fall(
        "thrown",
        "thrown over a planet that turns once in 13 s",
        10.0,
        (3.0, -4.0, 12.0),
        3.2,
        observables.rate("gyration", _gyrating, _twice),
    ),
    _fall(
        "dropped",
        "dropped from 100 m at Earth's equator",
        100.0,
        (0.0, 0.0, 0.0),
        4.8,
        observables.fitted("eastward deflection", "m", _eastward, _to_first_order),
    ),
)
