"""What other programs find in a log: seen through mcap's and protobuf's own eyes, not through ours."""

import io
import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from google.protobuf import descriptor_pb2, descriptor_pool, message_factory
from hypothesis import given, settings
from hypothesis import strategies as st
from mcap.data_stream import ReadDataStream
from mcap.opcode import Opcode
from mcap.reader import NonSeekingReader, make_reader
from mcap.records import Chunk, ChunkIndex, Message, MessageIndex, Statistics, SummaryOffset
from mcap.stream_reader import StreamReader, get_chunk_data_stream
from poinsot.adapters import log, log_rows, log_schema, log_views

FIELDS = ("position", "quaternion", "velocity", "omega", "joint_position", "joint_velocity")


@pytest.fixture
def logged(tmp_path, make_cell):
    """A cell of many chunks, and the path of its log."""
    scene, motion = make_cell(2, 2, 4000)
    log.write(tmp_path / "a.mcap", scene, motion, {"model.xml": "<mujoco/>"})
    return scene, motion, tmp_path / "a.mcap"


def _messages(path, topic):
    with path.open("rb") as stream:
        return list(make_reader(stream, validate_crcs=True).iter_messages(topics=topic))


def _decoder(schema):
    """A message class from nothing but what the log says of itself."""
    pool = descriptor_pool.DescriptorPool()
    for file in descriptor_pb2.FileDescriptorSet.FromString(schema.data).file:
        pool.Add(file)
    return message_factory.GetMessageClass(pool.FindMessageTypeByName(schema.name))


@pytest.mark.parametrize(("bodies", "hinges"), [(1, 0), (1, 1), (2, 3), (40, 1)])
def test_messages_are_the_bytes_protobuf_itself_writes(tmp_path, make_cell, bodies, hinges):
    scene, motion = make_cell(bodies, hinges, 15)
    log.write(tmp_path / "a.mcap", scene, motion, {})
    found = _messages(tmp_path / "a.mcap", "/state")
    assert len(found) == 15
    for place, (_, _, message) in enumerate(found):
        values = {name: getattr(motion, name)[place].ravel().tolist() for name in FIELDS}
        assert message.data == log_schema.State(t=motion.t[place], **values).SerializeToString()
        assert message.sequence == place


def test_reactions_are_a_field_of_the_message_only_where_there_are_some(tmp_path, make_cell):
    scene, motion = make_cell(2, 1, 15)
    told = np.random.default_rng(3).normal(size=(15, 1, 6))
    log.write(tmp_path / "a.mcap", replace(scene, reactions=("body 1",)), replace(motion, reaction=told), {})
    for place, (schema, channel, message) in enumerate(_messages(tmp_path / "a.mcap", "/state")):
        assert _decoder(schema).FromString(message.data).reaction == told[place].ravel().tolist()
        assert channel.metadata["reactions"] == '["body 1"]'
    log.write(tmp_path / "b.mcap", scene, motion, {})
    [(schema, channel, message), *_] = _messages(tmp_path / "b.mcap", "/state")
    assert len(_decoder(schema).FromString(message.data).reaction) == 0
    assert not {"reactions", "reaction"} & channel.metadata.keys()


def test_a_log_describes_its_own_messages(logged):
    _, motion, path = logged
    found = _messages(path, "/state")
    schema, channel, _ = found[0]
    state = _decoder(schema)
    assert (schema.name, schema.encoding, channel.message_encoding) == (
        "poinsot.State",
        "protobuf",
        "protobuf",
    )
    assert channel.metadata["bodies"] == '["body 0", "body 1"]'
    for place, (_, _, message) in enumerate(found):
        decoded = state.FromString(message.data)
        assert decoded.HasField("t")
        assert decoded.t == motion.t[place]
        for name in FIELDS:
            expected = getattr(motion, name)[place].ravel()
            assert np.array(getattr(decoded, name)).tobytes() == expected.tobytes()


def test_chunks_are_compressed_and_of_the_promised_size(logged):
    path = logged[2]
    with path.open("rb") as stream:
        chunks = [r for r in StreamReader(stream, emit_chunks=True).records if isinstance(r, Chunk)]
    assert {chunk.compression for chunk in chunks} == {"zstd"}
    assert all(chunk.uncompressed_crc for chunk in chunks)
    sizes = [chunk.uncompressed_size for chunk in chunks]
    assert len(sizes) > 10
    assert max(sizes) <= 128 * 1024
    # The last chunk of each of the three channels holds what is left.
    assert sum(size < 64 * 1024 for size in sizes) <= 3


def test_every_index_entry_leads_to_its_message(logged):
    with logged[2].open("rb") as stream:
        records = list(StreamReader(stream, emit_chunks=True, validate_crcs=True).records)
    entries = 0
    for chunk, index in pairwise(records):
        if not isinstance(chunk, Chunk):
            continue
        assert isinstance(index, MessageIndex)
        data, length = get_chunk_data_stream(chunk, validate_crc=True)
        held = data.read(length)
        times = [time for time, _ in index.records]
        assert (chunk.message_start_time, chunk.message_end_time) == (times[0], times[-1])
        for time, offset in index.records:
            size = int.from_bytes(held[offset + 1 : offset + 9], "little")
            message = Message.read(ReadDataStream(io.BytesIO(held[offset + 9 :])), size)
            assert (message.channel_id, message.log_time) == (index.channel_id, time)
            entries += 1
    [statistics] = [record for record in records if isinstance(record, Statistics)]
    assert statistics.message_count == entries == sum(statistics.channel_message_counts.values())


def test_the_summary_points_at_what_it_names(logged):
    data = logged[2].read_bytes()
    with logged[2].open("rb") as stream:
        records = list(StreamReader(stream, emit_chunks=True).records)
    for index in (record for record in records if isinstance(record, ChunkIndex)):
        [(channel, offset)] = index.message_index_offsets.items()
        assert offset == index.chunk_start_offset + index.chunk_length
        assert (data[offset], data[offset + 9 : offset + 11]) == (Opcode.MESSAGE_INDEX, bytes([channel, 0]))
        assert index.message_index_length == 9 + int.from_bytes(data[offset + 1 : offset + 9], "little")
    groups = [record for record in records if isinstance(record, SummaryOffset)]
    assert len(groups) == 6
    for group, following in pairwise(groups):
        assert data[group.group_start] == group.group_opcode
        assert group.group_start + group.group_length == following.group_start


def test_a_reader_that_cannot_seek_finds_the_same(logged):
    _, motion, path = logged
    with path.open("rb") as stream:
        found = list(NonSeekingReader(stream, validate_crcs=True).iter_messages(log_time_order=False))
    assert sum(channel.topic == "/state" for _, channel, _ in found) == len(motion.t)


def test_metadata_and_attachments_are_there_for_others(logged):
    with logged[2].open("rb") as stream:
        reader = make_reader(stream)
        metadata = {record.name: record.metadata for record in reader.iter_metadata()}
        attachments = {record.name: record.media_type for record in reader.iter_attachments()}
        statistics = reader.get_summary().statistics
    assert set(metadata) == {"run", "setup", "settings", "environment"}
    assert metadata["run"]["engine"] == "engine"
    assert metadata["run"]["dt"] == "0.001"
    assert attachments == {"scene.json": "application/json", "model.xml": "application/xml"}
    assert (statistics.metadata_count, statistics.attachment_count) == (4, 2)


# No deadline: how long an example takes says nothing of it.
@settings(deadline=None, max_examples=60)
@given(st.floats(1e-13, 1e4), st.integers(1, 1000), st.integers(1, 200))
def test_log_time_counts_steps_and_always_increases(dt, stride, samples):
    steps = np.arange(samples) * stride
    times = log_rows.log_times(steps * dt, dt)
    assert np.all(np.diff(times) > 0)
    if stride * dt > 2e-9:  # further apart than two roundings
        assert times.tolist() == [round(k * dt * 1e9) for k in steps.tolist()]
    else:
        assert times[-1] <= max(samples, math.ceil(steps[-1] * dt * 1e9) + samples)


# Made once by Foxglove's own classes (foxglove-schemas-protobuf 0.4.0): a first opinion on the numbers.
FRAME = (
    "0a0808011080cab5ee011205776f726c641a03746f70221b09000000000000f03f1100000000000000401900000000000008c0"
    "2a2409000000000000e03f11000000000000e0bf19000000000000d03f21000000000000f03f"
)
UPDATE = (
    "12610a0808011080cab5ee011203746f701a03746f70280142490a160a0909000000000000f03f120921000000000000f03f"
    "121b09000000000000f03f1100000000000000401900000000000010401a1209000000000000e03f21000000000000f03f"
)
SHAPES = (
    "12a7031201611a0162320c0a046d617373120432206b674a5b0a280a1209000000000000f03f1100000000000000c0121219"
    "000000000000e03f21000000000000f0bf121b09000000000000f03f1100000000000000401900000000000008401a120900"
    "0000000000e03f21000000000000f03f526d0a280a1209000000000000f03f1100000000000000c0121219000000000000e0"
    "3f21000000000000f0bf121b09000000000000f03f11000000000000f03f19000000000000084019000000000000f03f2100"
    "0000000000e03f2a1209000000000000e03f21000000000000f03f5a5f12280a1209000000000000f03f1100000000000000"
    "c0121219000000000000e03f21000000000000f0bf19000000000000004020012a002a1209000000000000f03f1900000000"
    "00001040321209000000000000e03f21000000000000f03f62640a280a1209000000000000f03f1100000000000000c01212"
    "19000000000000e03f21000000000000f0bf1200120909000000000000f03f120911000000000000f03f1a12090000000000"
    "00e03f21000000000000f03f2a0c000000000100000002000000"
)
NOW = {"seconds": 1, "nanos": 500_000_000}


def test_viewers_messages_are_those_of_foxglove():
    frame = log_schema.FrameTransform(
        timestamp=NOW, parent_frame_id="world", child_frame_id="top",
        translation={"x": 1, "y": 2, "z": -3}, rotation={"x": 0.5, "y": -0.5, "z": 0.25, "w": 1},
    )  # fmt: skip
    assert frame.SerializeToString().hex() == FRAME
    cube = {
        "pose": {"position": {"x": 1}, "orientation": {"w": 1}},
        "size": {"x": 1, "y": 2, "z": 4},
        "color": {"r": 0.5, "a": 1},
    }
    entity = {"timestamp": NOW, "frame_id": "top", "id": "top", "frame_locked": True, "cubes": [cube]}
    assert log_schema.SceneUpdate(entities=[entity]).SerializeToString().hex() == UPDATE


def test_every_shape_that_is_drawn_is_one_of_foxgloves():
    look = {
        "pose": {"position": {"x": 1, "y": -2}, "orientation": {"z": 0.5, "w": -1}},
        "color": {"r": 0.5, "a": 1},
    }
    entity = {
        "frame_id": "a",
        "id": "b",
        "metadata": [{"key": "mass", "value": "2 kg"}],
        "spheres": [look | {"size": {"x": 1, "y": 2, "z": 3}}],
        "cylinders": [look | {"size": {"x": 1, "y": 1, "z": 3}, "bottom_scale": 1, "top_scale": 0.5}],
        "lines": [look | {"thickness": 2, "scale_invariant": True, "points": [{}, {"x": 1, "z": 4}]}],
        "triangles": [look | {"points": [{}, {"x": 1}, {"y": 1}], "indices": [0, 1, 2]}],
    }
    assert log_schema.SceneUpdate(entities=[entity]).SerializeToString().hex() == SHAPES


def test_viewers_see_each_body_where_it_is(logged):
    scene, motion, path = logged
    found = _messages(path, "/tf")
    frame, shown = _decoder(found[0][0]), log_views.frames(motion.t, 2)
    assert [message.log_time for *_, message in found[::2]] == log_rows.log_times(motion.t, 1e-3)[
        shown
    ].tolist()
    decoded = [frame.FromString(message.data) for *_, message in found]
    for k, body in enumerate(scene.bodies):
        for place, one in enumerate(decoded[k::2]):
            at = place * shown.step
            assert (one.parent_frame_id, one.child_frame_id) == ("world", body.name)
            assert one.timestamp.ToNanoseconds() == found[2 * place][2].log_time
            np.testing.assert_equal([one.translation.x, one.translation.y, one.translation.z],
                                    motion.position[at, k])  # fmt: skip
            np.testing.assert_equal([one.rotation.x, one.rotation.y, one.rotation.z, one.rotation.w],
                                    motion.quaternion[at, k])  # fmt: skip


@pytest.mark.parametrize(
    ("samples", "end", "bodies", "least", "most"),
    [(1, 0.0, 1, 1, 1), (2, 1e-9, 1, 1, 2), (2001, 2.0, 1, 95, 101), (100_001, 100.0, 1, 290, 301),
     (10_001, 10.0, 64, 40, 48), (11, 10.0, 3, 11, 11), (3, 1.0, 5000, 1, 2)],
)  # fmt: skip
def test_viewers_get_a_bounded_number_of_frames(samples, end, bodies, least, most):
    t = np.linspace(0, end, samples)
    assert least <= len(t[log_views.frames(t, bodies)]) <= most
