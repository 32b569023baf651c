"""A spinning body that flies, and one that circles a centre: what its orbit has and what its spin has.

L and T are each a part of the centre of mass and a part about it. A force through the centre of mass leaves
the spin's parts alone; one that also points at the origin leaves L_orbital too. Catches an engine whose force
misses the centre of mass: L and the energy are kept as they should be, and only their parts change.
"""

import numpy as np

from ..reference import torque_free
from ..reference.checked import Array
from . import mechanics, observables, pictures
from .body import Body, Joint, Vector, diagonal
from .observables import Observable
from .scene import Scene
from .trajectory import Trajectory

#: Mass [kg], principal moments [kg m²], stiffness of the pull towards the origin [N/m], g [m/s²].
MASS, MOMENTS, STIFFNESS, G = 1.5, (0.02, 0.03, 0.04), 24.0, 9.81
PLACE, VELOCITY = (0.4, -0.3, 0.5), (0.9, 1.1, 0.6)
ATTITUDE, OMEGA = (0.1, 0.7, -0.1, 0.7), (1.5, 0.8, 4.0)
#: Of the circling, √(k/m) [rad/s].
RATE = float(np.sqrt(STIFFNESS / MASS))


def _truth(scene: Scene, t: Array) -> Trajectory:
    q, omega = torque_free.motion(MOMENTS, scene.q0[3:], scene.v0[3:], t)
    place, speed, t_ = np.array(scene.q0[:3]), np.array(scene.v0[:3]), t[:, None]
    none = np.empty((len(t), 0))
    if scene.variant == "flight":
        position = place + speed * t_ + np.array(scene.gravity) * t_**2 / 2
        velocity = speed + np.array(scene.gravity) * t_
        joints = none, none
    else:
        cos, sin = np.cos(RATE * t_), np.sin(RATE * t_)
        position = place * cos + speed / RATE * sin
        velocity = speed * cos - place * RATE * sin
        joints = position, velocity
    return Trajectory(t, position[:, None], q[:, None], velocity[:, None], omega[:, None], *joints)


def _kept(name: str, unit: str, part: str) -> Observable:
    """A part of L or T that stays as it is; its round-off is measured against itself."""
    compute = getattr(mechanics, part)

    def scale(scene: Scene, motion: Trajectory) -> float:
        found = compute(scene, motion)
        return float(np.abs(found).max())

    return observables.invariant(name, unit, compute, scale)


def _orbital_energy(scene: Scene, motion: Trajectory) -> Array:
    return mechanics.orbital_energy(scene, motion) + mechanics.potential_energy(scene, motion)


def _upright(scene: Scene, motion: Trajectory) -> Array:
    """The component of L_orbital that a vertical force leaves alone."""
    return mechanics.orbital_momentum_world(scene, motion)[:, 2]


def _circling(scene: Scene, motion: Trajectory) -> Array:
    """One coordinate and its velocity over the rate: a circle."""
    return np.asarray(motion.position[:, 0, 0] - 1j * motion.velocity[:, 0, 0] / RATE)


def _parted(scene: Scene, motion: Trajectory) -> Array:
    """What the joints' own coordinates and the body's place and velocity differ by."""
    places = motion.position[:, 0] - motion.joint_position
    return np.hstack([places, motion.velocity[:, 0] - motion.joint_velocity])


SPIN = (
    _kept("L_spin", "kg m²/s", "spin_momentum_world"),
    _kept("T_about", "J", "spin_energy"),
)
ENERGY = observables.invariant(
    "T_cm + V", "J", _orbital_energy, lambda scene, b: float(mechanics.orbital_energy(scene, b).max())
)
FLIGHT = (
    observables.invariant("L_orbital, vertical", "kg m²/s", _upright, mechanics.angular_momentum_scale),
)
ORBIT = (
    _kept("L_orbital", "kg m²/s", "orbital_momentum_world"),
    observables.rate("circling", _circling, lambda scene: RATE),
    observables.invariant("joint residual", "1", _parted, lambda scene, b: float(np.abs(b.velocity).max())),
)
#: Along x, y and z towards the origin, and free to turn: nothing but a force through the centre of mass.
SLIDES: tuple[Vector, ...] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
PULLED = (
    *(Joint(f"along {x}", "slide", axis, stiffness=STIFFNESS) for x, axis in zip("xyz", SLIDES, strict=True)),
    Joint("turning", "ball"),
)


def _body(
    variant: str, summary: str, joints: tuple[Joint, ...], g: float, more: tuple[Observable, ...]
) -> Scene:
    return Scene(
        name="orbit_and_spin",
        variant=variant,
        summary=f"A tumbling body {summary}: L and T of its orbit and of its spin.",
        source="Goldstein, Classical Mechanics, § 1.2; Taylor, Classical Mechanics, § 10.1",
        bodies=(Body("body", MASS, diagonal(*MOMENTS), joints),),
        gravity=(0.0, 0.0, -g),
        q0=(*PLACE, *ATTITUDE),
        v0=(*VELOCITY, *OMEGA),
        duration=2.0,
        samples=100,
        truth=_truth,
        observables=(
            observables.orientation(),
            observables.omega(),
            observables.position(),
            observables.velocity(),
            *SPIN,
            ENERGY,
            *more,
            observables.unit_norm(),
        ),
        pictures=(
            pictures.Picture("Path", ("x [m]", "y [m]", "z [m]"), lambda scene, m: m.position[:, 0]),
            pictures.tip(),
        ),
        ladders={1: (4e-3, 2e-3, 1e-3, 5e-4, 2.5e-4), 4: (2e-2, 1e-2, 5e-3, 2.5e-3, 1.25e-3)},
        errors=ERRORS[variant],
    )


#: C of C·dt^order of each observable in turn, measured by benchmarks/error_constants.py with MuJoCo 4.0.0.
ERRORS: dict[str, dict[str, tuple[float, ...]]] = {
    "orbit": {
        "semi-implicit Euler": (3.0, 10.0, 1.5, 3.1, 0.15, 0.42, 14.0, 0.0, 0.092, 0.0, 0.0),
        "implicit gyroscopic": (3.3, 9.8, 1.5, 3.1, 0.13, 0.41, 14.0, 0.0, 0.092, 0.0, 0.0),
        "RKMK4": (0.67, 1.8, 13.0, 41.0, 0.089, 0.016, 18.0, 3.6, 8.6, 0.0, 0.0),
        "implicitfast": (3.0, 10.0, 1.5, 3.1, 0.15, 0.42, 14.0, 0.0, 0.092, 0.0, 0.0),
        "discrete": (3.0, 10.0, 9.5, 46.0, 0.15, 0.42, 250.0, 50.0, 0.086, 0.0, 0.0),
    },
    "flight": {
        "semi-implicit Euler": (3.0, 10.0, 9.9, 0.0, 0.15, 0.42, 150.0, 0.0, 0.0),
        "implicit gyroscopic": (3.3, 9.8, 9.9, 0.0, 0.13, 0.41, 150.0, 0.0, 0.0),
        "RKMK4": (0.67, 1.8, 0.0, 0.0, 0.089, 0.016, 0.0, 0.0, 0.0),
        "implicitfast": (3.3, 9.8, 9.9, 0.0, 0.13, 0.41, 150.0, 0.0, 0.0),
        "discrete": (3.3, 9.8, 9.9, 0.0, 0.13, 0.41, 150.0, 0.0, 0.0),
    },
}

SCENES = (
    _body("orbit", "pulled towards a point", PULLED, 0.0, ORBIT),
    _body("flight", "thrown", (Joint("free", "free"),), G, FLIGHT),
)
