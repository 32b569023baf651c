"""PyBullet: trees in reduced coordinates, free bodies in maximal ones too; contact only where asked for."""

import importlib.metadata
from collections.abc import Sequence
from dataclasses import replace
from typing import Any, ClassVar

import numpy as np

from ..reference.checked import Array, finite
from ..reference.quaternions import conjugate, product, rotated
from ..scenarios.body import IDENTITY
from ..scenarios.features import FEATURES
from ..scenarios.scene import Scene
from . import pybullet_blows as blows
from . import pybullet_contact as contact
from . import pybullet_limits as limits
from . import pybullet_parts as parts
from . import pybullet_probes as probes
from . import pybullet_solids as solids
from .c_output import caught
from .engine import Scheme, Setup, State
from .pybullet_forces import pushes
from .pybullet_layout import inertial_frame, layout, of_ball, of_base, of_inertia
from .pybullet_loading import load, quieted
from .pybullet_reactions import Sensors
from .pybullet_settings import SETTINGS
from .pybullet_urdf import document, trees

with caught():  # PyBullet prints when it was built
    import pybullet as p

_REDUCED, _MAXIMAL = "reduced coordinates", "maximal coordinates"
#: Steps taken in one call. Only with powers of two is PyBullet's clock exact, so that no step is lost.
_BATCHES = (256, 32, 1)
#: Clients that nobody uses just now; to connect one takes longer than many a cell.
_IDLE: list[int] = []


class PyBullet:
    """PyBullet behind the calls of ``Engine``."""

    name: ClassVar[str] = "pybullet"
    schemes: ClassVar[tuple[Scheme, ...]] = (
        Scheme(_REDUCED, 1, "semi-implicit Euler", contact.NO_RIM | solids.LACKING),
        Scheme(_MAXIMAL, 1, "implicit gyroscopic", limits.LACKING | contact.NO_RIM | solids.LACKING),
    )
    features: ClassVar[frozenset[str]] = frozenset(FEATURES)
    settings: ClassVar[dict[str, str]] = SETTINGS

    @staticmethod
    def version() -> str:
        """Version of the installed engine."""
        return importlib.metadata.version("pybullet")

    def __init__(self) -> None:
        self._clients: dict[str, int] = {}

    def build(self, scene: Scene, scheme: Scheme, dt: float) -> None:
        """Build ``scene`` at its initial state; raises ``InputError`` as ``pybullet_limits`` says."""
        self._maximal = scheme.name == _MAXIMAL
        limits.refuse(scene, scheme, self._maximal)
        self._scene, self._untouched = scene, probes.without(scene)
        self._bare = probes.without(scene, "gravity", "stiffness", "damping")
        # Without the motors that would keep a force from moving its joint.
        self._slack = replace(self._bare, defaults=False) if scene.defaults else self._bare
        self._copy: _World | None = None
        self._sensors: Sensors | None = None
        q0, v0 = np.array(scene.q0), np.array(scene.v0)
        limits.refuse_frozen(scene, [self._response(i, q0) for i in range(len(scene.scalar_joints))])
        self._world = _World(self._client("run"), scene, self._maximal, dt)
        self._world.place(q0, v0)

    def step(self, n: int) -> None:
        """Advance by ``n`` steps, in PyBullet's own loop where there is no spring or damper."""
        self._world.advance(n)

    def state(self) -> State:
        """Where everything is now; raises ``EngineError`` if not finite or past what PyBullet can turn."""
        return self._world.state()

    def readback(self) -> Setup:
        """How PyBullet is set up: what it tells, and what a copy of the scene does when it is moved."""
        scene, numbers = self._scene, range(len(self._scene.scalar_joints))
        bare = self._loaded(self._bare)
        tried = probes.of_world(scene, bare.change) | parts.busy(p, bare.client, scene, bare.change)
        displaced = [self._response(i, probes.displaced(scene, i)) for i in numbers]
        resting = [self._response(i, probes.rest(scene)) for i in numbers]
        pulled = self._loaded(probes.without(scene, "gravity")).change
        tried |= probes.of_joints(scene, pulled, displaced, resting)
        if self._maximal and scene.contacts:
            floating = replace(scene, gravity=(0, 0, 0), forces=())
            tried |= blows.of_contacts(scene, self._loaded(floating).change)
        return Setup(self._world.told() | tried, tuple(tried))

    def acceleration(self, q: Array, v: Array) -> Array:
        """Generalised accelerations (nv,) at ``q`` and ``v``, laid out as the scene's ``q0`` and ``v0``.

        The change of velocity over one step: in reduced coordinates one of 1 s, exact for the scheme;
        in maximal ones the limit of small steps, good to 1e-13 ω², ω the fastest of the scene. No contacts.
        """
        q, v = finite("q", q, (len(self._scene.q0),)), finite("v", v, (len(self._scene.v0),))
        pushed = self._loaded(self._untouched).change(q, v, 1.0, 1)
        if not self._maximal:
            return pushed
        free = self._loaded(replace(self._untouched, forces=())).change
        return probes.limit(free, q, v) + (pushed - free(q, v, 1.0, 1))

    def reactions(self) -> Array:
        """Reactions (k, 6) now, of the bodies that the scene names, as ``Trajectory.reaction`` has them."""
        if self._sensors is None:
            copy = _World(self._client("sensors"), self._scene, self._maximal, self._world.dt)
            self._sensors = Sensors(p, copy)
        return self._sensors.read(self._world)

    def model_text(self) -> tuple[str, str]:
        """The model as URDF, with every digit; of several trees one document after the other."""
        return "model.urdf", document(self._scene)

    def close(self) -> None:
        """Let go of PyBullet's worlds; a client is used again unless its solver was set for contacts."""
        while self._clients:
            client = self._clients.popitem()[1]
            if self._scene.contacts:
                p.disconnect(client)
            else:
                _IDLE.append(client)
        self._copy = None

    def _client(self, name: str) -> int:
        if name not in self._clients:
            self._clients[name] = _IDLE.pop() if _IDLE else p.connect(p.DIRECT)
        return self._clients[name]

    def _loaded(self, scene: Scene) -> "_World":
        """A copy of the scene, in a world of its own, that may be moved at will."""
        if self._copy is None or self._copy.scene is not scene:
            self._copy = _World(self._client("copy"), scene, self._maximal, 1.0)
        return self._copy

    def _response(self, number: int, q: Array) -> Array:
        """Acceleration (nv,) from a unit of force in this hinge or slide at ``q``, if nothing else acts."""
        return self._loaded(self._slack).change(q, np.zeros(len(self._scene.v0)), 1.0, 1, number)


class _World:
    """A scene in one of PyBullet's clients."""

    def __init__(self, client: int, scene: Scene, maximal: bool, dt: float) -> None:
        self.client, self.scene, self.dt, self._size, self._maximal = client, scene, dt, 0, maximal
        self.steps = 0  # counted where forces have to be handed over
        p.resetSimulation(physicsClientId=client)
        p.setPhysicsEngineParameter(enableFileCaching=0, physicsClientId=client)
        p.setGravity(*scene.gravity, physicsClientId=client)
        self._batch(1)
        uids = {load(p, client, scene, tree, maximal): tree for tree in trees(scene)}
        links = dict(named for uid in uids for named in quieted(p, client, uid, scene))
        self.at = layout(scene, {body: uid for uid, tree in uids.items() for body in tree}, links)
        solids.touch_nothing(p, client, scene, self.at.bodies)
        self._pushes = pushes(p, client, scene, self.at, dt)
        self._pairs = contact.connect(p, client, scene, self.at.bodies) if scene.contacts else []
        self._by_one = any(joint.damping for joint in scene.joints) or bool(scene.contacts)
        frames = [inertial_frame(p, client, *place) for place in self.at.bodies]
        self.center, self.axes = (np.array(part) for part in zip(*frames, strict=True))
        self._carried, self._from_axes = np.vstack([self.axes, IDENTITY]), conjugate(self.axes)

    def place(self, q: Array, v: Array) -> None:
        """Put everything at these coordinates, laid out as the scene's."""
        if self.scene.contacts:
            # In maximal coordinates the inertia that a blow meets is turned to an attitude only by a step.
            self._put(q, v)
            dt, self.dt, self._size = self.dt, contact.INSTANT, 0
            self._batch(1)
            p.stepSimulation(self.client)
            self.dt, self._size = dt, 0
            self._batch(1)
        self._put(q, v)

    def _put(self, q: Array, v: Array) -> None:
        for body, uid, at_q, at_v in self.at.free:
            center, axes = self.center[body], self.axes[body]
            position, turn, velocity, omega = of_base(q[at_q], v[at_v], center, axes)
            p.resetBasePositionAndOrientation(uid, position, turn, self.client)
            p.resetBaseVelocity(uid, velocity, omega, self.client)
        for uid, link, carried, at_q, at_v in self.at.balls:
            turn, omega = of_ball(q[at_q], v[at_v], self._carried[carried])
            p.resetJointStateMultiDof(uid, link, turn, omega, self.client)
        for uid, link, i, j, _ in self.at.scalars:
            p.resetJointState(uid, link, q[i], v[j], self.client)

    def advance(self, n: int) -> None:
        """Take ``n`` steps."""
        if self._pushes:
            self._pull(n)
            return
        # PyBullet applies joint damping once a call, and not once a step.
        for size in (1,) if self._by_one else _BATCHES:
            calls, n = divmod(n, size)
            if calls:
                self._batch(size)
            for _ in range(calls):
                p.stepSimulation(self.client)

    def change(self, q: Array, v: Array, dt: float, steps: int, pushed: int | None = None) -> Array:
        """Change of the velocities (nv,) from ``q`` and ``v`` over some steps, by their duration.

        ``pushed`` is the number of a hinge or slide that a unit of force acts in over the first step.
        """
        self.dt, self._size = dt, 0
        self._batch(1)
        self.place(q, v)
        before = self._rates()
        if pushed is not None:
            uid, link, *_ = self.at.scalars[pushed]
            p.setJointMotorControl2(uid, link, p.TORQUE_CONTROL, force=1.0, physicsClientId=self.client)
        self.advance(steps)
        change = (self._rates() - before) / (steps * dt)
        for body, _, at_q, at_v in self.at.free:
            change[at_v] = probes.at_origin(change[at_v], q[at_q][3:], v[at_v][3:], self.center[body])
        return change

    def state(self) -> State:
        """Where everything is now."""
        state = State(*self._bodies(), *self._joints())
        limits.refuse_broken(state, self._turning(state), self.dt)
        return state

    def _turning(self, state: State) -> list[Sequence[float]]:
        """Every ω (3,) that PyBullet turns something by, in whatever axes."""
        free = [state.omega[body].tolist() for body, *_ in self.at.free]
        return free + [p.getJointStateMultiDof(uid, link, self.client)[1] for uid, link, *_ in self.at.balls]

    def told(self) -> dict[str, Any]:
        """What PyBullet says of its setup."""
        engine = p.getPhysicsEngineParameters(self.client)
        values: dict[str, Any] = {
            "gravity": np.array([engine[f"gravityAcceleration{axis}"] for axis in "XYZ"]),
            "dt": engine["fixedTimeStep"] / max(1, engine["numSubSteps"]),
        }
        bodies = zip(self.scene.bodies, self.at.bodies, self.center, self.axes, strict=True)
        for body, place, center, axes in bodies:
            mass, _, moments, *_ = p.getDynamicsInfo(*place, self.client)
            values |= of_inertia(body.name, mass, moments, center, axes)
        counted = parts.built(p, self.client, self._maximal, self.scene)
        return {**values, **contact.told(p, self.client, self.scene, self._pairs), **counted}

    def _batch(self, size: int) -> None:
        """Make a call of so many steps."""
        if size != self._size:
            steps, whole = (0 if size == 1 else size), size * self.dt
            p.setPhysicsEngineParameter(fixedTimeStep=whole, numSubSteps=steps, physicsClientId=self.client)
            self._size = size

    def _pull(self, n: int) -> None:
        """Take ``n`` steps, each after handing PyBullet the forces of springs and from outside the joints."""
        for step in range(self.steps, self.steps + n):
            for push in self._pushes:
                push(step)
            p.stepSimulation(self.client)
        self.steps += n

    def _bodies(self) -> tuple[Array, Array, Array, Array]:
        """Positions, quaternions, velocities and ω of the bodies, shapes and frames as in ``State``."""
        count = len(self.at.bodies)
        position, quaternion, velocity, omega = (np.empty((count, width)) for width in (3, 4, 3, 3))
        for body, uid, _, _ in self.at.free:
            position[body], quaternion[body] = p.getBasePositionAndOrientation(uid, self.client)
            velocity[body], omega[body] = p.getBaseVelocity(uid, self.client)
        for uid, bodies in self.at.linked.items():
            # Unless asked for forward kinematics (the last 1), PyBullet tells where links once were. It
            # tells the frames of links (4 and 5) in single precision, those of their inertia in double.
            states = p.getLinkStates(uid, [self.at.bodies[body][1] for body in bodies], 1, 1, self.client)
            for body, (center, turn, *_, linear, angular) in zip(bodies, states, strict=True):
                position[body], quaternion[body], velocity[body], omega[body] = center, turn, linear, angular
        quaternion = product(quaternion, self._from_axes)
        return position, quaternion, velocity, rotated(conjugate(quaternion), omega)

    def _joints(self) -> tuple[Array, Array]:
        """Positions and velocities (j,) of the hinges and slides."""
        found = np.empty((2, len(self.at.scalars)))
        for uid, numbers in self.at.hinged.items():
            states = p.getJointStates(uid, [self.at.scalars[i].link for i in numbers], self.client)
            found[:, numbers] = np.array([state[:2] for state in states]).T
        return found[0], found[1]

    def _rates(self) -> Array:
        """Velocities (nv,) as the scene lays them out, but of free bodies' centres, and ω in world axes."""
        rates = np.empty(len(self.scene.v0))
        for _, uid, _, at_v in self.at.free:
            rates[at_v] = np.ravel(p.getBaseVelocity(uid, self.client))
        for uid, link, carried, _, at_v in self.at.balls:
            omega = np.array(p.getJointStateMultiDof(uid, link, self.client)[1])
            rates[at_v] = rotated(self._carried[carried], omega)
        rates[[scalar.v for scalar in self.at.scalars]] = self._joints()[1]
        return rates
