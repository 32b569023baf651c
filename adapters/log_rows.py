"""A trajectory as message records of one fixed length, all written and read at once by numpy.

As every field of ``poinsot.State`` holds the same number of doubles in every sample, every tag and
length of its encoding sits at the same place: only the numbers differ. The bytes are those that the
protobuf library would write, one object at a time, and that any MCAP reader gives back.
"""

from typing import Any

import numpy as np
import numpy.typing as npt
from mcap.opcode import Opcode

from ..reference.checked import Array
from ..reference.errors import InputError
from ..scenarios.trajectory import Trajectory
from .log_schema import State

Rows = npt.NDArray[np.void]
Times = npt.NDArray[np.int64]

#: Head of a message record: opcode and length of what follows, then the fields of a Message.
_HEAD = [
    ("opcode", "u1"),
    ("length", "<u8"),
    ("channel", "<u2"),
    ("sequence", "<u4"),
    ("log_time", "<u8"),
    ("publish_time", "<u8"),
]
_WIDTHS = {"position": 3, "quaternion": 4, "velocity": 3, "omega": 3}
_JOINTS = ("joint_position", "joint_velocity")
#: Force and moment.
_REACTION = 6

#: Beyond this many seconds, 292 years, nanoseconds leave 64 bits.
LONGEST = 9.2e9


def encode(motion: Trajectory, times: Times, channel: int) -> Rows:
    """One message record for each sample (n,), ready to be put into chunks."""
    n, bodies = motion.position.shape[:2]
    joints, reactions = motion.joint_position.shape[1], motion.reaction.shape[1]
    rows = np.repeat(_empty_row(bodies, joints, channel, reactions), n)
    rows["sequence"] = np.arange(n)
    rows["log_time"] = rows["publish_time"] = times
    for name in _numbers(rows.dtype):
        rows[name] = getattr(motion, name).reshape(n, -1)
    return rows


def decode(data: bytes, bodies: int, joints: int, channel: int, reactions: int = 0) -> Trajectory:
    """The trajectory in the message records of ``data``, its arrays its own.

    Raises ``ValueError`` if ``data`` is anything but the records that ``encode`` makes, in order.
    """
    empty = _empty_row(bodies, joints, channel, reactions)
    if len(data) % empty.itemsize or not _as_written(rows := np.frombuffer(data, empty.dtype), empty):
        raise ValueError("its State messages are not laid out as Poinsot writes them")
    n = len(rows)
    arrays: dict[str, Any] = {
        name: rows[name].reshape(n, bodies, width).copy() for name, width in _WIDTHS.items()
    }
    for name in _JOINTS:
        arrays[name] = rows[name].copy() if joints else np.empty((n, 0))
    if reactions:
        arrays["reaction"] = rows["reaction"].reshape(n, reactions, _REACTION).copy()
    return Trajectory(rows["t"][:, 0].copy(), **arrays)


def log_times(t: Array, dt: float) -> Times:
    """Nanoseconds since the start (n,) of the samples at ``t`` [s], from their whole number of steps.

    Each is k·dt rounded to a nanosecond, or one more than the one before it where rounding would
    let the two coincide: time in a log always increases. Exact times are in the messages.
    Raises ``InputError`` if ``t`` does not increase from 0 or later, or goes beyond 64 bits.
    """
    if len(t) == 0 or not (t[0] >= 0 and np.all(np.diff(t) > 0) and t[-1] <= LONGEST):
        raise InputError(
            f"trajectory t: got {len(t)} times {np.array2string(t, threshold=4)} s, expected at least one, "
            f"increasing, from 0 to {LONGEST:g} s"
        )
    exact = np.rint(np.rint(t / dt) * dt * 1e9).astype(np.int64)
    place = np.arange(len(t))
    return np.maximum.accumulate(exact - place) + place


def _as_written(rows: Rows, empty: Rows) -> bool:
    free = {"sequence", "log_time", "publish_time", *_numbers(empty.dtype)}
    fixed = [name for name in empty.dtype.names or () if name not in free]
    in_order = np.array_equal(rows["sequence"], np.arange(len(rows)))
    return in_order and all(np.all(rows[name] == empty[name]) for name in fixed)


def _empty_row(bodies: int, joints: int, channel: int, reactions: int) -> Rows:
    sizes = {"t": 1, **{name: width * bodies for name, width in _WIDTHS.items()}}
    sizes |= {**dict.fromkeys(_JOINTS, joints), "reaction": _REACTION * reactions}
    tags = {name: _tag(name, size) for name, size in sizes.items() if size}
    fields: list[Any] = list(_HEAD)
    for name, tag in tags.items():
        fields += [(f"{name} tag", "u1", (len(tag),)), (name, "<f8", (sizes[name],))]
    row = np.zeros(1, np.dtype(fields))
    row["opcode"], row["channel"] = Opcode.MESSAGE, channel
    row["length"] = row.itemsize - 9
    for name, tag in tags.items():
        row[f"{name} tag"] = tag
    return row


def _tag(name: str, size: int) -> npt.NDArray[np.uint8]:
    """What stands before the ``size`` doubles of a field, by the protobuf library's own account."""
    zeros = State(t=0.0) if name == "t" else State(**{name: [0.0] * size})
    return np.frombuffer(zeros.SerializeToString()[: -8 * size], np.uint8)


def _numbers(dtype: np.dtype[Any]) -> list[str]:
    return [name for name in ("t", *_WIDTHS, *_JOINTS, "reaction") if name in (dtype.names or ())]
