"""A hundred one-token changes of control and drive blocks, drawn by a seed: which of them do the proofs find?

`python -m tests.prove.mutants` draws changes that lint and build, proves on each until something is not proved, and
prints what; the survivors are for a person to judge: which rule is not written down, or can nobody tell the change from
the text? The seed was fixed before any change had been judged by a rule.
"""

import argparse
import re
import sys
from collections.abc import Iterable, Iterator
from functools import cache
from random import Random

import z3
from tests.drives import station
from tests.drives.station import FAMILIES
from tests.second.mutants import NAME, SWAPS, TOKEN, Mutant

from driveblocks.maps import catalog, collection
from driveblocks.maps.collection import Source as Map
from driveblocks.prove import prover, rules
from driveblocks.prove.facts import facts
from driveblocks.prove.model import models
from driveblocks.prove.proof import STEPS, Question, questions
from driveblocks.prove.rules import Subject
from driveblocks.prove.sorts import UnsupportedError
from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.engine import EngineError, Source
from structured_text.language.lint import lint_sources

SEED, NUMBER = 22, 100
CONTROL = ("Control", "Pins", "Run", "FaultReset", "Start", "StopRound", "Send", "Why")
DRIVE = ("Link", "Unit", "Usual")
OF_EACH = ("Drive", "Reads", "Orders", "Reference", "Standstill")
BLOCKS = (
    *(f"VFD_{each}" for each in (*CONTROL, *DRIVE)),
    *(f"{family}_{each}" for family in FAMILIES for each in OF_EACH),
)


def every() -> Iterator[Mutant]:
    """All changes, in the order of the texts; comments and declarations stay."""
    for source in station.texts(kinds=FAMILIES):
        named = NAME.search(source.text)
        if not named or named[1] not in BLOCKS:
            continue
        plain = re.sub(r"\(\*.*?\*\)", lambda each: re.sub(r"[^\n]", " ", each[0]), source.text, flags=re.DOTALL)
        begins = plain.rindex("END_VAR") + len("END_VAR")
        for token in TOKEN.finditer(plain, begins):
            old = token[0]
            new = str(int(old) + 1) if old.isdigit() else SWAPS.get(old)
            if new is not None:
                yield Mutant(named[1], token.start(), plain.count("\n", 0, token.start()) + 1, old, new)


def drawn(seed: int = SEED) -> list[Mutant]:
    """All changes in the order of a seed; who takes the first ones leaves out those that do not lint or build."""
    found = list(every())
    Random(seed).shuffle(found)
    return found


def texts(one: Mutant | None = None) -> dict[str, list[Source]]:
    """The blocks of every family, with a change or without."""
    return {unit: [_changed(each, one) for each in made] for unit, made in prover.texts(sources())}


def _changed(source: Source, one: Mutant | None) -> Source:
    return source if one is None else Source(source.path, one.edit(source.text))


@cache
def sources() -> list[Map]:
    """The maps of the families."""
    return collection.read(catalog.shipped())


@cache
def subjects() -> dict[str, list[Subject]]:
    """What is proved of each family, and of every drive."""
    made = {each.path.stem: rules.family(facts(each.drive)) for each in sources()}
    return {prover.GENERIC: rules.shared()} | made


def good(one: Mutant) -> bool:
    """Whether a change lints, and builds."""
    every = {each.path: each.text for made in texts(one).values() for each in made}
    if lint_sources(every.items()):
        return False
    try:
        EmbeddedEngine().build([Source(path, text) for path, text in every.items()])
    except EngineError:
        return False
    return True


def judged(one: Mutant) -> str:
    """The first rule that is not proved of a change; empty: all are."""
    for unit, made in texts(one).items():
        if not any(NAME.search(each.text) and NAME.search(each.text)[1] == one.block for each in made):  # type: ignore[index]
            continue
        try:
            found = _broken(unit, made)
        except UnsupportedError as error:
            return str(error)
        if found:
            return found
    return ""


def _broken(unit: str, made: list[Source]) -> str:
    """The first rule of a family that is not proved."""
    named = {name for each in subjects()[unit] for name in each.inside.values()}
    parts = [each for each in rules.shared() if each.block in named and unit != prover.GENERIC]
    built = models(made, [*parts, *subjects()[unit]])
    by_name = {each.pou.name: each for each in built}
    for model in built[len(parts) :]:
        inside = {
            name: by_name[block] for name, block in model.subject.inside.items() if name.upper() in model.pou.symbols
        }
        for each in groups(questions(model, inside)):
            broken = together(each, exact=model.subject.exact)
            if broken is not None:
                return f"{model.pou.name}, {broken.about}: {broken.words}"
    return ""


def groups(asked: Iterable[Question]) -> Iterable[list[Question]]:
    """Questions of one set of facts."""
    found: dict[tuple[int, ...], list[Question]] = {}
    for each in asked:
        found.setdefault(tuple(fact.get_id() for fact in each.known), []).append(each)
    return found.values()


def together(asked: list[Question], *, exact: bool) -> Question | None:
    """One that can be broken; all are asked at once, which is quick where none can."""
    solver = z3.Then(*STEPS).solver() if exact else z3.SolverFor("QF_BVFP")
    solver.add(*asked[0].known, z3.Or(*(z3.And(each.when, z3.Not(each.then)) for each in asked)))
    verdict = solver.check()
    if verdict == z3.unsat:
        return None
    if verdict == z3.unknown:
        return asked[0]
    model = solver.model()
    holds = (each for each in asked if z3.is_true(model.eval(z3.And(each.when, z3.Not(each.then)), True)))
    return next(holds, asked[0])


def main() -> int:
    """Judge all of them, or some."""
    parser = argparse.ArgumentParser(description="One-token changes of control and drive blocks.")
    parser.add_argument("--seed", type=int, default=SEED)
    parser.add_argument("--only", type=int, nargs="*")
    parser.add_argument("--from", type=int, default=0, dest="first")
    parser.add_argument("--step", type=int, default=1)
    options = parser.parse_args()
    number = found = judged_in_all = 0
    for one in drawn(options.seed):
        if number >= NUMBER:
            break
        if not good(one):
            continue
        mine = number in options.only if options.only else number % options.step == options.first
        if mine:
            by = judged(one)
            judged_in_all, found = judged_in_all + 1, found + bool(by)
            print(f"{number:2} {one}: {by or 'SURVIVES'}", flush=True)
        number += 1
    print(f"{found} of {judged_in_all} found")
    return 0


if __name__ == "__main__":
    sys.exit(main())
