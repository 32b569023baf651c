"""What tests of several layers share: a scene as the reference's equations of motion take it."""

from collections.abc import Callable

import pytest
from poinsot.reference import equations_of_motion
from poinsot.scenarios.equations import links
from poinsot.scenarios.scene import Scene


@pytest.fixture
def links_of() -> Callable[[Scene], list[equations_of_motion.Link]]:
    """The bodies of a scene, for the reference equations of motion, which know no engine and no scene."""
    return links
