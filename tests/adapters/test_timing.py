"""A timing speaks of all steps of a cell, however many of them were timed."""

import gc
import time
from typing import ClassVar

import pytest
from poinsot.adapters import timing
from poinsot.adapters.engine import Scheme
from poinsot.scenarios.registry import scenes

SCHEME = Scheme("none", 1, "none", {})
EACH = 2e-6


class Sleeper:
    """Takes ``EACH`` seconds a step, and notes what it is asked for."""

    asked: ClassVar[list] = []
    collecting: ClassVar[list] = []

    def build(self, scene, scheme, dt):
        pass

    def step(self, n):
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
    Sleeper.asked, Sleeper.collecting = [], []


def timed(dt):
    return timing.timed(scenes()["free_symmetric_top[oblate]"], Sleeper, SCHEME, dt)


def test_a_short_cell_is_timed_as_a_whole():
    found = timed(1e-2)
    assert (found.steps, found.timed) == (1000, 1000)
    assert Sleeper.asked == [1000] * 11
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
    assert Sleeper.collecting == [False] * 11
    assert gc.isenabled()
