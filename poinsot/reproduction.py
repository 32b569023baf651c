"""Scripts that build and step a scene in an engine as its maintainers would, with nothing of Poinsot."""

from collections.abc import Iterable

import numpy as np

from .adapters.engine import Engine, Scheme
from .adapters.pybullet_urdf import trees
from .reference.checked import Array
from .scenarios.scene import Scene

#: What a script can hold: everything else is set up over many calls.
PLAIN = frozenset({"free", "ball", "hinge", "slide", "weld", "tree", "gravity"})

#: What MuJoCo's own text of a model says beside.
MUJOCO = frozenset({"spring", "damper", "solid", "ellipsoid", "shell"})


def stands_alone(scene: Scene, engine: type[Engine]) -> bool:
    """Whether there is a script that needs the engine alone."""
    centred = not any(any(body.center_of_mass) for body in scene.bodies if _is_free(scene, body.name))
    if engine.name == "pybullet" and "solid" in scene.features:
        return True  # not the run, but what is wrong in it
    if engine.name == "pybullet":
        aligned = all(np.count_nonzero(body.inertia_array) == 3 for body in scene.bodies)
        return scene.features <= PLAIN and aligned and centred
    return engine.name == "mujoco" and scene.features <= PLAIN | MUJOCO


def script(scene: Scene, engine: type[Engine], scheme: Scheme, dt: float) -> str:
    """A Python script that runs the cell and prints where it ends, beside where it should end.

    It needs the engine alone where that is possible, Poinsot otherwise.
    """
    if not stands_alone(scene, engine):
        return _with_poinsot(scene, engine, scheme, dt)
    machine = engine()
    try:
        machine.build(scene, scheme, dt)
        _, model = machine.model_text()
    finally:
        machine.close()
    steps = scene.samples * scene.steps_per_sample(dt)
    if engine.name == "pybullet" and "solid" in scene.features:
        return "\n".join([f"MODEL = '''{model}'''", *_pybullet_moments(scene)])
    write = {"mujoco": _mujoco, "pybullet": _pybullet}[engine.name]
    return "\n".join([f"MODEL = '''{model}'''", *write(scene, scheme, dt, steps), *_exact(scene)])


def _mujoco(scene: Scene, scheme: Scheme, dt: float, steps: int) -> Iterable[str]:
    yield "import mujoco"
    yield "model = mujoco.MjModel.from_xml_string(MODEL)"
    yield "data = mujoco.MjData(model)"
    for _, joint, at_q, at_v in scene.slices():
        q, v = list(scene.q0[at_q]), list(scene.v0[at_v])
        if joint.kind in ("free", "ball"):
            q = [*q[:-4], q[-1], *q[-4:-1]]
        yield f"data.joint({joint.name!r}).qpos[:] = {q}"
        yield f"data.joint({joint.name!r}).qvel[:] = {v}"
    yield f"mujoco.mj_step(model, data, nstep={steps})"
    yield "mujoco.mj_forward(model, data)"
    for body in scene.bodies:
        yield (
            f"print({body.name!r}, data.body({body.name!r}).xipos, "
            f"data.body({body.name!r}).xquat[[1, 2, 3, 0]])"
        )


def _pybullet(scene: Scene, scheme: Scheme, dt: float, steps: int) -> Iterable[str]:
    maximal = scheme.name == "maximal coordinates"
    yield "import math, pathlib, tempfile"
    yield "import pybullet as p"
    yield "from scipy.spatial.transform import Rotation"
    yield "p.connect(p.DIRECT)"
    yield f"p.setPhysicsEngineParameter(fixedTimeStep={dt!r}, numSubSteps=0)"
    yield f"p.setGravity(*{scene.gravity})"
    yield "found = []"
    yield "for number, text in enumerate(MODEL.split('<?xml')[1:]):"
    yield "    path = pathlib.Path(tempfile.mkdtemp()) / f'model{number}.urdf'"
    yield "    path.write_text('<?xml' + text)"
    yield (
        f"    found.append(p.loadURDF(str(path), useMaximalCoordinates={maximal}, "
        "flags=p.URDF_USE_INERTIA_FROM_FILE))"
    )
    yield "joints = {}"
    yield "for body in found:"
    if not scene.defaults:
        yield "    p.changeDynamics(body, -1, linearDamping=0, angularDamping=0, maxJointVelocity=math.inf,"
        yield "                     activationState=p.ACTIVATION_STATE_DISABLE_SLEEPING)"
    yield "    for link in range(p.getNumJoints(body)):"
    yield "        _, name, kind, *_ = p.getJointInfo(body, link)"
    yield "        joints[name.decode()] = body, link"
    if not scene.defaults:
        yield "        if kind == p.JOINT_SPHERICAL:"
        yield "            p.setJointMotorControlMultiDof(body, link, p.POSITION_CONTROL,"
        yield "                                           targetPosition=[0, 0, 0, 1], force=[0, 0, 0])"
        yield "        elif kind != p.JOINT_FIXED:"
        yield "            p.setJointMotorControl2(body, link, p.VELOCITY_CONTROL, force=0)"
    yield from _placed(scene)
    yield f"for _ in range({steps}):"
    yield "    p.stepSimulation()"
    yield "for body in found:"
    yield "    if not joints:"
    yield "        print(*p.getBasePositionAndOrientation(body))"
    yield "    for link in range(p.getNumJoints(body)):"
    yield "        print(*p.getLinkState(body, link, 1, 1)[:2])"


def _pybullet_moments(scene: Scene) -> Iterable[str]:
    """What PyBullet makes of solids when it loads them, beside what their moments are."""
    yield "import pathlib, re, tempfile"
    yield "import pybullet as p"
    yield "p.connect(p.DIRECT)"
    yield "folder = pathlib.Path(tempfile.mkdtemp())"
    yield "for name, text in re.findall('<!-- (.*?)\\n(.*?)-->', MODEL, re.DOTALL):"
    yield "    (folder / name).write_text(text)"
    yield "for number, text in enumerate(MODEL.split('<?xml')[1:]):"
    yield "    path = folder / f'model{number}.urdf'"
    yield "    path.write_text('<?xml' + text)"
    yield "    body = p.loadURDF(str(path), flags=p.URDF_USE_IMPLICIT_CYLINDER)"
    yield "    for link in range(-1, p.getNumJoints(body)):"
    yield "        mass, _, moments, *_ = p.getDynamicsInfo(body, link)"
    yield "        if mass:"
    yield "            print(mass, sorted(moments))"
    yield "# Exactly they are (mass [kg], principal moments [kg m²]):"
    for body in scene.bodies:
        moments = np.asarray(np.linalg.eigvalsh(body.inertia_array), dtype=np.float64)
        yield f"# {body.name}: {body.mass:.15g} {_numbers(moments)}"


def _placed(scene: Scene) -> Iterable[str]:
    """Where everything starts; links and joints are numbered as the URDF numbers them."""
    tree_of = {body: number for number, tree in enumerate(trees(scene)) for body in tree}
    numbers = {body.name: number for number, body in enumerate(scene.bodies)}
    for body, joint, at_q, at_v in scene.slices():
        q, v, number = list(scene.q0[at_q]), list(scene.v0[at_v]), numbers[body.name]
        name = f"joint {number}.{body.joints.index(joint)}"
        if joint.kind == "free":
            base = f"found[{tree_of[number]}]"
            yield f"p.resetBasePositionAndOrientation({base}, {q[:3]}, {q[3:]})"
            yield f"spin = Rotation.from_quat({q[3:]}).apply({v[3:]})"
            yield f"p.resetBaseVelocity({base}, {v[:3]}, list(spin))"
        elif joint.kind == "ball":
            yield f"p.resetJointStateMultiDof(*joints[{name!r}], {q}, {v})"
        else:
            yield f"p.resetJointState(*joints[{name!r}], {q[0]!r}, {v[0]!r})"


def _with_poinsot(scene: Scene, engine: type[Engine], scheme: Scheme, dt: float) -> str:
    return "\n".join(
        [
            "import poinsot",
            f"run = poinsot.simulate({scene.full_name!r}, {engine.name!r}, {scheme.name!r}, dt={dt!r})",
            "for verdict in poinsot.judge(run):",
            "    print(verdict.check, verdict.observable, verdict.status.value, verdict.measured,",
            "          verdict.allowed, verdict.unit, verdict.message)",
        ]
    )


def _exact(scene: Scene) -> Iterable[str]:
    """Where the exact motion ends, as a comment."""
    motion = scene.truth(scene, np.array([0.0, scene.duration]))
    yield "# The exact motion ends at (centre of mass, quaternion with the scalar last):"
    for body, place, turn in zip(scene.bodies, motion.position[-1], motion.quaternion[-1], strict=True):
        yield f"# {body.name}: {_numbers(place)} {_numbers(turn)}"


def _numbers(values: Array) -> str:
    return str([float(f"{value:.15g}") for value in values])


def _is_free(scene: Scene, name: str) -> bool:
    return any(body.name == name and joint.kind == "free" for body, joint, *_ in scene.slices())
