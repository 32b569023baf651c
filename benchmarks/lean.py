"""Print what leanness buys: the cost of a step as Poinsot builds a scene, and as the engine would have it.

    python benchmarks/lean.py [SCENE ...]     print the table
    python benchmarks/lean.py --publish       write reports/published/LEAN.md
    python benchmarks/lean.py --check         hold that page against a new run; 1 if it differs

The same motion is stepped twice in one run, by turns: in the model that holds only what the scene names, and
in one with what users mostly give an engine: MuJoCo with all it does by default and a shape on every body
above a floor; PyBullet with a shape and a picture on every link above a floor, stepped one by one;
Pinocchio in the loop one writes down, with a shape on every body above a floor, looked at for contact.
Nothing touches, so that the states must agree to 1e-9. The least of many times counts.
"""

import gc
import importlib
import sys
from pathlib import Path
from time import perf_counter

import numpy as np
from poinsot.adapters import registry, timing
from poinsot.scenarios.registry import select

PAGE = Path(__file__).resolve().parents[1] / "reports" / "published" / "LEAN.md"
DT, STEPS, ROUNDS = 1e-4, 256, 100
SCENES = ("free_symmetric_top[oblate]", "heavy_top[moderate]", "double_pendulum[small]")
#: Small shapes, and a floor far below all of them [m]: nothing ever touches.
SIZE, FLOOR = 1e-3, -100.0
#: How far the two motions may be apart.
SAME = 1e-9
#: Times are a machine's own. Their ratio differed by 8 % between an idle and a busy one: thrice that.
FACTORS = {"lean": float("inf"), "laden": float("inf"), "ratio": 1.25, "states apart": float("inf")}


def mujoco_laden(engine, scene):
    """MuJoCo as it comes, with shapes and a floor."""
    mujoco = importlib.import_module("mujoco")
    spec = engine._spec
    spec.option.disableflags = 0
    for body in spec.bodies[1:]:
        body.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[SIZE, 0, 0], mass=0)
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=[0, 0, 1], pos=[0, 0, FLOOR])
    engine._model = spec.compile()
    engine._begin()
    return engine.step


def pybullet_laden(engine, scene):
    """PyBullet with shapes and a floor, one call a step."""
    module = importlib.import_module("poinsot.adapters.pybullet_")
    loading = importlib.import_module("poinsot.adapters.pybullet_loading")
    p, plain, client = module.p, loading.urdf, engine._world.client
    form = f'<geometry><sphere radius="{SIZE}"/></geometry>'
    shapes = f"  <visual>{form}</visual><collision>{form}</collision>\n</link>"
    loading.urdf = lambda *of: plain(*of).replace("</link>", shapes)
    try:
        engine._world = module._World(client, scene, False, DT)
    finally:
        loading.urdf = plain
    engine._world.place(np.array(scene.q0), np.array(scene.v0))
    floor = p.createCollisionShape(p.GEOM_PLANE, physicsClientId=client)
    p.createMultiBody(0, floor, basePosition=[0, 0, FLOOR], physicsClientId=client)

    def step(n):
        for _ in range(n):
            engine._world.advance(1)

    return step


def pinocchio_laden(engine, scene):
    """Pinocchio as one writes it down, and its geometry placed and looked at for contact at every step."""
    pin = importlib.import_module("pinocchio")
    coal, model, data = importlib.import_module("coal"), engine._model, engine._data
    shapes = pin.GeometryModel()
    for frame in engine._frames:
        shape = pin.GeometryObject(frame.name, frame.parentJoint, frame.placement, coal.Sphere(SIZE))
        shapes.addGeometryObject(shape)
    under = pin.SE3(np.eye(3), np.array([0.0, 0.0, FLOOR]))
    shapes.addGeometryObject(pin.GeometryObject("floor", 0, under, coal.Halfspace(0.0, 0.0, 1.0, 0.0)))
    shapes.addAllCollisionPairs()
    found = shapes.createData()

    def step(n):
        tau = np.zeros(model.nv)
        for _ in range(n):
            pin.computeCollisions(model, data, shapes, found, engine._position, False)
            engine._velocity = engine._velocity + DT * pin.aba(
                model, data, engine._position, engine._velocity, tau
            )
            engine._position = pin.integrate(model, engine._position, DT * engine._velocity)

    return step


LADEN = {"mujoco": mujoco_laden, "pybullet": pybullet_laden, "pinocchio": pinocchio_laden}


def compared(scene, engine):
    """Microseconds a step, lean and laden, and how far the two motions are apart in the end."""
    lean, laden = engine(), engine()
    for machine in (lean, laden):
        machine.build(scene, engine.schemes[0], DT)
    steps = (lean.step, LADEN[engine.name](laden, scene))
    times = ([], [])
    for _ in range(ROUNDS):
        for step, found in zip(steps, times, strict=True):
            gc.disable()
            start = perf_counter()
            step(STEPS)
            found.append(perf_counter() - start)
            gc.enable()
    apart = max(
        float(np.abs(one - other).max(initial=0))
        for one, other in zip(lean.state(), laden.state(), strict=True)
    )
    lean.close()
    laden.close()
    return *(1e6 * min(found) / STEPS for found in times), apart


def page(rows):
    """The table, in Markdown."""
    lines = [
        "# What leanness buys",
        "",
        "`python benchmarks/lean.py --publish` writes this page: microseconds a step of the model that holds",
        "only what the scene names, and of one with shapes on every body above a floor and the engine's",
        "own defaults, in one run by turns. Nothing touches; the last column is how far the two end apart.",
        "",
        "| scene | engine | lean | laden | ratio | states apart |",
        "|---|---|---|---|---|---|",
    ]
    for scene, name, lean, laden, apart in rows:
        lines.append(f"| `{scene}` | {name} | {lean:.2f} | {laden:.2f} | {laden / lean:.2f} | {apart:.0e} |")
    return "\n".join(lines) + "\n"


def main(arguments):
    """Measure each scene in each engine; 1 if a motion is not the same."""
    timing.pin()
    names = [name for name in arguments if not name.startswith("--")] or list(SCENES)
    rows = []
    for scene in select(names):
        for name in LADEN:
            engine = registry.load(name)
            rows.append((scene.full_name, f"{name} {engine.version()}", *compared(scene, engine)))
    if max(row[-1] for row in rows) > SAME:
        sys.stdout.write(page(rows))
        return 1
    from published import settled  # beside this file, which a test may load from elsewhere

    return settled(page(rows), PAGE, arguments, FACTORS)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
