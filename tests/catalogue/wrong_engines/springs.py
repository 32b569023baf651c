"""Springs, and what pulls a pendulum back."""

from dataclasses import replace

import numpy as np
from poinsot.adapters.mujoco_ import MuJoCo
from poinsot.adapters.pinocchio_ import Pinocchio

from .entry import (
    CHAIN,
    ENERGY,
    EQUATIONS,
    MODES,
    OWN,
    PENDULUM,
    RK,
    SE,
    TWIN,
    Family,
    Feigning,
    Lying,
    Sight,
    Wrong,
    alone,
    building,
)


def stiff(size, lie=Lying):
    """Springs too stiff by a part of what was asked for."""

    class StiffSpring(lie, MuJoCo):
        def build(self, scene, scheme, dt):
            super().build(scene, scheme, dt)
            self._model.jnt_stiffness *= 1 + size

    return StiffSpring


def longer(length):
    """Springs at rest when they are longer by this [m]."""

    class Longer(Lying, MuJoCo):
        def build(self, scene, scheme, dt):
            super().build(scene, scheme, dt)
            self._model.qpos_spring += length

    return Longer


def attracting(size):
    """Attraction stronger by a part of itself."""

    def stronger(scene):
        (force,) = scene.forces
        return replace(scene, forces=(replace(force, G=force.G * (1 + size)),))

    return building(stronger, MuJoCo)


class HeldForce(Pinocchio):
    """Takes forces from outside once a step, and not at every stage of it."""

    def _take(self, n):
        known = self._mechanism
        for _ in range(n):
            held = known.force(self._position, self._velocity).copy()
            self._mechanism = replace(known, force=lambda q, v, held=held: held)
            super()._take(1)
        self._mechanism = known


class Linearised(Lying, MuJoCo):
    """Its pendulum is pulled back by the angle in place of its sine."""

    def step(self, n):
        body, (angle,) = self._scene.bodies[0], self._data.qpos
        moment = 9.81 * body.mass * np.linalg.norm(np.cross(body.joints[0].axis, body.center_of_mass))
        for _ in range(n):
            angle = self._data.qpos[0]
            self._data.qfrc_applied[0] = moment * (np.sin(angle) - angle)
            super().step(1)


OWN_PLACE, ORBIT = "truth position, scheme's own", "two_body[kepler e=0.1]"
STIFFNESS = Family("stiffness", stiff, alone(CHAIN, SE, EQUATIONS, OWN_PLACE))
FEIGNED = Family(
    "stiffness, in the run alone", lambda size: stiff(size, Feigning), alone(CHAIN, SE, OWN_PLACE)
)
REST = Family("rest length of springs [m]", longer, alone(CHAIN, SE, EQUATIONS, OWN_PLACE))
ATTRACTION = Family("attraction", attracting, alone(ORBIT, RK, EQUATIONS, "truth position, limit"))
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
        ), 1e-4,
        located=r"spring stiffness of all joints is 0\.01 % high",
    ),
    Wrong(
        "a pendulum is pulled back by its angle, not the sine", "pendulum", Linearised,
        (alone(PENDULUM, SE, "truth orientation", "invariant energy"),),
        located=r"is linear in its angle, in place of the sine$",
    ),
    *STIFFNESS.sizes(
        "spring", {1e-6: ("springs are 1e-6 too stiff", r"stiffness of all joints is 0\.0001 % high")}
    ),
    *FEIGNED.sizes(
        "spring",
        {1e-6: ("springs are 1e-6 too stiff in the run alone", r"stiffness of all joints is 0\.0001 % high")},
    ),
    *REST.sizes(
        "spring",
        {
            1e-4: (
                "springs rest at a length 1e-4 m too large",
                r"^rest positions of the springs of all joints are off by 0\.0001$",
            )
        },
    ),
    *ATTRACTION.sizes(
        "force", {1e-6: ("attraction is 1e-6 too strong", r"G of the Attraction force is 0\.0001 % high")}
    ),
    Wrong(
        "force from outside is held over a step", "force", HeldForce,
        (alone(ORBIT, RK, "order position", says=r"fitted order (0\.9|1\.0).* declared 4"),),
    ),
)  # fmt: skip
