"""Engines that stop, start again, change their mind, or hand out something other than their own motion."""

import numpy as np
from poinsot.adapters.engine import State
from poinsot.adapters.mujoco_ import MuJoCo

from .entry import CHAIN, OWN, RATES, SE, TOP, TUMBLING, TURNING, TWIN, Lying, Sight, Wrong, alone


class Undecided(MuJoCo):
    """The last bit of a velocity is another in every second run."""

    runs = 0

    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        self.runs += 1

    def state(self):
        state = super().state()
        return state._replace(omega=np.nextafter(state.omega, np.inf)) if self.runs % 2 else state


class Sleepy(MuJoCo):
    """Falls asleep half way."""

    def step(self, n):
        if self._steps * self._model.opt.timestep < self._scene.duration / 2:
            super().step(n)
        else:
            self._steps += n
            self._data.time += n * self._model.opt.timestep


class Recovers(Lying, MuJoCo):
    """Leaves the finite numbers for one sample, and is back as if nothing had been."""

    def state(self):
        found = super().state()
        t = self._steps * self._model.opt.timestep
        return found._replace(omega=found.omega * np.nan) if 0.3 < t < 0.32 else found


class Echo(Lying, MuJoCo):
    """Hands out the exact motion."""

    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        self._exact, self._stride = scene.truth(scene, scene.sample_times()), scene.steps_per_sample(dt)

    def step(self, n):
        self._steps += n

    def state(self):
        return State(*(getattr(self._exact, name)[self._steps // self._stride] for name in State._fields))


class NoisyEcho(Echo):
    """Hands out the exact motion, with noise that hides it."""

    def state(self):
        found = super().state()
        noise = np.random.default_rng().normal(scale=1e-6, size=found.omega.shape)
        return found._replace(omega=found.omega + noise)


class StartsAgain(Lying, MuJoCo):
    """Is back where it started half way, as MuJoCo's own reset would put it, and goes on from there."""

    def step(self, n):
        half = self._scene.duration / 2
        before = self._steps * self._model.opt.timestep
        super().step(n)
        if before < half <= self._steps * self._model.opt.timestep:
            self._data.qpos[self._q], self._data.qvel[self._v] = self._scene.q0, self._scene.v0


class HurriedEcho(Echo):
    """Hands out the exact motion by a clock that is wrong by dt: its error is of first order."""

    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        self._exact = scene.truth(scene, scene.sample_times() * (1 + dt / 2))


class Predicting(Echo):
    """Hands out the motion of the very scheme, where that is known in closed form."""

    def build(self, scene, scheme, dt):
        super().build(scene, scheme, dt)
        if scene.scheme_motion:
            self._exact = scene.scheme_motion(scene, scheme.twin, dt, scene.sample_times())


WRONG = (
    Wrong(
        "last bit differs from run to run", "determinism", Undecided,
        (Sight(TOP, SE, {"determinism state"}, "determinism state", "2 runs gave 2 different motions"),),
        located=r"^not deterministic",
    ),
    Wrong(
        "motion stops half way", "freeze", Sleepy,
        (Sight(TOP, SE, TURNING | RATES | TWIN, "truth orientation", "distance from the exact motion"),),
        located=r"^answers do not move after t = 1 s$",
    ),
    Wrong(
        "not finite for a moment, then well again", "not finite", Recovers,
        (Sight(TOP, SE, (), "refused", r"not finite at t = 0\.3"),),
    ),
    Wrong(
        "the exact motion, handed out as its own", "echo", Echo,
        (
            Sight(
                TOP, SE, {"order orientation", "order omega"} | TWIN, "order omega",
                "although the scheme's own error is 0.17 rad/s at dt 0.002 s: too good to be an integration",
            ),
            Sight(
                CHAIN, SE, {"order position", "order velocity"} | OWN | TWIN,
                "order position", "too good to be an integration",
            ),
        ),
        located=r"^answers are the exact motion itself, not an integration",
    ),
    Wrong(
        "the exact motion with noise", "echo", NoisyEcho,
        (alone(TUMBLING, SE, "determinism state", "order omega", "order orientation"),),
        located=r"^answers are the exact motion itself with noise of .* rad/s in omega$",
    ),
    Wrong(
        "reset to the start half way", "reset", StartsAgain,
        (alone(TOP, SE, "truth orientation", "order orientation"),),
        located=r"^state was reset to the start between t = 0\.99 s and 1 s$",
    ),
    Wrong(
        "the exact motion by a clock that is wrong by dt", "echo", HurriedEcho,
        (
            Sight(TOP, SE, TWIN, "twin state", "from its twin", near=RATES | TURNING),
            alone(CHAIN, SE, "truth position, scheme's own"),
        ),
    ),
    Wrong(
        "the scheme's motion in closed form, where there is one", "echo", Predicting,
        (alone(TOP, SE, "order orientation", says="too good to be an integration"),),
        located=r"^answers are the exact motion itself, not an integration",
    ),
)  # fmt: skip
