"""What tests of several layers share: a scene as the reference's equations of motion take it."""

from collections.abc import Callable

import pytest
from poinsot.reference import equations_of_motion
from poinsot.scenarios.scene import Scene


@pytest.fixture
def links_of() -> Callable[[Scene], list[equations_of_motion.Link]]:
    """The bodies of a scene, for the reference equations of motion, which know no engine and no scene."""

    def make(scene: Scene) -> list[equations_of_motion.Link]:
        names = [body.name for body in scene.bodies]
        return [
            equations_of_motion.Link(
                mass=body.mass,
                inertia=body.inertia_array,
                com=body.center_of_mass,
                parent=names.index(body.parent) if body.parent else -1,
                joints=tuple(
                    equations_of_motion.Joint(j.kind, j.axis, stiffness=j.stiffness, damping=j.damping)
                    for j in body.joints
                ),
                position=body.position,
                quaternion=body.quaternion,
            )
            for body in scene.bodies
        ]

    return make
