"""Four stones that fall together towards a distant mass and part: the tide at the near, far and side points.

Catches an engine that takes the pull at one place for all, as uniform gravity would: nothing parts.
"""

from dataclasses import replace

import numpy as np

from ..reference import kepler_orbit, tides
from ..reference.checked import Array
from . import observables, pictures, spheres
from .forces import Center
from .observables import Observable
from .scene import Scene
from .trajectory import Trajectory

MASSES = {"centre": 4.0, "near": 1.0, "far": 2.0, "side": 3.0}
#: Of the distant mass [m³/s²], its place, the distance of the centre from it and of the points from that [m].
GM, MOON, DISTANCE, RADIUS = 400.0, (3.0, -4.0, 5.0), 10.0, 1.0
#: From the distant mass to the centre, and across.
ALONG, ACROSS = np.array((2.0, -1.0, 2.0)) / 3, np.array((2.0, 2.0, -1.0)) / 3
POINTS = np.array((0 * ALONG, -RADIUS * ALONG, RADIUS * ALONG, RADIUS * ACROSS))
#: Common to all at the start [m/s]: an orbit about the distant mass, but a round one.
VELOCITY = 5.0 * ACROSS + 1.0 * ALONG + 2.0 * np.cross(ALONG, ACROSS)
#: What the relative velocities over the run are fitted by, a polynomial of this degree in time.
DEGREE = 6


def _truth(scene: Scene, t: Array) -> Trajectory:
    starts = zip(*spheres.start(scene), strict=True)
    orbits = [kepler_orbit.motion(GM, place - MOON, velocity, t) for place, velocity in starts]
    r, v = (np.stack(parts, axis=1) for parts in zip(*orbits, strict=True))
    return spheres.flying(scene, t, r + MOON, v)


def _tide(number: int, name: str, outward: float) -> Observable:
    """The acceleration of a point relative to the centre at the start: outward, or inward at the side."""
    direction = outward * POINTS[number] / RADIUS

    def value(scene: Scene, motion: Trajectory) -> float:
        parting = (motion.velocity[:, number] - motion.velocity[:, 0]) @ direction
        fit = np.polynomial.Polynomial.fit(motion.t, parting, DEGREE)
        return float(fit.deriv()(0.0))

    def exact(scene: Scene) -> float:
        return tides.tide_at_named_points(GM, DISTANCE, RADIUS)[number - 1]

    fitted = observables.fitted(f"tide at the {name} point", "m/s²", value, exact)
    # The tide is the difference of two pulls: its round-off is theirs.
    return replace(fitted, scale=lambda scene, b: GM / DISTANCE**2)


#: C of C·dt^order of each observable in turn, measured by benchmarks/error_constants.py with MuJoCo 4.0.0.
ERRORS: dict[str, tuple[float, ...]] = {
    "RKMK4": (0.0075, 0.0071, 0.0, 0.0039, 0.0018, 0.0006, 0.0, 0.047, 0.0),
    **dict.fromkeys(
        # No force is treated implicitly, and spheres have no gyroscopic term: alike in all digits kept.
        ("semi-implicit Euler", "implicit gyroscopic", "implicitfast", "discrete"),
        (3.6, 2.0, 0.0, 0.15, 0.1, 0.11, 0.0, 19.0, 0.0),
    ),
}

SCENES = (
    Scene(
        name="tides",
        summary="Four stones fall together towards a distant mass, and its tide draws them apart.",
        source="Taylor, Classical Mechanics, § 9.2",
        **spheres.spheres(MASSES, np.array(MOON) + DISTANCE * ALONG + POINTS, [VELOCITY] * 4),
        forces=(Center(GM, MOON),),
        duration=0.8,
        samples=25,
        dt=2e-3,
        truth=_truth,
        observables=(
            observables.position(),
            observables.velocity(),
            observables.orientation(),
            _tide(1, "near", 1.0),
            _tide(2, "far", 1.0),
            _tide(3, "side", -1.0),
            observables.turning(),
            observables.energy(),
            observables.unit_norm(),
        ),
        pictures=(
            pictures.against_time(
                "Distance of the near point from the far one",
                "[m]",
                lambda scene, m: np.linalg.norm(m.position[:, 1] - m.position[:, 2], axis=1),
            ),
        ),
        ladders={1: (1.6e-2, 8e-3, 4e-3, 2e-3, 1e-3), 4: (3.2e-2, 1.6e-2, 8e-3, 4e-3, 2e-3)},
        errors=ERRORS,
    ),
)
