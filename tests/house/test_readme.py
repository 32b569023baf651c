"""What the README says to type is what continuous integration types."""

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def commands():
    """The shell blocks of the README's first section."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    return [block.strip() for block in re.findall(r"```sh\n(.*?)```", text, re.DOTALL)][:2]


def test_the_two_commands_are_run_word_for_word():
    script = (ROOT / ".ci" / "run").read_text(encoding="utf-8").splitlines()
    install, check = commands()
    assert "poinsot run" in install
    assert "pytest" in check
    assert install in script
    assert check in script
