"""Every page of a run: the report for people, the summary for a terminal, the results for programs."""

from collections import defaultdict
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ..scenarios.scene import Scene
from . import html, junit, results, summary
from .cell import Cell
from .plots import Motion


def write(folder: Path, found: Mapping[str, Any], cells: Sequence[Cell]) -> None:
    """Write ``results.json``, ``summary.md``, ``junit.xml`` and ``report.html`` into ``folder``."""
    results.write(folder / "results.json", found)
    summary.render(found, folder / "summary.md")
    junit.render(found, folder / "junit.xml")
    html.render(found, motions(cells), folder / "report.html")


def motions(cells: Sequence[Cell]) -> list[Motion]:
    """What the pictures show: of each scene the truth, and every scheme at the scene's own step."""
    by_scene: dict[Scene, list[Cell]] = defaultdict(list)
    for cell in cells:
        by_scene[cell.scene].append(cell)
    return [_motion(scene, mine) for scene, mine in by_scene.items()]


def _motion(scene: Scene, cells: Sequence[Cell]) -> Motion:
    own = [cell for cell in cells if cell.provenance.dt == scene.whole_step(scene.dt)]
    return Motion(scene, tuple(cell.trajectory for cell in own or cells))
