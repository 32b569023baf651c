"""What C code prints: caught in order, given back, and never seen later."""

import os
import subprocess
import sys

import pytest
from poinsot.adapters.c_output import caught

PRINTS = """
import ctypes, sys
from poinsot.adapters.c_output import caught
c = ctypes.CDLL(None)
print("before, from Python")
c.printf(b"before, from C\\n")
with caught() as text:
    c.printf(b"inside, from C\\n")
    print("inside, from Python")
    print("inside, an error", file=sys.stderr)
    c.perror(b"inside, an error from C")
c.printf(b"after, from C\\n")
c.fflush(None)
print("caught", sorted(text[0].splitlines()))
"""


def test_only_what_is_printed_inside_is_caught():
    # Through a pipe, where C holds back what it prints until its buffer is full or the process ends.
    run = subprocess.run([sys.executable, "-c", PRINTS], capture_output=True, text=True, check=True)
    *lines, last = run.stdout.splitlines()
    assert sorted(lines) == ["after, from C", "before, from C", "before, from Python"]
    for said in ("inside, from C", "inside, from Python", "inside, an error", "inside, an error from C: "):
        assert said in last
    assert run.stderr == ""


def _fails():
    with caught() as text:
        os.write(1, b"said\n")
        raise RuntimeError(text)


def test_what_was_printed_is_there_after_an_exception(capfd):
    with pytest.raises(RuntimeError) as raised:
        _fails()
    assert raised.value.args == (["said\n"],)
    os.write(1, b"heard\n")
    assert capfd.readouterr().out == "heard\n"


def test_a_block_in_a_block_catches_its_own(capfd):
    with caught() as outer:
        os.write(1, b"one\n")
        with caught() as inner:
            os.write(2, b"two\n")
        os.write(1, b"three\n")
    assert (outer, inner) == (["one\nthree\n"], ["two\n"])
    assert capfd.readouterr() == ("", "")
