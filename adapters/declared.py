"""What Poinsot's own engine files declare, read without importing the engine they are about."""

import ast
import importlib.util
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..reference.errors import PoinsotError
from .engine import Scheme

DECLARED = ("name", "features", "schemes")
FIRST_METHOD = re.compile(r"^    (?:def |@)", re.MULTILINE)


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
    # What an engine does, from its first method on, says nothing here; to parse it would take the longest.
    tree = ast.parse(FIRST_METHOD.split(path.read_text(encoding="utf-8"), 1)[0])
    homes: dict[str, ast.stmt] = {}
    for node in tree.body:
        if isinstance(node, ast.ClassDef) and set(DECLARED) <= _attributes(node).keys():
            name, features, schemes = (_value(_attributes(node)[key], homes) for key in DECLARED)
            installed = importlib.util.find_spec(path.stem.removesuffix("_")) is not None
            return Declaration(name, features, schemes, installed)
        homes |= dict.fromkeys(_defined(node), node)
    raise PoinsotError(f"{path.name}: got no class that declares {', '.join(DECLARED)}, expected one engine")


def _attributes(node: ast.ClassDef) -> dict[str, ast.expr]:
    """The annotated attributes of a class, with their values."""
    return {
        part.target.id: part.value
        for part in node.body
        if isinstance(part, ast.AnnAssign) and isinstance(part.target, ast.Name) and part.value
    }


def _defined(node: ast.stmt) -> list[str]:
    """Names that a statement takes from Poinsot itself or assigns."""
    if isinstance(node, ast.ImportFrom) and node.level > 0:
        return [alias.asname or alias.name for alias in node.names]
    if isinstance(node, ast.Assign):
        return _names(*node.targets)
    return []


def _names(*nodes: ast.AST) -> list[str]:
    return [part.id for node in nodes for part in ast.walk(node) if isinstance(part, ast.Name)]


def _value(expression: ast.expr, homes: dict[str, ast.stmt]) -> Any:
    """The value of an expression, once the statements it stands on have been carried out, and no others."""
    found: dict[str, Any] = {"__package__": __package__}
    _carry_out(expression, homes, found)
    return eval(compile(ast.Expression(expression), "<declaration>", "eval"), found)  # noqa: S307 (own source)


def _carry_out(node: ast.AST, homes: dict[str, ast.stmt], found: dict[str, Any]) -> None:
    for name in _names(node):
        if name in homes and name not in found:
            if isinstance(homes[name], ast.Assign):
                _carry_out(homes[name].value, homes, found)  # type: ignore[attr-defined]
            exec(compile(ast.Module([homes[name]], []), "<declaration>", "exec"), found)  # noqa: S102 (own source)
