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
        self._data = self._model.createData()

    def let_act(self, forces: Sequence[Force]) -> None:
        """Let these alone act from now on."""
        if forces is not self._acting:
            self._acting, self._total = forces, forces_on(self._scene.bodies, forces)

    def along_velocities(self, q: Array, v: Array) -> Array:
        """Joint forces (nv,) at coordinates and velocities as Pinocchio has them."""
        force, J = self._found(q, v)
        return np.asarray(force.ravel() @ J.reshape(-1, len(v)))

    def on_joints(self, q: Array, v: Array) -> list[Any]:
        """Their wrench on each joint, in its axes: what Pinocchio is to take off what its joints bear."""
        pin, result = self._pin, [self._pin.Force.Zero() for _ in range(self._model.njoints)]
        if self._acting:
            force, _ = self._found(q, v)
            for (joint, place), frame, push in zip(self._centres, self._frames, force, strict=True):
                turn = self._data.oMf[frame].rotation
                result[joint] += place.act(pin.Force(turn.T @ push, np.zeros(3)))
        return result

    def _found(self, q: Array, v: Array) -> tuple[Array, Array]:
        """Forces (b, 3) [N] in world axes, and the Jacobians (b, 3, nv) of the centres."""
        pin, model, data = self._pin, self._model, self._data
        axes = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
        pin.computeJointJacobians(model, data, q)
        pin.updateFramePlacements(model, data)
        J = np.array([pin.getFrameJacobian(model, data, frame, axes)[:3] for frame in self._frames])
        position = np.array([data.oMf[frame].translation for frame in self._frames])
        J = J.reshape(-1, 3, len(v))  # of a single velocity Pinocchio leaves out the last dimension
        return self._total(position, J @ v), J
