"""A solid cone spinning on its tip, which goes round the vertical without ever turning back.

Catches an engine that takes the inertia of the box around a shape for the shape's own.
"""

from ..reference import cone_top, euler_angles
from . import observables, pictures, pivoted_top
from .scene import Scene, every_scheme

#: Mass [kg], radius of the base and height [m], g [m/s²].
MASS, RADIUS, HEIGHT, G = 0.1, 0.06, 0.05, 9.81
#: Azimuth, tilt and turn about the axis at the start [rad], and their rates [rad/s].
ANGLES, RATES = (0.7, 0.5, -0.4), (6.0, 1.2, 75.0)

#: C of C·dt^order of each observable in turn, measured by benchmarks/error_constants.py with MuJoCo 4.0.0.
ERRORS: dict[str, tuple[float, ...]] = {
    "semi-implicit Euler": (77.0, 1600.0, 14.0, 200.0, 1.4, 0.2, 0.0, 0.0, 2.8, 56.0),
    "implicit gyroscopic": (80.0, 1100.0, 20.0, 220.0, 1.2, 0.22, 0.0, 0.0, 2.7, 37.0),
    "RKMK4": (5.7e5, 3.2e6, 1.8e6, 2.7e6, 2100.0, 430.0, 0.0, 0.0, 2.1e4, 1.2e5),
}

SCENES = (
    Scene(
        name="cone_top",
        summary="A solid cone spinning on its tip, in one-way nutation.",
        source="Taylor, Classical Mechanics, § 10.3, example 10.3, and § 10.6; Goldstein, ch. 5.7",
        bodies=(
            pivoted_top.top(
                MASS, cone_top.length(HEIGHT), *cone_top.moments(MASS, RADIUS, HEIGHT), name="cone"
            ),
        ),
        gravity=(0.0, 0.0, -G),
        q0=tuple(euler_angles.zyz_attitude(ANGLES).tolist()),
        v0=tuple(euler_angles.zyz_omega(ANGLES, RATES).tolist()),
        duration=0.64,
        samples=80,
        dt=5e-4,
        truth=pivoted_top.truth,
        observables=(
            observables.orientation(),
            observables.omega(),
            observables.rate("precession", pivoted_top.from_above, pivoted_top.mean_precession),
            observables.rate("nutation", pivoted_top.nutating, pivoted_top.nutation_frequency),
            observables.energy(),
            observables.vertical_angular_momentum(),
            observables.axial_angular_momentum(),
            observables.unit_norm(),
            observables.position(),
            observables.velocity(),
        ),
        pictures=(
            pictures.tip("Axis of the cone"),
            pictures.against_time("Tilt", "β [rad]", pivoted_top.tilt),
        ),
        ladders={1: (5e-4, 2.5e-4, 5e-4 / 3, 1.25e-4, 6.25e-5), 4: (4e-3, 2e-3, 1e-3, 5e-4, 2.5e-4)},
        errors=every_scheme(ERRORS, like="semi-implicit Euler"),
    ),
)
