"""Measure the error constants C of C·dt^order that scenes record, and print them as the scene keeps them.

    python benchmarks/error_constants.py free_symmetric_top heavy_top

C is the largest error over dt^order on the ladder of each scheme, rounded up to two digits; where no
step is clear of round-off it is 0, and round-off alone is allowed. What is fitted to a motion, and what is
largest between two looks, depends on how often it is looked at: C is the largest over the scene's own looks
and up to half as many more, but where something bounces, which the scene wants in one part of a step, and
where a blow sets in and ends, which it must at a look: there at half as many more alone.
"""

import sys
from dataclasses import replace
from math import ceil, floor, log10
from pprint import pformat

from poinsot.adapters import registry
from poinsot.adapters.simulate import simulate, unsupported
from poinsot.reports.cell import Cell
from poinsot.scenarios.registry import select


def constant(cells, observable):
    """Largest error over dt^order among the cells that are clear of round-off."""
    clear = [(cell.error(observable), cell) for cell in cells]
    found = [
        error / cell.provenance.dt**cell.provenance.order
        for error, cell in clear
        if error > cell.round_off(observable)
    ]
    return rounded_up(max(found, default=0.0))


def looks(scene):
    """The scene, looked at ever more often."""
    bounces = any(not contact.friction for contact in scene.contacts)
    shares = (
        (1.0,) if bounces else (1.0, 1.04, 1.08, 1.13, 1.17, 1.21, 1.25, 1.3, 1.34, 1.38, 1.42, 1.46, 1.5)
    )
    if "blow" in scene.features:
        shares = (1.0, 1.5)  # between two looks no blow may set in
    return [replace(scene, samples=round(share * scene.samples)) for share in shares]


def rounded_up(value):
    """``value`` with two significant digits, never less than it was."""
    if value == 0:
        return 0.0
    unit = 10.0 ** (floor(log10(value)) - 1)
    return float(f"{ceil(value / unit) * unit:.2g}")


def measured(scene):
    """``{twin: (C, …)}`` of one scene, a C for each observable, over every scheme that is installed."""
    found, versions = {}, {}
    for engine in registry.engines().values():
        for scheme in () if isinstance(engine, str) else engine.schemes:
            if scheme.twin in found or unsupported(scene, engine, scheme):
                continue
            steps = sorted({*scene.ladder(scheme.order, scheme.twin), scene.dt})
            cells = [
                Cell.of(simulate(looked, engine, scheme, dt)[0], {scene.full_name: looked})
                for looked in looks(scene)
                for dt in steps
            ]
            found[scheme.twin] = tuple(constant(cells, o) for o in scene.observables)
            versions[engine.name] = engine.version()
    return found, versions


if __name__ == "__main__":
    for chosen in select(sys.argv[1:]):
        table, by = measured(chosen)
        print(f"# {chosen.full_name}: {', '.join(f'{name} {version}' for name, version in by.items())}")
        print(f'"{chosen.variant}": {pformat(table, width=105, sort_dicts=False)},')
