"""What a driver in C must know of each block and function: its pins by direction and C type, and telling numbers.

The C types are those of POUS.h, the directions those of the ST; `read only` in the comment of an in-out is a promise
of the block, which the drivers hold it to.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from tests.blocks.library import alone

from structured_text.engines.engine import Source
from structured_text.engines.matiec import MatiecEngine
from structured_text.engines.matiec.declarations import Unit, read_declarations
from structured_text.engines.matiec.header import ArrayType, Block, CType, Function, Header, StructType, read_header

DIRECTIONS = {"VAR_INPUT": "in", "VAR_OUTPUT": "out", "VAR_IN_OUT": "inout"}
_READ_ONLY = re.compile(r"^  (\w+) : \w+;\s*\(\*[^*]*read only", re.MULTILINE)
_UNIT = re.compile(r"^FUNCTION(?:_BLOCK)? (\w+)", re.MULTILINE)
_NUMBER = re.compile(r"(?<![\w.#])(?:\w+#16#([0-9A-F]+)|(\d+)(?![\w.#]))")
_REAL = re.compile(r"(?<![\w.])-?\d+\.\d+(?:E[+-]?\d+)?")
_WORD = re.compile(r"\w+")
_COMMENT = re.compile(r"\(\*.*?\*\)", re.DOTALL)


@dataclass(frozen=True)
class Pin:
    """A parameter by its name in C; `type` is the C type, `shape` what POUS.h says of a type that the ST declares."""

    name: str
    type: str
    direction: str
    shape: CType | None = None
    read_only: bool = False


@dataclass(frozen=True)
class Pou:
    """A block (`result` is None) or function: pins in the order of the C, and numbers in its text and its callees'."""

    name: str
    pins: tuple[Pin, ...]
    result: str | None
    members: tuple[str, ...]
    """Blocks: the variables that are held with a byte of flags."""
    words: tuple[int, ...]
    reals: tuple[float, ...]

    @property
    def c_name(self) -> str:
        """The name in C."""
        return self.name.upper()

    def pin(self, name: str) -> Pin | None:
        """A pin by its name in C."""
        return next((each for each in self.pins if each.name == name), None)


def pous(engine: MatiecEngine, texts: list[Source] | None = None) -> list[Pou]:
    """Every block and function of the library (or of other ST), in its order. Raises what building it raises."""
    texts = texts or alone()
    header = read_header((Path(engine.build(texts).folder) / "POUS.h").read_text(encoding="utf-8"))
    return list(_Reader(header, "\n".join(each.text for each in texts)).read())


class _Reader:
    """Puts together what POUS.h and the ST say."""

    def __init__(self, header: Header, text: str) -> None:
        self._header = header
        self._units = read_declarations(text).units
        starts = [*_UNIT.finditer(text)]
        ends = [*(match.start() for match in starts[1:]), len(text)]
        self._texts = {match[1]: text[match.start() : end] for match, end in zip(starts, ends, strict=True)}
        self._bodies = {name: _body(own) for name, own in self._texts.items()}

    def read(self) -> Iterator[Pou]:
        for unit in self._units.values():
            name = unit.name.upper()
            if name in self._header.blocks:
                yield self._block(unit, self._header.blocks[name])
            elif name in self._header.functions:
                yield self._function(unit, self._header.functions[name])

    def _block(self, unit: Unit, block: Block) -> Pou:
        fixed = {name.upper() for name in _READ_ONLY.findall(self._texts[unit.name])}
        pins, members = [], []
        for member in block.members:
            variable = unit.variables.get(member.name)
            direction = DIRECTIONS.get(variable.section) if variable else None
            shape = self._header.types.get(member.type)
            if direction:
                pins.append(Pin(member.name, member.type, direction, shape, member.name in fixed))
            if member.type not in self._header.blocks:
                members.append(member.name)
        return Pou(unit.name, tuple(pins), None, tuple(members), *self._numbers(unit.name))

    def _function(self, unit: Unit, function: Function) -> Pou:
        pins = tuple(Pin(name, type_, "in") for type_, name, _ in function.parameters)
        return Pou(unit.name, pins, function.result, (), *self._numbers(unit.name))

    def _numbers(self, name: str) -> tuple[tuple[int, ...], tuple[float, ...]]:
        """16-bit and real literals of a unit and of those it calls, but for tables."""
        seen, waiting = {name}, [name]
        while waiting:
            called = self._bodies.keys() & set(_WORD.findall(self._bodies[waiting.pop()])) - seen
            seen |= called
            waiting += sorted(called)
        reached = "\n".join(self._bodies[each] for each in sorted(seen))
        words = {int(hexa, 16) if hexa else int(decimal) for hexa, decimal in _NUMBER.findall(reached)}
        near = sorted({n + more for n in words for more in (-1, 0, 1) if 0 <= n + more <= 0xFFFF})
        return tuple(near), tuple(sorted({float(each) for each in _REAL.findall(reached)}))


def _body(text: str) -> str:
    """A unit's text without comments and constants."""
    plain = _COMMENT.sub("", text)
    before, _, behind = plain.partition("VAR CONSTANT")
    return before + behind.partition("END_VAR")[2]


def arrays(pin: Pin) -> tuple[str, int] | None:
    """Element type and length of a one-dimensional array pin."""
    return (pin.shape.base, pin.shape.lengths[0]) if isinstance(pin.shape, ArrayType) else None


def fields(pin: Pin) -> tuple[tuple[str, str], ...]:
    """(C type, name) of each field of a structure pin."""
    return pin.shape.fields if isinstance(pin.shape, StructType) else ()
