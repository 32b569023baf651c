"""Record what each engine makes of input that no body has: refused, complained of, or run, and how.

    python benchmarks/unphysical_input.py             print the table
    python benchmarks/unphysical_input.py --publish   write reports/published/UNPHYSICAL.md
    python benchmarks/unphysical_input.py --check     hold that page against a new run; 1 if it differs

Each case is a free body, spinning in space without gravity, given to the engine as its users give it (MJCF,
URDF, Python calls) in a process of its own, and stepped 1000 times by 1 ms. Poinsot itself refuses every one
of them before an engine sees it: tests/scenarios/test_unphysical.py.
"""

import json
import subprocess
import sys
from importlib import metadata
from pathlib import Path

import numpy as np

PAGE = Path(__file__).resolve().parents[1] / "reports" / "published" / "UNPHYSICAL.md"
NAN = "nan"
#: Mass, principal moments, attitude (x y z w), axis of a hinge (none: a free body).
SOUND = {"mass": 1.0, "moments": [0.1, 0.2, 0.25], "products": [0, 0, 0], "turn": [0, 0, 0, 1], "axis": None}
CASES = {
    "a sound body": {},
    "a plate, I3 = I1 + I2 in floating point": {"moments": [0.1, 0.2, 0.1 + 0.2]},
    "a plate whose I3 is rounded up an ulp": {"moments": [0.1, 0.7, 0.8]},
    "a needle, I3 = 1e-6 I1": {"moments": [0.1, 0.1, 1e-7]},
    "I3 = (I1 + I2)(1 + 1e-6)": {"moments": [0.1, 0.2, 0.3 * (1 + 1e-6)]},
    "I3 = 10 (I1 + I2)": {"moments": [0.1, 0.2, 3.0]},
    "I3 = 0": {"moments": [0.1, 0.1, 0.0]},
    "I3 < 0": {"moments": [0.1, 0.2, -0.25]},
    "a tensor that is not positive definite": {"moments": [0.1, 0.1, 0.1], "products": [0.2, 0, 0]},
    "I3 not a number": {"moments": [0.1, 0.2, NAN]},
    "mass 0": {"mass": 0.0},
    "mass < 0": {"mass": -1.0},
    "mass not a number": {"mass": NAN},
    "a quaternion of norm 2": {"turn": [0, 0, 0, 2]},
    "a quaternion of norm 0": {"turn": [0, 0, 0, 0]},
    "a quaternion not a number": {"turn": [0, 0, 0, NAN]},
    "an axis of length 0": {"axis": [0, 0, 0]},
    "an axis of length 2": {"axis": [0, 0, 2]},
    "an axis not a number": {"axis": [0, 0, NAN]},
}

TOLD = """
import json, sys
import numpy as np
case = json.loads(sys.argv[1])
mass, (Ixx, Iyy, Izz) = float(case["mass"]), map(float, case["moments"])
Ixy, Ixz, Iyz = case["products"]
turn, axis, omega0, dt, steps = [float(x) for x in case["turn"]], case["axis"], (1.0, 0.5, 2.0), 1e-3, 1000
def tell(omega, used=None):
    print("TOLD " + json.dumps([[float(x) for x in omega], used]))
"""

MUJOCO = (
    TOLD
    + """
import mujoco
mujoco.set_mju_user_warning(lambda text: print("WARNED " + text))
x, y, z, w = turn
text = ('<mujoco><option timestep="%r" gravity="0 0 0"/><worldbody>' % dt
    + '<body quat="%r %r %r %r">' % (w, x, y, z)
    + ("<freejoint/>" if axis is None else '<joint axis="%s"/>' % " ".join(str(part) for part in axis))
    + '<inertial pos="0 0 0" mass="%r" fullinertia="%r %r %r %r %r %r"/></body></worldbody></mujoco>'
    % (mass, Ixx, Iyy, Izz, Ixy, Ixz, Iyz))
try:
    model = mujoco.MjModel.from_xml_string(text)
except ValueError as error:
    print("REFUSED " + " ".join(str(error).split()))
    sys.exit()
data = mujoco.MjData(model)
data.qvel[-3:] = omega0 if axis is None else omega0[2]
mujoco.mj_step(model, data, nstep=steps)
said = [mujoco.mjtWarning(int(i)).name for i in np.flatnonzero(data.warning.number)]
for name in said:
    print("WARNED " + name)
tell(data.qvel[-3:], [float(model.body_mass[1]), sorted(model.body_inertia[1].tolist())])
"""
)

PYBULLET = (
    TOLD
    + """
import tempfile, pathlib, pybullet as p
p.connect(p.DIRECT)
link = ('<link name="%s"><inertial><mass value="%r"/><inertia ixx="%r" iyy="%r" izz="%r" ixy="%r" ixz="%r" '
    'iyz="%r"/></inertial></link>')
body = link % ("body", mass, Ixx, Iyy, Izz, Ixy, Ixz, Iyz)
if axis is not None:
    body = (link % ("base", 0, 0, 0, 0, 0, 0, 0) + body + '<joint name="j" type="continuous">'
        '<parent link="base"/><child link="body"/><axis xyz="%s"/></joint>' % " ".join(map(str, axis)))
path = pathlib.Path(tempfile.mkdtemp()) / "model.urdf"
path.write_text('<robot name="r">' + body + "</robot>")
print("BEGIN", flush=True)
try:
    flags = p.URDF_USE_INERTIA_FROM_FILE
    uid = p.loadURDF(str(path), [0, 0, 0], turn, useFixedBase=axis is not None, flags=flags)
except p.error as error:
    print("REFUSED " + str(error))
    sys.exit()
p.setTimeStep(dt)
p.changeDynamics(uid, -1, linearDamping=0, angularDamping=0, maxJointVelocity=1e9)
if axis is None:
    p.resetBaseVelocity(uid, [0, 0, 0], omega0)
else:
    p.setJointMotorControl2(uid, 0, p.VELOCITY_CONTROL, force=0)
    p.resetJointState(uid, 0, 0, omega0[2])
for _ in range(steps):
    p.stepSimulation()
info = p.getDynamicsInfo(uid, -1 if axis is None else 0)
if axis is not None:
    tell([p.getJointState(uid, 0)[1]], [info[0], info[2]])
else:
    q, omega = np.array(p.getBasePositionAndOrientation(uid)[1]), np.array(p.getBaseVelocity(uid)[1])
    v, w = -q[:3], q[3]
    tell(omega + 2 * np.cross(v, np.cross(v, omega) + w * omega), [info[0], info[2]])
"""
)

PINOCCHIO = (
    TOLD
    + """
import pinocchio as pin
model = pin.Model()
model.gravity = pin.Motion.Zero()
tensor = np.array([[Ixx, Ixy, Ixz], [Ixy, Iyy, Iyz], [Ixz, Iyz, Izz]])
x, y, z, w = turn
try:
    joint = pin.JointModelFreeFlyer()
    if axis is not None:
        joint = pin.JointModelRevoluteUnaligned(np.array(axis, float))
    number = model.addJoint(0, joint, pin.SE3.Identity(), "joint")
    model.appendBodyToJoint(number, pin.Inertia(mass, np.zeros(3), tensor), pin.SE3.Identity())
    data = model.createData()
    q = np.array([0, 0, 0, *turn]) if axis is None else np.zeros(1)
    v = np.array([0, 0, 0, *omega0]) if axis is None else np.array([omega0[2]])
    for _ in range(steps):
        v = v + dt * pin.aba(model, data, q, v, np.zeros(model.nv))
        q = pin.integrate(model, q, v * dt)
except Exception as error:
    print("REFUSED " + " ".join(str(error).split()))
    sys.exit()
tell(v[-3:], [float(model.inertias[number].mass), np.diag(model.inertias[number].inertia).tolist()])
"""
)

ENGINES = {"mujoco": MUJOCO, "pybullet": PYBULLET, "pinocchio": PINOCCHIO}


def outcome(engine, case):
    """What became of one case in one engine, in words."""
    command = [sys.executable, "-c", ENGINES[engine], json.dumps(SOUND | case)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    lines = done.stdout.splitlines()
    refused = [line.removeprefix("REFUSED ") for line in lines if line.startswith("REFUSED ")]
    if refused:
        return f"refuses: {_short(refused[0])}"
    if done.returncode < 0:
        return f"dies of signal {-done.returncode}"
    told = [json.loads(line.removeprefix("TOLD ")) for line in lines if line.startswith("TOLD ")]
    if not told:
        return f"raises: {_short(done.stderr.splitlines()[-1])}"
    warned = [line.removeprefix("WARNED ") for line in lines if line.startswith("WARNED ")]
    if "BEGIN" in lines:  # what PyBullet prints, it prints from C
        warned += [line for line in lines[lines.index("BEGIN") + 1 :] if not line.startswith("TOLD ")]
    complaint = f"complains ({_short(' '.join(dict.fromkeys(warned)))}) and " if warned else ""
    omega, (mass, moments) = told[0]
    finite = all(abs(part) < float("inf") for part in omega)
    ends = f"ω = ({', '.join(f'{part:.4g}' for part in omega)})" if finite else "not finite"
    return f"{complaint}**runs** to {ends}{_changed(SOUND | case, mass, moments)}"


def _changed(case, mass, moments):
    """What the engine says of the body's mass and moments, where that is not what it was given."""
    given = np.array([case["mass"], *sorted(map(float, case["moments"]))], dtype=float)
    if np.allclose([mass, *sorted(moments)], given, rtol=1e-9, atol=0, equal_nan=True):
        return ""
    return f"; it says mass {mass:g}, moments {_numbers(moments)}"


def _numbers(values):
    return "(" + ", ".join(f"{value:.7g}" for value in values) + ")"


def _short(text, most=110):
    text = " ".join(text.replace("|", "/").split())
    return text if len(text) <= most else text[: most - 1] + "…"


def versions():
    """Each engine with its version."""
    packages = {"mujoco": "mujoco", "pybullet": "pybullet", "pinocchio": "pin"}
    return [f"{name} {metadata.version(package)}" for name, package in packages.items()]


def page():
    """The table, in Markdown."""
    lines = [
        "# What engines make of unphysical input",
        "",
        "`python benchmarks/unphysical_input.py --publish` writes this page. Each case is one body that",
        "spins at ω = (1, 0.5, 2) rad/s in space (or on a hinge, at 2 rad/s), given to the engine as its",
        "users give it (MJCF, URDF, Python calls) and stepped 1000 times by 1 ms in a process of its own.",
        "Poinsot refuses all of it before an engine is asked, but the sound body, the plates and the needle.",
        "ω is in body axes.",
        "",
        "| input | " + " | ".join(versions()) + " |",
        "|---|" + "---|" * len(versions()),
    ]
    for name, case in CASES.items():
        cells = [outcome(engine, case) for engine in ENGINES]
        lines.append(f"| {name} | " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def main(arguments):
    """Print the table, write it, or hold it against what it says."""
    from published import settled  # beside this file, which a test may load from elsewhere

    # Numbers are printed to four digits, the last of which may be rounded otherwise elsewhere.
    return settled(page(), PAGE, arguments, dict.fromkeys(versions(), 1.002))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
