"""A tree loaded into PyBullet, and all taken from it that PyBullet adds by itself."""

import math
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from ..scenarios.body import IDENTITY
from ..scenarios.scene import Scene
from . import pybullet_limits as limits
from . import pybullet_solids as solids
from .c_output import caught
from .pybullet_layout import Place
from .pybullet_urdf import urdf


def load(p: Any, client: int, scene: Scene, tree: list[int], maximal: bool) -> int:
    """Load one tree, its joints at zero and its base at the origin; PyBullet's number for it."""
    flags = solids.flags(p, scene, tree)
    with tempfile.TemporaryDirectory() as folder, caught() as said:
        path = Path(folder) / "model.urdf"  # never the same folder: PyBullet remembers files by name
        path.write_text(urdf(scene, tree))
        for name, text in solids.meshes(scene, tree).items():
            path.with_name(name).write_text(text)
        try:
            uid = p.loadURDF(str(path), useMaximalCoordinates=maximal, flags=flags, physicsClientId=client)
        except p.error:
            uid = -1
    limits.refuse_said(scene, uid, "".join(said))
    return int(uid)


def quieted(p: Any, client: int, uid: int, scene: Scene) -> Iterator[tuple[str, Place]]:
    """Take from a tree what PyBullet adds by itself, unless the scene leaves it; joints' places by name."""
    if not scene.defaults:
        p.changeDynamics(
            uid, -1, linearDamping=0, angularDamping=0, maxJointVelocity=math.inf,
            activationState=p.ACTIVATION_STATE_DISABLE_SLEEPING, physicsClientId=client,
        )  # fmt: skip
    still = {"targetPosition": IDENTITY, "physicsClientId": client}
    for link in range(p.getNumJoints(uid, client)):
        _, name, kind, *_ = p.getJointInfo(uid, link, client)
        if kind == p.JOINT_SPHERICAL and not scene.defaults:
            p.setJointMotorControlMultiDof(uid, link, p.POSITION_CONTROL, force=[0, 0, 0], **still)
        elif kind != p.JOINT_FIXED and not scene.defaults:
            p.setJointMotorControl2(uid, link, p.VELOCITY_CONTROL, force=0, physicsClientId=client)
        yield name.decode(), (uid, link)
