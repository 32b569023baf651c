"""Equations of motion that a run may have followed: the scene's own, or with something else in them."""

from collections.abc import Callable
from copy import copy
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..reference import equations_of_motion
from ..reference.checked import Array
from ..reference.equations_of_motion import Link
from ..scenarios.equations import links
from ..scenarios.forces import Force, forces_on
from ..scenarios.scene import Scene


def changed(link: Link, **parts: Any) -> Link:
    """``link`` with other parts, unchecked: a hypothesis may have an inertia that no body has."""
    other = copy(link)
    for name, value in parts.items():
        object.__setattr__(other, name, value)
    return other


@dataclass(frozen=True, eq=False)
class Model:
    """Equations of motion that a run may have followed: the scene's, or with something else in them.

    Where coordinates are ``by_centres``, those of a free body are of its centre of mass, wherever that is.
    ``added(q, v)`` is a further force (n, nv) along the velocities.
    """

    scene: Scene
    links: tuple[Link, ...]
    gravity: Array
    forces: tuple[Force, ...]
    added: Callable[[Array, Array], Array] | None = None
    by_centres: bool = False

    @classmethod
    def of(cls, scene: Scene, by_centres: bool = False) -> "Model":
        """The scene's own equations."""
        gravity = np.array(scene.gravity)
        return cls(scene, tuple(links(scene)), gravity, scene.forces, by_centres=by_centres)

    def displaced(self, body: int, by: Array) -> "Model":
        """The same with a body's centre of mass elsewhere, ``by`` (3,) [m] in its own axes."""
        own = self.links[body]
        if not (self.by_centres and any(joint.kind == "free" for joint in own.joints)):
            return self.with_link(body, com=np.asarray(own.com) + by)
        model = self
        for at, link in enumerate(self.links):
            if link.parent == body:
                model = model.with_link(at, position=np.asarray(link.position) - by)
        return model

    def with_link(self, body: int, **parts: Any) -> "Model":
        """The same with other parts of one link."""
        every = list(self.links)
        every[body] = changed(every[body], **parts)
        return replace(self, links=tuple(every))

    def pushed(self, q: Array, v: Array) -> Array:
        """Forces from outside (n, b, 3) [N]."""
        if not self.forces:
            return np.zeros((len(q), len(self.links), 3))
        position, _, velocity, _ = equations_of_motion.link_motion(self.links, q, v)
        masses = [replace(b, mass=link.mass) for b, link in zip(self.scene.bodies, self.links, strict=True)]
        push = forces_on(masses, self.forces)
        return np.array([push(*at) for at in zip(position, velocity, strict=True)])

    def accelerate(self, q: Array, v: Array) -> Array:
        """v̇ (n, nv) at ``q`` (n, nq) and ``v`` (n, nv)."""
        more, pushed = self._more(q, v), self.pushed(q, v)
        return equations_of_motion.accelerations(self.links, q, v, self.gravity, more, pushed)

    def linearised(self, q: Array, v: Array) -> tuple[Array, Array]:
        """Mass matrix and −∂f/∂v (n, nv, nv), of all forces but those from outside."""
        # Forces are of second degree in the velocities: a central difference of any width is exact.
        widths = np.eye(v.shape[1])[:, None, :] / 2
        every = np.broadcast_to(q, (len(widths), *q.shape))
        columns = self._inner(every, v + widths) - self._inner(every, v - widths)
        return equations_of_motion.mass_matrix(self.links, q), np.moveaxis(columns, 0, -1)

    def _inner(self, q: Array, v: Array) -> Array:
        return equations_of_motion.required_forces(self.links, q, v, 0 * v, self.gravity, self._more(q, v))

    def _more(self, q: Array, v: Array) -> Array | None:
        return None if self.added is None else self.added(q, v)


#: A model with the number set to what it is in the scene is the scene's own.
Change = Callable[[Model, float], Model]
