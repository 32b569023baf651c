"""Which cells a run consists of, and which it must leave out, with the reason."""

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import Enum
from math import log2

from .adapters import registry
from .adapters.engine import Engine, Scheme, settings_in
from .adapters.runner import Request
from .adapters.simulate import unsupported
from .reference.checked import positive
from .reference.errors import InputError
from .reference.spelling import nearest
from .reports.results import CellRecord
from .reports.verdict import Status
from .reports.wording import count
from .scenarios.registry import scenes as all_scenes
from .scenarios.scene import Scene

#: How often the cell nearest to the scene's own step is run, where its determinism is to be judged.
REPEATS = 2


class Extent(Enum):
    """How much of every scene a run takes in: its variants, and steps beside its own."""

    QUICK = "each scene at its own step, once: orders, limits, errors over the step, determinism are left out"
    USUAL = (
        "ladders, and a second run for the same bits, of the first variant of each scene; `--full` takes "
        "those of all variants"
    )
    WHOLE = "every variant over its ladders"
    FULL = (
        "every variant over its ladders, and the error over run time over three decades of steps, in the "
        "first variant of each scene"
    )


@dataclass
class Plan:
    """Cells in the order of the report; those with a request will be run, the others cannot be."""

    records: list[CellRecord] = field(default_factory=list)
    requests: dict[tuple[str, str, str, float], Request] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    #: What to say before a run: of engines that borrow a name, of steps that do not fit everywhere.
    adjusted: list[str] = field(default_factory=list)
    #: Whether nothing is missing, scene, engine, scheme or step: every record must then find its check.
    whole: bool = False
    extent: Extent = Extent.WHOLE


def plan(
    scenes: Sequence[Scene],
    engines: Sequence[str],
    schemes: Sequence[str],
    steps: Sequence[float],
    extent: Extent = Extent.WHOLE,
) -> Plan:
    """Lay out scenes × engines × schemes × steps.

    No engines means all that Poinsot knows, no schemes all of theirs, no steps the scene's own step and,
    as far as the ``extent`` goes, each scheme's ladder. Raises ``InputError`` for a scheme that no
    engine has, for a step that cannot be and where none fits any scene, ``UnavailableError`` for an
    engine that was named and is not installed.
    """
    found, laid = _engines(engines), Plan(extent=extent)
    first = {scene.name: scene.full_name for scene in reversed(scenes)}
    if extent is Extent.QUICK and len(scenes) == len(all_scenes()):
        scenes = [scene for scene in scenes if first[scene.name] == scene.full_name]
        laid.notes.append("Of every scene the first variant alone was run; of one that is named, all are.")
    loaded = {spec: engine for spec, engine in found.items() if not isinstance(engine, str)}
    _check_schemes(schemes, loaded)
    borrowed = [
        f"engine {spec} has the name of Poinsot's own {engine.name!r}: what is on record of that engine is "
        "granted to this one as well"
        for spec, engine in loaded.items()
        if ":" in spec and engine.name in registry.names()
    ]
    laid.notes += borrowed
    laid.adjusted = borrowed + _adjusted(scenes, steps)
    for scene in scenes:
        for spec, engine in found.items():
            if isinstance(engine, str):
                laid.records.append(_left_out(scene, spec, Status.UNAVAILABLE, engine))
                continue
            for scheme in engine.schemes:
                if not schemes or scheme.name in schemes:
                    is_first = extent is Extent.USUAL and first[scene.name] == scene.full_name
                    twice = bool(steps) or is_first or extent in (Extent.WHOLE, Extent.FULL)
                    wanted = steps or _wanted(scene, scheme, extent, first)
                    _add(laid, scene, spec, engine, scheme, wanted, twice)
    everything = len(scenes) == len(all_scenes()) and len(loaded) == len(registry.names())
    laid.whole = everything and not (schemes or steps)
    if steps:
        laid.notes.append("Only the steps asked for were run; order needs a ladder of at least five.")
    elif extent in (Extent.QUICK, Extent.USUAL):
        laid.notes.append(f"This is a {extent.name.lower()} run: {extent.value}.")
    return laid


def in_turn(laid: Plan) -> list[Request]:
    """What is to be run, the finest steps first: no worker is left alone with a long cell at the end."""
    return sorted(laid.requests.values(), key=lambda request: request.dt)


def to_time(laid: Plan, records: Sequence[CellRecord]) -> list[CellRecord]:
    """Which of ``records`` to time: those of one variant of each scene, as most others only start elsewhere.

    Unless the run is a full one, one step of each scheme is timed, and the others take its time a step.
    """
    first = _first_variants(laid)
    sound = [r for r in records if r.key in laid.requests and r.scene in first]
    ladders = defaultdict[tuple[str, str, str], list[float]](list)
    for record in sound:
        ladders[record.key[:3]].append(record.dt)
    every = laid.extent in (Extent.WHOLE, Extent.FULL)
    return [r for r in sound if every or r.dt == _own_step(r.scene, ladders[r.key[:3]])]


def not_to_time(laid: Plan) -> list[str]:
    """A sentence on the variants that ``to_time`` leaves out, if there are any."""
    every, first = {record.scene for record in laid.records}, _first_variants(laid)
    if every == first:
        return []
    what = "Run times, and errors over them," if laid.extent is Extent.FULL else "Run times"
    return [
        f"{what} are those of the first variant of each scene: the others "
        f"({len(every - first)} of {len(every)}), most of which only start elsewhere and take "
        "as long a step, were not timed."
    ]


def _first_variants(laid: Plan) -> set[str]:
    first: dict[str, str] = {}
    for record in laid.records:
        first.setdefault(all_scenes()[record.scene].name, record.scene)
    return set(first.values())


def _own_step(scene: str, steps: Sequence[float]) -> float:
    """Which of ``steps`` [s] is nearest to the scene's own."""
    return min(steps, key=lambda step: abs(log2(step / all_scenes()[scene].dt)))


def _engines(specs: Sequence[str]) -> dict[str, type[Engine] | str]:
    """Each engine asked for, or all there are; one that was named must be installed, no two share a name."""
    found: dict[str, type[Engine] | str] = {spec: registry.load(spec) for spec in specs}
    found = found or registry.engines()
    named = dict[str, str]()
    for spec, engine in found.items():
        if not isinstance(engine, str) and spec != (other := named.setdefault(engine.name, spec)):
            raise InputError(f"engine: got {other!r} and {spec!r}, both named {engine.name!r}; rename one")
    return found


def _check_schemes(schemes: Sequence[str], engines: dict[str, type[Engine]]) -> None:
    valid = list(dict.fromkeys(scheme.name for engine in engines.values() for scheme in engine.schemes))
    for name in schemes:
        if name not in valid:
            raise InputError(f"scheme: got {name!r}; {nearest(name, valid)}")


def _add(
    laid: Plan,
    scene: Scene,
    spec: str,
    engine: type[Engine],
    scheme: Scheme,
    steps: Sequence[float],
    twice: bool,
) -> None:
    reason = unsupported(scene, engine, scheme)
    if reason:
        laid.records.append(_without(scene, engine, scheme, scene.dt, reason))
        return
    taken = _steps(scene, steps)
    own = _own_step(scene.full_name, [dt for dt in taken if not scene.unfit(dt)] or [scene.dt])
    for dt, asked in taken.items():
        laid.notes += [
            f"{scene.full_name}: dt {other:g} s rounded to {dt:g} s, whole steps between samples."
            for other in asked
            if other != dt
        ]
        if reason := scene.unfit(dt):
            laid.records.append(_without(scene, engine, scheme, dt, reason))
            continue
        repeats = REPEATS if dt == own and twice else 1
        record = CellRecord(
            scene=scene.full_name,
            engine=engine.name,
            engine_version=engine.version(),
            scheme=scheme.name,
            twin=scheme.twin,
            order=scheme.order,
            dt=dt,
            steps=scene.samples * scene.steps_per_sample(dt),
            settings=settings_in(engine, scene),
        )
        laid.records.append(record)
        laid.requests[record.key] = Request(scene.full_name, spec, scheme.name, dt, repeats, dt == own)


def _wanted(scene: Scene, scheme: Scheme, extent: Extent, first: Mapping[str, str]) -> tuple[float, ...]:
    """Steps [s] of one scheme in one scene where none was asked for."""
    every = extent in (Extent.WHOLE, Extent.FULL)
    has_ladder = every or (extent is Extent.USUAL and first[scene.name] == scene.full_name)
    return (*scene.ladder(scheme.order, scheme.twin), scene.dt) if has_ladder else (scene.dt,)


def _steps(scene: Scene, steps: Sequence[float]) -> dict[float, list[float]]:
    """The steps [s] to take, from the coarsest, each with those asked for that are rounded to it."""
    taken = defaultdict[float, list[float]](list)
    for dt in steps:
        taken[_nearest(scene, dt)].append(dt)
    return dict(sorted(taken.items(), reverse=True))


def _nearest(scene: Scene, dt: float) -> float:
    """The step [s] that ``dt`` is rounded to; one that is longer than the run stays, and is left out."""
    return dt if dt > scene.duration * (1 + 1e-12) else scene.whole_step(dt)


def _adjusted(scenes: Sequence[Scene], steps: Sequence[float]) -> list[str]:
    """A sentence on each step asked for that is rounded somewhere, and on each that is left out.

    Raises ``InputError`` for a step that is none, and where no scene has a use for any.
    """
    said, fits = list[str](), not steps
    for dt in steps:
        positive("dt", dt)
        taken = [(scene, _nearest(scene, dt)) for scene in scenes]
        reasons = [reason for scene, step in taken if (reason := scene.unfit(step))]
        rounded = {step for scene, step in taken if not scene.unfit(step)} - {dt}
        if rounded:
            ends = " to ".join(f"{end:g}" for end in sorted({min(rounded), max(rounded)}))
            said.append(f"dt {dt:g} s is rounded to whole steps between samples: {ends} s")
        if reasons:
            where = "" if len(scenes) == 1 else f" in {count(len(reasons), 'variant')} of {len(scenes)}"
            said.append(f"dt {dt:g} s is left out{where}: {reasons[0]}")
        fits = fits or len(reasons) < len(scenes)
    if not fits:
        raise InputError(f"dt: nothing is left to run; {'; '.join(said)}")
    return said


def _without(scene: Scene, engine: type[Engine], scheme: Scheme, dt: float, reason: str) -> CellRecord:
    """What cannot be run, of an engine that is there."""
    return replace(
        _left_out(scene, engine.name, Status.UNSUPPORTED, reason),
        engine_version=engine.version(),
        scheme=scheme.name,
        twin=scheme.twin,
        order=scheme.order,
        dt=dt,
    )


def _left_out(scene: Scene, engine: str, status: Status, reason: str) -> CellRecord:
    return CellRecord(scene.full_name, engine, "", "", "", 0, scene.dt, 0, status=status, message=reason)
