"""A disc that rolls on a level plane, a little faster than it must to stay up, and a little slower.

Catches an engine whose disc touches with more than one point of its rim, which stands where it should
fall, and one whose friction lets the rim slip.
"""

import numpy as np

from ..reference import euler_angles, quaternions, rolling_disc, rolling_disc_motion
from ..reference.checked import Array
from . import observables, pictures
from .body import Body, Joint, diagonal
from .contact import Contact, Plane, Rim
from .scene import Scene, Softness
from .trajectory import Trajectory, of_one_body

MASS, RADIUS, GRAVITY = 0.5, 0.15, 9.81
#: About a diameter and about the axis: of a thin disc.
I1, I3 = MASS * RADIUS**2 / 4, MASS * RADIUS**2 / 2
PLACE = (0.3, -0.2)
#: φ, θ and ψ [rad] of the start, and φ̇ and θ̇ [rad/s].
ANGLES, TURNING, FALLING = (0.4, np.pi / 2 - 0.06, 0.9), 0.1, -0.05
#: Speeds to that at which upright rolling becomes stable.
SPEEDS = {"stable": 1.1, "unstable": 0.9}
#: Largest lean at a sample [rad], by the equations of motion.
LEANS = {"stable": 0.43592805002337, "unstable": 0.70905119630145}
SOFT = {
    variant: Softness(
        share,
        "under a rim MuJoCo's contact holds back 0.99 of what presses on it in a step, or the rim would "
        "leave the ground for a step when its lowest point rises; the speed left, 0.01 g dt, is 0.16/s dt of "
        f"the slower disc's 0.63 m/s; measured beside Pinocchio's is {measured}",
        dt=6.4e-3,
        order=1,
    )
    for variant, share, measured in (
        ("stable", 3e-4, "0.038/s dt at 6.4 ms and 0.008/s dt at 0.8 ms"),
        ("unstable", 9e-4, "0.13/s dt at 6.4 ms and 0.03/s dt at 0.8 ms"),
    )
}
#: C of C·dt of each observable in turn, measured by benchmarks/error_constants.py with MuJoCo 4.0.0.
ERRORS: dict[str, dict[str, tuple[float, ...]]] = {
    "stable": {
        "semi-implicit Euler": (0.9, 3.3, 5.2, 20.0, 2.5, 1.2, 0.0067, 0.17, 0.0),
        "implicit gyroscopic": (0.23, 4.1, 4.5, 41.0, 2.8, 1.1, 0.0058, 0.28, 0.0),
        "implicitfast": (0.23, 4.1, 4.5, 41.0, 2.8, 1.1, 0.0058, 0.28, 0.0),
    },
    "unstable": {
        "semi-implicit Euler": (0.91, 3.1, 5.8, 22.0, 2.4, 4.4, 0.026, 0.46, 0.0),
        "implicit gyroscopic": (0.35, 4.3, 5.1, 73.0, 2.9, 4.3, 0.024, 0.83, 0.0),
        "implicitfast": (0.35, 4.3, 5.1, 73.0, 2.9, 4.3, 0.024, 0.83, 0.0),
    },
}


def _truth(scene: Scene, t: Array) -> Trajectory:
    q0, omega0 = scene.q0[3:], scene.v0[3:]
    return of_one_body(
        t, *rolling_disc_motion.motion(MASS, RADIUS, (I1, I3), GRAVITY, q0, omega0, t, scene.q0[:2])
    )


def _arm(scene: Scene, motion: Trajectory) -> Array:
    """From the centre to the lowest point of the rim (n, 3) [m], world axes."""
    axis = quaternions.rotated(motion.quaternion[:, 0], np.array([0.0, 0.0, 1.0]))
    down = np.array([0.0, 0.0, -1.0]) + axis[:, 2:] * axis
    return np.asarray(RADIUS * down / np.linalg.norm(down, axis=1, keepdims=True))


def _slip(scene: Scene, motion: Trajectory) -> Array:
    omega = quaternions.rotated(motion.quaternion[:, 0], motion.omega[:, 0])
    return np.asarray(motion.velocity[:, 0] + np.cross(omega, _arm(scene, motion)))


def _gap(scene: Scene, motion: Trajectory) -> Array:
    return np.asarray(motion.position[:, 0, 2] + _arm(scene, motion)[:, 2])


def _lean(scene: Scene, motion: Trajectory) -> Array:
    """Angle of the disc from the vertical, (n,) [rad]."""
    axis = quaternions.rotated(motion.quaternion[:, 0], np.array([0.0, 0.0, 1.0]))
    return np.asarray(np.arcsin(axis[:, 2]))


def _most(scene: Scene, motion: Trajectory) -> float:
    return float(np.abs(_lean(scene, motion)).max())


def _rolling(variant: str) -> Scene:
    q0 = euler_angles.zxz_attitude(np.array(ANGLES))
    spin = SPEEDS[variant] * rolling_disc.upright_threshold(MASS, RADIUS, (I1, I3), GRAVITY)
    rates = np.array([TURNING, FALLING, spin - TURNING * np.cos(ANGLES[1])])
    omega0 = euler_angles.zxz_omega(np.array(ANGLES), rates)
    arm = RADIUS * np.array([0.0, -1.0, 0.0])
    nodes = euler_angles.zxz_attitude(np.array([ANGLES[0], ANGLES[1], 0.0]))
    arm = quaternions.rotated(nodes, arm)
    velocity = -np.cross(quaternions.rotated(q0, omega0), arm)
    return Scene(
        name="rolling_disc",
        variant=variant,
        summary=f"A disc rolls at {SPEEDS[variant]} of the speed at which it stays up.",
        source="Routh, Advanced Rigid Dynamics; Neimark & Fufaev, Dynamics of Nonholonomic Systems",
        bodies=(Body("disc", MASS, diagonal(I1, I1, I3), (Joint("free", "free"),)),),
        contacts=(Contact("disc", Rim(RADIUS), None, Plane(), friction=1.0),),
        gravity=(0.0, 0.0, -GRAVITY),
        q0=(*PLACE, float(RADIUS * np.sin(ANGLES[1])), *q0.tolist()),
        v0=(*velocity.tolist(), *omega0.tolist()),
        duration=0.64,
        samples=20,
        dt=8e-4,
        truth=_truth,
        soft={"mujoco": SOFT[variant]},
        observables=(
            observables.position(),
            observables.velocity(),
            observables.orientation(),
            observables.omega(),
            observables.fitted("largest lean", "rad", _most, lambda scene: LEANS[scene.variant]),
            observables.invariant("slip", "m/s", _slip, lambda scene, b: float(np.abs(b.velocity).max())),
            observables.invariant("gap", "m", _gap, lambda scene, b: RADIUS),
            observables.energy(),
            observables.unit_norm(),
        ),
        pictures=(
            pictures.Picture("Path of the centre", ("x [m]", "y [m]"), lambda scene, m: m.position[:, 0, :2]),
            pictures.against_time("Lean", "lean [rad]", _lean),
        ),
        ladders={1: (6.4e-3, 3.2e-3, 1.6e-3, 8e-4, 4e-4)},
        errors=ERRORS[variant],
    )


SCENES = tuple(_rolling(variant) for variant in SPEEDS)
