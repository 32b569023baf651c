"""Print what a step costs in the harness, beside a plain Python loop over the engine's own step.

    python benchmarks/step_cost.py [SCENE ...]

Both loops are timed in turn, many times over, in this process on one core; the least of each is printed,
in microseconds a step, and their ratio, which must not exceed 1.00. Beside them: what a step takes that is
asked for alone, and what an empty call takes, which is Python's share of that.
"""

import gc
import importlib
import sys
from time import perf_counter

import numpy as np
from poinsot.adapters import registry, timing
from poinsot.scenarios.registry import select

DT, STEPS, ROUNDS = 1e-4, 500, 300
SCENES = ("free_symmetric_top[oblate]", "heavy_top[moderate]", "co2_chain[mixture]")


def mujoco_loop(engine, n):
    """One ``mj_step`` after another."""
    step, model, data = importlib.import_module("mujoco").mj_step, engine._model, engine._data
    for _ in range(n):
        step(model, data)


def pinocchio_loop(engine, n):
    """Semi-implicit Euler as one writes it down."""
    pin = importlib.import_module("pinocchio")
    model, data, q, v = engine._model, engine._data, engine._position, engine._velocity
    k, tau = np.array([joint.stiffness for joint in engine._scene.scalar_joints]), np.zeros(model.nv)
    sprung = len(k) == model.nv
    for _ in range(n):
        if sprung:
            tau = -k * q
        a = pin.aba(model, data, q, v, tau)
        v += a * DT
        q = pin.integrate(model, q, v * DT)


def pybullet_loop(engine, n):
    """One ``stepSimulation`` after another, with the forces of springs handed over before each."""
    p, world = importlib.import_module("pybullet"), engine._world
    client, springs = world.client, world.at.springs
    for _ in range(n):
        for uid, links, pulls in springs:
            states = p.getJointStates(uid, links, physicsClientId=client)
            forces = [pull * state[0] for pull, state in zip(pulls, states, strict=True)]
            p.setJointMotorControlArray(uid, links, p.TORQUE_CONTROL, forces=forces, physicsClientId=client)
        p.stepSimulation(physicsClientId=client)


LOOPS = {"mujoco": mujoco_loop, "pybullet": pybullet_loop, "pinocchio": pinocchio_loop}


def least(*loops):
    """Least time [s] of each loop, run in turn so that a busy moment of the machine hits them alike."""
    times = [[] for _ in loops]
    for _ in range(ROUNDS):
        for loop, found in zip(loops, times, strict=True):
            gc.disable()
            start = perf_counter()
            loop(STEPS)
            found.append(perf_counter() - start)
            gc.enable()
    return [min(found) for found in times]


def compared(scene, engine):
    """Microseconds a step of the plain loop and of the harness, of a step alone, and of an empty call."""
    plain, ours = engine(), engine()
    for machine in (plain, ours):
        machine.build(scene, engine.schemes[0], DT)
    alone = engine()
    alone.build(scene, engine.schemes[0], DT)

    def one_by_one(n):
        step = alone.step
        for _ in range(n):
            step(1)

    seconds = least(lambda n: LOOPS[engine.name](plain, n), ours.step, one_by_one)
    return [*(1e6 * second / STEPS for second in seconds), 1e6 * timing.empty_call(ours)]


def main(names):
    """Print a table, a row for each scene and engine."""
    timing.pin()
    head = ("plain", "harness", "ratio", "alone", "call")
    print(f"{'scene':28} {'engine':10} {' '.join(f'{word:>8}' for word in head)}")
    for scene in select(names):
        for name in LOOPS:
            plain, ours, alone, call = compared(scene, registry.load(name))
            found = (plain, ours, ours / plain, alone, call)
            print(f"{scene.full_name:28} {name:10} {' '.join(f'{value:8.2f}' for value in found)}")


if __name__ == "__main__":
    main(sys.argv[1:] or list(SCENES))
