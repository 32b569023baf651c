"""Pinocchio: its equations of motion, stepped by the integrators of ``pinocchio_schemes``."""

from collections.abc import Callable, Iterator
from functools import partial
from math import isfinite
from typing import Any, ClassVar

import numpy as np
import pinocchio as pin

from ..reference.checked import Array
from ..scenarios.blows import over_step, stretches
from ..scenarios.body import WIDTHS, Body, Joint
from ..scenarios.features import FEATURES
from ..scenarios.scene import Scene
from .centred import centred
from .engine import EngineError, Scheme, Setup, State
from .pinocchio_burning import Masses
from .pinocchio_contact import Contacts
from .pinocchio_forces import Forces
from .pinocchio_json import model_json
from .pinocchio_parts import built
from .pinocchio_schemes import Advance, Mechanism, implicit_gyroscopic, rkmk4, semi_implicit_euler
from .pinocchio_solids import NO_SHELL, inertia

_ADVANCE: dict[str, Advance] = {
    "semi-implicit Euler": semi_implicit_euler,
    "implicit gyroscopic": implicit_gyroscopic,
    "RKMK4": rkmk4,
}


class Pinocchio:
    """Pinocchio behind the calls of ``Engine``."""

    name: ClassVar[str] = "pinocchio"
    schemes: ClassVar[tuple[Scheme, ...]] = (
        Scheme("semi-implicit Euler", 1, "semi-implicit Euler", NO_SHELL),
        Scheme("implicit gyroscopic", 1, "implicit gyroscopic", NO_SHELL),
        Scheme(
            "RKMK4",
            4,
            "RKMK4",
            NO_SHELL
            | {
                "contact": "contact takes a whole step to act: only first-order schemes carry it",
                "burning": "Poinsot's Runge-Kutta knows no time within a step at which to take a mass",
            },
        ),
    )
    features: ClassVar[frozenset[str]] = frozenset(FEATURES)
    settings: ClassVar[dict[str, str]] = {
        "integrators": "Poinsot's own: Pinocchio gives accelerations, and q ⊕ dq",
        "free bodies": "at their centre of mass, a translation and then a ball joint, velocity in world axes "
        "(a FreeFlyer's, in body axes, is another and worse scheme)",
        "solids": "their volume, centre and inertia are those of Coal, which Pinocchio comes with",
        "springs, dampers and forces": "joint forces of ours, taken where the scheme takes its accelerations",
        "reactions": "by rnea, at the accelerations that aba gives in the very state, and told of its forces",
        "contacts": "points, normals and gaps are Poinsot's own; the impulses are those of Pinocchio's "
        "projected Gauss-Seidel solver, at the end of each step",
    }

    @staticmethod
    def version() -> str:
        """Version of the installed engine."""
        return str(pin.__version__)

    def build(self, scene: Scene, scheme: Scheme, dt: float) -> None:
        """Build ``scene`` at its initial state."""
        self._centred = centred(scene)
        self._scene = scene = self._centred.scene
        self._dt, self._steps = dt, 0
        self._advance = _ADVANCE[scheme.name]
        self._model, self._frames, joints = _model(scene)
        self._data = self._model.createData()
        self._locate(joints)
        self._mechanism = self._described_to_schemes()
        self._masses = Masses(pin, scene, self._model, self._frames, dt) if scene.burning else None
        self._position, self._velocity = self._ours_to_pinocchio(scene.q0, scene.v0)
        self._position = pin.normalize(self._model, self._position)

    def step(self, n: int) -> None:
        """Advance by ``n`` steps of the scheme."""
        for count, forces in stretches(self._scene.forces, self._dt, self._steps, n):
            self._outer.let_act(forces)
            if self._masses is None:
                self._take(count)
                continue
            for _ in range(count):
                self._masses.at(self._steps)
                self._take(1)

    def _take(self, n: int) -> None:
        self._position, self._velocity = self._advance(
            self._mechanism, self._position, self._velocity, self._dt, n
        )
        self._steps += n

    def state(self) -> State:
        """Where everything is now. Raises ``EngineError`` if a number is not finite."""
        q, v = self._position, self._velocity
        pin.forwardKinematics(self._model, self._data, q, v)
        bodies = [self._body_state(joint, centre) for joint, centre in self._centres]
        position, quaternion, velocity, omega = (np.array(part) for part in zip(*bodies, strict=True))
        state = State(position, quaternion, velocity, omega, q[self._scalar_q], v[self._scalar_v])
        if not all(map(isfinite, q.tolist() + v.tolist())):
            run = f"{self._steps} steps of {self._dt} s"
            raise EngineError(f"Pinocchio left the finite numbers within {run}", state)
        return state

    def readback(self) -> Setup:
        """How Pinocchio is set up, by its own account; springs, dampers and dt are our integrators'."""
        values: dict[str, Any] = {
            "gravity": self._model.gravity.linear.copy(),
            "dt": self._dt,
            "velocity_limit": np.inf,
            "linear_damping": 0.0,
            "angular_damping": 0.0,
        }
        for body, frame in zip(self._centred.before.bodies, self._frames, strict=True):
            inertia = self._moved(frame)
            values[f"body/{body.name}/mass"] = float(inertia.mass)
            values[f"body/{body.name}/center_of_mass"] = self._centred.center_of_mass(body, inertia.lever)
            values[f"body/{body.name}/inertia"] = inertia.inertia.copy()
        for joint, (_, stiffness, damping) in zip(self._scene.scalar_joints, self._springs(), strict=True):
            values[f"joint/{joint.name}/stiffness"] = stiffness
            values[f"joint/{joint.name}/damping"] = damping
        for contact in self._scene.contacts:  # ours, so that there is nothing to read back
            values[f"contact/{contact.name}/friction"] = contact.friction
            values[f"contact/{contact.name}/restitution"] = contact.restitution
        return Setup(values | built(pin, self._model, self._contacts))

    def acceleration(self, q: Array, v: Array) -> Array:
        """Generalised accelerations (nv,) at ``q`` and ``v``, laid out as the scene's ``q0`` and ``v0``.

        Contacts take no part: theirs depend on the step.
        """
        q, v = self._centred.state(q, v)
        position, velocity = self._ours_to_pinocchio(q, v)
        self._outer.let_act(self._scene.forces)
        force = self._mechanism.force(position, velocity)
        found = pin.aba(self._model, self._data, position, velocity, force)[self._v]
        return self._centred.acceleration(q, v, found)

    def reactions(self) -> Array:
        """Reactions (k, 6) now, of the bodies that the scene names, as ``Trajectory.reaction`` has them."""
        model, data, q, v = self._model, self._data, self._position, self._velocity
        self._outer.let_act(over_step(self._scene.forces, self._dt, self._steps))
        a = pin.aba(model, data, q, v, self._mechanism.force(q, v))
        pin.rnea(model, data, q, v, a, self._outer.on_joints(q, v))
        last = {frame.name: frame.parentJoint for frame in self._frames}
        return np.array([data.f[last[name]].vector for name in self._scene.reactions])

    def model_text(self) -> tuple[str, str]:
        """The model as JSON, every joint and body with every digit; a URDF could not hold ball joints."""
        return "model.json", model_json(self._model, self._frames, self._springs(), self._dt)

    def close(self) -> None:
        """Let go of the model."""
        for name in ("_model", "_data", "_frames", "_centres", "_mechanism"):
            self.__dict__.pop(name, None)

    def _locate(self, joints: list[int]) -> None:
        """Note where the scene's bodies and coordinates lie: Pinocchio's joints are sorted depth first."""
        model, places = self._model, list(zip(self._scene.joints, joints, strict=True))
        scalar = [i for joint, i in places if joint.kind in ("hinge", "slide")]
        self._q = np.array(
            [model.idx_qs[i] + k for joint, i in places for k in range(WIDTHS[joint.kind][0])], int
        )
        self._v = np.array(
            [model.idx_vs[i] + k for joint, i in places for k in range(WIDTHS[joint.kind][1])], int
        )
        self._scalar_q = np.array([model.idx_qs[i] for i in scalar], int)
        self._scalar_v = np.array([model.idx_vs[i] for i in scalar], int)
        self._centres = [
            (frame.parentJoint, frame.placement * pin.SE3(np.eye(3), frame.inertia.lever))
            for frame in self._frames
        ]

    def _ours_to_pinocchio(self, q: Any, v: Any) -> tuple[Array, Array]:
        position, velocity = np.empty(self._model.nq), np.empty(self._model.nv)
        position[self._q], velocity[self._v] = q, v
        return position, velocity

    def _described_to_schemes(self) -> Mechanism:
        model, data, rest = self._model, self._data, np.zeros(self._model.nv)
        self._pull, self._drag = np.zeros((model.nv, model.nq)), np.zeros((model.nv, model.nv))
        for joint, i, j in zip(self._scene.scalar_joints, self._scalar_v, self._scalar_q, strict=True):
            self._pull[i, j], self._drag[i, i] = -joint.stiffness, -joint.damping
        force = _spring_force(self._pull, self._drag)
        self._outer = Forces(pin, model, self._scene, self._centres)
        if self._scene.forces:
            force = _sum(force, self._outer.along_velocities)

        # Where a free body is and how fast it flies changes nothing in M or ∂f/∂v but, as Pinocchio takes
        # them in world axes, their rounding: look at them at the origin, at rest.
        at_origin, at_rest = np.ones(model.nq), np.ones(model.nv)
        for i in range(1, model.njoints):
            if model.nvs[i] == 3 and model.nqs[i] == 3:
                at_origin[model.idx_qs[i] :][:3] = at_rest[model.idx_vs[i] :][:3] = 0

        def linearised(q: Array, v: Array) -> tuple[Array, Array]:
            pin.computeRNEADerivatives(model, data, q * at_origin, v * at_rest, rest)
            return data.M, data.dtau_dv - self._drag

        balls = [int(model.idx_vs[i]) for i in range(1, model.njoints) if model.nqs[i] == 4]
        scene, frames = self._scene, self._frames
        self._contacts = Contacts(pin, model, scene, frames, self._dt) if scene.contacts else None
        touch = self._contacts.after if self._contacts else None
        return Mechanism(
            force, partial(pin.aba, model, data), partial(pin.integrate, model), linearised, balls, touch
        )

    def _springs(self) -> list[tuple[int, float, float]]:
        """Place in v, stiffness and damping of each hinge and slide, as the integrators use them."""
        places = zip(self._scalar_v, self._scalar_q, strict=True)
        return [(int(i), -float(self._pull[i, j]), -float(self._drag[i, i])) for i, j in places]

    def _body_state(self, joint: int, centre: Any) -> tuple[Array, Array, Array, Array]:
        """Position, quaternion, velocity and ω of a body; ``centre`` has its axes at its centre of mass."""
        place, motion = self._data.oMi[joint] * centre, centre.actInv(self._data.v[joint])
        turn = place.rotation
        return place.translation, pin.Quaternion(turn).coeffs(), turn @ motion.linear, motion.angular

    def _moved(self, frame: Any) -> Any:
        """Inertia of one body, once the bodies of its joint are seen to add up to what Pinocchio moves."""
        joint = frame.parentJoint
        total = pin.Inertia.Zero()
        for other in self._frames:
            if other.parentJoint == joint:
                total += other.placement.act(other.inertia)
        if not total.isApprox(self._model.inertias[joint], 1e-12):
            raise EngineError(f"Pinocchio moves other masses with joint {joint} than the bodies it was given")
        return frame.inertia


def _model(scene: Scene) -> tuple[Any, list[Any], list[int]]:
    """The model, the frame of each of the scene's bodies and the number of each of its joints."""
    model, frames, numbers = pin.Model(), dict[str | None, Any](), dict[str, int]()
    model.name = scene.full_name
    model.gravity = pin.Motion(np.array(scene.gravity), np.zeros(3))
    for body in _depth_first(scene.bodies):
        parent = frames.get(body.parent)
        at, place = (parent.parentJoint, parent.placement) if parent else (0, pin.SE3.Identity())
        turn = pin.Quaternion(*np.roll(body.quaternion, 1)).normalized()
        place = place * pin.SE3(turn, np.array(body.position))
        for joint in body.joints:
            at, place = _add_joint(model, at, place, joint, numbers)
        frames[body.name] = pin.Frame(body.name, at, place, pin.FrameType.BODY, inertia(pin, body))
        model.addFrame(frames[body.name])
    return (
        model,
        [frames[body.name] for body in scene.bodies],
        [numbers[joint.name] for joint in scene.joints],
    )


def _add_joint(model: Any, parent: int, place: Any, joint: Joint, numbers: dict[str, int]) -> tuple[int, Any]:
    """Add a joint, and note its number; several on one body carry nothing but each other."""
    if joint.kind == "free":
        parent = model.addJoint(parent, pin.JointModelTranslation(), place, f"{joint.name}, translation")
        last = model.addJoint(parent, pin.JointModelSpherical(), pin.SE3.Identity(), joint.name)
        numbers[joint.name] = parent
    else:
        last = numbers[joint.name] = model.addJoint(parent, _joint_model(joint), place, joint.name)
    return last, pin.SE3.Identity()


def _joint_model(joint: Joint) -> Any:
    if joint.kind == "ball":
        return pin.JointModelSpherical()
    make = {
        "hinge": (pin.JointModelRX, pin.JointModelRY, pin.JointModelRZ, pin.JointModelRevoluteUnaligned),
        "slide": (pin.JointModelPX, pin.JointModelPY, pin.JointModelPZ, pin.JointModelPrismaticUnaligned),
    }[joint.kind]
    return make[joint.axis.index(1.0)]() if 1.0 in joint.axis else make[3](*joint.axis)


def _depth_first(bodies: tuple[Body, ...]) -> Iterator[Body]:
    """Bodies such that each subtree is unbroken: else Pinocchio's mass matrix is silently wrong."""
    waiting = [body for body in reversed(bodies) if body.parent is None]
    while waiting:
        yield (body := waiting.pop())
        waiting += [child for child in reversed(bodies) if child.parent == body.name]


def _spring_force(pull: Array, drag: Array) -> Callable[[Array, Array], Array]:
    """``pull`` q + ``drag`` v, in an array that the next call overwrites."""
    tau, dot = np.zeros(len(pull)), np.dot
    if drag.any():
        return lambda q, v: dot(pull, q, tau) + dot(drag, v)
    return (lambda q, v: dot(pull, q, tau)) if pull.any() else (lambda q, v: tau)


def _sum(
    one: Callable[[Array, Array], Array], other: Callable[[Array, Array], Array]
) -> Callable[[Array, Array], Array]:
    return lambda q, v: one(q, v) + other(q, v)
