"""The embedded engine: Structured Text compiled to Python.

    EmbeddedEngine().build([Source(...)]).instance("Name").scan(now_ns)

The way of a source: `st` parses and checks it; `compiler` makes one Python function of every POU, by the tables of
`statements` and `expressions`, over `ranges` of values; `runtime` holds what these functions call; `library` runs them.
Wherever compilers could differ, a scan fails rather than choose.
"""

from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.embedded.library import EmbeddedInstance, EmbeddedLibrary

__all__ = ["EmbeddedEngine", "EmbeddedInstance", "EmbeddedLibrary"]
