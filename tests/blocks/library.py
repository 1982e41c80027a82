"""The compiled blocks: one build per engine and process, and a short way to call a block or a function."""

import re
from collections.abc import Iterable, Mapping
from pathlib import Path

from driveblocks.render.library import DRIVE_TYPES, LINE_TYPES
from driveblocks.render.results import RESULTS
from structured_text.engines.engine import Engine, Instance, Library, Source, Value

BLOCKS = Path(__file__).parents[2] / "blocks" / "iec61131"
NAMES = {result.code: result.name for result in RESULTS}
"""Result code -> its name."""


class Blocks:
    """A compiled library of blocks."""

    def __init__(self, library: Library) -> None:
        """Take what an engine has built."""
        self.library = library

    def run(self, block: str, pins: Mapping[str, Value]) -> Instance:
        """A fresh instance after one scan with these pins."""
        instance = self.library.instance(block)
        return scan(instance, pins)

    def call(self, function: str, pins: Mapping[str, Value]) -> Value:
        """The result of a function."""
        return self.library.call(function, pins)


def scan(instance: Instance, pins: Mapping[str, Value]) -> Instance:
    """Set pins and scan once."""
    for name, value in pins.items():
        instance[name] = value
    instance.scan()
    return instance


def sources(folder: Path = BLOCKS) -> list[Source]:
    """The files of a library in the order that it states."""
    names = (folder / "order.txt").read_text(encoding="utf-8").split()
    return [Source(name, (folder / name).read_text(encoding="utf-8")) for name in names]


def alone(folder: Path = BLOCKS) -> list[Source]:
    """The files of what can be called by itself: all but line and drive blocks, which run against drives elsewhere."""
    types = "|".join((*LINE_TYPES, *DRIVE_TYPES))
    line = re.compile(
        rf"line/.*|vfd/V.*|device/.*|.*_(?:Drive|Reads|Orders|ParameterGate|Identity)\.st|types/(?:{types}|MB_(?:Slots|Tracks)\d+)\.st"
    )
    return [each for each in sources(folder) if not line.fullmatch(each.path)]


_BUILT: dict[tuple[str, str], Blocks] = {}


def built(engine: Engine, key: str = "", texts: Iterable[Source] = ()) -> Blocks:
    """The library on an engine, compiled once per process; `key` and `texts` for one that is not the shipped one."""
    if (engine.name, key) not in _BUILT:
        _BUILT[engine.name, key] = Blocks(engine.build(list(texts) or sources()))
    return _BUILT[engine.name, key]


def result(instance: Instance) -> str:
    """The name of an instance's result."""
    code = instance["ErrorID"]
    assert isinstance(code, int)
    return NAMES[code]


def number(instance: Instance, path: str) -> int:
    """An integer or bit string of an instance."""
    value = instance[path]
    assert isinstance(value, int)
    return value


def octets(instance: Instance, path: str, length: int) -> bytes:
    """The first bytes of an array of BYTE."""
    value = instance[path]
    assert isinstance(value, list)
    return bytes(value[:length])  # type: ignore[arg-type]


def words(instance: Instance, path: str, count: int) -> tuple[int, ...]:
    """The first words of an array of WORD."""
    value = instance[path]
    assert isinstance(value, list)
    return tuple(value[:count])  # type: ignore[arg-type]
