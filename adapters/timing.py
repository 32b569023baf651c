"""How long an engine steps, with nothing else inside the clock."""

import gc
import os
import statistics
from dataclasses import dataclass
from time import perf_counter

from ..scenarios.scene import Scene
from .engine import Engine, Scheme

#: Repeats of one cell.
REPEATS = 10
#: How long [s] one repeat steps: long against the clock's grain, short enough to repeat ten times.
#: A cell that takes longer as a whole is timed over its first steps, and the time scaled to all of them.
SPAN = 0.02
#: Steps of the run that is not counted, which fills caches and tells how long the others will take.
WARM_UP = 500


@dataclass(frozen=True)
class Timing:
    """Wall time [s] of all ``steps`` of one cell, over its repeats, taken on the first ``timed`` of them."""

    steps: int
    timed: int
    seconds: tuple[float, ...]

    @property
    def least(self) -> float:
        """The fastest repeat: what the engine takes when nothing disturbs it."""
        return min(self.seconds)

    @property
    def median(self) -> float:
        """The middle repeat."""
        return statistics.median(self.seconds)

    def of(self, steps: int) -> "Timing":
        """The time of so many steps, taken on these."""
        return Timing(steps, self.timed, tuple(s * (steps / self.steps) for s in self.seconds))

    def as_row(self) -> dict[str, float | int]:
        """The part of a work-precision row that speaks of time."""
        return {
            "seconds_min": self.least,
            "seconds_median": self.median,
            "repeats": len(self.seconds),
            "timed_steps": self.timed,
        }


def timed(scene: Scene, engine: type[Engine], scheme: Scheme, dt: float) -> Timing:
    """Time the steps of a cell, from its start each time, without looking at or logging a sample.

    Pinned to one core where the system allows it, garbage collection off.
    """
    pin()
    steps = scene.samples * scene.steps_per_sample(dt)
    machine = engine()
    try:
        warm_up = min(steps, WARM_UP)
        each = _once(machine, scene, scheme, dt, warm_up) / warm_up
        stepped = min(steps, max(warm_up, round(SPAN / each)))
        whole = steps / stepped
        seconds = (_once(machine, scene, scheme, dt, stepped) * whole for _ in range(REPEATS))
        return Timing(steps, stepped, tuple(seconds))
    finally:
        machine.close()


def pin() -> bool:
    """Keep this process on one core, the last it may use; tells whether the system allowed it."""
    if not hasattr(os, "sched_setaffinity"):
        return False
    try:
        os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
    except OSError:
        return False
    return True


def _once(machine: Engine, scene: Scene, scheme: Scheme, dt: float, steps: int) -> float:
    machine.build(scene, scheme, scene.whole_step(dt))
    enabled = gc.isenabled()
    gc.disable()
    try:
        start = perf_counter()
        machine.step(steps)
        return perf_counter() - start
    finally:
        if enabled:
            gc.enable()
