"""Build the library and its tests: maps -> all files in memory -> what differs in a folder -> all of it or nothing."""

import os
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from driveblocks.docs.page import Measured, Own, documents
from driveblocks.maps import catalog
from driveblocks.maps.collection import Source, read
from driveblocks.maps.problem import MapError, Refused
from driveblocks.output import links, manifest, transaction
from driveblocks.output.manifest import Manifest, State
from driveblocks.platforms import CANONICAL, TARGETS, is_yours, writers
from driveblocks.platforms.part import shelf
from driveblocks.render import library
from driveblocks.render.text import Language, told

READ = 1
"""Families whose test programs are written beside those of the shared blocks, to be read; `test` makes those of all."""
BLOCKS, PAGES = "the blocks", "the pages"
SHOWN = 20
"""Files that a refusal names; the rest are counted."""


def files(  # noqa: PLR0913, PLR0917 - what is made of what, for what, and who is told of it
    sources: list[Source],
    languages: list[Language],
    targets: Collection[str] = (CANONICAL,),
    measured: Mapping[str, Sequence[Measured]] | None = None,
    without: Collection[str] = (),
    tell: Callable[[str], None] = lambda _: None,
) -> dict[str, str]:
    """Every file of the output, path below the output folder -> text. The same input gives the same text.

    `measured`: name of a map -> what was found of one drive each, for the page of its block; `without`: extras;
    `tell` is called with what is made next: BLOCKS, PAGES, then each target.
    Raises ExportError with everything that a target cannot say.
    """
    tell(BLOCKS)
    sources = [replace(source, drive=told(source.drive, languages)) for source in sources]
    made = [*library.generic(languages)]
    for source in sources:
        made.extend(library.drive(source.path.stem, source.drive, languages))
    made = [file for file in made if file.extra not in without]
    own = {
        source.drive.prefix: Own(
            "" if catalog.is_shipped(source.path) else source.path.name, (measured or {}).get(source.path.stem, ())
        )
        for source in sources
    }
    tell(PAGES)
    drives = {source.path.stem: source.drive for source in sources}
    stock = shelf(made, drives, languages)
    units = [part.unit for part in stock.parts]
    texts = documents(made, [*drives.values()], own, targets=targets, units=units)
    if CANONICAL in targets:
        tell(CANONICAL)
        texts |= {f"{CANONICAL}/{file.path}": file.text for file in made}
        texts[f"{CANONICAL}/order.txt"] = "".join(f"{file.path}\n" for file in made)
        texts |= _tests(sources[:READ], languages)
    return texts | writers.files(stock, targets, tell)


def _tests(sources: list[Source], languages: list[Language]) -> dict[str, str]:
    from driveblocks.bench.suite import programs  # which other targets do not need

    return programs(sources, languages)


Made = Callable[[list[Source], list[Language], Collection[str], Mapping[str, Sequence[Measured]]], dict[str, str]]
"""What makes an output, as `files` does."""


@dataclass(frozen=True)
class Plan:
    """What a folder is to hold, and what of that is not so yet: path below the folder -> why."""

    sources: list[Source]
    old: Manifest
    texts: dict[str, str]
    states: dict[str, State]
    kept: tuple[str, ...] = ()
    """Files of the user's that were edited since: they stay as they are."""


@dataclass(frozen=True)
class Wanted:
    """What is asked for; `only`: not also what the folder was built from and for."""

    languages: list[Language]
    targets: Collection[str] = (CANONICAL,)
    only: bool = False
    measured: Mapping[str, Sequence[Measured]] = field(default_factory=dict)
    """By the name of a map."""


def plan(folder: Path, named: list[Path], asked: Wanted, made: Made = files) -> Plan:
    """The output of the named maps for the named targets; `made` makes it.

    Unless only those are wanted, also of the maps and for the targets that the folder was built from and for.
    Raises MapError, ExportError, Refused and OSError.
    """
    old = manifest.read(folder)
    targets = [name for name in TARGETS if name in asked.targets or (name in old.targets and not asked.only)]
    others = [] if asked.only else _others(folder, old, named)
    try:
        sources = read(sorted([*named, *others], key=lambda path: (path.stem, str(path))))
    except MapError as error:
        if others:
            there = ", ".join(map(str, others))
            error.add_note(f"{folder} was built from {there} as well; --only builds without")
        raise
    texts = _linked(made(sources, asked.languages, targets, asked.measured), folder)
    words = [_word(source.path, folder) for source in sources]
    texts[manifest.NAME] = manifest.made(words, targets, texts, folder, old).text
    states = manifest.compare(folder, old, texts)
    kept = tuple(name for name, state in states.items() if state is State.EDITED and is_yours(name))
    return Plan(sources, old, texts, {name: state for name, state in states.items() if name not in kept}, kept)


def _linked(texts: dict[str, str], folder: Path) -> dict[str, str]:
    """All files; a link leads to one of them, or to what is beside the folder, as in a checkout, or becomes words."""

    def there(path: str) -> bool:
        outside = path.removeprefix("../")
        return path in texts if outside == path else (folder.resolve().parent / outside).exists()

    return {name: links.live(name, text, there) if name.endswith(".md") else text for name, text in texts.items()}


def write(folder: Path, plan: Plan, *, force: bool = False) -> None:
    """Carry out a plan in a locked folder, or nothing of it. Raises Refused and OSError.

    With force, files of the generator that were edited since are replaced or removed, too.
    """
    foreign = {name for name, state in plan.states.items() if state is State.FOREIGN}
    edited = {name for name, state in plan.states.items() if state is State.EDITED}
    if foreign or (edited and not force):
        raise Refused(_refusal(folder, plan, sorted(foreign if force else foreign | edited)))
    emptied = sorted(set(plan.old.folders) - set(manifest.parents(plan.texts)))
    if plan.states:
        transaction.write(folder, {name: plan.texts.get(name) for name in plan.states}, emptied)


def _refusal(folder: Path, plan: Plan, names: list[str]) -> str:
    lines = [f"{folder / name}: {plan.states[name]}" for name in names[:SHOWN]]
    if len(names) > SHOWN:
        lines.append(f"and {len(names) - SHOWN} more")
    states = {plan.states[name] for name in names}
    if State.EDITED in states:
        lines.append("keep what was edited in a copy elsewhere, then build with --force, which replaces it")
    if State.FOREIGN in states:
        lines.append("move away what is in the way, or build into another folder")
    if not plan.old.files and (folder / CANONICAL).is_dir():
        lines.append(f"if an older version built {folder}, delete what it wrote there; it kept no {manifest.NAME}")
    return "\n".join([*lines, "nothing was written"])


def _others(folder: Path, old: Manifest, named: list[Path]) -> list[Path]:
    """Maps that the folder was built from and that are not named. Raises Refused for those that are gone.

    A named map takes the place of one of the same file name that is gone: it has been moved. It takes that of a
    shipped one with its file name or prefix, too.
    """
    known, stems = {path.resolve() for path in named}, {path.stem for path in named}
    built = [path for path in (_path(word, folder) for word in old.maps) if path.resolve() not in known]
    paths = [path for path in built if catalog.displacing(path, named) == path]
    if gone := [path for path in paths if not path.exists() and path.stem not in stems]:
        lines = [f"{path}: not there; {folder} was built from it as well" for path in gone]
        raise Refused("\n".join([*lines, "name the map where it is now, or build without it by --only"]))
    return [path for path in paths if path.exists()]


def _word(path: Path, folder: Path) -> str:
    """How a manifest names a map: one that is shipped by its name, another by its path from the folder."""
    whole = path.resolve()
    if catalog.is_shipped(path):
        return whole.stem
    try:
        relative = Path(os.path.relpath(whole, folder.resolve())).as_posix()
    except ValueError:  # on another drive of Windows
        return whole.as_posix()
    return relative if "/" in relative else f"./{relative}"


def _path(word: str, folder: Path) -> Path:
    """The map that a manifest names."""
    if "/" in word:
        return Path(catalog.shown((folder.resolve() / word).resolve()))
    return catalog.folder() / f"{word}.yaml"
