"""Two bodies that pull on each other: by a spring, and by Newton's attraction on a round and a long orbit.

Their centre of mass drifts; neither turns. Catches an engine that takes a force along the axes of a body
and not of the world, that lets it act beside the centre of mass, or on one of the two alone.
"""

from functools import cache

import numpy as np

from ..reference import kepler_orbit, scheme_stability, schemes, two_body
from ..reference.checked import Array
from . import observables, pictures, spheres
from .forces import Attraction, Force, Spring
from .observables import Observable
from .scene import Scene, every_scheme
from .trajectory import Trajectory

M1, M2 = 2.0, 3.0
#: The first less the second at the start of each variant; no symmetry of the orbit is near.
STIFFNESS, PERIOD, SIZE = 30.0, 2.0, 1.0
#: Of the attraction [m³/(kg s²)], from Kepler's third law.
G = (2 * np.pi / PERIOD) ** 2 * SIZE**3 / (M1 + M2)
DRIFT = np.array((0.3, -0.2, 0.1))
#: Two axes across each other, at right angles to none of the world's: the plane of the orbits.
AXES = np.array(((2.0, -1.0, 2.0), (2.0, 2.0, -1.0))) / 3
SCHEMES: dict[str, schemes.Scheme] = {
    "semi-implicit Euler": "semi_implicit_euler",
    # No force is treated implicitly, and spheres have no gyroscopic term.
    "implicit gyroscopic": "semi_implicit_euler",
    "implicitfast": "semi_implicit_euler",
    "discrete": "semi_implicit_euler",
    "RKMK4": "rk4",
}


def _spring_truth(scene: Scene, t: Array) -> Trajectory:
    places, velocities = spheres.start(scene)
    return spheres.flying(scene, t, *two_body.spring_motion(M1, M2, STIFFNESS, places, velocities, t))


def _orbit_truth(scene: Scene, t: Array) -> Trajectory:
    places, velocities = spheres.start(scene)
    return spheres.flying(scene, t, *two_body.gravity_motion(M1, M2, G, places, velocities, t))


def _scheme_motion(scene: Scene, twin: str, dt: float, t: Array) -> Trajectory | None:
    if twin not in SCHEMES:
        return None
    T = np.kron(np.diag([M1, M2]), np.eye(3))
    V = np.kron(STIFFNESS * np.array([[1.0, -1.0], [-1.0, 1.0]]), np.eye(3))
    r0, v0 = (part.ravel() for part in spheres.start(scene))
    found = schemes.linear_motion(SCHEMES[twin], T, V, r0, v0, dt, np.rint(t / dt))
    return spheres.flying(scene, t, *(part.reshape(-1, 2, 3) for part in found))


def _stable_step(scene: Scene, twin: str) -> float | None:
    return scheme_stability.largest_stable_step(SCHEMES[twin], _frequency(scene)) if twin in SCHEMES else None


def _apart(motion: Trajectory) -> tuple[Array, Array]:
    """The first less the second, place and velocity (n, 3)."""
    return motion.position[:, 0] - motion.position[:, 1], motion.velocity[:, 0] - motion.velocity[:, 1]


@cache
def _frequency(scene: Scene) -> float:
    if scene.variant == "spring":
        return float(np.sqrt(STIFFNESS / two_body.reduced_mass(M1, M2)))
    r, v = (first - second for first, second in spheres.start(scene))
    return float(2 * np.pi / kepler_orbit.orbit(G * (M1 + M2), r, v).period)


def _swing(scene: Scene, motion: Trajectory) -> Array:
    r, v = _apart(motion)
    return np.asarray(r @ AXES[0] - 1j * (v @ AXES[0]) / _frequency(scene))


def _longitude(scene: Scene, motion: Trajectory) -> Array:
    r, _ = _apart(motion)
    return np.asarray(r @ AXES[0] + 1j * (r @ AXES[1]))


def _eccentricity(scene: Scene, motion: Trajectory) -> Array:
    """Towards the nearest point, as long as the eccentricity: fixed for an attraction as 1/r² alone."""
    r, v = _apart(motion)
    distance = np.linalg.norm(r, axis=1, keepdims=True)
    return np.asarray(np.cross(v, np.cross(r, v)) / (G * (M1 + M2)) - r / distance)


def _pair(
    variant: str,
    summary: str,
    force: Force,
    apart: tuple[float, float],
    parting: tuple[float, float],
    own: tuple[Observable, ...],
) -> Scene:
    """Two bodies ``apart`` and ``parting`` along ``AXES`` [m], [m/s]."""
    shares = np.array([[M2], [-M1]]) / (M1 + M2)
    places, velocities = shares * (np.array(apart) @ AXES), DRIFT + shares * (np.array(parting) @ AXES)
    spring = isinstance(force, Spring)
    return Scene(
        name="two_body",
        variant=variant,
        summary=f"Two bodies {summary}, their centre of mass adrift.",
        source="Goldstein, Classical Mechanics, ch. 3.1, 3.7, 3.8; Taylor, Classical Mechanics, §§ 8.2–8.3",
        **spheres.spheres({"first": M1, "second": M2}, places, velocities),
        forces=(force,),
        # The long orbit starts just before its nearest point: there the scheme is put to the test.
        duration=0.5 if "0.9" in variant else 1.0,
        samples=25,
        truth=_spring_truth if spring else _orbit_truth,
        scheme_motion=_scheme_motion if spring else None,
        stable_step=_stable_step if spring else None,
        observables=(
            observables.position(),
            observables.velocity(),
            observables.orientation(),
            *own,
            observables.turning(),
            observables.energy(),
            observables.momentum(),
            observables.angular_momentum(),
            observables.unit_norm(),
        ),
        pictures=(
            pictures.Picture(
                "The first seen from the second", ("x [m]", "y [m]", "z [m]"), lambda scene, m: _apart(m)[0]
            ),
        ),
        dt=min(1e-3, *(max(ladder) for ladder in LADDERS[variant].values())),
        ladders=LADDERS[variant],
        errors=every_scheme(ERRORS[variant], *ALIKE) if variant in ERRORS else {},
    )


def _kepler(eccentricity: float, anomaly: float) -> Scene:
    """An orbit about AXES[0], from this eccentric anomaly [rad]."""
    c, s, flat = np.cos(anomaly), np.sin(anomaly), np.sqrt(1 - eccentricity**2)
    rate = 2 * np.pi / PERIOD / (1 - eccentricity * c)
    return _pair(
        f"kepler e={eccentricity:g}",
        f"that attract each other, on an orbit of eccentricity {eccentricity:g}",
        Attraction("first", "second", float(G)),
        (SIZE * float(c - eccentricity), SIZE * float(flat * s)),
        (-SIZE * rate * float(s), SIZE * rate * float(flat * c)),
        (
            observables.rate("mean motion", _longitude, _frequency),
            observables.invariant("eccentricity vector", "1", _eccentricity, lambda scene, b: 1.0),
        ),
    )


LADDERS: dict[str, dict[int | str, tuple[float, ...]]] = {
    "spring": {1: (8e-3, 4e-3, 2e-3, 1e-3, 5e-4), 4: (2e-2, 1e-2, 5e-3, 2.5e-3, 1.25e-3)},
    "kepler e=0.1": {1: (8e-3, 4e-3, 2e-3, 1e-3, 5e-4), 4: (2e-2, 1e-2, 5e-3, 2.5e-3, 1.25e-3)},
    "kepler e=0.9": {1: (2e-3, 1e-3, 5e-4, 2.5e-4, 1.25e-4), 4: (5e-4, 2.5e-4, 1.25e-4, 6.25e-5, 3.125e-5)},
}
#: No force is treated implicitly, and spheres have no gyroscopic term: these two are alike.
ALIKE = ("semi-implicit Euler", "implicit gyroscopic")
#: C of C·dt^order of each observable in turn, measured by benchmarks/error_constants.py with MuJoCo 4.0.0.
ERRORS: dict[str, dict[str, tuple[float, ...]]] = {
    "kepler e=0.1": {
        "semi-implicit Euler": (5.7, 9.4, 0.0, 8.1, 3.2, 0.0, 2.3, 0.0, 0.0, 0.0),
        "RKMK4": (7.8, 21.0, 0.0, 9.8, 2.9, 0.0, 5.8, 0.0, 0.82, 0.0),
    },
    "kepler e=0.9": {
        "semi-implicit Euler": (27.0, 260.0, 0.0, 49.0, 74.0, 0.0, 2400.0, 0.0, 0.0, 0.0),
        "RKMK4": (1.1e7, 3.6e7, 0.0, 1.5e7, 5.1e6, 0.0, 8.2e7, 0.0, 3.9e5, 0.0),
    },
}

SCENES = (
    _pair(
        "spring",
        "on a spring",
        Spring("first", "second", STIFFNESS),
        (0.5, 0.3),
        (-1.0, 1.6),
        (observables.rate("frequency", _swing, _frequency),),
    ),
    _kepler(0.1, 0.7),
    _kepler(0.9, 5.5),
)
