"""The face that every engine shows: build sources, make instances, scan them at a given time, read their state."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from structured_text import files

# A value as Python sees it: BOOL is bool; bit strings and integers are int; REAL and LREAL are float;
# STRING is bytes; TIME is int nanoseconds; an array is a list; a structure is a dict in declaration order.
Value = bool | int | float | bytes | list["Value"] | dict[str, "Value"]


@dataclass(frozen=True)
class Source:
    """One ST file: its text and the path by which messages name it."""

    path: str
    text: str

    @classmethod
    def read(cls, path: Path) -> "Source":
        """Read a UTF-8 file. Raises BadFile."""
        return cls(str(path), files.text(path))


@dataclass(frozen=True)
class Message:
    """What a tool says about a source: 1-based line and column, 0 where the tool gave none."""

    path: str
    line: int
    column: int
    text: str

    def __str__(self) -> str:
        """Print as compilers do, `file:line:col: text`."""
        return f"{self.path}:{self.line}:{self.column}: {self.text}"


class EngineError(Exception):
    """An engine cannot do its work: not installed, crashed, timed out, or printed what nobody understands."""


class BuildError(EngineError):
    """The sources do not compile; `messages` says where and why."""

    def __init__(self, messages: Sequence[Message]) -> None:
        self.messages = tuple(messages)
        super().__init__("\n".join(str(message) for message in self.messages))


class ScanError(EngineError):
    """A scan went wrong at a line: an index out of bounds, an overflow, an endless loop."""

    def __init__(self, message: Message) -> None:
        self.message = message
        super().__init__(str(message))


class Instance(Protocol):
    """A function block or program instance. Paths are dotted and case-insensitive: `Inner.Buffer[3].Crc`."""

    def __getitem__(self, path: str) -> Value:
        """Read a variable: input, output, in-out, internal, or one of a nested instance. KeyError if unknown."""

    def __setitem__(self, path: str, value: Value) -> None:
        """Write a variable; bytes and lists fill arrays (a shorter one keeps the rest). KeyError, ValueError."""

    def scan(self, now_ns: int | None = None) -> None:
        """Run the body once with the clock at `now_ns` nanoseconds (None: as it is). Raises ScanError."""

    def state(self) -> dict[str, Value]:
        """Every scalar of the instance and of all inside it, path in upper case -> value, in declaration order."""


class Library(Protocol):
    """Compiled sources."""

    def instance(self, type_name: str) -> Instance:
        """Make a fresh instance of a function block or program. KeyError if there is none of that name."""

    def call(self, function: str, arguments: Mapping[str, Value]) -> Value:
        """Call a FUNCTION by its formal parameters. KeyError if there is none of that name; ScanError."""

    def blocks(self) -> Iterator[str]:
        """The names of the function blocks and programs, in source order."""


class Engine(Protocol):
    """A way to run ST."""

    @property
    def name(self) -> str:
        """`embedded`, `matiec-beremiz` or `matiec-openplc`."""

    def build(self, sources: Sequence[Source]) -> Library:
        """Compile the sources as one text in the given order. Raises BuildError, EngineError."""
