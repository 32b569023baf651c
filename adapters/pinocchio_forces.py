"""Forces from outside the joints in Pinocchio: as joint forces, by the Jacobians of the centres of mass."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from ..reference.checked import Array
from ..scenarios.forces import forces_on
from ..scenarios.scene import Scene


def joint_forces(
    pin: Any, model: Any, scene: Scene, centres: Sequence[tuple[int, Any]]
) -> Callable[[Array, Array], Array]:
    """Joint forces (nv,) of the scene's forces at coordinates and velocities as Pinocchio has them.

    ``centres`` are the joint and the place on it of each body's centre of mass.
    """
    total, model = forces_on(scene.bodies, scene.forces), model.copy()
    frames = [
        model.addFrame(pin.Frame(f"centre {i}", joint, place, pin.FrameType.OP_FRAME))
        for i, (joint, place) in enumerate(centres)
    ]
    data, axes = model.createData(), pin.ReferenceFrame.LOCAL_WORLD_ALIGNED

    def of(q: Array, v: Array) -> Array:
        pin.computeJointJacobians(model, data, q)
        pin.updateFramePlacements(model, data)
        J = np.array([pin.getFrameJacobian(model, data, frame, axes)[:3] for frame in frames])
        position = np.array([data.oMf[frame].translation for frame in frames])
        return np.asarray(total(position, J @ v).ravel() @ J.reshape(-1, len(v)))

    return of
