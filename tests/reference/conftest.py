"""Property tests here have no deadline: the first example pays for caches, and machines are shared."""

from hypothesis import settings

settings.register_profile("reference", deadline=None)
settings.load_profile("reference")
