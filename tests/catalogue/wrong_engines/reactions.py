"""Reactions of joints told wrong: the motion is right, and what the joints do in it is not."""

import numpy as np
from poinsot.adapters.mujoco_ import MuJoCo
from poinsot.reference import quaternions

from .entry import SE, Sight, Wrong

BRAKED, STATIC, DYNAMIC = (f"rotor_balance[{variant}]" for variant in ("braked", "static", "dynamic"))


class Telling(MuJoCo):
    """Keeps the scene that it was asked for; ``told`` is what it makes of its reactions (1, 6)."""

    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        self._wanted, self._before = scene, None

    def reactions(self):
        return np.hstack(self.told(*np.split(super().reactions(), 2, axis=1)))

    def turn(self):
        return self.state().quaternion[0]


class InWorldAxes(Telling):
    def told(self, force, moment):
        return [quaternions.rotated(self.turn(), part) for part in (force, moment)]


class AboutTheCentre(Telling):
    def told(self, force, moment):
        return force, moment - np.cross(self._wanted.bodies[0].center_of_mass, force)


class AboutTheWorldsOrigin(Telling):
    def told(self, force, moment):
        place = np.array(self._wanted.bodies[0].position)
        arm = quaternions.rotated(quaternions.conjugate(self.turn()), place)
        return force, moment + np.cross(arm, force)


class OfTheBodyOnItsParent(Telling):
    def told(self, force, moment):
        return -force, -moment


class Weightless(Telling):
    def told(self, force, moment):
        body = self._wanted.bodies[0]
        borne = np.array([0.0, 0.0, -body.mass * self._wanted.gravity[2]])
        return force - borne, moment - np.cross(body.center_of_mass, borne)


class Gyroscopic(Telling):
    """Its moments hold the gyroscopic one so many ``times``."""

    times = 0.0

    def told(self, force, moment):
        omega = self.state().omega[0]
        once = np.cross(omega, self._wanted.bodies[0].inertia_array @ omega)
        return force, moment + (self.times - 1) * once


class GyroscopicTwice(Gyroscopic):
    times = 2.0


class OfTheSampleBefore(Telling):
    def told(self, force, moment):
        before, self._before = self._before or (force, moment), (force, moment)
        return before


def _wrong(name, engine, scene, located, what="moment"):
    sight = Sight(scene, SE, {f"truth reaction {what}"}, near=None, beside=False)
    return Wrong(name, "reaction", engine, (sight,), located=located)


WRONG = (
    _wrong("reaction is in world axes", InWorldAxes, STATIC, "^reactions are in world axes$", "force"),
    _wrong(
        "reaction is about the centre of mass", AboutTheCentre, STATIC,
        "^moments of reactions are about the centre of mass$",
    ),
    _wrong(
        "reaction is about the world's origin", AboutTheWorldsOrigin, STATIC,
        "^moments of reactions are about the world's origin$",
    ),
    _wrong(
        "reaction is the body's on its parent", OfTheBodyOnItsParent, DYNAMIC,
        "^reactions are those of the body on its parent$",
    ),
    _wrong("reaction lacks the weight", Weightless, STATIC, "^reactions lack the weight$", "force"),
    _wrong(
        "reaction lacks the products of inertia", Gyroscopic, DYNAMIC,
        "^reactions lack the gyroscopic moment ω×Iω$",
    ),
    _wrong(
        "reaction holds the products of inertia twice", GyroscopicTwice, DYNAMIC,
        "^reactions hold the gyroscopic moment ω×Iω twice$",
    ),
    _wrong(
        "reaction is told one sample late", OfTheSampleBefore, BRAKED,
        "^reactions are told one sample late$",
    ),
)  # fmt: skip
