"""Masses that fall, in MuJoCo: of the compiled model, and of all that MuJoCo derives from them."""

from typing import Any

from ..reference.checked import Array
from ..scenarios.scene import Scene


class Masses:
    """The masses of a scene in a model, whose bodies are numbered as ``bodies`` (b,)."""

    def __init__(self, mujoco: Any, scene: Scene, model: Any, bodies: Array, dt: float) -> None:
        self._mujoco, self._scene, self._model, self._dt = mujoco, scene, model, dt
        # What it derives is written over with the pose of the reference: not into the data that moves.
        self._scratch = mujoco.MjData(model)
        places = [int(bodies[burning.place(scene.bodies)]) for burning in scene.burning]
        self._full = [(i, float(model.body_mass[i]), model.body_inertia[i].copy()) for i in places]

    def at(self, step: int) -> None:
        """Give the model the masses of the start of this step."""
        model = self._model
        for burning, (i, mass, inertia) in zip(self._scene.burning, self._full, strict=True):
            share = burning.share(self._scene.bodies, step * self._dt)
            model.body_mass[i], model.body_inertia[i] = mass * share, inertia * share
        self._mujoco.mj_setConst(model, self._scratch)
