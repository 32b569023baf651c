"""Print how exact each scheme is, at which order it converges, and how closely twins agree.

    python benchmarks/accuracy.py [SCENE ...]

Errors are the largest over the run at the scene's own step; orders are fitted over the scheme's ladder;
a twin's difference is relative to the state's size, over every sample and every step of the ladder.
"""

import sys
from collections import defaultdict

from poinsot.adapters import registry
from poinsot.adapters.simulate import simulate, unsupported
from poinsot.reports.cell import Cell
from poinsot.reports.growth import growth
from poinsot.reports.judge import judge
from poinsot.scenarios.registry import scenes, select


def runs(scene):
    """Every trajectory of every scheme over its ladder and at the scene's own step."""
    for engine in registry.engines().values():
        for scheme in () if isinstance(engine, str) else engine.schemes:
            if not unsupported(scene, engine, scheme):
                for dt in sorted({*scene.ladder(scheme.order, scheme.twin), scene.dt}, reverse=True):
                    yield simulate(scene, engine, scheme, dt)[0]


def table(scene):
    """One line a scheme: errors at the scene's step, orders, the worst twin."""
    trajectories = list(runs(scene))
    by_scheme, orders, twins = defaultdict(list), defaultdict(dict), defaultdict(float)
    for trajectory in trajectories:
        by_scheme[trajectory.provenance.engine, trajectory.provenance.scheme].append(trajectory)
    for verdict in judge(trajectories):
        key = verdict.engine, verdict.scheme
        if verdict.check == "order":
            orders[key][verdict.observable] = verdict.message.removeprefix("fitted order ").split(" over")[0]
        if verdict.check == "twin" and verdict.measured is not None:
            twins[key] = max(twins[key], verdict.measured)
    A = growth(scene)
    print(f"\n{scene.full_name}: errors at dt {scene.dt:g} s over {scene.duration:g} s; A = {A:.3g}, "
          f"twins may differ by {1e-12 + 1e-13 * A:.1e}")  # fmt: skip
    states = [observable for observable in scene.observables if observable.kind == "state"]
    for key, mine in by_scheme.items():
        own = next(Cell.of(t, scenes()) for t in mine if t.provenance.dt == scene.dt)
        errors = "  ".join(f"{o.name} {own.error(o):.2e} {o.unit}" for o in states)
        fitted = "  ".join(f"{name} {text}" for name, text in orders[key].items())
        twin = f"{twins[key]:.1e}" if key in twins else "none"
        print(f"  {' '.join(key):32s} error {errors} | order {fitted} | twin {twin}")


if __name__ == "__main__":
    for chosen in select(sys.argv[1:] or ["free_symmetric_top", "heavy_top", "co2_chain"]):
        table(chosen)
