"""What commissioning works with, and what it finds out: a line, a person, and the findings about one drive."""

from dataclasses import dataclass, field
from typing import Literal, Protocol

from rich.console import RenderableType

from driveblocks.desk.exchange import Quality
from driveblocks.desk.master import Master
from driveblocks.meaning.serial import character

Trouble = Literal[
    "silent", "half", "echo", "damaged", "family", "identity", "two", "foreign", "noise", "slow", "refused", "lost",
    "bound",
]  # fmt: skip
"""What is wrong with a line or a drive, as far as the bytes show it."""
Tens = Literal["1", "0.1", "0.01", "0.001", "0.0001"]
"""A scale of `VFD_Settings` that was found out."""


@dataclass(frozen=True)
class Way:
    """How a line is spoken on."""

    rate: int
    form: str = "8N1"
    mode: Literal["rtu", "ascii"] = "rtu"

    @property
    def character_us(self) -> float:
        """Time of a character on the wire."""
        return 1_000_000 * character(self.form).bits / self.rate

    def __str__(self) -> str:
        """For a person."""
        return f"{self.rate} bit/s {self.form} {self.mode.upper()}"


class Line(Protocol):
    """A line that one person speaks on, with its time."""

    def now_us(self) -> int:
        """The time."""

    def tune(self, way: Way) -> bool:
        """Take another rate, format and mode; whether the port can."""

    @property
    def master(self) -> Master:
        """Who asks on it. Raises OSError for a port that has gone."""

    def hear(self, for_us: int) -> bytes:
        """What comes by itself: from its first byte on until nothing has come for 20 ms. Raises OSError."""


class Asker(Protocol):
    """A person."""

    def ask(self, key: str, text: str) -> str:
        """The answer to a question, without blanks around it; empty: skipped. `key` is the step's or the gap's name."""

    def say(self, what: RenderableType) -> None:
        """A text or a table to read."""

    def progress(self, done: float, total: float, text: str) -> None:
        """How far a step has come."""


@dataclass(frozen=True)
class Fault:
    """What is wrong, in words, and what to look at."""

    kind: Trouble
    text: str
    look: str = ""


@dataclass(frozen=True)
class Set:
    """A setting of the keypad that the map needs; `read` is None where the map has no register for it."""

    id: str
    name: str
    read: int | None
    must: tuple[int, ...]
    """What it may be; empty where anything serves that the PLC also uses."""
    why: str
    told: str = ""
    """What a person has answered."""

    @property
    def differs(self) -> bool:
        """Whether it was read and is not what it must be."""
        return self.read is not None and self.must != () and self.read not in self.must


@dataclass(frozen=True)
class Measured:
    """Times in ms, as seen at the adapter."""

    reads: int
    longest_ms: int
    gap_ms: int | None
    """Shortest pause after a reply, of those tried, after which the drive has always answered."""
    words: int
    """Longest read that was answered."""
    unlisted: str
    """What a read of a register that the map does not list is answered by: `refused`, `words`, `no reply`, or `not
    tried`."""

    @property
    def turn_round_ms(self) -> int:
        """`TurnRoundMs`, as a drive block learns it."""
        return max(50, 2 * self.longest_ms + 20)

    @property
    def longest_reply_ms(self) -> int:
        """`LongestMs`."""
        return max(500, 4 * self.longest_ms)


@dataclass(frozen=True)
class Answer:
    """What a person has said about a gap, and the word that was read at that moment."""

    gap: str
    answer: str
    word: int | None = None
    gives: str = ""
    """Field of `VFD_Settings`."""
    value: str = ""
    """Its value; empty where answer and word do not agree on one."""


@dataclass
class Found:
    """What was found out about one drive; it grows with each step."""

    way: Way | None = None
    unit: int | None = None
    family: str = ""
    """Whether the drive is of the map's family: `identity`; without one `fits`, or `unknown` where it answers all."""
    evidence: list[str] = field(default_factory=list)
    """What speaks for the family and against it, each with its frame."""
    quality: Quality | None = None
    """Of the line, since the drive was found."""
    plate: str = ""
    faults: list[Fault] = field(default_factory=list)
    settings: list[Set] = field(default_factory=list)
    measured: Measured | None = None
    answers: list[Answer] = field(default_factory=list)
    tried: list[str] = field(default_factory=list)
    done: list[str] = field(default_factory=list)
    """Steps that were finished."""
    skipped: list[str] = field(default_factory=list)
    """Steps and questions that a person has passed over."""
    ended: str = ""
    """Why it did not come to its end; empty while it goes on, or if it has."""
