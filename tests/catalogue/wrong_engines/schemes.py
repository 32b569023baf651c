"""Schemes other than they say, and numbers of fewer digits."""

from dataclasses import replace

import numpy as np
from poinsot.adapters.mujoco_ import MuJoCo
from poinsot.adapters.pinocchio_ import Pinocchio
from poinsot.adapters.pinocchio_schemes import rkmk4, semi_implicit_euler

from .entry import (
    CHAIN,
    ENERGY,
    FREE,
    IMPLICIT,
    LIMITS,
    MOMENTUM,
    P_ALPHA,
    RATES,
    RK,
    SE,
    TOP,
    TURNING,
    TWIN,
    Sight,
    Wrong,
    alone,
    state,
)


class NaiveRK4(Pinocchio):
    """Averages the body velocities of its stages as if their axes were the same."""

    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        self._mechanism = replace(self._mechanism, balls=())


class EulerCalledRK4(Pinocchio):
    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        self._advance = semi_implicit_euler


class SinglePrecision(MuJoCo):
    def step(self, n):
        for _ in range(n):
            super().step(1)
            self._data.qvel[:] = self._data.qvel.astype(np.float32)


class AllInSinglePrecision(SinglePrecision):
    def step(self, n):
        for _ in range(n):
            super().step(1)
            self._data.qpos[:] = self._data.qpos.astype(np.float32)


class RK4CalledEuler(Pinocchio):
    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        self._advance = rkmk4


class OtherFirstOrder(MuJoCo):
    """Takes the gyroscopic term implicitly under the name of a scheme that does not: of the same order."""

    def build(self, scene, scheme, dt):
        super().build(scene, next(s for s in self.schemes if s.twin == IMPLICIT), dt)


class OneWeightWrong(Pinocchio):
    """Runge-Kutta with the weights 1, 1, 1, 1 over 4 in place of 1, 2, 2, 1 over 6."""

    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)

        def even(system, q, v, dt, n):
            for _ in range(n):
                a = [system.accelerate(q, v, system.force(q, v))]
                rates = [v]
                for reach in (dt / 2, dt / 2, dt):
                    x, w = system.integrate(q, reach * rates[-1]), v + reach * a[-1]
                    a.append(system.accelerate(x, w, system.force(x, w)))
                    rates.append(w)
                q, v = system.integrate(q, dt * sum(rates) / 4), v + dt * sum(a) / 4
            return q, v

        self._advance = even


WRONG = (
    Wrong(
        "RK4 averages body velocities of different axes", "scheme", NaiveRK4,
        (
            Sight(
                FREE, RK, state("orientation") | MOMENTUM | TWIN,
                "order orientation", "fitted order 2.00. ± 0.00. over 5 steps .*, declared 4",
            ),
        ),
        located=r"^orientation is integrated to order 2 only",
    ),
    Wrong(
        "Euler is called RK4", "scheme", EulerCalledRK4,
        (
            Sight(
                TOP, RK, TURNING | RATES | ENERGY | P_ALPHA | TWIN,
                "order orientation", "fitted order 1.01. ± 0.00. over 5 steps .*, declared 4",
            ),
        ),
        located=r"^steps are those of semi-implicit Euler, not of RKMK4",
    ),
    Wrong(
        "velocities are kept in 32 bits", "precision", SinglePrecision,
        (Sight(TOP, SE, LIMITS | TWIN, "truth omega, limit", "limit at dt = 0 from the truth"),),
        located=r"^angular velocity is kept in single precision$",
    ),
    Wrong(
        "coordinates and velocities are kept in 32 bits", "precision", AllInSinglePrecision,
        (alone(TOP, SE, "truth omega, limit"),),
        located=r"is kept in single precision$",
    ),
    Wrong(
        "RK4 is called Euler", "scheme", RK4CalledEuler,
        (alone(CHAIN, SE, "order position", "truth position, scheme's own", says="declared 1"),),
        located=r"^steps are those of Runge and Kutta, not of semi-implicit Euler$",
    ),
    Wrong(
        "another first-order scheme than it says", "scheme", OtherFirstOrder,
        (Sight(FREE, SE, TWIN, "twin state", "from its twin", near=ENERGY | MOMENTUM),),
        located=r"^gyroscopic term is taken at the end of the step, not as semi-implicit Euler does$",
    ),
    Wrong(
        "RK4 weighs its stages alike", "scheme", OneWeightWrong,
        (alone(CHAIN, RK, "order position", says="fitted order 2.* declared 4"),),
    ),
)  # fmt: skip
