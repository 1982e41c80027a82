"""`driveblocks lint`: say what in an ST source one compiler or another refuses or compiles differently."""

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from driveblocks.st.problems import Problem

# A source of more is no source; the largest library in public use has a tenth of it.
MOST_BYTES = 8 << 20

Files = Annotated[list[Path] | None, typer.Argument(metavar="FILE", help="ST sources that belong together.")]
Select = Annotated[
    list[str] | None,
    typer.Option(help="Tell only this rule, by name, code or beginning of a code (ST3); may be repeated."),
]
Ignore = Annotated[list[str] | None, typer.Option(help="Do not tell this rule; may be repeated.")]
Listing = Annotated[bool, typer.Option("--list", help="List the rules and stop.")]
Format = Annotated[str, typer.Option("--format", metavar="text|json", help="How to print the findings.")]


def run(
    files: Files = None,
    select: Select = None,
    ignore: Ignore = None,
    listing: Listing = False,
    output: Format = "text",
) -> None:
    """Find what is not portable in Structured Text.

    A finding is one line, `file:line:col: CODE rule: why; what to write instead`. The files are taken as one text:
    each may use what another declares. The exit status is 0 without findings, 1 with findings, and 2 if a file cannot
    be read or parsed. docs/lint.md explains every rule.

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
    sources = _read(files or [])
    problems = lint_sources(sources, selection)
    _print(problems, output)
    if problems:
        raise typer.Exit(2 if any(each.rule in ("syntax", "long-expression") for each in problems) else 1)


def _stop(text: str) -> None:
    """End with the status for bad input."""
    typer.echo(text, err=True)
    raise typer.Exit(2)


def _split(words: list[str] | None) -> list[str]:
    """Words given one by one or separated by commas."""
    return [each.strip() for word in words or [] for each in word.split(",") if each.strip()]


def _read(files: list[Path]) -> list[tuple[str, str]]:
    """The text of every file by its path; all that cannot be read are told before it ends with status 2."""
    sources: list[tuple[str, str]] = []
    bad: list[str] = []
    for path in dict.fromkeys(files):
        try:
            sources.append((str(path), _text(path)))
        except (OSError, ValueError) as error:
            bad.append(f"{path}:1:1: {_reason(error)}")
    if bad:
        _stop("\n".join(bad))
    return sources


def _text(path: Path) -> str:
    """The text of one file. Raises OSError, or ValueError saying why it is no source."""
    if path.is_dir():
        raise ValueError("expected a file, found a directory: name the files in it")
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
