"""A pendulum at rest where all turns: a plumb line on Earth, a conical pendulum seen from its table.

Nothing moves, so every scheme is exact: what stirs is a wrong force. Catches an engine that takes the
centrifugal force at the joint, or at the body's frame, in place of its centre of mass.
"""

import numpy as np

from ..reference import plumb_line, quaternions
from ..reference.checked import Array
from . import observables, pictures
from .body import Body, Joint, Vector, diagonal
from .forces import Centrifugal, Coriolis
from .scene import Scene
from .trajectory import Trajectory, about_fixed_point

#: Earth's field without its turn [m/s²], radius [m] and turn [rad/s]; colatitude of the plumb line [rad].
G, RADIUS, OMEGA, COLATITUDE = 9.82, 6.371e6, 7.292e-5, 0.8
#: Turn of the table [rad/s]: beyond √(g/L), so that the pendulum does not hang down.
TABLE = 6.0
LENGTH = 0.5
BODY = Body(
    "pendulum",
    2.0,
    diagonal(0.02, 0.03, 0.01),
    (Joint("pivot", "ball"),),
    center_of_mass=(0.0, 0.0, -LENGTH),
)
#: The twist of the pendulum about its own axis [rad].
TWIST = 1.1


def _deflection(scene: Scene) -> float:
    if scene.variant == "planet":
        return plumb_line.pendulum_on_a_planet(G, OMEGA, RADIUS, COLATITUDE, LENGTH)
    return plumb_line.pendulum_on_a_turntable(G, TABLE, 0.0, LENGTH)


def _truth(scene: Scene, t: Array) -> Trajectory:
    """At rest, at the attitude of the start."""
    q = np.broadcast_to(scene.q0, (len(t), 4))
    return about_fixed_point(t, np.array(BODY.center_of_mass), q, np.zeros((len(t), 3)))


def _hanging(scene: Scene, motion: Trajectory) -> Array:
    """Angle (n,) [rad] between the pendulum and the vertical."""
    place = motion.position[:, 0]
    return np.arctan2(np.hypot(place[:, 0], place[:, 1]), -place[:, 2])


def _at_rest(
    variant: str, summary: str, towards: Vector, deflection: float, omega: Vector, center: Vector
) -> Scene:
    """Hanging at ``deflection`` [rad] from the vertical ``towards`` a horizontal direction."""
    turn = quaternions.from_rotation_vector(deflection * np.cross(towards, (0.0, 0.0, 1.0)))
    twist = quaternions.from_rotation_vector(np.array((0.0, 0.0, TWIST)))
    return Scene(
        name="plumb_line",
        variant=variant,
        summary=f"A pendulum at rest {summary}.",
        source="Taylor, Classical Mechanics, § 9.6",
        bodies=(BODY,),
        gravity=(0.0, 0.0, -G),
        forces=(Coriolis(omega), Centrifugal(omega, center)),
        q0=tuple(quaternions.product(turn, twist).tolist()),
        v0=(0.0, 0.0, 0.0),
        duration=1.0,
        samples=20,
        dt=2.5e-3,
        truth=_truth,
        observables=(
            observables.position(),
            observables.orientation(),
            observables.fitted(
                "deflection", "rad", lambda scene, m: float(_hanging(scene, m).mean()), _deflection
            ),
            observables.turning(),
            observables.invariant(
                "velocity", "m/s", lambda scene, m: m.velocity[:, 0], lambda scene, b: np.sqrt(G * LENGTH)
            ),
            observables.unit_norm(),
        ),
        pictures=(pictures.against_time("Angle from the vertical", "[rad]", _hanging),),
        ladders=dict.fromkeys((1, 4), (5e-2, 2.5e-2, 1.25e-2, 6.25e-3, 3.125e-3)),
        errors=dict.fromkeys(SCHEMES, (0.0,) * 6),
    )


SCHEMES = ("semi-implicit Euler", "implicit gyroscopic", "implicitfast", "discrete", "RKMK4")
#: What ``_deflection`` gives for the two, which a test holds them against: the scenes load no reference.
DEFLECTIONS = {"planet": 0.0017272110979681672, "conical": 0.9937444599106132}

SCENES = (
    _at_rest(
        "conical",
        "on a turntable: a conical pendulum, seen by who turns with it",
        (0.6, 0.8, 0.0),
        DEFLECTIONS["conical"],
        (0.0, 0.0, TABLE),
        (0.0, 0.0, 0.0),
    ),
    _at_rest(
        "planet",
        "on Earth, which turns: a plumb line; axes east, north, and up from the centre",
        (0.0, -1.0, 0.0),
        DEFLECTIONS["planet"],
        (0.0, OMEGA * float(np.sin(COLATITUDE)), OMEGA * float(np.cos(COLATITUDE))),
        (0.0, 0.0, -RADIUS),
    ),
)
