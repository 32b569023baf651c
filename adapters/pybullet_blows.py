"""Friction and restitution of contacts as PyBullet runs them, found out by blows between free bodies.

In maximal coordinates PyBullet does not tell a restitution.
"""

import numpy as np

from ..reference.checked import Array
from ..scenarios.contact import Contact, Plane
from ..scenarios.scene import Scene
from .pybullet_probes import Change

#: How deep a blow begins, to the radius, and how fast the two then meet and slide [m/s].
DEPTH, MEETING, SLIDING = 0.01, 1.0, 100.0


def of_contacts(scene: Scene, change: Change) -> dict[str, float]:
    """The settings of every contact, of a ``scene`` without gravity."""
    values: dict[str, float] = {}
    for contact in scene.contacts:
        q, v, up = _about_to_meet(scene, contact)
        # However long the step, a blow is over in it.
        blow = change(q, v, 1.0, 1).reshape(-1, 6)[:, :3]
        first = blow[_number(scene, contact.first)]
        relative = first - (blow[_number(scene, contact.second)] if contact.second else 0.0)
        along = float(first @ up)
        values[f"contact/{contact.name}/friction"] = float(np.linalg.norm(first - along * up)) / along
        values[f"contact/{contact.name}/restitution"] = float(relative @ up) / MEETING - 1
    return values


def _about_to_meet(scene: Scene, contact: Contact) -> tuple[Array, Array, Array]:
    """Coordinates and velocities with the first just inside the second, and where up is for the first."""
    q, v, r = np.array(scene.q0), np.zeros(len(scene.v0)), contact.shape.radius
    first = _number(scene, contact.first)
    if isinstance(contact.against, Plane):
        up, place = (
            np.array(contact.against.normal),
            np.array(contact.against.normal) * contact.against.offset,
        )
    else:
        up, second = np.array([0.0, 0.0, 1.0]), _number(scene, contact.second)
        place = q[7 * second : 7 * second + 3] + contact.against.radius * up
    q[7 * first : 7 * first + 3] = place + (1 - DEPTH) * r * up
    across = np.cross(up, np.eye(3)[int(np.argmin(np.abs(up)))])
    v[6 * first : 6 * first + 3] = SLIDING * across / np.linalg.norm(across) - MEETING * up
    return q, v, up


def _number(scene: Scene, name: str | None) -> int:
    return [body.name for body in scene.bodies].index(name or "")
