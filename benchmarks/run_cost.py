"""What a run took beside the bare steps of its engines, and what its checks add.

    python benchmarks/run_cost.py RUN ...           tell of runs, from the cost.json that each left
    python benchmarks/run_cost.py RUN ... --rates   write poinsot/rates.toml from them, for estimates

Seconds are of the processor but for what says otherwise: where a machine does other work beside, the clock
tells of that too. Bare steps are those of the runs that are judged, once each.
"""

import json
import sys
from collections import Counter, defaultdict
from pathlib import Path

import numpy as np
from poinsot.scenarios.registry import scenes

from poinsot import cost, estimate

RATES = Path(__file__).resolve().parents[1] / "poinsot" / "rates.toml"
#: Which parts of the work, on cells and then on scenes, are there for the checks alone.
CHECKS = {
    "setup": "read-back of the setup, with probe runs",
    "accelerations": "the engine's accelerations",
    "repeat": "second run, for determinism",
    "stable step": "search for the largest stable step",
    "checks": "judging",
}
OTHERS = {
    "stepping": "bare steps",
    "building": "building models",
    "rest": "looking at states, and what is loaded once",
    "loading": "loading engines",
    "logging": "writing logs",
    "reading": "reading logs",
    "errors": "exact motions, and errors",
    "pictures": "pictures",
}


def read(folder):
    """The cost.json of a run."""
    found = json.loads((Path(folder) / cost.FILE).read_text(encoding="utf-8"))
    if found["schema"] != cost.SCHEMA:
        raise SystemExit(f"{folder}: got {found['schema']}, expected {cost.SCHEMA}")
    return found


def parts(found):
    """Seconds by part, with those of the phases that no part is measured of, and what is left over."""
    total = Counter()
    for one in (*(cell["spent"] for cell in found["cells"]), *found["judging"].values()):
        total.update(one)
    phases = found["phases"]
    alone = {name: phases[name]["cpu_seconds"] for name in phases if name not in ("simulating", "judging")}
    told = sum(total.values())
    whole = phases["simulating"]["cpu_seconds"] + phases["judging"]["cpu_seconds"]
    return total, alone, whole - told


def told(folder):
    """Lines on one run."""
    found = read(folder)
    total, alone, left = parts(found)
    whole = sum(total.values()) + sum(alone.values()) + left
    wall, workers, bare = found["seconds"], found["workers"], total["stepping"]
    checks = sum(total[part] for part in CHECKS)
    lines = [f"{folder}: {len(found['cells'])} cells, {wall:.1f} s by the clock on {workers} workers"]
    own, expected = undisturbed(found), sum(found["expected"].values())
    lines.append(f"  {own:.1f} s if it had had the cores to itself, by what the processor took")
    if expected:
        lines += [
            f"  expected {expected:.0f} s: {expected / own - 1:+.0%} against that, "
            f"{expected / wall - 1:+.0%} against the clock; "
            f"{expected * found['crowding']:.0f} s as busy as the machine was before it: "
            f"{expected * found['crowding'] / wall - 1:+.0%}",
            f"  expected and taken by phase: {by_phase(found)}",
        ]
    rows = [(name, total[part]) for part, name in (OTHERS | CHECKS).items()]
    rows += [*alone.items(), ("starting processes, passing results", left)]
    for name, seconds in sorted(rows, key=lambda row: -row[1]):
        lines.append(f"  {seconds:8.2f} s {seconds / whole:6.1%}  {name}")
    lines += [
        f"  {whole:8.2f} s         in all",
        f"  by the clock / (bare steps / {workers}): {wall * workers / bare:.2f}; "
        f"with the cores to itself {own * workers / bare:.2f}, "
        f"without timing {(own - processor(found, 'timing')) * workers / bare:.2f}",
        f"  the checks add {checks / (whole - checks):.0%} to everything else ({checks:.1f} s), "
        f"{checks / (whole - checks - alone.get('timing', 0)):.0%} to everything but timing",
    ]
    return lines


def undisturbed(found):
    """Seconds that the run would take if its processes never waited for a core."""
    alone = sum(processor(found, phase) for phase in estimate.ALONE)
    return alone + (sum(processor(found, phase) for phase in found["phases"]) - alone) / found["workers"]


def by_phase(found):
    """What was expected of each phase, and what it took, by the clock."""
    return ", ".join(
        f"{name} {found['expected'].get(name, 0):.0f}/{clock(found, name):.0f}" for name in found["phases"]
    )


def clock(found, phase):
    """Seconds of a phase by the clock."""
    return found["phases"].get(phase, {"seconds": 0.0})["seconds"]


def processor(found, phase):
    """Seconds of a phase of the processor: what it takes where nothing else runs."""
    return found["phases"].get(phase, {"cpu_seconds": 0.0})["cpu_seconds"]


def rates(runs):
    """What each kind of work took in these runs, as TOML."""
    cells = [cell for run in runs for cell in run["cells"] if cell["spent"]]
    timing = sum(processor(run, "timing") for run in runs)
    lines = [
        "# Seconds of the processor that pieces of a run take, for the estimate before one. Written by",
        "# `python benchmarks/run_cost.py RUN ... --rates`. `pulse` is how fast that machine was.",
        f"pulse = {np.median([run['pulse'] for run in runs]):.3g}",
        f"start = {np.mean([parts(run)[2] / run['workers'] / 2 for run in runs]):.3g}",
    ]
    steps, per_engine = _steps(cells), _engines(cells)
    for table, known in (("step", steps), ("cell", per_engine)):
        for name, found in known.items():
            lines += ["", f'[{table}."{name}"]', *(f"{key} = {value:.3g}" for key, value in found.items())]
    for table, (name, matrix, seconds) in {
        "judging": ("scene", *_judging(runs)),
        "report": (
            "start",
            [(1, len(run["cells"])) for run in runs],
            [processor(run, "report") for run in runs],
        ),
    }.items():
        first, each = np.linalg.lstsq(np.array(matrix, float), np.array(seconds), rcond=None)[0]
        lines += ["", f"[{table}]", f"{name} = {first:.3g}", f"cell = {each:.3g}"]
    timed = sum(_timed(cell, steps, per_engine) for cell in cells if cell["timed"])
    return "\n".join([*lines, "", "[timing]", f"factor = {timing / timed:.3g}"]) + "\n"


def _steps(cells):
    """Seconds of a step by scheme and kind of scene."""
    taken = defaultdict(lambda: [0.0, 0])
    for cell in cells:
        scene = scenes()[cell["scene"]]
        one = taken[f"{cell['engine']} {cell['scheme']}", estimate.kind(scene)]
        one[0] += cell["spent"]["stepping"]
        one[1] += scene.samples * scene.steps_per_sample(cell["dt"])
    found = defaultdict(dict)
    for (scheme, kind), (seconds, steps) in taken.items():
        found[scheme][kind] = seconds / steps
    return found


def _engines(cells):
    """Seconds of what is done once a cell, once a sample, and only in some cells, by engine."""
    by_engine = defaultdict(list)
    for cell in cells:
        by_engine[cell["engine"]].append(cell | {"scene": scenes()[cell["scene"]]})
    return {engine: _engine(of) for engine, of in by_engine.items()}


def _engine(cells):
    looked = sum(cell["spent"]["rest"] for cell in cells) / sum(cell["scene"].samples for cell in cells)
    asked = [cell for cell in cells if cell["asked"]]
    again = [
        cell["spent"]["repeat"] - cell["spent"]["stepping"] - looked * cell["scene"].samples
        for cell in cells
        if cell["repeats"] > 1
    ]
    once = "loading", "building", "setup", "logging"
    return {
        "built": _mean(cell["spent"]["building"] for cell in cells),
        "whole": _mean(sum(cell["spent"][part] for part in once) for cell in cells),
        "sample": looked,
        "repeated": max(0.0, _mean(again)),
        "asked": _mean(cell["spent"]["accelerations"] for cell in asked),
        "stable": _mean(cell["spent"]["stable step"] for cell in asked if cell["scene"].stable_step),
    }


def _mean(values):
    values = list(values)
    return sum(values) / len(values) if values else 0.0


def _judging(runs):
    """Scenes with their cells, and the seconds that judging each took."""
    rows, seconds = [], []
    for run in runs:
        cells = Counter(cell["scene"] for cell in run["cells"])
        rows += [(1, cells[scene]) for scene in run["judging"]]
        seconds += [sum(spent.values()) for spent in run["judging"].values()]
    return rows, seconds


def _timed(cell, steps, engines):
    """Seconds that timing a cell would take if no repeat of it were disturbed."""
    scene = scenes()[cell["scene"]]
    step = steps[f"{cell['engine']} {cell['scheme']}"][estimate.kind(scene)]
    return estimate.timing(scene, cell["dt"], estimate.Work(step, engines[cell["engine"]]["built"], 0.0))


def main(*arguments):
    """Tell of runs, or write down their rates."""
    folders = [argument for argument in arguments if argument != "--rates"]
    if not folders:
        raise SystemExit("run_cost.py: got no folder, expected those that `poinsot run` wrote")
    if "--rates" in arguments:
        RATES.write_text(rates([read(folder) for folder in folders]), encoding="utf-8")
        return
    for folder in folders:
        print("\n".join(told(folder)))


if __name__ == "__main__":
    main(*sys.argv[1:])
