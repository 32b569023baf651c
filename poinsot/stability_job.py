"""Stability maps and limits: families of scenes swept in every scheme, in child processes."""

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from .adapters import registry, runner
from .adapters.engine import Engine, Scheme
from .adapters.environment import environment
from .adapters.observed import observe
from .adapters.runner import Failure
from .adapters.simulate import unsupported
from .adapters.stable_step import StableStep, stable_step
from .main_job import Progress
from .reference.errors import InputError
from .reference.spelling import nearest
from .reports import deviations, stability, stability_results, stored
from .reports.outcomes import LONGEST, Found, Outcome, judged
from .reports.stability_results import Sweep
from .reports.verdict import Verdict
from .scenarios.families import Family, select
from .scenarios.scene import Scene


@dataclass(frozen=True)
class Point:
    """One run at one value of a family's parameter and one step [s]; no step: its largest stable one."""

    family: str
    value: float
    engine: str
    scheme: str
    dt: float | None


@dataclass(frozen=True)
class Laid:
    """What a sweep consists of: a map of each family in each scheme, and the points of all of them."""

    families: Sequence[Family]
    sweeps: Sequence[Sweep]
    points: Sequence[Point]
    names: Mapping[str, str]
    notes: Sequence[str]


def lay(families: Sequence[Family], engines: Sequence[str], schemes: Sequence[str]) -> Laid:
    """Lay out families × engines × schemes; none named means all that there are.

    Raises ``InputError`` for a scheme that no engine has, ``UnavailableError`` for an engine that was named
    and is not installed.
    """
    found, notes = _engines(engines)
    valid = list(dict.fromkeys(scheme.name for engine in found.values() for scheme in engine.schemes))
    for name in schemes:
        if name not in valid:
            raise InputError(f"scheme: got {name!r}; {nearest(name, valid)}")
    chosen = [
        (family, spec, engine, scheme)
        for family in families
        for spec, engine in found.items()
        for scheme in engine.schemes
        if not schemes or scheme.name in schemes
    ]
    sweeps = [Sweep(f.name, e.name, e.version(), scheme.name, scheme.twin) for f, _, e, scheme in chosen]
    points = [point for each in chosen for point in _points(*each)]
    # Limits take longest: no worker is left with one while the others have nothing to do.
    points.sort(key=lambda point: point.dt is not None)
    return Laid(families, sweeps, points, {spec: engine.name for spec, engine in found.items()}, notes)


def run(
    laid: Laid, folder: Path, command: str, workers: int, time_limit: float, progress: Progress
) -> dict[str, Any]:
    """Sweep what was laid out; the results, as written to ``folder`` with their page."""
    from .reports import stability_page  # jinja2 loads only when there is something to show

    by_sweep: dict[tuple[str, str, str], dict[Point, Any]] = defaultdict(dict)
    worked = runner.isolated(_worked, laid.points, (), workers, time_limit)
    for done, (point, result) in enumerate(worked, start=1):
        by_sweep[point.family, laid.names[point.engine], point.scheme][point] = result
        progress("sweeping", done, len(laid.points))
    for sweep in laid.sweeps:
        _fill(sweep, by_sweep[sweep.key])
    every = [verdict for sweep in laid.sweeps for verdict in _verdicts(sweep)]
    verdicts = deviations.applied(every, deviations.recorded())
    facts = environment() | {"command": command}
    results = stability_results.results(laid.families, laid.sweeps, verdicts, facts, laid.notes)
    stored.write(folder / "stability.json", results)
    stability_page.render(results, folder / "stability.html")
    return results


def _engines(specs: Sequence[str]) -> tuple[dict[str, type[Engine]], list[str]]:
    """Each engine asked for, or all that are installed, and a note on each that is not."""
    if specs:
        return {spec: registry.load(spec) for spec in specs}, []
    every = registry.engines()
    found = {name: engine for name, engine in every.items() if not isinstance(engine, str)}
    return found, [reason for reason in every.values() if isinstance(reason, str)]


def _points(family: Family, spec: str, engine: type[Engine], scheme: Scheme) -> list[Point]:
    """Every point of a map, and the limits that theory knows; none where the scheme cannot run the family."""
    scenes = {value: family.scene(value) for value in family.values}
    if any(unsupported(scene, engine, scheme) for scene in scenes.values()):
        return []
    limits = [
        Point(family.name, value, spec, scheme.name, None)
        for value, scene in scenes.items()
        if _theory(scene, scheme.twin) is not None
    ]
    return limits + [
        Point(family.name, value, spec, scheme.name, dt) for value in family.values for dt in family.steps
    ]


def _theory(scene: Scene, twin: str) -> float | None:
    return scene.stable_step(scene, twin) if scene.stable_step else None


def _worked(point: Point) -> Found | StableStep:
    """What becomes of a point, in a child process."""
    (family,), engine, scene = (
        select([point.family]),
        _loaded(point.engine),
        _scene(point.family, point.value),
    )
    scheme = registry.scheme_of(engine, point.scheme)
    if point.dt is not None:
        found = judged(scene, observe(scene, engine, scheme, point.dt, family.most))
        if found.doubtful and scene.duration / point.dt <= LONGEST:
            return judged(scene, observe(scene, engine, scheme, point.dt, LONGEST))
        return found
    machine = engine()
    try:
        return stable_step(machine, scene, scheme)
    finally:
        machine.close()


@cache
def _loaded(spec: str) -> type[Engine]:
    return registry.load(spec)


@cache
def _scene(family: str, value: float) -> Scene:
    return select([family])[0].scene(value)


def _fill(sweep: Sweep, results: dict[Point, Any]) -> None:
    for point, result in sorted(results.items(), key=lambda item: (item[0].value, item[0].dt or 0.0)):
        if point.dt is None:
            sweep.limits[point.value] = result
        else:
            found = _ended(result) if isinstance(result, Failure) else result
            sweep.points[point.value, point.dt] = found


def _ended(failure: Failure) -> Found:
    kinds = {"time limit": Outcome.TIMED_OUT, "death": Outcome.CRASHED, "error": Outcome.REFUSED}
    return Found(kinds[failure.cause], said=str(failure))


def _verdicts(sweep: Sweep) -> list[Verdict]:
    (family,) = select([sweep.family])
    scenes = {value: family.scene(value) for value in sweep.limits}
    return [
        stability.verdict(
            scenes[value].full_name, sweep, scenes[value].dt, limit, _theory(scenes[value], sweep.twin)
        )
        for value, limit in sweep.limits.items()
    ]
