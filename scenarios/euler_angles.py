"""A body in a gimbal: three hinges, z, y and z, one on the other, turn it as Euler's angles do.

Catches an engine that adds up the rates of stacked hinges along axes that do not turn with the hinges before
them. At β = 0 the outer and the inner axis coincide and ω no longer fixes the rates: how much an error of ω
may grow in them is the conditioning, cot(β/2).
"""

from dataclasses import replace

import numpy as np

from ..reference import euler_angles, heavy_top, quaternions
from ..reference.checked import Array
from . import free_body, observables, pictures
from .body import Body, Joint, Vector, diagonal
from .scene import Scene, every_scheme
from .trajectory import Trajectory, about_fixed_point

#: Mass [kg], moments [kg m²], how far below the hinges the body hangs where it does [m], g [m/s²].
MASS, ASYMMETRIC, SYMMETRIC, HUNG, G = 1.5, (0.012, 0.02, 0.016), (0.016, 0.016, 0.01), 0.02, 9.81
#: When β = 0 is crossed [s], and how fast [rad/s]: a sixth of a step away from every step and half step of
#: the ladders, and of all others but where three steps, or a multiple, make 16 ms. The mass matrix divides
#: rounding by β²: a scheme that looked at β = 0 itself would be lost.
CROSSING, SPEED = 0.6 + 0.008 / 3, 3.4
#: Largest time [s] over which the truth follows its angles: near β = 0 they run fast.
FINE = 5e-4


def _truth(scene: Scene, t: Array) -> Trajectory:
    """The body turns about its fixed point as if there were no gimbal: without mass it bears no torque."""
    start = euler_angles.zyz_attitude(scene.q0), euler_angles.zyz_omega(scene.q0, scene.v0)
    often = np.linspace(0.0, t.max(), 2 + int(t.max() / FINE))
    when, places = np.unique(np.concatenate([t, often]), return_inverse=True)
    q, omega = (_swinging if any(scene.gravity) else _turning)(scene.bodies[0], *start, when)
    here = places[: len(t)]
    angles = _followed(euler_angles.zyz_angles(q), np.array(scene.q0))[here]
    motion = about_fixed_point(t, np.array(scene.bodies[0].center_of_mass), q[here], omega[here])
    rates = euler_angles.zyz_rates(angles, omega[here])
    return replace(motion, joint_position=angles, joint_velocity=rates)


def _turning(body: Body, q0: Array, omega0: Array, t: Array) -> tuple[Array, Array]:
    return free_body.turning(body.inertia_array, q0, omega0, t)


def _swinging(body: Body, q0: Array, omega0: Array, t: Array) -> tuple[Array, Array]:
    """A heavy top, the centre of mass below the fixed point along e3: the reference has it above."""
    over, length = np.array([1.0, 0.0, 0.0, 0.0]), -body.center_of_mass[2]
    moments = (body.inertia[0][0] + body.mass * length**2, body.inertia[2][2])
    start = quaternions.product(q0, over), quaternions.rotated(over, omega0)
    q, omega = heavy_top.motion(body.mass, length, moments, G, *start, t)
    return quaternions.product(q, quaternions.conjugate(over)), quaternions.rotated(over, omega)


def _followed(angles: Array, start: Array) -> Array:
    """Angles (n, 3) without jumps, from those in the books' ranges, where β turns back at 0."""
    jumps = np.abs((np.diff(angles[:, 0]) + np.pi) % (2 * np.pi) - np.pi) > np.pi / 2
    through = np.concatenate([[start[1] < 0], jumps]).cumsum() % 2
    angles = angles + np.outer(through, [np.pi, 0.0, np.pi])
    angles[:, 1] *= 1 - 2 * through
    angles = np.unwrap(angles, axis=0)
    return np.asarray(angles + 2 * np.pi * np.round((start - angles[0]) / (2 * np.pi)))


def _attitude(scene: Scene, motion: Trajectory) -> Array:
    """What the body's attitude differs from that of its angles, (n, 3) [rad]."""
    turn = euler_angles.zyz_attitude(motion.joint_position)
    apart = quaternions.product(quaternions.conjugate(turn), motion.quaternion[:, 0])
    return quaternions.rotation_vector(apart)


def _omega(scene: Scene, motion: Trajectory) -> Array:
    """What ω differs from that of the angles and their rates, (n, 3) [rad/s]."""
    made = euler_angles.zyz_omega(motion.joint_position, motion.joint_velocity)
    return np.asarray(motion.omega[:, 0] - made)


def _fastest(scene: Scene, motion: Trajectory) -> float:
    return float(np.abs(motion.joint_velocity).max())


def _gimbal(variant: str, moments: Vector, hung: float, q0: Vector, v0: Vector) -> Scene:
    names = (("outer", (0.0, 0.0, 1.0)), ("middle", (0.0, 1.0, 0.0)), ("inner", (0.0, 0.0, 1.0)))
    hinges = tuple(Joint(f"{name} hinge", "hinge", axis) for name, axis in names)
    return Scene(
        name="euler_angles",
        variant=variant,
        summary=f"A body in a gimbal of three hinges, {_WORDS[variant]}.",
        source="Goldstein, Classical Mechanics, § 4.9 and appendix A; Landau & Lifshitz, Mechanics, § 35",
        bodies=(Body("body", MASS, diagonal(*moments), hinges, center_of_mass=(0.0, 0.0, -hung)),),
        gravity=(0.0, 0.0, -G if hung else 0.0),
        q0=q0,
        v0=v0,
        duration=1.2,
        samples=75,
        truth=_truth,
        observables=(
            observables.orientation(),
            observables.omega(),
            observables.invariant("attitude of the angles", "rad", _attitude, lambda scene, b: 1.0),
            observables.invariant("omega of the rates", "rad/s", _omega, _fastest),
            observables.energy(),
            observables.vertical_angular_momentum() if hung else observables.angular_momentum(),
            observables.position(),
            observables.velocity(),
        ),
        pictures=(
            pictures.tip(),
            pictures.against_time(
                "Angle of the middle hinge", "β [rad]", lambda scene, m: m.joint_position[:, 1]
            ),
            pictures.against_time(
                "Conditioning of the rates",
                "cot(β/2)",
                lambda scene, m: euler_angles.conditioning(m.joint_position[:, 1]),
            ),
        ),
        ladders={1: (8e-3, 4e-3, 2e-3, 1e-3, 5e-4), 4: (1.6e-2, 8e-3, 4e-3, 2e-3, 1e-3)},
        singular_times=(CROSSING,) if variant == "through zero" else (),
        errors=every_scheme(ERRORS[variant], like="semi-implicit Euler"),
    )


_WORDS = {
    "general": "far from gimbal lock: conditioning up to 3.6",
    "near zero": "past gimbal lock at 6°: conditioning up to 18.7",
    "through zero": "hung in it and swinging straight through gimbal lock: conditioning infinite at β = 0",
}

#: C of C·dt^order of each observable in turn, measured by benchmarks/error_constants.py with MuJoCo 4.0.0.
ERRORS: dict[str, dict[str, tuple[float, ...]]] = {
    "general": {
        "semi-implicit Euler": (1.9, 3.3, 0.0, 0.0, 0.052, 0.068, 0.0, 0.0),
        "implicit gyroscopic": (2.2, 2.4, 0.0, 0.0, 0.054, 0.044, 0.0, 0.0),
        "RKMK4": (0.68, 1.7, 0.0, 0.0, 0.015, 0.023, 0.0, 0.0),
    },
    "near zero": {
        "semi-implicit Euler": (7.5, 26.0, 0.0, 0.0, 0.31, 0.4, 0.0, 0.0),
        "implicit gyroscopic": (6.0, 16.0, 0.0, 0.0, 0.24, 0.18, 0.0, 0.0),
        "RKMK4": (55.0, 260.0, 0.0, 0.0, 3.9, 4.4, 0.0, 0.0),
    },
    "through zero": {
        "semi-implicit Euler": (1.5, 4.5, 0.0, 0.0, 0.39, 0.0, 0.03, 0.12),
        "implicit gyroscopic": (1.5, 4.5, 0.0, 0.0, 0.39, 0.0, 0.03, 0.12),
        "RKMK4": (5.8, 27.0, 0.0, 0.0, 0.11, 0.0, 0.12, 0.55),
    },
}
#: β [rad] and its rate [rad/s] at the start, of a pendulum that crosses 0 at CROSSING with SPEED.
BETA, RATE = -0.5485065303687349, -2.5216035890371535
SCENES = (
    _gimbal("general", ASYMMETRIC, 0.0, (0.4, 0.9, -1.1), (0.1, -1.0, 2.0)),
    _gimbal("near zero", ASYMMETRIC, 0.0, (0.4, 0.9, -1.1), (-0.45, -1.0, -0.65)),
    _gimbal("through zero", SYMMETRIC, HUNG, (0.4, BETA, -1.1), (0.0, RATE, 0.0)),
)
