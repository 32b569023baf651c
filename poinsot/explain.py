"""A known deviation seen once more, and how its engine's maintainers can see it without Poinsot."""

from collections.abc import Iterator
from itertools import groupby

from . import reproduction
from .adapters import registry
from .adapters.engine import Engine, Scheme
from .adapters.simulate import simulate, unsupported
from .reference.errors import InputError
from .reports.deviations import Deviation, recorded
from .reports.judge import judge
from .reports.verdict import Verdict
from .scenarios.registry import scenes
from .scenarios.scene import Scene
from .scenarios.trajectory import Trajectory


def listed() -> str:
    """Every known deviation with its number, in words; a reason is said once for all that it is behind."""
    lines: list[str] = []
    for (place, reason), found in groupby(enumerate(recorded(), start=1), lambda each: _said(each[1])):
        checks = [f"{number}. {entry.check} of {entry.observable}" for number, entry in found]
        lines += [f"{place}: {reason}", f"   {'; '.join(checks)}"]
    return "\n".join(lines) or "no known deviations"


def explained(number: int) -> str:
    """One known deviation: its record, what is measured now, and a script that shows it.

    Raises ``InputError`` for a number that none has, ``UnavailableError`` if its engine is not installed.
    """
    entries = recorded()
    if not 1 <= number <= len(entries):
        raise InputError(
            f"explain: got {number}, expected a number from 1 to {len(entries)}; `poinsot explain` lists them"
        )
    entry = entries[number - 1]
    engine = registry.load(entry.engine)
    scene, scheme, dt = _cell(entry, engine)
    verdicts = [v for v in judge(_runs(entry, scene, engine, scheme, dt), known=()) if entry.applies(v)]
    worst = max(verdicts, key=lambda verdict: verdict.measured or 0.0, default=None)
    return "\n".join(
        [
            f"{number}. {_title(entry)}",
            "",
            f"Recorded: {_said(entry)[1]}.",
            f"Granted: up to {entry.bound:g}, of {entry.engine} {entry.versions}.",
            _measured(worst, scene, engine, scheme, dt),
            "",
            "To see it without Poinsot:" if reproduction.stands_alone(scene, engine) else "To see it again:",
            "",
            reproduction.script(scene, engine, scheme, dt),
        ]
    )


def _said(entry: Deviation) -> tuple[str, str]:
    """Where an entry is seen, and its reason on one line."""
    return f"{entry.engine} {entry.scheme} in {entry.scene}", " ".join(entry.reason.split())


def _title(entry: Deviation) -> str:
    return f"{_said(entry)[0]}: {entry.check} of {entry.observable}"


def _cell(entry: Deviation, engine: type[Engine]) -> tuple[Scene, Scheme, float]:
    """The finest step that the entry speaks of, in the first scene and scheme that it does."""
    for scene in scenes().values():
        for scheme in engine.schemes:
            if entry.speaks_of(scene.full_name, engine.name, engine.version(), scheme.name):
                ladder = (*scene.ladder(scheme.order, scheme.twin), scene.dt)
                steps = [dt for dt in map(scene.whole_step, ladder) if dt <= entry.dt]
                if steps and not unsupported(scene, engine, scheme):
                    return scene, scheme, min(steps)
    raise InputError(
        f"explain: the record speaks of {entry.engine} {entry.versions} {entry.scheme} in {entry.scene}, "
        f"which {engine.name} {engine.version()} does not run"
    )


def _runs(
    entry: Deviation, scene: Scene, engine: type[Engine], scheme: Scheme, dt: float
) -> Iterator[Trajectory]:
    """The cell itself, the rest of its ladder where that matters, or the cells of its twins."""
    steps = [dt]
    if entry.check == "order" or entry.observable.endswith("limit"):
        steps = [scene.whole_step(step) for step in scene.ladder(scheme.order, scheme.twin)]
    yield from (simulate(scene, engine, scheme, step, repeats=2)[0] for step in steps)
    if entry.check == "twin":
        for other in registry.engines().values():
            if not isinstance(other, str) and other.name != engine.name:
                twins = (one for one in other.schemes if one.twin == scheme.twin)
                yield from (
                    simulate(scene, other, one, dt)[0] for one in twins if not unsupported(scene, other, one)
                )


def _measured(worst: Verdict | None, scene: Scene, engine: type[Engine], scheme: Scheme, dt: float) -> str:
    place = f"{engine.name} {engine.version()} {scheme.name} in {scene.full_name} at dt {dt:g} s"
    if worst is None or worst.measured is None:
        return f"Now: {place} could not be judged; its twins may not be installed."
    when = "" if worst.at is None else f", at t = {worst.at:g} s"
    allowed = "" if worst.allowed is None else f", {worst.allowed:.3g} allowed"
    return f"Now: {worst.measured:.3g} {worst.unit}{allowed}{when}: {place}: {worst.message}."
