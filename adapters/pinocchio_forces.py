"""Forces from outside the joints in Pinocchio: as joint forces, by the Jacobians of the centres of mass."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..reference.checked import Array
from ..scenarios.forces import Force, forces_on
from ..scenarios.scene import Scene


class Forces:
    """Those of a scene that act: all of them, until it is told which.

    ``centres`` are the joint and the place on it of each body's centre of mass.
    """

    def __init__(self, pin: Any, model: Any, scene: Scene, centres: Sequence[tuple[int, Any]]) -> None:
        self._pin, self._model, self._scene, self._centres = pin, model.copy(), scene, centres
        self._acting: Sequence[Force] = scene.forces
        self._total = forces_on(scene.bodies, scene.forces)
        self._frames = [
            self._model.addFrame(pin.Frame(f"centre {i}", joint, place, pin.FrameType.OP_FRAME))
            for i, (joint, place) in enumerate(centres)
        ]
        self._data, self._axes = self._model.createData(), pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
        # Of the centres: the same numbers (b, 3, nv) and (3 b, nv), and where they are (b, 3) [m].
        self._rows = np.zeros((len(centres), 3, model.nv))
        self._jacobian, self._position = self._rows.reshape(-1, model.nv), np.zeros((len(centres), 3))

    def let_act(self, forces: Sequence[Force]) -> None:
        """Let these alone act from now on."""
        if forces is not self._acting:
            self._acting, self._total = forces, forces_on(self._scene.bodies, forces)

    def along_velocities(self, q: Array, v: Array) -> Array:
        """Joint forces (nv,) at coordinates and velocities as Pinocchio has them."""
        return np.asarray(self._found(q, v).ravel().dot(self._jacobian))

    def on_joints(self, q: Array, v: Array) -> list[Any]:
        """Their wrench on each joint, in its axes: what Pinocchio is to take off what its joints bear."""
        pin, result = self._pin, [self._pin.Force.Zero() for _ in range(self._model.njoints)]
        if self._acting:
            found = self._found(q, v)
            for (joint, place), frame, push in zip(self._centres, self._frames, found, strict=True):
                turn = self._data.oMf[frame].rotation
                result[joint] += place.act(pin.Force(turn.T @ push, np.zeros(3)))
        return result

    def _found(self, q: Array, v: Array) -> Array:
        """Forces (b, 3) [N] in world axes; the Jacobian of the centres is then that at ``q``."""
        pin, model, data, jacobian, position = self._pin, self._model, self._data, self._rows, self._position
        axes = self._axes
        pin.computeJointJacobians(model, data, q)
        pin.updateFramePlacements(model, data)
        for number, frame in enumerate(self._frames):
            # Of a single velocity Pinocchio leaves out the last dimension.
            jacobian[number] = pin.getFrameJacobian(model, data, frame, axes)[:3].reshape(3, -1)
            position[number] = data.oMf[frame].translation
        return self._total(position, self._jacobian.dot(v).reshape(-1, 3))
