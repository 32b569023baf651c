"""A timing speaks of all steps of a cell, however many of them were timed."""

import gc
import os
import subprocess
import sys
import time
from typing import ClassVar

import pytest
from poinsot.adapters import timing
from poinsot.adapters.engine import Scheme
from poinsot.adapters.registry import load
from poinsot.scenarios.registry import scenes

SCHEME = Scheme("none", 1, "none", {})
EACH = 2e-6
#: What it takes to be asked, of an engine that is slow at that.
ASKING = 5e-5


class Sleeper:
    """Takes ``EACH`` seconds a step, and notes what it is asked for."""

    asked: ClassVar[list] = []
    collecting: ClassVar[list] = []

    def build(self, scene, scheme, dt):
        pass

    def step(self, n):
        if n == 0:
            return
        self.asked.append(n)
        self.collecting.append(gc.isenabled())
        end = time.perf_counter() + n * EACH
        while time.perf_counter() < end:
            pass

    def close(self):
        pass


@pytest.fixture(autouse=True)
def unpinned(monkeypatch):
    monkeypatch.setattr(timing, "pin", lambda: True)
    # Whatever else the machine does, no test but one wants a cell timed again.
    monkeypatch.setattr(timing, "SPREAD", float("inf"))
    Sleeper.asked, Sleeper.collecting = [], []


#: Steps asked for before any is timed.
COUNTED = (timing.WARM_UP, timing.MANY, timing.FEW)


def timed(dt):
    return timing.timed(scenes()["free_symmetric_top[oblate]"], Sleeper, SCHEME, dt)


def test_a_short_cell_is_timed_as_a_whole(monkeypatch):
    monkeypatch.setattr(timing, "SPAN", 1.0)  # however busy the machine is
    found = timed(1e-2)
    assert (found.steps, found.timed) == (1000, 1000)
    assert Sleeper.asked == [*COUNTED] + [1000] * timing.REPEATS
    assert found.least >= 1000 * EACH


def test_a_long_cell_is_timed_in_part_and_scaled():
    found = timed(1e-4)
    assert found.steps == 100_000
    assert timing.WARM_UP <= found.timed < found.steps
    # The sleeper cannot be faster; a busy machine can only make it slower.
    assert found.least >= 100_000 * EACH * (1 - 1e-9)
    assert len(found.seconds) == timing.REPEATS
    assert found.as_row()["timed_steps"] == found.timed


def test_nothing_is_collected_inside_the_clock():
    timed(1e-2)
    assert Sleeper.collecting[:1] + Sleeper.collecting[len(COUNTED) :] == [False] * 11
    assert gc.isenabled()


class Disturbed(Sleeper):
    """Every other repeat of the first ten takes three times as long."""

    def step(self, n):
        slow = len(self.asked) % 2 and len(self.asked) < timing.REPEATS + len(COUNTED)
        super().step(3 * n if slow else n)


def test_a_cell_that_spreads_is_timed_again_and_the_steadier_kept(monkeypatch):
    monkeypatch.setattr(timing, "SPREAD", 0.2)
    found = timing.timed(scenes()["free_symmetric_top[oblate]"], Disturbed, SCHEME, 1e-2)
    assert len(Sleeper.asked) == len(COUNTED) + 2 * timing.REPEATS
    assert len(found.seconds) == timing.REPEATS
    assert found.median < 3 * 1000 * EACH
    assert timing.Timing(10, 10, (1.0, 1.5, 1.6)).spread == pytest.approx(0.5)


def test_the_time_of_other_steps_is_scaled():
    found = timing.Timing(10, 5, (2.0, 4.0), 1e-3).of(30)
    assert found == timing.Timing(30, 5, (6.0, 12.0), 1e-3, scaled=True)
    assert found.as_row()["us_per_step"] == pytest.approx(2e5)
    assert found.as_row()["scaled"]
    assert not timing.Timing(10, 5, (2.0, 4.0)).as_row()["scaled"]


class SlowToCall(Sleeper):
    """Takes a while to be asked, whatever for."""

    def step(self, n):
        end = time.perf_counter() + ASKING
        while time.perf_counter() < end:
            pass
        super().step(n)


def test_what_a_call_takes_by_itself_is_told_apart():
    found = timing.timed(scenes()["free_symmetric_top[oblate]"], SlowToCall, SCHEME, 1e-2)
    assert found.call >= ASKING
    assert found.as_row()["us_per_call"] == found.call * 1e6


@pytest.mark.parametrize(
    ("name", "scene", "looped"),
    [
        ("mujoco", "free_symmetric_top[oblate]", True),
        ("mujoco", "two_body[kepler e=0.1]", False),
        ("pybullet", "free_symmetric_top[oblate]", True),
        ("pinocchio", "free_symmetric_top[oblate]", False),
    ],
)
def test_whose_loop_takes_the_steps_is_told(name, scene, looped):
    pytest.importorskip(name)
    engine = load(name)
    found = timing.timed(scenes()[scene], engine, engine.schemes[0], 1e-3)
    assert found.as_row()["own_loop"] is looped


class WantsSteps(Sleeper):
    def step(self, n):
        if n < 1:
            raise ValueError("how many?")
        super().step(n)


def test_an_engine_that_takes_no_empty_call_is_timed_all_the_same():
    found = timing.timed(scenes()["free_symmetric_top[oblate]"], WantsSteps, SCHEME, 1e-2)
    assert found.call is None
    assert found.as_row()["us_per_call"] is None
    assert found.least > 0


@pytest.mark.parametrize("name", ["mujoco", "pybullet", "pinocchio"])
def test_an_empty_call_moves_nothing(name):
    pytest.importorskip(name)
    scene, engine = scenes()["double_pendulum[small]"], load(name)
    machine = engine()
    machine.build(scene, engine.schemes[0], 1e-3)
    machine.step(10)
    before = [part.tolist() for part in machine.state()[:6]]
    # Python's share of a call is microseconds; on a machine that is busy, tens of them.
    assert 0 < timing.empty_call(machine) < 1e-3
    assert [part.tolist() for part in machine.state()[:6]] == before
    machine.close()


def test_the_beat_is_that_of_the_machine():
    assert 0 < timing.beat() < 0.1


class Counted(Sleeper):
    """Notes what it is told beside its steps."""

    def build(self, scene, scheme, dt):
        self.asked.append(("build", dt))

    def close(self):
        self.asked.append("close")


def test_a_repeat_of_the_whole_starts_anew_and_the_engine_is_closed(monkeypatch):
    monkeypatch.setattr(timing, "SPAN", 1.0)  # however busy the machine is
    timing.timed(scenes()["free_symmetric_top[oblate]"], Counted, SCHEME, 1.001e-2)
    build = ("build", 1e-2)
    assert Sleeper.asked == [build, *COUNTED] + [build, 1000] * timing.REPEATS + ["close"]


@pytest.mark.parametrize(
    ("name", "dt", "starts"), [("free_symmetric_top[oblate]", 1e-3, 4), ("rolling[hoop]", 1e-4, 10)]
)
def test_repeats_of_a_part_go_on_but_where_bodies_touch(monkeypatch, name, dt, starts):
    scene = scenes()[name]
    steps = scene.samples * scene.steps_per_sample(dt)
    # A part of 3 in 10, told apart from the clock: three of them fill a run.
    monkeypatch.setattr(timing, "_stepping", lambda machine, n: machine.step(n) or n * EACH)
    monkeypatch.setattr(timing, "SPAN", 0.3 * steps * EACH)
    found = timing.timed(scene, Counted, SCHEME, dt)
    part = round(0.3 * steps)
    assert found.timed == part
    asked = [entry for entry in Sleeper.asked if entry != "close"]
    assert asked.count(part) == timing.REPEATS
    assert sum(isinstance(entry, tuple) for entry in asked) == 1 + starts
    since = 0
    for entry in asked[2:]:
        since = 0 if isinstance(entry, tuple) else since + entry
        assert since <= steps


class Breaking(Counted):
    def step(self, n):
        raise RuntimeError("the solver did not converge")


def test_an_engine_that_breaks_is_closed_and_the_collector_runs_again():
    with pytest.raises(RuntimeError, match="did not converge"):
        timing.timed(scenes()["free_symmetric_top[oblate]"], Breaking, SCHEME, 1e-2)
    assert Sleeper.asked[-1] == "close"
    assert gc.isenabled()


def test_the_middle_and_the_least_of_the_repeats():
    found = timing.Timing(10, 10, (3.0, 1.0, 2.0, 9.0))
    assert (found.least, found.median, found.as_row()["repeats"]) == (1.0, 2.5, 4)


def test_a_timing_says_whether_it_was_pinned(monkeypatch):
    assert timed(1e-2).pinned
    monkeypatch.setattr(timing, "pin", lambda: False)
    assert not timed(1e-2).pinned


@pytest.mark.skipif(not hasattr(os, "sched_getaffinity"), reason="this system pins no process")
def test_a_timed_process_stays_on_one_core():
    code = "import os; from poinsot.adapters.timing import pin; print(pin(), len(os.sched_getaffinity(0)))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "True 1\n"
