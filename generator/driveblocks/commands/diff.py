"""`driveblocks diff`: what differs between two versions of a map or of the blocks, and what a PLC project notices."""

import sys
from typing import TYPE_CHECKING

import click

from driveblocks.commands import echo_json, refuse

if TYPE_CHECKING:
    from collections.abc import Iterator

    from driveblocks.diff.change import Change


@click.command()
@click.argument("old", metavar="OLD", help="The older map, by path or name, or a folder of blocks as text.")
@click.argument("new", metavar="NEW", help="The newer one, of the same kind.")
@click.option("--changelog", is_flag=True, help="Print Markdown for a changelog; changes of words alone are counted.")
@click.option("--json", is_flag=True, help="Print all changes as JSON.")
def run(old: str, new: str, changelog: bool, json: bool) -> None:
    """List what differs between two versions of a map.

    Of two maps, blocks and facts are compared: what no longer compiles (a pin is gone, a type is another one), what
    acts differently (an address, a scale, a command), what is new, and where only words differ. Of two folders, such
    as blocks/iec61131 of two releases, the pins of all blocks. The exit status is 0 if every program still compiles,
    1 if one may not, 2 for bad input.

    Example: driveblocks diff chf_of_last_year.yaml chf
    """
    from driveblocks.diff import versions
    from driveblocks.diff.change import Kind
    from driveblocks.maps.problem import Refused

    wrong, found = [], []
    for name in (old, new):
        try:
            found.append(versions.version(name))
        except (Refused, ValueError, OSError) as error:
            wrong.append(str(error))
    if wrong:
        refuse("\n".join(wrong))
    try:
        changes = versions.compared(*found)
    except ValueError as error:
        refuse(str(error))
    if json:
        _json(changes)
    else:
        click.echo("\n".join(_lines(found[0].title, found[1].title, changes, words=not changelog, markdown=changelog)))
    if any(each.kind is Kind.BREAKS for each in changes):
        sys.exit(1)


def _json(changes: "list[Change]") -> None:
    rows = [{"kind": each.kind.name.lower(), "where": each.where, "what": each.what} for each in changes]
    echo_json(rows)


def _lines(old: str, new: str, changes: "list[Change]", *, words: bool, markdown: bool) -> "Iterator[str]":
    from driveblocks.diff.change import Kind
    from driveblocks.maps import view

    yield f"### {view.markdown(new)}\n\nSince {view.markdown(old)}:" if markdown else f"from {old}\nto   {new}"
    if not changes:
        yield "\nNothing differs." if markdown else "\nnothing differs"
    for kind in Kind:
        rows = [each for each in changes if each.kind is kind]
        if not rows:
            continue
        yield ""
        if kind is Kind.WORDS and not words:
            yield f"{len(rows)} change{'s' * (len(rows) > 1)} of texts and sources."
            continue
        heading = f"{kind.value[0].upper()}{kind.value[1:]}:\n" if markdown else f"{kind.value}: {len(rows)}"
        yield heading
        yield from (f"- {view.markdown(str(each))}" if markdown else f"  {each}" for each in rows)
