"""The URDF that PyBullet is given: one text for each tree of bodies, with every digit."""

import math
import re
from collections.abc import Iterable, Iterator

import numpy as np
import numpy.typing as npt

from ..reference import quaternions
from ..reference.checked import Array
from ..scenarios.body import IDENTITY, Body, Joint
from ..scenarios.scene import Scene
from . import pybullet_solids as solids
from .pybullet_shapes import shapes

_TYPES = {"ball": "spherical", "hinge": "continuous", "slide": "prismatic"}


def trees(scene: Scene) -> list[list[int]]:
    """Indices of the bodies of each tree, a root first."""
    found: dict[str, list[int]] = {}
    for index, body in enumerate(scene.bodies):
        tree = found[body.parent] if body.parent else []
        tree.append(index)
        found[body.name] = tree
    return [found[body.name] for body in scene.bodies if body.parent is None]


def is_free(body: Body) -> bool:
    """Whether the body is the base of its tree, which PyBullet lets move freely."""
    return any(joint.kind == "free" for joint in body.joints)


def joint_name(body: int, joint: int) -> str:
    """Name in the URDF of the joint of this number on the body of this number."""
    return f"joint {body}.{joint}"


def urdf(scene: Scene, tree: list[int]) -> str:
    """One tree as URDF: the bodies' frames are its links' frames, inertias lie along principal axes.

    Joints that share a body get links without mass between them. No line is long: PyBullet cuts
    lines at 8191 characters without a word.
    """
    lines = ['<?xml version="1.0"?>', f'<robot name="{_plain(scene.full_name)}">']
    if not is_free(scene.bodies[tree[0]]):
        lines += _link("ground", 0.0)
    names = {scene.bodies[index].name: _link_name(scene, index) for index in tree}
    for index in tree:
        body = scene.bodies[index]
        shaped = solids.lines(body, index, _origin) if body.solids else shapes(scene, index)
        lines += _body(names[body.name], body, shaped)
        lines += _joints(index, body, names.get(body.parent or "", "ground"), names[body.name])
    return "\n".join([*lines, "</robot>", ""])


def document(scene: Scene) -> str:
    """The URDF of every tree, one after the other, and as comments the meshes that they name."""
    every = [urdf(scene, tree) for tree in trees(scene)]
    meshes = solids.meshes(scene, range(len(scene.bodies))).items()
    return "\n".join([*every, *(f"<!-- {name}\n{text}-->\n" for name, text in meshes)])


def principal_axes(inertia: Array) -> tuple[Array, Array]:
    """Principal moments (3,) [kg m²] and the axes they belong to, the columns of a rotation (3, 3).

    Moments that rounding has put an ulp beyond a plate's are put back: PyBullet would set all three
    to zero.
    """
    if np.array_equal(inertia, np.diag(np.diag(inertia))):
        moments, axes = np.diag(inertia).copy(), np.eye(3)
    else:
        moments, axes = np.linalg.eigh(inertia)
        axes[:, 2] *= np.sign(np.linalg.det(axes))
    largest = int(np.argmax(moments))
    moments[largest] = min(moments[largest], np.delete(moments, largest).sum())
    return moments, axes


def roll_pitch_yaw(axes: Array) -> tuple[float, float, float]:
    """Angles [rad] of the rotation Rz(yaw) Ry(pitch) Rx(roll) = ``axes`` (3, 3), good to rounding.

    The yaw is taken from what the roll leaves over, so that near a pitch of ±π/2, where each of the
    two is ill-defined, they still fit together.
    """
    roll = math.atan2(axes[2, 1], axes[2, 2])
    pitch = math.atan2(-axes[2, 0], math.hypot(axes[2, 1], axes[2, 2]))
    s, c = math.sin(roll), math.cos(roll)
    yaw = math.atan2(s * axes[0, 2] - c * axes[0, 1], c * axes[1, 1] - s * axes[1, 2])
    return roll, pitch, yaw


def _body(name: str, body: Body, shaped: Iterable[str]) -> Iterator[str]:
    moments, axes = principal_axes(body.inertia_array)
    if body.solids:
        # PyBullet takes its own moments, along the axes of the inertial frame.
        own = solids.axes(body)
        moments, axes = np.zeros(3), axes if own is None else own
    return _link(name, body.mass, moments, _origin(body.center_of_mass, axes), shaped)


def _link(
    name: str,
    mass: float,
    moments: npt.ArrayLike = (0, 0, 0),
    origin: str = "",
    shaped: Iterable[str] = (),
) -> Iterator[str]:
    xx, yy, zz = (repr(float(moment)) for moment in np.asarray(moments))
    yield f'<link name="{name}">'
    yield f'  <inertial>{origin}<mass value="{float(mass)!r}"/>'
    yield f'    <inertia ixx="{xx}" iyy="{yy}" izz="{zz}" ixy="0" ixz="0" iyz="0"/>'
    yield "  </inertial>"
    yield from shaped
    yield "</link>"


def _joints(index: int, body: Body, parent: str, child: str) -> Iterator[str]:
    """The joints from ``parent`` to ``child``, a link without mass before each but the first."""
    if is_free(body):
        return
    origin = _origin(body.position, quaternions.matrix(np.array(body.quaternion)), body.quaternion)
    last = len(body.joints) - 1
    for number, joint in enumerate(body.joints or (None,)):
        link = child if number >= last else f"{child} {number}"
        if link != child:
            yield from _link(link, 0.0)
        yield f'<joint name="{joint_name(index, number)}" type="{_TYPES[joint.kind] if joint else "fixed"}">'
        yield f'  <parent link="{parent}"/><child link="{link}"/>{origin}'
        yield from _motion(joint) if joint else ()
        yield "</joint>"
        parent, origin = link, ""


def _motion(joint: Joint) -> Iterator[str]:
    axis = np.array(joint.axis) / np.linalg.norm(joint.axis)
    yield f'  <axis xyz="{_numbers(axis)}"/><dynamics damping="{float(joint.damping)!r}" friction="0"/>'
    if joint.kind == "slide":
        yield '  <limit lower="0" upper="-1" effort="0" velocity="0"/>'  # upside down: none


def _origin(position: npt.ArrayLike, axes: Array, quaternion: tuple[float, ...] = ()) -> str:
    turn = (0.0, 0.0, 0.0) if quaternion == IDENTITY else roll_pitch_yaw(axes)
    return f'<origin xyz="{_numbers(position)}" rpy="{_numbers(turn)}"/>'


def _link_name(scene: Scene, index: int) -> str:
    return f"{index} {_plain(scene.bodies[index].name)}"


def _plain(name: str) -> str:
    return re.sub(r"[^A-Za-z0-9]+", "_", name)[:60]


def _numbers(values: npt.ArrayLike) -> str:
    return " ".join(repr(float(value)) for value in np.asarray(values))
