"""States told wrong: the motion is right, and what is said of it is not."""

import numpy as np
from poinsot.adapters.mujoco_ import MuJoCo
from poinsot.reference import quaternions

from .entry import (
    CHAIN,
    ENERGY,
    FREE,
    MOMENTUM,
    ON_JOINTS,
    P_ALPHA,
    P_GAMMA,
    PENDULUM,
    RATES,
    RK,
    SE,
    TOP,
    TUMBLING,
    TWIN,
    Lying,
    Sight,
    Wrong,
    alone,
    state,
)


class ScalarFirst(MuJoCo):
    def state(self):
        state = super().state()
        return state._replace(quaternion=np.roll(state.quaternion, 1, axis=1))


class Conjugated(MuJoCo):
    def state(self):
        state = super().state()
        return state._replace(quaternion=quaternions.conjugate(state.quaternion))


class WorldOmega(MuJoCo):
    def state(self):
        state = super().state()
        return state._replace(omega=quaternions.rotated(state.quaternion, state.omega))


class FrameNotCentre(MuJoCo):
    def state(self):
        return super().state()._replace(position=self._look.data.xpos[self._bodies])


class StuckInPlace(MuJoCo):
    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        self._start = super().state().position

    def state(self):
        return super().state()._replace(position=self._start)


class JointsOfLastSample(MuJoCo):
    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        self._old = super().state().joint_velocity

    def step(self, n):
        self._old = super().state().joint_velocity
        super().step(n)

    def state(self):
        return super().state()._replace(joint_velocity=self._old)


class Turned(MuJoCo):
    def state(self):
        return super().state()._replace(quaternion=np.tile([0, 0, 0.6, 0.8], (3, 1)))


class NeverNormalised(Lying, MuJoCo):
    """Its quaternions grow by a part in 10⁹ a step."""

    def state(self):
        found = super().state()
        return found._replace(quaternion=found.quaternion * (1 + 1e-9 * self._steps))


class NoTurn(MuJoCo):
    """Leaves the quaternions of what does not turn at zero."""

    def state(self):
        found = super().state()
        return found._replace(quaternion=np.zeros_like(found.quaternion))


class VelocityOneStepLate(MuJoCo):
    """Tells the velocities that its bodies had before the last step, and all else as it is."""

    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        self._old = super().state().velocity

    def step(self, n):
        if n > 1:
            super().step(n - 1)
        self._old = super().state().velocity
        super().step(1)

    def state(self):
        return super().state()._replace(velocity=self._old)


class VelocityOfFrame(MuJoCo):
    """Tells the velocity of the frame's origin: of a body about a fixed point, none."""

    def state(self):
        found = super().state()
        arm = found.position - self._look.data.xpos[self._bodies]
        swept = np.cross(quaternions.rotated(found.quaternion, found.omega), arm)
        return found._replace(velocity=found.velocity - swept)


class LeftHanded(Lying, MuJoCo):
    """Mirrors what it tells of turning."""

    def state(self):
        found = super().state()
        mirror = np.array([1.0, 1.0, -1.0])
        return found._replace(quaternion=found.quaternion * [1, 1, -1, -1], omega=-found.omega * mirror)


class InDegrees(Lying, MuJoCo):
    """Tells joint angles in degrees."""

    def state(self):
        found = super().state()
        return found._replace(joint_position=np.degrees(found.joint_position))


WRONG = (
    Wrong(
        "quaternion is scalar-first", "quaternion", ScalarFirst,
        (
            Sight(
                FREE, RK, state("orientation") | MOMENTUM | TWIN,
                "twin state", "from its twin .* in orientation",
            ),
            Sight(
                TOP, SE, state("orientation") | P_ALPHA | ON_JOINTS | TWIN,
                "truth orientation", "distance from the exact motion",
            ),
        ),
        located=r"^quaternion is scalar-first$",
    ),
    Wrong(
        "quaternion is conjugated", "quaternion", Conjugated,
        (
            Sight(
                FREE, RK, state("orientation") | MOMENTUM | TWIN,
                "truth orientation", "distance from the exact motion",
            ),
        ),
        located=r"^quaternion is conjugated$",
    ),
    Wrong(
        "quaternion is never normalised", "quaternion", NeverNormalised,
        (alone(TUMBLING, SE, "invariant quaternion norm"),),
        located=r"^quaternion is not normalised",
    ),
    Wrong(
        "angular velocity is in world axes", "angular velocity", WorldOmega,
        (
            Sight(
                TOP, RK, state("omega") | ENERGY | P_ALPHA | P_GAMMA | ON_JOINTS | TWIN,
                "twin state", "from its twin .* in omega",
            ),
        ),
        located=r"^angular velocity is in world axes$",
    ),
    Wrong(
        "position is the frame's, not the centre's", "position", FrameNotCentre,
        (Sight(TOP, SE, RATES | ENERGY | P_ALPHA | ON_JOINTS, "truth nutation", "from the exact rate"),),
        located=r"^position is that of the frame, not of the centre of mass$",
    ),
    Wrong(
        "position stays where it was", "position", StuckInPlace,
        (Sight(FREE, SE, state("position") | TWIN, "twin state", "from its twin .* in position"),),
        located=r"^position never changes",
    ),
    Wrong(
        "joint velocities are those of the last sample", "joints", JointsOfLastSample,
        (
            Sight(
                CHAIN, SE, {"invariant joint speed residual"} | ON_JOINTS,
                "invariant joint speed residual", "change from the exact value at the start",
            ),
        ),
        located=r"^joint velocity is told one sample late$",
    ),
    Wrong(
        "attitudes are told of bodies that never turn", "quaternion", Turned,
        (
            Sight(
                CHAIN, SE, {"invariant attitude"} | ON_JOINTS,
                "invariant attitude", "change from the exact value at the start",
            ),
        ),
        located=r"^orientation told of the bodies does not fit their joints",
    ),
    Wrong(
        "velocity is the frame's, not the centre's", "velocity", VelocityOfFrame,
        (alone(TOP, SE, "invariant energy"),),
        located=r"^velocity is that of the frame, not of the centre of mass$",
    ),
    Wrong(
        "quaternions are left at zero", "quaternion", NoTurn,
        (alone(CHAIN, SE, "invariant quaternion norm"),),
        located=r"^quaternion is not normalised",
    ),
    Wrong(
        "velocity alone is one step late", "velocity", VelocityOneStepLate,
        (alone(TOP, SE, *ON_JOINTS), alone(TOP, RK, *ON_JOINTS)),
        located=r"^velocity told of the bodies does not fit their joints|^velocity is one step late",
    ),
    Wrong(
        "attitudes are mirrored", "quaternion", LeftHanded,
        (alone(TUMBLING, SE, "truth orientation", "truth omega", "invariant angular momentum"),),
    ),
    Wrong(
        "joint angles are in degrees", "joints", InDegrees, (alone(PENDULUM, SE, "truth hinge angle"),),
        located=r"^joint positions are in degrees$",
    ),
)  # fmt: skip
