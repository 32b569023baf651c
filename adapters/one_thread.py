"""Child processes whose linear algebra keeps to one thread."""

import os
from collections.abc import Iterator
from contextlib import contextmanager

#: What numpy's and scipy's libraries read when they are loaded.
NAMES = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")


@contextmanager
def one_thread_each() -> Iterator[None]:
    """Processes that start within this get one thread each, unless whoever runs Poinsot chose otherwise.

    There are as many processes as cores: threads beside them wait for one another, and a judging of all
    scenes takes a tenth longer or more.
    """
    added = [name for name in NAMES if name not in os.environ]
    os.environ.update(dict.fromkeys(added, "1"))
    try:
        yield
    finally:
        for name in added:
            os.environ.pop(name, None)
