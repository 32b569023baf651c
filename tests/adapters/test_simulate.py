"""One cell: every sample where it belongs, copied, hashed, and nothing left open."""

from dataclasses import replace
from typing import ClassVar

import numpy as np
import pytest
from poinsot.adapters.engine import EngineError, Scheme, Setup, State
from poinsot.adapters.simulate import UnsupportedError, digest, simulate, unsupported
from poinsot.reference.errors import InputError
from poinsot.scenarios.registry import scenes
from poinsot.scenarios.trajectory import Trajectory

SCENE = scenes()["co2_chain[mixture]"]
SCHEME = Scheme("steady", 3, "steady's twin", {"damper": "it has none", "gravity": "it floats"})


class Drifting:
    """Three bodies whose every number is how many steps were taken; hands out views of its own arrays."""

    name: ClassVar[str] = "drifting"
    schemes: ClassVar[tuple] = (SCHEME,)
    features: ClassVar[frozenset] = frozenset({"slide", "tree", "spring"})
    settings: ClassVar[dict] = {"clock": "integer"}
    calls: ClassVar[list] = []

    @staticmethod
    def version():
        return "7.1"

    def build(self, scene, scheme, dt):
        self.calls.append(("build", scheme.name, dt))
        self.arrays = [np.zeros(shape) for shape in ((3, 3), (3, 4), (3, 3), (3, 3), 3, 3)]

    def step(self, n):
        self.calls.append(("step", n))
        for array in self.arrays:
            array += n

    def state(self):
        return State(*self.arrays)

    def readback(self):
        return Setup({"gravity": np.zeros(3), "dt": np.float64(0.1), "limit": np.inf}, ("limit",))

    def acceleration(self, q, v):
        return np.zeros_like(v)

    def model_text(self):
        return "model.txt", "three bodies"

    def close(self):
        self.calls.append(("close",))


@pytest.fixture(autouse=True)
def calls(monkeypatch):
    monkeypatch.setattr(Drifting, "calls", [])
    return lambda: Drifting.calls


@pytest.mark.parametrize(("dt", "stride"), [(2e-2, 1), (4e-3, 5), (1e-3, 20)])
def test_each_sample_is_the_state_after_its_steps(calls, dt, stride):
    run, _ = simulate(SCENE, Drifting, SCHEME, dt)
    taken = stride * np.arange(SCENE.samples + 1)
    for name in ("position", "quaternion", "velocity", "omega", "joint_position", "joint_velocity"):
        # The engine hands out the same array every time: a sample that is not copied would be the last.
        array = getattr(run, name)
        assert np.array_equal(array, np.broadcast_to(taken.reshape(-1, *[1] * (array.ndim - 1)), array.shape))
    assert run.t == pytest.approx(SCENE.sample_times(), abs=1e-12)
    assert [call for call in calls() if call[0] == "step"] == [("step", stride)] * SCENE.samples


def test_times_are_whole_steps_and_do_not_add_up_rounding():
    run, _ = simulate(SCENE, Drifting, SCHEME, 1e-3)
    assert np.array_equal(run.t, np.arange(SCENE.samples + 1) * 20 * 1e-3)


def test_a_step_is_rounded_to_whole_steps_between_samples(calls):
    run, _ = simulate(SCENE, Drifting, SCHEME, 1.1e-3)
    assert run.provenance.dt == pytest.approx(0.02 / 18, rel=1e-12)
    assert calls()[0] == ("build", "steady", run.provenance.dt)
    assert run.provenance.steps == 18 * SCENE.samples


def test_provenance_says_what_ran():
    run, model = simulate(SCENE, Drifting, SCHEME, 1e-3)
    p = run.provenance
    assert (p.scene, p.engine, p.engine_version) == ("co2_chain[mixture]", "drifting", "7.1")
    assert (p.scheme, p.order, p.twin, p.dt, p.steps) == ("steady", 3, "steady's twin", 1e-3, 2500)
    assert p.setup == {"gravity": [0.0, 0.0, 0.0], "dt": 0.1, "limit": float("inf")}
    assert {type(value) for value in p.setup.values()} == {list, float}  # as a log gives them back
    assert (p.probed, p.settings) == (("limit",), {"clock": "integer"})
    assert model == {"model.txt": "three bodies"}


def test_every_repeat_is_built_anew_and_hashed(calls):
    run, _ = simulate(SCENE, Drifting, SCHEME, 2e-2, repeats=3)
    assert len(run.provenance.digests) == 3
    assert set(run.provenance.digests) == {digest(run)}
    assert [call[0] for call in calls() if call[0] != "step"] == ["build", "build", "build", "close"]


class LastBit(Drifting):
    """Another last bit in every run."""

    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        self.arrays[3][1, 2] = np.nextafter(1.0, 2.0) if len(self.calls) > 1 else 1.0


def test_a_last_bit_is_another_hash():
    run, _ = simulate(SCENE, LastBit, SCHEME, 2e-2, repeats=2)
    assert len(set(run.provenance.digests)) == 2
    # The first run is the one that is logged.
    assert run.provenance.digests[0] == digest(run)


@pytest.mark.parametrize("place", range(6))
def test_every_bit_of_every_array_is_in_the_hash(place):
    def motion(value):
        arrays = [np.zeros(shape) for shape in ((5, 2, 3), (5, 2, 4), (5, 2, 3), (5, 2, 3), (5, 1), (5, 1))]
        arrays[place].flat[-1] = value
        return Trajectory(np.arange(5.0), *arrays)

    assert len({digest(motion(value)) for value in (0.0, -0.0, 5e-324, 1.0, np.nan)}) == 5
    assert digest(motion(1.0)) == digest(motion(1.0))


class Breaking(Drifting):
    def step(self, n):
        super().step(n)
        if self.arrays[0][0, 0] >= 300:
            self.break_down()


class TurnsToNaN(Breaking):
    def break_down(self):
        self.arrays[5][2] = np.nan


class Raises(Breaking):
    def break_down(self):
        raise EngineError("the solver did not converge")


@pytest.mark.parametrize(
    ("engine", "says"),
    [(TurnsToNaN, r"the state is not finite at t = 0\.3 s"), (Raises, "the solver did not converge")],
)
def test_an_engine_that_breaks_down_is_closed_and_says_when(calls, engine, says):
    with pytest.raises(EngineError, match=says):
        simulate(SCENE, engine, SCHEME, 1e-3)
    assert calls()[-1] == ("close",)


def test_a_scene_that_the_engine_cannot_run_says_what_it_lacks(calls):
    top = scenes()["heavy_top[moderate]"]
    assert unsupported(SCENE, Drifting, SCHEME) == ""
    assert unsupported(top, Drifting, SCHEME) == "drifting has no ball joints, no gravity"
    with pytest.raises(
        UnsupportedError, match=r"scene heavy_top\[moderate\] with drifting steady: drifting has no ball"
    ):
        simulate(top, Drifting, SCHEME, 1e-3)
    assert calls() == []


def test_a_scheme_may_lack_what_its_engine_has():
    lacking = Scheme(
        "lazy", 1, "", {"spring": "it has no springs", "tree": "one body at a time", "ball": "no balls"}
    )
    assert unsupported(SCENE, Drifting, lacking) == "it has no springs; one body at a time"
    same = Scheme("lazy", 1, "", dict.fromkeys(("spring", "tree"), "free bodies only"))
    assert unsupported(SCENE, Drifting, same) == "free bodies only"


def test_a_step_that_no_scheme_can_take_is_refused_before_anything_is_built(calls):
    singular = replace(SCENE, singular_times=(SCENE.duration / 2,))
    with pytest.raises(UnsupportedError, match=r"with drifting steady: a step of .* comes to"):
        simulate(singular, Drifting, SCHEME, SCENE.dt)
    assert calls() == []


@pytest.mark.parametrize("dt", [0.0, -1e-3, float("nan"), 100.0])
def test_a_step_that_cannot_be_is_refused_before_anything_is_built(calls, dt):
    with pytest.raises(InputError, match="dt: got"):
        simulate(SCENE, Drifting, SCHEME, dt)
    assert calls() == []
