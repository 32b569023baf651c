"""The command line: ``poinsot run | stability | list | report | compare | explain | doctor``."""

import shlex
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Any

from cyclopts import App, CycloptsError, Parameter

from . import __version__
from .reference.errors import InputError, PoinsotError, UnavailableError
from .telling import remark, tell

app = App(
    name="poinsot",
    help="Cross-validate rigid-body physics engines against exact solutions and against each other.",
    version=__version__,
    suppress_keyboard_interrupt=False,
)

Names = Annotated[list[str] | None, Parameter(negative="", consume_multiple=False)]


@app.command
def run(
    *scene: str,
    engine: Names = None,
    scheme: Names = None,
    dt: Annotated[list[float] | None, Parameter(negative="", consume_multiple=False)] = None,
    out: Path | None = None,
    workers: int | None = None,
    time_limit: float = 300.0,
    timing: bool = True,
    quick: Annotated[bool, Parameter(negative="")] = False,
    full: Annotated[bool, Parameter(negative="")] = False,
    update_known: Annotated[bool, Parameter(negative="")] = False,
) -> int:
    """Run scenes in engines, log and judge them, and write a report.

    Parameters
    ----------
    scene
        Scenes, as `name` or `name[variant]`; all of them if none is named.
    engine
        An engine's name, `package.module:Class` or `path/to/file.py:Class`; may be repeated.
        All that are installed if none is named.
    scheme
        A scheme's name; may be repeated.
    dt
        A step [s] in place of each scheme's ladder; may be repeated.
    out
        Folder for the report and the logs, new or empty; otherwise a new dated one in poinsot-runs/.
    workers
        How many processes simulate at once; as many as there are cores if not said.
    time_limit
        Longest time [s] that one cell may take.
    timing
        Whether to time the engines after they have been simulated.
    quick
        The first variant of each scene at its own step alone, once: no ladders of steps, so no orders.
    full
        Ladders of steps of every variant; of the first, every step timed, and error over run time over three
        decades of steps. Of scenes that are named every ladder is run anyway; else those of the first
        variant of each scene.
    update_known
        Propose changes to the record of known deviations in known_deviations.proposed.toml beside the
        report. A new entry lacks its reason, which is for you to find; no bound is ever widened.
    """
    from .adapters.runner import cores
    from .estimate import estimate, machine
    from .main_job import output_folder
    from .main_job import run as run_all
    from .plan import Extent, plan
    from .progress import bar
    from .reports.results import exit_code
    from .scenarios.registry import select

    _check_limits(workers, time_limit)
    if quick and full:
        raise InputError("--quick, --full: got both, expected one of them or none")
    extent = Extent.QUICK if quick else Extent.FULL if full else Extent.WHOLE if scene else Extent.USUAL
    laid = plan(select(list(scene)), engine or [], scheme or [], dt or [], extent)
    folder = output_folder(out)
    command = shlex.join(["poinsot", *_arguments()])
    expected = estimate(laid, workers or cores(), cores(), timing, *machine(cores()))
    remark("\n".join([*laid.adjusted, str(expected)]))
    with bar(expected) as progress:
        found = run_all(laid, folder, command, workers or cores(), time_limit, timing, progress, expected)
    _show(found, folder)
    if update_known:
        _propose(found, folder)
    return exit_code(found)


@app.command
def stability(
    *family: str,
    engine: Names = None,
    scheme: Names = None,
    out: Path | None = None,
    workers: int | None = None,
    time_limit: float = 60.0,
) -> int:
    """Sweep families of scenes to their extremes: stability maps, and the largest stable step of each scheme.

    Runs of small steps are cut short, most of them after 4000 steps; `covered` in stability.json and a white
    corner in the maps say of which that may change the outcome.

    Parameters
    ----------
    family
        Families of scenes; all of them if none is named.
    engine
        An engine's name, `package.module:Class` or `path/to/file.py:Class`; may be repeated.
        All that are installed if none is named.
    scheme
        A scheme's name; may be repeated.
    out
        Folder for stability.json and stability.html, new or empty; otherwise a new dated one in
        poinsot-runs/.
    workers
        How many processes simulate at once; as many as there are cores if not said.
    time_limit
        Longest time [s] that one run, or the search for one limit, may take.
    """
    from .adapters.runner import cores
    from .listing import swept
    from .main_job import new_folder
    from .progress import bar
    from .reports.stability_results import exit_code
    from .scenarios.families import select
    from .stability_job import lay
    from .stability_job import run as sweep

    _check_limits(workers, time_limit)
    laid = lay(select(list(family)), engine or [], scheme or [])
    folder = new_folder(out)
    command = shlex.join(["poinsot", *_arguments()])
    with bar() as progress:
        found = sweep(laid, folder, command, workers or cores(), time_limit, progress)
    tell(swept(found, folder))
    return exit_code(found)


@app.command
def report(folder: Path) -> int:
    """Judge the logs of an earlier run again and write its report anew; no engine is needed.

    Parameters
    ----------
    folder
        What `poinsot run` wrote.
    """
    from .adapters.runner import cores
    from .main_job import again
    from .reports.results import exit_code

    found = again(folder, cores())
    _show(found, folder)
    return exit_code(found)


@app.command(name="list")
def list_(*, json: Annotated[bool, Parameter(negative="")] = False) -> int:
    """List every scene and every engine with its schemes.

    Parameters
    ----------
    json
        Print it as JSON.
    """
    from . import listing

    return listing.printed(as_json=json)


@app.command
def compare(old: Path, new: Path) -> int:
    """Tell what changed between two runs: verdicts, errors, versions, and run times on one machine.

    Ends with 1 if anything got worse, is missing, or has another error.

    Parameters
    ----------
    old
        What `poinsot run` wrote, or its results.json.
    new
        Another such folder or file.
    """
    from .reports import comparison, results

    files = [path / "results.json" if path.is_dir() else path for path in (old, new)]
    for path in files:
        if not path.is_file():
            raise InputError(f"compare: got {path}, which is not there; expected what `poinsot run` wrote")
    before, after = map(results.read, files)
    found = comparison.compared(before, after)
    tell(comparison.as_text(found))
    return 0 if found.same else 1


@app.command
def explain(number: int | None = None) -> int:
    """List the known deviations, or tell all about one: its reason, its size now, a script that shows it.

    Parameters
    ----------
    number
        Which one; all of them are listed if it is not said.
    """
    from .explain import explained, listed

    tell(listed() if number is None else explained(number))
    return 0


@app.command
def doctor() -> int:
    """Tell versions, which engines are here, and whether each passes a self-test."""
    from .doctor import examine

    text, sound = examine()
    tell(text)
    return 0 if sound else 3


def main(tokens: Sequence[str] | None = None) -> int:
    """Run the command line; the exit code is 0, 1, 2, 3, 4 or 130 as the README says."""
    try:
        return int(app(tokens, exit_on_error=False, print_error=False, result_action="return_value") or 0)
    except KeyboardInterrupt:
        return _complain("interrupted", 130)
    except (CycloptsError, InputError) as error:
        return _complain(str(error), 2)
    except UnavailableError as error:
        return _complain(str(error), 3)
    except PoinsotError as error:
        return _complain(str(error), 4)


def _check_limits(workers: int | None, time_limit: float) -> None:
    if workers is not None and workers < 1:
        raise InputError(f"--workers: got {workers}, expected at least 1")
    if not time_limit > 0:
        raise InputError(f"--time-limit: got {time_limit}, expected a number of seconds above 0")


def _propose(found: dict[str, Any], folder: Path) -> None:
    from .reports.deviations import recorded
    from .reports.proposals import proposed

    text = proposed(found, recorded())
    if text:
        path = folder / "known_deviations.proposed.toml"
        path.write_text(text, encoding="utf-8")
    said = f"proposed changes to the known deviations: {path}" if text else "nothing to propose"
    tell(said)


def _complain(text: str, code: int) -> int:
    remark(f"poinsot: {' '.join(text.split())}")
    return code


def _arguments() -> list[str]:
    return sys.argv[1:]


def _show(found: dict[str, Any], folder: Path) -> None:
    from .listing import outcome

    tell(outcome(found, folder))
