"""A top set spinning all but upright: below the threshold (I3ω3)² = 4MglI1 it falls, above it sleeps.

Catches an engine that takes a small tilt for none: there a top sleeps at any spin.
"""

import numpy as np

from ..reference import euler_angles, heavy_top_rates, sleeping_top
from ..reference.checked import Array
from . import observables, pictures, pivoted_top
from .observables import Observable
from .scene import Scene, every_scheme
from .trajectory import Trajectory

#: Mass [kg], distance of the centre of mass [m], moments about the fixed point [kg m²], g [m/s²].
MASS, LENGTH, I1, I3, G = 0.5, 0.05, 0.002, 0.0012, 9.81
TOP = (MASS, LENGTH, (I1, I3), G)
#: The spin of the threshold [rad/s], as `sleeping_top.threshold_spin` gives it: a test compares.
THRESHOLD = 36.912057650583506
#: Azimuth, tilt and turn about the axis at the start [rad], and the rates of the first two [rad/s].
ANGLES, RATES = (0.7, 5e-3, -0.4), (3.0, 0.02)
#: Tilt up to which the motion counts as small [rad].
SMALL = 0.02


def _part(scene: Scene, motion: Trajectory, other: complex) -> Array:
    """What of ζ = x + iy is left (n,) where exp(iνt) with this ``other`` ν is taken out of it [m/s]."""
    x, y, _ = motion.velocity[:, 0].T
    return np.asarray(x + 1j * y - 1j * other * pivoted_top.from_above(scene, motion))


def _growing(scene: Scene, motion: Trajectory) -> Array:
    return _part(scene, motion, I3 * scene.v0[2] / (2 * I1) + 1j * _growth_rate(scene))


def _growth_rate(scene: Scene) -> float:
    return sleeping_top.growth_rate(*TOP, scene.v0[2])


def _growth(scene: Scene, motion: Trajectory) -> float:
    """Slope of the logarithm of the growing part, as long as it is expected to be small [1/s]."""
    early = motion.t <= np.log(SMALL / ANGLES[1]) / _growth_rate(scene)
    # A top that stops has no logarithm, but it is the engine that is wrong.
    size = np.maximum(np.abs(_growing(scene, motion)[early]), 1e-300)
    return float(np.polyfit(motion.t[early], np.log(size), 1)[0])


def _circling(which: int, name: str) -> Observable:
    def signal(scene: Scene, motion: Trajectory) -> Array:
        return _part(scene, motion, sleeping_top.upright_rates(*TOP, scene.v0[2])[1 - which])

    def exact(scene: Scene) -> float:
        return sleeping_top.upright_rates(*TOP, scene.v0[2])[which]

    return observables.rate(name, signal, exact)


def _largest_tilt(scene: Scene, motion: Trajectory) -> float:
    return float(pivoted_top.tilt(scene, motion).max())


def _lowest(scene: Scene) -> float:
    return heavy_top_rates.turning_points(*pivoted_top.arguments(scene)).beta_lowest


FALLING = (observables.fitted("growth rate", "1/s", _growth, _growth_rate),)
ASLEEP = (
    _circling(0, "slow circling"),
    _circling(1, "fast circling"),
    observables.fitted("largest tilt", "rad", _largest_tilt, _lowest),
)


def _top(variant: str, duration: float, coarsest: float = 1.6e-3) -> Scene:
    part = float(variant)
    omega3 = part * THRESHOLD
    spin = omega3 - RATES[0] * np.cos(ANGLES[1])
    return Scene(
        name="sleeping_top",
        variant=variant,
        summary=f"A top spun all but upright at {variant} of the threshold: it {_WORDS[part > 1]}.",
        source="Goldstein, Classical Mechanics, ch. 5.7; Landau & Lifshitz, Mechanics, § 35 problem 2",
        bodies=(pivoted_top.top(MASS, LENGTH, I1, I3),),
        gravity=(0.0, 0.0, -G),
        q0=tuple(euler_angles.zyz_attitude(ANGLES).tolist()),
        v0=tuple(euler_angles.zyz_omega(ANGLES, (*RATES, spin)).tolist()),
        duration=duration,
        samples=round(duration / 0.0128),
        dt=8e-4,
        truth=pivoted_top.truth,
        observables=(
            observables.orientation(),
            observables.omega(),
            *(ASLEEP if part > 1 else FALLING),
            observables.energy(),
            observables.vertical_angular_momentum(),
            observables.axial_angular_momentum(),
            observables.unit_norm(),
            observables.position(),
            observables.velocity(),
        ),
        pictures=(
            pictures.against_time("Tilt", "β [rad]", pivoted_top.tilt),
            pictures.tip("Tip of the top"),
        ),
        ladders={1: tuple(coarsest / 2**k for k in range(5)), 4: (1.28e-2, 6.4e-3, 3.2e-3, 1.6e-3, 8e-4)},
        errors=every_scheme(ERRORS[variant], like="semi-implicit Euler"),
    )


_WORDS = {True: "sleeps", False: "falls"}

#: C of C·dt^order of each observable in turn, measured by benchmarks/error_constants.py with MuJoCo 4.0.0.
ERRORS: dict[str, dict[str, tuple[float, ...]]] = {
    "0.9": {
        # A growth rate nearly right by chance, 40 times nearer than with the gyroscopic term implicit: 1.1 at
        # these looks, up to 2.0 at up to half as many more.
        "semi-implicit Euler": (120.0, 1400.0, 2.0, 2.3, 0.23, 0.0, 0.0, 5.7, 76.0),
        "implicit gyroscopic": (110.0, 1200.0, 40.0, 2.4, 0.17, 0.0, 0.0, 5.2, 61.0),
        "RKMK4": (1.9e4, 1.7e5, 1.8e4, 49.0, 17.0, 0.0, 0.0, 920.0, 1.2e4),
    },
    "0.99": {
        "semi-implicit Euler": (290.0, 3300.0, 39.0, 2.5, 0.21, 0.0, 0.0, 15.0, 180.0),
        "implicit gyroscopic": (280.0, 3100.0, 47.0, 1.6, 0.16, 0.0, 0.0, 14.0, 160.0),
        "RKMK4": (6.0e4, 4.6e5, 1.1e5, 66.0, 3.6, 0.0, 0.0, 2400.0, 2.7e4),
    },
    "1.01": {
        "semi-implicit Euler": (25.0, 290.0, 220.0, 530.0, 1.1, 0.036, 0.0031, 0.0, 0.0, 1.3, 15.0),
        "implicit gyroscopic": (24.0, 260.0, 340.0, 420.0, 2.9, 0.033, 0.0032, 0.0, 0.0, 1.2, 13.0),
        "RKMK4": (5900.0, 6.2e4, 2.5e5, 2.0e5, 2900.0, 1.8, 0.15, 0.0, 0.0, 300.0, 3100.0),
    },
    "1.1": {
        "semi-implicit Euler": (2.2, 30.0, 11.0, 32.0, 0.044, 0.0034, 0.0003, 0.0, 0.0, 0.11, 1.5),
        "implicit gyroscopic": (2.1, 22.0, 19.0, 6.9, 0.8, 0.003, 0.00036, 0.0, 0.0, 0.11, 1.1),
        "RKMK4": (990.0, 7900.0, 1.3e5, 5.9e4, 140.0, 0.35, 0.044, 0.0, 0.0, 50.0, 400.0),
    },
}
SCENES = (_top("0.9", 1.024), _top("0.99", 2.048), _top("1.01", 1.28, 8e-4), _top("1.1", 1.024))
