"""One body hung twice: by a point of it, and reversed, by the point that swings alike.

The body is skew: its hinges' axis is none of its principal axes. Catches an engine that turns a body about
its hinge with the moment about the centre of mass, or without it, or that drops the products of inertia: the
two then no longer swing together. What the hinges bear catches one that tells m(a − g) without the part that
the turning of the body makes, which leaves a pendulum of a point alone as it is.
"""

from dataclasses import replace
from functools import cache

import numpy as np

from ..reference import compound_pendulum, inertia, quaternions
from ..reference.checked import Array
from . import hinged, observables, pictures, reactions, struck_pendulum
from .body import Body, Joint, Matrix, Vector
from .observables import Observable
from .scene import Scene, every_scheme
from .trajectory import Trajectory

#: Mass [kg], inertia about the centre of mass [kg m²], g [m/s²]; axis of both hinges, horizontal.
MASS, G, AXIS = 1.3, 9.81, (0.6, 0.8, 0.0)
INERTIA: Matrix = ((0.04, 0.006, -0.004), (0.006, 0.03, 0.003), (-0.004, 0.003, 0.02))
#: From the first hinge to the centre of mass [m]; the moment about that hinge [kg m²]; the length I/(ml) of
#: the point pendulum that swings alike, and k²/l, from the centre of mass to the second hinge [m].
ARM = 0.25
MOMENT = float(np.array(AXIS) @ np.array(INERTIA) @ AXIS) + MASS * ARM**2
LENGTH = MOMENT / (MASS * ARM)
BEYOND = LENGTH - ARM
#: Upside down: half a turn about the hinge.
REVERSED = (*AXIS, 0.0)


def _truth(scene: Scene, t: Array) -> Trajectory:
    swings = [
        compound_pendulum.motion(MASS, arm, MASS * arm * LENGTH, G, angle, rate, t)
        for arm, angle, rate in zip((ARM, BEYOND), scene.q0, scene.v0, strict=True)
    ]
    angle, rate = (np.stack(part, axis=1) for part in zip(*swings, strict=True))
    motion = hinged.motion(scene.bodies, t, angle, rate)
    return replace(motion, reaction=_borne(scene, motion)) if scene.reactions else motion


def _borne(scene: Scene, motion: Trajectory) -> Array:
    """What the hinges do to the bodies (n, 2, 6): m(a − g), and what turns them so about their hinges."""
    arms = np.array([body.center_of_mass for body in scene.bodies])
    swung = [
        compound_pendulum.acceleration(MASS, arm, MASS * arm * LENGTH, G, angle)
        for arm, angle in zip((ARM, BEYOND), motion.joint_position.T, strict=True)
    ]
    alpha, omega = np.stack(swung, axis=1)[..., None] * AXIS, motion.omega
    weight = MASS * quaternions.rotated(quaternions.conjugate(motion.quaternion), np.array(scene.gravity))
    carried = quaternions.cross(alpha, arms) + quaternions.cross(omega, quaternions.cross(omega, arms))
    tensors = np.array([inertia.about_point(INERTIA, MASS, arm) for arm in arms])
    turned, spin = (np.einsum("bij,nbj->nbi", tensors, part) for part in (alpha, omega))
    moment = turned + quaternions.cross(omega, spin) - quaternions.cross(arms, weight)
    return np.concatenate([MASS * carried - weight, moment], axis=2)


@cache
def _frequency(scene: Scene) -> float:
    """Swings of 2π a second [rad/s]."""
    sine = np.hypot(np.sin(scene.q0[0] / 2), scene.v0[0] / (2 * np.sqrt(G / LENGTH)))
    return 2 * np.pi / compound_pendulum.period(MASS, ARM, MOMENT, G, float(2 * np.arcsin(sine)))


def _swinging(which: int, name: str) -> Observable:
    def signal(scene: Scene, motion: Trajectory) -> Array:
        angle, speed = motion.joint_position[:, which], motion.joint_velocity[:, which]
        return np.asarray(angle - 1j * speed / np.sqrt(G / LENGTH))

    return observables.rate(f"frequency {name}", signal, _frequency)


def _parting(scene: Scene, motion: Trajectory) -> Array:
    """By what the two swing apart: angles, and rates in units of a small swing's."""
    return np.concatenate(
        [np.diff(motion.joint_position), np.diff(motion.joint_velocity) / np.sqrt(G / LENGTH)], axis=1
    )


def _hung(name: str, hinge: Vector, height: float, quaternion: tuple[float, float, float, float]) -> Body:
    """The body hung by a point that is ``height`` [m] above its centre of mass, in its own axes."""
    return Body(
        name,
        MASS,
        INERTIA,
        (Joint(f"{name} hinge", "hinge", AXIS),),
        center_of_mass=(0.0, 0.0, -height),
        position=hinge,
        quaternion=quaternion,
    )


def _pendulum(variant: str, summary: str, angle: float, rate: float) -> Scene:
    return Scene(
        name="compound_pendulum",
        variant=variant,
        summary=f"A body on a hinge, and the same body hung by its centre of oscillation: {summary}.",
        source="Fowles & Cassiday, Analytical Mechanics, § 8.4; Goldstein, Classical Mechanics, ch. 5",
        bodies=(
            _hung("hung", (0.3, -0.2, 0.1), ARM, (0.0, 0.0, 0.0, 1.0)),
            _hung("reversed", (-0.4, 0.5, 0.2), -BEYOND, REVERSED),
        ),
        gravity=(0.0, 0.0, -G),
        q0=(angle, angle),
        v0=(rate, rate),
        duration=2.0,
        samples=100,
        truth=_truth,
        reactions=("hung", "reversed"),
        observables=(
            observables.orientation(),
            observables.omega(),
            observables.position(),
            observables.velocity(),
            hinged.angle(),
            _swinging(0, "hung"),
            _swinging(1, "reversed"),
            observables.invariant("parting", "rad", _parting, lambda scene, b: float(np.pi)),
            observables.energy(),
            hinged.residual(),
            observables.unit_norm(),
            reactions.force(),
        ),
        pictures=(
            pictures.against_time("Angle as hung", "θ [rad]", lambda scene, m: m.joint_position[:, 0]),
            pictures.against_time("Angle reversed", "θ [rad]", lambda scene, m: m.joint_position[:, 1]),
        ),
        ladders={1: (4e-3, 2e-3, 1e-3, 5e-4, 2.5e-4), 4: (2e-2, 1e-2, 5e-3, 2.5e-3, 1.25e-3)},
        errors=every_scheme(ERRORS[variant], *ALIKE),
    )


#: On one hinge nothing is gyroscopic and nothing damped: these two are alike.
ALIKE = ("semi-implicit Euler", "implicit gyroscopic")
#: C of C·dt^order of each observable in turn, measured by benchmarks/error_constants.py with MuJoCo 4.0.0.
ERRORS: dict[str, dict[str, tuple[float, ...]]] = {
    "small": {
        "semi-implicit Euler": (0.37, 1.9, 0.072, 0.37, 0.37, 0.15, 0.15, 0.0, 0.24, 0.0, 0.0, 2.5),
        "RKMK4": (12.0, 52.0, 2.4, 11.0, 12.0, 30.0, 30.0, 0.0, 0.47, 0.0, 0.0, 80.0),
    },
    "large": {
        "semi-implicit Euler": (69.0, 330.0, 14.0, 130.0, 69.0, 11.0, 11.0, 0.0, 36.0, 0.0, 0.0, 1700.0),
        "RKMK4": (180.0, 840.0, 36.0, 350.0, 180.0, 26.0, 26.0, 0.0, 58.0, 0.0, 0.0, 4400.0),
    },
}


def _as_engines_come(scene: Scene) -> Scene:
    """The scene without its ladders, and without reactions, of which a motor's own would be part."""
    return replace(
        scene,
        variant="defaults",
        summary="What a user gets who sets nothing: two bodies hung from hinges, engines as they come.",
        defaults=True,
        reactions=(),
        observables=scene.observables[:-1],
        ladders={},
        errors={twin: row[:-1] for twin, row in scene.errors.items()},
    )


SMALL = _pendulum("small", "small swings", 0.1, -0.5)
SCENES = (
    SMALL,
    _pendulum("large", "to and fro between ±2.6 rad", 1.2, -8.0),
    _as_engines_come(SMALL),
    *(struck_pendulum.struck(variant, MASS, INERTIA, AXIS, ARM) for variant in struck_pendulum.PLACES),
)
