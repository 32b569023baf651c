"""Springs, and what pulls a pendulum back."""

import numpy as np
from poinsot.adapters.mujoco_ import MuJoCo

from .entry import CHAIN, ENERGY, EQUATIONS, MODES, OWN, PENDULUM, SE, TWIN, Lying, Sight, Wrong


def stiff(size):
    """Springs too stiff by a part of what was asked for."""

    class StiffSpring(Lying, MuJoCo):
        def build(self, scene, scheme, dt):
            super().build(scene, scheme, dt)
            self._model.jnt_stiffness *= 1 + size

    return StiffSpring


class Linearised(Lying, MuJoCo):
    """Its pendulum is pulled back by the angle in place of its sine."""

    def step(self, n):
        body, (angle,) = self._scene.bodies[0], self._data.qpos
        moment = 9.81 * body.mass * np.linalg.norm(np.cross(body.joints[0].axis, body.center_of_mass))
        for _ in range(n):
            angle = self._data.qpos[0]
            self._data.qfrc_applied[0] = moment * (np.sin(angle) - angle)
            super().step(1)


WRONG = (
    Wrong(
        "springs are 1e-4 too stiff", "spring", stiff(1e-4),
        (
            Sight(
                CHAIN, SE,
                OWN | MODES | TWIN
                | {"truth position", "truth position, limit", "truth velocity, limit", EQUATIONS},
                "truth position, scheme's own", "only round-off is allowed",
                near=ENERGY | {"truth velocity"},
            ),
        ), 1e-4, of_size=stiff,
        located=r"spring stiffness of all joints is 0\.01 % high",
    ),
    Wrong(
        "a pendulum is pulled back by its angle, not the sine", "pendulum", Linearised,
        (Sight(PENDULUM, SE, {"truth orientation", "invariant energy"}, near=None, beside=False),),
        located=r"is linear in its angle, in place of the sine$",
    ),
)  # fmt: skip
