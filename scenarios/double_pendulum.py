"""A double pendulum in small swings, whose two frequencies are known, and in large ones.

A swing shifts its own frequencies by a part that goes as the square of its amplitude. So the small variant
swings two of them, the second twice as far: what is fitted to both is extrapolated to no amplitude at all,
and the rest is the engine's own. Catches an engine that leaves out what the links' velocities do to each
other: small swings hardly show it, large ones do.
"""

import numpy as np

from ..reference import double_pendulum, double_pendulum_motion, normal_modes, quaternions
from ..reference.checked import Array
from . import hinged, observables, pictures
from .body import Body, Joint, Vector, diagonal
from .observables import Observable
from .scene import Scene, every_scheme
from .trajectory import Trajectory

#: Masses [kg], hinge to hinge and to centre of mass [m]; g [m/s²]; axis of all hinges, horizontal.
MASSES, LENGTH, ARM, G, AXIS = (0.75, 1.0), 0.5, 0.4, 9.81, (0.6, 0.8, 0.0)
#: Each link alone swings like a point at LENGTH, and the masses are such that together they swing like
#: two equal points at the ends of two massless rods.
MOMENTS = tuple(mass * ARM * (LENGTH - ARM) for mass in MASSES)
HINGES: tuple[Vector, ...] = ((0.3, -0.2, 0.65), (-0.4, 0.5, 0.75))
LINKS = double_pendulum.links(MASSES, (LENGTH, LENGTH), G, (ARM, ARM), MOMENTS)


def _truth(scene: Scene, t: Array) -> Trajectory:
    angles, rates = np.reshape(scene.q0, (-1, 2)), np.reshape(scene.v0, (-1, 2))
    swings = [
        double_pendulum_motion.motion(LINKS, np.cumsum(angle), np.cumsum(rate), t)
        for angle, rate in zip(angles, rates, strict=True)
    ]
    return _placed(t, *(np.stack(part, axis=1) for part in zip(*swings, strict=True)))


def _placed(t: Array, theta: Array, rate: Array) -> Trajectory:
    """From angles and rates (n, pendulums, 2) against the vertical."""
    axis, n = np.array(AXIS), len(t)
    q = quaternions.from_rotation_vector(theta[..., None] * axis)
    omega = rate[..., None] * axis
    arms = [np.array([0.0, 0.0, -length]) for length in (ARM, LENGTH)]
    (centres, ends), (speeds, end_speeds) = (
        [quaternions.rotated(q, arm) for arm in arms],
        [quaternions.rotated(q, np.cross(omega, arm)) for arm in arms],
    )
    position = np.array(HINGES)[: theta.shape[1], None] + centres
    position[:, :, 1] += ends[:, :, 0]
    velocity = speeds
    velocity[:, :, 1] += end_speeds[:, :, 0]
    position, q, velocity, omega = (
        array.reshape(n, -1, array.shape[-1]) for array in (position, q, velocity, omega)
    )
    angle, speed = (np.diff(array, axis=2, prepend=0.0).reshape(n, -1) for array in (theta, rate))
    return Trajectory(t, position, q, velocity, omega, angle, speed)


def frequency(motion: Trajectory, mode: int) -> float:
    """Frequency of a mode (0 the slow one) [rad/s] at no amplitude, from two pendulums at two."""
    near, far = (_fitted(motion, which, mode) for which in (0, 1))
    return (4 * near - far) / 3


def _fitted(motion: Trajectory, which: int, mode: int) -> float:
    """Rate [rad/s] at which the mode's coordinate and velocity of one pendulum go round each other."""
    T, V = double_pendulum.energy_matrices(LINKS)
    omegas, modes = normal_modes.normal_modes(T, V)
    own = slice(2 * which, 2 * which + 2)
    coordinate, velocity = (
        np.cumsum(joints[:, own], axis=1) @ T @ modes[:, mode]
        for joints in (motion.joint_position, motion.joint_velocity)
    )
    phase = np.unwrap(np.angle(coordinate - 1j * velocity / omegas[mode]))
    centred = motion.t - motion.t.mean()
    return float(centred @ phase / (centred @ centred))


def _frequency(mode: int, name: str) -> Observable:
    return observables.fitted(
        f"{name} frequency",
        "rad/s",
        lambda scene, motion: frequency(motion, mode),
        lambda scene: float(double_pendulum.frequencies(LINKS)[mode]),
    )


def _parted(scene: Scene, motion: Trajectory) -> Array:
    """What positions, attitudes and velocities differ from those that the hinges' own angles make."""
    n = len(motion.t)
    theta, rate = (
        np.cumsum(joints.reshape(n, -1, 2), axis=2)
        for joints in (motion.joint_position, motion.joint_velocity)
    )
    placed = _placed(motion.t, theta, rate)
    turn = quaternions.product(quaternions.conjugate(placed.quaternion), motion.quaternion)
    apart = [motion.position - placed.position, quaternions.rotation_vector(turn)]
    return np.concatenate([*apart, motion.velocity - placed.velocity, motion.omega - placed.omega], axis=2)


def _links(name: str, hinge: Vector) -> tuple[Body, Body]:
    upper, lower = (
        Body(
            f"{part} {name}",
            mass,
            diagonal(moment, moment, 0.6 * moment),
            (Joint(f"{part} hinge of {name}", "hinge", AXIS),),
            center_of_mass=(0.0, 0.0, -ARM),
            parent=f"upper {name}" if part == "lower" else None,
            position=(0.0, 0.0, -LENGTH) if part == "lower" else hinge,
        )
        for part, mass, moment in zip(("upper", "lower"), MASSES, MOMENTS, strict=True)
    )
    return upper, lower


def _pendulum(
    variant: str,
    summary: str,
    starts: tuple[tuple[float, float], ...],
    rates: tuple[tuple[float, float], ...],
    more: tuple[Observable, ...],
    ladders: dict[int | str, tuple[float, ...]],
) -> Scene:
    places = list(zip(("first", "second"), HINGES, strict=True))[: len(starts)]
    return Scene(
        name="double_pendulum",
        variant=variant,
        summary=f"A double pendulum, {summary}.",
        source="Landau & Lifshitz, Mechanics, § 5 problem 1 and § 23 problem 2; Taylor, § 11.4",
        bodies=tuple(body for name, hinge in places for body in _links(name, hinge)),
        gravity=(0.0, 0.0, -G),
        q0=tuple(angle for start in starts for angle in start),
        v0=tuple(rate for start in rates for rate in start),
        duration=2.0,
        samples=100,
        truth=_truth,
        observables=(
            observables.orientation(),
            observables.omega(),
            observables.position(),
            observables.velocity(),
            hinged.angle(),
            *more,
            observables.energy(),
            observables.invariant(
                "joint residual", "1", _parted, lambda scene, b: max(1.0, float(np.abs(b.omega).max()))
            ),
            observables.unit_norm(),
        ),
        pictures=(
            pictures.against_time("Upper angle", "θ1 [rad]", lambda scene, m: m.joint_position[:, 0]),
            pictures.against_time(
                "Lower angle", "θ2 [rad]", lambda scene, m: m.joint_position[:, :2].sum(axis=1)
            ),
        ),
        ladders=ladders,
        errors=every_scheme(ERRORS[variant], like="semi-implicit Euler"),
    )


#: C of C·dt^order of each observable in turn, measured by benchmarks/error_constants.py with MuJoCo 4.0.0.
ERRORS: dict[str, dict[str, tuple[float, ...]]] = {
    "small": {
        "semi-implicit Euler": (0.39, 2.7, 0.26, 0.66, 0.25, 0.22, 0.27, 0.38, 0.0, 0.0),
        "implicit gyroscopic": (0.39, 2.6, 0.26, 0.65, 0.24, 0.22, 0.27, 0.36, 0.0, 0.0),
        "RKMK4": (45.0, 330.0, 11.0, 77.0, 67.0, 3.8, 310.0, 2.7, 0.0, 0.0),
    },
    "large": {
        "semi-implicit Euler": (77.0, 650.0, 30.0, 550.0, 120.0, 89.0, 0.0, 0.0),
        "implicit gyroscopic": (28.0, 270.0, 17.0, 140.0, 38.0, 130.0, 0.0, 0.0),
        "RKMK4": (4700.0, 5.0e4, 1400.0, 3.3e4, 7400.0, 5.3e4, 0.0, 0.0),
    },
}

SCENES = (
    _pendulum(
        "small",
        "small swings, and one twice as far",
        ((0.06, 0.02), (0.12, 0.04)),
        ((0.12, -0.4), (0.24, -0.8)),
        (_frequency(0, "slow"), _frequency(1, "fast")),
        {1: (4e-3, 2e-3, 1e-3, 5e-4, 2.5e-4), 4: (2e-2, 1e-2, 5e-3, 2.5e-3, 1.25e-3)},
    ),
    _pendulum(
        "large",
        "from far beyond small angles",
        ((1.8, -0.9),),
        ((1.0, -2.0),),
        (),
        # Of fourth order coarser steps err by other laws, and finer ones by round-off.
        {1: (2e-3, 1e-3, 5e-4, 2.5e-4, 1.25e-4), 4: (2.5e-3, 2e-2 / 12, 1e-3, 6.25e-4, 4e-4)},
    ),
)
