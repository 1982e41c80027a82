"""All proofs: of the blocks that every drive shares, and of each drive."""

import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

import z3

from driveblocks.bench.runner import Tell
from driveblocks.maps.collection import Source
from driveblocks.prove import rules
from driveblocks.prove.example import Values, least
from driveblocks.prove.model import Model, models
from driveblocks.prove.operations import FREE
from driveblocks.prove.question import Answer, Verdict, answers, questions
from driveblocks.prove.replay import Call, Replay
from driveblocks.prove.rules import Subject
from driveblocks.render import library
from driveblocks.render.text import languages
from structured_text.engines.engine import Source as Text

GENERIC = "every drive"
"""How the blocks are called that every drive shares."""
READING = "reading the blocks"
LARGE = tuple(f"Line{slots}" for slots in library.LINE_SIZES)
"""What the names of blocks end with that only hand from one block to the next, slot by slot; no rule is about them."""


@dataclass(frozen=True)
class Proof:
    """What became of a question; `call`: the call that breaks it or comes to it, as the embedded engine ran it.

    `values`: of what that call depends on, by name.
    """

    answer: Answer
    call: Call | None = None
    values: Values = field(default_factory=dict)

    @property
    def free(self) -> bool:
        """Whether the call rests on values of REALs that the engine need not compute."""
        return any(name.startswith(FREE) for name in self.values)

    @property
    def good(self) -> bool:
        """Whether it is proved, and the call that comes to it does so on the engine, too."""
        if self.answer.verdict is not Verdict.PROVED or self.call is None:
            return self.answer.verdict is Verdict.PROVED
        return self.call.then if self.call.when else self.free

    @property
    def replayed(self) -> bool:
        """Whether the engine comes to what the solver found."""
        broken = self.answer.verdict is Verdict.BROKEN
        return self.call is not None and self.call.when and self.call.then != broken


@dataclass(frozen=True)
class Proved:
    """All proofs of a block, and how long they took."""

    unit: str
    model: Model
    proofs: tuple[Proof, ...]
    seconds: float


def texts(sources: Sequence[Source]) -> Iterator[tuple[str, list[Text]]]:
    """The blocks that every drive shares, then each drive with the shared blocks before its own."""
    spoken = languages(["en", "zh"], "utf-8")
    generic = [Text(each.path, each.text) for each in library.generic(spoken) if not each.name.endswith(LARGE)]
    yield GENERIC, generic
    for source in sources:
        own = library.drive(source.path.stem, source.drive, spoken)
        yield source.path.stem, [*generic, *(Text(each.path, each.text) for each in own)]


def proved(
    sources: Sequence[Text], subjects: Mapping[str, Sequence[Subject]], tell: Tell = lambda *_: None
) -> Iterator[Proved]:
    """The proofs of each unit's subjects; parts that they name are proved elsewhere. UnsupportedError, CheckError."""
    tell(0, 1, READING)
    asked = [(unit, each) for unit, some in subjects.items() for each in some]
    named = {name for _, each in asked for name in each.inside.values()} - {each.block for _, each in asked}
    parts = [each for each in rules.shared() if each.block in named]
    made = models(sources, [*parts, *(each for _, each in asked)])
    replay = Replay(sources, made)
    by_name = {each.pou.name: each for each in made}
    every = [list(questions(model, _inside(model, by_name))) for model in made[len(parts) :]]
    done, total = 0, sum(map(len, every))
    for (unit, _), model, some in zip(asked, made[len(parts) :], every, strict=True):
        begin, proofs = time.perf_counter(), list[Proof]()
        tell(done, total, f"{model.pou.name} ({unit})")
        for each in answers(some, exact=model.subject.exact):
            proofs.append(_replayed(replay, model, each))
            tell(done + len(proofs), total, f"{model.pou.name} ({unit})")
        done += len(proofs)
        yield Proved(unit, model, tuple(proofs), time.perf_counter() - begin)


def _inside(model: Model, by_name: Mapping[str, Model]) -> dict[str, Model]:
    """The parts of a block that are proved on their own, by the names of their instances."""
    parts = model.subject.inside.items()
    return {name: by_name[block] for name, block in parts if name.upper() in model.pou.symbols}


def _replayed(replay: Replay, model: Model, answer: Answer) -> Proof:
    """Run on the engine what the solver found; a counterexample is made as small as can be before."""
    asked = answer.question
    if answer.example is None:
        return Proof(answer)
    if answer.verdict is Verdict.BROKEN:
        values: Values = least([*asked.known, asked.when, z3.Not(asked.then)])
    else:
        found = answer.example
        values = {each.name(): found[each] for each in found.decls() if each.arity() == 0}
    return Proof(answer, replay.call(model, asked, values), values)
