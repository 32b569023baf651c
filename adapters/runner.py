"""Many cells, each in a child process with a time limit: one that dies takes no other with it."""

import multiprocessing
import os
import re
import signal
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Future, as_completed
from concurrent.futures import TimeoutError as TimeLimitError
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal, TypeVar

from pebble import ProcessExpired, ProcessPool

from ..reference.errors import PoinsotError
from ..scenarios.registry import scenes
from . import log, memory, registry, spent
from .one_thread import one_thread_each
from .simulate import simulate
from .timing import Timing, timed

#: What is asked of a child process.
Asked = TypeVar("Asked")


@dataclass(frozen=True)
class Request:
    """One cell to run, ``repeats`` times; ``engine`` is what ``registry.load`` takes.

    ``asked`` tells whether the engine's accelerations and its largest stable step are wanted as well.
    """

    scene: str
    engine: str
    scheme: str
    dt: float
    repeats: int = 1
    asked: bool = False


class Failure(str):
    """Why a piece of work gave no result, in a sentence; ``cause`` tells what kind of end it came to."""

    cause: Literal["time limit", "death", "error"]

    def __new__(cls, text: str, cause: Literal["time limit", "death", "error"]) -> "Failure":
        """The sentence, with its cause."""
        made = super().__new__(cls, text)
        made.cause = cause
        return made


@dataclass(frozen=True)
class Outcome:
    """What became of a request: the name of its log, or why there is none; the memory [bytes] it took.

    ``spent`` [s] is what the processor took for each part of it.
    """

    request: Request
    log: str | None = None
    error: str = ""
    memory: int | None = None
    spent: Mapping[str, float] = field(default_factory=dict)


def run(
    requests: Sequence[Request],
    folder: Path,
    workers: int,
    time_limit: float,
    progress: Callable[[Outcome], None] = lambda outcome: None,
) -> list[Outcome]:
    """Run every request, its log written into ``folder``; outcomes in the order of the requests.

    ``time_limit`` [s] is for one cell. ``progress`` is told of each outcome as it comes.
    """
    folder.mkdir(parents=True, exist_ok=True)
    outcomes: dict[Request, Outcome] = {}
    for request, result in isolated(_logged, requests, (folder,), workers, time_limit):
        failed = isinstance(result, str)
        outcomes[request] = (
            Outcome(request, error=result) if failed else Outcome(request, result[0], "", *result[1:])
        )
        progress(outcomes[request])
    return [outcomes[request] for request in requests]


def time(
    requests: Sequence[Request],
    time_limit: float,
    progress: Callable[[Request], None] = lambda request: None,
) -> dict[Request, Timing | str]:
    """Time every request, one after the other, in one process on one core: a timing or what went wrong."""
    results: dict[Request, Timing | str] = {}
    for request, result in isolated(_timed, requests, (), 1, time_limit):
        results[request] = result
        progress(request)
    return results


def file_name(request: Request) -> str:
    """Name of a cell's log: readable, and safe on any file system."""
    text = f"{request.scene}-{request.engine}-{request.scheme}-{request.dt:.9g}"
    return re.sub(r"[^A-Za-z0-9.+-]+", "_", text.replace("[", "-").replace("]", "")) + ".mcap"


def isolated(
    work: Callable[..., Any],
    requests: Iterable[Asked],
    arguments: tuple[Any, ...],
    workers: int,
    time_limit: float,
) -> Iterator[tuple[Asked, Any]]:
    """Results of ``work(request, *arguments)``, or a ``Failure`` for each that has none, as they come.

    Each is worked on in a child process for ``time_limit`` [s] at most; ``work`` must have a name of its own.
    """
    with one_thread_each():
        pool = ProcessPool(max_workers=workers, context=multiprocessing.get_context("spawn"))
        origin: dict[Future[Any], Asked] = {
            pool.schedule(work, (request, *arguments), timeout=time_limit): request for request in requests
        }
        try:
            for future in as_completed(origin):
                yield origin[future], _result(future, time_limit)
        finally:
            # Whoever stops asking, by an interrupt for one, wants nothing of what is still under way.
            pool.stop()  # type: ignore[no-untyped-call]
            pool.join()


def _result(future: Future[Any], time_limit: float) -> Any:
    """What a piece of work came to, or how it failed."""
    try:
        return future.result()
    except TimeLimitError:
        return Failure(f"took longer than the time limit of {time_limit:g} s and was stopped", "time limit")
    except ProcessExpired as death:
        return Failure(f"its process died ({_cause(death.exitcode)})", "death")
    except PoinsotError as error:
        return Failure(str(error), "error")
    except Exception as error:  # an engine may raise anything; it must not end the run
        return Failure(f"{type(error).__name__}: {error}", "error")


def _logged(request: Request, folder: Path) -> tuple[str, int | None, dict[str, float]]:
    memory.forget()
    spent.forget()
    with spent.on("loading"):
        engine = registry.load(request.engine)
    scene, scheme = scenes()[request.scene], registry.scheme_of(engine, request.scheme)
    trajectory, model = simulate(scene, engine, scheme, request.dt, request.repeats, request.asked)
    path = folder / file_name(request)
    with spent.on("logging"):
        log.write(path, scene, trajectory, model)
    return path.name, memory.peak(), spent.so_far()


def _timed(request: Request) -> Timing:
    engine = registry.load(request.engine)
    return timed(scenes()[request.scene], engine, registry.scheme_of(engine, request.scheme), request.dt)


def _cause(exit_code: int) -> str:
    if exit_code < 0:
        return f"signal {-exit_code}, {signal.Signals(-exit_code).name}"
    return f"exit code {exit_code}"


def cores() -> int:
    """How many cores this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
