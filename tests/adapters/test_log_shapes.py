"""What a viewer is given to draw: in every scene something to be seen of every body, as its numbers say."""

from dataclasses import replace

import numpy as np
import pytest
from google.protobuf import descriptor_pb2, descriptor_pool, message_factory
from mcap.reader import make_reader
from poinsot.adapters import log, log_shapes, log_views
from poinsot.adapters.log_schema import SceneUpdate
from poinsot.reference.quaternions import matrix
from poinsot.scenarios.body import Body, Joint, diagonal
from poinsot.scenarios.registry import scenes
from poinsot.scenarios.trajectory import Provenance

NAMES = {scene.name: scene.full_name for scene in reversed(scenes().values())}
FEW = [*NAMES.values(), *(name for name in scenes() if name.startswith("inertia_of_shapes"))]
SIZED = ("spheres", "cubes", "cylinders")


def moved(scene):
    """The exact motion at few times."""
    return scene.truth(scene, np.linspace(0.0, scene.duration, 11))


def drawn(scene, motion=None):
    return SceneUpdate.FromString(log_views.update(scene, motion or moved(scene), 0)).entities


def vector(message):
    return np.array([message.x, message.y, message.z])


def turn(message):
    return matrix(np.array([message.x, message.y, message.z, message.w]))


@pytest.mark.parametrize("name", FEW)
def test_of_every_body_there_is_something_to_be_seen(name):
    scene = scenes()[name]
    motion = moved(scene)
    spans = log_shapes.span(motion.position)
    entities = drawn(scene, motion)
    bodies = [entity for entity in entities if entity.id != "world"]
    assert [entity.frame_id for entity in bodies] == [body.name for body in scene.bodies]
    for entity in entities:
        parts = [part for field in (*SIZED, "triangles") for part in getattr(entity, field)]
        assert parts
        for part in [*parts, *entity.lines]:
            q = part.pose.orientation
            assert np.linalg.norm([q.x, q.y, q.z, q.w]) == pytest.approx(1.0)
            assert np.all(np.isfinite(vector(part.pose.position)))
            assert part.color.a > 0
        for part in (part for field in SIZED for part in getattr(entity, field)):
            size = vector(part.size)
            assert np.all(size >= log_shapes.SEEN * size.max() * (1 - 1e-12))
            assert 1e-3 * spans < size.max()
            if len(scene.bodies) > 1:
                assert size.max() < 10 * spans


def test_no_log_grows_by_more_than_little():
    largest = max(len(log_views.update(scene, moved(scene), 0)) / len(scene.bodies) for scene in map(
        scenes().get, FEW))  # fmt: skip
    assert largest < 1500  # bytes a body, before compression


def test_bodies_of_their_own_do_not_overlap():
    for name in ("two_body[spring]", "tides", "compound_pendulum[small]", "co2_chain[mixture]"):
        scene = scenes()[name]
        motion = moved(scene)
        sizes = [
            max(vector(part.size).max() for field in SIZED for part in getattr(entity, field))
            for entity in drawn(scene, motion)
        ]
        for i, size in enumerate(sizes):
            away = np.linalg.norm(motion.position[0] - motion.position[0, i], axis=1)
            assert size <= 0.6 * away[away > 0].min() * (1 + 1e-12)


def one(inertia, mass=2.0):
    """A free body by itself, as it is drawn: its one part and which it is."""
    top = scenes()["free_symmetric_top[oblate]"]
    body = Body("alone", mass, inertia, (Joint("free", "free"),))
    [entity] = drawn(replace(top, bodies=(body,)))
    [(field, part)] = [(field, part) for field in SIZED for part in getattr(entity, field)]
    return field, part, {pair.key: pair.value for pair in entity.metadata}


def of_size(field, size, mass):
    """Moments of a uniform solid about its own axes."""
    squares = size**2
    pairs = squares.sum() - squares
    if field == "cubes":
        return mass * pairs / 12
    if field == "spheres":
        return mass * pairs / 20
    across = mass * (size[0] ** 2 / 16 + size[2] ** 2 / 12)
    return np.array([across, across, mass * size[0] ** 2 / 8])


@pytest.mark.parametrize(
    ("inertia", "field"),
    [
        (diagonal(0.3, 0.3, 0.3), "spheres"),
        (diagonal(0.3, 0.3, 0.2), "cylinders"),
        (diagonal(0.3, 0.2, 0.2), "cylinders"),
        (diagonal(0.2, 0.3, 0.2), "cylinders"),
        (diagonal(0.3, 0.35, 0.2), "cubes"),
        (((0.3, 0.04, 0.0), (0.04, 0.2, 0.01), (0.0, 0.01, 0.4)), "cubes"),
    ],
)
def test_what_is_drawn_has_the_bodys_mass_and_inertia(inertia, field):
    found, part, told = one(inertia)
    assert found == field
    axes = turn(part.pose.orientation)
    tensor = axes @ np.diag(of_size(field, vector(part.size), 2.0)) @ axes.T
    np.testing.assert_allclose(tensor, np.array(inertia), atol=1e-15)
    assert told == {"mass": "2 kg", "drawn as": f"a {field_word(field)} of its inertia"}


def field_word(field):
    return {"spheres": "ball", "cylinders": "cylinder", "cubes": "brick"}[field]


def test_a_plate_can_be_seen():
    _, part, _ = one(diagonal(0.01, 0.02, 0.03))
    size = vector(part.size)
    assert size.min() == pytest.approx(0.02 * size.max())


def test_solids_are_drawn_where_they_are():
    [first, *_] = drawn(scenes()["inertia_of_shapes[molecule]"])
    body = scenes()["inertia_of_shapes[molecule]"].bodies[0]
    for part, solid in zip(first.spheres, body.solids, strict=True):
        at = np.array(solid.position) - body.center_of_mass
        np.testing.assert_allclose(vector(part.pose.position), at, atol=1e-16)
        np.testing.assert_allclose(vector(part.size), 2 * solid.sizes[0])
    [cone, *_] = drawn(scenes()["inertia_of_shapes[cone]"])
    solid = scenes()["inertia_of_shapes[cone]"].bodies[0].solids[0]
    [mesh] = cone.triangles
    np.testing.assert_array_equal([vector(point) for point in mesh.points], solid.vertices)
    np.testing.assert_array_equal(mesh.indices, np.ravel(solid.faces))
    [capsule, *_] = drawn(scenes()["inertia_of_shapes[capsule]"])
    assert [len(getattr(capsule, field)) for field in SIZED] == [2, 0, 1]
    ends = [part.pose.position.z for part in capsule.spheres]
    assert sorted(ends) == pytest.approx([-0.15, 0.15])


@pytest.mark.parametrize("name", ["rolling[hoop]", "rolling[sphere]", "rolling_disc[stable]"])
def test_what_rolls_is_as_wide_as_what_touches_and_the_ground_is_under_it(name):
    scene = scenes()[name]
    motion = moved(scene)
    [wheel, world] = drawn(scene, motion)
    [part] = [part for field in SIZED for part in getattr(wheel, field)]
    radius = scene.contacts[0].shape.radius
    assert part.size.x == pytest.approx(2 * radius)
    assert part.size.z < part.size.x or name == "rolling[sphere]"
    [ground] = world.cubes
    normal = turn(ground.pose.orientation)[:, 2]
    np.testing.assert_allclose(normal, scene.contacts[0].against.normal, atol=1e-15)
    top = vector(ground.pose.position) + normal * ground.size.z / 2
    assert normal @ top == pytest.approx(scene.contacts[0].against.offset, abs=1e-15)
    assert np.abs(motion.position[:, 0] - top).max() < ground.size.x / 2 + 2 * radius


def test_a_pendulum_hangs_on_a_line_to_what_holds_it():
    scene = scenes()["large_pendulum[swing]"]
    [entity] = drawn(scene)
    center = np.array(scene.bodies[0].center_of_mass)
    ends = [vector(line.points[1]) for line in entity.lines]
    assert any(np.allclose(end, -center) for end in ends)
    assert len(ends) == 4  # and three axes


def test_what_never_turns_is_a_bead_without_axes():
    for entity in drawn(scenes()["normal_modes[16_wall]"]):
        [bead] = entity.spheres
        assert not entity.lines
        assert bead.size.x < 0.1


def test_places_that_are_none_are_no_hindrance(make_cell):
    scene, motion = make_cell(3)
    assert not np.isfinite(motion.position).all()
    for entity in drawn(scene, motion):
        assert all(np.isfinite(vector(part.size)).all() for field in SIZED for part in getattr(entity, field))


@pytest.mark.parametrize("name", ["heavy_top[fast]", "rolling[hoop]", "inertia_of_shapes[cone]"])
def test_every_message_is_read_by_what_the_log_says_of_itself(tmp_path, name):
    scene = scenes()[name]
    t = scene.sample_times()
    run = Provenance(scene.full_name, "engine", "1.2", "Euler", 1, "SE", 1e-3, 1)
    log.write(tmp_path / "a.mcap", scene, replace(scene.truth(scene, t), provenance=run), {})
    classes, counts = {}, {}
    with (tmp_path / "a.mcap").open("rb") as stream:
        for schema, channel, message in make_reader(stream).iter_messages():
            if schema.name not in classes:
                pool = descriptor_pool.DescriptorPool()
                for file in descriptor_pb2.FileDescriptorSet.FromString(schema.data).file:
                    pool.Add(file)  # raises where a file that it needs has not come before
                found = pool.FindMessageTypeByName(schema.name)
                classes[schema.name] = message_factory.GetMessageClass(found)
            decoded = classes[schema.name].FromString(message.data)
            assert decoded.SerializeToString(deterministic=True) == message.data
            counts[channel.topic] = counts.get(channel.topic, 0) + 1
    assert counts["/scene"] == 1
    assert counts["/state"] == scene.samples + 1
    assert counts["/tf"] > 10 * len(scene.bodies)
