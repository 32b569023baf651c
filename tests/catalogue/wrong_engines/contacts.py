"""Contacts of other friction, bounce or size, and what rolls as if it had no inertia."""

from dataclasses import replace

from poinsot.adapters.pinocchio_ import Pinocchio

from .entry import SE, Family, Wrong, alone, building, first_body

SLIPS, ROLLS, BLOW = "rolling[slips]", "rolling[sphere]", "collisions[e=0.5]"
OWN = "truth velocity, scheme's own"


def touching(**times):
    """Friction or restitution of every contact multiplied by so much."""

    def changed(scene):
        contacts = (
            replace(c, **{name: getattr(c, name) * factor for name, factor in times.items()})
            for c in scene.contacts
        )
        return replace(scene, contacts=tuple(contacts))

    return building(changed, Pinocchio)


def _larger(size):
    def changed(scene):
        contacts = (
            replace(c, shape=replace(c.shape, radius=c.shape.radius * (1 + size))) for c in scene.contacts
        )
        return replace(scene, contacts=tuple(contacts))

    return building(changed, Pinocchio)


def _weightless(scene):
    inertia = scene.bodies[0].inertia_array * 1e-9
    return first_body(scene, inertia=tuple(tuple(row) for row in inertia.tolist()))


FRICTION = Family("friction", lambda size: touching(friction=1 + size), alone(SLIPS, SE, OWN))
RESTITUTION = Family(
    "restitution", lambda size: touching(restitution=1 + size), alone(BLOW, SE, OWN, "truth 1 + e")
)
RADIUS = Family("radius of what touches", _larger, alone(ROLLS, SE, OWN))
WRONG = (
    *FRICTION.sizes(
        "friction",
        {
            1e-2: ("friction is 1 % high", r"^friction of contact 'wheel on world' is 1 % high$"),
            -1e-2: ("friction is 1 % low", r"^friction of contact 'wheel on world' is 1 % low$"),
        },
    ),
    Wrong(
        "friction is missing", "friction", touching(friction=1e-9), (alone(ROLLS, SE, OWN, "truth omega"),)
    ),
    *RESTITUTION.sizes(
        "restitution",
        {
            1e-2: ("restitution is 1 % high", r"^restitution of contact 'first on second' is 1 % high$"),
            1e-6: ("restitution is 1e-6 high", ""),
        },
    ),
    Wrong(
        "bodies part at full speed", "restitution", touching(restitution=2.0), (alone(BLOW, SE, OWN),)
    ),
    Wrong(
        "rolls as if it had no inertia", "rolling", building(_weightless, Pinocchio),
        (alone(ROLLS, SE, OWN, "truth acceleration"),),
    ),
    *RADIUS.sizes("contact", {1e-3: ("a sphere is 1e-3 too large where it touches", "")}),
)  # fmt: skip
