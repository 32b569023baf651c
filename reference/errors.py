"""The one root exception of Poinsot, and the one for input that cannot be right."""


class PoinsotError(Exception):
    """Root of every exception that Poinsot raises on purpose; its text is for people."""


class UnavailableError(PoinsotError):
    """An engine that is known but not installed here."""


class InputError(PoinsotError, ValueError):
    """A value that was given is not allowed; the message says what was got and what is allowed."""
