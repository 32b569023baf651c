"""Poinsot's construction: the inertia ellipsoid of a free body rolls on a plane fixed in space.

An asteroid's slow tumbling, 0.4 rad/s, catches an engine that lets slow bodies fall asleep: Bullet does so
below 1 rad/s after two seconds, unless it is told not to.
"""

import numpy as np

from ..reference import poinsot_construction as construction
from ..reference import quaternions, wobble
from ..reference.checked import Array
from . import free_body, observables
from .body import Body, Joint, Vector, diagonal
from .observables import Observable
from .pictures import Picture
from .scene import Scene, every_scheme
from .trajectory import Trajectory

ATTITUDE = (-0.5, 0.1, 0.5, 0.7)
VELOCITY = (0.01, 0.02, -0.01)


def _moments(scene: Scene) -> Array:
    return np.asarray(np.diag(scene.bodies[0].inertia_array))


def _contact(scene: Scene, motion: Trajectory) -> Array:
    """ρ = ω/√(2T) in body axes (n, 3), T being what the body starts with: a body that stops is no error."""
    omega0 = np.array(scene.v0[3:])
    return np.asarray(motion.omega[:, 0] / np.sqrt(_moments(scene) @ omega0**2))


def _contact_world(scene: Scene, motion: Trajectory) -> Array:
    return quaternions.rotated(motion.quaternion[:, 0], _contact(scene, motion))


def _herpolhode(scene: Scene, motion: Trajectory) -> Array:
    """The point of contact on the plane, as complex numbers (n,) about the foot of L."""
    return free_body.around_momentum(scene, _contact_world(scene, motion))


def _plane_distance(scene: Scene, motion: Trajectory) -> Array:
    return np.asarray(_contact_world(scene, motion) @ free_body.momentum_direction(scene))


def _polhode(scene: Scene, motion: Trajectory) -> Array:
    return free_body.around_axis(scene, motion.omega[:, 0])


def _polhode_rate(scene: Scene) -> float:
    return 2 * np.pi / wobble.flip_period(_moments(scene), scene.v0[3:])


def _radius(which: int, name: str) -> Observable:
    def value(scene: Scene, motion: Trajectory) -> float:
        radii = np.abs(_herpolhode(scene, motion))
        return float((radii.min(), radii.max())[which])

    def exact(scene: Scene) -> float:
        return construction.herpolhode_radii(_moments(scene), scene.v0[3:])[which]

    return observables.fitted(name, "kg^-1/2 m^-1", value, exact)


def _herpolhode_rate(scene: Scene) -> float:
    """Mean over one round of the polhode, of the exact motion itself."""
    t = np.linspace(0.0, 2 * np.pi / _polhode_rate(scene), 1001)
    phase = np.unwrap(np.angle(_herpolhode(scene, scene.truth(scene, t))))
    return float((phase[-1] - phase[0]) / t[-1])


def _asteroid(variant: str, moments: Vector, words: str) -> Scene:
    return Scene(
        name="poinsot_construction",
        variant=variant,
        summary=f"A slowly tumbling body: its inertia ellipsoid rolls on the invariable plane, {words}.",
        source="Goldstein, Classical Mechanics, ch. 5.6; Landau & Lifshitz, Mechanics, § 37",
        bodies=(Body("asteroid", 4.0, diagonal(*moments), (Joint("free", "free"),)),),
        q0=(-1.0, 2.0, 0.5, *ATTITUDE),
        v0=(*VELOCITY, 0.17, 0.35, -0.11),
        duration=32.0,
        samples=50,
        dt=4e-2,
        truth=free_body.truth,
        observables=(
            observables.orientation(),
            observables.omega(),
            observables.position(),
            # Seen from the tip of the axis, the polhode is run through clockwise.
            observables.rate("polhode", _polhode, lambda scene: -_polhode_rate(scene)),
            observables.rate("herpolhode", _herpolhode, _herpolhode_rate),
            _radius(0, "herpolhode, least radius"),
            _radius(1, "herpolhode, greatest radius"),
            observables.invariant("plane distance", "kg^-1/2 m^-1", _plane_distance, lambda scene, b: 1.0),
            observables.energy(),
            observables.angular_momentum(),
            observables.momentum(),
            observables.unit_norm(),
        ),
        pictures=(
            Picture(
                "Herpolhode: the point of contact on the invariable plane",
                ("ξ [kg^-½ m⁻¹]", "η [kg^-½ m⁻¹]"),
                lambda scene, m: np.column_stack([(z := _herpolhode(scene, m)).real, z.imag]),
            ),
            Picture(
                "Polhode: the point of contact on the inertia ellipsoid",
                ("ρ1 [kg^-½ m⁻¹]", "ρ2 [kg^-½ m⁻¹]", "ρ3 [kg^-½ m⁻¹]"),
                _contact,
            ),
        ),
        ladders={1: (1.6e-1, 8e-2, 4e-2, 2e-2, 1e-2), 4: (6.4e-1, 3.2e-1, 1.6e-1, 8e-2, 4e-2)},
        errors=every_scheme(ERRORS[variant], like="implicit gyroscopic"),
    )


#: C of C·dt^order of each observable in turn, measured by benchmarks/error_constants.py with MuJoCo 4.0.0.
ERRORS: dict[str, dict[str, tuple[float, ...]]] = {
    "triaxial": {
        "semi-implicit Euler": (2.7, 0.18, 0.0, 0.0012, 0.083, 0.012, 0.18, 0.2, 0.13, 0.5, 0.0, 0.0),
        "implicit gyroscopic": (2.5, 0.17, 0.0, 0.0021, 0.072, 0.088, 0.042, 0.25, 0.11, 0.46, 0.0, 0.0),
        "RKMK4": (
            0.00044,
            4.3e-05,
            0.0,
            5.6e-06,
            7.6e-06,
            0.00012,
            8.1e-05,
            6.3e-05,
            2.5e-06,
            0.00013,
            0.0,
            0.0,
        ),
    },
    "symmetric": {
        "semi-implicit Euler": (2.8, 0.2, 0.0, 0.00072, 0.085, 0.0, 0.13, 0.18, 0.14, 0.55, 0.0, 0.0),
        "implicit gyroscopic": (2.6, 0.19, 0.0, 0.00072, 0.075, 0.17, 0.09, 0.22, 0.12, 0.51, 0.0, 0.0),
        "RKMK4": (
            0.00049,
            4.1e-05,
            0.0,
            6.3e-06,
            6.9e-06,
            0.00015,
            1.2e-06,
            8.7e-05,
            3.3e-06,
            0.00015,
            0.0,
            0.0,
        ),
    },
}
SCENES = (
    _asteroid("triaxial", (3.2, 1.0, 2.7), "between two circles"),
    _asteroid("symmetric", (3.1, 1.0, 3.1), "on one circle"),
)
