"""A free body with a rotor inside, whose momentum turns the wobble of the whole the other way.

The rotor keeps σ + a·ω, what it turns at about its own axis: so the carrier's ω goes round at
((I3 − I1)ω3 + h)/I1. Catches an engine whose hinge carries no gyroscopic moment: the wobble is then that of
the frozen body. No other scene has a rotor whose spin the free motion of its carrier feels.
"""

import numpy as np

from ..reference import gyrostat, quaternions
from ..reference.checked import Array
from . import observables, pictures
from .body import Body, Joint, diagonal
from .scene import Scene, every_scheme
from .trajectory import Trajectory

#: Masses [kg] and moments (across, along the common axis) of carrier and rotor [kg m²].
CARRIER, ACROSS, ALONG = 5.0, 0.9, 0.5
ROTOR, ROTOR_ACROSS, ROTOR_ALONG = 2.0, 0.3, 0.5
#: Where the rotor's centre is on the axis, from the carrier's [m].
OFFSET = 0.2
#: The rotor's spin in the carrier [rad/s], from −2.9 rad to 2.7: large angles are rounded coarsely.
SPIN, TURNED = 3.5, -2.9
#: Carrier's and rotor's centres along the axis, from that of both [m].
CENTRES = np.array([-OFFSET * ROTOR, OFFSET * CARRIER]) / (CARRIER + ROTOR)
#: Of both together, about the centre of both: moments [kg m²], and the rotor's own momentum [kg m²/s].
I1 = ACROSS + ROTOR_ACROSS + float(CENTRES**2 @ np.array([CARRIER, ROTOR]))
I3, H = ALONG + ROTOR_ALONG, ROTOR_ALONG * SPIN
ATTITUDE = (0.1, -0.3, 0.9, 0.3)
OMEGA = (0.5, -0.8, 1.2)


def _truth(scene: Scene, t: Array) -> Trajectory:
    q0, v0 = np.array(scene.q0), np.array(scene.v0)
    q, omega = gyrostat.motion(I1, I3, H, q0[3:7], v0[3:6], t)
    axis = np.array([0.0, 0.0, 1.0])
    arms = CENTRES[:, None] * axis
    start = q0[:3] - quaternions.rotated(q0[3:7], arms[0])
    drift = v0[:3] - quaternions.rotated(q0[3:7], np.cross(v0[3:6], arms[0]))
    centre = (start + t[:, None] * drift)[:, None]
    position = centre + quaternions.rotated(q[:, None], arms)
    velocity = drift + quaternions.rotated(q[:, None], np.cross(omega[:, None], arms))
    angle = q0[7] + SPIN * t
    turn = quaternions.from_rotation_vector(angle[:, None] * axis)
    rotor = quaternions.rotated(quaternions.conjugate(turn), omega) + SPIN * axis
    return Trajectory(
        t,
        position,
        np.stack([q, quaternions.product(q, turn)], axis=1),
        velocity,
        np.stack([omega, rotor], axis=1),
        angle[:, None],
        np.full((len(t), 1), SPIN),
    )


def _wobbling(scene: Scene, motion: Trajectory) -> Array:
    """The carrier's ω across the axis: as complex numbers (n,)."""
    return np.asarray(motion.omega[:, 0, 0] + 1j * motion.omega[:, 0, 1])


def _wobble(scene: Scene) -> float:
    return gyrostat.precession_rate(I1, I3, H, scene.v0[5])


def _spinning(scene: Scene, motion: Trajectory) -> Array:
    return np.asarray(np.exp(1j * motion.joint_position[:, 0]))


def _kept(scene: Scene, motion: Trajectory) -> Array:
    """What the rotor turns at about its own axis, which nothing drives: σ + ω3."""
    return np.asarray(motion.joint_velocity[:, 0] + motion.omega[:, 0, 2])


def _parted(scene: Scene, motion: Trajectory) -> Array:
    """What the rotor's place, attitude and ω differ from those that the hinge gives it."""
    axis, carrier = np.array([0.0, 0.0, 1.0]), motion.quaternion[:, 0]
    turn = quaternions.from_rotation_vector(motion.joint_position * axis)
    apart = quaternions.product(
        quaternions.conjugate(quaternions.product(carrier, turn)), motion.quaternion[:, 1]
    )
    place = motion.position[:, 0] + quaternions.rotated(carrier, OFFSET * axis)
    carried = quaternions.rotated(quaternions.conjugate(turn), motion.omega[:, 0])
    return np.hstack(
        [
            motion.position[:, 1] - place,
            quaternions.rotation_vector(apart),
            motion.omega[:, 1] - carried - motion.joint_velocity * axis,
        ]
    )


#: C of C·dt^order of each observable in turn, measured by benchmarks/error_constants.py with MuJoCo 4.0.0.
ERRORS: dict[str, tuple[float, ...]] = {
    "semi-implicit Euler": (1.2, 1.5, 0.19, 0.25, 0.0026, 0.0, 0.0, 1.2, 1.7, 0.77, 0.0, 0.0),
    "implicit gyroscopic": (0.64, 1.5, 0.084, 0.16, 0.0026, 0.0, 0.0, 1.2, 0.87, 0.35, 0.0, 0.0),
    "RKMK4": (0.029, 0.036, 0.0071, 0.0071, 0.017, 0.0, 0.0, 0.004, 0.058, 0.03, 0.0, 0.0),
}

SCENES = (
    Scene(
        name="gyrostat",
        summary="A free body with a rotor inside, which turns its wobble the other way.",
        source="Landau & Lifshitz, Mechanics, § 36; Volterra, Acta Math. 22, 1899; Wittenburg, Dynamics of "
        "Multibody Systems",
        bodies=(
            Body("carrier", CARRIER, diagonal(ACROSS, ACROSS, ALONG), (Joint("free", "free"),)),
            Body(
                "rotor",
                ROTOR,
                diagonal(ROTOR_ACROSS, ROTOR_ACROSS, ROTOR_ALONG),
                (Joint("hinge", "hinge"),),
                parent="carrier",
                position=(0.0, 0.0, OFFSET),
            ),
        ),
        q0=(0.4, -0.2, 0.3, *ATTITUDE, TURNED),
        v0=(0.05, 0.1, -0.04, *OMEGA, SPIN),
        duration=1.6,
        samples=32,
        truth=_truth,
        observables=(
            observables.orientation(),
            observables.omega(),
            observables.position(),
            observables.velocity(),
            observables.rate("wobble", _wobbling, _wobble),
            observables.rate("spin of the rotor", _spinning, lambda scene: SPIN),
            observables.invariant("rotor about its axis", "rad/s", _kept, lambda scene, b: SPIN),
            observables.energy(),
            observables.angular_momentum(),
            observables.momentum(),
            observables.invariant("joint residual", "1", _parted, lambda scene, b: SPIN),
            observables.unit_norm(),
        ),
        pictures=(pictures.body_cone(), pictures.tip()),
        ladders={
            1: (5e-3, 2.5e-3, 1.25e-3, 6.25e-4, 3.125e-4),
            4: (5e-2, 2.5e-2, 1.25e-2, 6.25e-3, 3.125e-3),
        },
        errors=every_scheme(ERRORS, like="semi-implicit Euler"),
    ),
)
