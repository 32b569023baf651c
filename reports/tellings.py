"""How an engine may tell its state wrongly though it moves rightly, and how to undo each way."""

from collections.abc import Callable, Iterator
from dataclasses import fields, replace

import numpy as np

from ..reference import quaternions
from ..reference.checked import Array
from ..scenarios.scene import Scene
from ..scenarios.trajectory import Trajectory

Undo = Callable[[Trajectory], Trajectory]

#: What a trajectory tells, in words.
CHANNELS = {
    "position": "position",
    "quaternion": "orientation",
    "velocity": "velocity",
    "omega": "angular velocity",
    "joint_position": "joint position",
    "joint_velocity": "joint velocity",
}


def tellings(scene: Scene) -> Iterator[tuple[str, Undo]]:
    """Sentences, each with what would make the telling right if it is true."""
    yield from _attitudes()
    yield from _frames(scene)
    for names, said in _LATE:
        yield f"{said} told one sample late", _later(names)
        yield f"{said} told one sample early", _earlier(names)
    if scene.scalar_joints:
        yield "joint positions are in degrees", _scaled("joint_position", np.pi / 180)
        yield "joint coordinates have the opposite sign", _opposite


_LATE = (
    (("joint_velocity",), "joint velocity is"),
    (("joint_position",), "joint position is"),
    (("velocity",), "velocity is"),
    (("position",), "position is"),
    (("omega",), "angular velocity is"),
    (("quaternion",), "orientation is"),
    (("velocity", "omega", "joint_velocity"), "velocities are"),
    (("position", "quaternion", "joint_position"), "positions are"),
)


def _attitudes() -> Iterator[tuple[str, Undo]]:
    def turned(change: Callable[[Array], Array]) -> Undo:
        return lambda told: replace(told, quaternion=change(told.quaternion))

    yield "quaternion is scalar-first", turned(lambda q: np.roll(q, -1, axis=-1))
    yield "quaternion is conjugated", turned(quaternions.conjugate)
    yield (
        "quaternion is scalar-first and conjugated",
        turned(lambda q: quaternions.conjugate(np.roll(q, -1, axis=-1))),
    )
    yield "quaternion is not normalised", turned(lambda q: q / np.linalg.norm(q, axis=-1, keepdims=True))


def _frames(scene: Scene) -> Iterator[tuple[str, Undo]]:
    offset = np.array([body.center_of_mass for body in scene.bodies])

    def into_body(told: Trajectory, vector: Array) -> Array:
        return quaternions.rotated(quaternions.conjugate(told.quaternion), vector)

    def centre(told: Trajectory) -> Trajectory:
        return replace(told, position=told.position + quaternions.rotated(told.quaternion, offset))

    def going(told: Trajectory) -> Trajectory:
        arm = np.cross(told.omega, offset)
        return replace(told, velocity=told.velocity + quaternions.rotated(told.quaternion, arm))

    yield "angular velocity is in world axes", lambda m: replace(m, omega=into_body(m, m.omega))
    yield "angular velocity has the opposite sign", lambda m: replace(m, omega=-m.omega)
    yield "angular velocity is in degrees per second", _scaled("omega", np.pi / 180)
    yield (
        "velocity is in body axes",
        lambda m: replace(m, velocity=quaternions.rotated(m.quaternion, m.velocity)),
    )
    if offset.any():
        yield "position is that of the frame, not of the centre of mass", centre
        yield "velocity is that of the frame, not of the centre of mass", going
        yield (
            "position and velocity are those of the frame, not of the centre of mass",
            lambda told: going(centre(told)),
        )


def _scaled(name: str, factor: float) -> Undo:
    return lambda told: replace(told, **{name: getattr(told, name) * factor})


def _opposite(told: Trajectory) -> Trajectory:
    return replace(told, joint_position=-told.joint_position, joint_velocity=-told.joint_velocity)


def _later(names: tuple[str, ...]) -> Undo:
    """What is told of the next sample is true of this one; the last sample is lost."""
    return lambda told: _cut(told, slice(None, -1), names, slice(1, None))


def _earlier(names: tuple[str, ...]) -> Undo:
    return lambda told: _cut(told, slice(1, None), names, slice(None, -1))


def _cut(told: Trajectory, kept: slice, names: tuple[str, ...], shifted: slice) -> Trajectory:
    parts = {f.name for f in fields(told)} - {"provenance"}
    return replace(told, **{name: getattr(told, name)[shifted if name in names else kept] for name in parts})
