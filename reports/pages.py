"""Every page of a run: the report for people, the summary for a terminal, the results for programs."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from . import html, junit, stored, summary
from .plots import Figure


def write(folder: Path, found: Mapping[str, Any], pictures: Mapping[str, Sequence[Figure]]) -> None:
    """Write ``results.json``, ``summary.md``, ``junit.xml`` and ``report.html`` into ``folder``."""
    stored.write(folder / "results.json", found)
    summary.render(found, folder / "summary.md")
    junit.render(found, folder / "junit.xml")
    html.render(found, pictures, folder / "report.html")
