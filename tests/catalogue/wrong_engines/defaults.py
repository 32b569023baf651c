"""What PyBullet does unless it is told not to: damping, and a clamp on velocities."""

import numpy as np
from poinsot.adapters import pybullet_
from poinsot.adapters.mujoco_ import MuJoCo
from poinsot.adapters.pybullet_ import PyBullet

from .entry import (
    ENERGY,
    EQUATIONS,
    FAST,
    FREE,
    MOMENTUM,
    P_ALPHA,
    P_GAMMA,
    PENDULUM,
    RATES,
    SE,
    SPIN,
    TUMBLING,
    TURNING,
    TWIN,
    Family,
    Lying,
    Sight,
    Wrong,
    alone,
)


class ByDefault(PyBullet):
    """With one setting left or put otherwise, in the run and in the copy that is probed."""

    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        self._undo(self._world)

    def _loaded(self, scene):
        world = super()._loaded(scene)
        self._undo(world)
        return world

    def _undo(self, world):
        pybullet_.p.changeDynamics(0, -1, physicsClientId=world.client, **dict([self.default]))


class Damped(ByDefault):
    default = ("angularDamping", 0.04)


class LyingDamped(Lying, Damped):
    pass


class Clamped(ByDefault):
    default = ("maxJointVelocity", 100)


class LyingClamped(Lying, Clamped):
    pass


class LinearlyDamped(Lying, ByDefault):
    default = ("linearDamping", 0.04)


def damped(rate):
    """An angular damping of ``rate`` [1/s]: not in the copy, so that accelerations show none of it."""

    class SlightlyDamped(Lying, PyBullet):
        def build(self, scene, scheme, dt):
            super().build(scene, scheme, dt)
            pybullet_.p.changeDynamics(0, -1, angularDamping=rate, physicsClientId=self._world.client)

    return SlightlyDamped


def dragging(damping):
    """A damper [N m s/rad] in each hinge that none was asked for in."""

    class Dragging(Lying, MuJoCo):
        def build(self, scene, scheme, dt):
            super().build(scene, scheme, dt)
            self._model.dof_damping += damping

    return Dragging


def friction_loss(moment):
    """A dry friction [N m] in each hinge."""

    class Dry(Lying, MuJoCo):
        def step(self, n):
            for _ in range(n):
                self._data.qfrc_applied[:] = -moment * np.sign(self._data.qvel)
                super().step(1)

    return Dry


DAMPING = Family(
    "angular damping [1/s], in the run alone", damped,
    alone(TUMBLING, SE, "truth orientation, limit", "truth omega, limit"),
)  # fmt: skip
DAMPER = Family(
    "damper in a hinge [N m s/rad]", dragging, alone(PENDULUM, SE, EQUATIONS, "truth orientation, limit")
)
DRY = Family("dry friction in a hinge [N m]", friction_loss, alone(PENDULUM, SE, "truth orientation, limit"))
WRONG = (
    Wrong(
        "angular damping is 0.04 /s, and probed so", "damping", Damped,
        (
            Sight(
                FREE, SE,
                TURNING | SPIN | ENERGY | MOMENTUM | TWIN | {"setup angular_damping", EQUATIONS},
                "setup angular_damping", "has 0.04.*, inferred from a probe run, the scene asks for 0.0",
            ),
        ), 0.04,
        located=r"^angular damping ≈ 0\.04 /s$",
    ),
    Wrong(
        "angular damping is 0.04 /s", "damping", LyingDamped,
        (
            Sight(
                FREE, SE, TURNING | SPIN | ENERGY | MOMENTUM | TWIN | {EQUATIONS},
                "invariant energy", "change from the exact value at the start",
            ),
        ), 0.04,
        located=r"^angular damping ≈ 0\.04 /s$",
    ),
    Wrong(
        "velocities are clamped at 100, and probed so", "clamp", Clamped,
        (
            Sight(
                FAST, SE,
                TURNING | RATES | ENERGY | P_ALPHA | P_GAMMA | TWIN | {"setup velocity_limit", EQUATIONS},
                "setup velocity_limit", "has 100.0, inferred from a probe run, the scene asks for inf",
            ),
        ),
        located=r"^angular velocity is clamped at 100 rad/s$",
    ),
    Wrong(
        "velocities are clamped at 100", "clamp", LyingClamped,
        (
            Sight(
                FAST, SE, TURNING | RATES | ENERGY | P_ALPHA | P_GAMMA | TWIN | {EQUATIONS},
                "invariant p_gamma", "change from the exact value at the start",
            ),
        ),
        located=r"^angular velocity is clamped at 100 rad/s$",
    ),
    *DAMPING.sizes(
        "damping",
        {
            1e-4: ("angular damping is 1e-4 /s in the run alone", r"^angular damping ≈ 0\.0001 /s$"),
            1e-6: ("angular damping is 1e-6 /s in the run alone", r"^angular damping ≈ 1e-06 /s$"),
        },
    ),
    Wrong(
        "linear damping is 0.04 /s", "damping", LinearlyDamped,
        (alone(FREE, SE, EQUATIONS, "truth position", "invariant momentum"),), 0.04,
        located=r"^linear damping ≈ 0\.04 /s$",
    ),
    *DAMPER.sizes(
        "damping",
        {1e-6: ("a hinge is damped by 1e-6 N m s/rad", "joint 'hinge' is damped by 1e-06 N m s")},
    ),
    *DRY.sizes(
        "damping",
        {1e-6: ("a hinge has a dry friction of 1e-6 N m", "^joint 'hinge' has a dry friction of 1e-06 N m$")},
    ),
)  # fmt: skip
