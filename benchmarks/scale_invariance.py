"""Find where an engine's results stop being the same in other units, and which number of it does that.

    python benchmarks/scale_invariance.py             print the table
    python benchmarks/scale_invariance.py --publish   write reports/published/SCALE.md
    python benchmarks/scale_invariance.py --check     hold that page against a new run; 1 if it differs

Each scene is run for 100 steps as it is, and with its lengths times 2^±20 (10^±6), its masses times 2^±30
(10^±9), its times times 2^±10 (10^±3): powers of two, which round nothing, so that the same motion has the
same bits. Where the two are more than 1e-9 apart, or the engine refuses or breaks, the power of two from
which on that is so is found by bisection. Two of the scenes are taken further, to 2^±100, until they fail.
"""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
from poinsot.adapters import registry
from poinsot.adapters.simulate import simulate, unsupported
from poinsot.reference.errors import PoinsotError
from poinsot.scenarios.equivalents import scaled
from poinsot.scenarios.registry import scenes

PAGE = Path(__file__).resolve().parents[1] / "reports" / "published" / "SCALE.md"
SCENES = (
    "free_asymmetric_top[general]", "heavy_top[moderate]", "double_pendulum[small]", "co2_chain[mixture]",
    "two_body[kepler e=0.1]", "collisions[e=1]",
)  # fmt: skip
ENGINES = ("mujoco", "pybullet", "pinocchio")
#: Powers of two that are the stated decades: 1e6, 1e9, 1e3.
REACH = {"length": 20, "mass": 30, "time": 10}
#: Taken further than that, and how far.
FAR, FARTHEST = ("free_asymmetric_top[general]", "double_pendulum[small]"), 100
STEPS, SAMPLES, SAME = 100, 10, 1e-9
#: How far two motions are apart that are not the same is a matter of rounding, which machines differ in.
FACTORS = {"what happens": 3.0}


def short(scene):
    """The first steps of a scene."""
    return replace(scene, duration=STEPS * scene.dt, samples=SAMPLES, reactions=())


def apart(a, b):
    """The largest difference of two motions, each part by its own size, or by what it does over the run."""

    def size(values):
        return float(np.abs(values).max(initial=0.0))

    run, reach = a.t[-1], size(a.position) or 1.0
    return max(
        size(a.position - b.position) / reach,
        size(a.velocity - b.velocity) / max(size(a.velocity), reach / run),
        size(a.omega - b.omega) / max(size(a.omega), 1 / run),
        size(np.abs(a.quaternion) - np.abs(b.quaternion)),
    )


def tried(scene, engine, scheme, unit, power, as_it_is):
    """How far the scaled motion is apart, or what the engine says in place of one."""
    same = scaled(scene, **{unit: 2.0**power})
    try:
        return apart(as_it_is, same.back(simulate(same.scene, engine, scheme, same.scene.dt)[0]))
    except PoinsotError as error:
        return " ".join(str(error).split()).replace(f"scene {scene.full_name}: ", "")


def good(result):
    """Whether it is the same motion."""
    return isinstance(result, float) and result <= SAME


def threshold(scene, engine, scheme, unit, reach, as_it_is):
    """The least power of two up to ``reach`` that fails, and its result; else nothing, and the farthest's."""
    at_end = tried(scene, engine, scheme, unit, reach, as_it_is)
    if good(at_end):
        return None, at_end
    sound, broken, result = 0, reach, at_end
    while abs(broken - sound) > 1:
        middle = (sound + broken) // 2
        found = tried(scene, engine, scheme, unit, middle, as_it_is)
        if good(found):
            sound = middle
        else:
            broken, result = middle, found
    return broken, result


def swept(name, engine, scheme, reaches):
    """Every direction of one scene in one scheme: (unit, power or ``None``, result)."""
    scene = short(scenes()[name])
    as_it_is = simulate(scene, engine, scheme, scene.dt)[0]
    for unit, reach in reaches.items():
        for end in (-reach, reach):
            yield unit, *threshold(scene, engine, scheme, unit, end, as_it_is)


def sweep(names, reaches):
    """Every scene in every scheme that can run it: (scene, engine, scheme, unit, power, result)."""
    for name in names:
        for engine_name in ENGINES:
            engine = registry.load(engine_name)
            for scheme in engine.schemes:
                if not unsupported(scenes()[name], engine, scheme):
                    for found in swept(name, engine, scheme, reaches):
                        yield name, engine, scheme, *found


def table(found):
    """The directions that fail, in Markdown; schemes of an engine that fail alike on one line."""
    alike = {}
    for name, engine, scheme, unit, power, result in found:
        if power is not None:
            said = f"{result:.1e} apart" if isinstance(result, float) else result
            key = name, f"{engine.name} {engine.version()}", unit, power, said[:160]
            alike.setdefault(key, []).append(scheme.name)
    lines = ["| scene | schemes | unit | fails from a factor of | what happens |", "|---|---|---|---|---|"]
    for (name, engine, unit, power, said), schemes in alike.items():
        factor = f"2^{power} = {2.0**power:.1e}"
        lines.append(f"| `{name}` | {engine} {', '.join(schemes)} | {unit} | {factor} | {said} |")
    return lines


def page():
    """The thresholds, in Markdown."""
    stated, further = list(sweep(SCENES, REACH)), list(sweep(FAR, dict.fromkeys(REACH, FARTHEST)))
    kept = [result for *_, power, result in stated if power is None]
    unbroken = sum(power is None for *_, power, _ in further)
    lines = [
        "# Where results depend on the units",
        "",
        "`python benchmarks/scale_invariance.py --publish` writes this page: the first 100 steps of",
        f"{len(SCENES)} scenes in every scheme, with lengths times 10^±6, masses times 10^±9 and times",
        f"times 10^±3, by powers of two. Of {len(stated)} directions {len(kept)} give the same motion,",
        f"{sum(result == 0 for result in kept)} of them in the same bits. The others, with the factor from",
        "which on they fail, found by bisection:",
        "",
        *table(stated),
        "",
        f"Taken further, to 2^±{FARTHEST} ({2.0**FARTHEST:.1e}), {unbroken} of {len(further)} directions",
        "still give the same motion; the others fail here:",
        "",
        *table(further),
    ]
    return "\n".join(lines) + "\n"


def main(arguments):
    """Print the page, write it, or hold it against what it says."""
    from published import settled  # beside this file, which a test may load from elsewhere

    return settled(page(), PAGE, arguments, FACTORS)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
