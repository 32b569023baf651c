"""A progress bar where there is a terminal; nothing where there is none."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from time import perf_counter

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from .estimate import Estimate, spoken
from .main_job import Progress as Report


@contextmanager
def bar(expected: Estimate | None = None) -> Iterator[Report]:
    """A function that is told of progress and shows it on standard error while the block runs.

    What is left is of the whole run where it is known what to expect of it, else of the phase.
    """
    left = TextColumn("{task.fields[left]}") if expected else TimeRemainingColumn()
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), left)
    with Progress(*columns, console=Console(stderr=True), disable=not sys.stderr.isatty()) as shown:
        tasks, begun = {}, perf_counter()

        def report(phase: str, done: int, of: int) -> None:
            if phase not in tasks:
                tasks[phase] = shown.add_task(phase, total=of, left="")
            to_go = expected.left(phase, done, perf_counter() - begun) if expected and done < of else 0.0
            shown.update(tasks[phase], completed=done, left=f"{spoken(to_go)} to go in all" if to_go else "")

        yield report
