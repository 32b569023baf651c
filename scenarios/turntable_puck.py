"""A puck on two slides of a turntable, which draw it nowhere: straight in the room, curved on the table.

The table turns on a hinge and nothing drives it. The slides hinder neither the puck's flight nor, as they
lead to its centre, the table's turning: both go on evenly, whatever the masses. All that happens in the
joints is Coriolis' and the centrifugal force, and what they do back to the hinge. Catches an engine whose
sliding joints do not know that their axes turn, or whose hinge does not feel what moves along them.
"""

import numpy as np

from ..reference import quaternions, rotating_frames
from ..reference.checked import Array
from . import observables
from .body import Body, Joint, Quaternion, Vector, diagonal
from .pictures import Picture
from .scene import Scene, every_scheme
from .trajectory import Trajectory

#: Rate of the table [rad/s]; it turns from −1.6 to 1.4 rad, as larger angles are rounded more coarsely. Its
#: bearing [m], and how its axis leans.
RATE = 1.5
BEARING: Vector = (0.3, -0.2, 0.5)
LEANING: Quaternion = (0.1, -0.3, 0.3, 0.9)
#: Directions of the slides and where the puck is when they are at zero [m], both in axes of the table.
SLIDES: tuple[Vector, Vector] = ((0.8, 0.6, 0.0), (-0.6, 0.8, 0.0))
MIDDLE: Vector = (0.1, 0.05, 0.2)
TURNING = np.array([0.0, 0.0, RATE])


def _placed(scene: Scene, joints: Array) -> Array:
    """Where the slides ``joints`` (n, 2) put the puck on the table, (n, 3) [m]."""
    return np.asarray(MIDDLE + joints @ np.array(SLIDES))


def _turned(angle: Array) -> Array:
    """Attitude (n, 4) of a table whose hinge is at ``angle`` (n,) [rad]."""
    turn = quaternions.from_rotation_vector(angle[:, None] * np.array([0.0, 0.0, 1.0]))
    return quaternions.product(np.broadcast_to(LEANING, turn.shape), turn)


def _truth(scene: Scene, t: Array) -> Trajectory:
    q0, v0 = np.array(scene.q0), np.array(scene.v0)
    start, speed = _placed(scene, q0[None, 1:])[0], v0[1:] @ np.array(SLIDES)
    r, v = rotating_frames.straight_line_seen_turning(TURNING, start, speed, t)
    angle = q0[0] + RATE * t
    attitude, at_start = _turned(angle), _turned(q0[:1])[0]
    fly = quaternions.rotated(at_start, speed + np.cross(TURNING, start))
    puck = BEARING + quaternions.rotated(at_start, start) + t[:, None] * fly
    position = np.stack([np.broadcast_to(BEARING, puck.shape), puck], axis=1)
    velocity = np.stack([np.zeros_like(puck), np.broadcast_to(fly, puck.shape)], axis=1)
    along = (r - MIDDLE) @ np.transpose(SLIDES), v @ np.transpose(SLIDES)
    return Trajectory(
        t,
        position,
        np.stack([attitude, attitude], axis=1),
        velocity,
        np.broadcast_to(TURNING, position.shape),
        np.column_stack([angle, along[0]]),
        np.column_stack([np.full_like(t, RATE), along[1]]),
    )


def _seen_turning(scene: Scene, motion: Trajectory) -> Array:
    """The puck's velocity in the room as a table that turns evenly sees it: as complex numbers (n,)."""
    r, v = _placed(scene, motion.joint_position[:, 1:]), motion.joint_velocity[:, 1:] @ np.array(SLIDES)
    u = v + np.cross(TURNING, r)
    return np.asarray(u[:, 0] + 1j * u[:, 1])


def _hinge(scene: Scene, motion: Trajectory) -> Array:
    return np.asarray(np.exp(1j * motion.joint_position[:, 0]))


def _parted(scene: Scene, motion: Trajectory) -> Array:
    """What places, attitudes and their rates differ from those that the joints make."""
    attitude, rate = _turned(motion.joint_position[:, 0]), motion.joint_velocity[:, :1] * [0.0, 0.0, 1.0]
    r, v = _placed(scene, motion.joint_position[:, 1:]), motion.joint_velocity[:, 1:] @ np.array(SLIDES)
    turn = quaternions.product(quaternions.conjugate(attitude)[:, None], motion.quaternion)
    apart = [
        quaternions.rotation_vector(turn).reshape(len(r), -1),
        (motion.omega - rate[:, None]).reshape(len(r), -1),
        motion.position[:, 0] - BEARING,
        motion.position[:, 1] - BEARING - quaternions.rotated(attitude, r),
        motion.velocity[:, 0],
        motion.velocity[:, 1] - quaternions.rotated(attitude, v + np.cross(rate, r)),
    ]
    return np.hstack(apart)


#: C of C·dt^order of each observable in turn, measured by benchmarks/error_constants.py with MuJoCo 4.0.0.
ERRORS: dict[str, tuple[float, ...]] = {
    "semi-implicit Euler": (11.0, 13.0, 0.0, 0.0, 2.5, 0.0, 11.0, 9.1, 6.0, 0.0, 0.0),
    "implicit gyroscopic": (6.8, 8.2, 0.0, 0.0, 2.5, 0.0, 4.3, 5.7, 9.9, 0.0, 0.0),
    "RKMK4": (0.59, 0.18, 0.0, 0.0, 0.064, 0.0, 0.0087, 0.13, 0.069, 0.0, 0.0),
}

SCENES = (
    Scene(
        name="turntable_puck",
        summary="A puck on two slides of a turntable: straight in the room, curved on the table.",
        source="Taylor, Classical Mechanics, § 9.7 and problem 9.20",
        bodies=(
            Body(
                "table",
                3.0,
                diagonal(0.3, 0.2, 0.4),
                (Joint("hinge", "hinge"),),
                position=BEARING,
                quaternion=LEANING,
            ),
            Body(
                "puck",
                0.7,
                diagonal(0.01, 0.02, 0.025),
                (Joint("first slide", "slide", SLIDES[0]), Joint("second slide", "slide", SLIDES[1])),
                parent="table",
                position=MIDDLE,
            ),
        ),
        q0=(-1.6, -0.9, 0.3),
        v0=(RATE, 0.6, -0.2),
        duration=2.0,
        samples=50,
        truth=_truth,
        observables=(
            observables.position(),
            observables.velocity(),
            observables.orientation(),
            observables.omega(),
            observables.rate("turning of the puck's path", _seen_turning, lambda scene: -RATE),
            observables.rate("turning of the table", _hinge, lambda scene: RATE),
            observables.energy(),
            observables.momentum(),
            observables.angular_momentum(),
            observables.invariant(
                "joint residual", "1", _parted, lambda scene, b: float(np.abs(b.position).max())
            ),
            observables.unit_norm(),
        ),
        pictures=(
            Picture(
                "Path of the puck on the table",
                ("x [m]", "y [m]"),
                lambda scene, m: _placed(scene, m.joint_position[:, 1:])[:, :2],
            ),
        ),
        ladders={1: (4e-3, 2e-3, 1e-3, 5e-4, 2.5e-4), 4: (4e-2, 2e-2, 1e-2, 5e-3, 2.5e-3)},
        errors=every_scheme(ERRORS, like="semi-implicit Euler"),
    ),
)
