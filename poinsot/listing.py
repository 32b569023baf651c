"""What there is to run and to sweep, and how a run ended, in words for a terminal and as JSON."""

import json
from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from .adapters.declared import Declaration, declared
from .adapters.engine import Scheme
from .scenarios.families import FAMILIES
from .scenarios.registry import scenes
from .scenarios.scene import Scene
from .telling import tell

#: Sentences shown in a terminal before the reader is sent to the report.
SHOWN = 12


def printed(*, as_json: bool) -> int:
    """Print what there is to run, as JSON or in words; 0, as a command that went well ends."""
    tell(json_text() if as_json else as_text())
    return 0


def json_text() -> str:
    """Every scene, family and engine as JSON."""
    engines = declared()
    found = {
        "scenes": {name: _scene(scene, engines) for name, scene in scenes().items()},
        "families": {
            family.name: {"summary": family.summary, "values": family.values} for family in FAMILIES
        },
        "engines": {engine.name: _engine(engine) for engine in engines},
    }
    return json.dumps(found, indent=1, ensure_ascii=False)


def as_text() -> str:
    """Every scene with its variants, every family and every engine, a few lines each."""
    lines, engines = ["Scenes"], declared()
    for name, variants in _by_name().items():
        scene = variants[0]
        able = [engine.name for engine in engines if any(_able(variant, engine) for variant in variants)]
        left_out = [part for part in scene.left_out if all(part in other.left_out for other in variants)]
        needed = dict.fromkeys(feature for variant in variants for feature in sorted(variant.features))
        lines += [f"  {name}"]
        lines += [f"      {variant.full_name}: {variant.summary}" for variant in variants if variant.variant]
        lines += [f"      {scene.summary}"] if not scene.variant else []
        lines += [
            f"      source: {scene.source}",
            f"      needs {', '.join(needed)}; can run in {', '.join(able) or 'no engine'}",
            f"      leaves out {', '.join(left_out)}",
        ]
    lines += ["", "Families, which `poinsot stability` sweeps"]
    lines += [f"  {family.name}: {family.summary}" for family in FAMILIES]
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
    from .reports.common_causes import spoken  # a list of scenes needs no reports
    from .reports.wording import count

    counts = Counter(cell["status"] for cell in found["cells"])
    said = ", ".join(f"{n} {status}" for status, n in counts.most_common())
    lines = [f"{count(sum(counts.values()), 'cell')}: {said}"]
    lines += [f"most likely: {spoken(cause)}" for cause in found.get("likely_causes", ())][:SHOWN]
    wrong = list(dict.fromkeys(line for cell in found["cells"] for line in _complaints(cell)))
    lines += wrong[:SHOWN]
    if len(wrong) > SHOWN:
        lines.append(f"… and {len(wrong) - SHOWN} more, in the report")
    lines += found["stale_deviations"]
    lines += [note for note in found["notes"] if note.startswith("Loose timing")]
    return "\n".join([*lines, f"report: {folder / 'report.html'}"])


def swept(found: Mapping[str, Any], folder: Path) -> str:
    """How a sweep ended: runs by outcome, limits by verdict, what is not a pass, and where the page is."""
    outcomes = Counter(point["outcome"] for each in found["maps"] for point in each["points"])
    statuses = Counter(verdict["status"] for verdict in found["verdicts"])
    lines = [
        f"{sum(counts.values())} {noun}: "
        + (", ".join(f"{n} {word}" for word, n in counts.most_common()) or "none")
        for noun, counts in (("runs", outcomes), ("largest stable steps", statuses))
    ]
    wrong = [
        f"{v['status']}: {v['scene']} in {v['engine']} {v['scheme']}: {v['message']}"
        for v in found["verdicts"]
        if v["status"] in ("fail", "fixed", "error")
    ]
    lines += wrong[:SHOWN]
    if len(wrong) > SHOWN:
        lines.append(f"… and {len(wrong) - SHOWN} more, on the page")
    return "\n".join([*lines, *found["notes"], f"page: {folder / 'stability.html'}"])


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


def _by_name() -> dict[str, list[Scene]]:
    """The variants of each scene."""
    found: dict[str, list[Scene]] = {}
    for scene in scenes().values():
        found.setdefault(scene.name, []).append(scene)
    return found


def _able(scene: Scene, engine: Declaration) -> bool:
    return scene.features <= engine.features and any(
        not scene.features & scheme.lacks.keys() for scheme in engine.schemes
    )


def _scene(scene: Scene, engines: list[Declaration]) -> dict[str, Any]:
    return {
        "name": scene.name,
        "variant": scene.variant,
        "summary": scene.summary,
        "source": scene.source,
        "engines": [engine.name for engine in engines if _able(scene, engine)],
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
