"""Where what a command says goes nowhere."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

START = "from poinsot.entry import process; process()"
FULL = Path("/dev/full")
COMMANDS = ["list", "explain"]


def ended(command, output):
    """Exit code of a command whose standard output is that, and what it says beside it."""
    with output:
        done = subprocess.run(
            [sys.executable, "-c", START, command], stdout=output, stderr=subprocess.PIPE, check=False
        )
    return done.returncode, done.stderr.decode()


@pytest.mark.parametrize("command", COMMANDS)
def test_a_reader_who_left_changes_nothing(command):
    reader, writer = os.pipe()
    os.close(reader)
    assert ended(command, os.fdopen(writer, "wb")) == (0, "")


@pytest.mark.skipif(not FULL.exists(), reason="this system has no file that is always full")
@pytest.mark.parametrize("command", COMMANDS)
def test_a_full_disk_is_told_in_one_line(command):
    code, said = ended(command, FULL.open("wb"))
    assert code == 4
    assert said == "poinsot: standard output takes no more: No space left on device\n"


@pytest.mark.parametrize("command", COMMANDS)
def test_no_standard_output_at_all_is_no_error(command):
    done = subprocess.run(
        ["sh", "-c", f'"{sys.executable}" -c "{START}" {command} >&-'], capture_output=True, check=False
    )
    assert (done.returncode, done.stderr) == (0, b"")


def test_a_mistake_is_told_by_its_exit_code_where_nobody_hears_it():
    done = subprocess.run(
        ["sh", "-c", f'"{sys.executable}" -c "{START}" run no_such_scene 2>&-'], check=False
    )
    assert done.returncode == 2
