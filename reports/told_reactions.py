"""How an engine may tell reactions wrongly though it moves rightly: in other axes, about another point."""

from collections.abc import Iterator

import numpy as np

from ..adapters.centred import centred
from ..reference import equations_of_motion, joint_reactions, quaternions
from ..reference.checked import Array
from ..scenarios import reactions as looked_at
from ..scenarios.blows import over_step
from ..scenarios.equations import links
from ..scenarios.forces import forces_on
from ..scenarios.scene import Scene
from ..scenarios.trajectory import Trajectory
from .cell import Cell
from .intervals import coordinates

#: Of their size: two telling apart differ by far more, and rounding by far less.
ALIKE = 1e-9


def cause(cell: Cell) -> str:
    """What is wrong with the reactions told of a motion that is right; empty if nothing, or nothing known."""
    told, scene = cell.trajectory, centred(cell.scene).scene
    state = coordinates(scene, told) if scene.reactions else None
    if state is None:
        return ""
    size = np.array([part.scale(scene, cell.truth) for part in (looked_at.force(), looked_at.moment())])
    outer = _outer(scene, *state)
    exact = _exact(scene, *state, scene.gravity, outer)
    weightless = _exact(scene, *state, (0.0, 0.0, 0.0), outer)
    if _alike(told.reaction, exact, size):
        return ""
    added = _of_outer(scene, *state, outer)
    for words, expected in _tellings(scene, told, exact, weightless, added):
        if _alike(told.reaction[-len(expected) :], expected, size):
            return words
    return "the motion is right, and reactions alone are wrong"


def _tellings(
    scene: Scene, told: Trajectory, exact: Array, weightless: Array, added: Array
) -> Iterator[tuple[str, Array]]:
    """Sentences, each with what would be told, of the last samples, if it is true."""
    held = _held(scene)
    turn, omega = told.quaternion[:, held], told.omega[:, held]
    back, (force, moment) = quaternions.conjugate(turn), np.split(exact, 2, axis=-1)
    centre = np.array([scene.bodies[body].center_of_mass for body in held])
    origin = quaternions.rotated(back, told.position[:, held]) - centre
    inertia = np.array([scene.bodies[body].inertia for body in held])
    gyroscopic = quaternions.cross(omega, np.einsum("kij,nkj->nki", inertia, omega))
    yield "reactions are told one sample late", exact[:-1]
    yield "reactions are in world axes", _both(*(quaternions.rotated(turn, p) for p in (force, moment)))
    yield "reactions are those of the body on its parent", -exact
    yield (
        "moments of reactions are about the centre of mass",
        _both(force, moment - quaternions.cross(centre, force)),
    )
    yield (
        "moments of reactions are about the world's origin",
        _both(force, moment + quaternions.cross(origin, force)),
    )
    yield "reactions lack the weight", weightless
    yield "reactions hold what acts from outside", exact + added
    yield "reactions lack the gyroscopic moment ω×Iω", _both(force, moment - gyroscopic)
    yield "reactions hold the gyroscopic moment ω×Iω twice", _both(force, moment + gyroscopic)


def _both(force: Array, moment: Array) -> Array:
    return np.concatenate([force, moment], axis=-1)


def _exact(scene: Scene, q: Array, v: Array, gravity: tuple[float, float, float], outer: Array) -> Array:
    return joint_reactions.reactions(links(scene), q, v, gravity, _held(scene), outer)


def _of_outer(scene: Scene, q: Array, v: Array, outer: Array) -> Array:
    return joint_reactions.of_outer_forces(links(scene), q, v, outer, _held(scene))


def _held(scene: Scene) -> list[int]:
    names = [body.name for body in scene.bodies]
    return [names.index(name) for name in scene.reactions]


def _outer(scene: Scene, q: Array, v: Array) -> Array:
    """Forces from outside (n, b, 3) [N] at the scene's own samples: of blows, those about to act."""
    position, _, velocity, _ = equations_of_motion.link_motion(links(scene), q, v)
    apart = scene.duration / scene.samples
    acting = [forces_on(scene.bodies, over_step(scene.forces, apart, sample)) for sample in range(len(q))]
    return np.array([push(*at) for push, *at in zip(acting, position, velocity, strict=True)])


def _alike(a: Array, b: Array, size: Array) -> bool:
    off = [np.abs(part).max() for part in np.split(a - b, 2, axis=-1)]
    return bool((np.array(off) <= ALIKE * size).all())
