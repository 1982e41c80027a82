"""`driveblocks lint`: say what in an ST source one compiler or another refuses or compiles differently."""

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import click

from driveblocks.commands import FILE, refuse

if TYPE_CHECKING:
    from structured_text.language.problems import Problem
    from structured_text.language.tree import Unit


@click.command()
@click.argument(
    "files",
    nargs=-1,
    type=FILE,
    metavar="[FILE]...",
    help="ST sources that belong together; a folder means every .st file in it.",
)
@click.option(
    "--select",
    multiple=True,
    metavar="RULE",
    help="Report only this rule, by name, code or beginning of a code (ST3); may be repeated.",
)
@click.option("--ignore", multiple=True, metavar="RULE", help="Do not report this rule; may be repeated.")
@click.option(
    "--for",
    "targets",
    multiple=True,
    metavar="TARGET",
    help="Also report names that these targets of build, or all, cannot take.",
)
@click.option("--map", "maps", multiple=True, metavar="MAP", help="A map of your own, whose blocks the sources use.")
@click.option("--list", "listing", is_flag=True, help="List the rules and stop.")
@click.option("--format", "output", metavar="text|json", default="text", help="How to print the findings.")
def run(  # noqa: PLR0913, PLR0917 - one parameter per option of the command line
    files: tuple[Path, ...],
    select: tuple[str, ...],
    ignore: tuple[str, ...],
    targets: tuple[str, ...],
    maps: tuple[str, ...],
    listing: bool,
    output: str,
) -> None:
    """Find what is not portable in Structured Text.

    A finding is one line, `file:line:col: CODE rule: why; what to write instead`. The files are taken as one text:
    each may use what another declares, and the types and blocks of the installed library. Of a file that cannot be
    read or parsed only that is reported; the others are checked all the same. The exit status is 0 without findings,
    1 with findings, and 2 if a file could not be checked; standard error names it. docs/lint.md explains every rule.

    With --for, also names that the targets of build reserve are reported.

    Example: driveblocks lint --ignore case-without-else types.st blocks.st
    """
    from structured_text import files as door
    from structured_text.findings import print_problems, print_rules
    from structured_text.language.lint import Selection, UnknownRuleError, lint_sources

    if listing:
        print_rules(output)
        return
    if output not in ("text", "json"):
        refuse(f"--format is text or json, not {output}")
    if not files:
        refuse("name the files to lint, as in: driveblocks lint types.st blocks.st")
    try:
        selection = Selection.of(_split(select), _split(ignore))
    except UnknownRuleError as error:
        refuse(str(error))
    wanted = _targets(_split(targets))
    sources, unread = door.sources(files)
    library = _library(sources, maps)
    own = {path for path, _ in sources}
    found = lint_sources([*library, *sources], selection, wanted)
    problems = sorted({*(each for each in found if each.path in own), *_clashes(found, sources)})
    print_problems(problems, output)
    broken = dict.fromkeys(each.path for each in problems if each.rule in ("syntax", "long-expression"))
    unjudged = [*unread, *(f"{path}: not checked beyond its syntax" for path in broken)]
    if unjudged:
        refuse("\n".join(unjudged))
    if problems:
        sys.exit(1)


def _library(sources: list[tuple[str, str]], maps: tuple[str, ...]) -> list[tuple[str, str]]:
    """Those files of the library, by path and text, that sources need beside what they declare themselves."""
    from driveblocks.desk.run.source import known, needed
    from driveblocks.maps import catalog
    from structured_text.language.lint import Selection, lint_sources
    from structured_text.language.parser import ParseError, parse

    def parsed(path: str, text: str) -> "Unit":
        try:
            return parse(text, path)
        except ParseError as error:
            return error.unit

    named = [catalog.resolve(name) for name in maps]
    if not lint_sources(sources, Selection(frozenset({"undeclared-name", "unknown-type"}))):
        return []
    files = needed([parsed(*each) for each in sources], known(named))
    return [(f"library/{file.path}", file.text) for file in files]


def _clashes(found: "list[Problem]", sources: list[tuple[str, str]]) -> "Iterator[Problem]":
    """What of the sources has the name of a variable inside a block of the library, at its own place."""
    from structured_text.language.parser import ParseError, parse
    from structured_text.language.problems import Problem

    own = {path for path, _ in sources}
    clashes = [each for each in found if each.rule == "name-clash" and each.path not in own]
    inside = {each.text.partition(" ")[0].upper() for each in clashes}
    for path, text in sources if inside else ():
        try:
            unit = parse(text, path)
        except ParseError:
            continue
        for one in unit.elements:
            name = getattr(one, "name", "")
            if name.upper() in inside:
                line, column = unit.place(getattr(one, "name_at", one.at))
                told = (
                    f"{name} is also the name of a variable of the library, which matiec refuses: choose another name"
                )
                yield Problem(path, line, column, told, "name-clash")


def _split(words: tuple[str, ...]) -> list[str]:
    """Words given one by one or separated by commas."""
    return [each.strip() for word in words for each in word.split(",") if each.strip()]


def _targets(words: list[str]) -> list[str]:
    """The targets that the command line names."""
    from structured_text.language.reserved import TARGET_WORDS

    for word in words:
        if word not in (*TARGET_WORDS, "all"):
            refuse(f"--for knows no target {word}; write {', '.join(TARGET_WORDS)} or all")
    return list(TARGET_WORDS) if "all" in words else words
