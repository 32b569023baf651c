"""MuJoCo, built by MjSpec: bodies and joints only, and contact where a scene has contacts."""

import warnings
from collections.abc import Sequence
from contextlib import nullcontext
from math import isfinite
from typing import Any, ClassVar

import mujoco
import numpy as np
from scipy.spatial.transform import Rotation

from ..reference.checked import Array
from ..scenarios.blows import over_step, stretches
from ..scenarios.body import WIDTHS, Body, Joint
from ..scenarios.features import FEATURES
from ..scenarios.forces import Force
from ..scenarios.scene import Scene
from .centred import centred
from .engine import EngineError, Scheme, Setup, State
from .mujoco_burning import Masses
from .mujoco_contact import add_contacts, told
from .mujoco_forces import Forces
from .mujoco_looked import Look
from .mujoco_mjcf import mjcf
from .mujoco_parts import built
from .mujoco_reactions import reactions
from .mujoco_settings import SETTINGS
from .mujoco_solids import NO_HOLLOW, add_solids
from .mujoco_told import inertial_frame, world

#: Where a joint's coordinates lie among MuJoCo's, whose quaternions are scalar-first.
_PLACES = {"free": (0, 1, 2, 4, 5, 6, 3), "ball": (1, 2, 3, 0), "hinge": (0,), "slide": (0,)}
_SWITCHED_OFF = ("autoreset", "eulerdamp")
#: Switched off where nothing touches.
_FOR_CONTACT = ("contact", "constraint")
_FIRST_ORDER = {
    "contact": "MuJoCo's contact takes a whole step to act: only first-order schemes can carry it",
    "burning": "MuJoCo's masses stand still over a step: only first-order schemes can carry their fall",
    **NO_HOLLOW,
}
_NO_TURN = (1.0, 0.0, 0.0, 0.0)

_SOFT_CONTACT = {
    "contact": "it takes a contact's damper at the end of the step: one of 1/dt leaves half the speed of a "
    "blow, and none lets two bodies part",
    **NO_HOLLOW,
}


def _integrator(scheme: Scheme) -> str:
    return f"mjINT_{scheme.name.upper()}"


class MuJoCo:
    """MuJoCo behind the calls of ``Engine``.

    On a free body that carries no other, ``implicitfast`` and ``discrete`` do as ``implicit``;
    elsewhere they leave the gyroscopic term explicit, as ``Euler`` does. Both take dampers, and
    ``discrete`` springs too, at the end of the step. So each of the two is only its own twin.
    """

    name: ClassVar[str] = "mujoco"
    schemes: ClassVar[tuple[Scheme, ...]] = (
        Scheme("Euler", 1, "semi-implicit Euler", NO_HOLLOW),
        Scheme("implicit", 1, "implicit gyroscopic", NO_HOLLOW),
        Scheme("implicitfast", 1, "implicitfast", NO_HOLLOW),
        Scheme("RK4", 4, "RKMK4", _FIRST_ORDER),
        Scheme("discrete", 1, "discrete", _SOFT_CONTACT),
    )
    features: ClassVar[frozenset[str]] = frozenset(FEATURES)
    settings: ClassVar[dict[str, str]] = SETTINGS

    @staticmethod
    def version() -> str:
        """Version of the installed engine."""
        return str(mujoco.__version__)

    def build(self, scene: Scene, scheme: Scheme, dt: float) -> None:
        """Build ``scene`` at its initial state. Raises ``EngineError`` if MuJoCo refuses the model."""
        self.close()
        # Left alone, MuJoCo appends to MUJOCO_LOG.TXT in the working directory; its counters say as much.
        if mujoco.get_mju_user_warning() is None:
            mujoco.set_mju_user_warning(lambda message: None)
        self._centred = centred(scene)
        self._scene = scene = self._centred.scene
        self._scheme, self._steps = scheme, 0
        self._spec, bodies, joints = _spec(scene, scheme, dt)
        self._model = _compiled(self._spec, scene.full_name)
        _keep_small_offsets(self._model)
        self._locate([body.id for body in bodies], [joint.id for joint in joints])
        self._forces = Forces(mujoco, scene, self._bodies) if scene.forces else None
        self._forced = self._forces.acting if self._forces else nullcontext
        self._masses = Masses(mujoco, scene, self._model, self._bodies, dt) if scene.burning else None
        self._begin()

    def step(self, n: int) -> None:
        """Advance by ``n`` steps in MuJoCo's own loop."""
        for count, forces in stretches(self._scene.forces, self._model.opt.timestep, self._steps, n):
            with self._forced(forces):
                if self._masses is None:
                    mujoco.mj_step(self._model, self._data, nstep=count)
                else:
                    for k in range(count):
                        self._masses.at(self._steps + k)
                        mujoco.mj_step(self._model, self._data)
            self._steps += count

    def state(self) -> State:
        """Where everything is now. Raises ``EngineError`` if MuJoCo warned, reset itself or is not finite."""
        # A step leaves the kinematics of the state before it.
        state = self._look.at(self._qpos, self._qvel)
        self._sound(state)
        return state

    def readback(self) -> Setup:
        """How MuJoCo is set up, by its own account; nothing has to be probed."""
        model, values = self._model, world(mujoco, self._model)
        for body, i in zip(self._centred.before.bodies, self._bodies, strict=True):
            com, turn = inertial_frame(mujoco, model, i)
            values[f"body/{body.name}/mass"] = float(model.body_mass[i])
            values[f"body/{body.name}/center_of_mass"] = self._centred.center_of_mass(body, com)
            values[f"body/{body.name}/inertia"] = turn @ np.diag(model.body_inertia[i]) @ turn.T
        for joint, v in zip(self._scene.scalar_joints, self._scalar_v, strict=True):
            values[f"joint/{joint.name}/stiffness"] = float(model.jnt_stiffness[model.dof_jntid[v]])
            values[f"joint/{joint.name}/damping"] = float(model.dof_damping[v])
        return Setup({**values, **told(model, self._scene), **built(mujoco, model)})

    def acceleration(self, q: Array, v: Array) -> Array:
        """Generalised accelerations (nv,) at ``q`` and ``v``, laid out as the scene's ``q0`` and ``v0``.

        Contacts take no part: theirs depend on the step.
        """
        data = self._look.data
        q, v = self._centred.state(q, v)
        data.qpos[self._q], data.qvel[self._v] = q, v
        self._forward(self._scene.forces)
        return self._centred.acceleration(q, v, data.qacc_smooth[self._v])

    def reactions(self) -> Array:
        """Reactions (k, 6) now, of the bodies that the scene names, as ``Trajectory.reaction`` has them."""
        scene, model, data = self._scene, self._model, self._look.data
        data.qpos[:], data.qvel[:] = self._qpos, self._qvel
        self._forward(over_step(scene.forces, self._model.opt.timestep, self._steps))
        names = [body.name for body in scene.bodies]
        held = [int(self._bodies[names.index(name)]) for name in scene.reactions]
        outer = self._forces.found(model, data) if self._forces else None
        return reactions(mujoco, model, data, held, self._bodies, outer)

    def model_text(self) -> tuple[str, str]:
        """The model as MJCF, with every digit."""
        return "model.xml", mjcf(self._spec, self._scheme.name, _switched_off(self._scene))

    def close(self) -> None:
        """Let go of the model."""
        for name in ("_spec", "_model", "_data", "_qpos", "_qvel", "_warned", "_look"):
            self.__dict__.pop(name, None)

    def _locate(self, bodies: list[int], joints: list[int]) -> None:
        """Note where the scene's bodies and coordinates lie: MuJoCo sorts bodies depth first."""
        model, kinds = self._model, [joint.kind for joint in self._scene.joints]
        first_q, first_v = model.jnt_qposadr[joints], model.jnt_dofadr[joints]
        scalar = [kind in ("hinge", "slide") for kind in kinds]
        self._bodies = np.array(bodies)
        self._q = np.array(
            [i + k for kind, i in zip(kinds, first_q, strict=True) for k in _PLACES[kind]], int
        )
        self._v = np.array(
            [i + k for kind, i in zip(kinds, first_v, strict=True) for k in range(WIDTHS[kind][1])], int
        )
        self._scalar_q, self._scalar_v = first_q[scalar], first_v[scalar]

    def _begin(self) -> None:
        """Put the model at the scene's initial state."""
        self._data = mujoco.MjData(self._model)
        # Arrays that MuJoCo keeps in their place: to ask for one takes as long as to look into it.
        self._qpos, self._qvel, self._warned = self._data.qpos, self._data.qvel, self._data.warning.number
        self._qpos[self._q], self._qvel[self._v] = self._scene.q0, self._scene.v0
        self._look = Look(mujoco, self._model, self._bodies, self._scalar_q, self._scalar_v)

    def _forward(self, forces: Sequence[Force]) -> None:
        """Make of the scratch copy's coordinates and velocities all that follows from them and ``forces``."""
        # Under "discrete" qacc is the change of velocity over a whole step.
        option, euler = self._model.opt, mujoco.mjtIntegrator.mjINT_EULER
        chosen, option.integrator = option.integrator, euler
        with self._forced(forces):
            mujoco.mj_forward(self._model, self._look.data)
        option.integrator = chosen

    def _sound(self, state: State) -> None:
        data, dt = self._data, self._model.opt.timestep
        # Lists, as numpy takes ten times as long to look through so few numbers.
        if any(self._warned.tolist()):
            kinds = [mujoco.mjtWarning(int(i)).name for i in np.flatnonzero(self._warned)]
            raise EngineError(f"MuJoCo warned within {self._run()}: {', '.join(kinds)}", state)
        # Adding up dt rounds by far less than half a step; a reset starts the clock again.
        if abs(data.time - self._steps * dt) > dt / 2:
            raise EngineError(
                f"MuJoCo reset itself: its clock shows {data.time} s after {self._run()}", state
            )
        if not all(map(isfinite, self._qpos.tolist() + self._qvel.tolist())):
            raise EngineError(f"MuJoCo left the finite numbers within {self._run()}", state)

    def _run(self) -> str:
        return f"{self._steps} steps of {self._model.opt.timestep} s"


# Until release 4.0 RK4 averaged the body velocities of its stages: second order in attitude.
if int(MuJoCo.version().split(".")[0]) < 4:
    MuJoCo.schemes = tuple(
        Scheme("RK4", 2, "RK4 of body velocities", _FIRST_ORDER) if scheme.name == "RK4" else scheme
        for scheme in MuJoCo.schemes
        if hasattr(mujoco.mjtIntegrator, _integrator(scheme))
    )


def _spec(scene: Scene, scheme: Scheme, dt: float) -> tuple[Any, list[Any], list[Any]]:
    """The model's description, and in it the scene's bodies and joints."""
    spec = mujoco.MjSpec()
    spec.modelname = scene.full_name
    spec.option.integrator = getattr(mujoco.mjtIntegrator, _integrator(scheme))
    spec.option.timestep, spec.option.gravity = dt, scene.gravity
    for flag in _switched_off(scene):
        spec.option.disableflags |= int(getattr(mujoco.mjtDisableBit, f"mjDSBL_{flag.upper()}"))
    bodies: dict[str | None, Any] = {None: spec.worldbody}
    joints = []
    for body in scene.bodies:
        bodies[body.name] = _add_body(spec, bodies[body.parent], body)
        joints += [_add_joint(bodies[body.name], joint) for joint in body.joints]
    if scene.contacts:
        add_contacts(mujoco, spec, bodies, scene, dt)
    return spec, list(bodies.values())[1:], joints


def _switched_off(scene: Scene) -> tuple[str, ...]:
    return _SWITCHED_OFF if scene.contacts else (*_FOR_CONTACT, *_SWITCHED_OFF)


def _add_body(spec: Any, parent: Any, body: Body) -> Any:
    moments, iquat = _principal_axes(body.inertia_array)
    x, y, z, w = body.quaternion
    if body.solids:
        added = parent.add_body(name=body.name, pos=body.position, quat=(w, x, y, z))
        add_solids(mujoco, spec, added, body)
        return added
    return parent.add_body(
        name=body.name,
        pos=body.position,
        quat=(w, x, y, z),
        mass=body.mass,
        ipos=body.center_of_mass,
        iquat=iquat,
        inertia=moments,
        explicitinertial=True,
        # Else MuJoCo may take the mass matrix for diagonal although the centre is off by up to 1e-6 m.
        simple=iquat == _NO_TURN and not any(body.center_of_mass),
    )


def _add_joint(body: Any, joint: Joint) -> Any:
    kind = getattr(mujoco.mjtJoint, f"mjJNT_{joint.kind.upper()}")
    added = body.add_joint(name=joint.name, type=kind, axis=joint.axis)
    added.stiffness[0], added.damping[0] = joint.stiffness, joint.damping
    return added


def _principal_axes(inertia: Array) -> tuple[Array, tuple[float, ...]]:
    """Principal moments and the turn to their axes; until 3.14 MuJoCo found them only to 1e-6."""
    if np.array_equal(inertia, np.diag(np.diag(inertia))):
        moments, iquat = np.diag(inertia).copy(), _NO_TURN
    else:
        moments, axes = np.linalg.eigh(inertia)
        x, y, z, w = Rotation.from_matrix(axes * np.linalg.det(axes)).as_quat().tolist()
        iquat = (w, x, y, z)
    # MuJoCo grants no rounding to a plate, whose largest moment is the sum of the others.
    largest = int(np.argmax(moments))
    moments[largest] = min(moments[largest], np.delete(moments, largest).sum())
    return moments, iquat


def _compiled(spec: Any, name: str) -> Any:
    try:
        with warnings.catch_warnings():
            # Compiling looks at all coordinates zero, a pose that may be singular without ever being met.
            warnings.simplefilter("ignore")
            return spec.compile()
    except ValueError as error:
        raise EngineError(f"MuJoCo refuses {name}: {' '.join(str(error).split())}") from error


def _keep_small_offsets(model: Any) -> None:
    """Undo MuJoCo's taking an inertial frame within 1e-6 of the body's for the body's."""
    aligned = (model.body_ipos == 0).all(axis=1) & (model.body_iquat == _NO_TURN).all(axis=1)
    model.body_sameframe[~aligned] = mujoco.mjtSameFrame.mjSAMEFRAME_NONE
