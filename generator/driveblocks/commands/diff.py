"""`driveblocks diff`: what two versions of a map or of the blocks change, and what the swap of a drive takes."""

import sys
from typing import TYPE_CHECKING

import click

from driveblocks.commands import echo_json, refuse

if TYPE_CHECKING:
    from collections.abc import Iterator

    from driveblocks.diff.change import Change
    from driveblocks.docs.swap import Section
    from driveblocks.maps.model import Drive


@click.command()
@click.argument(
    "old", metavar="OLD", help="The older map, by path, name or model number, or a folder of blocks as text."
)
@click.argument("new", metavar="NEW", help="The newer one, of the same kind.")
@click.option("--changelog", is_flag=True, help="Print Markdown; of two versions, changes of words alone are counted.")
@click.option("--json", is_flag=True, help="Print everything as JSON.")
def run(old: str, new: str, changelog: bool, json: bool) -> None:
    """Tell two versions of a map apart, or two families.

    Of two families, what changes at the machine, side by side: wires, the line, the keypad, pins of the block, what the
    drive can do and does by itself, faults. Of two versions of a map, blocks and facts: what no longer compiles (a pin
    is gone, a type is another one), what acts differently (an address, a scale, a command), what is new, and where only
    words differ. Of two folders, such as blocks/iec61131 of two releases, the pins of all blocks. The exit status is 0
    if every program still compiles and of two families, 1 if one may not, 2 for bad input.

    Examples: driveblocks diff chf_of_last_year.yaml chf, driveblocks diff acs355 6SL3210-5BE17-5UV0
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
    drives = [each.drive for each in found if each.drive]
    if len(drives) == len(found) and drives[0].prefix != drives[1].prefix:
        _swap(*drives, json=json, markdown=changelog)
        return
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


def _swap(old: "Drive", new: "Drive", *, json: bool, markdown: bool) -> None:
    """Print what the swap of a drive takes."""
    from driveblocks import console
    from driveblocks.docs import swap
    from driveblocks.maps import view
    from driveblocks.show.layout import heading, table

    sections = list(swap.sections(old, new))
    if json:
        echo_json(
            [
                {"section": one.title, "what": row[0], "old": row[1], "new": row[2]}
                for one in sections
                for row in one.rows
            ]
        )
    elif markdown:
        click.echo(
            "\n".join(_page(f"{view.title(old)} is replaced by {view.title(new)}", old.prefix, new.prefix, sections))
        )
    else:
        console.write(f"{view.title(old)} is replaced by {view.title(new)}")
        for one in sections:
            made = table("", old.prefix, new.prefix, wide=("", old.prefix, new.prefix))
            for row in one.rows:
                made.add_row(*row)
            console.write(heading(one.title), made)
        console.write("\nThe order of the work, and what to try before the first start: blocks/docs/Swapping.md")


def _page(title: str, old: str, new: str, sections: "list[Section]") -> "Iterator[str]":
    from driveblocks.maps import view

    yield f"# {view.markdown(title)}"
    for one in sections:
        yield f"\n## {one.title}\n\n| | {old} | {new} |\n|---|---|---|"
        for row in one.rows:
            yield f"| {' | '.join('<br>'.join(map(view.markdown, cell.splitlines())) for cell in row)} |"


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
