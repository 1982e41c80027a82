"""Which engines are compared with each other."""

from structured_text.engines.discovery import EMBEDDED
from structured_text.engines.embedded import EmbeddedEngine
from structured_text.engines.engine import Engine


def beside(matiec: Engine) -> dict[str, Engine]:
    """A line of matiec, whose state has more in it, and the embedded engine."""
    return {matiec.name: matiec, EMBEDDED: EmbeddedEngine()}
