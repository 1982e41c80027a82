"""What a screen shows of drives at a moment."""

from contextlib import suppress
from dataclasses import dataclass

from structured_text.engines.engine import Value


@dataclass(frozen=True)
class Seen:
    name: str
    unit: int
    state: str
    asked_hz: float
    hertz: float | None
    why: str
    remedy: str = ""
    """What a person does about it; empty for nothing, or to wait."""
    most_hz: float = 0.0
    """Its maximum; 0.0 where that is not known."""


@dataclass(frozen=True)
class View:
    """All that is to be seen at a moment, in microseconds since the start."""

    at_us: int
    drives: tuple[Seen, ...]
    shown: dict[str, Value]
    inputs: dict[str, Value]
    dropped: int = 0
    port_error: str = ""


def text(value: bytes) -> str:
    """A STRING: UTF-8 where it can be, as texts of the library are, else each byte a character."""
    with suppress(UnicodeDecodeError):
        return value.decode("utf-8")
    return value.decode("latin-1")


def is_bad(state: str) -> bool:
    """Whether a state is one that nobody wants."""
    return state.startswith(("fault", "STOP", "no reply"))


def spelled(value: Value) -> str:
    """A value in the words of ST, a REAL with two places."""
    if isinstance(value, bool):
        return "TRUE" if value else "FALSE"
    if isinstance(value, float):
        return f"{value:.2f}"
    if isinstance(value, bytes):
        return text(value)
    return f"{value:d}" if isinstance(value, int) else "..."
