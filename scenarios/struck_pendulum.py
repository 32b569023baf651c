"""A body on a hinge, struck on a peg: at its centre of percussion, where its hinge bears nothing of it.

The peg is a body of its own, welded on, for forces act at centres of mass. Catches an engine that tells what
a hinge bears without taking off what acts on the body from outside; one that lets a blow act at the centre of
the body; and one that asks at every stage of a step whether the blow is on, an error of the first order.
"""

from dataclasses import replace
from functools import cache

import numpy as np

from ..reference import inertia, quaternions, struck_pendulum
from ..reference.checked import Array
from . import hinged, mechanics, observables, pictures, reactions
from .blows import Blow
from .body import Body, Joint, Matrix, Quaternion, Vector, diagonal
from .observables import Observable
from .scene import Scene, every_scheme
from .trajectory import Trajectory

#: Mass [kg] of the peg and its moment [kg m²], that of a ball of 2 cm; g [m/s²].
PEG, PEG_MOMENT, G = 0.2, 3.2e-5, 9.81
#: The blow [N], from when to when [s]; how the hinge is turned about the vertical.
FORCE, START, END = 30.0, 0.2, 0.24
YAW: Quaternion = (0.0, 0.0, 0.28, 0.96)
#: Where the pegs are, in parts of the way from the hinge to the centre of percussion.
PLACES = {"struck": 1.0, "struck above": 0.4, "struck below": 1.5}
_JUST = 1e-9


def struck(variant: str, mass: float, tensor: Matrix, axis: Vector, arm: float) -> Scene:
    """The scene of a body of this ``mass`` [kg] and ``tensor`` (3, 3) about its centre, its own axes.

    It hangs by a hinge along ``axis``, ``arm`` [m] above its centre.
    """
    moment = float(np.array(axis) @ np.array(tensor) @ axis) + mass * arm**2
    # A peg's mass moves the centre of percussion of the whole only for what it has of a moment of its own.
    distance = PLACES[variant] * (moment + PEG_MOMENT) / (mass * arm)
    hung = Body(
        "hung", mass, tensor, (Joint("hinge", "hinge", axis),), (0.0, 0.0, -arm), None, (0.3, -0.2, 0.1), YAW
    )
    peg = Body("peg", PEG, diagonal(*[PEG_MOMENT] * 3), (), parent="hung", position=(0.0, 0.0, -distance))
    x, y, z = (FORCE * quaternions.rotated(np.array(YAW), np.cross(axis, (0.0, 0.0, -1.0)))).tolist()
    where = {"struck": "at", "struck above": "above", "struck below": "below"}[variant]
    return Scene(
        name="compound_pendulum",
        variant=variant,
        summary=f"A swinging body struck {where} its centre of percussion, and what its hinge bears.",
        source="Fowles & Cassiday, Analytical Mechanics, § 8.7",
        bodies=(hung, peg),
        gravity=(0.0, 0.0, -G),
        forces=(Blow("peg", (x, y, z), START, END),),
        q0=(-0.35,),
        v0=(1.2,),
        duration=1.0,
        samples=50,
        truth=_truth,
        reactions=("hung",),
        observables=(
            observables.orientation(),
            observables.omega(),
            observables.position(),
            observables.velocity(),
            observables.fitted("jump of omega", "rad/s", _jump, lambda scene: _jump(scene, _struck(scene))),
            _impulse(),
            reactions.force(),
            Observable("borne of the blow", "N", "state", _other_share, lambda scene, b: FORCE),
            observables.invariant("peg and hinge", "m, m/s, 1", _apart, lambda scene, b: _fastest(b)),
            observables.unit_norm(),
        ),
        pictures=(
            pictures.against_time("Angle", "θ [rad]", lambda scene, m: m.joint_position[:, 0]),
            pictures.against_time("What the hinge bears of the blow", "F [N]", borne_of_the_blow),
        ),
        ladders={1: (2e-3, 1e-3, 5e-4, 2.5e-4, 1.25e-4), 4: (2e-2, 1e-2, 5e-3, 2.5e-3, 1.25e-3)},
        errors=every_scheme(ERRORS[variant], *ALIKE),
    )


def whole(scene: Scene) -> tuple[float, float, float, float]:
    """Mass, arm of the centre, moment about the hinge and distance of the peg, of body and peg together."""
    hung, peg = scene.bodies
    distance, mass = -peg.position[2], hung.mass + peg.mass
    arm = (hung.mass * -hung.center_of_mass[2] + peg.mass * distance) / mass
    return mass, arm, inertia.about_axis(_tensor(scene), hung.joints[0].axis), distance


def borne_of_the_blow(scene: Scene, motion: Trajectory) -> Array:
    """What the hinge bears across the arm (n,) [N] but for its share of the weight."""
    mass, arm, moment, _ = whole(scene)
    onward = np.cross(scene.bodies[0].joints[0].axis, (0.0, 0.0, -1.0))
    weight = mass * G * np.sin(motion.joint_position[:, 0]) * (1 - mass * arm**2 / moment)
    return np.asarray(motion.reaction[:, 0, :3] @ onward - weight)


def hinge_impulse(scene: Scene, motion: Trajectory) -> float:
    """What the hinge gives along the blow while that lasts [N s]: change of momentum less the blow's."""
    along, (i, j) = _blow(scene) / FORCE, _edges(motion)
    before, after = mechanics.momentum(scene, motion)[[i, j]]
    return float((after - before) @ along - FORCE * (END - START))


def _truth(scene: Scene, t: Array) -> Trajectory:
    (angle,), (rate,) = scene.q0, scene.v0
    mass, arm, moment, distance = whole(scene)
    swung = struck_pendulum.swing(mass, arm, moment, G, distance, FORCE, START, END, angle, rate, t)
    motion = _moved(scene, t, *swung)
    return replace(motion, reaction=_borne(scene, motion))


def _moved(scene: Scene, t: Array, angle: Array, rate: Array) -> Trajectory:
    """The motion of both bodies whose hinge is at ``angle`` (n,) with ``rate`` (n,)."""
    hung, peg = scene.bodies
    # The peg goes as a body would whose centre is there, on a hinge of its own that turns alike.
    pair = hung, replace(hung, center_of_mass=peg.position)
    both = hinged.motion(pair, t, *(np.repeat(part[:, None], 2, axis=1) for part in (angle, rate)))
    return replace(both, joint_position=angle[:, None], joint_velocity=rate[:, None])


def _borne(scene: Scene, motion: Trajectory) -> Array:
    """What the hinge does to the bodies (n, 1, 6): m(a − g) − F, and what turns them so about the hinge."""
    mass, arm, moment, distance = whole(scene)
    axis, centre, peg = np.array(scene.bodies[0].joints[0].axis), [0.0, 0.0, -arm], [0.0, 0.0, -distance]
    on = (motion.t > START - _JUST) & (motion.t < END - _JUST)
    angle, omega = motion.joint_position[:, 0], motion.omega[:, 0]
    alpha = axis * struck_pendulum.acceleration(mass, arm, moment, G, distance, FORCE * on, angle)[:, None]
    back = quaternions.conjugate(motion.quaternion[:, 0])
    weight = mass * quaternions.rotated(back, np.array(scene.gravity))
    blow = on[:, None] * quaternions.rotated(back, _blow(scene))
    carried = np.cross(alpha, centre) + np.cross(omega, np.cross(omega, centre))
    turned, spin = (part @ _tensor(scene) for part in (alpha, omega))
    torque = turned + np.cross(omega, spin) - np.cross(centre, weight) - np.cross(peg, blow)
    return np.concatenate([mass * carried - weight - blow, torque], axis=1)[:, None]


def _tensor(scene: Scene) -> Array:
    """Inertia of body and peg about the hinge (3, 3)."""
    hung, peg = scene.bodies
    return np.asarray(
        inertia.about_point(hung.inertia_array, hung.mass, hung.center_of_mass)
        + inertia.about_point(peg.inertia_array, peg.mass, peg.position)
    )


@cache
def _struck(scene: Scene) -> Trajectory:
    """The exact motion where the blow sets in and where it ends."""
    return _truth(scene, np.array([START, END]))


def _blow(scene: Scene) -> Array:
    (blow,) = scene.forces
    return np.array(blow.force) if isinstance(blow, Blow) else np.zeros(3)


def _edges(motion: Trajectory) -> tuple[int, int]:
    i, j = np.searchsorted(motion.t, (START - _JUST, END - _JUST)).tolist()
    return i, j


def _jump(scene: Scene, motion: Trajectory) -> float:
    i, j = _edges(motion)
    return float(motion.joint_velocity[j, 0] - motion.joint_velocity[i, 0])


def _impulse() -> Observable:
    fitted = observables.fitted(
        "hinge impulse", "N s", hinge_impulse, lambda scene: hinge_impulse(scene, _struck(scene))
    )
    # The hinge's is the difference of the body's and the blow's: its round-off is theirs.
    return replace(fitted, scale=lambda scene, b: FORCE * (END - START))


def _other_share(scene: Scene, a: Trajectory, b: Trajectory) -> Array:
    return (borne_of_the_blow(scene, a) - borne_of_the_blow(scene, b))[:, None]


def _fastest(b: Trajectory) -> float:
    return float(max(np.abs(b.velocity).max(), np.abs(b.omega).max()))


def _apart(scene: Scene, motion: Trajectory) -> Array:
    """What bodies differ from where the hinge's whole angle and its rate put them."""
    made = _moved(scene, motion.t, motion.joint_position[:, 0], motion.joint_velocity[:, 0])
    turn = quaternions.product(quaternions.conjugate(made.quaternion), motion.quaternion)
    parts = (
        motion.position - made.position, motion.velocity - made.velocity,
        quaternions.rotation_vector(turn), motion.omega - made.omega,
    )  # fmt: skip
    return np.concatenate(parts, axis=2)


#: On one hinge nothing is gyroscopic and nothing damped: these two are alike.
ALIKE = ("semi-implicit Euler", "implicit gyroscopic")
#: C of C·dt^order of each observable in turn, measured by benchmarks/error_constants.py with MuJoCo 4.0.0.
ERRORS: dict[str, dict[str, tuple[float, ...]]] = {
    "struck": {
        "semi-implicit Euler": (3.3, 5.7, 1.1, 5.5, 0.38, 0.63, 62.0, 0.0, 0.0, 0.0),
        "RKMK4": (37.0, 170.0, 12.0, 53.0, 110.0, 43.0, 470.0, 0.0, 0.0, 0.0),
    },
    "struck above": {
        "semi-implicit Euler": (2.3, 5.0, 0.47, 1.9, 0.32, 0.16, 45.0, 2.2, 0.0, 0.0),
        "RKMK4": (22.0, 84.0, 4.4, 19.0, 14.0, 4.2, 200.0, 4.9, 0.0, 0.0),
    },
    "struck below": {
        "semi-implicit Euler": (3.7, 5.2, 1.6, 9.1, 0.4, 0.87, 67.0, 1.9, 0.0, 0.0),
        "RKMK4": (78.0, 330.0, 34.0, 170.0, 200.0, 82.0, 1200.0, 1.1, 0.0, 0.0),
    },
}
