"""Print the largest stable step of every scheme against theory, as ωdt, and how it follows the stiffness.

    python benchmarks/stability_limits.py [STIFFNESS ...]

A mass of 1 kg on a spring of each stiffness [N/m], by default 1e2 to 1e10; two free bodies on a spring, for
schemes without joints. Each limit is found by halving to 0.5 %; seconds are CPU time for all of a line.
"""

import sys
from time import process_time

from poinsot.adapters import registry
from poinsot.adapters.simulate import unsupported
from poinsot.adapters.stable_step import stable_step
from poinsot.reports.stability import between
from poinsot.scenarios.registry import scenes
from poinsot.scenarios.stiff_spring import on_spring


def line(cases, engine, scheme):
    """ωdt at the limit in each of the cases (scene, ω), and the largest deviation from theory."""
    shown, worst, began = [], 0.0, process_time()
    for scene, omega in cases:
        if unsupported(scene, engine, scheme):
            shown.append("–")
            continue
        machine = engine()
        measured = between(*stable_step(machine, scene, scheme)) * omega
        machine.close()
        theory = scene.stable_step(scene, scheme.twin) * omega
        shown.append(f"{measured:.4f}")
        worst = max(worst, 0.0 if measured == theory else abs(measured / theory - 1))
    print(f"{engine.name + ' ' + scheme.name:32s} {theory:7.4f}  " + "  ".join(f"{s:>7s}" for s in shown)
          + f"   {worst:8.1e}  {process_time() - began:5.1f} s")  # fmt: skip


if __name__ == "__main__":
    stiffnesses = [float(text) for text in sys.argv[1:]] or [10.0**k for k in range(2, 11)]
    cases = [(on_spring(k), k**0.5) for k in stiffnesses]
    pair = scenes()["two_body[spring]"]
    cases.append((pair, 2 / pair.stable_step(pair, "semi-implicit Euler")))
    print(f"{'':32s} theory   " + "  ".join(f"{k:7.0e}" for k in stiffnesses) + "     pair   deviation")
    for engine in registry.engines().values():
        for scheme in () if isinstance(engine, str) else engine.schemes:
            line(cases, engine, scheme)
