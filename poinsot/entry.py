"""Where `poinsot` starts: a list needs no parser of options, whose loading is a good part of its time."""

import sys

from .reference.errors import PoinsotError


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
            sys.stderr.write("poinsot: interrupted\n")
            return 130
    from . import command_line

    return command_line.main(arguments)
