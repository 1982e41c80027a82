"""The embedded engine: Structured Text compiled to Python.

    EmbeddedEngine(model="fail").build([Source(...)]).instance("Name").scan(now_ns)

The way of a source: `st` parses and checks it; `compiler` makes one Python function of every POU, by `statements` and
`expressions` over `ranges` of values; `runtime` holds what the functions call, model by model; `library` runs them.
"""

from driveblocks.host.embedded.engine import EmbeddedEngine
from driveblocks.host.embedded.library import EmbeddedInstance, EmbeddedLibrary

__all__ = ["EmbeddedEngine", "EmbeddedInstance", "EmbeddedLibrary"]
