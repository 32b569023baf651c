"""Fifty-digit numbers for what a case needs once: a context of mpmath's own, so nobody else's digits matter.

mpmath's global precision is left alone, whatever a caller set it to; ``mp.mpf(x)`` takes doubles exactly.
mpmath loads with the first number that is asked for: scenes are listed without it.
"""

from typing import Any

#: Decimal digits of every number made from `mp`.
DIGITS = 50


class _Context:
    """Stands for mpmath's context; takes over each of its functions when it is first used."""

    def __getattr__(self, name: str) -> Any:
        import mpmath

        if "context" not in self.__dict__:
            context: Any = mpmath.MPContext()  # type: ignore[attr-defined,no-untyped-call]
            context.dps = DIGITS
            self.__dict__["context"] = context
        value = getattr(self.__dict__["context"], name)
        if callable(value):
            self.__dict__[name] = value
        return value


#: The context: mp.mpf, mp.sqrt, mp.agm, mp.elliprf, ... (mpmath ships no types).
mp: Any = _Context()
