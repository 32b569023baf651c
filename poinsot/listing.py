"""What there is to run, and how a run ended, in words for a terminal and as JSON."""

import json
from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from .adapters.declared import Declaration, declared
from .adapters.engine import Scheme
from .scenarios.registry import scenes
from .scenarios.scene import Scene

#: Sentences shown in a terminal before the reader is sent to the report.
SHOWN = 12


def as_json() -> str:
    """Every scene and every engine as JSON."""
    found = {
        "scenes": {name: _scene(scene) for name, scene in scenes().items()},
        "engines": {engine.name: _engine(engine) for engine in declared()},
    }
    return json.dumps(found, indent=1, ensure_ascii=False)


def as_text() -> str:
    """Every scene and every engine, a few lines each."""
    lines, engines = ["Scenes"], declared()
    for name, scene in scenes().items():
        able = [engine.name for engine in engines if _able(scene, engine)]
        lines += [
            f"  {name}",
            f"      {scene.summary}",
            f"      needs {', '.join(sorted(scene.features))}; can run in {', '.join(able)}",
        ]
    lines += ["", "Engines"]
    for engine in engines:
        lines.append(f"  {engine.name}{'' if engine.installed else ' (not installed)'}")
        lines += [
            f"      {scheme.name}: order {scheme.order}, twin name {scheme.twin!r}"
            for scheme in engine.schemes
        ]
    return "\n".join(lines)


def outcome(found: Mapping[str, Any], folder: Path) -> str:
    """How a run ended: counts, a sentence for what is not a pass, and where the report lies."""
    counts = Counter(cell["status"] for cell in found["cells"])
    lines = [
        f"{sum(counts.values())} cells: " + ", ".join(f"{n} {status}" for status, n in counts.most_common())
    ]
    wrong = list(dict.fromkeys(line for cell in found["cells"] for line in _complaints(cell)))
    lines += wrong[:SHOWN]
    if len(wrong) > SHOWN:
        lines.append(f"… and {len(wrong) - SHOWN} more, in the report")
    return "\n".join([*lines, *found["stale_deviations"], f"report: {folder / 'report.html'}"])


def _complaints(cell: Mapping[str, Any]) -> list[str]:
    place = f"{cell['scene']} in {cell['engine']} {cell['scheme']} at dt {cell['dt']:g} s"
    if cell["message"] and cell["status"] == "error":
        return [f"error: {place}: {cell['message']}"]
    return [
        f"{found['status']}: {place}: {found['check']} of {found['observable']}: "
        f"{found['message']}{_numbers(found)}"
        for found in cell["verdicts"]
        if found["status"] in ("fail", "fixed", "error")
    ]


def _numbers(verdict: Mapping[str, Any]) -> str:
    if verdict["measured"] is None or verdict["allowed"] is None:
        return ""
    return f" ({verdict['measured']:.3g} {verdict['unit']}, {verdict['allowed']:.3g} allowed)"


def _able(scene: Scene, engine: Declaration) -> bool:
    return scene.features <= engine.features and any(
        not scene.features & scheme.lacks.keys() for scheme in engine.schemes
    )


def _scene(scene: Scene) -> dict[str, Any]:
    return {
        "summary": scene.summary,
        "source": scene.source,
        "features": sorted(scene.features),
        "left_out": list(scene.left_out),
        "duration": scene.duration,
        "dt": scene.dt,
        "observables": [observable.name for observable in scene.observables],
    }


def _engine(engine: Declaration) -> dict[str, Any]:
    return {
        "installed": engine.installed,
        "features": sorted(engine.features),
        "schemes": [_scheme(scheme) for scheme in engine.schemes],
    }


def _scheme(scheme: Scheme) -> dict[str, Any]:
    return {
        "name": scheme.name,
        "order": scheme.order,
        "twin": scheme.twin,
        "lacks": dict(scheme.lacks),
    }
