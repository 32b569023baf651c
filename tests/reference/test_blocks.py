"""Blocks cover what they are to cover, once and in order."""

import pytest
from poinsot.reference.blocks import BLOCK, blocks


@pytest.mark.parametrize("size", [0, 1, BLOCK - 1, BLOCK, BLOCK + 1, 3 * BLOCK])
def test_blocks_cover_a_range_once_and_in_order(size):
    places = list(range(size))
    pieces = [places[here] for here in blocks(size)]
    assert [place for piece in pieces for place in piece] == places
    assert all(0 < len(piece) <= BLOCK for piece in pieces)
    assert len(pieces) == -(-size // BLOCK)
