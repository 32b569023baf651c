"""What Poinsot's own engine files declare, read without importing the engine they are about."""

import ast
import importlib.util
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..reference.errors import PoinsotError
from .engine import Scheme

DECLARED = ("name", "features", "schemes")


@dataclass(frozen=True)
class Declaration:
    """An engine's name, features and schemes, and whether its package is installed."""

    name: str
    features: frozenset[str]
    schemes: tuple[Scheme, ...]
    installed: bool


def declared() -> list[Declaration]:
    """The engines that have a file in this folder, by name."""
    return [_declaration(path) for path in sorted(Path(__file__).parent.glob("[a-z]*_.py"))]


def _declaration(path: Path) -> Declaration:
    tree = ast.parse(path.read_text(encoding="utf-8"))
    names: dict[str, Any] = {"__package__": __package__}
    for node in tree.body:
        if isinstance(node, ast.ClassDef) and set(DECLARED) <= _assigned(node).keys():
            name, features, schemes = (_value(_assigned(node)[key], names) for key in DECLARED)
            installed = importlib.util.find_spec(path.stem.removesuffix("_")) is not None
            return Declaration(name, features, schemes, installed)
        _define(node, names)
    raise PoinsotError(f"{path.name}: got no class that declares {', '.join(DECLARED)}, expected one engine")


def _assigned(node: ast.ClassDef) -> dict[str, ast.expr]:
    return dict(_assignments(node))


def _assignments(node: ast.ClassDef) -> Iterator[tuple[str, ast.expr]]:
    for part in node.body:
        if isinstance(part, ast.AnnAssign) and isinstance(part.target, ast.Name) and part.value:
            yield part.target.id, part.value


def _define(node: ast.stmt, names: dict[str, Any]) -> None:
    """Carry out an import from Poinsot itself or an assignment, unless it needs the engine."""
    ours = isinstance(node, ast.ImportFrom) and node.level > 0
    if ours or isinstance(node, ast.Assign):
        try:
            exec(compile(ast.Module([node], []), "<declaration>", "exec"), names)  # noqa: S102 (own source)
        except NameError:
            return


def _value(expression: ast.expr, names: dict[str, Any]) -> Any:
    return eval(compile(ast.Expression(expression), "<declaration>", "eval"), names)  # noqa: S307 (own source)
