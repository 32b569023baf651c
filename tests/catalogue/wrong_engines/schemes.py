"""Schemes other than they say, and numbers of fewer digits."""

from dataclasses import replace

import numpy as np
from poinsot.adapters.mujoco_ import MuJoCo
from poinsot.adapters.pinocchio_ import Pinocchio
from poinsot.adapters.pinocchio_schemes import semi_implicit_euler

from .entry import (
    ENERGY,
    FREE,
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
    state,
)  # fmt: skip


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
)  # fmt: skip
