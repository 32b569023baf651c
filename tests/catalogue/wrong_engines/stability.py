"""Schemes that hold longer or shorter than theory says they can."""

from poinsot.adapters import pybullet_
from poinsot.adapters.mujoco_ import MuJoCo
from poinsot.adapters.pinocchio_ import Pinocchio
from poinsot.adapters.pinocchio_schemes import semi_implicit_euler
from poinsot.adapters.pybullet_ import PyBullet

from .entry import DISCRETE, SE, Sight, Wrong

STIFF, LIMIT = "stiff_spring", "stability largest stable step"
BEYOND = "beyond what the scheme can do"


class ExplicitSprings(MuJoCo):
    """Says that it treats springs implicitly, and does not."""

    schemes = tuple(scheme for scheme in MuJoCo.schemes if scheme.name == "discrete")

    def build(self, scene, scheme, dt):
        super().build(scene, MuJoCo.schemes[0], dt)


class SubSteps(Pinocchio):
    """Takes four smaller steps for each."""

    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt / 4)

    def step(self, n):
        super().step(4 * n)


class ClampedSpring(PyBullet):
    """Leaves PyBullet's clamp of velocities where it is by default."""

    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        for uid in self._world.at.hinged:
            pybullet_.p.changeDynamics(uid, -1, maxJointVelocity=100, physicsClientId=self._world.client)


class OldVelocity(Pinocchio):
    """Explicit Euler under the name of semi-implicit Euler: it grows at any step."""

    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)

        def explicit(system, q, v, dt, n):
            for _ in range(n):
                old = v
                v = v + dt * system.accelerate(q, v, system.force(q, v))
                q = system.integrate(q, dt * old)
            return q, v

        self._advance = explicit


class DampedSteps(Pinocchio):
    """Semi-implicit Euler that takes a tenth of the velocity away at each step."""

    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)

        def damped(system, q, v, dt, n):
            for _ in range(n):
                q, v = semi_implicit_euler(system, q, 0.9 * v, dt, 1)
            return q, v

        self._advance = damped


def _seen(twin, says):
    return (Sight(STIFF, twin, {LIMIT}, LIMIT, says, near=None, beside=False),)


WRONG = (
    Wrong(
        "springs are explicit in a scheme called implicit", "scheme", ExplicitSprings,
        _seen(DISCRETE, "by theory at any step"),
        located=r"^steps are those of semi-implicit Euler, not of discrete",
    ),
    Wrong(
        "four smaller steps are taken for each", "scheme", SubSteps, _seen(SE, BEYOND),
        located=r"^step is a part of the stated one, 1/4, and 4 are taken for each$",
    ),
    Wrong(
        "a spring's velocity is clamped at 100", "clamp", ClampedSpring, _seen(SE, BEYOND),
        located=r"clamp",
    ),
    Wrong(
        "explicit Euler is called semi-implicit", "scheme", OldVelocity,
        _seen(SE, "by theory up to 0.0002 s"),
        located=r"^steps are those of explicit Euler",
    ),
    Wrong(
        "a tenth of the velocity is lost at each step", "damping", DampedSteps, _seen(SE, ""),
        located=r"damp",
    ),
)  # fmt: skip
