"""Where `poinsot` starts: a list needs no parser of options, whose loading is a good part of its time."""

import gc
import os
import sys
from typing import NoReturn

from .reference.errors import PoinsotError
from .telling import remark


def process() -> NoReturn:
    """What `poinsot` runs: ``main``, and the end of the process with its exit code."""
    if sys.argv[1:2] != ["list"]:
        sys.exit(main())
    gc.disable()  # it would look through thousands of new objects, all of which stay
    code = main()
    print(end="", flush=True)  # noqa: T201 (what is still on its way)
    # Python would take the scenes apart before the process ends with them: a tenth of the list's time.
    os._exit(code)


def main() -> int:
    """Run the command line; the exit code is 0, 1, 2, 3, 4 or 130 as the README says."""
    arguments = sys.argv[1:]
    if arguments in (["list"], ["list", "--json"]):
        from . import listing

        try:
            return listing.printed(as_json="--json" in arguments)
        except PoinsotError:
            pass  # The whole command line comes to it again, and tells what it means.
        except KeyboardInterrupt:
            remark("poinsot: interrupted")
            return 130
    from . import command_line

    return command_line.main(arguments)
