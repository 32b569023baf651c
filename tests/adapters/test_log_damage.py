"""No damaged, cut or foreign file is ever taken for a log."""

import io
import pickle
import struct
import zlib
from pathlib import Path

import numpy as np
import pytest
from mcap.reader import make_reader
from mcap.writer import CompressionType, Writer
from poinsot.adapters import log, log_rows
from poinsot.adapters.log_container import Container
from poinsot.adapters.log_intact import fault
from poinsot.reference.errors import InputError, PoinsotError


@pytest.fixture
def path(tmp_path, make_cell) -> Path:
    """A log of a few samples, small enough to spoil at every byte."""
    log.write(tmp_path / "a.mcap", *make_cell(1, 0, 4), {"model.xml": "<mujoco/>"})
    return tmp_path / "a.mcap"


def _reason(path: Path, data: bytes) -> str:
    path.write_bytes(data)
    with pytest.raises(log.CorruptLog) as caught:
        log.read(path)
    assert isinstance(caught.value, PoinsotError)
    assert caught.value.path == path
    assert str(caught.value) == f"log {path}: {caught.value.reason}"
    assert "\n" not in str(caught.value)
    return caught.value.reason


def test_a_change_of_any_byte_is_found(path):
    whole = path.read_bytes()
    changes = np.random.default_rng(1).integers(1, 256, size=len(whole))
    for place, change in enumerate(changes.tolist()):
        data = bytearray(whole)
        data[place] ^= change
        assert fault(bytes(data), "poinsot.State"), f"byte {place} of {len(whole)}"


def test_any_bit_flipped_in_a_log_of_many_chunks_is_found(tmp_path, make_cell):
    path = tmp_path / "a.mcap"
    log.write(path, *make_cell(1, 4, 3000), {"model.xml": "<mujoco/>" * 1000})
    whole, rng = path.read_bytes(), np.random.default_rng(2)
    # As many places near the two ends, where the structure is, as in the data.
    places = [*rng.integers(len(whole), size=100), *range(0, 2000, 20), *range(-2000, 0, 20)]
    for place, bit in zip(places, rng.integers(8, size=300).tolist(), strict=True):
        data = bytearray(whole)
        data[place] ^= 1 << bit
        _reason(path, bytes(data))


def test_a_log_cut_at_any_length_is_found(path):
    whole = path.read_bytes()
    for length in range(8, len(whole)):
        assert "cut short" in (fault(whole[:length], "poinsot.State") or "")
    for length in range(8, len(whole), 100):
        assert "cut short" in _reason(path, whole[:length])


def test_a_log_with_more_behind_it_or_missing_its_middle_is_found(path):
    whole = path.read_bytes()
    assert "cut short" in _reason(path, whole + b"\0")
    assert "damaged" in _reason(path, whole + whole)
    assert "damaged" in _reason(path, whole[:1000] + whole[1100:])


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"", "is empty"),
        (b"\x89MCAP0", "not an MCAP file"),
        (b"<mujoco/>" * 100, "not an MCAP file"),
        (b"\x89MCAP0\r\n", "cut short"),
        (b"\x89MCAP0\r\n" * 20, "footer"),
    ],
)
def test_what_is_no_mcap_file_is_found(path, data, words):
    assert words in _reason(path, data)


def _foreign(**options) -> bytes:
    stream = io.BytesIO()
    writer = Writer(stream, **options)
    writer.start()
    schema = writer.register_schema("geometry_msgs/Pose", "ros1msg", b"float64 x")
    channel = writer.register_channel("/pose", "ros1", schema)
    writer.add_message(channel, log_time=0, data=bytes(8), publish_time=0)
    writer.finish()
    return stream.getvalue()


@pytest.mark.parametrize("checksums", [True, False])
def test_another_programs_mcap_file_is_named_as_such(path, checksums):
    reason = _reason(path, _foreign(enable_data_crcs=checksums))
    assert reason == "is not a log of Poinsot: holds geometry_msgs/Pose, expected poinsot.State"


def test_an_mcap_file_without_checksums_or_summary_is_refused(path):
    assert "no checksum of its summary" in _reason(path, _foreign(enable_crcs=False))
    bare = {"use_statistics": False, "repeat_channels": False, "repeat_schemas": False, "use_chunking": False}
    assert "no summary" in _reason(path, _foreign(**bare, use_summary_offsets=False))


def _written_anew(data: bytes, **options) -> bytes:
    """The messages of a log, put into another file by mcap's own writer."""
    stream = io.BytesIO()
    writer, channels = Writer(stream, **options), dict[int, int]()
    writer.start()
    for schema, channel, message in make_reader(io.BytesIO(data)).iter_messages():
        if channel.id not in channels:
            number = writer.register_schema(schema.name, schema.encoding, schema.data)
            channels[channel.id] = writer.register_channel(
                channel.topic, channel.message_encoding, number, channel.metadata
            )
        writer.add_message(channels[channel.id], message.log_time, message.data, message.publish_time)
    writer.finish()
    return stream.getvalue()


def test_a_log_another_program_wrote_anew_is_refused(path):
    whole = path.read_bytes()
    assert "has no checksum of its data" in _reason(path, _written_anew(whole))
    anew = _written_anew(whole, enable_data_crcs=True, compression=CompressionType.NONE)
    assert "not a log that this version of Poinsot reads" in _reason(path, anew)


def _resealed(data: bytes) -> bytes:
    """``data`` with both its checksums made right, as a program that meant to change it would."""
    footer = len(data) - 37
    [start] = struct.unpack("<Q", data[footer + 9 : footer + 17])
    data = data[: start - 4] + struct.pack("<I", zlib.crc32(data[: start - 13])) + data[start:]
    return data[:-12] + struct.pack("<I", zlib.crc32(data[start:-12])) + data[-8:]


@pytest.mark.parametrize(
    ("old", "new"),
    [
        (b"chain", b"\xff\xfe\xff\xfe\xff"),
        (b"scene.json", b"scene.jsom"),
        (b'["body 0"]', b'["body" 0]'),
        (b'["body 0"]', b'["bo","0"]'),
        (b"0.001", b"zero!"),
        (b"environment", b"environ\nent"),
        (b"zstd", b"gzip"),
    ],
)
def test_what_poinsot_would_not_write_is_refused_though_its_checksums_are_right(path, old, new):
    whole = path.read_bytes()
    assert old in whole
    reason = _reason(path, _resealed(whole.replace(old, new)))
    assert "not a log that this version of Poinsot reads" in reason


@pytest.mark.parametrize("wrong", [slice(None, None, -1), slice(1, None), slice(None, None, 2)])
def test_samples_out_of_order_or_missing_are_refused(path, make_cell, monkeypatch, wrong):
    rows = Container.rows
    monkeypatch.setattr(
        Container, "rows", lambda self, channel, times, part: rows(self, channel, times[wrong], part[wrong])
    )
    log.write(path, *make_cell(1, 0, 8), {})
    assert "not laid out as Poinsot writes them" in _reason(path, path.read_bytes())


@pytest.mark.parametrize("part", ["opcode", "length", "channel", "position tag"])
def test_messages_laid_out_otherwise_are_refused(path, make_cell, monkeypatch, part):
    encode = log_rows.encode

    def spoilt(*arguments):
        rows = encode(*arguments)
        rows[part][-1] += 1
        return rows

    monkeypatch.setattr(log_rows, "encode", spoilt)
    log.write(path, *make_cell(1, 0, 8), {})
    assert "not laid out as Poinsot writes them" in _reason(path, path.read_bytes())


def test_resealing_is_faithful(path):
    assert _resealed(path.read_bytes()) == path.read_bytes()


def test_the_error_survives_a_change_of_process(path):
    error = pickle.loads(pickle.dumps(log.CorruptLog(path, "is empty")))
    assert (error.path, error.reason, str(error)) == (path, "is empty", f"log {path}: is empty")


def test_a_log_that_is_not_there_is_bad_input(tmp_path):
    with pytest.raises(InputError, match=r"none\.mcap: cannot be read: No such file"):
        log.read(tmp_path / "none.mcap")
    with pytest.raises(InputError, match="cannot be read: Is a directory"):
        log.read(tmp_path)
