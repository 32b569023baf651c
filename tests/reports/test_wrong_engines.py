"""Engines that are wrong in one known way, a few lines around a real one: each turns the right checks red.

Which checks stay green matters as much: together they tell what is wrong. Engines that lie repeat
in their readback what the scene asked for, so that only their motion gives them away.
"""

import re
from collections.abc import Collection
from dataclasses import replace
from functools import cache
from typing import NamedTuple

import numpy as np
import pytest

pytest.importorskip("mujoco")
pytest.importorskip("pinocchio")
pytest.importorskip("pybullet")

from poinsot.adapters import pybullet_
from poinsot.adapters.engine import Setup, State
from poinsot.adapters.mujoco_ import MuJoCo
from poinsot.adapters.pinocchio_ import Pinocchio, pin
from poinsot.adapters.pinocchio_schemes import semi_implicit_euler
from poinsot.adapters.pybullet_ import PyBullet
from poinsot.adapters.simulate import simulate, unsupported
from poinsot.reference import quaternions
from poinsot.reports import setup
from poinsot.reports.judge import judge
from poinsot.reports.verdict import Status
from poinsot.scenarios.body import diagonal
from poinsot.scenarios.registry import scenes

RIGHT = (MuJoCo, Pinocchio, PyBullet)
SE, RK = "semi-implicit Euler", "RKMK4"
TOP, FAST = "heavy_top[moderate]", "heavy_top[fast]"
FREE, CHAIN = "free_symmetric_top[oblate]", "co2_chain[mixture]"


class Lying:
    """Repeats what was asked for, whatever was built."""

    def build(self, scene, scheme, dt):
        self._asked = scene, dt
        super().build(scene, scheme, dt)

    def readback(self):
        return Setup(setup.expected(*self._asked))


class WeakGravity(MuJoCo):
    def build(self, scene, scheme, dt):
        super().build(replace(scene, gravity=(0.0, 0.0, -9.80)), scheme, dt)


class LyingWeakGravity(Lying, WeakGravity):
    pass


class LargeMoment(Pinocchio):
    def build(self, scene, scheme, dt):
        body = scene.bodies[0]
        I1, I2, I3 = np.diag(body.inertia_array)
        larger = replace(body, inertia=diagonal(I1 * 1.001, I2, I3))
        super().build(replace(scene, bodies=(larger,)), scheme, dt)


class LyingLargeMoment(Lying, LargeMoment):
    pass


class NoGyroscopicTerm(Pinocchio):
    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        model, data = self._model, self._data

        def cancelling(q, v):
            return pin.nle(model, data, q, v) - pin.computeGeneralizedGravity(model, data, q)

        self._mechanism = replace(self._mechanism, force=cancelling)


class ScalarFirst(MuJoCo):
    def state(self):
        state = super().state()
        return state._replace(quaternion=np.roll(state.quaternion, 1, axis=1))


class Conjugated(MuJoCo):
    def state(self):
        state = super().state()
        return state._replace(quaternion=quaternions.conjugate(state.quaternion))


class WorldOmega(MuJoCo):
    def state(self):
        state = super().state()
        return state._replace(omega=quaternions.rotated(state.quaternion, state.omega))


class ByDefault(PyBullet):
    """With something that PyBullet does unless it is told not to."""

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


class NaiveRK4(Pinocchio):
    """Averages the body velocities of its stages as if their axes were the same."""

    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        self._mechanism = replace(self._mechanism, balls=())


class EulerCalledRK4(Pinocchio):
    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        self._advance = semi_implicit_euler


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


class Undecided(MuJoCo):
    """The last bit of a velocity is another in every second run."""

    runs = 0

    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        self.runs += 1

    def state(self):
        state = super().state()
        return state._replace(omega=np.nextafter(state.omega, np.inf)) if self.runs % 2 else state


class OffByABillionth(Lying, MuJoCo):
    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        self._model.opt.gravity *= 1 + 1e-9


class FrameNotCentre(MuJoCo):
    def state(self):
        return super().state()._replace(position=self._scratch.xpos[self._bodies])


class SinglePrecision(MuJoCo):
    def step(self, n):
        for _ in range(n):
            super().step(1)
            self._data.qvel[:] = self._data.qvel.astype(np.float32)


class StiffSpring(Lying, MuJoCo):
    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        self._model.jnt_stiffness *= 1 + 1e-4


class Echo(Lying, MuJoCo):
    """Hands out the exact motion."""

    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        self._exact, self._stride = scene.truth(scene, scene.sample_times()), scene.steps_per_sample(dt)

    def step(self, n):
        self._steps += n

    def state(self):
        return State(*(getattr(self._exact, name)[self._steps // self._stride] for name in State._fields))


class StuckInPlace(MuJoCo):
    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        self._start = super().state().position

    def state(self):
        return super().state()._replace(position=self._start)


class JointsOfLastSample(MuJoCo):
    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        self._old = super().state().joint_velocity

    def step(self, n):
        self._old = super().state().joint_velocity
        super().step(n)

    def state(self):
        return super().state()._replace(joint_velocity=self._old)


class Turned(MuJoCo):
    def state(self):
        return super().state()._replace(quaternion=np.tile([0, 0, 0.6, 0.8], (3, 1)))


class Sleepy(MuJoCo):
    """Falls asleep half way."""

    def step(self, n):
        if self._steps * self._model.opt.timestep < self._scene.duration / 2:
            super().step(n)
        else:
            self._steps += n
            self._data.time += n * self._model.opt.timestep


class Wrong(NamedTuple):
    """An engine, where it is run, the checks that it fails, and what one of them says.

    The checks ``near`` their limit may fail or pass; all others must pass.
    """

    engine: type
    scene: str
    twin: str
    red: Collection[str]
    check: str
    says: str
    near: Collection[str] = ()

    @property
    def name(self):
        return f"{self.engine.__name__} in {self.scene}, {self.twin}"


def state(*names):
    """All that looks at these parts of the state."""
    return {kind.format(name) for name in names for kind in ("truth {}", "order {}", "truth {}, limit")}


LIMITS = {"truth orientation, limit", "truth omega, limit"}
TURNING, RATES = state("orientation", "omega"), {"truth precession", "truth nutation"}
ENERGY, MOMENTUM, TWIN = {"invariant energy"}, {"invariant angular momentum"}, {"twin state"}
P_ALPHA, P_GAMMA, SPIN = {"invariant p_alpha"}, {"invariant p_gamma"}, {"truth Omega_b"}
MODES = {f"truth frequency of the {mode} mode" for mode in ("symmetric", "antisymmetric")}
OWN = {"truth position, scheme's own", "truth velocity, scheme's own"}

WRONG = (
    Wrong(
        WeakGravity, TOP, RK, TURNING | RATES | ENERGY | TWIN | {"setup gravity"}, "setup gravity",
        r"gravity: the engine has \[0.0, 0.0, -9.8\], the scene asks for \(0.0, 0.0, -9.81\)",
    ),
    Wrong(
        LyingWeakGravity, TOP, RK, TURNING | RATES | ENERGY | TWIN, "truth orientation, limit",
        "limit at dt = 0 from the truth; the finest step alone is at 5.29e-03",
    ),
    Wrong(
        LyingWeakGravity, TOP, SE, {"truth orientation", "truth omega"} | LIMITS | RATES | TWIN,
        "truth precession", "difference from the exact rate",
        near=ENERGY | {"order orientation", "order omega"},
    ),
    Wrong(
        LargeMoment, FREE, RK, TURNING | SPIN | ENERGY | MOMENTUM | TWIN | {"setup body/top/inertia"},
        "setup body/top/inertia", r"the engine has \[\[0.01001, .*, the scene asks for \(\(0.01, ",
    ),
    Wrong(
        LyingLargeMoment, FREE, RK, TURNING | SPIN | ENERGY | MOMENTUM | TWIN,
        "truth Omega_b", "difference from the exact rate",
    ),
    Wrong(
        LyingLargeMoment, FREE, SE, LIMITS | SPIN | TWIN,
        "truth orientation, limit", "limit at dt = 0 from the truth", near={"truth omega"},
    ),
    Wrong(
        NoGyroscopicTerm, FREE, SE, TURNING | SPIN | MOMENTUM | TWIN,
        "truth Omega_b", "difference from the exact rate",
    ),
    Wrong(
        ScalarFirst, FREE, RK, state("orientation") | MOMENTUM | TWIN,
        "twin state", "from its twin .* in orientation",
    ),
    Wrong(
        ScalarFirst, TOP, SE, state("orientation") | P_ALPHA | TWIN,
        "truth orientation", "distance from the exact motion",
    ),
    Wrong(
        Conjugated, FREE, RK, state("orientation") | MOMENTUM | TWIN,
        "truth orientation", "distance from the exact motion",
    ),
    Wrong(
        WorldOmega, TOP, RK, state("omega") | ENERGY | P_ALPHA | P_GAMMA | TWIN,
        "twin state", "from its twin .* in omega",
    ),
    Wrong(
        Damped, FREE, SE, TURNING | SPIN | ENERGY | MOMENTUM | TWIN | {"setup angular_damping"},
        "setup angular_damping", "has 0.04.*, inferred from a probe run, the scene asks for 0.0",
    ),
    Wrong(
        LyingDamped, FREE, SE, TURNING | SPIN | ENERGY | MOMENTUM | TWIN,
        "invariant energy", "change from the exact value at the start",
    ),
    Wrong(
        Clamped, FAST, SE, TURNING | RATES | ENERGY | P_ALPHA | P_GAMMA | TWIN | {"setup velocity_limit"},
        "setup velocity_limit", "has 100.0, inferred from a probe run, the scene asks for inf",
    ),
    Wrong(
        LyingClamped, FAST, SE, TURNING | RATES | ENERGY | P_ALPHA | P_GAMMA | TWIN,
        "invariant p_gamma", "change from the exact value at the start",
    ),
    Wrong(
        NaiveRK4, FREE, RK, state("orientation") | MOMENTUM | TWIN,
        "order orientation", "fitted order 2.00. ± 0.00. over 5 steps .*, declared 4",
    ),
    Wrong(
        EulerCalledRK4, TOP, RK, TURNING | RATES | ENERGY | P_ALPHA | TWIN,
        "order orientation", "fitted order 1.01. ± 0.00. over 5 steps .*, declared 4",
    ),
    Wrong(
        OneSampleLate, TOP, SE, TURNING | {"truth precession"} | TWIN,
        "order orientation", "fitted order -?0.0.* declared 1",
    ),
    Wrong(OneStepLate, TOP, RK, TURNING | RATES | TWIN, "order omega", "fitted order 1.00.* declared 4"),
    Wrong(OneStepLate, TOP, SE, TWIN, "twin state", "from its twin .* in orientation"),
    Wrong(
        TwiceTheStep, TOP, SE, TURNING | RATES | ENERGY | P_ALPHA | TWIN | {"setup dt"},
        "setup dt", "dt: the engine has 0.004, the scene asks for 0.002",
    ),
    Wrong(
        HalfTheSteps, CHAIN, SE, OWN | MODES | ENERGY | TWIN | {"truth position", "truth velocity"},
        "truth velocity, scheme's own", "scheme's own exact motion; only round-off is allowed",
        near=state("position", "velocity") - {"truth position", "truth velocity"},
    ),
    Wrong(
        Undecided, TOP, SE, {"determinism state"}, "determinism state", "2 runs gave 2 different motions"
    ),
    Wrong(OffByABillionth, TOP, SE, LIMITS | TWIN, "twin state", "from its twin .* in orientation"),
    Wrong(FrameNotCentre, TOP, SE, RATES | ENERGY | P_ALPHA, "truth nutation", "from the exact rate"),
    Wrong(SinglePrecision, TOP, SE, LIMITS | TWIN, "truth omega, limit", "limit at dt = 0 from the truth"),
    Wrong(
        StiffSpring, CHAIN, SE,
        OWN | MODES | TWIN | {"truth position", "truth position, limit", "truth velocity, limit"},
        "truth position, scheme's own", "only round-off is allowed",
        near=ENERGY | {"truth velocity"},
    ),
    Wrong(StuckInPlace, FREE, SE, state("position") | TWIN, "twin state", "from its twin .* in position"),
    Wrong(
        JointsOfLastSample, CHAIN, SE, {"invariant joint speed residual"},
        "invariant joint speed residual", "change from the exact value at the start",
    ),
    Wrong(
        Turned, CHAIN, SE, {"invariant attitude"},
        "invariant attitude", "change from the exact value at the start",
    ),
    Wrong(Sleepy, TOP, SE, TURNING | RATES | TWIN, "truth orientation", "distance from the exact motion"),
    Wrong(
        Echo, TOP, SE, {"order orientation", "order omega"} | TWIN, "order omega",
        "although the scheme's own error is 0.17 rad/s at dt 0.002 s: too good to be an integration",
    ),
    Wrong(
        Echo, CHAIN, SE, {"order position", "order velocity"} | OWN | TWIN,
        "order position", "too good to be an integration",
    ),
)  # fmt: skip

#: Each place where a wrong engine is run, with every right engine that has the scheme.
PLACES = [
    (engine, scene, twin)
    for scene, twin in sorted({(wrong.scene, wrong.twin) for wrong in WRONG})
    for engine in RIGHT
    if twin in {scheme.twin for scheme in engine.schemes}
]


@cache
def ladder(engine, scene_name, twin):
    """Every step of the scheme of this twin name, the coarsest run twice; nothing if it cannot run."""
    scene = scenes()[scene_name]
    scheme = next((scheme for scheme in engine.schemes if scheme.twin == twin), None)
    if scheme is None or unsupported(scene, engine, scheme):
        return ()
    first, *finer = (scene.whole_step(dt) for dt in scene.ladder(scheme.order, twin))
    steps = [(first, 2), *((dt, 1) for dt in finer)]
    return tuple(simulate(scene, engine, scheme, dt, repeats)[0] for dt, repeats in steps)


def beside(engine, scene, twin):
    """Verdicts on an engine, and on the right ones beside it."""
    right = [other for other in RIGHT if not issubclass(engine, other)]
    mine, others = ladder(engine, scene, twin), [run for other in right for run in ladder(other, scene, twin)]
    if not (mine and others):
        pytest.skip(f"the {twin} of {engine.name} {engine.version()} has no twin")
    verdicts = judge([*mine, *others], known=())
    return ([v for v in verdicts if (v.engine == engine.name) is own] for own in (True, False))


@pytest.mark.parametrize(("engine", "scene", "twin"), PLACES)
def test_the_unchanged_engine_passes_everything(engine, scene, twin):
    verdicts, others = beside(engine, scene, twin)
    assert {v.check for v in verdicts} == {
        "truth",
        "order",
        "twin",
        "invariant",
        "setup",
        "determinism",
        "acceleration",
    }
    assert [v for v in [*verdicts, *others] if v.status is not Status.PASS] == []


#: Fails where the engine's equations are wrong, and where only its integration or its telling is, passes.
EQUATIONS = "acceleration equations of motion"
WRONG_EQUATIONS = {
    WeakGravity, LyingWeakGravity, LargeMoment, LyingLargeMoment, NoGyroscopicTerm, Damped, LyingDamped,
    Clamped, LyingClamped, OffByABillionth, StiffSpring,
}  # fmt: skip


@pytest.mark.parametrize("wrong", WRONG, ids=lambda wrong: wrong.name)
def test_a_wrong_engine_turns_the_right_checks_red(wrong):
    verdicts, others = beside(*wrong[:3])
    red = [v for v in verdicts if v.status is not Status.PASS]
    found = {f"{v.check} {v.observable}" for v in red}
    assert (EQUATIONS in found) == (wrong.engine in WRONG_EQUATIONS)
    assert found - set(wrong.near) - {EQUATIONS} == set(wrong.red)
    assert all(v.status is Status.FAIL for v in red)
    messages = [v.message for v in red if f"{v.check} {v.observable}" == wrong.check]
    assert any(re.search(wrong.says, message) for message in messages), messages
    # No right engine is accused along with it.
    assert [v for v in others if v.status is not Status.PASS] == []


def test_without_its_gyroscopic_term_a_body_does_not_turn_about_its_axis_at_all():
    verdicts, _ = beside(NoGyroscopicTerm, FREE, SE)
    assert {round(v.measured, 9) for v in verdicts if v.observable == "Omega_b"} == {5.0}


def test_one_step_is_enough_for_twins_to_tell_which_of_three_is_wrong():
    runs = [ladder(engine, TOP, SE)[1] for engine in (OffByABillionth, Pinocchio, PyBullet)]
    failed = {(v.engine, v.check) for v in judge(runs, known=()) if v.status is not Status.PASS}
    assert failed == {("mujoco", "twin")}
