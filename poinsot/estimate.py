"""How long a run will take, told before its first cell from what the same kinds of work took once.

`rates.toml` holds that, measured by ``benchmarks/run_cost.py``; what other engines take is guessed to be the
mean of those in it. All but the speed of the machine follows from the plan alone.
"""

import math
import os
import tomllib
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from time import perf_counter, process_time
from typing import Any, NamedTuple

from . import precision
from .adapters import registry
from .adapters.runner import Request
from .adapters.timing import REPEATS, SPAN, beat
from .plan import Extent, Plan, in_turn, to_time
from .reports.wording import count
from .scenarios.registry import scenes
from .scenarios.scene import Scene

#: How often the machine is looked at, two milliseconds each.
LOOKS = 15
#: What part of the whole must be behind us for the pace so far to count as much as the estimate.
TRUSTED = 0.1
#: From how many times longer on others are spoken of: what always runs beside takes less.
CROWDED = 1.25
#: What one process does, however many workers there are.
ALONE = "timing", "report"


class Work(NamedTuple):
    """What to expect of one cell: seconds of a step, of building it once, and of all of it."""

    step: float
    built: float
    whole: float


@dataclass(frozen=True)
class Estimate:
    """Seconds by the clock that each piece of each phase will take, in turn; phases as progress names them.

    ``pulse`` [s] is what tells how fast the machine is, ``crowding`` how many times longer all takes while
    other programs want its cores as now.
    """

    cells: int
    workers: int
    phases: Mapping[str, Sequence[float]]
    pulse: float
    crowding: float = 1.0

    @property
    def seconds(self) -> float:
        """The whole run, with the cores to itself."""
        return sum(map(sum, self.phases.values()))

    def left(self, phase: str, done: int, elapsed: float) -> float:
        """Seconds to go with ``done`` pieces of ``phase`` behind us, at the pace of ``elapsed`` [s]."""
        names = list(self.phases)
        at = names.index(phase) if phase in names else len(names)
        rest = sum(sum(self.phases[name]) for name in names[at + 1 :])
        rest += sum(self.phases[phase][done:]) if phase in names else 0.0
        trust = TRUSTED * self.seconds
        return rest * (elapsed + self.crowding * trust) / (self.seconds - rest + trust)

    def __str__(self) -> str:
        workers = count(self.workers, "worker")
        crowded = f"; {spoken(self.seconds * self.crowding)} while others keep it as busy as now"
        return f"{count(self.cells, 'cell')}, about {spoken(self.seconds)} with {workers} on this machine" + (
            crowded if self.crowding > CROWDED else ""
        )


def spoken(seconds: float) -> str:
    """A time in words, no more exact than an estimate is."""
    if seconds < 95:
        return f"{max(5, 5 * math.ceil(seconds / 5))} s"
    minutes, rest = divmod(10 * round(seconds / 10), 60)
    return f"{minutes} min" if minutes >= 10 or not rest else f"{minutes} min {rest} s"


def estimate(
    laid: Plan, workers: int, cores: int, with_timing: bool, pulse: float, others: float = 0.0
) -> Estimate:
    """What a plan will take on so many ``workers`` and ``cores`` of a machine with this ``pulse`` [s].

    ``others`` is how many more processes want a core.
    """
    rates = recorded()
    # On a machine that others share, the pulse is twice as long at one time as at another, whatever a run
    # takes: its root errs by no more than a third then, and no more where a machine is twice as fast.
    slow, at_once = (pulse / rates["pulse"]) ** 0.5, min(workers, cores)
    expected = {request: work(request) for request in laid.requests.values()}
    timed = [laid.requests[record.key] for record in to_time(laid, laid.records)] if with_timing else []
    by_scene = Counter(request.scene for request in expected).values()
    judging = rates["judging"]
    phases = {
        "simulating": _shared([expected[r].whole for r in in_turn(laid)], at_once),
        "timing": [rates["timing"]["factor"] * timing(scenes()[r.scene], r.dt, expected[r]) for r in timed],
        "steps beyond the ladders": _shared(_beyond(laid, timed), at_once),
        "judging": _shared([judging["scene"] + judging["cell"] * cells for cells in by_scene], at_once),
        "report": [rates["report"]["start"] + rates["report"]["cell"] * len(laid.records)],
    }
    scaled = {name: [piece * slow for piece in pieces] for name, pieces in phases.items() if pieces}
    busy = {name: 1 if name in ALONE else at_once for name in scaled}
    crowded = sum(sum(pieces) * max(1.0, (others + busy[name]) / cores) for name, pieces in scaled.items())
    alone = sum(map(sum, scaled.values()))
    return Estimate(len(laid.requests), workers, scaled, pulse, crowded / alone)


def machine(cores: int) -> tuple[float, float]:
    """Time [s] of a fixed piece of work here, undisturbed, and how many other processes want a core now."""
    pulses, running = [], []
    clock, processor = perf_counter(), process_time()
    for _ in range(LOOKS):
        pulses.append(beat())
        running.append(_running())
    share = (process_time() - processor) / (perf_counter() - clock)
    # Of the others that run, those that yield to us take less of a core: how much is left to us tells.
    return min(pulses), min(_mean(running), cores / share - 1)


def _running() -> float:
    """How many processes beside this one run, at this moment if the system tells, or in the last minute."""
    now = Path("/proc/loadavg")
    if now.is_file():
        return int(now.read_text(encoding="ascii").split()[3].partition("/")[0]) - 1
    return os.getloadavg()[0] if hasattr(os, "getloadavg") else 0.0


def kind(scene: Scene) -> str:
    """What a step of this scene costs by: forces and contacts take longer than all the rest."""
    return "contact" if scene.contacts else "force" if "force" in scene.features else "plain"


def work(request: Request) -> Work:
    """What to expect of a cell."""
    scene = scenes()[request.scene]
    cell, name = _rate("cell", request.engine), f"{request.engine} {request.scheme}"
    step = _rate("step", name)[kind(scene)]
    stepping = scene.samples * scene.steps_per_sample(request.dt) * step
    looking = scene.samples * cell["sample"]
    whole = cell["whole"] + request.repeats * (stepping + looking)
    whole += cell["repeated"] * (request.repeats - 1)
    if request.asked:
        whole += cell["asked"] + (cell["stable"] if scene.stable_step else 0.0)
    return Work(step, cell["built"], whole)


@cache
def recorded() -> dict[str, Any]:
    """The rates of `rates.toml`."""
    return tomllib.loads((Path(__file__).parent / "rates.toml").read_text(encoding="utf-8"))


@cache
def _rate(table: str, name: str) -> dict[str, float]:
    """The rates of an engine or scheme; the mean of all for those it has none of."""
    known: dict[str, dict[str, float]] = recorded()[table]
    every = {part for rates in known.values() for part in rates}
    means = {part: _mean([rates[part] for rates in known.values() if part in rates]) for part in every}
    return means | known.get(name, {})


def _mean(values: Sequence[float]) -> float:
    return sum(values) / len(values)


def _shared(pieces: Sequence[float], at_once: int) -> list[float]:
    """Pieces that so many processes work on at once, the start of the processes in the first of them."""
    if not pieces:
        return []
    share = [piece / min(at_once, len(pieces)) for piece in pieces]
    return [recorded()["start"] + share[0], *share[1:]]


def timing(scene: Scene, dt: float, expected: Work) -> float:
    """Seconds that timing a cell takes if none of its repeats is disturbed."""
    run = scene.samples * scene.steps_per_sample(dt) * expected.step
    once = min(SPAN, run)
    builds = REPEATS if scene.contacts else math.ceil(REPEATS / (run / once))
    return (1 + builds) * expected.built + (1 + REPEATS) * once


def _beyond(laid: Plan, timed: Sequence[Request]) -> list[float]:
    """Seconds of each cell that a full run adds to the ladders of what is timed."""
    if laid.extent is not Extent.FULL:
        return []
    ladders: dict[tuple[str, str, str], set[float]] = {}
    for request in timed:
        ladders.setdefault((request.scene, request.engine, request.scheme), set()).add(request.dt)
    return [
        work(Request(name, engine, scheme, dt)).whole + float(recorded()["judging"]["cell"])
        for (name, engine, scheme), there in ladders.items()
        for dt in _wide(name, engine, scheme)
        if not any(abs(dt / other - 1) < 1e-9 for other in there)
    ]


def _wide(name: str, engine: str, scheme: str) -> tuple[float, ...]:
    """The steps [s] of a wide ladder that are short enough."""
    scene, step = scenes()[name], work(Request(name, engine, scheme, scenes()[name].dt)).step
    return precision.affordable(scene, registry.scheme_of(registry.load(engine), scheme), step)
