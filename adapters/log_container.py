"""An MCAP file, laid down record by record in order, with every index and checksum the format has.

mcap's ``Writer`` takes one call and one index entry a message, more time than a whole sample may
take here, so whole chunks of ready message records are put into mcap's own record classes instead.
The format is https://mcap.dev/spec.
"""

import struct
import zlib
from collections.abc import Iterable, Mapping, Sequence
from typing import IO

import numpy as np
import numpy.typing as npt
import zstandard
from mcap.data_stream import RecordBuilder
from mcap.opcode import Opcode
from mcap.records import (
    Attachment,
    AttachmentIndex,
    Channel,
    Chunk,
    ChunkIndex,
    DataEnd,
    Footer,
    Header,
    McapRecord,
    Metadata,
    MetadataIndex,
    Schema,
    Statistics,
    SummaryOffset,
)

MAGIC = b"\x89MCAP0\r\n"
#: A full chunk before compression [bytes]: small enough to seek in, large enough to compress.
CHUNK = 96 * 1024

#: What a message record begins with: opcode, length of what follows, channel, sequence and both times.
_MESSAGE = struct.Struct("<BQHIQQ")
#: How long the fields before the data are, opcode and length aside [bytes].
_FIELDS = _MESSAGE.size - 9

Times = npt.NDArray[np.int64]


class Container:
    """Writes to ``stream``, which must be at its start; ``finish`` completes the file."""

    def __init__(self, stream: IO[bytes]) -> None:
        self._stream = stream
        self._offset = self._checksum = 0
        # Mantissas hardly compress: mcap's own level, 3, takes about twice the time to save 1 to 3 %.
        self._compressor = zstandard.ZstdCompressor(level=1)
        self._summary: dict[Opcode, list[McapRecord]] = {
            opcode: []
            for opcode in (
                Opcode.SCHEMA,
                Opcode.CHANNEL,
                Opcode.CHUNK_INDEX,
                Opcode.ATTACHMENT_INDEX,
                Opcode.METADATA_INDEX,
            )
        }
        self._messages: dict[int, int] = {}
        self._span: list[int] = []
        self._put(MAGIC)
        self._add(Header(profile="", library="poinsot"))

    def channel(self, topic: str, schema: str, descriptors: bytes, metadata: Mapping[str, str]) -> int:
        """Declare a channel of protobuf messages; returns its number."""
        number = len(self._summary[Opcode.CHANNEL]) + 1
        self._declare(Opcode.SCHEMA, Schema(id=number, name=schema, encoding="protobuf", data=descriptors))
        self._declare(
            Opcode.CHANNEL,
            Channel(
                id=number,
                schema_id=number,
                topic=topic,
                message_encoding="protobuf",
                metadata=dict(metadata),
            ),
        )
        return number

    def attachment(self, name: str, media_type: str, data: bytes) -> None:
        """Attach a file."""
        start = self._offset
        length = self._add(Attachment(log_time=0, create_time=0, name=name, media_type=media_type, data=data))
        self._summary[Opcode.ATTACHMENT_INDEX].append(
            AttachmentIndex(start, length, 0, 0, len(data), name, media_type)
        )

    def metadata(self, name: str, texts: Mapping[str, str]) -> None:
        """Put down names with texts."""
        start = self._offset
        length = self._add(Metadata(name=name, metadata=dict(texts)))
        self._summary[Opcode.METADATA_INDEX].append(MetadataIndex(start, length, name))

    def rows(self, channel: int, times: Times, rows: npt.NDArray[np.void]) -> None:
        """Put down ready message records (n,) of one length, logged at ``times`` (n,) [ns]."""
        count = max(1, CHUNK // rows.itemsize)
        for start in range(0, len(rows), count):
            part = rows[start : start + count]
            self._chunk(
                channel, times[start : start + count], part.tobytes(), np.arange(len(part)) * rows.itemsize
            )

    def messages(self, channel: int, times: Sequence[int], payloads: Iterable[bytes]) -> None:
        """Put down encoded messages of any length, logged at ``times`` [ns]."""
        records, offsets, first = bytearray(), list[int](), 0
        for place, (time, data) in enumerate(zip(times, payloads, strict=True)):
            offsets.append(len(records))
            records += _MESSAGE.pack(Opcode.MESSAGE, len(data) + _FIELDS, channel, place, time, time) + data
            if len(records) > CHUNK or place + 1 == len(times):
                self._chunk(channel, np.array(times[first : place + 1]), bytes(records), np.array(offsets))
                records, offsets, first = bytearray(), [], place + 1

    def finish(self) -> None:
        """Write the end of the data, the summary with its offsets, and the footer."""
        self._add(DataEnd(self._checksum))
        start, builder, offsets = self._offset, RecordBuilder(), list[SummaryOffset]()
        self._summary[Opcode.STATISTICS] = [self._statistics()]
        for opcode, group in self._summary.items():
            here = builder.count
            for record in group:
                record.write(builder)
            if group:
                offsets.append(SummaryOffset(opcode, start + here, builder.count - here))
        offset_start = start + builder.count
        for offset in offsets:
            offset.write(builder)
        summary = builder.end()
        Footer(start, offset_start, 0).write(builder)
        footer = builder.end()
        # The checksum, the footer's last four bytes, covers everything before it from the summary on.
        checksum = zlib.crc32(footer[:-4], zlib.crc32(summary))
        self._put(summary + footer[:-4] + checksum.to_bytes(4, "little") + MAGIC)

    def _chunk(self, channel: int, times: Times, records: bytes, offsets: npt.NDArray[np.int64]) -> None:
        start, first, last = self._offset, int(times[0]), int(times[-1])
        data = self._compressor.compress(records)
        length = self._add(Chunk("zstd", data, last, first, zlib.crc32(records), len(records)))
        index = self._offset
        index_length = self._index(channel, times, offsets)
        self._summary[Opcode.CHUNK_INDEX].append(
            ChunkIndex(
                message_start_time=first,
                message_end_time=last,
                chunk_start_offset=start,
                chunk_length=length,
                message_index_offsets={channel: index},
                message_index_length=index_length,
                compression="zstd",
                compressed_size=len(data),
                uncompressed_size=len(records),
            )
        )
        self._messages[channel] = self._messages.get(channel, 0) + len(times)
        self._span += [first, last]

    def _index(self, channel: int, times: Times, offsets: npt.NDArray[np.int64]) -> int:
        builder = RecordBuilder()
        builder.start_record(Opcode.MESSAGE_INDEX)
        builder.write2(channel)
        builder.write4(16 * len(times))
        builder.write(np.column_stack([times, offsets]).astype("<u8").tobytes())
        builder.finish_record()
        return self._put(builder.end())

    def _statistics(self) -> Statistics:
        counts = {opcode: len(records) for opcode, records in self._summary.items()}
        return Statistics(
            attachment_count=counts[Opcode.ATTACHMENT_INDEX],
            channel_count=counts[Opcode.CHANNEL],
            channel_message_counts=self._messages,
            chunk_count=counts[Opcode.CHUNK_INDEX],
            message_count=sum(self._messages.values()),
            message_end_time=max(self._span, default=0),
            message_start_time=min(self._span, default=0),
            metadata_count=counts[Opcode.METADATA_INDEX],
            schema_count=counts[Opcode.SCHEMA],
        )

    def _declare(self, opcode: Opcode, record: McapRecord) -> None:
        self._add(record)
        self._summary[opcode].append(record)

    def _add(self, record: McapRecord) -> int:
        builder = RecordBuilder()
        record.write(builder)
        return self._put(builder.end())

    def _put(self, data: bytes) -> int:
        self._stream.write(data)
        self._offset += len(data)
        self._checksum = zlib.crc32(data, self._checksum)
        return len(data)
