"""Count how often a right engine is accused: every scene in every scheme of every engine, many times over.

    python benchmarks/false_alarms.py [ROUNDS] [--workers N] [--seed FIRST] [--out FILE] [--scene NAME]...

Each round has a seed of its own, by which the random states at which accelerations are asked for, the
order of scenes and of cells, how many scenes share a process, how many processes there are and how
often the motion is looked at are drawn; the first round of seed 0 draws nothing. An alarm is a verdict that
neither passes nor is known nor unsupported, or a cell that breaks down; of an engine whose deviation in the
very observable is on record, it is counted apart. Each is printed with the seed that
brings it back. Every part that is done adds a line to FILE, so that a run that is cut short still tells its
count. Ends with 1 if there was an alarm.
"""

import argparse
import json
import multiprocessing
import os
import random
import sys
import time
from collections import Counter, defaultdict
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import replace
from math import ceil
from pathlib import Path

from poinsot.adapters import registry
from poinsot.adapters.runner import cores
from poinsot.adapters.simulate import simulate, unsupported
from poinsot.reports.judge import judge
from poinsot.reports.verdict import Status, ladder_of
from poinsot.scenarios import equations
from poinsot.scenarios.registry import scenes, select

#: Ends an alarm about something of which a deviation is on record.
RECORDED = " (a deviation of it is on record)"
FINE = (Status.PASS, Status.KNOWN, Status.UNSUPPORTED)
#: Fewest and most looks at a motion, as a part of what its scene asks for. What an average rate is found to
#: be depends on the looks: an error constant holds for as many as it was measured with, or more.
LOOKS = (1.0, 1.5)
#: Scenes whose steps stay as they are, with the reason.
STEPS_CHOSEN = {
    "euler_angles[through zero]": "no step of its own comes near to gimbal lock, where any scheme is lost",
}


def varied(scene, chance):
    """The scene looked at some other number of times, at steps that this makes no coarser.

    Where something bounces the steps stay as they are: the scene chose them so that the blow falls in the
    same part of each; and where a force acts for a while, which sets in and ends at looks.
    """
    bounces = any(not contact.friction for contact in scene.contacts)
    if chance is None or bounces or "blow" in scene.features or scene.full_name in STEPS_CHOSEN:
        return scene
    samples = max(1, round(scene.samples * chance.uniform(*LOOKS)))
    between = scene.duration / samples

    def whole(dt):
        return between / ceil(between / dt * (1 - 1e-9))

    ladders = {key: tuple(dict.fromkeys(map(whole, dts))) for key, dts in scene.ladders.items()}
    return replace(scene, samples=samples, dt=whole(scene.dt), ladders=ladders)


def cells(scene):
    """Every cell of a scene: engine, scheme, step and how often it is run."""
    for engine in registry.engines().values():
        for scheme in () if isinstance(engine, str) else engine.schemes:
            if not unsupported(scene, engine, scheme):
                steps = {scene.whole_step(dt) for dt in (*scene.ladder(scheme.order, scheme.twin), scene.dt)}
                own = scene.whole_step(scene.dt)
                yield from ((engine, scheme, dt, 2 if dt == own else 1) for dt in sorted(steps, reverse=True))


def part(names, seed):
    """Run and judge some scenes in one process: how many cells and verdicts, and the alarms."""
    chance = random.Random(f"{seed} {names}") if seed else None
    equations.SEED = equations.SEED + seed
    chosen = {name: varied(scenes()[name], chance) for name in names}
    todo = [(name, *cell) for name, scene in chosen.items() for cell in cells(scene)]
    if chance:
        chance.shuffle(todo)
    runs, alarms = defaultdict(list), []
    for name, engine, scheme, dt, repeats in todo:
        try:
            runs[name].append(simulate(chosen[name], engine, scheme, dt, repeats)[0])
        except Exception as error:  # whatever an engine breaks down with is an alarm
            alarms.append(f"{engine.name} {scheme.name} in {name} at dt {dt:g} s: {error}")
    verdicts = [v for name in names for v in judge(runs[name], chosen)]
    samples = {name: scene.samples for name, scene in chosen.items()}
    on_record = {(*ladder_of(v), v.observable) for v in verdicts if v.status is Status.KNOWN}
    for v in verdicts:
        if v.status not in FINE:
            # A bound is of the states and steps it was measured at, and others may go beyond it.
            known = (*ladder_of(v), v.observable) in on_record or "beyond the recorded bound" in v.message
            alarms.append(f"{told(v, samples[v.scene])}{RECORDED if known else ''}")
    return len(todo), Counter(v.check for v in verdicts), alarms


def told(v, samples):
    """An alarm in one line."""
    size = "" if v.measured is None else f" {v.measured:.3g} > {v.allowed or 0:.3g} {v.unit}"
    return (
        f"{v.engine} {v.scheme} in {v.scene} at dt {v.dt:g} s, {samples} samples: {v.check} of "
        f"{v.observable} {v.status.value}{size}: {v.message}"
    )


def rounds(count, first, names, workers, note):
    """Alarms of all rounds; ``note`` is told of every part that is done."""
    everything, alarms = [scene.full_name for scene in select(names)], []
    for seed in range(first, first + count):
        chance = random.Random(seed)
        order = list(everything)
        if seed:
            chance.shuffle(order)
        size, at_once = (chance.randint(1, 8), chance.randint(1, workers)) if seed else (4, workers)
        parts = [order[i : i + size] for i in range(0, len(order), size)]
        context = multiprocessing.get_context("spawn")
        with ProcessPoolExecutor(at_once, context, max_tasks_per_child=1) as pool:
            for future in as_completed({pool.submit(part, names, seed): names for names in parts}):
                found = future.result()
                alarms += [f"seed {seed}: {alarm}" for alarm in found[2]]
                note(seed, *found)
    return alarms


def main():
    """Run the rounds and print the count."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("rounds", nargs="?", type=int, default=20)
    parser.add_argument("--workers", type=int, default=cores())
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--out", type=Path, default=Path("poinsot-runs/false-alarms.jsonl"))
    parser.add_argument("--scene", action="append", default=[])
    asked = parser.parse_args()
    os.nice(max(0, 19 - os.nice(0)))
    start, total, done = time.monotonic(), Counter(), Counter()

    def note(seed, number, verdicts, alarms):
        done[seed] += number
        recorded = sum(alarm.endswith(RECORDED) for alarm in alarms)
        total.update(
            cells=number, verdicts=sum(verdicts.values()), alarms=len(alarms) - recorded, recorded=recorded
        )
        for alarm in alarms:
            print(f"seed {seed}: {alarm}", flush=True)
        line = {"seed": seed, "cells": number, "verdicts": verdicts, "alarms": alarms}
        asked.out.parent.mkdir(parents=True, exist_ok=True)
        with asked.out.open("a", encoding="utf-8") as file:
            file.write(f"{json.dumps(line)}\n")
        if sys.stderr.isatty() or total["cells"] // 500 != (total["cells"] - number) // 500:
            print(f"so far {counted(total, len(done), start)}", file=sys.stderr, flush=True)

    alarms = rounds(asked.rounds, asked.seed, asked.scene, asked.workers, note)
    print(counted(total, asked.rounds, start))
    return 1 if alarms else 0


def counted(total, rounds_begun, start):
    """The count in words."""
    return (
        f"{total['alarms']} false alarms (and {total['recorded']} beyond a record) in {total['verdicts']} "
        f"verdicts on {total['cells']} cells, "
        f"{rounds_begun} rounds, {time.monotonic() - start:.0f} s"
    )


if __name__ == "__main__":
    sys.exit(main())
