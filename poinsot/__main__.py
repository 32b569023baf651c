"""``python -m poinsot``: the command line."""

from .entry import process

if __name__ == "__main__":
    process()
