"""Each rule of a block: proved, or the call that breaks it."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum

import z3

from driveblocks.prove.model import Model
from driveblocks.prove.operations import Term
from driveblocks.prove.rules import Rule
from driveblocks.prove.terms import Obligation, Store

WORK = 240_000_000
"""Steps of the solver for one question, after which its answer is unknown; no clock, so that all machines agree."""

STEPS = ("simplify", "propagate-values", "solve-eqs", "fpa2bv", "simplify", "bit-blast", "sat")
"""How a solver treats REALs that are computed with."""
TRUE = z3.BoolVal(True)
CALLS = "call by call"
"""What is asked of a call that finds what always holds."""


class Verdict(Enum):
    """What became of a rule."""

    PROVED = "proved"
    BROKEN = "counterexample"
    UNKNOWN = "unknown"
    EMPTY = "never comes to it"


@dataclass(frozen=True)
class Question:
    """What is asked of the solver: under what is known, can the claim be broken?

    `condition` names it in the block's observer, as `Rule3` or `Control.Given0`; empty for what compilers agree on.
    """

    block: str
    about: str
    words: str
    of: str
    condition: str
    known: tuple[Term, ...]
    when: Term
    then: Term

    @property
    def reached(self) -> bool:
        """Whether a call has to exist that comes to it."""
        return self.about in ("", CALLS) and not z3.is_true(self.when)


@dataclass(frozen=True)
class Answer:
    """A question and what became of it; `example`: a call that breaks it, or of what is proved one that comes to it."""

    question: Question
    verdict: Verdict
    example: z3.ModelRef | None = None


@dataclass(frozen=True)
class World:
    """Calls of one kind: what they are called, the conditions about them, and what is known of them."""

    about: str
    truth: Store
    known: tuple[Term, ...]


def questions(model: Model, parts: Mapping[str, Model] | None = None) -> Iterator[Question]:
    """Everything that is to be shown of a block; `parts`: by instance, the subjects inside it, each proved on its own.

    What always holds of a part may be used, and what the part was promised has to be shown.
    """
    inner = {name: model.inner(name, part) for name, part in (parts or {}).items()}
    given = _claims(model.truth, "Given", len(model.subject.given))
    calls, start = _worlds(model, list(inner.values()), given)
    for world in (*calls, *start):
        yield from _of(model, "Always", model.subject.always, world)
    for world in calls:
        yield from _of(model, "Rule", model.subject.rules, world)
        for name, part in inner.items():
            promised = World(f"promised to {name}, {world.about}", part.truth, world.known)
            yield from _of(model, "Given", part.subject.given, promised, f"{name}.")
    for each in model.obligations:
        yield _agreed(model, "every compiler", each, calls[0].known, each.term)
    yield from _first(model, given)


def _worlds(model: Model, inner: Sequence[Model], given: tuple[Term, ...]) -> tuple[list[World], list[World]]:
    """The calls that rules are about, and the memory at power-up of a block that knows no restart."""
    always = _claims(model.was, "Always", len(model.subject.always))
    for part in inner:
        always += _claims(part.was, "Always", len(part.subject.always))
    calls = [World(CALLS, model.truth, (*given, *always))]
    if model.subject.restart:
        return [*calls, World("any memory, with a restart", model.truth, (*given, model.truth["Restarts"]))], []
    return calls, [World("as declared", model.was, model.declared), World("all zero", model.was, model.zero)]


def _of(model: Model, word: str, rules: Sequence[Rule], world: World, prefix: str = "") -> Iterator[Question]:
    """Rules in a world."""
    for number, rule in enumerate(rules):
        named, when, then = f"{prefix}{word}{number}", *_parts(world.truth, word, number)
        yield Question(model.pou.name, world.about, rule.say, rule.of, named, world.known, when, then)


def _agreed(model: Model, about: str, each: Obligation, known: tuple[Term, ...], term: Term) -> Question:
    """That all compilers agree on a result."""
    where = f"{each.path} line {each.line}: {each.words}"
    return Question(model.pou.name, about, where, "", "", known, TRUE, term)


def _first(model: Model, given: tuple[Term, ...]) -> Iterator[Question]:
    """What the first call after power-up is: a restart, and the same for all compilers."""
    if not model.subject.restart or model.subject.by_caller:
        return
    for about, memory in (("as declared", model.declared), ("all zero", model.zero)):
        block, words, restarts = model.pou.name, "the first call acts like a restart", model.truth["Restarts"]
        yield Question(block, about, words, "B6", "Restarts", (*given, *memory), TRUE, restarts)
        for each in model.obligations:
            yield _agreed(model, f"every compiler, {about}", each, (*given, *memory), each.term)


def _parts(world: Store, word: str, number: int) -> tuple[Term, Term]:
    return world[f"{word}When{number}"], world[f"{word}Then{number}"]


def _claims(world: Store, word: str, count: int) -> tuple[Term, ...]:
    return tuple(z3.Implies(*_parts(world, word, number)) for number in range(count))


def answers(asked: Iterable[Question], *, reach: bool = True, exact: bool = False) -> Iterator[Answer]:
    """What became of each question, those with the same facts together; `reach`: premises are checked, too."""
    groups: dict[tuple[int, ...], list[Question]] = {}
    for each in asked:
        groups.setdefault(tuple(fact.get_id() for fact in each.known), []).append(each)
    for group in groups.values():
        solver = _solver(exact=exact)
        solver.add(*group[0].known)
        for each in group:
            yield _answered(solver, each, reach=reach and each.reached)


def _solver(*, exact: bool) -> z3.Solver:
    """A solver that remembers from one question to the next; REALs that are computed with need another one."""
    solver = z3.Then(*STEPS).solver() if exact else z3.SolverFor("QF_BVFP")
    solver.set("rlimit", WORK)
    return solver


def _answered(solver: z3.Solver, each: Question, *, reach: bool) -> Answer:
    verdict, example = _asked(solver, each.when, z3.Not(each.then))
    if verdict == z3.sat:
        return Answer(each, Verdict.BROKEN, example)
    if verdict == z3.unknown:
        return Answer(each, Verdict.UNKNOWN)
    if not reach:
        return Answer(each, Verdict.PROVED)
    verdict, example = _asked(solver, each.when)
    if verdict == z3.unsat:
        return Answer(each, Verdict.EMPTY)
    return Answer(each, Verdict.PROVED if verdict == z3.sat else Verdict.UNKNOWN, example)


def _asked(solver: z3.Solver, *terms: Term) -> tuple[z3.CheckSatResult, z3.ModelRef | None]:
    solver.push()
    solver.add(*terms)
    verdict = solver.check()
    example = solver.model() if verdict == z3.sat else None
    solver.pop()
    return verdict, example
