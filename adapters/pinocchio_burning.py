"""Masses that fall, in Pinocchio: the inertias that its joints move."""

from collections.abc import Sequence
from typing import Any

from ..scenarios.scene import Scene


class Masses:
    """The masses of a scene in a model; ``frames`` are those of the scene's bodies."""

    def __init__(self, pin: Any, scene: Scene, model: Any, frames: Sequence[Any], dt: float) -> None:
        self._pin, self._scene, self._model, self._dt = pin, scene, model, dt
        self._joints = [frames[burning.place(scene.bodies)].parentJoint for burning in scene.burning]
        self._full = [model.inertias[joint].copy() for joint in self._joints]

    def at(self, step: int) -> None:
        """Give the model the masses of the start of this step."""
        for burning, joint, full in zip(self._scene.burning, self._joints, self._full, strict=True):
            share = burning.share(self._scene.bodies, step * self._dt)
            self._model.inertias[joint] = self._pin.Inertia(
                full.mass * share, full.lever, full.inertia * share
            )
