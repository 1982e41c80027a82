"""One thing that differs, and how much it matters to a PLC project."""

from dataclasses import dataclass
from enum import Enum


class Kind(Enum):
    """How much a change matters, the worst first; the value is the heading of its list."""

    BREAKS = "no longer compiles where it is used"
    ACTS = "acts differently"
    NEW = "is new"
    WORDS = "only words differ"


@dataclass(frozen=True)
class Change:
    """What differs: `where` names it, `what` says old and new."""

    kind: Kind
    where: str
    what: str

    def __str__(self) -> str:
        """As a line of a list."""
        return f"{self.where}: {self.what}"
