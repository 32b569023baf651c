"""How one joint of a tree moves what it carries: the new frame, and what each velocity moves and how.

A coordinate that turns has an axis and a point on it, one that slides has a direction; both ride on the
frame that carries the joint (Kane & Levinson, *Dynamics: Theory and Applications*, ch. 2).
"""

from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from . import quaternions
from .checked import Array
from .errors import InputError
from .multibody_tree import Joint

NO_TURN = np.array([0.0, 0.0, 0.0, 1.0])


@dataclass(frozen=True)
class Frame:
    """A moving frame: its turn, its origin, and their rates, all in world axes."""

    quaternion: Array  # (..., 4)
    origin: Array  # (..., 3) [m]
    omega: Array  # (..., 3) [rad/s]
    velocity: Array  # (..., 3) of the origin [m/s]


@dataclass(frozen=True)
class Columns:
    """What each of k velocities of a joint moves: axes, a point on each, and their rates, in world axes."""

    rotates: npt.NDArray[np.bool_]  # (k,)
    axis: Array  # (..., k, 3)
    point: Array  # (..., k, 3) [m]
    axis_rate: Array  # (..., k, 3) [1/s]
    point_velocity: Array  # (..., k, 3) [m/s]


def joined(parts: list[Columns]) -> Columns:
    """All columns of ``parts``, in their order."""
    return Columns(
        np.concatenate([part.rotates for part in parts]),
        *(
            np.concatenate([getattr(part, name) for part in parts], axis=-2)
            for name in ("axis", "point", "axis_rate", "point_velocity")
        ),
    )


def placed(frame: Frame, position: Array, quaternion: Array) -> Frame:
    """The frame at a fixed place in ``frame``, carried along by it."""
    arm = quaternions.rotated(frame.quaternion, position)
    return replace(
        frame,
        quaternion=quaternions.product(frame.quaternion, quaternion),
        origin=frame.origin + arm,
        velocity=frame.velocity + quaternions.cross(frame.omega, arm),
    )


def moved(frame: Frame, joint: Joint, q: Array, v: Array) -> tuple[Frame, Columns]:
    """The frame that ``joint`` carries on ``frame``, and what its velocities move.

    Parameters
    ----------
    frame : what carries the joint
    joint : which
    q, v : its own coordinates (..., 7, 4 or 1) and velocities (..., 6, 3 or 1)

    Raises
    ------
    InputError
        For a quaternion of length below ½; others are normalised, since an integrator's stages are not unit.
    """
    if joint.kind == "slide":
        return _slid(frame, np.asarray(joint.axis), q, v)
    if joint.kind == "hinge":
        axis = np.asarray(joint.axis)
        return _turned(frame, joint, quaternions.from_rotation_vector(q * axis), axis[None, :], v)
    if joint.kind == "ball":
        return _turned(frame, joint, _normalised(q), np.eye(3), v)
    return _freed(frame, joint, q, v)


def _slid(frame: Frame, axis: Array, q: Array, v: Array) -> tuple[Frame, Columns]:
    direction = quaternions.rotated(frame.quaternion, axis)
    direction_rate = quaternions.cross(frame.omega, direction)
    after = replace(
        frame,
        origin=frame.origin + q * direction,
        velocity=frame.velocity + v * direction + q * direction_rate,
    )
    unused = np.zeros((*q.shape[:-1], 1, 3))
    columns = Columns(
        np.array([False]), direction[..., None, :], unused, direction_rate[..., None, :], unused
    )
    return after, columns


def _turned(frame: Frame, joint: Joint, turn: Array, axes: Array, v: Array) -> tuple[Frame, Columns]:
    """Turn ``frame`` about the joint's point; ``axes`` (k, 3), in axes after the turn, go with ``v``."""
    position = np.asarray(joint.position)
    before = placed(frame, position, NO_TURN)
    quaternion = quaternions.product(frame.quaternion, turn)
    world_axes = quaternions.rotated(quaternion[..., None, :], axes)
    omega = frame.omega + np.einsum("...k,...kc->...c", v, world_axes)
    after = Frame(quaternion, before.origin, omega, before.velocity)
    # Axes of a ball are fixed in the link it carries; that of a hinge in both links alike.
    columns = Columns(
        np.ones(len(axes), dtype=bool),
        world_axes,
        np.broadcast_to(before.origin[..., None, :], world_axes.shape),
        quaternions.cross(omega[..., None, :], world_axes),
        np.broadcast_to(before.velocity[..., None, :], world_axes.shape),
    )
    return placed(after, -position, NO_TURN), columns


def _freed(frame: Frame, joint: Joint, q: Array, v: Array) -> tuple[Frame, Columns]:
    translated = replace(frame, origin=q[..., :3], velocity=v[..., :3])
    at_origin = replace(joint, position=(0.0, 0.0, 0.0))
    after, turning = _turned(translated, at_origin, _normalised(q[..., 3:]), np.eye(3), v[..., 3:])
    unused = np.zeros((*q.shape[:-1], 3, 3))
    sliding = Columns(np.zeros(3, bool), np.broadcast_to(np.eye(3), unused.shape), unused, unused, unused)
    return after, joined([sliding, turning])


def _normalised(q: Array) -> Array:
    norm = np.linalg.norm(q, axis=-1, keepdims=True)
    if np.any(norm < 0.5):
        raise InputError(f"q: got a quaternion of length {norm.min()}, expected unit length")
    normalised: Array = q / norm
    return normalised
