"""What Poinsot's own engine files declare, read without importing the engine they are about."""

import ast
import importlib.util
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..reference.errors import PoinsotError
from ..scenarios.scene import FEATURES
from .engine import Scheme

#: All that a declaration may refer to.
_KNOWN = {"Scheme": Scheme, "FEATURES": FEATURES, "frozenset": frozenset}


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
    for node in tree.body:
        if isinstance(node, ast.ClassDef):
            values = {a.target.id: a.value for a in node.body if isinstance(a, ast.AnnAssign) if a.value
                      and isinstance(a.target, ast.Name)}  # fmt: skip
            if "schemes" in values:
                installed = importlib.util.find_spec(path.stem.removesuffix("_")) is not None
                name, features, schemes = (_value(values[key]) for key in ("name", "features", "schemes"))
                return Declaration(name, features, schemes, installed)
    raise PoinsotError(f"{path.name}: got no class that declares schemes, expected one engine")


def _value(expression: ast.expr) -> Any:
    """The value of a class attribute that is written with literals, schemes and features alone."""
    code = compile(ast.Expression(expression), "<declaration>", "eval")
    return eval(code, {"__builtins__": {}}, _KNOWN)  # noqa: S307 (Poinsot's own source, and no builtins)
