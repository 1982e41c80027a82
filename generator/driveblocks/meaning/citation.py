"""Where a fact is stated: the document, the place in it, and the place in the map."""

from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class Citation:
    """A place in a document; None is the manual itself."""

    document: str | None
    source: str
    place: tuple[int, int] = field(default=(0, 0), compare=False, repr=False)
    """Line and column of the map."""


def cited(fact: Any) -> Citation:
    """Where an entry of a map is stated."""
    return Citation(fact.document, fact.source, fact.at)
