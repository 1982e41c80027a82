"""`driveblocks prove`: show that the safety rules hold in every scan, whatever comes, or the call that breaks one."""

import sys
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

import click

from driveblocks.commands import JUNIT, MAPS, refuse, sources, write

if TYPE_CHECKING:
    from driveblocks.prove.prover import Proved

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
    from driveblocks.prove import prover, report
    from driveblocks.prove.sorts import UnsupportedError
    from driveblocks.testing import junit as xml
    from structured_text.language.problems import SourceError

    done: list[Proved] = []
    try:
        for each in prover.run(sources(maps)):
            _print(each, rules=rules)
            done.append(each)
    except (UnsupportedError, SourceError) as error:
        refuse(f"cannot be proved: {error}")
    if junit is not None:
        write(junit, xml.text(report.written(done)))
    bad = _say(done)
    sys.exit(1 if bad else 0)


def _print(proved: "Proved", *, rules: bool) -> None:
    """A line per block, or per rule; what is not proved always."""
    from driveblocks.prove import report

    found = report.sentences(proved)
    bad = [words for words, proofs in found.items() if not all(each.good for each in proofs)]
    verdict = f"{len(bad)} not proved" if bad else "all proved"
    count = f"{len(found)} rules, {len(proved.proofs)} questions"
    click.echo(f"{proved.model.pou.name} ({proved.unit}): {count}: {verdict} in {proved.seconds:.1f} s")
    for words, proofs in found.items():
        if words in bad:
            click.echo(f"  NOT PROVED: {words}")
            for each in proofs:
                if not each.good:
                    click.echo(f"    {report.told(each)}")
        elif rules:
            of = proofs[0].answer.question.of
            click.echo(f"  proved: {words}" + (f" ({of})" if of else ""))


def _say(done: "list[Proved]") -> int:
    """The counterexamples, then the sum of it all; how many are not proved."""
    from textwrap import indent

    from driveblocks.prove import report

    bad = [(proved, each) for proved in done for each in proved.proofs if not each.good]
    for proved, each in bad[:SHOWN]:
        if lines := report.table(proved, each):
            click.echo(f"{proved.model.pou.name}: {each.answer.question.words}\n  {report.told(each)}")
            click.echo(indent("\n".join(lines), "    "))
    proofs = [each for proved in done for each in proved.proofs]
    calls = [each for each in proofs if each.call is not None]
    free = sum(not each.replayed for each in calls if each.good)
    verdict = f"{len(bad)} not proved" if bad else "all proved"
    seconds = sum(each.seconds for each in done)
    click.echo(f"{len(calls)} premises run on the embedded engine, of which {free} rest on values that were left free")
    click.echo(f"{len(proofs)} questions: {verdict} in {seconds:.1f} s")
    return len(bad)
