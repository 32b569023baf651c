"""What a command says to whoever started it."""

import os
import sys
from contextlib import suppress


def tell(text: str) -> None:
    """Print what was asked for; a reader who left early (``| head``) changes nothing about what was found.

    Where standard output takes nothing for another reason the process ends with 4.
    """
    try:
        print(text, flush=True)  # noqa: T201 (this is what commands are for)
    except OSError as error:
        # What was not written stays in the buffer: at its end Python would try again, and complain.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        if not isinstance(error, BrokenPipeError):
            remark(f"poinsot: standard output takes no more: {error.strerror}")
            raise SystemExit(4) from None


def remark(text: str) -> None:
    """Say something beside it, on standard error; where nobody hears it, nothing is lost."""
    with suppress(OSError, AttributeError):
        sys.stderr.write(f"{text}\n")
