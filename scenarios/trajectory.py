"""What a run leaves behind: arrays over the sample times, and where they came from."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..reference import quaternions
from ..reference.checked import Array
from ..reference.errors import InputError


@dataclass(frozen=True)
class Provenance:
    """Which cell a trajectory is the outcome of, and what was found out while it ran.

    ``order`` is the scheme's declared order, ``twin`` the name it shares with the same scheme of
    other engines. ``setup`` maps a setting to what the engine read back, ``probed`` names those
    of them that were inferred from a probe run; ``digests`` are hashes of the states of repeated
    runs, ``accelerations`` (n, nv) the engine's at the states of ``equations.states``, ``stable_step`` the
    largest step [s] seen to hold and the smallest seen to grow, ``settings`` its own settings in words,
    ``environment`` versions and machine.
    """

    scene: str
    engine: str
    engine_version: str
    scheme: str
    order: int
    twin: str
    dt: float
    steps: int
    setup: Mapping[str, Any] = field(default_factory=dict)
    probed: tuple[str, ...] = ()
    digests: tuple[str, ...] = ()
    accelerations: tuple[tuple[float, ...], ...] = ()
    stable_step: tuple[float, ...] = ()
    settings: Mapping[str, str] = field(default_factory=dict)
    environment: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Trajectory:
    """The motion of ``b`` bodies and ``j`` scalar joints at ``n`` times.

    ``t`` (n,) [s]; ``position`` (n, b, 3) of the centres of mass, world axes [m]; ``quaternion``
    (n, b, 4) body to world, scalar last; ``velocity`` (n, b, 3) of the centres of mass, world axes
    [m/s]; ``omega`` (n, b, 3), **body axes** [rad/s]; ``joint_position`` and ``joint_velocity``
    (n, j), the hinges [rad, rad/s] and slides [m, m/s] in the scene's order.

    ``reaction`` (n, k, 6) of the k bodies that the scene names in ``reactions``, none unless it does:
    force [N] and moment [N m] that the parent exerts on the body through its joints, in the **body's
    axes**, the moment about the origin of the body's frame, where those joints are. It is all that passes
    through them, springs and dampers too, and nothing that acts from outside, in the state of that very
    sample and under the forces of the step about to be taken.

    Raises ``InputError`` if a shape does not fit.
    """

    t: Array
    position: Array
    quaternion: Array
    velocity: Array
    omega: Array
    joint_position: Array
    joint_velocity: Array
    provenance: Provenance | None = None
    reaction: Array = field(default_factory=lambda: np.empty((0, 0, 6)))

    def __post_init__(self) -> None:
        n, b = self.position.shape[:2]
        j = self.joint_position.shape[-1]
        if self.reaction.shape[1:] == (0, 6):  # none, of however many samples
            object.__setattr__(self, "reaction", np.empty((n, 0, 6)))
        expected = {
            "t": (n,),
            "position": (n, b, 3),
            "quaternion": (n, b, 4),
            "velocity": (n, b, 3),
            "omega": (n, b, 3),
            "joint_position": (n, j),
            "joint_velocity": (n, j),
            "reaction": (n, *self.reaction.shape[1:2], 6),
        }
        for name, shape in expected.items():
            got = getattr(self, name).shape
            if got != shape:
                raise InputError(f"trajectory {name}: got shape {got}, expected {shape}")

    def first_not_finite(self) -> float | None:
        """Time [s] of the first sample that holds a number that is not finite, or ``None``."""
        n = len(self.t)
        arrays = (
            self.position,
            self.quaternion,
            self.velocity,
            self.omega,
            self.joint_position,
            self.joint_velocity,
            self.reaction,
        )
        fine = np.logical_and.reduce([np.isfinite(a.reshape(n, -1)).all(axis=1) for a in arrays])
        return None if fine.all() else float(self.t[int(np.argmin(fine))])


def about_fixed_point(t: Array, center_of_mass: Array, quaternion: Array, omega: Array) -> Trajectory:
    """Motion of one body whose frame's origin stays at the world's, from its attitude.

    ``center_of_mass`` (3,) [m] and ``omega`` (n, 3) [rad/s] in body axes, ``quaternion`` (n, 4).
    """
    position = quaternions.rotated(quaternion, center_of_mass)
    velocity = quaternions.rotated(quaternion, np.cross(omega, center_of_mass))
    return of_one_body(t, position, quaternion, velocity, omega)


def of_one_body(t: Array, position: Array, quaternion: Array, velocity: Array, omega: Array) -> Trajectory:
    """Motion of one body without scalar joints: arrays as of a ``Trajectory``, without its axis of bodies."""
    none = np.empty((len(t), 0))
    return Trajectory(
        t, position[:, None], quaternion[:, None], velocity[:, None], omega[:, None], none, none
    )
