"""A user's program, compiled together with those blocks of the library that it names."""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache, lru_cache
from pathlib import Path

from driveblocks.maps import catalog, collection
from driveblocks.maps.collection import Source as Map
from driveblocks.maps.model import Drive
from driveblocks.platforms import PLATFORMS
from driveblocks.render import library
from driveblocks.render.text import Language, languages
from structured_text.engines.embedded import EmbeddedEngine, EmbeddedLibrary
from structured_text.engines.engine import BuildError, Message, Source
from structured_text.language.parser import ParseError, parse
from structured_text.language.tree import Program, Unit

_WORD = re.compile(r"[A-Za-z]\w*")
_UNKNOWN = re.compile(r"expected the name of a type, found ([A-Za-z]\w*_\w+)")
_ENGINE = EmbeddedEngine(strict=False)
"""It computes a REAL as PLCs do."""
_PORTS = {one.prefix for one in PLATFORMS.values()} - {"MB"}


@dataclass(frozen=True)
class Loaded:
    library: EmbeddedLibrary
    program: Program
    drives: dict[str, Drive]
    """By the prefix of their blocks, upper case."""


def load(
    path: str, text: str, maps: Sequence[Map], name: str | None = None, tell: Callable[[float], None] = lambda _: None
) -> Loaded:
    """Compile a program; `name` says which, where there are several; `tell` takes the share done. Raises BuildError."""
    try:
        files = needed([parse(text, path)], maps)
    except ParseError as error:
        raise BuildError([Message(each.path, each.line, each.column, each.text) for each in error.problems]) from error
    _ENGINE.told = tell
    built = _built((*files, Source(path, text)))
    unit = built.compiler.checked.units[-1]
    return Loaded(built, _chosen(unit, name), {each.drive.prefix.upper(): each.drive for each in maps})


@lru_cache(8)
def _built(texts: tuple[Source, ...]) -> EmbeddedLibrary:
    """The compiled texts, for any number of instances. Raises BuildError."""
    return _ENGINE.build(texts)


def advice(wrong: str) -> str:
    """What to do about a block that is not known: it is of a platform, or of a map of the user's own. Or nothing."""
    found = _UNKNOWN.search(wrong)
    if found is None:
        return ""
    prefix = found[1].partition("_")[0]
    if prefix in _PORTS:
        return f"\n{found[1]} is for a platform; take MB_ByteLine8, as in ..._MotorBytes.st of openplc/yours"
    return f"\nif {found[1]} is of a map of your own, name that by --map"


def known(named: Sequence[Path] = ()) -> list[Map]:
    """The shipped maps, and those that are named, which take the place of shipped ones. Raises MapError."""
    paths = [*(path for path in catalog.shipped() if catalog.displacing(path, named) == path), *named]
    single = {path.resolve(): path for path in reversed(paths)}
    return collection.read(sorted(single.values(), key=lambda path: path.stem))


def asked(named: Sequence[str], drives: Sequence[str]) -> list[Map]:
    """The same in words of the command line; names of drives may be paths of maps, too. Raises Refused."""
    return known([catalog.resolve(each) for each in (*named, *filter(catalog.is_path, drives))])


def meant(name: str, maps: Sequence[Map]) -> tuple[Path, Drive]:
    """The map that a name means, unless another takes its place. Raises UnknownDrive."""
    one = catalog.displacing(catalog.resolve(name), [each.path for each in maps]).resolve()
    return next((each.path, each.drive) for each in maps if each.path.resolve() == one)


def needed(units: Sequence[Unit], maps: Sequence[Map]) -> list[Source]:
    """The files of the library that texts need, in their order, but for what they declare themselves."""
    own = {getattr(each, "name", "").upper() for unit in units for each in unit.elements}
    text = "\n".join(unit.text for unit in units)
    files = [*_shared()]
    for each in (one for one in maps if re.search(rf"\b{one.drive.prefix}_", text, re.IGNORECASE)):
        files.extend(library.drive(each.path.stem, each.drive, _english()))
    there = {file.name.upper(): file for file in files if file.name.upper() not in own}
    wanted: set[str] = set()
    waiting = [text]
    while waiting:
        words = {word.upper() for word in _WORD.findall(waiting.pop())}
        new = (words & there.keys()) - wanted
        wanted |= new
        waiting += [there[word].text for word in sorted(new)]
    return [Source(f"{file.folder}/{file.name}.st", file.text) for file in files if file.name.upper() in wanted]


def _english() -> list[Language]:
    return languages(["en"], "utf-8")


@cache
def _shared() -> tuple[library.File, ...]:
    """What all drives share, rendered once."""
    return tuple(library.generic(_english()))


def _chosen(unit: Unit, name: str | None) -> Program:
    programs = [each for each in unit.elements if isinstance(each, Program)]
    found = [each for each in programs if name is None or each.name.upper() == name.upper()]
    if len(found) == 1:
        return found[0]
    names = ", ".join(each.name for each in programs)
    if not programs:
        raise BuildError([Message(unit.path, 1, 1, "there is no PROGRAM in here; write PROGRAM ... END_PROGRAM")])
    wrong = f"there is no PROGRAM {name}" if name else f"there are {len(programs)} PROGRAMs"
    places = [Message(unit.path, *unit.place(each.at), f"{wrong}; choose by --program: {names}") for each in programs]
    raise BuildError(places[:1] if name else places[1:2])
