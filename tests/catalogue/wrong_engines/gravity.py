"""Gravity of another size or sign."""

from dataclasses import replace
from math import cos, sin

from poinsot.adapters.mujoco_ import MuJoCo

from .entry import (
    ENERGY,
    EQUATIONS,
    LIMITS,
    RATES,
    RK,
    SE,
    TOP,
    TURNING,
    TWIN,
    Family,
    Feigning,
    Lying,
    Sight,
    Wrong,
    alone,
    building,
)


class WeakGravity(MuJoCo):
    def build(self, scene, scheme, dt):
        super().build(replace(scene, gravity=(0.0, 0.0, -9.80)), scheme, dt)


class LyingWeakGravity(Lying, WeakGravity):
    pass


def times(factor, lie=Lying):
    """Gravity multiplied by ``factor``."""
    return building(
        lambda scene: replace(scene, gravity=tuple(g * factor for g in scene.gravity)), MuJoCo, lie
    )


def leaning(angle):
    """Gravity that leans by this angle [rad]."""

    def leaned(scene):
        x, y, z = scene.gravity
        return replace(scene, gravity=(x - z * sin(angle), y, z * cos(angle)))

    return building(leaned, MuJoCo)


class StandardGravity(Lying, MuJoCo):
    def mistaken(self, scene):
        return replace(scene, gravity=(0.0, 0.0, -9.80665))


class OffByABillionth(Lying, MuJoCo):
    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        self._model.opt.gravity *= 1 + 1e-9


LIMIT = "truth orientation, limit"
HIGH = Family("gravity", lambda size: times(1 + size), alone(TOP, SE, EQUATIONS, LIMIT))
FEIGNED = Family("gravity, in the run alone", lambda size: times(1 + size, Feigning), alone(TOP, SE, LIMIT))
LEANING = Family("direction of gravity [rad]", leaning, alone(TOP, SE, EQUATIONS, LIMIT))
WRONG = (
    Wrong(
        "gravity is 9.80, and read back so", "gravity", WeakGravity,
        (
            Sight(
                TOP, RK, TURNING | RATES | ENERGY | TWIN | {"setup gravity", EQUATIONS}, "setup gravity",
                r"gravity: the engine has \[0.0, 0.0, -9.8\], the scene asks for \(0.0, 0.0, -9.81\)",
            ),
        ), 1e-3,
        located=r"^gravity is 9\.8 m/s², not 9\.81$",
    ),
    Wrong(
        "gravity is 9.80", "gravity", LyingWeakGravity,
        (
            Sight(
                TOP, RK, TURNING | RATES | ENERGY | TWIN | {EQUATIONS}, "truth orientation, limit",
                "limit at dt = 0 from the truth; the finest step alone is at 5.29e-03",
            ),
            Sight(
                TOP, SE, {"truth orientation", "truth omega", EQUATIONS} | LIMITS | RATES | TWIN,
                "truth precession", "difference from the exact rate",
                near=ENERGY | {"order orientation", "order omega"},
            ),
        ), 1e-3,
        located=r"^gravity is 9\.8 m/s², not 9\.81$",
    ),
    Wrong(
        "gravity is 9.80665", "gravity", StandardGravity,
        (alone(TOP, SE, EQUATIONS, LIMIT),), 3.4e-4,
        located=r"^gravity is 9\.80665 m/s²",
    ),
    Wrong(
        "gravity points up", "gravity", times(-1),
        (alone(TOP, SE, EQUATIONS, "truth omega", "truth precession"),),
        located=r"^gravity has the wrong sign$",
    ),
    *HIGH.sizes("gravity", {1e-6: ("gravity is 1e-6 high", r"^gravity is 9\.81000981 m/s²")}),
    *FEIGNED.sizes(
        "gravity",
        {
            1e-4: ("gravity is 1e-4 high in the run alone", r"^gravity is 9\.810981 m/s²"),
            1e-6: ("gravity is 1e-6 high in the run alone", r"^gravity is 9\.81000981 m/s²"),
        },
    ),
    *LEANING.sizes("gravity", {1e-6: ("gravity leans by 1e-6 rad", "^gravity leans by 1e-06 rad along x$")}),
    Wrong(
        "gravity is 1e-9 high", "gravity", OffByABillionth,
        (Sight(TOP, SE, LIMITS | TWIN | {EQUATIONS}, "twin state", "from its twin .* in orientation"),), 1e-9,
        located=r"^gravity is 9\.81000001 m/s²",
    ),
)  # fmt: skip
