"""Foucault's pendulum at a pole, seen by who turns with the planet: a swing of any size, exact.

In the room it swings in a plane; below it the ground turns, here in 16 s. Catches an engine that
leaves out the Coriolis or the centrifugal part, or takes it along axes that turn with the bob.
"""

import numpy as np

from ..reference import foucault, plane_pendulum, quaternions
from ..reference.checked import Array
from . import observables, pictures
from .body import Body, Joint, diagonal
from .forces import Centrifugal, Coriolis
from .scene import Scene
from .trajectory import Trajectory

LENGTH, G, TURN = 1.0, 9.81, 0.4
#: Angle [rad], its rate [rad/s] and the azimuth of the plane [rad] at the start.
ANGLE, RATE, AZIMUTH = 0.5, -1.2, 0.6
BOB = Body(
    "bob",
    50.0,
    # A point: the inertia about its centre is 2e-14 of that about the pivot.
    diagonal(1e-12, 1e-12, 1e-12),
    (Joint("tilt about x", "hinge", (1.0, 0.0, 0.0)), Joint("tilt about y", "hinge", (0.0, 1.0, 0.0))),
    center_of_mass=(0.0, 0.0, -LENGTH),
)


def _hung(t: Array, theta: Array, rate: Array) -> Trajectory:
    """A swing by ``theta`` (n,) [rad], in a plane that turns backwards below it."""
    phi = AZIMUTH - TURN * t
    s, c, sine, cosine = np.sin(phi), np.cos(phi), np.sin(theta), np.cos(theta)
    n = np.stack([sine * c, sine * s, -cosine], axis=1)
    across = np.stack([-sine * s, sine * c, 0 * t], axis=1)
    n_rate = rate[:, None] * np.stack([cosine * c, cosine * s, sine], axis=1) - TURN * across
    return _on_hinges(t, n, n_rate)


def _on_hinges(t: Array, n: Array, n_rate: Array) -> Trajectory:
    """The pendulum along unit vectors ``n`` (n, 3): turned about x by α, then about its own y by β."""
    alpha, beta = np.arctan2(n[:, 1], -n[:, 2]), -np.arcsin(n[:, 0])
    lean = np.cos(beta)
    alpha_rate = (n[:, 1] * n_rate[:, 2] - n[:, 2] * n_rate[:, 1]) / lean**2
    beta_rate = -n_rate[:, 0] / lean
    q = quaternions.product(
        quaternions.from_rotation_vector(alpha[:, None] * np.array((1.0, 0.0, 0.0))),
        quaternions.from_rotation_vector(beta[:, None] * np.array((0.0, 1.0, 0.0))),
    )
    omega = np.stack([alpha_rate * lean, beta_rate, alpha_rate * np.sin(beta)], axis=1)
    return Trajectory(
        t,
        LENGTH * n[:, None],
        q[:, None],
        LENGTH * n_rate[:, None],
        omega[:, None],
        np.column_stack([alpha, beta]),
        np.column_stack([alpha_rate, beta_rate]),
    )


def _truth(scene: Scene, t: Array) -> Trajectory:
    return _hung(t, *plane_pendulum.motion(G, LENGTH, ANGLE, RATE, t))


def _plane(scene: Scene, motion: Trajectory) -> Array:
    """Complex numbers whose phase is twice the azimuth of the plane of swing, wherever in it the bob is."""
    place, velocity = (part[:, 0, 0] + 1j * part[:, 0, 1] for part in (motion.position, motion.velocity))
    in_room = velocity + 1j * TURN * place
    return np.asarray(G / LENGTH * place**2 + in_room**2)


def _twice_the_turn(scene: Scene) -> float:
    return 2 * foucault.precession_rate(TURN, np.pi / 2)


def _between(scene: Scene, motion: Trajectory) -> Array:
    """What the hinges' angles and rates differ by from where the bob is and how it moves."""
    n, n_rate = motion.position[:, 0] / LENGTH, motion.velocity[:, 0] / LENGTH
    hung = _on_hinges(motion.t, n, n_rate)
    return np.column_stack(
        [hung.joint_position - motion.joint_position, hung.joint_velocity - motion.joint_velocity]
    )


_START = _hung(np.zeros(1), np.array([ANGLE]), np.array([RATE]))
#: C of C·dt^order of each observable in turn, measured by benchmarks/error_constants.py with MuJoCo 4.0.0.
ERRORS: dict[str, tuple[float, ...]] = {
    "implicit gyroscopic": (0.82, 2.8, 0.84, 2.7, 0.47, 340.0, 0.0),
    "RKMK4": (3.9, 13.0, 3.9, 11.0, 3.6, 39.0, 0.0),
    # A body on hinges: both of MuJoCo's own leave its gyroscopic term explicit.
    **dict.fromkeys(
        ("semi-implicit Euler", "implicitfast", "discrete"), (0.94, 3.2, 0.94, 3.0, 0.15, 380.0, 0.0)
    ),
}

SCENES = (
    Scene(
        name="foucault_pendulum",
        summary="A pendulum over the pole of a planet that turns in 16 s: its plane of swing turns back.",
        source="Taylor, Classical Mechanics, § 9.9; Goldstein, Classical Mechanics, ch. 4.10",
        bodies=(BOB,),
        gravity=(0.0, 0.0, -G),
        forces=(Coriolis((0.0, 0.0, TURN)), Centrifugal((0.0, 0.0, TURN))),
        q0=tuple(_START.joint_position[0].tolist()),
        v0=tuple(_START.joint_velocity[0].tolist()),
        duration=2.4,
        samples=75,
        dt=2e-3,
        truth=_truth,
        observables=(
            observables.position(),
            observables.velocity(),
            observables.orientation(),
            observables.omega(),
            observables.rate("turn of the plane, twice", _plane, _twice_the_turn),
            observables.energy(),
            observables.invariant("hinge residual", "rad", _between, lambda scene, b: 1.0),
        ),
        pictures=(
            pictures.Picture(
                "Path from above", ("east [m]", "north [m]"), lambda scene, m: m.position[:, 0, :2]
            ),
        ),
        ladders={1: (1.6e-2, 8e-3, 4e-3, 2e-3, 1e-3), 4: (1.6e-2, 8e-3, 1.6e-2 / 3, 4e-3, 2e-3)},
        errors=ERRORS,
    ),
)
