"""Print the largest stable step of every scheme, measured over theory, at every value of a family.

    python benchmarks/stability_limits.py [FAMILY ...]

By default a mass on springs of 1e2 to 1e10 N/m; families as `poinsot list` names them, those that theory
knows a limit of. Each limit is found by halving to 0.5 %; "any": holds at every step; "none": grows at every
one. "worst" is how far what is shown lies from theory, "open" how far the limit may lie from what is shown.
Seconds are CPU time for all of a line. Last, two free bodies on a spring, for schemes without joints.
"""

import math
import sys
from time import process_time

from poinsot.adapters import registry
from poinsot.adapters.simulate import unsupported
from poinsot.adapters.stable_step import stable_step
from poinsot.reports.stability import between, bracket, deviation
from poinsot.scenarios.families import select
from poinsot.scenarios.registry import scenes


def measured(scene, engine, scheme):
    """The limit over theory's in a few characters, how far it is from it, and what the halving left open."""
    machine = engine()
    try:
        held, grew = stable_step(machine, scene, scheme)
    finally:
        machine.close()
    theory, limit = scene.stable_step(scene, scheme.twin), between(held, grew)
    kinds = {0.0: "none", math.inf: "any"}
    shown = kinds.get(limit) or (f"{limit / theory:.4f}" if theory not in kinds else f"{limit:.1e}!")
    return shown, deviation(held, grew, theory), bracket(held, grew)


def table(title, cases):
    """One line a scheme: its limit in each of the ``cases``, scenes by what to call them."""
    print(f"\n{title}\n{'':33s}" + "".join(f"{name:>9s}" for name in cases) + "    worst     open")
    for engine in registry.engines().values():
        for scheme in () if isinstance(engine, str) else engine.schemes:
            if any(unsupported(scene, engine, scheme) for scene in cases.values()):
                continue
            began = process_time()
            shown, worst, left = zip(
                *(measured(scene, engine, scheme) for scene in cases.values()), strict=True
            )
            print(f"{engine.name + ' ' + scheme.name:33s}" + "".join(f"{each:>9s}" for each in shown)
                  + f"  {max(worst):7.1e}  {max(left):7.1e}  {process_time() - began:5.1f} s")  # fmt: skip


if __name__ == "__main__":
    for family in select(sys.argv[1:] or ["stiff_spring"]):
        scenes_of = {f"{value:g}": family.scene(value) for value in family.values}
        if all(scene.stable_step for scene in scenes_of.values()):
            table(f"{family.name}: {family.parameter}", scenes_of)
    table("two_body[spring]", {"": scenes()["two_body[spring]"]})
