"""A rocket straight up, its mass falling to a fifth while it burns.

Catches an engine that goes on with the mass it began with, or changes the mass and not all that it had
derived from it.
"""

import numpy as np

from ..reference import rocket
from ..reference.checked import Array
from . import observables, pictures, spheres
from .burning import Burning
from .forces import Constant
from .scene import Scene
from .trajectory import Trajectory

#: Mass [kg], mass burnt per time [kg/s], speed of the exhaust [m/s], g [m/s²], its run [s].
MASS, RATE, EXHAUST, G, BURNT = 10.0, 4.0, 60.0, 9.81, 2.0
START, DRIFT = (1.0, -2.0, 0.5), (0.6, -0.3, 5.0)
FIRST_ORDER = ("semi-implicit Euler", "implicit gyroscopic", "implicitfast", "discrete")


def _flight(scene: Scene, t: Array, z: Array, climb: Array) -> Trajectory:
    """At height ``z`` (n,) [m] and rising by ``climb`` (n,) [m/s], adrift sideways."""
    place, velocity = (part[0] for part in spheres.start(scene))
    r, v = place + np.outer(t, velocity), np.tile(velocity, (len(t), 1))
    r[:, 2], v[:, 2] = z, climb
    return spheres.flying(scene, t, r[:, None], v[:, None])


def _truth(scene: Scene, t: Array) -> Trajectory:
    place, velocity = (part[0] for part in spheres.start(scene))
    z, climb = rocket.rocket_motion(MASS, RATE, EXHAUST, G, t, float(place[2]), float(velocity[2]))
    return _flight(scene, t, z, climb)


def _scheme_motion(scene: Scene, twin: str, dt: float, t: Array) -> Trajectory | None:
    """Of the first-order schemes: each step with the mass at its start, then along by the new velocity."""
    if twin not in FIRST_ORDER:
        return None
    place, velocity = (part[0] for part in spheres.start(scene))
    h, steps = np.longdouble(dt), np.rint(t / dt).astype(int)
    left = MASS - RATE * h * np.arange(steps[-1])
    climb = np.concatenate([[0], np.cumsum(h * (RATE * EXHAUST / left - G))]) + velocity[2]
    z = np.concatenate([[0], np.cumsum(h * climb[1:])]) + place[2]
    return _flight(scene, t, z[steps].astype(np.float64), climb[steps].astype(np.float64))


def _gained(scene: Scene, motion: Trajectory) -> float:
    """What the motor gave [m/s]: the change of velocity beside that by gravity."""
    climb = motion.velocity[:, 0, 2]
    return float(climb[-1] - climb[0] + G * motion.t[-1])


def _exactly_gained(scene: Scene) -> float:
    return float(EXHAUST * np.log(MASS / (MASS - RATE * scene.duration)))


SCENES = (
    Scene(
        name="rocket",
        summary="A rocket straight up: its mass falls to a fifth while it burns.",
        source="Taylor, Classical Mechanics, § 3.2 and problem 3.11",
        **spheres.spheres({"rocket": MASS}, [START], [DRIFT]),
        gravity=(0.0, 0.0, -G),
        forces=(Constant("rocket", (0.0, 0.0, RATE * EXHAUST)),),
        burning=(Burning("rocket", RATE),),
        duration=BURNT,
        samples=50,
        truth=_truth,
        scheme_motion=_scheme_motion,
        observables=(
            observables.position(),
            observables.velocity(),
            observables.orientation(),
            observables.fitted("velocity gained", "m/s", _gained, _exactly_gained),
            observables.turning(),
            observables.unit_norm(),
        ),
        pictures=(pictures.against_time("Upward velocity", "[m/s]", lambda scene, m: m.velocity[:, 0, 2]),),
        ladders={1: (2e-2, 1e-2, 5e-3, 2.5e-3, 1.25e-3)},
    ),
)
