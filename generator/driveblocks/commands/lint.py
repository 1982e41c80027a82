"""`driveblocks lint`: say what in an ST source one compiler or another refuses or compiles differently."""

import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from driveblocks import console

if TYPE_CHECKING:
    from driveblocks.st.problems import Problem
    from driveblocks.st.tree import Unit

# A source of more is no source; the largest library in public use has a tenth of it.
MOST_BYTES = 8 << 20

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
    1 with findings, and 2 if a file could not be judged; standard error names it. docs/lint.md explains every rule.

    With --for, also names that the targets of build reserve are reported.

    Example: driveblocks lint --ignore case-without-else types.st blocks.st
    """
    from driveblocks.st.lint import Selection, UnknownRuleError, lint_sources

    if listing:
        _list(output)
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
    sources, unread = _read(files or [])
    library = _library(sources, maps)
    own = {path for path, _ in sources}
    problems = [each for each in lint_sources([*library, *sources], selection, wanted) if each.path in own]
    _print(problems, output)
    broken = dict.fromkeys(each.path for each in problems if each.rule in ("syntax", "long-expression"))
    unjudged = [*unread, *(f"{path}: not judged beyond its syntax" for path in broken)]
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
    from driveblocks.st.lint import Selection, lint_sources
    from driveblocks.st.parser import ParseError, parse

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
    from driveblocks.st.reserved import TARGET_WORDS

    for word in words:
        if word not in (*TARGET_WORDS, "all"):
            _stop(f"--for knows no target {word}; write {', '.join(TARGET_WORDS)} or all")
    return list(TARGET_WORDS) if "all" in words else words


def _read(named: list[Path]) -> tuple[list[tuple[str, str]], list[str]]:
    """The text of every file by its name, and what cannot be read, with the reason."""
    sources: list[tuple[str, str]] = []
    bad: list[str] = []
    for path in dict.fromkeys(file for each in named for file in _files(each, bad)):
        try:
            sources.append((console.name(path), _text(path)))
        except (OSError, ValueError) as error:
            bad.append(f"{console.name(path)}:1:1: {_reason(error)}")
    return sources, bad


def _files(path: Path, bad: list[str]) -> list[Path]:
    """A file, or the sources in a folder and below, hidden folders left out, in the order of their names."""
    if not os.path.isdir(path):  # noqa: PTH112 - Path.is_dir raises for a name that is too long
        return [path]
    found: list[Path] = []

    def told(error: OSError) -> None:
        bad.append(f"{console.name(error.filename)}:1:1: {_reason(error)}")

    for folder, inner, names in os.walk(path, onerror=told):
        inner[:] = sorted(each for each in inner if not each.startswith("."))
        found += [Path(folder, each) for each in names if each.lower().endswith(".st")]
    if not found:
        bad.append(f"{console.name(path)}:1:1: expected .st files in this folder, found none")
    pipes = [each for each in found if each.exists() and not each.is_file()]
    bad += [f"{console.name(each)}:1:1: expected a file, found a pipe or device" for each in sorted(pipes)]
    return sorted(each for each in found if each not in pipes)


def _text(path: Path) -> str:
    """The text of one file. Raises OSError, or ValueError saying why it is no source."""
    if path.exists() and not path.is_file():
        raise ValueError("expected a file, found a pipe or device")
    with path.open("rb") as stream:
        data = stream.read(MOST_BYTES + 1)
    if len(data) > MOST_BYTES:
        raise ValueError(f"expected at most {MOST_BYTES >> 20} MiB of text, found more")
    if b"\0" in data:
        raise ValueError("expected text, found a binary file")
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise ValueError(
            f"expected UTF-8, found the byte {data[error.start]:02X}H in line {line}: save it as UTF-8"
        ) from None


def _reason(error: Exception) -> str:
    """Why a file cannot be read, in words."""
    if isinstance(error, OSError):
        return f"cannot be read: {error.strerror or error}"
    return str(error)


def _print(problems: list["Problem"], output: str) -> None:
    """Print the findings."""
    from driveblocks.st.rules import RULES

    if output == "json":
        rows = [
            {
                "path": each.path,
                "line": each.line,
                "column": each.column,
                "code": RULES[each.rule].code,
                "rule": each.rule,
                "message": each.text,
            }
            for each in problems
        ]
        typer.echo(json.dumps(rows, indent=2, ensure_ascii=False))
        return
    for each in problems:
        code = RULES[each.rule].code
        typer.echo(f"{each.path}:{each.line}:{each.column}: {code} {each.rule}: {each.text}")


def _list(output: str) -> None:
    """Print every rule."""
    from driveblocks.st.rules import RULES

    if output == "json":
        rows = [{"code": rule.code, "rule": rule.name, "summary": rule.summary} for rule in RULES.values()]
        typer.echo(json.dumps(rows, indent=2))
        return
    for rule in RULES.values():
        typer.echo(f"{rule.code}  {rule.name:<22} {rule.summary}")
