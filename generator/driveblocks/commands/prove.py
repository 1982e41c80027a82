"""`driveblocks prove`: show that the safety rules hold in every scan, whatever comes, or the call that breaks one."""

import sys
from contextlib import closing
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

import click

from driveblocks import console
from driveblocks.commands import JUNIT, MAPS, refuse, sources, write

if TYPE_CHECKING:
    from driveblocks.bench.outcome import Result

SHOWN = 5
"""Counterexamples that are printed whole; all are in the XML, if one is asked for."""


@click.command()
@MAPS
@JUNIT
@click.option("--rules", is_flag=True, help="Print every rule that is proved, below its block.")
def run(maps: tuple[str, ...], junit: Path | None, rules: bool) -> None:
    """Prove the safety rules of the drive blocks.

    Each rule is shown to hold in every call, for all inputs and everything that the memory can hold by then, from
    power-up on; where it does not hold, the call that breaks it is printed, and run on the embedded engine. What is
    proved, for which inputs, and what is not: see docs/prove.md. The exit status is 0 if all is proved, 1 for a
    counterexample or where the solver does not know, and 2 if a map is bad or the solver is missing.

    Example: driveblocks prove my_drive.yaml --junit proofs.xml
    """
    if find_spec("z3") is None:
        refuse("the solver is missing: pip install 'driveblocks[prove]'")
    from driveblocks.bench import junit as xml
    from driveblocks.bench.outcome import Run
    from driveblocks.prove import archive
    from driveblocks.prove.sorts import UnsupportedError
    from structured_text.language.problems import SourceError

    done: list[Result] = []
    try:
        with closing(console.Bar(console.terminal("stderr"))) as bar:
            bar.show(0, 1, "the maps")
            for each, kept in archive.run(sources(maps), tell=bar.show):
                bar.close()
                _print(each, kept=kept, rules=rules)
                done.append(each)
    except (UnsupportedError, SourceError) as error:
        refuse(f"cannot be proved: {error}")
    if junit is not None:
        write(junit, xml.text(Run(done, sum(each.seconds for each in done))))
    _say(done)
    sys.exit(0 if all(each.passed for each in done) else 1)


def _print(result: "Result", *, kept: bool, rules: bool) -> None:
    """A line per block, or per rule; what is not proved always."""
    bad = {each.scene: each.message.partition("\n")[0] for each in reversed(result.bad)}
    verdict = f"{len(bad)} not proved" if bad else "all proved"
    count = f"{len(result.scenes)} rules, {len(result.outcomes)} questions"
    when = "before, for the same text" if kept else f"in {result.seconds:.1f} s"
    click.echo(f"{result.program} ({result.unit}): {count}: {verdict} {when}")
    for words in result.scenes:
        if words in bad:
            click.echo(f"  NOT PROVED: {words}\n    {bad[words]}")
        elif rules:
            click.echo(f"  proved: {words}")


def _say(done: "list[Result]") -> None:
    """The counterexamples, then the sum of it all."""
    from textwrap import indent

    bad = [(result, each) for result in done for each in result.bad]
    for result, each in bad[:SHOWN]:
        if "\n" in each.message:
            click.echo(f"{result.program}: {each.scene}\n{indent(each.message, '    ')}")
    premises, free = (sum(int(result.properties[at][1]) for result in done) for at in (0, 1))
    verdict = f"{len(bad)} not proved" if bad else "all proved"
    questions, seconds = (sum(len(each.outcomes) for each in done), sum(each.seconds for each in done))
    click.echo(f"{premises} premises run on the embedded engine, of which {free} rest on values that were left free")
    click.echo(f"{questions} questions: {verdict} in {seconds:.1f} s")
