"""A hundred one-token changes of control and drive blocks, drawn by a seed: which of them do the proofs find?

`python -m tests.prove.mutants` draws changes that lint and build, proves on each until something is not proved, and
prints what. Survivors are in `survivors.yaml`, each with its class and a reason: liveness, timing, text, a scale, or
equivalent, which is proved, not claimed. The exit status is 1 where that list and the proofs do not agree. A change is
drawn by what it says, not by where it stands, so that an edit of a block leaves the other changes as they are.
"""

import argparse
import sys
from collections.abc import Iterable
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import Any

import yaml
import z3
from tests import shipped
from tests.drives.station import FAMILIES
from tests.second.mutants import Mutant, changes, named

from driveblocks.prove import prover, rules
from driveblocks.prove.facts import facts
from driveblocks.prove.model import models
from driveblocks.prove.question import STEPS, Question, questions
from driveblocks.prove.rules import Subject
from driveblocks.prove.sorts import UnsupportedError
from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.engine import EngineError, Source
from structured_text.language.lint import lint_sources

SEED, NUMBER = 22, 100
SURVIVORS = Path(__file__).with_name("survivors.yaml")
CLASSES = ("liveness", "timing", "text", "scale", "equivalent")
CONTROL = ("Control", "Pins", "Run", "FaultReset", "Start", "FirstStop", "StopRound", "Send", "Why")
DRIVE = ("Link", "Unit", "Usual")
OF_EACH = ("Drive", "Reads", "Orders", "Reference", "Standstill")
BLOCKS = (
    *(f"VFD_{each}" for each in (*CONTROL, *DRIVE)),
    *(f"{family}_{each}" for family in FAMILIES for each in OF_EACH),
)


@cache
def every() -> dict[str, Mutant]:
    """All changes by what they say, in the order of the texts; comments and declarations stay."""
    sources = {each.path: each for made in texts().values() for each in made}.values()
    return {one.says: one for name, text in named(sources) if name in BLOCKS for one in changes(name, text)}


def drawn(seed: int = SEED) -> list[str]:
    """All changes in the order of a seed; who takes the first ones leaves out those that do not lint or build."""
    return sorted(every(), key=lambda name: sha256(f"{seed} {name}".encode()).hexdigest())


def survivors() -> dict[str, dict[str, Any]]:
    """The changes that no rule finds, each with its class and the reason."""
    listed: list[dict[str, Any]] = yaml.safe_load(SURVIVORS.read_text("utf-8"))
    return {each["change"]: each for each in listed}


def texts(one: Mutant | None = None) -> dict[str, list[Source]]:
    """The blocks of every family, with a change or without."""
    return {unit: [_changed(each, one) for each in made] for unit, made in prover.texts(shipped.sources())}


def _changed(source: Source, one: Mutant | None) -> Source:
    return source if one is None else Source(source.path, one.edit(source.text))


@cache
def subjects() -> dict[str, list[Subject]]:
    """What is proved of each family, and of every drive."""
    made = {each.path.stem: rules.family(facts(each.drive)) for each in shipped.sources()}
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
        if one.block not in dict(named(made)):
            continue
        try:
            found = _broken(unit, made)
        except UnsupportedError as error:
            return str(error)
        if found:
            return found
    return ""


def equivalent(one: Mutant) -> bool:
    """Whether the block with a change does in every call, from any memory, what it does without."""
    ours = next(made for made in texts().values() if any(one.edit(each.text) != each.text for each in made))
    before, after = (
        models(made, [Subject(one.block)])[0].after for made in (ours, [_changed(each, one) for each in ours])
    )
    solver = z3.SolverFor("QF_BVFP")
    solver.add(z3.Or(*(before[path] != after[path] for path in before)))
    return bool(solver.check() == z3.unsat)


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


def verdict(name: str) -> tuple[str, bool]:
    """What becomes of a change, and whether the list agrees."""
    found, listed = judged(every()[name]), survivors().get(name)
    if found:
        return found, listed is None
    if listed is None:
        return "SURVIVES", False
    if listed["class"] == "equivalent":
        return "equivalent", equivalent(every()[name])
    return f"survives: {listed['class']}", True


def main() -> int:
    """Judge all of them, or some."""
    parser = argparse.ArgumentParser(description="One-token changes of control and drive blocks.")
    parser.add_argument("--seed", type=int, default=SEED)
    parser.add_argument("--only", type=int, nargs="*", help="their places in the draw")
    options = parser.parse_args()
    number = found = wrong = 0
    for place, name in enumerate(drawn(options.seed)):
        if number == NUMBER:
            break
        if (options.only and place not in options.only) or not good(every()[name]):
            continue
        by, agrees = verdict(name)
        number, wrong = number + 1, wrong + (not agrees)
        found += "urvives" not in by and "SURVIVES" not in by and by != "equivalent"
        print(f"{place:3} {name}: {by}{'' if agrees else ' - the list says otherwise'}", flush=True)
    print(f"{found} of {number} found, {wrong} not as the list says")
    return int(wrong > 0)


if __name__ == "__main__":
    sys.exit(main())
