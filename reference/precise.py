"""Fifty-digit numbers for what a case needs once: a context of mpmath's own, so nobody else's digits matter.

mpmath's global precision is left alone, whatever a caller set it to; ``mp.mpf(x)`` takes doubles exactly.
"""

from typing import Any

import mpmath

#: Decimal digits of every number made from `mp`.
DIGITS = 50

_untyped: Any = mpmath

#: The context: mp.mpf, mp.sqrt, mp.agm, mp.elliprf, ... (mpmath ships no types).
mp: Any = _untyped.MPContext()
mp.dps = DIGITS
