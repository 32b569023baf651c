"""A symmetric top on a fixed point under gravity: it precesses and nutates."""

from . import observables, pictures, pivoted_top
from .body import Vector
from .scene import Scene, every_scheme

#: Mass [kg], distance of the centre of mass [m], moments about the fixed point [kg m²], g [m/s²].
MASS, LENGTH, I1, I3, G = 1.0, 0.05, 0.0065, 0.0075, 9.81
TILTED = (0.28, 0.0, 0.0, 0.96)


Ladders = dict[int | str, tuple[float, ...]]


def _top(variant: str, summary: str, omega0: Vector, samples: int, ladders: Ladders) -> Scene:
    return Scene(
        name="heavy_top",
        variant=variant,
        summary=f"A symmetric top on a fixed point, {summary}.",
        source="Landau & Lifshitz, Mechanics, § 35 problem 1; Goldstein, Classical Mechanics, ch. 5.7",
        bodies=(pivoted_top.top(MASS, LENGTH, I1, I3),),
        gravity=(0.0, 0.0, -G),
        q0=TILTED,
        v0=omega0,
        duration=2.0,
        samples=samples,
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
        ),
        pictures=(pictures.tip("Tip of the top"),),
        ladders=ladders,
        errors=every_scheme(ERRORS[variant], like="semi-implicit Euler"),
    )


#: C of C·dt^order of each observable in turn, measured by benchmarks/error_constants.py with MuJoCo 4.0.0.
ERRORS: dict[str, dict[str, tuple[float, ...]]] = {
    "moderate": {
        "semi-implicit Euler": (20.0, 85.0, 1.5, 23.0, 1.8, 0.47, 0.0, 0.0),
        "implicit gyroscopic": (13.0, 71.0, 0.31, 17.0, 2.4, 0.5, 0.0, 0.0),
        "RKMK4": (420.0, 2400.0, 300.0, 150.0, 12.0, 1.9, 0.0, 0.0),
    },
    "fast": {
        "semi-implicit Euler": (13.0, 630.0, 0.072, 1.1, 6.4, 2.3, 0.0, 0.0),
        "implicit gyroscopic": (11.0, 500.0, 0.031, 1.5, 3.6, 2.3, 0.0, 0.0),
        "RKMK4": (1.8e5, 2.8e5, 1.7e5, 8.0e4, 2.6e4, 4.6e4, 0.0, 0.0),
    },
    "cusps": {
        "semi-implicit Euler": (19.0, 85.0, 1.1, 24.0, 2.1, 0.51, 0.0, 0.0),
        "implicit gyroscopic": (18.0, 78.0, 1.3, 23.0, 2.1, 0.52, 0.0, 0.0),
        "RKMK4": (420.0, 2200.0, 280.0, 140.0, 14.0, 2.2, 0.0, 0.0),
    },
}
SLOW: Ladders = {1: (2e-3, 1e-3, 5e-4, 2.5e-4, 1.25e-4), 4: (1e-2, 5e-3, 2.5e-3, 1.25e-3, 6.25e-4)}
FAST: Ladders = {1: (1e-3, 5e-4, 2.5e-4, 1.25e-4, 6.25e-5), 4: (4e-3, 2e-3, 1e-3, 5e-4, 2.5e-4)}

SCENES = (
    _top("moderate", "spinning at 20 rad/s: deep nutation in loops", (1.5, 0.5, 20.0), 200, SLOW),
    # Beyond 100 rad/s, where an engine that bounds velocities would show it.
    _top("fast", "spinning at 120 rad/s: fast shallow nutation", (1.5, 0.5, 120.0), 250, FAST),
    _top("cusps", "released at rest at 20 rad/s of spin: its tip draws cusps", (0.0, 0.0, 20.0), 200, SLOW),
)
