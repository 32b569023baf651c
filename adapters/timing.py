"""How long an engine steps, with nothing else inside the clock."""

import gc
import os
import statistics
import sys
from dataclasses import dataclass, replace
from time import perf_counter

from ..scenarios.scene import Scene
from .engine import Engine, Scheme

#: Repeats of one cell.
REPEATS = 10
#: How long [s] one repeat steps: long against the clock's grain, short enough to repeat ten times.
#: A cell that takes longer as a whole is timed over a part of its steps, and the time scaled to all of them.
SPAN = 0.001
#: A cell whose middle repeat takes longer than its fastest by this part is timed once more, or marked.
SPREAD = 0.2
#: Rounds of the loop that tells how fast the machine itself is just then.
ROUNDS = 20_000
#: Empty calls to take the mean of.
CALLS = 100
#: Steps of the run that is not counted, which fills caches and tells how long the others will take.
WARM_UP = 50
#: Steps over which Python's calls are counted: where many need as many more, each is asked for by itself.
FEW, MANY = 32, 64


@dataclass(frozen=True)
class Timing:
    """Wall time [s] of all ``steps`` of one cell, over its repeats, each taken on ``timed`` of them.

    ``beat`` [s] is what a fixed piece of Python's own work took beside it: where it differs from one
    cell to another, so did the machine. ``pinned`` tells whether the process could be kept on one core.
    ``call`` [s] is what asking for no step at all takes: Python's share of a call, which a batch pays once.
    ``looped`` tells whether the engine's own loop takes the steps; else each is asked for from Python, whose
    part of a step's time is not told apart.
    ``scaled`` tells that it was taken at another step of the same scheme.
    """

    steps: int
    timed: int
    seconds: tuple[float, ...]
    beat: float = 0.0
    pinned: bool = True
    call: float | None = None
    looped: bool | None = None
    scaled: bool = False

    @property
    def least(self) -> float:
        """The fastest repeat: what the engine takes when nothing disturbs it."""
        return min(self.seconds)

    @property
    def median(self) -> float:
        """The middle repeat."""
        return statistics.median(self.seconds)

    @property
    def each(self) -> float:
        """Time [s] of one step, without Python's share of a call, of which few steps bear more each."""
        return self.least / self.steps - (self.call or 0.0) / self.timed

    @property
    def spread(self) -> float:
        """How much longer the middle repeat took than the fastest, as a part of it."""
        return self.median / self.least - 1

    def of(self, steps: int) -> "Timing":
        """The time of so many steps, taken on these."""
        seconds = tuple(s * (steps / self.steps) for s in self.seconds)
        return replace(self, steps=steps, seconds=seconds, scaled=True)

    def as_row(self) -> dict[str, float | int | None]:
        """The part of a work-precision row that speaks of time."""
        return {
            "seconds_min": self.least,
            "seconds_median": self.median,
            "repeats": len(self.seconds),
            "timed_steps": self.timed,
            "us_per_step": self.least / self.steps * 1e6,
            "spread": self.spread,
            "us_per_call": None if self.call is None else self.call * 1e6,
            "own_loop": self.looped,
            "scaled": self.scaled,
        }


def timed(scene: Scene, engine: type[Engine], scheme: Scheme, dt: float) -> Timing:
    """Time the steps of a cell, without looking at or logging a sample.

    Pinned to one core where the system allows it, garbage collection off. Repeats go on where the one
    before ended, and from the start again at the end of the run; each from the start where bodies may
    touch, as steps with contact and without take different times.
    """
    pinned, dt = pin(), scene.whole_step(dt)
    steps = scene.samples * scene.steps_per_sample(dt)
    machine = engine()
    try:
        warm_up = min(steps, WARM_UP)
        machine.build(scene, scheme, dt)
        each = _stepping(machine, warm_up) / warm_up
        looped = _looped(machine, steps - warm_up)
        stepped = min(steps, max(warm_up, round(SPAN / each)))
        whole = steps / stepped

        def repeated() -> Timing:
            seconds, taken = list[float](), steps
            for _ in range(REPEATS):
                if taken + stepped > steps or scene.contacts:
                    machine.build(scene, scheme, dt)
                    taken = 0
                seconds.append(_stepping(machine, stepped) * whole)
                taken += stepped
            return Timing(steps, stepped, tuple(seconds), beat(), pinned, empty_call(machine), looped)

        first = repeated()
        return first if first.spread <= SPREAD else min(first, repeated(), key=lambda timing: timing.spread)
    finally:
        machine.close()


def _looped(machine: Engine, left: int) -> bool | None:
    """Whether the engine's own loop takes the steps; ``None`` where too few steps are ``left`` of a run."""
    if left < FEW + MANY:
        return None
    return _calls(machine, MANY) - _calls(machine, FEW) < (MANY - FEW) / 2


def _calls(machine: Engine, steps: int) -> int:
    """Calls of Python's own functions while that many steps are taken."""
    counted = 0

    def count(frame: object, event: str, argument: object) -> None:
        nonlocal counted
        counted += event in ("call", "c_call")

    before = sys.getprofile()
    sys.setprofile(count)
    try:
        machine.step(steps)
    finally:
        sys.setprofile(before)
    return counted


def empty_call(machine: Engine) -> float | None:
    """Time [s] of a call for no steps, the least of five means; ``None`` if the engine takes no such call."""
    means = []
    try:
        for _ in range(5):
            start = perf_counter()
            for _ in range(CALLS):
                machine.step(0)
            means.append((perf_counter() - start) / CALLS)
    except Exception:  # an engine of one's own may want at least one step, and say so in any way
        return None
    return min(means)


def beat() -> float:
    """Time [s] of a fixed piece of Python's own work, the fastest of three."""
    times = []
    for _ in range(3):
        start, total = perf_counter(), 0
        for i in range(ROUNDS):
            total += i
        times.append(perf_counter() - start)
    return min(times)


def pin() -> bool:
    """Keep this process on one core, the last it may use; tells whether the system allowed it."""
    if not hasattr(os, "sched_setaffinity"):
        return False
    try:
        os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
    except OSError:
        return False
    return True


def _stepping(machine: Engine, steps: int) -> float:
    """Time [s] of so many steps, from where the engine is."""
    enabled = gc.isenabled()
    gc.disable()
    try:
        start = perf_counter()
        machine.step(steps)
        return perf_counter() - start
    finally:
        if enabled:
            gc.enable()
