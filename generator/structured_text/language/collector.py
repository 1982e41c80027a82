"""Python's cyclic garbage collector, which walks over a growing tree again and again and finds nothing to collect."""

import gc
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def paused() -> Iterator[None]:
    """Keep the collector off while trees are built or live to the end; it doubles the time of a large file."""
    running = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if running:
            gc.freeze()
            gc.unfreeze()  # what was made meanwhile counts as old at once: a walk over all of it would find nothing
            gc.enable()
