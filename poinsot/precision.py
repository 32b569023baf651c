"""Error against run time over three decades of steps, beyond the ladder over which order is judged."""

from collections import defaultdict
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import lru_cache
from typing import Any

from .adapters import registry, runner
from .adapters.engine import Engine, Scheme
from .adapters.simulate import simulate
from .adapters.timing import Timing
from .plan import Plan
from .reports.cell import Cell
from .reports.results import Key, broken_rows, precision_rows, with_time
from .scenarios.registry import scenes
from .scenarios.scene import Scene

#: Steps of a wide ladder that end at each look or sooner, each half the one before: three decades.
RUNGS = 11
#: How many of them are coarser than the scene's own ladder, where there is room between two samples.
COARSER = 2
#: No step is longer than so many times the time between two samples.
SELDOM = 8
#: Fewest looks at a run whose steps are longer than that time.
LOOKS = 5
#: Longest run time [s] of one cell: a finer step is left out.
LONGEST = 1.0


def wide_ladder(scene: Scene, scheme: Scheme) -> tuple[float, ...]:
    """Steps [s] of a scheme over three decades around its own ladder, each at most half the one before.

    Where a step from one sample to the next is among them, longer ones follow: of most schemes of fourth
    order that step is nearer than many a user needs. Not where bodies touch or are struck, which
    happens at looks or between them.
    """
    own = max(scene.ladder(scheme.order, scheme.twin))
    fewest = scene.steps_per_sample(min(own * 2**COARSER, scene.duration))
    sample = scene.duration / scene.samples
    longer = _every(scene) if fewest == 1 and not (scene.contacts or "blow" in scene.features) else []
    return (
        *(sample * every for every in reversed(longer)),
        *(sample / (fewest * 2**rung) for rung in range(RUNGS)),
    )


def _every(scene: Scene) -> list[int]:
    """Every how manieth sample steps may come to, each at least twice the one before."""
    found = [1]
    for every in range(2, SELDOM + 1):
        fits = scene.samples % every == 0 and scene.samples // every >= LOOKS
        if fits and every >= 2 * found[-1]:
            found.append(every)
    return found[1:]


def looked(scene: Scene, dt: float) -> Scene:
    """The scene, looked at only after each step of ``dt`` [s] where that is longer than from look to look.

    Rates need the looks, so that of such a scene the states alone are observed.
    """
    every = round(dt * scene.samples / scene.duration)
    return scene if every <= 1 else _thinned(scene, every)


@lru_cache(maxsize=256)  # a scene is known by its identity: what is worked out about this one is kept
def _thinned(scene: Scene, every: int) -> Scene:
    states = tuple(observable for observable in scene.observables if observable.kind == "state")
    return replace(scene, samples=scene.samples // every, observables=states, errors={})


def steps(scene: Scene, dt: float) -> int:
    """Steps of ``dt`` [s] in a run of the scene, looked at no more often than after each."""
    scene = looked(scene, dt)
    return scene.samples * scene.steps_per_sample(dt)


def affordable(scene: Scene, scheme: Scheme, seconds_per_step: float) -> tuple[float, ...]:
    """The steps [s] of the wide ladder at which a run takes no longer than ``LONGEST``."""
    return tuple(
        dt
        for dt in wide_ladder(scene, scheme)
        if steps(scene, dt) * seconds_per_step <= LONGEST and not scene.unfit(dt)
    )


def rows(scene: Scene, engine: type[Engine], scheme: Scheme, dt: float) -> list[dict[str, Any]]:
    """Rows without times of one cell, run here, held against the truth, neither logged nor judged.

    Raises what ``simulate`` raises.
    """
    scene = looked(scene, dt)
    trajectory, _ = simulate(scene, engine, scheme, dt)
    found = precision_rows([Cell.of(trajectory, {scene.full_name: scene})], {})
    return [row | {"judged": False} for row in found]


def broken(
    scene: Scene, engine: type[Engine], scheme: Scheme, dt: float, message: str
) -> list[dict[str, Any]]:
    """Rows without errors and times of a cell that gave nothing, and why, as ``rows`` has them."""
    return broken_rows(looked(scene, dt), engine.name, engine.version(), scheme.name, dt, message)


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
    found, failed = list[dict[str, Any]](), defaultdict[str, list[str]](list)
    for done, (request, result) in enumerate(
        runner.isolated(_rows, list(times), (), workers, time_limit), start=1
    ):
        progress("steps beyond the ladders", done, len(times))
        if isinstance(result, str):
            engine = registry.load(request.engine)
            scheme = registry.scheme_of(engine, request.scheme)
            found += broken(scenes()[request.scene], engine, scheme, request.dt, result)
            failed[f"{engine.name} {scheme.name}"].append(f"{request.scene} {request.dt:.2g} s")
        else:
            found += [with_time(row, times[request]) for row in result]
    found.sort(key=lambda row: (row["scene"], row["engine"], row["scheme"], -row["dt"]))
    return found, short + [
        f"Error over run time, {scheme}: no error, for reasons that its rows tell, in {', '.join(where)}."
        for scheme, where in failed.items()
    ]


def _wanted(
    laid: Plan, timings: Mapping[Key, Timing]
) -> tuple[dict[runner.Request, dict[str, Any]], list[str]]:
    """Each cell to run, with its time; and a sentence on the ladders of each scheme that are cut short."""
    times, short = dict[runner.Request, dict[str, Any]](), defaultdict[str, list[str]](list)
    ladders: dict[tuple[str, str, str], tuple[runner.Request, Timing]] = {}
    for key, timing in sorted(timings.items(), key=lambda item: item[1].spread, reverse=True):
        ladders[key[:3]] = laid.requests[key], timing  # in the end the steadiest of each ladder
    for ladder, (request, timing) in ladders.items():
        scene, scheme = scenes()[ladder[0]], registry.scheme_of(registry.load(request.engine), request.scheme)
        taken = affordable(scene, scheme, timing.least / timing.steps)
        finest = steps(scene, wide_ladder(scene, scheme)[-1])
        if finest * timing.least / timing.steps > LONGEST:
            last = f"{min(taken):.2g} s" if taken else "none"
            short[f"{ladder[1]} {ladder[2]}"].append(f"{scene.full_name} at {last}")
        there = [key[3] for key in laid.requests if key[:3] == ladder]
        for dt in taken:
            if not any(abs(dt / other - 1) < 1e-9 for other in there):
                cell = runner.Request(scene.full_name, request.engine, scheme.name, dt)
                times[cell] = timing.of(steps(scene, dt)).as_row()
    return times, [
        f"Error over run time, {scheme}: steps end where a finer one would take over {LONGEST:g} s a run: "
        f"{', '.join(names)}."
        for scheme, names in short.items()
    ]


def _rows(request: runner.Request) -> list[dict[str, Any]]:
    engine = registry.load(request.engine)
    return rows(scenes()[request.scene], engine, registry.scheme_of(engine, request.scheme), request.dt)
