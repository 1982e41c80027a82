"""What may be there only once: keys that distinguish entries, and numbers that no two spans may share."""

from collections.abc import Callable, Iterable, Iterator
from typing import Any, TypeVar

from driveblocks.maps.form import Span
from driveblocks.maps.model import Entry
from driveblocks.maps.problem import Report, line

E = TypeVar("E", bound=Entry)
T = TypeVar("T")


def unique(
    entries: Iterable[E], key: str, what: str, report: Report, shown: Callable[[Any], str] = "`{}`".format
) -> dict[Any, E]:
    """Note every entry whose key an earlier one has; return the first entry of each key. None is no key."""
    first: dict[Any, E] = {}
    for entry in entries:
        value = getattr(entry, key)
        if value is None:
            continue
        if value in first:
            wrong = f"{what} {shown(value)} is there twice"
            report.add(entry.place(key), wrong, f"the first is in {line(first[value].at)}; keep one or correct this")
        else:
            first[value] = entry
    return first


def overlapping(spans: Iterable[tuple[Span, T]]) -> Iterator[tuple[T, T]]:
    """Pairs that share a number, the earlier of the given order first; one pair for each span that hits another."""
    ordered = sorted(((span, order, what) for order, (span, what) in enumerate(spans) if span), key=lambda one: one[:2])
    reach: tuple[Span, int, T] | None = None
    for one in ordered:
        if reach is not None and one[0].first <= reach[0].last:
            earlier, later = sorted((reach, one), key=lambda pair: pair[1])
            yield earlier[2], later[2]
        if reach is None or one[0].last > reach[0].last:
            reach = one
