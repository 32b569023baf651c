"""What MuJoCo tells of a compiled model: where its inertias lie, and how its world is set up."""

from typing import Any

import numpy as np

from ..reference.checked import Array


def inertial_frame(mujoco: Any, model: Any, i: int) -> tuple[Array, Array]:
    """Centre of mass and principal axes of body ``i`` in body axes, as MuJoCo's kinematics takes them."""
    same = mujoco.mjtSameFrame(int(model.body_sameframe[i]))
    turned = same not in (mujoco.mjtSameFrame.mjSAMEFRAME_BODY, mujoco.mjtSameFrame.mjSAMEFRAME_BODYROT)
    com = model.body_ipos[i] if same != mujoco.mjtSameFrame.mjSAMEFRAME_BODY else np.zeros(3)
    axes = np.eye(3).ravel()
    if turned:  # by MuJoCo's own formula: a quaternion it found itself is of unit length only to 2e-15
        mujoco.mju_quat2Mat(axes, model.body_iquat[i])
    return com.copy(), axes.reshape(3, 3)


def world(mujoco: Any, model: Any) -> dict[str, Any]:
    """Settings of the world by name, as ``Setup.values`` has them."""
    weightless = model.opt.disableflags & mujoco.mjtDisableBit.mjDSBL_GRAVITY
    kind, first = model.jnt_type[model.dof_jntid], model.jnt_dofadr[model.dof_jntid]
    moving = (kind == mujoco.mjtJoint.mjJNT_FREE) & (np.arange(model.nv) < first + 3)
    turning = ~moving & (kind != mujoco.mjtJoint.mjJNT_HINGE) & (kind != mujoco.mjtJoint.mjJNT_SLIDE)
    rate = model.dof_damping * model.dof_invweight0
    return {
        "gravity": np.zeros(3) if weightless else model.opt.gravity.copy(),
        "dt": float(model.opt.timestep),
        "velocity_limit": np.inf,
        "linear_damping": float(rate[moving].max(initial=0.0)),
        "angular_damping": float(rate[turning].max(initial=0.0)),
    }
