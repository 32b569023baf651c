"""What a sample costs to log and to read back: ``python benchmarks/log_speed.py [repeats]``.

10 000 samples of 21 numbers and their time: one body (position, quaternion, velocity, angular velocity)
and four hinges. Poinsot's figures are of the whole of ``write`` and ``read``: views, attachments,
checksums, compression. Beside them, in the same run, one message at a time through the mcap
and protobuf libraries, without views and attachments: with protobuf's objects, and with the bytes
ready made, which leaves mcap's own cost.
"""

import gc
import io
import statistics
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from mcap.reader import make_reader
from mcap.writer import Writer
from poinsot.adapters import log, log_rows
from poinsot.adapters.log_container import CHUNK
from poinsot.adapters.log_schema import State, descriptor_set
from poinsot.scenarios.body import Body, Joint, diagonal
from poinsot.scenarios.scene import Scene
from poinsot.scenarios.trajectory import Provenance, Trajectory

SAMPLES, HINGES, DT = 10_000, 4, 1e-3
FIELDS = ("position", "quaternion", "velocity", "omega", "joint_position", "joint_velocity")
OBJECTS = {"write": "write: mcap.Writer, objects", "read:": "read:  mcap reader, objects"}
WRITE_LIMIT, READ_LIMIT = 5.0, 3.5


def cell() -> tuple[Scene, Trajectory]:
    """A smooth motion with full mantissas, as an engine gives it."""
    joints = tuple(Joint(f"hinge {k}", "hinge") for k in range(HINGES))
    body = Body("body", 1.0, diagonal(0.01, 0.01, 0.015), joints)
    scene = Scene(
        name="speed", summary="", source="", bodies=(body,), q0=(0.0,) * HINGES, v0=(0.0,) * HINGES,
        duration=(SAMPLES - 1) * DT, samples=SAMPLES - 1, truth=lambda scene, t: motion, observables=(),
    )  # fmt: skip
    t = np.arange(SAMPLES) * DT
    rates, phases = np.random.default_rng(0).uniform(0.5, 5.0, size=(2, 21))
    waves = np.sin(np.outer(t, rates) + phases)
    parts = np.split(waves, np.cumsum([3, 4, 3, 3, HINGES]), axis=1)
    arrays = [part[:, None] for part in parts[:4]] + parts[4:]
    run = Provenance("speed", "none", "0", "none", 1, "none", DT, SAMPLES - 1)
    motion = Trajectory(t, *arrays, provenance=run)
    return scene, motion


def add_messages(payloads: Callable[[], list[bytes]], times: list[int]) -> bytes:
    """An MCAP file by mcap's Writer, one call a message."""
    stream = io.BytesIO()
    writer = Writer(stream, chunk_size=CHUNK, enable_data_crcs=True)
    writer.start()
    schema = writer.register_schema("poinsot.State", "protobuf", descriptor_set(State))
    channel = writer.register_channel("/state", "protobuf", schema)
    for place, (at, data) in enumerate(zip(times, payloads(), strict=True)):
        writer.add_message(channel, at, data, at, place)
    writer.finish()
    return stream.getvalue()


def objects(motion: Trajectory) -> list[bytes]:
    """Each sample as protobuf's own object, encoded."""
    columns = [getattr(motion, name).reshape(SAMPLES, -1).tolist() for name in FIELDS]
    return [
        State(t=t, **dict(zip(FIELDS, row, strict=True))).SerializeToString()
        for t, *row in zip(motion.t.tolist(), *columns, strict=True)
    ]


def read_objects(data: bytes) -> np.ndarray:
    """Each message decoded by protobuf, gathered into one array."""
    messages = make_reader(io.BytesIO(data), validate_crcs=True).iter_messages(topics="/state")
    states = (State.FromString(message.data) for _, _, message in messages)
    return np.array([(s.t, *s.position, *s.quaternion, *s.velocity, *s.omega, *s.joint_position,
                      *s.joint_velocity) for s in states])  # fmt: skip


def timed(actions: dict[str, Callable[[], object]], repeats: int) -> dict[str, list[float]]:
    """Microseconds a sample of each run, after one that does not count.

    The actions take turns, so that what else the machine does falls on all of them alike.
    """
    marks: dict[str, list[float]] = {name: [] for name in actions}
    for repeat in range(repeats + 1):
        for name, action in actions.items():
            gc.collect()
            gc.disable()
            start = time.perf_counter()
            action()
            spent = time.perf_counter() - start
            gc.enable()
            if repeat:
                marks[name].append(spent / SAMPLES * 1e6)
    return marks


def table(marks: dict[str, list[float]]) -> list[str]:
    """Minimum, median and maximum of each, and the minimum over that of protobuf's objects."""
    lines = [f"{'':34}{'min':>8}{'median':>8}{'max':>8}{'/ objects':>11}"]
    for name, spent in marks.items():
        figures = "".join(f"{f:8.2f}" for f in (min(spent), statistics.median(spent), max(spent)))
        lines.append(f"{name:34}{figures}{min(spent) / min(marks[OBJECTS[name[:5]]]):11.3f}")
    return lines


def main(repeats: int) -> None:
    """Measure and print."""
    scene, motion = cell()
    times = log_rows.log_times(motion.t, DT).tolist()
    ready = objects(motion)
    by_library = add_messages(lambda: ready, times)
    with tempfile.TemporaryDirectory(dir=".") as folder:
        path = Path(folder) / "speed.mcap"
        marks = timed(
            {
                "write: Poinsot": lambda: log.write(path, scene, motion, {}),
                "write: mcap.Writer, bytes ready": lambda: add_messages(lambda: ready, times),
                "write: mcap.Writer, objects": lambda: add_messages(lambda: objects(motion), times),
                "read:  Poinsot": lambda: log.read(path),
                "read:  mcap reader, objects": lambda: read_objects(by_library),
            },
            repeats,
        )
        size = path.stat().st_size / SAMPLES
    lines = [f"{SAMPLES} samples of 21 float64 and t, {repeats} repeats, microseconds a sample", ""]
    lines += [*table(marks), "", f"asked for: write <= {WRITE_LIMIT:g}, read <= {READ_LIMIT:g}; "]
    sys.stdout.write("\n".join(lines) + f"the file has {size:.0f} bytes a sample\n")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 20)
