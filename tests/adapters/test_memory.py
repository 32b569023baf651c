"""The peak of memory is of what ran since it was forgotten, and not of what ran before."""

import sys

import numpy as np
import pytest
from poinsot.adapters import memory

LARGE = 200_000_000


def test_what_is_held_and_let_go_of_is_counted():
    memory.forget()
    before = memory.peak()
    held = np.ones(LARGE // 8)
    assert memory.peak() - before > 0.9 * LARGE
    del held
    assert memory.peak() - before > 0.9 * LARGE


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux forgets")
def test_what_was_let_go_of_is_forgotten():
    held = np.ones(LARGE // 8)
    high = memory.peak()
    del held
    assert memory.forget()
    assert high - memory.peak() > 0.9 * LARGE
