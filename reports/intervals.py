"""A run cut at its samples: what equations and scheme make of each state told, against the next one told.

Over one interval nothing has time to grow, and each counts by itself: a wrong parameter shows in all of
them, a reset in one, noise differently in each. Where the scheme is known here its own steps are taken,
so that a right run leaves nothing over but rounding.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from ..adapters.centred import centred
from ..reference import equations_of_motion, quaternions, tree_schemes
from ..reference.checked import EPSILON, Array
from ..scenarios.blows import at_work
from ..scenarios.body import Body
from ..scenarios.equations import links
from ..scenarios.scene import Scene
from ..scenarios.trajectory import Trajectory
from .supposed import Model

#: Numbers of intervals.
Places = npt.NDArray[np.intp]

#: Steps of the fine scheme that an interval's exact flow is made of.
FINE = 8


@dataclass(frozen=True, eq=False)
class Intervals:
    """The states told, as coordinates ``q`` (n, nq) and velocities ``v`` (n, nv) of a scene's joints.

    ``scene`` has its free bodies' origins at their centres of mass. ``rounding`` (2 nv) is what rounding
    may change in a state over one interval. ``leftover`` says, by name, how far what is told of bodies is
    from what is told of joints.
    """

    scene: Scene
    q: Array
    v: Array
    dt: float
    stride: int
    rounding: Array
    leftover: dict[str, float]

    @classmethod
    def of(cls, scene: Scene, told: Trajectory) -> "Intervals | None":
        """Those of a run; ``None`` where contacts or burning masses act, which the equations lack."""
        if scene.contacts or scene.burning or told.provenance is None:
            return None
        dt, central = told.provenance.dt, centred(scene).scene
        state = coordinates(central, told)
        if state is None:
            return None
        q, v = state
        stride = scene.steps_per_sample(dt)
        leftover = {name: float(np.abs(values).max()) for name, values in apart(central, told, q, v)}
        return cls(central, q, v, dt, stride, _rounding(central, q, v, stride), leftover)

    def residual(
        self,
        model: Model,
        scheme: str,
        which: Places | None = None,
        stretch: float = 1.0,
        steps: int | None = None,
    ) -> Array:
        """What is told less what follows, (k, 2 nv), in units of rounding; ``which`` (k,) of the intervals.

        ``scheme`` is a twin name of `tree_schemes`, or "exact" for the flow itself, ``stretch`` a factor on
        dt and ``steps`` how many an interval has, where they are not those asked for.
        """
        chosen = np.asarray(np.arange(len(self.q) - 1) if which is None else which, dtype=np.intp)
        q, v = self.advanced(model, scheme, chosen, stretch, steps)
        dq = tree_schemes.apart(model.links, self.q[chosen + 1], q)
        return np.asarray(np.hstack([dq, self.v[chosen + 1] - v]) / self.rounding)

    def advanced(
        self,
        model: Model,
        scheme: str,
        chosen: Places,
        stretch: float = 1.0,
        steps: int | None = None,
    ) -> tuple[Array, Array]:
        """Where the scheme leads over one interval, from each of the ``chosen`` states."""
        count, dt, name = self.stride if steps is None else steps, self.dt * stretch, scheme
        if scheme == "exact":
            count, dt, name = FINE, dt * count / FINE, "RKMK4"
        q, v = self.q[chosen], self.v[chosen]
        for model_now, mine in self._while(model, chosen):
            q[mine], v[mine] = tree_schemes.advanced(
                name, model.links, model_now.accelerate, q[mine], v[mine], dt, count, model_now.linearised
            )
        return q, v

    def _while(self, model: Model, chosen: Places) -> Iterator[tuple[Model, Places]]:
        """What of the model acts over which of the intervals: of blows, those that are on."""
        middles = (chosen + 0.5) * (self.stride * self.dt)
        acting = [at_work(model.forces, t) for t in middles.tolist()] if model.forces else []
        for forces in dict.fromkeys(acting):
            yield replace(model, forces=forces), np.flatnonzero([found == forces for found in acting])
        if not acting:
            yield model, np.arange(len(chosen))


def coordinates(scene: Scene, told: Trajectory) -> tuple[Array, Array] | None:
    """The joints' coordinates (n, nq) and velocities (n, nv) in a motion of a centred scene.

    ``None`` where a ball shares its body with other joints: then bodies alone do not tell.
    """
    q, v = np.zeros((len(told.t), len(scene.q0))), np.zeros((len(told.t), len(scene.v0)))
    names, scalar = [body.name for body in scene.bodies], 0
    for body, joint, at_q, at_v in scene.slices():
        at = names.index(body.name)
        if joint.kind in ("hinge", "slide"):
            q[:, at_q.start], v[:, at_v.start] = (
                told.joint_position[:, scalar],
                told.joint_velocity[:, scalar],
            )
            scalar += 1
        elif joint.kind == "free":
            q[:, at_q] = np.hstack([told.position[:, at], told.quaternion[:, at]])
            v[:, at_v] = np.hstack([told.velocity[:, at], told.omega[:, at]])
        elif len(body.joints) > 1:
            return None
        else:
            parent = names.index(body.parent) if body.parent else -1
            q[:, at_q], v[:, at_v] = _ball(told, body, at, parent)
    return q, v


def _ball(told: Trajectory, body: Body, at: int, parent: int) -> tuple[Array, Array]:
    turn, omega = told.quaternion[:, at], told.omega[:, at]
    place = np.broadcast_to(np.array(body.quaternion), turn.shape)
    if parent >= 0:
        carrier = told.quaternion[:, parent]
        world = quaternions.rotated(carrier, told.omega[:, parent])
        omega = omega - quaternions.rotated(quaternions.conjugate(turn), world)
        place = quaternions.product(carrier, place)
    return quaternions.product(quaternions.conjugate(place), turn), omega


def _rounding(scene: Scene, q: Array, v: Array, stride: int) -> Array:
    """What a few roundings an interval come to: of the largest coordinate and velocity of each sort."""
    linear, angular = np.zeros(v.shape[1], bool), np.zeros(v.shape[1], bool)
    size = np.ones(v.shape[1])
    for _, joint, at_q, at_v in scene.slices():
        straight = {"free": 3, "slide": 1}.get(joint.kind, 0)
        linear[at_v.start : at_v.start + straight] = True
        if straight:
            size[at_v.start : at_v.start + straight] = np.abs(q[:, at_q][:, :straight]).max()
        if joint.kind == "hinge":
            size[at_v] = max(1.0, np.abs(q[:, at_q]).max())
    angular[:] = ~linear
    speed = np.ones(v.shape[1])
    for sort in (linear, angular):
        fastest = np.abs(v[:, sort]).max(initial=0.0)
        speed[sort] = max(fastest, 1 / scene.duration)
        if sort is linear and linear.any():
            size[sort] = max(size[sort].max(), fastest * scene.duration / scene.samples)
    share = EPSILON * (4 + 2 * np.sqrt(stride))
    return np.asarray(np.concatenate([share * size, share * speed]))


def apart(scene: Scene, told: Trajectory, q: Array, v: Array) -> list[tuple[str, Array]]:
    """What is told of bodies less what follows from their joints, (n, b, 3) each, by name.

    Position [m], orientation [rad], velocity [m/s] and omega [rad/s] of a centred scene whose joints have the
    coordinates ``q`` (n, nq) and the velocities ``v`` (n, nv).
    """
    q = unit_quaternions(scene, q)
    position, quaternion, velocity, omega = equations_of_motion.link_motion(links(scene), q, v)
    turn = quaternions.product(quaternions.conjugate(quaternion), told.quaternion)
    return [
        ("position", told.position - position),
        ("orientation", quaternions.rotation_vector(turn)),
        ("velocity", told.velocity - velocity),
        ("omega", told.omega - omega),
    ]


def unit_quaternions(scene: Scene, q: Array) -> Array:
    """Coordinates whose turns have length 1."""
    result = np.array(q)
    for _, joint, at, _ in scene.slices():
        if joint.kind in ("free", "ball"):
            turn = result[:, at][:, -4:]
            turn /= np.linalg.norm(turn, axis=1, keepdims=True)
    return result
