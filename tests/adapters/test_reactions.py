"""Reactions of joints: engine against engine, against the change of momenta, and what PyBullet adds."""

from dataclasses import replace

import numpy as np
import pytest
from poinsot.adapters.simulate import digest, simulate
from poinsot.reference import joint_reactions, quaternions
from poinsot.scenarios import equations, mechanics, rotor_balance
from poinsot.scenarios.body import Body, Joint
from poinsot.scenarios.forces import Constant, Coriolis
from poinsot.scenarios.registry import scenes

DT = 1e-3
#: So short [s] that a difference over it is a derivative to 1e-7.
STEP = 1e-5


def made(name):
    module = pytest.importorskip(f"poinsot.adapters.{name}_")
    return getattr(module, {"mujoco": "MuJoCo", "pinocchio": "Pinocchio", "pybullet": "PyBullet"}[name])


def told(name, scene, dt=DT):
    machine = made(name)()
    machine.build(scene, machine.schemes[0], dt)
    found = machine.reactions()
    machine.close()
    return found


def held(scene):
    """The scene, asked for the reactions of every body that joints hold."""
    names = [body.name for body in scene.bodies if body.joints and body.joints[0].kind != "free"]
    return replace(scene, reactions=tuple(reversed(names)))


@pytest.mark.parametrize("seed", range(10))
@pytest.mark.parametrize("name", ["mujoco", "pinocchio"])
def test_they_are_those_of_newtons_and_eulers_equations_on_any_tree(random_tree, links_of, name, seed):
    scene = held(random_tree(seed))
    names = [body.name for body in scene.bodies]
    expected = joint_reactions.reactions(
        links_of(scene), scene.q0, scene.v0, scene.gravity, [names.index(name) for name in scene.reactions]
    )
    assert told(name, scene) == pytest.approx(expected, abs=1e-11 * np.abs(expected).max())


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("name", ["mujoco", "pinocchio", "pybullet"])
def test_what_acts_from_outside_is_no_part_of_them(random_tree, links_of, name, seed):
    # Left in, as MuJoCo and Pinocchio do by themselves, it would show in force and moment.
    made("pybullet")
    scene = held(random_tree(seed))
    pushed = [body.name for body in scene.bodies]
    forces = (
        Constant(pushed[-1], (3.0, -2.0, 5.0)),
        Coriolis((0.4, -0.7, 1.1)),
        Constant(pushed[0], (1.0, 2.0, 0.5)),
    )
    scene = replace(scene, forces=forces, v0=tuple(1e-3 * np.array(scene.v0)))
    state = np.array([scene.q0]), np.array([scene.v0])
    outer = equations.outer_forces(scene, *state)
    expected = joint_reactions.reactions(
        links_of(scene), *state, scene.gravity, [pushed.index(body) for body in scene.reactions], outer
    )[0]
    # What PyBullet adds is of the square of speeds, here of 1e-3, after the step.
    error = 1e-11 if name != "pybullet" else 1e-5
    assert told(name, scene, 1e-9) == pytest.approx(expected, abs=error * np.abs(expected).max())


@pytest.mark.parametrize("name", ["mujoco", "pinocchio"])
@pytest.mark.parametrize("seed", [1, 3])
def test_what_holds_a_tree_is_what_its_momenta_change_by(random_tree, name, seed):
    base = random_tree(seed)
    assert base.bodies[0].parent is None
    scene = replace(held(base), duration=2 * STEP, samples=2, reactions=(base.bodies[0].name,))
    kind = made(name)
    scheme = next(scheme for scheme in kind.schemes if scheme.order == 4)
    motion, _ = simulate(scene, kind, scheme, STEP)
    turn, root = motion.quaternion[1, 0], scene.bodies[0]
    force, moment = (quaternions.rotated(turn, part) for part in np.split(motion.reaction[1, 0], 2))
    weights = np.outer([body.mass for body in scene.bodies], scene.gravity)
    change = [np.diff(of(scene, motion)[::2], axis=0)[0] / (2 * STEP)
              for of in (mechanics.momentum, mechanics.angular_momentum_world)]  # fmt: skip
    assert force + weights.sum(axis=0) == pytest.approx(change[0], abs=1e-6 * np.abs(change[0]).max())
    origin = motion.position[1, 0] - quaternions.rotated(turn, np.array(root.center_of_mass))
    about = moment + np.cross(origin, force) + np.cross(motion.position[1], weights).sum(axis=0)
    assert about == pytest.approx(change[1], abs=1e-6 * np.abs(change[1]).max())


@pytest.mark.parametrize("seed", range(6))
def test_pybullet_tells_the_same_at_rest(random_tree, seed):
    made("pybullet")
    scene = held(random_tree(seed))
    scene = replace(scene, v0=(0.0,) * len(scene.v0))
    other = told("pinocchio", scene)
    # What PyBullet adds is of the speed after the step: of so short a one, nothing.
    assert told("pybullet", scene, 1e-9) == pytest.approx(other, abs=1e-9 * np.abs(other).max())


@pytest.mark.parametrize("variant", ["dynamic", "braked"])
def test_pybullet_counts_the_gyroscopic_moment_twice(variant):
    made("pybullet")
    scene = scenes()[f"rotor_balance[{variant}]"]
    body, spin = scene.bodies[0], scene.v0[0]
    exact = scene.truth(scene, np.array([0.0])).reaction[0]
    found = told("pybullet", scene) - exact
    after = spin * (1 - DT * rotor_balance.BRAKE / moment_about_axle(body) * (variant == "braked"))
    omega = np.array([0.0, 0.0, after])
    assert found[0, :3] == pytest.approx(0, abs=1e-12)
    assert found[0, 3:] == pytest.approx(np.cross(omega, body.inertia_array @ omega), abs=1e-12)
    assert np.abs(found).max() > 0.5


def moment_about_axle(body):
    x, y, _ = body.center_of_mass
    return body.inertia_array[2, 2] + body.mass * (x**2 + y**2)


@pytest.mark.parametrize("name", ["mujoco", "pinocchio", "pybullet"])
def test_the_motion_goes_on_as_if_nobody_had_asked(name):
    kind, scene = made(name), scenes()["rotor_balance[braked]"]
    scene = replace(scene, duration=0.16, samples=10)
    asked, _ = simulate(scene, kind, kind.schemes[0], DT)
    alone, _ = simulate(replace(scene, reactions=()), kind, kind.schemes[0], DT)
    assert digest(replace(asked, reaction=alone.reaction)) == digest(alone)
    assert digest(asked) != digest(alone)


def test_two_hinges_of_one_body_bear_one_reaction():
    """What holds it together is told once, at the joint nearest to the body."""
    axes = (1.0, 0.0, 0.0), (0.0, 0.6, 0.8)
    joints = tuple(Joint(f"hinge {k}", "hinge", axis) for k, axis in enumerate(axes))
    tensor = ((0.03, 0.004, 0.0), (0.004, 0.02, 0.0), (0.0, 0.0, 0.04))
    body = Body("arm", 1.5, tensor, joints, center_of_mass=(0.1, -0.2, 0.3), position=(1.0, 2.0, 3.0))
    given = {"bodies": (body,), "q0": (0.4, -0.9), "v0": (0.0, 0.0), "reactions": ("arm",)}
    scene = replace(scenes()["rotor_balance[static]"], **given)
    every = [told(name, scene, 1e-9) for name in ("mujoco", "pinocchio", "pybullet")]
    for one in every[1:]:
        assert one == pytest.approx(every[0], abs=1e-12)
    # No moment along the axes of hinges that turn freely.
    first = quaternions.rotated(
        quaternions.from_rotation_vector(-scene.q0[1] * np.array(axes[1])), np.array(axes[0])
    )
    assert every[0][0, 3:] @ np.array(axes[1]) == pytest.approx(0, abs=1e-12)
    assert every[0][0, 3:] @ first == pytest.approx(0, abs=1e-12)
