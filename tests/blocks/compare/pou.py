"""The functions and function blocks of the library as what can be scanned: pins, types, and the values they name.

A function cannot be scanned, so that a block of one call is written around each.
"""

from __future__ import annotations

import functools
import hashlib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from tests.blocks.compare.landmark import Arm, arms, callees, literals
from tests.blocks.compare.leaf import Leaf, leaves
from tests.blocks.library import alone

from structured_text.engines.engine import Source
from structured_text.language import tree
from structured_text.language.checker import check
from structured_text.language.lexer import tokenize
from structured_text.language.parser import parse
from structured_text.language.tree import Array, Block, Checked, Direction, Parameter, Struct
from structured_text.language.types import Elementary, Kind, Type

AROUND = "around.st"
"""The source that holds the blocks around functions."""

_AROUND = """
FUNCTION_BLOCK {name}_Scan
VAR_INPUT
{inputs}
END_VAR
VAR_OUTPUT
  Result : {result};
END_VAR
  Result := {name}({arguments});
END_FUNCTION_BLOCK
"""


@dataclass(frozen=True)
class Pin:
    """An input or in-out, or a field of one that is a structure; `path` as an engine's instance takes it."""

    path: str
    kind: Type

    @property
    def length(self) -> int:
        """Elements of an array; 0 for a scalar."""
        return self.kind.length if isinstance(self.kind, Array) else 0

    @property
    def span(self) -> tuple[int, int]:
        """Least and greatest value of an integer or bit string, or of an array's elements. TypeError for others."""
        kind = self.kind.element if isinstance(self.kind, Array) else self.kind
        if isinstance(kind, Elementary) and kind.kind in (Kind.BITS, Kind.INTEGER):
            return kind.low, kind.high
        raise TypeError(f"{self.path} is a {kind}")


@dataclass(frozen=True)
class Pou:
    """A block or function of the library.

    `block` is what is instantiated: itself, or the block around a function. `folder`: where its file stands.
    `leaves`: the state of `block`. `whole` and `real`: the literals of its statements and of all that it calls.
    `arms`: see there. `digest`: of its text and of all that it uses, without comments.
    """

    name: str
    block: str
    folder: str
    pins: tuple[Pin, ...]
    leaves: tuple[Leaf, ...]
    whole: tuple[int, ...]
    real: tuple[float, ...]
    arms: tuple[Arm, ...]
    digest: str

    def of_kind(self, *kinds: Kind) -> tuple[Pin, ...]:
        """The scalar pins of some kinds."""
        return tuple(pin for pin in self.pins if pin.kind.kind in kinds)

    @property
    def arrays(self) -> tuple[Pin, ...]:
        """The pins that are arrays."""
        return tuple(pin for pin in self.pins if pin.length)


@dataclass(frozen=True)
class Text:
    """A library to compare: its sources with the blocks around functions, and its POUs by name, callees first."""

    sources: tuple[Source, ...]
    pous: Mapping[str, Pou]


@functools.cache
def shipped() -> Text:
    """The library as it is shipped."""
    return read(alone())


def read(texts: Sequence[Source]) -> Text:
    """Read the sources of a library. Raises SourceError for what is no good ST."""
    functions = check([parse(each.text, each.path) for each in texts]).functions
    around = Source(AROUND, "".join(_around(each) for each in functions.values()))
    whole = (*texts, around)
    checked = check([parse(each.text, each.path) for each in whole])
    found = [each for each in checked.callees_first if _path(each) != AROUND]
    return Text(whole, {each.name: _pou(checked, each) for each in found})


def _pou(checked: Checked, found: tree.Function | tree.FunctionBlock) -> Pou:
    block = f"{found.name}_Scan" if isinstance(found, tree.Function) else found.name
    kind = _type(checked.blocks[block.upper()])
    numbers = literals(found)
    return Pou(
        name=found.name,
        block=block,
        folder=_path(found).partition("/")[0],
        pins=tuple(pin for each in kind.parameters.values() for pin in _pins(each)),
        leaves=tuple(leaves(kind)),
        whole=tuple(sorted({one for one in numbers if isinstance(one, int)})),
        real=tuple(sorted({one for one in numbers if isinstance(one, float)})),
        arms=tuple(arms(found.body)),
        digest=_digest(checked, found),
    )


def _type(block: tree.FunctionBlock) -> Block:
    assert block.type is not None
    return block.type


def _path(pou: tree.Pou) -> str:
    assert pou.unit is not None
    return pou.unit.path


def _pins(parameter: Parameter) -> Iterator[Pin]:
    if parameter.direction is Direction.OUTPUT:
        return
    if isinstance(parameter.type, Struct):
        for each in parameter.type.fields.values():
            yield Pin(f"{parameter.name}.{each.name}", each.type)
    else:
        yield Pin(parameter.name, parameter.type)


def _around(function: tree.Function) -> str:
    names = [each.name for each in function.parameters.values()]
    return _AROUND.format(
        name=function.name,
        inputs="\n".join(f"  {each.name} : {each.type};" for each in function.parameters.values()),
        result=function.type,
        arguments=", ".join(f"{name} := {name}" for name in names),
    )


def _digest(checked: Checked, pou: tree.Function | tree.FunctionBlock) -> str:
    units = {_path(each): each.unit for each in callees(pou)}
    units |= {each.path: each for each in checked.units if each.path.startswith("types/")}
    tokens = [tokenize(unit.text).texts for _, unit in sorted(units.items()) if unit is not None]
    return hashlib.sha256(repr(tokens).encode()).hexdigest()[:16]
