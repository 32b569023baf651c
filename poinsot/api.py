"""The public functions: what users' scripts call."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from .adapters import registry
from .adapters.engine import Engine, Scheme
from .adapters.simulate import simulate as _simulate
from .adapters.simulate import unsupported
from .adapters.timing import timed
from .precision import affordable, broken, looked, rows
from .reference.errors import PoinsotError
from .reports import judge as _judge
from .reports.results import with_time
from .reports.verdict import Verdict
from .scenarios.registry import scenes as _scenes
from .scenarios.registry import select
from .scenarios.scene import Scene
from .scenarios.trajectory import Trajectory


def scenes() -> dict[str, Scene]:
    """Every scene by its full name, ``scene[variant]``."""
    return dict(_scenes())


def engines() -> dict[str, type[Engine] | str]:
    """Every engine by name, or the reason why it is unavailable."""
    return registry.engines()


def simulate(
    scene: Scene | str, engine: type[Engine] | str, scheme: str | None = None, dt: float | None = None
) -> Trajectory:
    """Run ``scene`` in ``engine``, in this process.

    ``scene`` is a ``Scene`` or a full name, ``engine`` a class or what ``poinsot run --engine``
    takes; ``scheme`` is the engine's first unless named, ``dt`` [s] the scene's own, rounded to
    whole steps between samples. The run is made twice, so that determinism can be judged.

    Raises ``InputError`` for a name or a step that cannot be, ``UnsupportedError`` where the engine
    lacks a feature, ``UnavailableError`` where it is not installed, ``EngineError`` if it breaks down.
    """
    scene, engine = _scene(scene), _engine(engine)
    step = scene.dt if dt is None else dt
    trajectory, _ = _simulate(scene, engine, registry.scheme_of(engine, scheme), step, repeats=2)
    return trajectory


def judge(
    trajectories: Iterable[Trajectory] | Trajectory, scenes: Mapping[str, Scene] | None = None
) -> list[Verdict]:
    """Every verdict that one or many trajectories allow: order and twin need several.

    ``scenes`` are Poinsot's own unless given. Raises ``InputError`` for a trajectory of unknown origin.
    """
    many = [trajectories] if isinstance(trajectories, Trajectory) else trajectories
    return _judge.judge(many, scenes)


def work_precision(
    scene: Scene | str, engines: Sequence[type[Engine] | str] | type[Engine] | str | None = None
) -> list[dict[str, Any]]:
    """Error against run time of one scene: rows as in ``results.json``, over three decades of steps.

    ``engines`` are one or several, all that are installed unless given; a scheme that cannot run the scene
    has no rows, nor has a step at which one run takes over a second. Where an engine breaks down at a step,
    rows have no ``error`` (``None``) and no times, and a ``message`` that tells what it said: at the scene's
    own step, by which the others are timed, that is all there is of its scheme. Nothing is judged.
    Takes up to two seconds a scheme and step, one after the other, on one core.

    Raises ``InputError`` for a name that cannot be, ``UnavailableError`` for an engine that is not installed.
    """
    scene = _scene(scene)
    if engines is None:
        chosen = [engine for engine in registry.engines().values() if not isinstance(engine, str)]
    else:
        several = [engines] if isinstance(engines, (str, type)) else engines
        chosen = [_engine(engine) for engine in several]
    return [
        row
        for engine in chosen
        for scheme in engine.schemes
        if not unsupported(scene, engine, scheme)
        for row in _over_steps(scene, engine, scheme)
    ]


def _over_steps(scene: Scene, engine: type[Engine], scheme: Scheme) -> Iterator[dict[str, Any]]:
    """Rows of one scheme at each step of its wide ladder."""
    dt = scene.whole_step(scene.dt)
    try:
        each = timed(scene, engine, scheme, dt)
    except Exception as error:  # as below
        yield from broken(scene, engine, scheme, dt, _said(error))
        return
    for dt in affordable(scene, scheme, each.least / each.steps):
        try:
            timing = timed(looked(scene, dt), engine, scheme, dt).as_row()
            found = [with_time(row, timing) for row in rows(scene, engine, scheme, dt)]
        except Exception as error:  # an engine may raise anything; one step must not take the others with it
            found = broken(scene, engine, scheme, dt, _said(error))
        yield from found


def _said(error: Exception) -> str:
    return str(error) if isinstance(error, PoinsotError) else f"{type(error).__name__}: {error}"


def _scene(scene: Scene | str) -> Scene:
    return scene if isinstance(scene, Scene) else select([scene])[0]


def _engine(engine: type[Engine] | str) -> type[Engine]:
    return registry.load(engine) if isinstance(engine, str) else engine
