"""Gravity of another size or sign."""

from dataclasses import replace

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
    Lying,
    Sight,
    Wrong,
)  # fmt: skip


class WeakGravity(MuJoCo):
    def build(self, scene, scheme, dt):
        super().build(replace(scene, gravity=(0.0, 0.0, -9.80)), scheme, dt)


class LyingWeakGravity(Lying, WeakGravity):
    pass


def times(factor):
    """Gravity multiplied by ``factor``."""

    class Times(Lying, MuJoCo):
        def mistaken(self, scene):
            return replace(scene, gravity=tuple(g * factor for g in scene.gravity))

    return Times


class StandardGravity(Lying, MuJoCo):
    def mistaken(self, scene):
        return replace(scene, gravity=(0.0, 0.0, -9.80665))


class OffByABillionth(Lying, MuJoCo):
    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        self._model.opt.gravity *= 1 + 1e-9


def more(size):
    """Gravity high by a part of itself."""
    return times(1 + size)


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
        (Sight(TOP, SE, {EQUATIONS, "truth orientation, limit"}, near=None, beside=False),), 3.4e-4,
        located=r"^gravity is 9\.80665 m/s²",
    ),
    Wrong(
        "gravity points up", "gravity", times(-1),
        (Sight(TOP, SE, {EQUATIONS, "truth omega", "truth precession"}, near=None, beside=False),),
        located=r"^gravity has the wrong sign$",
    ),
    Wrong(
        "gravity is 1e-6 high", "gravity", more(1e-6),
        (Sight(TOP, SE, {EQUATIONS, "truth orientation, limit"}, near=None, beside=False),), 1e-6,
        of_size=more,
        located=r"^gravity is 9\.81000981 m/s²",
    ),
    Wrong(
        "gravity is 1e-9 high", "gravity", OffByABillionth,
        (Sight(TOP, SE, LIMITS | TWIN | {EQUATIONS}, "twin state", "from its twin .* in orientation"),), 1e-9,
        located=r"^gravity is 9\.81000001 m/s²",
    ),
)  # fmt: skip
