"""A body in a gimbal whose axis passes gimbal lock at a small distance: two hinges turn half way at once."""

from dataclasses import replace

import numpy as np

from ..reference import euler_angles, quaternions
from ..reference.checked import Array
from . import observables
from .body import Body, Joint, diagonal
from .scene import Scene
from .trajectory import Trajectory, about_fixed_point

#: How far from gimbal lock the axis starts [rad]: steps of 1e-3 and 1e-4 s end in it, others pass it. How
#: fast the body turns [rad/s]; how it is turned at first.
START, SPEED, TURNED = 0.517, 1.0, (0.4, -1.1)
#: The middle moment twice [kg m²]: turning about any axis across e3 is then steady.
MOMENTS = (0.02, 0.02, 0.015)


def _omega(distance: float) -> tuple[Array, Array]:
    """Attitude (4,) and ω (3,) in body axes of a body whose e3 passes the vertical at ``distance`` [rad].

    e3 runs on the great circle about ω; that circle's nearest point to the vertical is as far from it as ω is
    from the horizontal.
    """
    q0 = euler_angles.zyz_attitude((TURNED[0], START, TURNED[1]))
    e3 = quaternions.rotated(q0, np.array([0.0, 0.0, 1.0]))
    # Across e3, and tilted by the distance: a combination of the horizontal axis and the steepest one.
    level = np.cross([0.0, 0.0, 1.0], e3) / np.sin(START)
    steep = np.cross(e3, level)
    share = np.sin(distance) / steep[2]
    axis = share * steep - np.sqrt(1 - share**2) * level
    return q0, quaternions.rotated(quaternions.conjugate(q0), SPEED * axis)


def _truth(scene: Scene, t: Array) -> Trajectory:
    q0 = euler_angles.zyz_attitude(scene.q0)
    omega = np.tile(euler_angles.zyz_omega(scene.q0, scene.v0), (len(t), 1))
    q = quaternions.product(q0, quaternions.from_rotation_vector(t[:, None] * omega))
    angles = euler_angles.zyz_angles(q)
    motion = about_fixed_point(t, np.zeros(3), q, omega)
    return replace(motion, joint_position=angles, joint_velocity=euler_angles.zyz_rates(angles, omega))


def near_gimbal_lock(distance: float) -> Scene:
    """A gimbal whose middle angle comes down to ``distance`` [rad] half a second after the start."""
    q0, omega = _omega(distance)
    angles = euler_angles.zyz_angles(q0)
    names = (("outer", (0.0, 0.0, 1.0)), ("middle", (0.0, 1.0, 0.0)), ("inner", (0.0, 0.0, 1.0)))
    hinges = tuple(Joint(f"{name} hinge", "hinge", axis) for name, axis in names)
    return Scene(
        name="near_gimbal_lock",
        variant=f"{distance:g}",
        summary=f"A body in a gimbal, its axis passing {distance:g} rad from gimbal lock.",
        source="Goldstein, Classical Mechanics, § 4.9 and appendix A",
        bodies=(Body("body", 1.5, diagonal(*MOMENTS), hinges),),
        q0=tuple(angles.tolist()),
        v0=tuple(euler_angles.zyz_rates(angles, omega).tolist()),
        duration=1.2,
        samples=75,
        truth=_truth,
        observables=(observables.orientation(), observables.omega(), observables.energy()),
    )
