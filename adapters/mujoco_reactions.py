"""Reactions of joints, in MuJoCo: what its inverse dynamics finds between a body and its parent."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..reference.checked import Array
from ..reference.quaternions import cross


def reactions(
    mujoco: Any, model: Any, data: Any, bodies: Sequence[int], pushed: Array, forces: Array | None
) -> Array:
    """Reactions (k, 6) of MuJoCo's ``bodies``, as ``Trajectory.reaction`` has them.

    ``data`` knows its accelerations. MuJoCo's wrenches are torque first, in world axes, about the centre
    of mass of the whole tree. They hold what acts through its callback for passive forces, of which it keeps
    only what that does along velocities: so the ``forces`` (b, 3) [N] on the bodies ``pushed`` (b,) are told
    again, in the place whose forces it takes off.
    """
    if forces is not None:
        data.xfrc_applied[pushed, :3] = forces
    mujoco.mj_rnePostConstraint(model, data)
    data.xfrc_applied[:] = 0  # where forces act while it steps, they would act twice
    found = np.empty((len(bodies), 6))
    for row, body in zip(found, bodies, strict=True):
        torque, force = np.split(data.cfrc_int[body], 2)
        arm = data.subtree_com[model.body_rootid[body]] - data.xpos[body]
        axes = data.xmat[body].reshape(3, 3)
        row[:3], row[3:] = force @ axes, (torque + cross(arm, force)) @ axes
    return found
