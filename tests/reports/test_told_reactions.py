"""What is said of reactions told wrongly: nothing of right ones, and never more than is known."""

from dataclasses import replace

import numpy as np
import pytest
from poinsot.reports import told_reactions
from poinsot.reports.cell import Cell
from poinsot.scenarios.registry import scenes
from poinsot.scenarios.trajectory import Provenance

STATIC, BALANCED = (scenes()[f"rotor_balance[{variant}]"] for variant in ("static", "balanced"))


def cell(scene, change=lambda told: told):
    """The exact motion as a run, its reactions (n, 1, 6) changed."""
    run = Provenance(scene.full_name, "engine", "1", "Euler", 1, "semi-implicit Euler", 1e-3, 1280)
    motion = scene.truth(scene, scene.sample_times())
    return Cell.of(replace(motion, reaction=change(motion.reaction), provenance=run), dict(scenes()))


@pytest.mark.parametrize("scene", [STATIC, BALANCED], ids=["static", "balanced"])
def test_nothing_is_said_of_right_ones(scene):
    assert told_reactions.cause(cell(scene)) == ""
    shaken = 1e-13 * np.random.default_rng(2).normal(size=(81, 1, 6))
    assert told_reactions.cause(cell(scene, lambda told: told + shaken)) == ""


def test_nothing_is_said_where_none_were_asked_for():
    scene = scenes()["large_pendulum[swing]"]
    assert told_reactions.cause(cell(scene, lambda told: told)) == ""


def test_what_no_sentence_explains_is_wrong_all_the_same():
    found = told_reactions.cause(cell(STATIC, lambda told: told * 1.01))
    assert found == "the motion is right, and reactions alone are wrong"


def test_a_balanced_rotor_tells_nothing_of_axes_and_points():
    # Zero is zero in any axes; only what is added shows.
    assert told_reactions.cause(cell(BALANCED, lambda told: -told)) == ""
    assert told_reactions.cause(cell(BALANCED, lambda told: told + 1.0)) != ""
