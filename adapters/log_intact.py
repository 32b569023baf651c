"""Whether a log is whole: every byte of it is covered by a checksum, and every checksum is checked.

mcap's readers skip the checksums of the summary and of attachments, and any that reads zero. So the
two that together cover the whole file, of the data section and of the summary, are checked here
over the bytes themselves, before anything is parsed: https://mcap.dev/spec, Data End and Footer.
"""

import io
import zlib
from pathlib import Path

from mcap.data_stream import ReadDataStream
from mcap.opcode import Opcode
from mcap.reader import make_reader
from mcap.records import Footer

from ..reference.errors import PoinsotError
from .log_container import MAGIC

#: Bytes of a record's opcode and length, of the footer with them, and of the Data End record.
_HEAD, _FOOTER, _DATA_END = 9, 29, 13


class CorruptLog(PoinsotError):  # noqa: N818 - the name that scripts catch; it says what is the case
    """A log that cannot be trusted: ``path`` and the ``reason``, one line."""

    def __init__(self, path: Path, reason: str) -> None:
        super().__init__(path, reason)
        self.path, self.reason = path, reason

    def __str__(self) -> str:
        """Path and reason on one line."""
        return f"log {self.path}: {self.reason}"


def fault(data: bytes, schema: str) -> str | None:
    """Why ``data`` is no whole MCAP file that holds a channel of ``schema``; ``None`` if it is one."""
    if not data:
        return "is empty"
    if not data.startswith(MAGIC):
        return f"is not an MCAP file: begins with {data[:8]!r}, expected {MAGIC!r}"
    if not data.endswith(MAGIC) or len(data) < 2 * len(MAGIC) + _FOOTER:
        return "is cut short: the mark that closes an MCAP file is missing at its end"
    footer_start = len(data) - len(MAGIC) - _FOOTER
    if data[footer_start : footer_start + _HEAD] != _head(Opcode.FOOTER, _FOOTER):
        return "is damaged: its footer cannot be read"
    footer = Footer.read(ReadDataStream(io.BytesIO(data[footer_start + _HEAD :])))
    return (
        _summary_fault(data, footer, footer_start)
        or _foreign(data, schema)
        or _data_fault(data, footer.summary_start)
    )


def _summary_fault(data: bytes, footer: Footer, footer_start: int) -> str | None:
    if footer.summary_start == 0:
        return "has no summary: Poinsot did not write it"
    if not len(MAGIC) + _DATA_END <= footer.summary_start <= footer_start:
        return "is damaged: its footer points outside of it"
    if zlib.crc32(data[footer.summary_start : -len(MAGIC) - 4]) == footer.summary_crc:
        return None
    if footer.summary_crc == 0:
        return "has no checksum of its summary: Poinsot did not write it"
    return "is damaged: the checksum of its summary does not match"


def _foreign(data: bytes, schema: str) -> str | None:
    summary = make_reader(io.BytesIO(data)).get_summary()
    found = sorted({s.name for s in summary.schemas.values()}) if summary else []
    if schema in found:
        return None
    return f"is not a log of Poinsot: holds {', '.join(found) or 'no schema'}, expected {schema}"


def _data_fault(data: bytes, summary_start: int) -> str | None:
    end = summary_start - _DATA_END
    if data[end : end + _HEAD] != _head(Opcode.DATA_END, _DATA_END):
        return "is damaged: the end of its data cannot be read"
    stored = int.from_bytes(data[end + _HEAD : summary_start], "little")
    if zlib.crc32(memoryview(data)[:end]) == stored:
        return None
    if stored == 0:
        return "has no checksum of its data: another program wrote it, or wrote it anew"
    return "is damaged: the checksum of its data does not match"


def _head(opcode: Opcode, size: int) -> bytes:
    return bytes([opcode]) + (size - _HEAD).to_bytes(8, "little")
