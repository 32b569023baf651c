"""What C code prints: caught before it reaches a standard output or error stream that is not its own."""

import ctypes
import os
import sys
import tempfile
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager

_c_library = ctypes.CDLL(None)


@contextmanager
def caught() -> Iterator[list[str]]:
    """Catch what anything in this process prints, from C too, on standard output and error.

    The list that it yields holds the text once the block is left, however it is left.
    """
    text: list[str] = []
    _flush()
    with tempfile.TemporaryFile() as file:
        try:
            with ExitStack() as streams:
                for stream in (1, 2):
                    streams.enter_context(_sent(stream, file.fileno()))
                yield text
        finally:
            file.seek(0)
            text.append(file.read().decode(errors="replace"))


@contextmanager
def _sent(stream: int, elsewhere: int) -> Iterator[None]:
    try:
        kept = os.dup(stream)
    except OSError:  # a process without this stream needs none kept clean
        yield
        return
    os.dup2(elsewhere, stream)
    try:
        yield
    finally:
        # C keeps what it prints to a pipe in a buffer, which would otherwise come out at the exit.
        _flush()
        os.dup2(kept, stream)
        os.close(kept)


def _flush() -> None:
    for stream in (sys.stdout, sys.stderr):
        if stream is not None and not stream.closed:
            stream.flush()
    _c_library.fflush(None)
