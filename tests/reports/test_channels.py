"""What is logged is what is read: every array of a state by a check of every scene, the rest by viewers."""

from dataclasses import fields

import numpy as np
import pytest
from mcap.reader import make_reader
from poinsot.adapters import log
from poinsot.adapters.log_schema import State
from poinsot.adapters.registry import load
from poinsot.adapters.simulate import simulate
from poinsot.scenarios.registry import scenes
from poinsot.scenarios.trajectory import Trajectory

LOGGED = {field.name for field in State.DESCRIPTOR.fields}
#: What no check reads, each with who does.
VIEWS = {"/tf": "viewers, for where bodies are", "/scene": "viewers, for what they look like"}


class Watched(Trajectory):
    """Notes which of its arrays are read."""

    def __post_init__(self):
        super().__post_init__()
        object.__setattr__(self, "read", set())

    def __getattribute__(self, name):
        if name in LOGGED and "read" in object.__getattribute__(self, "__dict__"):
            object.__getattribute__(self, "read").add(name)
        return object.__getattribute__(self, name)


@pytest.mark.parametrize("scene", scenes().values(), ids=lambda scene: scene.full_name)
def test_every_array_that_is_logged_is_read_by_a_check(scene):
    exact = scene.truth(scene, scene.sample_times())
    motion = Watched(**{field.name: getattr(exact, field.name) for field in fields(Trajectory)})
    for observable in scene.observables:
        observable.distance(scene, motion, exact)
    # An array without a column is not in the log at all.
    assert motion.read | {"t"} >= {name for name in LOGGED if np.size(getattr(exact, name))}


def test_a_log_holds_the_state_and_what_viewers_need(tmp_path):
    pytest.importorskip("mujoco")
    scene, engine = scenes()["co2_chain[mixture]"], load("mujoco")
    run, model = simulate(scene, engine, engine.schemes[0], scene.dt)
    log.write(tmp_path / "a.mcap", scene, run, model)
    with (tmp_path / "a.mcap").open("rb") as stream:
        topics = {channel.topic for channel in make_reader(stream).get_summary().channels.values()}
    assert topics == {"/state", *VIEWS}
