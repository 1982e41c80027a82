"""`driveblocks lint`: say what in an ST source one compiler or another refuses or compiles differently."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from structured_text.language.tree import Unit

Files = Annotated[
    list[Path] | None,
    typer.Argument(metavar="FILE", help="ST sources that belong together; a folder means every .st file in it."),
]
Select = Annotated[
    list[str] | None,
    typer.Option(help="Report only this rule, by name, code or beginning of a code (ST3); may be repeated."),
]
Ignore = Annotated[list[str] | None, typer.Option(help="Do not report this rule; may be repeated.")]
For = Annotated[
    list[str] | None,
    typer.Option("--for", metavar="TARGET", help="Also report names that these targets of build, or all, cannot take."),
]
Maps = Annotated[
    list[str] | None, typer.Option("--map", metavar="MAP", help="A map of your own, whose blocks the sources use.")
]
Listing = Annotated[bool, typer.Option("--list", help="List the rules and stop.")]
Format = Annotated[str, typer.Option("--format", metavar="text|json", help="How to print the findings.")]


def run(  # noqa: PLR0913, PLR0917 - one parameter per option of the command line
    files: Files = None,
    select: Select = None,
    ignore: Ignore = None,
    targets: For = None,
    maps: Maps = None,
    listing: Listing = False,
    output: Format = "text",
) -> None:
    """Find what is not portable in Structured Text.

    A finding is one line, `file:line:col: CODE rule: why; what to write instead`. The files are taken as one text:
    each may use what another declares, and the types and blocks of the installed library. Of a file that cannot be
    read or parsed only that is reported; the others are checked all the same. The exit status is 0 without findings,
    1 with findings, and 2 if a file could not be checked; standard error names it. docs/lint.md explains every rule.

    With --for, also names that the targets of build reserve are reported.

    Example: driveblocks lint --ignore case-without-else types.st blocks.st
    """
    from structured_text.files import read
    from structured_text.findings import print_problems, print_rules
    from structured_text.language.lint import Selection, UnknownRuleError, lint_sources

    if listing:
        print_rules(output)
        return
    if output not in ("text", "json"):
        _stop(f"--format is text or json, not {output}")
    if not files:
        _stop("name the files to lint, as in: driveblocks lint types.st blocks.st")
    try:
        selection = Selection.of(_split(select), _split(ignore))
    except UnknownRuleError as error:
        _stop(str(error))
    wanted = _targets(_split(targets))
    sources, unread = read(files or [])
    library = _library(sources, maps)
    own = {path for path, _ in sources}
    problems = [each for each in lint_sources([*library, *sources], selection, wanted) if each.path in own]
    print_problems(problems, output)
    broken = dict.fromkeys(each.path for each in problems if each.rule in ("syntax", "long-expression"))
    unjudged = [*unread, *(f"{path}: not checked beyond its syntax" for path in broken)]
    if unjudged:
        _stop("\n".join(unjudged))
    if problems:
        raise typer.Exit(1)


def _stop(text: str) -> None:
    """End with the status for bad input."""
    typer.echo(text, err=True)
    raise typer.Exit(2)


def _library(sources: list[tuple[str, str]], maps: list[str] | None) -> list[tuple[str, str]]:
    """Those files of the library, by path and text, that sources need beside what they declare themselves."""
    from driveblocks.maps import catalog
    from driveblocks.maps.problem import MapError
    from driveblocks.plc.source import known, needed
    from structured_text.language.lint import Selection, lint_sources
    from structured_text.language.parser import ParseError, parse

    def parsed(path: str, text: str) -> "Unit":
        try:
            return parse(text, path)
        except ParseError as error:
            return error.unit

    try:
        named = [catalog.resolve(name) for name in maps or ()]
        if not lint_sources(sources, Selection(frozenset({"undeclared-name", "unknown-type"}))):
            return []
        files = needed([parsed(*each) for each in sources], known(named))
    except (catalog.UnknownDrive, MapError) as error:
        _stop(str(error))
    return [(f"library/{file.path}", file.text) for file in files]


def _split(words: list[str] | None) -> list[str]:
    """Words given one by one or separated by commas."""
    return [each.strip() for word in words or [] for each in word.split(",") if each.strip()]


def _targets(words: list[str]) -> list[str]:
    """The targets that the command line names."""
    from structured_text.language.reserved import TARGET_WORDS

    for word in words:
        if word not in (*TARGET_WORDS, "all"):
            _stop(f"--for knows no target {word}; write {', '.join(TARGET_WORDS)} or all")
    return list(TARGET_WORDS) if "all" in words else words
