"""Where everything is, whatever the engine says of itself."""

import numpy as np

from .engine import Engine, EngineError, State


def looked(machine: Engine) -> tuple[State, str]:
    """Where everything is, copied, though the engine complain; and its complaint.

    Raises ``EngineError`` if it cannot tell where everything is.
    """
    said = ""
    try:
        state = machine.state()
    except EngineError as error:
        if error.state is None:
            raise
        state, said = error.state, str(error)
    # Copied: an engine may hand out views of arrays that its next step overwrites.
    return State(*(np.array(part, dtype=np.float64) for part in state)), said
