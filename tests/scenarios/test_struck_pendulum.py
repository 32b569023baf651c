"""The struck pendulum: what its hinge bears, against equations of a tree, and engines that err in it."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from poinsot.adapters.registry import scheme_of
from poinsot.adapters.simulate import simulate
from poinsot.reference import compound_pendulum as closed_form
from poinsot.reference import joint_reactions, quaternions
from poinsot.reports import told_reactions
from poinsot.reports.cell import Cell
from poinsot.scenarios import blows, compound_pendulum, equations, struck_pendulum
from poinsot.scenarios.blows import at_work
from poinsot.scenarios.forces import forces_on
from poinsot.scenarios.registry import scenes
from poinsot.scenarios.struck_pendulum import END, START
from scipy.integrate import simpson

AT, ABOVE, BELOW = (scenes()[f"compound_pendulum[{variant}]"] for variant in struck_pendulum.PLACES)
JUST_THE_MOTION = {"reactions": (), "observables": (), "errors": {}}
EVERY = pytest.mark.parametrize("scene", [AT, ABOVE, BELOW], ids=lambda scene: scene.variant)


@EVERY
def test_what_the_hinge_bears_is_what_newtons_and_eulers_equations_of_a_tree_give(scene):
    motion = scene.truth(scene, scene.sample_times())
    forces = [
        forces_on(scene.bodies, at_work(scene.forces, t + 1e-9))(*at)
        for t, *at in zip(motion.t, motion.position, motion.velocity, strict=True)
    ]
    state = motion.joint_position, motion.joint_velocity
    found = joint_reactions.reactions(equations.links(scene), *state, scene.gravity, (0,), np.array(forces))
    assert motion.reaction == pytest.approx(found, abs=1e-12 * np.abs(found).max())
    assert np.any(forces, axis=(1, 2)).sum() == 2


@EVERY
def test_the_truth_is_what_comes_of_integrating_its_equations(scene):
    # Piece by piece: before, while and after it is struck.
    edges = (0.0, START, END, scene.duration)
    for begin, end in pairwise(edges):
        now = scene.truth(scene, np.array([begin]))
        q0, v0 = (tuple(part[0].tolist()) for part in (now.joint_position, now.joint_velocity))
        acting = blows.lasting(at_work(scene.forces, (begin + end) / 2))
        piece = replace(scene, forces=acting, q0=q0, v0=v0, **JUST_THE_MOTION)
        (found,) = equations.motions(piece, np.array([v0]), np.linspace(0.0, end - begin, 11))
        exact = scene.truth(scene, np.linspace(begin, end, 11))
        assert exact.position == pytest.approx(found.position, abs=1e-7)
        assert exact.velocity == pytest.approx(found.velocity, abs=1e-6)


def test_at_the_centre_of_percussion_alone_the_hinge_bears_nothing_of_the_blow():
    for scene, way in ((AT, 0), (ABOVE, -1), (BELOW, 1)):
        motion = scene.truth(scene, scene.sample_times())
        borne = struck_pendulum.borne_of_the_blow(scene, motion)
        struck = (motion.t > START - 1e-9) & (motion.t < END - 1e-9)
        assert np.abs(borne[~struck]).max() < 1e-13 * struck_pendulum.FORCE
        if way == 0:
            assert np.abs(borne).max() < 1e-13 * struck_pendulum.FORCE
        else:
            assert (way * borne[struck] > 0.3 * struck_pendulum.FORCE).all()


@EVERY
def test_jump_and_impulse_are_near_those_of_a_moments_blow(scene):
    # In 0.04 s the body turns, and gravity and the hinge's pull along the arm have their share.
    mass, arm, moment, distance = struck_pendulum.whole(scene)
    given = struck_pendulum.FORCE * (END - START)
    jump, impulse = closed_form.struck(mass, arm, moment, distance, given)
    exact = {o.name: o.exact(scene) for o in scene.observables if o.kind == "rate"}
    assert exact["jump of omega"] == pytest.approx(jump, rel=0.08)
    assert exact["hinge impulse"] == pytest.approx(impulse, abs=0.07 * given)
    # Whatever else the hinge bears and gravity gives, what is told of it adds up to the impulse.
    t = np.linspace(START, END, 2001)
    motion = scene.truth(scene, t)
    force = quaternions.rotated(motion.quaternion[:, 0], motion.reaction[:, 0, :3])
    (blow,) = scene.forces
    along = np.array(blow.force) / struck_pendulum.FORCE
    assert simpson((force @ along)[:-1], x=t[:-1]) == pytest.approx(exact["hinge impulse"], abs=1e-3)


def mujoco():
    return pytest.importorskip("poinsot.adapters.mujoco_")


def test_an_engine_that_leaves_the_blow_in_what_the_hinge_bears_is_seen_and_named(failed):
    kind = mujoco().MuJoCo

    class Forgetful(kind):
        """MuJoCo's own count, of forces by its callback."""

        def reactions(self):
            forces, self._forces = self._forces, None
            try:
                return super().reactions()
            finally:
                self._forces = forces

    found = failed(Forgetful, AT)
    assert {("truth", "reaction force"), ("truth", "borne of the blow")} <= found
    assert not [name for check, name in found if check in ("twin", "acceleration") or name == "omega"]
    run, _ = simulate(AT, Forgetful, scheme_of(kind, None), 1e-3)
    cell = Cell.of(run, dict(scenes()))
    assert told_reactions.cause(cell) == "reactions hold what acts from outside"


def test_an_engine_that_lets_the_blow_act_at_the_bodys_centre_is_seen(failed):
    class Central(mujoco().MuJoCo):
        def build(self, scene, scheme, dt):
            (blow,) = scene.forces
            super().build(replace(scene, forces=(replace(blow, body="hung"),)), scheme, dt)

    found = failed(Central, AT)
    names = {"omega", "jump of omega", "hinge impulse", "reaction force", "borne of the blow"}
    assert {("truth", name) for name in names} <= found


def test_an_engine_that_asks_at_each_stage_whether_the_blow_is_on_is_of_first_order(failed):
    module = mujoco()

    class Asking(module.MuJoCo):
        """Has the blow on at a stage that stands where it starts, off at one where it ends."""

        def build(self, scene, scheme, dt):
            super().build(scene, scheme, dt)
            forces = self._forces

            def found(model, data):
                if data is self._data:
                    forces._total = forces_on(scene.bodies, at_work(scene.forces, data.time + 1e-9))
                return type(forces).found(forces, model, data)

            forces.found = found

    found = failed(Asking, AT, "RKMK4")
    assert {("order", name) for name in ("omega", "position", "orientation")} <= found
    # At first order a step is either in the blow or not: nothing is wrong.
    assert not failed(Asking, AT)


def test_the_peg_moves_with_the_body_and_is_not_where_the_centre_is():
    mass, arm, moment, distance = struck_pendulum.whole(AT)
    assert distance == pytest.approx(moment / (mass * arm), rel=1e-14)
    assert distance - arm > 0.1 * arm
    assert mass == compound_pendulum.MASS + struck_pendulum.PEG
