"""Change a sign, an index or an operation in reference/ at random, and see whether a test turns red.

    python benchmarks/mutation_score.py [COUNT] [SEED]

Each change is made in a copy of the tree, and the tests of that module run there, then those of every
other if they stay green. Prints each survivor with its line, and the score. Takes minutes.
"""

import ast
import os
import random
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parent.parent
OPERATIONS = {ast.Add: ("+", "-"), ast.Sub: ("-", "+"), ast.Mult: ("*", "/"), ast.Div: ("/", "*")}
SWAPPED = {"sin": "cos", "cos": "sin", "sinh": "cosh", "cosh": "sinh", "I1": "I3", "I3": "I1", "I2": "I1"}
#: Seconds after which a run counts as red: a change may make a loop endless.
TOO_LONG = 300


class Change(NamedTuple):
    """A place in a file (bytes from, to) and what to put there."""

    path: Path
    line: int
    start: int
    end: int
    new: str


class Finder(ast.NodeVisitor):
    """Every change that can be made in one file; texts, types and messages are left alone."""

    def __init__(self, path):
        self.path, self.source, self.found = path, path.read_bytes(), []
        self.starts = [0]
        for line in self.source.splitlines(keepends=True):
            self.starts.append(self.starts[-1] + len(line))

    def visit_Raise(self, node):
        """What an error says is no formula."""

    def visit_JoinedStr(self, node):
        """Nor is text."""

    def visit_AnnAssign(self, node):
        if node.value:
            self.visit(node.value)

    def visit_FunctionDef(self, node):
        for part in node.body:
            self.visit(part)

    def visit_BinOp(self, node):
        if type(node.op) in OPERATIONS:
            old, new = OPERATIONS[type(node.op)]
            between = self._span(node.left)[1], self._span(node.right)[0]
            place = self.source.find(old.encode(), *between)
            if place >= 0 and self.source[place : place + 2] not in (b"**", b"//"):
                self._add(node, place, place + 1, new)
        self.generic_visit(node)

    def visit_UnaryOp(self, node):
        if isinstance(node.op, ast.USub):
            start, _ = self._span(node)
            self._add(node, start, start + 1, " ")
        self.generic_visit(node)

    def visit_Subscript(self, node):
        for index in ast.walk(node.slice):
            if isinstance(index, ast.Constant) and type(index.value) is int:
                self._add(index, *self._span(index), str((index.value + 1) % 3))
        self.visit(node.value)

    def visit_Attribute(self, node):
        if node.attr in SWAPPED:
            end = self._span(node)[1]
            self._add(node, end - len(node.attr), end, SWAPPED[node.attr])
        self.generic_visit(node)

    def visit_Name(self, node):
        if node.id in SWAPPED and isinstance(node.ctx, ast.Load):
            self._add(node, *self._span(node), SWAPPED[node.id])

    def _span(self, node):
        return (
            self.starts[node.lineno - 1] + node.col_offset,
            self.starts[node.end_lineno - 1] + node.end_col_offset,
        )

    def _add(self, node, start, end, new):
        self.found.append(Change(self.path, node.lineno, start, end, new))


def changes():
    """All changes that can be made in ``reference/``."""
    for path in sorted((ROOT / "reference").glob("*.py")):
        finder = Finder(path)
        finder.visit(ast.parse(finder.source))
        yield from finder.found


def red(tree, tests):
    """Whether any of these tests fails in a copy of the tree."""
    command = [sys.executable, "-m", "pytest", "-x", "-q", "-p", "no:cacheprovider", *tests]
    # The copy comes first on the path, before whatever is installed.
    environment = os.environ | {"PYTHONPATH": str(tree), "PYTHONDONTWRITEBYTECODE": "1"}
    try:
        done = subprocess.run(
            command, cwd=tree, env=environment, capture_output=True, timeout=TOO_LONG, check=False
        )
    except subprocess.TimeoutExpired:
        return True
    return done.returncode != 0


def caught(change):
    """Whether the tests see a change; its own module's first, because they are likely to."""
    with tempfile.TemporaryDirectory() as folder:
        tree = Path(folder)
        for name in ("reference", "poinsot", "tests/reference"):
            shutil.copytree(ROOT / name, tree / name, ignore=shutil.ignore_patterns("__pycache__"))
        shutil.copy(ROOT / "pyproject.toml", tree)
        source = change.path.read_bytes()
        changed = source[: change.start] + change.new.encode() + source[change.end :]
        (tree / "reference" / change.path.name).write_bytes(changed)
        own = tree / "tests" / "reference" / f"test_{change.path.name}"
        return (own.is_file() and red(tree, [str(own)])) or red(tree, ["tests/reference"])


def main(count=30, seed=0):
    """Try ``count`` changes and print the score."""
    chosen = random.Random(seed).sample(list(changes()), count)
    alive = []
    for number, change in enumerate(chosen, start=1):
        line = change.path.read_text(encoding="utf-8").splitlines()[change.line - 1].strip()
        seen = caught(change)
        outcome = "caught  " if seen else "SURVIVES"
        print(f"{number:3d} {outcome} {change.path.name}:{change.line} -> {change.new!r}: {line}", flush=True)
        alive += [] if seen else [change]
    print(f"{count - len(alive)} of {count} changes caught (seed {seed})")


if __name__ == "__main__":
    main(*(int(argument) for argument in sys.argv[1:]))
