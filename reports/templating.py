"""The templates of the pages: whatever they print is made printable and escaped."""

from pathlib import Path

from jinja2 import Environment, FileSystemLoader

from .wording import GLYPHS, printable


def environment() -> Environment:
    """A new environment over ``reports/templates``, to which a page adds what it needs."""
    made = Environment(
        loader=FileSystemLoader(Path(__file__).parent / "templates"),
        autoescape=True,
        finalize=lambda value: printable(value) if type(value) is str else value,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    made.globals["GLYPHS"] = GLYPHS
    return made
