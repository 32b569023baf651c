"""A top that precesses without nutating: slowly, as the books' rule has it, and fast.

Catches a game engine's gyroscope, which turns its axle by that rule, Mgl/(I3ω3): its tilt stays as it
should, and its slow precession is 12 % too slow. Of the fast one it knows nothing.
"""

import numpy as np

from ..reference import euler_angles
from . import observables, pictures, pivoted_top
from .scene import Scene, every_scheme

#: Mass [kg], distance of the centre of mass [m], moments about the fixed point [kg m²], g [m/s²].
MASS, LENGTH, I1, I3, G = 0.8, 0.06, 0.006, 0.005, 9.81
#: Azimuth, tilt and turn about the axis at the start [rad]; the spin about it [rad/s].
ANGLES, OMEGA3 = (0.7, 0.6, -0.4), 30.0
#: Rates of precession that keep that tilt [rad/s], as `heavy_top.regular_precession` gives them: a test
#: compares. They stand here as numbers so that listing the scenes needs no fifty-digit arithmetic.
RATES = {"slow": 3.556861553852566, "fast": 26.73384630895535}


def _precession(scene: Scene) -> float:
    return RATES[scene.variant]


def _top(variant: str) -> Scene:
    rate = RATES[variant]
    spin = OMEGA3 - rate * np.cos(ANGLES[1])
    return Scene(
        name="regular_precession",
        variant=variant,
        summary=f"A top at a constant tilt, in its {variant} regular precession.",
        source="Goldstein, Classical Mechanics, ch. 5.7; Landau & Lifshitz, Mechanics, § 35",
        bodies=(pivoted_top.top(MASS, LENGTH, I1, I3),),
        gravity=(0.0, 0.0, -G),
        q0=tuple(euler_angles.zyz_attitude(ANGLES).tolist()),
        v0=tuple(euler_angles.zyz_omega(ANGLES, (rate, 0.0, spin)).tolist()),
        duration=1.6,
        samples=100,
        truth=pivoted_top.truth,
        observables=(
            observables.orientation(),
            observables.omega(),
            observables.rate("precession", pivoted_top.from_above, _precession),
            observables.invariant("tilt", "rad", pivoted_top.tilt, lambda scene, b: 1.0),
            observables.energy(),
            observables.vertical_angular_momentum(),
            observables.axial_angular_momentum(),
            observables.unit_norm(),
            observables.position(),
            observables.velocity(),
        ),
        pictures=(
            pictures.tip("Tip of the top"),
            pictures.against_time("Tilt", "β [rad]", pivoted_top.tilt),
        ),
        ladders={1: (4e-3, 2e-3, 1e-3, 5e-4, 2.5e-4), 4: (8e-3, 4e-3, 2e-3, 1e-3, 5e-4)},
        errors=every_scheme(ERRORS[variant], like="semi-implicit Euler"),
    )


#: C of C·dt^order of each observable in turn, measured by benchmarks/error_constants.py with MuJoCo 4.0.0.
ERRORS: dict[str, dict[str, tuple[float, ...]]] = {
    "slow": {
        "semi-implicit Euler": (22.0, 130.0, 2.4, 13.0, 2.7, 0.74, 0.0, 0.0, 0.79, 5.8),
        "implicit gyroscopic": (23.0, 51.0, 2.6, 12.0, 2.8, 0.79, 0.0, 0.0, 0.69, 3.4),
        "RKMK4": (6800.0, 2.4e4, 7000.0, 1200.0, 270.0, 74.0, 0.0, 0.0, 390.0, 1400.0),
    },
    "fast": {
        "semi-implicit Euler": (260.0, 740.0, 180.0, 18.0, 50.0, 1.8, 0.0, 0.0, 9.3, 260.0),
        "implicit gyroscopic": (240.0, 680.0, 170.0, 18.0, 44.0, 1.7, 0.0, 0.0, 8.9, 240.0),
        "RKMK4": (2200.0, 3.1e4, 2300.0, 690.0, 150.0, 5.4, 0.0, 0.0, 130.0, 3300.0),
    },
}
SCENES = (_top("slow"), _top("fast"))
