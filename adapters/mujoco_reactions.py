"""Reactions of joints, in MuJoCo: what its inverse dynamics finds between a body and its parent."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..reference.checked import Array
from ..reference.quaternions import cross


def reactions(mujoco: Any, model: Any, data: Any, bodies: Sequence[int]) -> Array:
    """Reactions (k, 6) of MuJoCo's ``bodies``, as ``Trajectory.reaction`` has them.

    ``data`` knows its accelerations. MuJoCo's wrenches are torque first, in world axes, about the centre
    of mass of the whole tree.
    """
    mujoco.mj_rnePostConstraint(model, data)
    found = np.empty((len(bodies), 6))
    for row, body in zip(found, bodies, strict=True):
        torque, force = np.split(data.cfrc_int[body], 2)
        arm = data.subtree_com[model.body_rootid[body]] - data.xpos[body]
        axes = data.xmat[body].reshape(3, 3)
        row[:3], row[3:] = force @ axes, (torque + cross(arm, force)) @ axes
    return found
