"""Run a free top and a pendulum for ten million steps in every scheme, and tell how their errors grow.

    python benchmarks/long_runs.py FOLDER [ENGINE ...]   run what FOLDER does not hold yet, and keep it there
    python benchmarks/long_runs.py FOLDER --publish      the same, and write reports/published/LONG_RUNS.md
    python benchmarks/long_runs.py --check               hold that page against the first 1e5 steps; 1 if it
                                                         differs

Each run is a process of its own, one after the other, stepped in the engine's own loop and looked at 1600
times. Energy and angular momentum are computed from its states, as everywhere in Poinsot; reports/drift.py
tells their law. Memory is what the process holds after 1e5 steps and at the end.
"""

import json
import multiprocessing
import sys
from dataclasses import replace
from pathlib import Path
from time import process_time

import numpy as np
from poinsot.adapters import registry
from poinsot.adapters.engine import EngineError
from poinsot.adapters.simulate import unsupported
from poinsot.reports.drift import BLOCKS, drift
from poinsot.scenarios import mechanics
from poinsot.scenarios.registry import scenes
from poinsot.scenarios.trajectory import Trajectory

PAGE = Path(__file__).resolve().parents[1] / "reports" / "published" / "LONG_RUNS.md"
SYSTEMS = {"free top": "free_symmetric_top[oblate]", "pendulum": "large_pendulum[swing]"}
ENGINES = ("mujoco", "pybullet", "pinocchio")
DT, STEPS, SAMPLES, EARLY = 1e-3, 10_000_000, 1600, 100_000


def held():
    """Memory [bytes] that this process holds now."""
    for line in Path("/proc/self/status").read_text(encoding="utf-8").splitlines():
        if line.startswith("VmRSS:"):
            return int(line.split()[1]) * 1024
    return 0


def quantities(scene, state):
    """Energy, angular momentum about the centre of mass (3,), and ω across the body's axis, of a state."""
    motion = Trajectory(np.zeros(1), *(np.asarray(part, float)[None] for part in state))
    still = replace(motion, position=0 * motion.position, velocity=0 * motion.velocity)
    spin = mechanics.angular_momentum_world(scene, still)[0]
    return mechanics.energy(scene, motion)[0], spin, np.hypot(*motion.omega[0, 0, :2])


def run(system, engine_name, scheme_name, path):
    """One run; what it came to is written to ``path``."""
    told = measured(system, engine_name, scheme_name, STEPS)
    path.write_text(json.dumps(told), encoding="utf-8")


def measured(system, engine_name, scheme_name, steps):
    """What so many steps come to."""
    scene, engine = scenes()[SYSTEMS[system]], registry.load(engine_name)
    machine, scheme = engine(), registry.scheme_of(engine, scheme_name)
    machine.build(scene, scheme, DT)
    found, broke, early, stride = np.full((SAMPLES + 1, 5), np.nan), "", 0, steps // SAMPLES
    energy, spin, _ = quantities(scene, machine.state())
    begun = process_time()
    for sample in range(SAMPLES + 1):
        try:
            if sample:
                machine.step(stride)
            now = quantities(scene, machine.state())
        except EngineError as error:
            broke = " ".join(str(error).split())
            break
        found[sample] = now[0] - energy, *(now[1] - spin), now[2]
        if sample * stride <= EARLY:
            early = held()
    seconds, late = process_time() - begun, held()
    return {
        "system": system, "engine": engine_name, "version": engine.version(), "scheme": scheme_name,
        "stride": stride, "broke": broke, "seconds": seconds, "memory": [early, late],
        "energy_scale": float(abs(kinetic_scale(scene))), "momentum_scale": float(np.linalg.norm(spin)),
        "found": found[np.isfinite(found).all(axis=1)].tolist(),
    }  # fmt: skip


def kinetic_scale(scene):
    """The kinetic energy [J] of the start, a free body's without its flight: what errors are held against."""
    start = scene.truth(scene, scene.sample_times()[:1])
    if scene.bodies[0].joints[0].kind == "free":
        start = replace(start, velocity=0 * start.velocity)
    return mechanics.kinetic_energy(scene, start)[0]


def wanted(names):
    """Every system, engine and scheme that goes together."""
    for system, full_name in SYSTEMS.items():
        for name in names:
            engine = registry.load(name)
            for scheme in engine.schemes:
                if not unsupported(scenes()[full_name], engine, scheme):
                    yield system, name, scheme.name


def law(t, errors):
    """Law, rate and largest error in words; of a run that broke, of what came before."""
    if len(t) < 8 * BLOCKS:
        return f"{len(t)} samples tell no law", float(np.abs(errors).max())
    told = drift(t, errors)
    rate = {"linear": f", {told.rate:.2g} /s", "√t": f", {told.rate:.2g} /√s"}.get(told.law, "")
    if told.law == "exponential":  # how fast is no constant of a scheme that blows up ever faster
        rate = " or faster"
    return told.law + rate, told.largest


def row(told):
    """One line of the table."""
    found = np.array(told["found"])
    t = np.arange(len(found)) * told["stride"] * DT
    energy, largest = law(t, found[:, 0] / told["energy_scale"])
    momentum, across = ("–", None), "–"
    if told["system"] == "free top":
        momentum = law(t, np.linalg.norm(found[:, 1:4], axis=1) / told["momentum_scale"])
        across = f"{left(found, told['stride'], EARLY):.2g}, {found[-1, 4] / found[0, 4]:.2g}"
    early, late = told["memory"]
    steps = (len(found) - 1) * told["stride"]
    turned = f"{momentum[1]:.1e}" if momentum[1] is not None else "–"
    fate = f"stops after {steps:.3g}: {told['broke']}" if told["broke"] else f"{steps:.0e}"
    scheme = f"{told['engine']} {told['version']} {told['scheme']}"
    return (
        f"| {told['system']} | {scheme} | {fate} | {energy} | "
        f"{largest:.1e} | {momentum[0]} | {turned} | {across} | {late / early - 1:+.1%} | "
        f"{told['seconds'] / max(1, steps) * 1e6:.2f} |"
    )


def left(found, stride, steps):
    """How much of the ω across its axis that a top began with it has after so many steps."""
    return found[min(steps // stride, len(found) - 1), 4] / found[0, 4]


def page(folder):
    """The table, in Markdown, of what the folder holds."""
    runs = {path.stem: json.loads(path.read_text(encoding="utf-8")) for path in folder.glob("*.json")}
    lines = [
        "# Ten million steps",
        "",
        "`python benchmarks/long_runs.py FOLDER --publish` writes this page, and `--check` holds it against",
        "the first 10⁵ steps: a free top (`free_symmetric_top[oblate]`) and a pendulum",
        "(`large_pendulum[swing]`), by steps of 1 ms over 10⁴ s. Errors of energy are held against the",
        "kinetic energy of the start, a top's without its flight, those of the angular momentum about",
        "the centre of mass against itself. `reports/drift.py` tells the laws and how they are decided.",
        "Memory is what the process holds at the end, against what it held after 10⁵ steps.",
        "",
        "*ω across* is how much of the ω across its axis a top has left, after 10⁵ steps and at the end;",
        "in truth it keeps all of it. Where an error *came to rest* there was no more to lose: an implicit",
        "scheme divides this ω by √(1 + (Ω_b dt)²) at each step, until the nutation is gone and a steady",
        "spin is left.",
        "",
        "| system | scheme | steps | energy | largest | momentum | largest | ω across | memory | µs a step |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    names = [file_name(*case) for case in wanted(ENGINES)]
    lines += [row(runs[name]) for name in names if name in runs]
    missing = [name for name in names if name not in runs]
    if missing:
        lines += ["", f"Not run: {', '.join(missing)}."]
    return "\n".join(lines) + "\n"


def file_name(system, engine, scheme):
    """Name of a run's file, without its ending."""
    return f"{system}-{engine}-{scheme}".replace(" ", "_")


def check():
    """What the page says of each scheme, and its first steps do not bear out."""
    from published import close  # beside this file, which a test may load from elsewhere

    lines = PAGE.read_text(encoding="utf-8").splitlines()
    rows = [line.strip("| ").split(" | ") for line in lines if line.startswith("| ")]
    said = {tuple(row[:2]): row for row in rows}
    for system, engine, scheme in wanted(ENGINES):
        told = measured(system, engine, scheme, EARLY)
        name = system, f"{engine} {told['version']} {scheme}"
        if name not in said:
            yield f"{', '.join(name)}: not published"
            continue
        found = np.array(told["found"])
        errors = [("energy", found[:, 0] / told["energy_scale"], *said[name][3:5])]
        if system == "free top":
            turned = np.linalg.norm(found[:, 1:4], axis=1) / told["momentum_scale"]
            errors.append(("momentum", turned, *said[name][5:7]))
            across, published = left(found, told["stride"], EARLY), float(said[name][7].split(",")[0])
            # Looks that are whole steps apart end up to a part in a hundred before the steps do.
            if not close(across, published, 1.05):
                yield f"{', '.join(name)}: ω across is published as {published}; {across:.2g} is left"
        for what, error, law_of_it, largest in errors:
            reason = refuted(np.abs(error), len(error) * told["stride"] * DT, law_of_it, float(largest))
            if reason:
                yield f"{', '.join(name)}: {what} is published as {law_of_it}, at most {largest}; {reason}"
        if told["broke"] and "stops after" not in said[name][2]:
            yield f"{', '.join(name)}: is published to go on; {told['broke']}"


def refuted(errors, seconds, said, largest):
    """Why errors over the first ``seconds`` are not what is said of all of them, or an empty text."""
    if said in ("bounded", "came to rest"):
        # It swings through most of its range within seconds; a tenth is for other machines' rounding. What
        # comes to rest has lost nine tenths of what there is to lose.
        return "" if largest / 2 <= errors.max() <= 1.1 * largest else f"reaches {errors.max():.1e} already"
    if said.startswith("linear"):
        # It also swings: that of the top's momentum by six times what the law adds in 100 s.
        drifted = abs(float(said.split()[1])) * seconds
        return "" if drifted / 3 <= errors.max() <= 10 * drifted else f"reaches {errors.max():.1e} already"
    # What ends in a blow-up, or before a law could be told, begins by growing.
    third = len(errors) // 3
    return "" if errors[-third:].max() > 1.5 * errors[:third].max() else "does not grow"


def main(*arguments):
    """Run what is missing, and publish what is there; or hold the page against the first steps."""
    if "--check" in arguments:
        from published import agreed  # beside this file, which a test may load from elsewhere

        return agreed(list(check()))
    folder, *names = (argument for argument in arguments if argument != "--publish")
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    for case in wanted(names or ENGINES):
        path = folder / f"{file_name(*case)}.json"
        if not path.exists():
            child = multiprocessing.get_context("spawn").Process(target=run, args=(*case, path))
            child.start()
            child.join()
            print(path.stem, "done" if path.exists() else f"died with exit code {child.exitcode}", flush=True)
    if "--publish" in arguments:
        PAGE.parent.mkdir(exist_ok=True)
        PAGE.write_text(page(folder), encoding="utf-8")
    else:
        sys.stdout.write(page(folder))
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
