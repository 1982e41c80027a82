"""What the C of iec2c declares: types, function blocks, programs, functions and what a CONFIGURATION holds.

`POUS.h`, and the headers of matiec's library for the standard blocks, declare everything by a handful of macros in a
fixed form, so they are read line by line and not as C.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from enum import Enum
from functools import lru_cache
from pathlib import Path

from structured_text.files import data


@dataclass(frozen=True)
class ArrayType:
    """`typedef struct { base table[n][m]; } name;` - the C knows lengths, not the bounds of the ST."""

    base: str
    lengths: tuple[int, ...]


@dataclass(frozen=True)
class StructType:
    """A structure: (C type, name) of each field."""

    fields: tuple[tuple[str, str], ...]


@dataclass(frozen=True)
class EnumType:
    """An enumeration; the names without the type's prefix."""

    names: tuple[str, ...]


@dataclass(frozen=True)
class AliasType:
    """Another name for a type: a subrange, an alias, or either with an initial value of its own."""

    base: str


CType = ArrayType | StructType | EnumType | AliasType


class Storage(Enum):
    """How a block holds a variable."""

    VALUE = "__DECLARE_VAR"  # struct {value; flags}
    POINTER = "__DECLARE_EXTERNAL"  # struct {*value; flags}: VAR_EXTERNAL
    BLOCK_POINTER = "__DECLARE_EXTERNAL_FB"  # a plain pointer: VAR_EXTERNAL of a block type
    LOCATED = "__DECLARE_LOCATED"  # struct {*value; flags}: AT %...
    BLOCK = ""  # the block itself


@dataclass(frozen=True)
class Member:
    """A variable of a block. `interface`: an input, output or in-out."""

    name: str
    type: str
    storage: Storage
    interface: bool


@dataclass(frozen=True)
class Block:
    """A function block or program by its C name."""

    name: str
    members: tuple[Member, ...]


@dataclass(frozen=True)
class Function:
    """A function: its result type, and (C type, name, by pointer) of each parameter after EN and ENO."""

    name: str
    result: str
    parameters: tuple[tuple[str, str, bool], ...]


@dataclass
class Header:
    """All declarations of a header by C name, in its order."""

    types: dict[str, CType] = field(default_factory=dict)
    blocks: dict[str, Block] = field(default_factory=dict)
    functions: dict[str, Function] = field(default_factory=dict)


_DECLARATION = re.compile(
    r"""^__DECLARE_ARRAY_TYPE\((?P<array>\w+),(?P<base>\w+),(?P<lengths>(?:\[\d+\])+)\)
    | ^__DECLARE_STRUCT_TYPE\((?P<struct>\w+),(?P<fields>[^()]*)\)
    | ^__DECLARE_ENUMERATED_TYPE\((?P<enum>\w+),(?P<names>[^()]*)\)
    | ^__DECLARE_DERIVED_TYPE\((?P<alias>\w+),(?P<of>\w+)\)
    | ^typedef\ struct\ \{\n(?P<members>[^{}]*)\}\ (?P<block>\w+);
    | ^//\ FUNCTION\n(?P<result>\w+)\ (?P<function>\w+)\((?P<parameters>[^()]*)\);""",
    re.MULTILINE | re.VERBOSE,
)
_MEMBER = re.compile(
    r"^\s*(?P<macro>__DECLARE_\w+)\((?P<type>\w+),\s*(?P<name>\w+)\)|^\s*(?P<fb>\w+) (?P<instance>\w+);"
)
_FIELD = re.compile(r"(\w+)\s+(\w+)\s*;")
_PARAMETER = re.compile(r"(\w+) (\*?)(\w+)")


def read_header(text: str) -> Header:
    """Read POUS.h, or a header of standard blocks. What is in no known form is left out."""
    header = Header()
    for match in _DECLARATION.finditer(text):
        if name := match["array"]:
            lengths = tuple(int(each) for each in re.findall(r"\d+", match["lengths"]))
            header.types[name] = ArrayType(match["base"], lengths)
        elif name := match["struct"]:
            header.types[name] = _struct(match["fields"])
        elif name := match["enum"]:
            header.types[name] = EnumType(tuple(each.partition("__")[2] for each in re.findall(r"\w+", match["names"])))
        elif name := match["alias"]:
            header.types[name] = AliasType(match["of"])
        elif name := match["block"]:
            header.blocks[name] = Block(name, tuple(_members(match["members"])))
        else:
            header.functions[match["function"]] = _function(match)
    return header


def _struct(fields: str) -> StructType | AliasType:
    pairs = _FIELD.findall(fields)
    return StructType(tuple(pairs)) if pairs else AliasType(fields.strip())


def _members(text: str) -> Iterator[Member]:
    interface = False
    for line in text.splitlines():
        if "//" in line:
            interface = "Interface" in line
        elif match := _MEMBER.match(line):
            if match["macro"]:
                yield Member(match["name"], match["type"], Storage(match["macro"]), interface)
            else:
                yield Member(match["instance"], match["fb"], Storage.BLOCK, interface)


def _function(match: re.Match[str]) -> Function:
    parameters = []
    for type_name, star, name in _PARAMETER.findall(match["parameters"]):
        plain = name.removeprefix("__") if star else name
        if plain not in ("EN", "ENO"):
            parameters.append((type_name, plain, bool(star)))
    return Function(match["function"], match["result"], tuple(parameters))


@lru_cache
def read_standard_blocks(folder: Path) -> dict[str, Block]:
    """The blocks that matiec's own headers define, by name. Raises OSError."""
    found: dict[str, Block] = {}
    for file in sorted(folder.glob("*FB.h")):
        for name, block in read_header(data(file).decode(errors="replace")).blocks.items():
            found.setdefault(name, block)
    return found


@dataclass(frozen=True)
class ConfigurationC:
    """What iec2c wrote of a CONFIGURATION and its resources: files, and the C type of each global by its name."""

    files: tuple[str, ...]
    globals: dict[str, str]


_CONFIGURATION = re.compile(r"^// (?:CONFIGURATION|RESOURCE) ", re.MULTILINE)
_GLOBAL = re.compile(r"^__DECLARE_GLOBAL(?:_FB|_LOCATED)?\((\w+),\w+,(\w+)\)", re.MULTILINE)
_LOCATION = re.compile(r"__LOCATED_VAR\((\w+),(\w+),")


def read_configuration(folder: Path) -> ConfigurationC:
    """Read the files of the CONFIGURATION; none where the sources have none. Raises OSError."""
    texts = {file.name: data(file).decode(errors="replace") for file in sorted(folder.glob("*.c"))}
    own = {name: text for name, text in texts.items() if _CONFIGURATION.search(text)}
    return ConfigurationC(tuple(own), {name: kind for text in own.values() for kind, name in _GLOBAL.findall(text)})


def read_locations(folder: Path) -> dict[str, str]:
    """C type by C name of every place that an AT names. Raises OSError."""
    file = folder / "LOCATED_VARIABLES.h"
    text = data(file).decode(errors="replace") if file.is_file() else ""
    return {name: type_name for type_name, name in _LOCATION.findall(text)}
