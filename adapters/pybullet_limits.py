"""What PyBullet runs wrong without a word, found before it runs: too small, too large, too fast."""

import math
from collections.abc import Iterable

import numpy as np

from ..reference.checked import Array
from ..reference.errors import InputError
from ..scenarios.body import WIDTHS
from ..scenarios.scene import Scene
from . import pybullet_contact
from .engine import EngineError, Scheme, State
from .pybullet_urdf import is_free, principal_axes, trees

#: What maximal coordinates lack, each with the reason.
LACKING = dict.fromkeys(
    ("ball", "hinge", "slide", "weld", "tree", "spring", "damper", "reaction"),
    "in maximal coordinates PyBullet lets no one set or read a joint, so that only free bodies can be run",
) | {"acceleration": "the limit of small steps, 11 ms a state and good to 1e-10 at the worst"}
#: What PyBullet takes for zero: a mass, a moment, a joint's inertia, a product of three moments.
EPSILON = float(np.finfo(np.float64).eps)
#: PyBullet turns no body further than this [rad] in a step.
LARGEST_TURN = math.pi / 4
#: Coordinates that PyBullet has room for in a tree, seven of them its base's; more overrun its memory.
ROOM = 128


def refuse(scene: Scene, scheme: Scheme, maximal: bool) -> None:
    """Raise ``InputError`` for what ``scheme`` lacks, or what is too small or too large for PyBullet."""
    lacking = dict.fromkeys(scheme.lacks[name] for name in sorted(scene.features & scheme.lacks.keys()))
    if lacking:
        raise InputError(f"scene {scene.full_name}: {'; '.join(lacking)}")
    pybullet_contact.refuse(scene)
    for tree in trees(scene):
        _refuse_small(scene, tree, maximal)
        _refuse_large(scene, tree)


def refuse_frozen(scene: Scene, responses: Iterable[Array]) -> None:
    """Raise ``InputError`` for the first hinge or slide that a force in it does not move."""
    for joint, response in zip(scene.scalar_joints, responses, strict=True):
        if not response.any():
            raise InputError(
                f"scene {scene.full_name}: joint {joint.name!r} moves an inertia below {EPSILON:.3g} "
                "(kg m² or kg), with which PyBullet never moves it; scale the scene up"
            )


def refuse_broken(state: State, turning: Iterable[Iterable[float]], dt: float) -> None:
    """Raise ``EngineError`` for a state that is not finite, or for an ω (3,) too fast for the step."""
    # Lists, as numpy takes ten times as long to look through so few numbers.
    if not all(math.isfinite(number) for part in state for number in part.ravel().tolist()):
        raise EngineError(f"PyBullet left the finite numbers, at a step of {dt:g} s", state)
    fastest = max((math.hypot(*omega) for omega in turning), default=0.0)
    if fastest * dt > LARGEST_TURN:
        raise EngineError(
            f"PyBullet clips turns of more than π/4 in a step: got {fastest:.4g} rad/s "
            f"at a step of {dt:g} s; take a step below {LARGEST_TURN / fastest:.3g} s",
            state,
        )


def refuse_said(scene: Scene, uid: int, text: str) -> None:
    """Raise ``EngineError`` if a model was not loaded, or PyBullet printed anything: it only complains."""
    if uid < 0 or text.strip():
        raise EngineError(
            f"PyBullet refuses {scene.full_name}: {' '.join(text.split()) or 'no reason given'}"
        )


def _refuse_small(scene: Scene, tree: list[int], maximal: bool) -> None:
    body = scene.bodies[tree[0]]
    if not is_free(body) or len(tree) > 1:
        return  # what joints move is tried out instead
    moments, _ = principal_axes(body.inertia_array)
    size = float(np.prod(moments)) if maximal else float(min(body.mass, *moments))
    if size < EPSILON:
        what = "product of moments" if maximal else "smallest of mass and moments"
        lost = "the gyroscopic term" if maximal else "its acceleration"
        raise InputError(
            f"scene {scene.full_name}: body {body.name!r} has a {what} of {size:.3g}; below "
            f"{EPSILON:.3g} PyBullet leaves out {lost}; scale the scene up"
        )


def _refuse_large(scene: Scene, tree: list[int]) -> None:
    joints = [joint for index in tree for joint in scene.bodies[index].joints if joint.kind != "free"]
    needed = 7 + sum(WIDTHS[joint.kind][0] for joint in joints)
    links = len(joints) + sum(not scene.bodies[index].joints for index in tree)
    if max(needed, links + 1) > ROOM:
        raise InputError(
            f"scene {scene.full_name}: a tree of {links} links with {needed - 7} coordinates; "
            f"PyBullet has room for {ROOM - 1} links and {ROOM - 7} coordinates"
        )
