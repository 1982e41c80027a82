"""What can go wrong in a matiec build, beside the ST being wrong."""

from collections.abc import Sequence

from structured_text.engines.engine import BuildError, EngineError, Message


class CompilerCrashError(EngineError):
    """iec2c or the C compiler died of a signal, or gave itself up, without a message about the sources."""


class CompilerTimeoutError(EngineError):
    """iec2c or the C compiler did not end within its time limit."""


class RefusedWithCrashError(BuildError):
    """iec2c complained about the ST, and then crashed; the last message says so."""

    def __init__(self, messages: Sequence[Message], crash: str) -> None:
        """Put `crash` after the messages, at the place of the last of them."""
        last = messages[-1]
        super().__init__([*messages, Message(last.path, last.line, last.column, crash)])


class BadCError(BuildError):
    """iec2c accepted the ST, but the C that it wrote does not compile."""
