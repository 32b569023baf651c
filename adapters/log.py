"""The log: one cell's trajectory, and all that it takes to judge it, in one MCAP file.

Any MCAP tool reads it: ``/state`` holds every sample as a ``poinsot.State``, ``/tf`` and ``/scene``
what a viewer draws; the scene and the engine's model are attached; metadata says which cell it is.
"""

import io
import json
import os
import struct
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import IO

import numpy as np
from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.reader import McapReader, make_reader
from mcap.records import Channel, Chunk
from mcap.stream_reader import get_chunk_data_stream
from mcap.summary import Summary
from zstandard import ZstdError

from ..reference.errors import InputError
from ..scenarios.scene import Scene
from ..scenarios.trajectory import Provenance, Trajectory
from . import log_rows, log_views
from .log_container import Container
from .log_intact import CorruptLog, fault
from .log_provenance import Metadata, from_metadata, to_metadata
from .log_schema import FrameTransform, SceneUpdate, State, descriptor_set

__all__ = ["CorruptLog", "Logged", "read", "write"]

SCENE_FILE = "scene.json"
STATE = "poinsot.State"
_MEDIA_TYPES = {".json": "application/json", ".xml": "application/xml", ".urdf": "application/xml"}
#: For people and tools that look into ``/state``; each is row after row, body after body.
_UNITS = {
    "t": "s",
    "position": "m, centres of mass, world axes",
    "quaternion": "body to world, x y z w",
    "velocity": "m/s, centres of mass, world axes",
    "omega": "rad/s, body axes",
    "joint_position": "rad or m",
    "joint_velocity": "rad/s or m/s",
}

#: The same for what only some scenes have.
_REACTION = "N and N m, parent on body through its joints, about the origin of the body's frame, body axes"


@dataclass(frozen=True)
class Logged:
    """What a log holds: the trajectory with its provenance, the scene as JSON, the models by file name."""

    trajectory: Trajectory
    scene_json: str
    attachments: Mapping[str, str]


def write(path: Path, scene: Scene, trajectory: Trajectory, attachments: Mapping[str, str]) -> None:
    """Write one cell's log to ``path``; the same input gives the same bytes.

    ``attachments`` maps a file name to the text of a model that an engine was given. The file
    appears at ``path`` whole or not at all: until then it is a hidden ``.part`` file beside it.
    Raises ``InputError`` if ``trajectory`` is none of ``scene`` or has no provenance, if its times
    do not increase, if a value of the provenance cannot be kept, or if nothing can be written there.
    """
    provenance = _provenance(scene, trajectory)
    if SCENE_FILE in attachments:
        raise InputError(f"attachments: got {SCENE_FILE!r}, expected another name: the scene has that one")
    metadata = to_metadata(provenance)
    times = log_rows.log_times(trajectory.t, provenance.dt)
    with _whole_or_not_at_all(path) as stream:
        file = Container(stream)
        for name, texts in metadata.items():
            file.metadata(name, texts)
        for name, text in {SCENE_FILE: scene.as_json(), **attachments}.items():
            file.attachment(name, _MEDIA_TYPES.get(Path(name).suffix, "text/plain"), text.encode())
        _write_views(file, scene, trajectory, times)
        _write_states(file, scene, trajectory, times)
        file.finish()


def read(path: Path) -> Logged:
    """What was written to ``path``, every array bit for bit.

    Raises ``CorruptLog`` if the file is anything but a whole log, every checksum right;
    ``InputError`` if there is none or it cannot be opened.
    """
    try:
        data = path.read_bytes()
    except OSError as error:
        raise InputError(f"log {path}: cannot be read: {error.strerror}; expected an MCAP file") from error
    reason = fault(data, STATE)
    if reason:
        raise CorruptLog(path, reason)
    try:
        return _parse(data)
    # Whole, yet not what Poinsot writes: whatever the parts make of that is the reason.
    except (McapError, ZstdError, ArithmeticError, LookupError, TypeError, ValueError, struct.error) as error:
        reason = " ".join(f"{type(error).__name__}: {error}".split())
        raise CorruptLog(path, f"is not a log that this version of Poinsot reads ({reason})") from error


def _provenance(scene: Scene, trajectory: Trajectory) -> Provenance:
    provenance = trajectory.provenance
    if provenance is None:
        raise InputError(f"trajectory of {scene.full_name}: got no provenance, expected to know its run")
    found = trajectory.position, trajectory.joint_position, trajectory.reaction
    got = (provenance.scene, *(array.shape[1] for array in found))
    expected = (scene.full_name, len(scene.bodies), len(scene.scalar_joints), len(scene.reactions))
    if got != expected:
        words = "scene {}, {} bodies, {} scalar joints, {} reactions"
        raise InputError(f"trajectory: got {words.format(*got)}; expected {words.format(*expected)}")
    return provenance


@contextmanager
def _whole_or_not_at_all(path: Path) -> Iterator[IO[bytes]]:
    part = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        with part.open("wb") as stream:
            yield stream
        # Not forced onto the disk, which took as long as the log: what a power cut loses, checksums tell.
        part.replace(path)
    except OSError as error:
        raise InputError(f"log {path}: cannot be written: {error.strerror}") from error
    finally:
        part.unlink(missing_ok=True)


def _write_views(file: Container, scene: Scene, trajectory: Trajectory, times: log_rows.Times) -> None:
    shown = log_views.frames(trajectory.t, len(scene.bodies))
    few = replace(trajectory, **{name: getattr(trajectory, name)[shown] for name in (*_UNITS, "reaction")})
    file.messages(
        file.channel("/scene", "foxglove.SceneUpdate", descriptor_set(SceneUpdate), {}),
        [int(times[0])],
        [log_views.update(scene, trajectory, int(times[0]))],
    )
    file.messages(
        file.channel("/tf", "foxglove.FrameTransform", descriptor_set(FrameTransform), {}),
        np.repeat(times[shown], len(scene.bodies)).tolist(),
        log_views.transforms(scene, few, times[shown].tolist()),
    )


def _write_states(file: Container, scene: Scene, trajectory: Trajectory, times: log_rows.Times) -> None:
    names = {
        "bodies": json.dumps([body.name for body in scene.bodies]),
        "joints": json.dumps([joint.name for joint in scene.scalar_joints]),
    }
    if scene.reactions:
        names |= {"reactions": json.dumps(scene.reactions), "reaction": _REACTION}
    channel = file.channel("/state", STATE, descriptor_set(State), {**names, **_UNITS})
    file.rows(channel, times, log_rows.encode(trajectory, times, channel))


def _parse(data: bytes) -> Logged:
    reader = make_reader(io.BytesIO(data), validate_crcs=True)
    metadata: Metadata = {record.name: record.metadata for record in reader.iter_metadata()}
    attachments = {record.name: record.data.decode() for record in reader.iter_attachments()}
    trajectory = replace(_states(reader, data), provenance=from_metadata(metadata))
    return Logged(trajectory, attachments.pop(SCENE_FILE), attachments)


def _states(reader: McapReader, data: bytes) -> Trajectory:
    summary = reader.get_summary() or Summary()
    [schema] = [schema.id for schema in summary.schemas.values() if schema.name == STATE]
    [channel] = [channel for channel in summary.channels.values() if channel.schema_id == schema]
    records = b"".join(_chunks(summary, channel, data))
    bodies, joints = (len(json.loads(channel.metadata[name])) for name in ("bodies", "joints"))
    reactions = len(json.loads(channel.metadata.get("reactions", "[]")))
    return log_rows.decode(records, bodies, joints, channel.id, reactions)


def _chunks(summary: Summary, channel: Channel, data: bytes) -> Iterator[bytes]:
    """What the chunks with messages of ``channel`` hold, decompressed, each against its own checksum."""
    stream = io.BytesIO(data)
    for index in summary.chunk_indexes:
        if channel.id in index.message_index_offsets:
            stream.seek(index.chunk_start_offset + 9)
            records, length = get_chunk_data_stream(Chunk.read(ReadDataStream(stream)), validate_crc=True)
            yield records.read(length)
