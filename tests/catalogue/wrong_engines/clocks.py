"""States of another time, and steps of another length."""

import numpy as np
from poinsot.adapters.engine import State
from poinsot.adapters.mujoco_ import MuJoCo
from poinsot.adapters.pinocchio_ import Pinocchio

from .entry import (
    CHAIN,
    ENERGY,
    MODES,
    OWN,
    P_ALPHA,
    RATES,
    RK,
    SE,
    TOP,
    TUMBLING,
    TURNING,
    TWIN,
    Family,
    Lying,
    Sight,
    Wrong,
    alone,
    state,
)


class OneSampleLate(MuJoCo):
    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        self._late = super().state()

    def step(self, n):
        self._late = super().state()
        super().step(n)

    def state(self):
        return self._late


class OneStepLate(MuJoCo):
    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        self._late = super().state()

    def step(self, n):
        super().step(n - 1)
        self._late = super().state()
        super().step(1)

    def state(self):
        return self._late


class HalfAStepLate(Lying, MuJoCo):
    """Tells velocities of the middle of the last step, as a leapfrog scheme keeps them.

    That is within a first-order scheme's own error, at every step: where that error is only bounded, and
    not predicted, it takes a twin to see it.
    """

    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        self._before = self._data.qvel.copy()

    def step(self, n):
        super().step(n - 1)
        self._before = self._data.qvel.copy()
        super().step(1)

    def state(self):
        now = self._data.qvel.copy()
        self._data.qvel[:] = (self._before + now) / 2
        found = super().state()
        self._data.qvel[:] = now
        return found


class TwiceTheStep(MuJoCo):
    def build(self, scene, scheme, dt):
        super().build(scene, scheme, 2 * dt)


class HalfTheSteps(Lying, MuJoCo):
    """Takes one step of 2 dt for every two it is asked for."""

    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        self._model.opt.timestep, self._owed, self._steps = 2 * dt, 0, 0

    def step(self, n):
        self._owed += n
        super().step(self._owed // 2)
        self._owed %= 2


class OneStepEarly(Lying, MuJoCo):
    """Has taken a step before the first is asked for."""

    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        super().step(1)


def slow(size, lie=Lying):
    """Steps longer than asked for by a part of themselves."""

    class Longer(lie, MuJoCo):
        def build(self, scene, scheme, dt):
            super().build(scene, scheme, dt)
            self._model.opt.timestep *= 1 + size

    return Longer


class StepOfItsOwn(Lying, MuJoCo):
    """Takes the step that it likes, whichever was asked for: as many as make the same time."""

    def build(self, scene, scheme, dt):
        self._asked_dt = dt
        super().build(scene, scheme, dt)
        self._model.opt.timestep = self._own = scene.duration / scene.samples / 100

    def step(self, n):
        super().step(round(n * self._asked_dt / self._own))


def coarse(steps):
    """Steps ``steps`` times as long, between which it draws straight lines to the times of the samples."""

    class Coarse(Lying, Pinocchio):
        def build(self, scene, scheme, dt):
            super().build(scene, scheme, steps * dt)
            self._asked = scene, dt
            self._now, self._last, self._next = 0, super().state(), super().state()

        def step(self, n):
            self._now += n
            while self._now > steps * self._steps:
                self._last = self._next
                super().step(1)
                self._next = super().state()

        def state(self):
            part = self._now / steps - self._steps + 1
            mixed = [(1 - part) * a + part * b for a, b in zip(self._last, self._next, strict=True)]
            found = State(*mixed) if self._steps else self._next
            norm = np.linalg.norm(found.quaternion, axis=1, keepdims=True)
            return found._replace(quaternion=found.quaternion / norm)

    return Coarse


STEP = Family("step, in the run alone", slow, alone(TOP, SE, "truth orientation, limit"))
WRONG = (
    Wrong(
        "state is one sample late", "time", OneSampleLate,
        (
            Sight(
                TOP, SE, TURNING | {"truth precession"} | TWIN,
                "order orientation", "fitted order -?0.0.* declared 1",
            ),
        ),
        located=r"^state is one sample late$",
    ),
    Wrong(
        "state is one step late", "time", OneStepLate,
        (
            Sight(TOP, RK, TURNING | RATES | TWIN, "order omega", "fitted order 1.00.* declared 4"),
            Sight(TOP, SE, TWIN, "twin state", "from its twin .* in orientation"),
        ),
        located=r"^state is one step late",
    ),
    Wrong(
        "velocity is half a step late", "time", HalfAStepLate,
        (
            alone(CHAIN, SE, "truth velocity, scheme's own"),
        ),
        located=r"^velocities are told half a step late$",
    ),
    Wrong(
        "step is twice as large, and read back so", "time", TwiceTheStep,
        (
            Sight(
                TOP, SE, TURNING | RATES | ENERGY | P_ALPHA | TWIN | {"setup dt"},
                "setup dt", "dt: the engine has 0.004, the scene asks for 0.002",
            ),
        ),
        located=r"^step is twice the stated one",
    ),
    Wrong(
        "one step of 2 dt is taken for every two", "time", HalfTheSteps,
        (
            Sight(
                CHAIN, SE, OWN | MODES | ENERGY | TWIN | {"truth position", "truth velocity"},
                "truth velocity, scheme's own", "scheme's own exact motion; only round-off is allowed",
                near=state("position", "velocity") - {"truth position", "truth velocity"},
            ),
        ),
        located=r"^step is twice the stated one, and one is taken for 2$",
    ),
    Wrong(
        "state is one step early", "time", OneStepEarly,
        (
            alone(TOP, RK, "order omega", says="fitted order 1.* declared 4"),
            alone(CHAIN, SE, "truth position, scheme's own"),
        ),
        located=r"^state is one step early$",
    ),
    *STEP.sizes(
        "time",
        {
            1e-4: ("steps are 1e-4 too long", r"^step is 1\.0001 times the stated one"),
            1e-6: ("steps are 1e-6 too long", r"^step is 1\.000001 times the stated one"),
        },
    ),
    Wrong(
        "the step asked for is never taken", "time", StepOfItsOwn,
        (alone(TOP, SE, "order orientation", says="fitted order -?0.0.* declared 1"),),
        located=r"^step is a part of the stated one, 1/10, and 10 are taken for each$",
    ),
    Wrong(
        "samples lie on lines between coarse steps of Euler", "time", coarse(8),
        (alone(TOP, SE, "truth omega"),),
    ),
    Wrong(
        "samples lie on lines between coarse steps of RK4", "time", coarse(3),
        (alone(TUMBLING, RK, "order omega", says="fitted order [12].* declared 4"),),
        located=r"^angular velocity is interpolated between coarser steps",
    ),
)  # fmt: skip
