"""What became of a run, told by its motion: each outcome by an engine that does so and one that does not."""

from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("mujoco")
pytest.importorskip("pinocchio")
pytest.importorskip("pybullet")

from poinsot.adapters import mujoco_
from poinsot.adapters.engine import EngineError
from poinsot.adapters.mujoco_ import MuJoCo
from poinsot.adapters.observed import SAMPLES, Observed, observe
from poinsot.adapters.pinocchio_ import Pinocchio
from poinsot.adapters.pybullet_ import PyBullet
from poinsot.reference.errors import InputError
from poinsot.reports import stability_page
from poinsot.reports.outcomes import LONGEST, Outcome, judged
from poinsot.scenarios import extreme_damper, extreme_gimbal, extreme_tops
from poinsot.scenarios.stiff_spring import on_spring
from wrong_engines.stability import ClampedSpring

SCENE = on_spring(1e4)
#: Step [s] at which ωdt is 1.
UNIT = 1e-2


def outcome(engine, z, scheme=None, scene=SCENE, most=4000):
    chosen = next((s for s in engine.schemes if s.name == scheme), engine.schemes[0])
    return judged(scene, observe(scene, engine, chosen, z * UNIT, most))


@pytest.mark.parametrize(
    ("engine", "scheme", "z", "expected"),
    [
        (MuJoCo, "Euler", 1e-2, Outcome.ACCURATE),
        (MuJoCo, "Euler", 1.0, Outcome.BOUNDED),
        (MuJoCo, "Euler", 1.999, Outcome.BOUNDED),
        (MuJoCo, "Euler", 2.01, Outcome.GROWING),
        (MuJoCo, "Euler", 1e3, Outcome.NOT_FINITE),
        (MuJoCo, "RK4", 0.1, Outcome.ACCURATE),
        (MuJoCo, "RK4", 2.8, Outcome.BOUNDED),
        (MuJoCo, "RK4", 2.86, Outcome.GROWING),
        (MuJoCo, "discrete", 1e6, Outcome.BOUNDED),
        (Pinocchio, "semi-implicit Euler", 2.01, Outcome.GROWING),
        (Pinocchio, "RKMK4", 1e3, Outcome.NOT_FINITE),
        (PyBullet, "reduced coordinates", 1.999, Outcome.BOUNDED),
        (PyBullet, "reduced coordinates", 1e3, Outcome.NOT_FINITE),
        (PyBullet, "maximal coordinates", 1.0, Outcome.REFUSED),
    ],
)
def test_right_engines(engine, scheme, z, expected):
    assert outcome(engine, z, scheme).outcome is expected


class Resetting(MuJoCo):
    """Leaves MuJoCo's own reset on, as it is by default, and says nothing of it."""

    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        self._model.opt.disableflags &= ~int(mujoco_.mujoco.mjtDisableBit.mjDSBL_AUTORESET)

    def _sound(self, state):
        pass


@pytest.mark.parametrize("z", [2.5, 3.0, 1e3, 1e6])
def test_a_reset_is_seen_though_nothing_is_said(z):
    found = outcome(Resetting, z)
    assert found.outcome is Outcome.RESET
    assert found.said == ""
    # The same engine with its reset off never comes back.
    assert outcome(MuJoCo, z).outcome in (Outcome.GROWING, Outcome.NOT_FINITE)


def test_a_reset_on_is_no_reset_where_the_step_holds():
    for z, expected in ((1e-2, Outcome.ACCURATE), (1.9, Outcome.BOUNDED)):
        assert outcome(Resetting, z).outcome is expected


class BackToStart(Pinocchio):
    """Starts again from the scene's own state once it is too fast."""

    def step(self, n):
        super().step(n)
        if not np.abs(self._velocity).max() < 1e6:
            self._position, self._velocity = self._ours_to_pinocchio(self._scene.q0, self._scene.v0)


class Frozen(Pinocchio):
    """Throws each step away."""

    def step(self, n):
        pass


@pytest.mark.parametrize(("engine", "z"), [(BackToStart, 2.1), (BackToStart, 50.0), (Frozen, 1.0)])
def test_a_return_to_the_start_is_a_reset(engine, z):
    assert outcome(engine, z).outcome is Outcome.RESET


class ClampedSpin(Pinocchio):
    """Lets no component of a velocity above 50."""

    def step(self, n):
        for _ in range(n):
            super().step(1)
            self._velocity = np.clip(self._velocity, -50, 50)


@pytest.mark.parametrize("z", [2.1, 3.0, 100.0])
def test_a_clamp_is_seen(z):
    assert outcome(ClampedSpring, z).outcome is Outcome.CLAMPED


def test_a_clamp_that_is_not_met_is_none():
    for z, expected in ((1e-2, Outcome.ACCURATE), (1.9, Outcome.BOUNDED)):
        assert outcome(ClampedSpring, z).outcome is expected


def test_a_clamp_below_the_motion_itself_is_seen():
    # Its own spin of 200 rad/s is cut at the first step, and then stays what the clamp lets it be.
    scene = extreme_tops.spin(200.0)
    found = judged(scene, observe(scene, ClampedSpin, ClampedSpin.schemes[0], 1e-5, 4000))
    assert found.outcome is Outcome.CLAMPED
    slow = extreme_tops.spin(20.0)
    found = judged(slow, observe(slow, ClampedSpin, ClampedSpin.schemes[0], 1e-5, 4000))
    assert found.outcome is Outcome.ACCURATE


def test_steady_spin_is_no_clamp():
    # ω3 of a symmetric top is constant in truth too, and what an implicit scheme dies down to is approached.
    scene = extreme_tops.inertia_ratio(0.5)
    for engine, scheme in ((MuJoCo, "Euler"), (MuJoCo, "implicit"), (MuJoCo, "RK4")):
        for dt in (1e-4, 1e-2, 1.0):
            chosen = next(s for s in engine.schemes if s.name == scheme)
            found = judged(scene, observe(scene, engine, chosen, dt, 4000))
            assert found.outcome is not Outcome.CLAMPED
            assert found.outcome is not Outcome.RESET


def test_what_dies_down_is_neither_clamped_nor_reset():
    scene = extreme_damper.stiff_damper(1e6)
    # At c dt/m = 1 semi-implicit Euler stops it in one step; taken implicitly, it ends in the least numbers.
    for scheme, dt in (("Euler", 1e-6), ("implicit", 10.0), ("implicitfast", 10.0), ("implicit", 1e-4)):
        chosen = next(s for s in MuJoCo.schemes if s.name == scheme)
        found = judged(scene, observe(scene, MuJoCo, chosen, dt, 4000))
        assert found.outcome in (Outcome.ACCURATE, Outcome.BOUNDED)
        assert found.energy_last < 1e-9


@pytest.mark.parametrize("dt", [1e-5, 1e-2])
def test_a_reset_of_a_damped_mass_is_seen(dt):
    scene = extreme_damper.stiff_damper(1e6)
    assert judged(scene, observe(scene, Resetting, MuJoCo.schemes[0], dt, 4000)).outcome is Outcome.RESET


@pytest.mark.parametrize("dt", [0.3, 30.0])
def test_a_reset_of_a_free_body_is_seen(dt):
    scene = extreme_tops.spin(100.0)
    assert judged(scene, observe(scene, Resetting, MuJoCo.schemes[0], dt, 4000)).outcome is Outcome.RESET


def test_a_storm_that_calms_down_by_itself_is_no_reset():
    # Its ω grows until rounding has taken from ω3, about which it then precesses slowly enough to be stable.
    scene = extreme_tops.spin(316.0)
    scheme = next(s for s in Pinocchio.schemes if s.name == "RKMK4")
    found = judged(scene, observe(scene, Pinocchio, scheme, 0.01, 4000))
    assert found.outcome is Outcome.GROWING
    assert found.energy_last < 1 < 1e6 < found.energy_most


def test_what_an_implicit_scheme_leaves_is_no_clamp():
    scene = extreme_tops.spin(1e5)
    scheme = next(s for s in Pinocchio.schemes if s.name == "implicit gyroscopic")
    assert judged(scene, observe(scene, Pinocchio, scheme, 1.0, 4000)).outcome is Outcome.BOUNDED


@pytest.mark.parametrize(
    ("engine", "said"), [(MuJoCo, "mjWARN_INERTIA"), (PyBullet, ""), (Pinocchio, "left the finite numbers")]
)
def test_a_step_that_ends_in_gimbal_lock(engine, said):
    recorded = {name.split()[0]: (name, outcome) for name, outcome, _ in stability_page.IN_GIMBAL_LOCK}
    scene = extreme_gimbal.near_gimbal_lock(1e-12)
    found = judged(scene, observe(scene, engine, engine.schemes[0], 1e-3, 20_000))
    assert (f"{engine.name} {engine.version()}", found.outcome) == recorded[engine.name]
    assert said in found.said
    # A step that passes it sees nothing.
    passed = judged(scene, observe(scene, engine, engine.schemes[0], 4.64e-3, 20_000))
    assert (passed.outcome, passed.said) == (Outcome.ACCURATE, "")


class Speechless(Pinocchio):
    """Complains of a sound run."""

    def state(self):
        raise EngineError("all is lost", super().state())


class Sleeping(Pinocchio):
    """Refuses small steps, and others once half way."""

    def build(self, scene, scheme, dt):
        if dt < 1e-4:
            raise InputError("no such step")
        self._calls = 0
        super().build(scene, scheme, dt)

    def step(self, n):
        self._calls += 1
        if self._calls > 100:
            raise ArithmeticError("no more")
        super().step(n)


def test_what_an_engine_says_does_not_decide():
    found = outcome(Speechless, 1e-2)
    assert found.outcome is Outcome.ACCURATE
    assert found.said == "all is lost"


def test_refused_at_once_or_broken_off():
    assert outcome(Sleeping, 1e-3).outcome is Outcome.REFUSED
    found = outcome(Sleeping, 0.1)
    assert found.outcome is Outcome.NOT_FINITE
    assert found.said == "ArithmeticError: no more"


def test_not_a_number_in_silence_is_seen():
    class Lost(Pinocchio):
        def state(self):
            state = super().state()
            return state._replace(velocity=state.velocity * np.nan) if self._steps > 150 else state

    assert outcome(Lost, 1.0).outcome is Outcome.NOT_FINITE


def test_numbers_beside_the_outcome():
    accurate = outcome(MuJoCo, 1e-2)
    # First order: the displacement errs by a part ωdt/2 of itself.
    assert accurate.error == pytest.approx(5e-3, rel=0.3)
    assert accurate.energy_most == pytest.approx(1.0, abs=0.02)
    lost = outcome(MuJoCo, 10.0, "discrete")
    assert lost.energy_last < 1e-100
    assert lost.energy_most == pytest.approx(1.0)
    broken = outcome(MuJoCo, 1e3)
    assert (broken.error, broken.energy_most) == (None, None)
    assert "BADQACC" in broken.said


def test_length_of_a_run():
    short = observe(SCENE, Pinocchio, Pinocchio.schemes[0], 1.0, 4000)
    assert short.steps == SAMPLES
    assert len(short.motion.t) == SAMPLES + 1
    long = observe(SCENE, Pinocchio, Pinocchio.schemes[0], SCENE.duration / 3000, 4000)
    assert long.steps == 3000
    assert long.motion.t[-1] == pytest.approx(SCENE.duration)
    cut = observe(SCENE, Pinocchio, Pinocchio.schemes[0], SCENE.duration / 1e6, 4000)
    assert cut.steps == 4000


def test_a_run_sees_all_of_its_scene_unless_it_is_cut_short():
    for steps in (200, 200.5, 290, 999, 3001.5, 4000):
        seen = observe(SCENE, Pinocchio, Pinocchio.schemes[0], SCENE.duration / steps, 4000)
        assert seen.steps == np.ceil(steps)
        assert len(seen.motion.t) == SAMPLES + 1
        assert judged(SCENE, seen).covered == 1
    cut = observe(SCENE, Pinocchio, Pinocchio.schemes[0], SCENE.duration / 5000, 4000)
    assert judged(SCENE, cut).covered == pytest.approx(0.8)
    assert judged(SCENE, Observed(1.0, 200, None, "why")).covered is None


@pytest.mark.parametrize(
    ("engine", "scheme"), [(MuJoCo, "Euler"), (PyBullet, "reduced coordinates"), (Pinocchio, None)]
)
def test_energy_that_rises_slowly_and_steadily_grows(engine, scheme):
    # By a half in all, which is no factor of four from third to third.
    scene = extreme_tops.spin(100.0)
    chosen = next((s for s in engine.schemes if s.name == scheme), engine.schemes[0])
    found = judged(scene, observe(scene, engine, chosen, 3.16e-4, 4000))
    assert found.energy_last == pytest.approx(1.58, abs=0.01)
    assert found.outcome is Outcome.GROWING


@pytest.mark.parametrize("scheme", ["Euler", "implicit"])
def test_of_what_is_cut_short_what_may_end_otherwise_is_told(scheme):
    # At its end it is off by twelve parts in a hundred, after an eighth of the way by two in a thousand.
    scene = extreme_tops.spin(10.0)
    chosen = next(s for s in MuJoCo.schemes if s.name == scheme)
    short, whole = (judged(scene, observe(scene, MuJoCo, chosen, 1e-4, most)) for most in (4000, LONGEST))
    assert (short.outcome, short.so_far, short.doubtful) == (Outcome.ACCURATE, True, True)
    expected = Outcome.GROWING if scheme == "Euler" else Outcome.BOUNDED
    assert (whole.outcome, whole.so_far, whole.doubtful) == (expected, False, False)
    rk4 = next(s for s in MuJoCo.schemes if s.name == "RK4")
    exact = judged(scene, observe(scene, MuJoCo, rk4, 1e-4, 4000))
    assert (exact.outcome, exact.so_far, exact.doubtful) == (Outcome.ACCURATE, True, False)


def test_nothing_seen_is_refused():
    assert judged(SCENE, Observed(1.0, 200, None, "why")).said == "why"
    assert judged(replace(SCENE), Observed(1.0, 200, None)).outcome is Outcome.REFUSED


def test_every_outcome_has_a_sentence():
    for each in Outcome:
        assert each.sentence
