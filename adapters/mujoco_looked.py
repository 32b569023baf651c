"""Where MuJoCo's bodies are: asked of a copy of its data, so that its own motion goes on as it was."""

from typing import Any

import numpy as np
import numpy.typing as npt

from ..reference.checked import Array
from .engine import State

Places = npt.NDArray[np.intp]

#: Where MuJoCo, whose quaternions are scalar-first, has x, y, z and w.
_XYZW = np.array([1, 2, 3, 0])


class Look:
    """A look at a model's ``bodies``, hinges and slides, by their places in MuJoCo's arrays.

    A run looks far more often than it builds, and a look at few bodies costs what numpy does about it:
    arrays are asked for once, and what a look needs of one is taken out of it at once. ``data`` is the copy,
    for other questions whose answers leave the motion alone.
    """

    def __init__(self, mujoco: Any, model: Any, bodies: Places, scalar_q: Places, scalar_v: Places) -> None:
        self._mujoco, self._model, self.data = mujoco, model, mujoco.MjData(model)
        self._bodies, self._numbers = bodies, bodies.tolist()
        self._scalar_q, self._scalar_v = scalar_q, scalar_v
        self._qpos, self._qvel, self._xipos = self.data.qpos, self.data.qvel, self.data.xipos
        self._xquat, self._xmat = self.data.xquat.ravel(), self.data.xmat.ravel()
        self._quaternions = 4 * bodies[:, None] + _XYZW
        self._axes = 9 * bodies[:, None, None] + np.arange(9).reshape(3, 3)

    def at(self, qpos: Array, qvel: Array) -> State:
        """Where everything is at coordinates and velocities as MuJoCo has them."""
        mujoco, model, data = self._mujoco, self._model, self.data
        self._qpos[:], self._qvel[:] = qpos, qvel
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        mujoco.mj_comVel(model, data)
        kind, speeds = mujoco.mjtObj.mjOBJ_BODY, np.empty((len(self._numbers), 6))
        for row, body in zip(speeds, self._numbers, strict=True):
            mujoco.mj_objectVelocity(model, data, kind, body, row, 0)
        return State(
            position=self._xipos.take(self._bodies, 0),
            quaternion=self._xquat.take(self._quaternions),
            velocity=speeds[:, 3:],
            omega=np.einsum("bji,bj->bi", self._xmat.take(self._axes), speeds[:, :3]),
            joint_position=qpos.take(self._scalar_q),
            joint_velocity=qvel.take(self._scalar_v),
        )
