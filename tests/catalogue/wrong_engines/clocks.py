"""States of another time, and steps of another length."""

from poinsot.adapters.mujoco_ import MuJoCo

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
    TURNING,
    TWIN,
    Lying,
    Sight,
    Wrong,
    state,
)  # fmt: skip


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
        (Sight(CHAIN, SE, {"truth velocity, scheme's own"}, near=None, beside=False),),
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
)  # fmt: skip
