"""What is written to a log comes back to the last bit, and nothing half-written is ever found."""

import json
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from poinsot.adapters import log, log_provenance
from poinsot.reference.errors import InputError
from poinsot.scenarios.trajectory import Provenance

ARRAYS = ("t", "position", "quaternion", "velocity", "omega", "joint_position", "joint_velocity")


@pytest.mark.parametrize(("bodies", "hinges", "samples"), [(1, 0, 1), (1, 0, 2), (1, 4, 3000), (3, 2, 700)])
def test_every_array_comes_back_bit_for_bit(tmp_path, make_cell, bodies, hinges, samples):
    scene, motion = make_cell(bodies, hinges, samples)
    log.write(tmp_path / "a.mcap", scene, motion, {})
    got = log.read(tmp_path / "a.mcap").trajectory
    for name in ARRAYS:
        expected, array = getattr(motion, name), getattr(got, name)
        assert array.dtype == np.float64
        assert array.shape == expected.shape
        assert array.tobytes() == expected.tobytes(), name
        assert array.flags.writeable
        assert array.flags.aligned


def with_reactions(scene, motion):
    """The same cell, the reactions of its last and first body measured."""
    told = np.random.default_rng(3).normal(size=(len(motion.t), 2, 6))
    told.flat[:4] = (0.0, -0.0, np.nan, 5e-324)
    return replace(scene, reactions=(scene.bodies[-1].name, scene.bodies[0].name)), replace(
        motion, reaction=told
    )


def test_reactions_come_back_bit_for_bit_where_there_are_some(tmp_path, make_cell):
    bare, scene = make_cell(3, 2, 700), with_reactions(*make_cell(3, 2, 700))
    for name, cell in {"bare": bare, "told": scene}.items():
        log.write(tmp_path / name, *cell, {})
    told, none = (log.read(tmp_path / name).trajectory for name in ("told", "bare"))
    assert told.reaction.tobytes() == scene[1].reaction.tobytes()
    assert told.position.tobytes() == none.position.tobytes()
    assert none.reaction.shape == (700, 0, 6)
    assert "reactions" not in json.loads(bare[0].as_json())
    assert json.loads(scene[0].as_json())["reactions"] == ["body 2", "body 0"]


def test_scene_and_models_come_back(tmp_path, make_cell):
    scene, motion = make_cell()
    models = {"model.xml": '<mujoco model="größe"/>\r\n', "arm.urdf": "", "note": "line\n"}
    log.write(tmp_path / "a.mcap", scene, motion, models)
    got = log.read(tmp_path / "a.mcap")
    assert got.attachments == models
    assert got.scene_json == scene.as_json()
    assert json.loads(got.scene_json)["name"] == "chain"


PLAIN = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False) | st.text(),
    lambda parts: (
        st.lists(parts)
        | st.lists(parts).map(tuple)
        | st.dictionaries(st.text().filter(lambda key: not key.startswith("$")), parts)
    ),
    max_leaves=10,
)


# No deadline: how long an example takes says nothing of it.
@settings(deadline=None, max_examples=60)
@given(
    st.dictionaries(st.text().filter(lambda key: not key.startswith("$")), PLAIN), st.floats(1e-300, 1e300)
)
def test_provenance_comes_back_exactly(setup, dt):
    given_one = Provenance(
        "heavy_top[fast]", "möbius", "4.0", "Euler", 1, "", dt, 7, setup=setup, probed=("damping",),
        digests=("ab", "cd"), settings={"solver": "Newton"}, environment={"cores": 2, "setup": setup},
    )  # fmt: skip
    got = log_provenance.from_metadata(log_provenance.to_metadata(given_one))
    assert got == given_one
    # Equality lets 1, 1.0 and True pass for each other, and 0.0 for -0.0.
    assert repr(got) == repr(given_one)


def test_provenance_survives_the_file(tmp_path, make_cell):
    scene, motion = make_cell()
    setup = {
        "velocity_limit": float("inf"),
        "body/top/inertia": [[0.1, -0.0], (1e-320, 3)],
        "nan": float("nan"),
    }
    run = replace(motion.provenance, setup=setup, settings={"a": "b\nc"}, environment={"python": "3.11"})
    log.write(tmp_path / "a.mcap", scene, replace(motion, provenance=run), {})
    got = log.read(tmp_path / "a.mcap").trajectory.provenance
    assert repr(got) == repr(run)


def test_the_same_cell_gives_the_same_bytes(tmp_path, make_cell):
    for name in ("a.mcap", "b.mcap"):
        log.write(tmp_path / name, *make_cell(samples=3000), {"m.xml": "<m/>"})
    assert (tmp_path / "a.mcap").read_bytes() == (tmp_path / "b.mcap").read_bytes()


def _without_provenance(scene, motion):
    return scene, replace(motion, provenance=None)


def _of_another_scene(scene, motion):
    return replace(scene, variant="other"), motion


def _of_other_bodies(scene, motion):
    return replace(scene, bodies=scene.bodies[:1], q0=(0.0,), v0=(0.0,)), motion


def _unmeasured(scene, motion):
    return with_reactions(scene, motion)[0], motion


def _time_standing_still(scene, motion):
    return scene, replace(motion, t=np.zeros_like(motion.t))


def _time_not_a_number(scene, motion):
    return scene, replace(motion, t=np.where(motion.t > 0.01, np.nan, motion.t))


def _an_array_in_the_setup(scene, motion):
    return scene, replace(motion, provenance=replace(motion.provenance, setup={"g": np.zeros(3)}))


def _no_samples(scene, motion):
    return scene, replace(motion, **{name: getattr(motion, name)[:0] for name in ARRAYS})


@pytest.mark.parametrize(
    ("spoil", "words"),
    [
        (_without_provenance, "no provenance"),
        (_of_another_scene, r"expected scene chain\[other\]"),
        (_of_other_bodies, "1 bodies, 1 scalar joints"),
        (_unmeasured, "0 reactions; expected .* 2 reactions"),
        (_time_standing_still, "increasing"),
        (_time_not_a_number, "increasing"),
        (_an_array_in_the_setup, "provenance setup: got array"),
        (_no_samples, "got 0 times"),
    ],
)
def test_what_cannot_be_logged_is_refused_and_leaves_nothing(tmp_path, make_cell, spoil, words):
    with pytest.raises(InputError, match=words) as caught:
        log.write(tmp_path / "a.mcap", *spoil(*make_cell()), {})
    assert "\n" not in str(caught.value)
    assert list(tmp_path.iterdir()) == []


def test_a_model_may_not_take_the_scenes_name(tmp_path, make_cell):
    with pytest.raises(InputError, match=r"scene\.json"):
        log.write(tmp_path / "a.mcap", *make_cell(), {"scene.json": ""})


def test_a_folder_that_is_not_there_is_one_clear_line(tmp_path, make_cell):
    with pytest.raises(InputError, match=r"a\.mcap: cannot be written: No such file"):
        log.write(tmp_path / "nowhere" / "a.mcap", *make_cell(), {})


@pytest.mark.parametrize(
    "failing", ["poinsot.adapters.log_container.Container.finish", "pathlib.Path.replace"]
)
def test_a_failure_in_the_middle_keeps_the_old_log_and_nothing_else(
    tmp_path, make_cell, monkeypatch, failing
):
    path = tmp_path / "a.mcap"
    log.write(path, *make_cell(), {})
    before = path.read_bytes()

    def fail(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(failing, fail)
    with pytest.raises(InputError, match="No space left"):
        log.write(path, *make_cell(samples=30), {})
    assert path.read_bytes() == before
    assert list(tmp_path.iterdir()) == [path]


def test_a_process_that_dies_while_writing_leaves_no_log(tmp_path, make_cell):
    log.write(tmp_path / "a.mcap", *make_cell(), {})
    program = (
        "import os, sys; from pathlib import Path; from poinsot.adapters import log, log_container\n"
        "log_container.Container.finish = lambda self: os._exit(9)\n"
        "from poinsot.scenarios.scene import Scene; from poinsot.scenarios.body import Body, diagonal\n"
        "from poinsot.scenarios.trajectory import Trajectory, Provenance; import numpy as np\n"
        "body = Body('b', 1.0, diagonal(1.0, 1.0, 1.0), ())\n"
        "scene = Scene('s', '', '', (body,), (), (), 1.0, 1, None, ())\n"
        "one = np.zeros((1, 1, 3)); q = np.zeros((1, 1, 4)); j = np.zeros((1, 0))\n"
        "run = Provenance('s', 'e', '1', 'x', 1, 'x', 1.0, 1)\n"
        "log.write(Path(sys.argv[1]), scene, Trajectory(np.zeros(1), one, q, one, one, j, j, run), {})\n"
    )
    target = tmp_path / "dead.mcap"
    done = subprocess.run([sys.executable, "-c", program, str(target)], capture_output=True, text=True)
    assert done.returncode == 9, done.stderr
    assert [path.name for path in tmp_path.glob("*.mcap")] == ["a.mcap"]
    assert list(tmp_path.glob(".dead.mcap.*.part")), "the process died before it wrote anything"


def test_logs_are_read_where_no_engine_is_imported():
    program = (
        "import sys; import poinsot.adapters.log\n"
        "sys.exit(', '.join({'mujoco', 'pybullet', 'pinocchio'} & set(sys.modules)) or 0)"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")
