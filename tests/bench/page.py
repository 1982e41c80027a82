"""The page `docs/measured/performance.md`, written from the record and from nothing else."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path

from tests.bench.record import DOCS, Record
from tests.bench.sections import blocks, checksum, drives, engines, exchange, growth, summary

NAME = "performance.md"
HEAD = """# Performance

Written by `make bench` from one run; the figures are in [`performance.json`](performance.json). Nanoseconds belong to
the machine; ratios and counts say more. A time in nanoseconds is the least of many short rounds of the same work, so
that caches are warm; the forms of one program take turns. A run without matiec, valgrind or pymodbus says so, and
keeps the figures that need them as they were.
"""
UNKNOWN = "Not measured yet.\n"


def write(record: Record, folder: Path = DOCS) -> None:
    """Write the page."""
    (folder / NAME).write_text(page(record), encoding="utf-8", newline="\n")


def page(record: Record) -> str:
    """The text of the page."""
    return "\n".join(_page(record)).rstrip("\n") + "\n"


def _page(record: Record) -> Iterator[str]:
    yield HEAD
    yield from _machine(record)
    yield from ("## In short", "", *summary.section(record))
    yield from ("## CRC", "", *_part(record, ["crc"], checksum.section))
    yield from ("## A request and its reply", "", *_part(record, ["exchange"], exchange.section))
    yield from ("## Decoders and encoders", "", *_part(record, ["times"], blocks.decoding))
    yield from ("## Every block", "", *_part(record, ["instructions", "memory", "times"], blocks.instructions))
    yield from ("## Drive blocks on a line", "", *_part(record, ["drives"], drives.section))
    yield from ("## Building", "", *_part(record, ["growth"], growth.section))
    yield from ("## Engines", "", *_part(record, ["engines"], engines.section))
    yield from _part(record, ["front end"], engines.front_end)


def _part(record: Record, names: list[str], section: Callable[..., Iterable[str]]) -> Iterator[str]:
    """A section from its parts, and their machine where it is not that of the page."""
    if any(name not in record for name in names):
        yield UNKNOWN
        return
    yield from section(*(record[name].rows for name in names))
    usual = _usual(record)
    for name in names:
        other = {key: said for key, said in record[name].machine.items() if usual.get(key) != said}
        if other:
            yield f"Measured in another run ({name}): {', '.join(f'{key} {said}' for key, said in other.items())}.\n"


def _usual(record: Record) -> Mapping[str, str]:
    return next(iter(record.values())).machine if record else {}


def _machine(record: Record) -> Iterator[str]:
    for key, said in _usual(record).items():
        yield f"- {key}: {said}"
    yield ""
