"""Error against run time over three decades of steps, beyond the ladder over which order is judged."""

from collections import defaultdict
from collections.abc import Callable, Mapping
from typing import Any

from .adapters import registry, runner
from .adapters.engine import Engine, Scheme
from .adapters.simulate import simulate
from .adapters.timing import Timing
from .plan import Plan
from .reports.cell import Cell
from .reports.results import Key, precision_rows, with_time
from .scenarios.registry import scenes
from .scenarios.scene import Scene

#: Steps of a wide ladder, each half the one before: three decades.
RUNGS = 11
#: How many of them are coarser than the scene's own ladder, where there is room between two samples.
COARSER = 2
#: Longest run time [s] of one cell: a finer step is left out.
LONGEST = 1.0


def wide_ladder(scene: Scene, scheme: Scheme) -> tuple[float, ...]:
    """Steps [s] of a scheme over three decades around its own ladder, each half the one before."""
    own = max(scene.ladder(scheme.order, scheme.twin))
    coarsest = scene.steps_per_sample(min(own * 2**COARSER, scene.duration))
    return tuple(scene.duration / scene.samples / (coarsest * 2**rung) for rung in range(RUNGS))


def affordable(scene: Scene, scheme: Scheme, seconds_per_step: float) -> tuple[float, ...]:
    """The steps [s] of the wide ladder at which a run takes no longer than ``LONGEST``."""
    return tuple(
        dt
        for dt in wide_ladder(scene, scheme)
        if scene.samples * scene.steps_per_sample(dt) * seconds_per_step <= LONGEST and not scene.unfit(dt)
    )


def rows(scene: Scene, engine: type[Engine], scheme: Scheme, dt: float) -> list[dict[str, Any]]:
    """Rows without times of one cell, run here, held against the truth and not logged.

    Raises what ``simulate`` raises.
    """
    trajectory, _ = simulate(scene, engine, scheme, dt)
    return precision_rows([Cell.of(trajectory, {scene.full_name: scene})], {})


def beyond(
    laid: Plan,
    timings: Mapping[Key, Timing],
    workers: int,
    time_limit: float,
    progress: Callable[[str, int, int], None],
) -> tuple[list[dict[str, Any]], list[str]]:
    """What the plan leaves out of the wide ladder of each scheme that was timed, with the time of its steps.

    Rows, marked as not judged, and sentences on what is not there.
    """
    times, short = _wanted(laid, timings)
    found, broken = list[dict[str, Any]](), defaultdict[tuple[str, str, str], list[str]](list)
    for done, (request, result) in enumerate(
        runner.isolated(_rows, list(times), (), workers, time_limit), start=1
    ):
        progress("steps beyond the ladders", done, len(times))
        if isinstance(result, str):
            broken[request.engine, request.scheme, result].append(f"{request.scene} ({request.dt:.2g} s)")
        else:
            found += [with_time(row, times[request]) | {"judged": False} for row in result]
    found.sort(key=lambda row: (row["scene"], row["engine"], row["scheme"], -row["dt"]))
    failed = [
        f"Error over run time, {engine} {scheme}: {said} in {', '.join(where)}."
        for (engine, scheme, said), where in broken.items()
    ]
    return found, short + failed


def _wanted(
    laid: Plan, timings: Mapping[Key, Timing]
) -> tuple[dict[runner.Request, dict[str, Any]], list[str]]:
    """Each cell to run, with its time; and a sentence on the ladders of each scheme that are cut short."""
    times, short = dict[runner.Request, dict[str, Any]](), defaultdict[str, list[str]](list)
    ladders: dict[tuple[str, str, str], tuple[runner.Request, Timing]] = {}
    for key, timing in timings.items():
        ladders.setdefault(key[:3], (laid.requests[key], timing))
    for ladder, (request, timing) in ladders.items():
        scene, scheme = scenes()[ladder[0]], registry.scheme_of(registry.load(request.engine), request.scheme)
        taken = affordable(scene, scheme, timing.least / timing.steps)
        if len(taken) < RUNGS:
            short[f"{ladder[1]} {ladder[2]}"].append(f"{scene.full_name} {len(taken)}")
        there = [key[3] for key in laid.requests if key[:3] == ladder]
        for dt in taken:
            if not any(abs(dt / other - 1) < 1e-9 for other in there):
                cell = runner.Request(scene.full_name, request.engine, scheme.name, dt)
                steps = scene.samples * scene.steps_per_sample(dt)
                times[cell] = timing.of(steps).as_row()
    return times, [
        f"Error over run time, {scheme}: fewer than {RUNGS} steps where a run would take over {LONGEST:g} s: "
        f"{', '.join(names)}."
        for scheme, names in short.items()
    ]


def _rows(request: runner.Request) -> list[dict[str, Any]]:
    engine = registry.load(request.engine)
    return rows(scenes()[request.scene], engine, registry.scheme_of(engine, request.scheme), request.dt)
