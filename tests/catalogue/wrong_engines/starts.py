"""Bodies placed, joined or thrown wrong."""

from dataclasses import replace

import numpy as np
from poinsot.adapters.mujoco_ import MuJoCo
from poinsot.adapters.pinocchio_ import Pinocchio

from .entry import CHAIN, EQUATIONS, SE, TOP, Family, alone, building

DOUBLE = "double_pendulum[large]"


def thrown(size):
    """Velocities at the start larger by a part of themselves."""
    return building(lambda scene: replace(scene, v0=tuple(v * (1 + size) for v in scene.v0)), MuJoCo)


def displaced(size):
    """Coordinates of slides larger by this [m]."""
    return building(lambda scene: replace(scene, q0=tuple(q + size for q in scene.q0)), Pinocchio)


def _last(scene, **changed):
    return replace(scene, bodies=(*scene.bodies[:-1], replace(scene.bodies[-1], **changed)))


def aslant(angle):
    """The last hinge aslant by this [rad]."""

    def turned(scene):
        (hinge,) = scene.bodies[-1].joints
        axis = np.array(hinge.axis) + angle * np.array([0.0, 0.0, 1.0])
        return _last(scene, joints=(replace(hinge, axis=tuple((axis / np.linalg.norm(axis)).tolist())),))

    return building(turned, Pinocchio)


def lower(distance):
    """The last joint too far down its parent by this [m]."""

    def moved(scene):
        x, y, z = scene.bodies[-1].position
        return _last(scene, position=(x, y, z - distance))

    return building(moved, MuJoCo)


LIMIT = "truth orientation, limit"
THROWN = Family("velocity at the start", thrown, alone(TOP, SE, LIMIT))
DISPLACED = Family("place at the start [m]", displaced, alone(CHAIN, SE, "truth position, scheme's own"))
#: To first order a hinge aslant in a plane of symmetry changes no equation of motion, only where bodies are.
ASLANT = Family("direction of a hinge [rad]", aslant, alone(DOUBLE, SE, LIMIT, "invariant joint residual"))
LOWER = Family("place of a joint [m]", lower, alone(DOUBLE, SE, EQUATIONS, LIMIT))
_BEGINS = r"^motion begins in another state than was asked for: "
WRONG = (
    *THROWN.sizes(
        "start", {1e-6: ("velocities at the start are 1e-6 high", _BEGINS + r".*omega by 2e-05 rad/s$")}
    ),
    *DISPLACED.sizes("start", {1e-6: ("slides start 1e-6 m too far", _BEGINS + r"position by 3e-06 m$")}),
    *ASLANT.sizes(
        "joint", {1e-4: ("a hinge is aslant by 1e-4 rad", ""), 1e-6: ("a hinge is aslant by 1e-6 rad", "")}
    ),
    *LOWER.sizes("joint", {1e-6: ("a joint is 1e-6 m too low", "")}),
)
