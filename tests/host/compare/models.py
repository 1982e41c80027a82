"""The embedded engine under each of its models, and as the double of a line of matiec."""

from driveblocks.host.embedded import EmbeddedEngine
from driveblocks.host.engine import Engine, Overflow

MODELS: tuple[Overflow, ...] = ("c", "standard", "fail")


def double(matiec: Engine) -> EmbeddedEngine:
    """The embedded engine in C's model, following the line of a matiec engine (`matiec-beremiz`, `matiec-openplc`)."""
    return EmbeddedEngine(model="c", line=matiec.name.partition("-")[2])
