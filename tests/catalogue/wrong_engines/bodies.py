"""Bodies that are built wrong: masses, centres, moments and products of inertia."""

from dataclasses import replace

import numpy as np
from poinsot.adapters.mujoco_ import MuJoCo
from poinsot.adapters.pinocchio_ import Pinocchio
from poinsot.scenarios.body import diagonal

from .entry import (
    CHAIN,
    ENERGY,
    EQUATIONS,
    FREE,
    LIMITS,
    MOMENTUM,
    RK,
    SE,
    SPIN,
    TOP,
    TUMBLING,
    TURNING,
    TWIN,
    Lying,
    Sight,
    Wrong,
)  # fmt: skip


def first_body(scene, **changed):
    """The scene with its first body changed."""
    return replace(scene, bodies=(replace(scene.bodies[0], **changed), *scene.bodies[1:]))


class LargeMoment(Pinocchio):
    def build(self, scene, scheme, dt):
        I1, I2, I3 = np.diag(scene.bodies[0].inertia_array)
        super().build(first_body(scene, inertia=diagonal(I1 * 1.001, I2, I3)), scheme, dt)


class LyingLargeMoment(Lying, LargeMoment):
    pass


class Permuted(Lying, Pinocchio):
    def mistaken(self, scene):
        I1, I2, I3 = np.diag(scene.bodies[0].inertia_array)
        return first_body(scene, inertia=diagonal(I2, I3, I1))


class Skewed(Lying, MuJoCo):
    """A product of inertia of a millionth of the moments."""

    def mistaken(self, scene):
        inertia = scene.bodies[0].inertia_array.copy()
        inertia[0, 1] = inertia[1, 0] = 1e-6 * inertia[0, 0]
        return first_body(scene, inertia=tuple(tuple(row) for row in inertia.tolist()))


class OffCentre(Lying, MuJoCo):
    """The centre of mass a micrometre beside the axis."""

    def mistaken(self, scene):
        x, y, z = scene.bodies[0].center_of_mass
        return first_body(scene, center_of_mass=(x + 1e-6, y, z))


class Heavy(Lying, Pinocchio):
    """The first mass a ten-thousandth too large."""

    def mistaken(self, scene):
        return first_body(scene, mass=scene.bodies[0].mass * (1 + 1e-4))


WRONG = (
    Wrong(
        "moment I1 is 0.1 % high, and read back so", "moment", LargeMoment,
        (
            Sight(
                FREE, RK,
                TURNING | SPIN | ENERGY | MOMENTUM | TWIN | {"setup body/top/inertia", EQUATIONS},
                "setup body/top/inertia",
                r"the engine has \[\[0.01001, .*, the scene asks for \(\(0.01, ",
            ),
        ), 1e-3,
        located=r"^moment I1 of body 'top' is 0\.1 % high$",
    ),
    Wrong(
        "moment I1 is 0.1 % high", "moment", LyingLargeMoment,
        (
            Sight(
                FREE, RK, TURNING | SPIN | ENERGY | MOMENTUM | TWIN | {EQUATIONS},
                "truth Omega_b", "difference from the exact rate",
            ),
            Sight(
                FREE, SE, LIMITS | SPIN | TWIN | {EQUATIONS},
                "truth orientation, limit", "limit at dt = 0 from the truth", near={"truth omega"},
            ),
        ), 1e-3,
        located=r"^moment I1 of body 'top' is 0\.1 % high$",
    ),
    Wrong(
        "inertia axes are permuted", "inertia axes", Permuted,
        (
            Sight(
                TUMBLING, SE, {EQUATIONS, "truth omega", "invariant angular momentum"}, near=None,
                beside=False,
            ),
        ),
        located=r"^inertia axes of body 'satellite' are permuted$",
    ),
    Wrong(
        "product I12 is 1e-6 of I1", "product", Skewed,
        (Sight(TUMBLING, SE, {EQUATIONS, "truth orientation, limit"}, near=None, beside=False),), 1e-6,
        located=r"^product of inertia I12 of body 'satellite' is off by 0\.00012 kg m²$",
    ),
    Wrong(
        "centre of mass is 1e-6 m beside the axis", "centre", OffCentre,
        (Sight(TOP, SE, {EQUATIONS, "truth orientation, limit"}, near=None, beside=False),), 1e-6,
        located=r"^centre of mass of body 'top' is displaced by 1e-06 m along its axis 1$",
    ),
    Wrong(
        "first mass is 1e-4 high", "mass", Heavy,
        (Sight(CHAIN, SE, {EQUATIONS, "truth position, scheme's own"}, near=None, beside=False),), 1e-4,
        located=r"^mass of body 'left' is 0\.01 % high$",
    ),
)  # fmt: skip
