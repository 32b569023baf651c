"""What a scene refuses, how it rounds a step, and which steps and constants it gives to a scheme."""

import json
import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from poinsot.reference.errors import InputError
from poinsot.scenarios import heavy_top, observables, registry
from poinsot.scenarios.body import Body, Joint, diagonal
from poinsot.scenarios.burning import Burning
from poinsot.scenarios.forces import Constant
from poinsot.scenarios.registry import scenes, select
from poinsot.scenarios.scene import Scene

UNIT = diagonal(1.0, 1.0, 1.0)
HINGE = Joint("hinge", "hinge", stiffness=2.0, damping=0.5)
STATE = (observables.position(), observables.velocity())


def scene(**changes):
    """A hinge on the world, a ball on the hinge and a slide on the ball."""
    bodies = (
        Body("arm", 1.0, UNIT, (HINGE,)),
        Body("hand", 1.0, UNIT, (Joint("ball", "ball"),), parent="arm"),
        Body("finger", 1.0, UNIT, (Joint("slide", "slide"),), parent="hand"),
    )
    given = {
        "name": "reach", "summary": "", "source": "", "bodies": bodies, "duration": 1.0, "samples": 10,
        "q0": (0.1, 0.0, 0.0, 0.6, 0.8, 0.2), "v0": (1.0, 2.0, 3.0, 4.0, 5.0),
        "truth": None, "observables": STATE,
    }  # fmt: skip
    return Scene(**(given | changes))


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"duration": 0.0}, "duration: got 0.0, expected a number above 0"),
        ({"duration": float("nan")}, "duration"),
        ({"dt": -1e-3}, "dt: got -0.001"),
        ({"samples": 0}, "samples: got 0, expected a whole number, at least 1"),
        ({"samples": float("nan")}, "samples: got nan"),
        ({"samples": 1.5}, "samples: got 1.5"),
        ({"gravity": (0.0, float("inf"), 0.0)}, "gravity"),
        ({"q0": (0.1, 0.0, 0.0, 0.6, 0.8)}, "q0: got an array of shape (5,), expected (6,)"),
        ({"v0": (0.0,) * 6}, "v0: got an array of shape (6,), expected (5,)"),
        ({"v0": (1.0, 2.0, float("nan"), 4.0, 5.0)}, "v0"),
        (
            {"q0": (0.1, 0.0, 0.0, 0.6, 0.9, 0.2)},
            "q0 of joint 'ball': got [0.0, 0.0, 0.6, 0.9], expected a unit",
        ),
        ({"q0": (0.1, 0.0, 0.0, 0.6, 0.8 + 1e-8, 0.2)}, "expected a unit quaternion"),
        ({"errors": {"RKMK4": (1.0,)}}, "errors of 'RKMK4': got 1 constants, expected one for each of 2"),
        ({"bodies": ()}, "bodies: got the names []"),
        (
            {"reactions": ("foot",)},
            "reactions: got ['foot'], expected each once, of bodies that a ball, hinge",
        ),
        ({"reactions": ("arm", "arm")}, "slide holds: arm, hand, finger"),
    ],
)
def test_what_cannot_be_is_refused_by_scene_and_field(changes, says):
    with pytest.raises(InputError, match=re.escape(says)) as caught:
        scene(variant="far", **changes)
    assert str(caught.value).startswith("scene reach[far]: ")


def test_reactions_are_of_bodies_that_joints_hold_and_stand_beside_no_contacts_or_burning():
    thrown = Body("a", 1.0, UNIT, (Joint("free", "free"),))
    at_rest = {"q0": (0.0,) * 6 + (1.0,), "v0": (0.0,) * 6}
    with pytest.raises(InputError, match="slide holds: there are none"):
        scene(bodies=(thrown,), reactions=("a",), **at_rest)
    with pytest.raises(InputError, match="reactions: got some beside contacts or burning bodies"):
        scene(reactions=("arm",), burning=(Burning("hand", 1e-3),))
    assert scene(reactions=("arm",), forces=(Constant("hand", (0.0, 0.0, 1.0)),)).reactions


def test_bodies_must_differ_in_name():
    twice = (Body("a", 1.0, UNIT, (HINGE,)), Body("a", 1.0, UNIT, ()))
    with pytest.raises(InputError, match=re.escape("bodies: got the names ['a', 'a']")):
        scene(bodies=twice, q0=(0.0,), v0=(0.0,))


@pytest.mark.parametrize("parent", ["b", "nobody"])
def test_a_parent_is_listed_before_its_child(parent):
    bodies = (Body("a", 1.0, UNIT, (HINGE,), parent=parent), Body("b", 1.0, UNIT, ()))
    with pytest.raises(
        InputError, match=f"body 'a' parent: got '{parent}', expected a body listed before it"
    ):
        scene(bodies=bodies, q0=(0.0,), v0=(0.0,))


def test_coordinates_lie_body_by_body():
    places = {joint.name: (body.name, at_q, at_v) for body, joint, at_q, at_v in scene().slices()}
    assert places == {
        "hinge": ("arm", slice(0, 1), slice(0, 1)),
        "ball": ("hand", slice(1, 5), slice(1, 4)),
        "slide": ("finger", slice(5, 6), slice(4, 5)),
    }
    assert [joint.name for joint in scene().scalar_joints] == ["hinge", "slide"]


@pytest.mark.parametrize(
    ("changes", "features"),
    [
        ({}, {"hinge", "ball", "slide", "tree", "spring", "damper"}),
        ({"gravity": (0.0, 1.0, 0.0)}, {"hinge", "ball", "slide", "tree", "spring", "damper", "gravity"}),
        (
            {"bodies": (Body("a", 1.0, UNIT, (Joint("free", "free"),)), Body("b", 1.0, UNIT, (), parent="a")),
             "q0": (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0), "v0": (0.0,) * 6},
            {"free", "weld", "tree"},
        ),
        ({"bodies": (Body("a", 1.0, UNIT, (Joint("h", "hinge", damping=1.0),)),), "q0": (0.0,), "v0": (0.0,)},
         {"hinge", "damper"}),
        ({"reactions": ("arm",)}, {"hinge", "ball", "slide", "tree", "spring", "damper", "reaction"}),
    ],
)  # fmt: skip
def test_features_are_what_the_bodies_have(changes, features):
    assert scene(**changes).features == features


def test_what_no_scene_names_is_left_out():
    left_out = scene().left_out
    assert "gravity" in left_out
    assert "contact solver" in left_out
    assert "hinges" not in left_out


def test_samples_are_even_and_include_both_ends():
    assert scene().sample_times() == pytest.approx(np.arange(11) / 10, rel=1e-15)


@pytest.mark.parametrize(
    ("dt", "steps", "whole"),
    [(0.1, 1, 0.1), (0.05, 2, 0.05), (0.03, 3, 0.1 / 3), (0.04, 2, 0.05), (1.0, 1, 0.1), (1e-3, 100, 1e-3)],
)
def test_a_step_is_rounded_to_whole_steps_between_samples(dt, steps, whole):
    assert scene().steps_per_sample(dt) == steps
    assert scene().whole_step(dt) == whole


def test_a_step_that_fits_but_for_rounding_stays_as_it_was_asked_for():
    made = scene(duration=0.6, samples=6)
    assert made.duration / made.samples / 5 != 0.02
    assert made.whole_step(0.02) == 0.02


@pytest.mark.parametrize("dt", [0.02, 0.04, 0.02 + 1e-4, 0.02 - 1e-4])
def test_no_step_nor_half_of_one_may_come_to_a_singular_time(dt):
    made = scene(singular_times=(0.9, 0.1))
    assert f"a step of {dt:g} s comes to 0." in made.unfit(dt)
    assert scene().unfit(dt) == ""


@pytest.mark.parametrize(
    ("dt", "says"), [(1.1, "longer than the whole run, 1 s"), (1e-10, "1e+10 of them, at most 2147483647")]
)
def test_a_step_must_be_shorter_than_the_run_and_not_of_too_many(dt, says):
    assert says in scene().unfit(dt)
    assert scene().unfit(1.0) == scene().unfit(1e-9) == ""


def test_steps_that_keep_away_from_singular_times_are_fit():
    assert scene(singular_times=(0.11,)).unfit(0.03) == ""


def test_what_is_recorded_of_schemes_holds_at_each_scenes_own_step():
    for one in scenes().values():
        coarsest = [max(ladder) for key, ladder in one.ladders.items() if isinstance(key, int)]
        assert one.whole_step(one.dt) <= min(coarsest, default=one.dt) * (1 + 1e-9), one.full_name


def test_every_step_of_a_ladder_is_fit():
    for one in scenes().values():
        steps = {one.dt, *(dt for ladder in one.ladders.values() for dt in ladder)}
        assert [one.unfit(one.whole_step(dt)) for dt in steps] == [""] * len(steps), one.full_name


# No deadline: how long an example takes says nothing of it.
@settings(deadline=None)
@given(st.floats(1e-7, 1.0))
def test_a_rounded_step_divides_a_sample_and_stays(dt):
    made = scene()
    whole, steps = made.whole_step(dt), made.steps_per_sample(dt)
    assert steps * whole == pytest.approx(0.1, rel=1e-11)
    assert (made.whole_step(whole), made.steps_per_sample(whole)) == (whole, steps)
    # No other whole number of steps is nearer.
    assert abs(0.1 / dt - steps) <= 0.5 + 1e-9 or steps == 1


@pytest.mark.parametrize("dt", [0.0, -1.0, float("nan"), float("inf")])
def test_a_step_must_be_a_positive_number(dt):
    with pytest.raises(InputError, match="dt: got"):
        scene().steps_per_sample(dt)


def test_a_step_longer_than_the_run_is_refused():
    with pytest.raises(
        InputError, match=re.escape("dt: got 1.5 s, expected at most 1 s, the whole run of reach")
    ):
        scene().steps_per_sample(1.5)


@pytest.mark.parametrize(
    ("order", "twin", "expected"),
    [
        (1, "", (0.1, 0.05)), (2, "", (0.1, 0.05)), (3, "", (0.02, 0.01)), (4, "RKMK4", (0.02, 0.01)),
        (5, "", (0.02, 0.01)), (1, "discrete", (0.01, 0.005)),
    ],
)  # fmt: skip
def test_a_scheme_is_measured_on_its_own_ladder_or_the_nearest_orders(order, twin, expected):
    ladders = {1: (0.1, 0.05), 4: (0.02, 0.01), "discrete": (0.01, 0.005)}
    assert scene(ladders=ladders).ladder(order, twin) == expected


def test_without_ladders_there_is_the_scenes_own_step():
    assert scene(dt=0.02).ladder(4) == (0.02,)
    assert scene(dt=0.02, ladders={"discrete": (0.1,)}).ladder(1, "RKMK4") == (0.02,)


def test_a_constant_belongs_to_its_observable_and_scheme():
    made = scene(errors={"RKMK4": (3.0, 7.0)})
    assert [made.error_constant("RKMK4", observable) for observable in STATE] == [3.0, 7.0]
    assert made.error_constant("semi-implicit Euler", STATE[0]) is None


def test_as_json_says_everything_that_changes_the_motion():
    plain = scene().as_json()
    assert scene().as_json() == plain
    heavier = (replace(scene().bodies[0], mass=1.0 + 1e-15), *scene().bodies[1:])
    stiffer = (replace(scene().bodies[0], joints=(replace(HINGE, stiffness=3.0),)), *scene().bodies[1:])
    changes = [
        {"bodies": heavier}, {"bodies": stiffer}, {"gravity": (0.0, 0.0, -1e-9)}, {"samples": 20},
        {"duration": 2.0}, {"v0": (1.0, 2.0, 3.0, 4.0, 5.0 + 1e-15)}, {"variant": "far"},
    ]  # fmt: skip
    for change in changes:
        assert scene(**change).as_json() != plain, change
    assert json.loads(plain)["observables"] == ["position", "velocity"]


def test_names_select_scenes_and_variants():
    assert [found.full_name for found in select(["heavy_top"])] == [
        "heavy_top[moderate]", "heavy_top[fast]", "heavy_top[cusps]",
    ]  # fmt: skip
    twice = [found.full_name for found in select(["heavy_top[cusps]", "heavy_top"])]
    assert twice == ["heavy_top[cusps]", "heavy_top[moderate]", "heavy_top[fast]"]
    assert select([]) == list(scenes().values())


@pytest.mark.parametrize(
    ("name", "suggests"),
    [
        ("heavy_tap", "'heavy_top'"),
        ("heavy_top[slow]", "heavy_top["),
        ("co2_chain[mixtures]", "co2_chain[mixture]"),
    ],
)
def test_an_unknown_name_is_answered_with_the_nearest(name, suggests):
    with pytest.raises(InputError, match=re.escape(suggests)) as caught:
        select([name])
    assert repr(name) in str(caught.value)


def test_every_file_of_scenes_is_found_and_none_twice():
    named = {found.name for found in scenes().values()}
    assert {"free_symmetric_top", "heavy_top", "co2_chain"} <= named
    assert all(full == found.full_name for full, found in scenes().items())


def test_two_files_may_not_define_the_same_scene(monkeypatch):
    monkeypatch.setattr(heavy_top, "SCENES", (*heavy_top.SCENES, heavy_top.SCENES[0]))
    with pytest.raises(
        InputError, match=re.escape("scene heavy_top[moderate]: two files of scenarios/ define it")
    ):
        registry.scenes.__wrapped__()
