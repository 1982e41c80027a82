"""One call of a block as terms: before it, its inputs, after it; and the conditions of its rules on these."""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import z3

from driveblocks.prove import observer
from driveblocks.prove.example import nothing
from driveblocks.prove.rules import Subject
from driveblocks.prove.sorts import UnsupportedError, initial, leaves, sort
from driveblocks.prove.terms import Obligation, Store, Terms
from structured_text.engines.engine import Source
from structured_text.language.checker import check
from structured_text.language.parser import parse
from structured_text.language.tree import Checked, Function, Pou, VarKind
from structured_text.language.types import Elementary

BEFORE = "Was."
"""What the name of a term begins with that is not an input of the call."""


@dataclass(frozen=True)
class Model:
    """A call. `before`: the memory that it finds; `inputs`: with its inputs; `after`: the memory after it."""

    subject: Subject
    pou: Pou
    checked: Checked
    before: Store
    inputs: Store
    after: Store
    obligations: list[Obligation]

    @cached_property
    def truth(self) -> Store:
        """Every condition of the subject about this call."""
        return self._observe(self.after, self.before)

    @cached_property
    def was(self) -> Store:
        """Every condition about the memory before the call; only those say something that name the memory alone."""
        return self._observe(self.before, self.before)

    @cached_property
    def declared(self) -> tuple[z3.ExprRef, ...]:
        """That every scalar of the memory is what it is at power-up."""
        start = {
            each.name.upper() + leaf.path: initial(leaf)
            for each in observer.kept(self.pou)
            for leaf in leaves(each.type, each.start)
        }
        if isinstance(self.pou, Function):
            start["RESULT"] = start[self.pou.name.upper()]
        return tuple(term == start[path] for path, term in self._memory())

    @cached_property
    def scalars(self) -> dict[str, tuple[str, Elementary]]:
        """Every scalar of the block: path -> name as declared, and type."""
        kept = observer.kept(self.pou)
        return {
            each.name.upper() + leaf.path: (each.name + leaf.name, leaf.type)
            for each in kept
            for leaf in leaves(each.type)
        }

    @cached_property
    def zero(self) -> tuple[z3.ExprRef, ...]:
        """That every scalar of the memory is 0."""
        return tuple(term == nothing(term) for _, term in self._memory())

    def _memory(self) -> Iterator[tuple[str, z3.ExprRef]]:
        """The scalars that are the block's own, not in-outs."""
        shared = in_outs(self.pou)
        return ((path, term) for path, term in self.before.items() if re.split(r"[.\[]", path)[0] not in shared)

    def _observe(self, now: Store, before: Store) -> Store:
        was = {f"WAS.{path}": term for path, term in before.items()}
        unset = {name.upper(): z3.BoolVal(False) for name in self.subject.conditions()}
        terms = Terms(now | was | unset, exact=self.subject.exact)
        terms.block(self.checked.blocks[observer.name(self.pou).upper()], "", {})
        return {name: terms.store[name.upper()] for name in self.subject.conditions()}

    def inner(self, instance: str, other: "Model") -> "Model":
        """Another subject's conditions about the call of it inside this one."""
        prefix = f"{instance.upper()}."

        def below(store: Store) -> Store:
            shared = {path: store[path] for path in other.before if path.split(".")[0] in in_outs(other.pou)}
            return shared | {path[len(prefix) :]: term for path, term in store.items() if path.startswith(prefix)}

        return replace(other, before=below(self.before), inputs=below(self.after), after=below(self.after))


def in_outs(pou: Pou) -> set[str]:
    return {name for name, each in pou.symbols.items() if each.kind is VarKind.IN_OUT}


def models(sources: Sequence[Source], subjects: Sequence[Subject]) -> list[Model]:
    """The calls of all subjects. CheckError for conditions that are no ST; UnsupportedError."""
    first = check([parse(each.text, each.path) for each in sources])
    units = [parse(each.text, each.path) for each in sources]
    for subject in subjects:
        text = observer.text(_pou(first, subject.block), first, subject.conditions())
        units.append(parse(text, f"the rules of {subject.block}"))
    checked = check(units)
    made = [_model(subject, _pou(checked, subject.block), checked) for subject in subjects]
    own = [each for each in made if each.subject.exact or (isinstance(each.pou, Function) and not each.subject.given)]
    proved = {each.pou.unit.path for each in own if each.pou.unit is not None}
    for each in made:
        if each not in own:
            each.obligations[:] = [one for one in each.obligations if one.path not in proved]
    return made


def _pou(checked: Checked, name: str) -> Pou:
    found = checked.blocks.get(name.upper()) or checked.functions.get(name.upper())
    if found is None:
        raise UnsupportedError(f"there is no block {name}")
    return found


def _model(subject: Subject, pou: Pou, checked: Checked) -> Model:
    before: Store = {}
    inputs: Store = {}
    for each in observer.kept(pou):
        for leaf in leaves(each.type):
            path = each.name.upper() + leaf.path
            before[path] = inputs[path] = z3.Const(BEFORE + path, sort(leaf.type))
            if each.kind is VarKind.INPUT:
                inputs[path] = z3.Const(path, sort(leaf.type))
    after, obligations = run(pou, inputs, exact=subject.exact, loose=subject.loose)
    if isinstance(pou, Function):
        before["RESULT"], after["RESULT"] = before[pou.name.upper()], after[pou.name.upper()]
    return Model(subject, pou, checked, before, inputs, after, obligations)


def run(pou: Pou, inputs: Store, *, exact: bool = False, loose: Sequence[str] = ()) -> tuple[Store, list[Obligation]]:
    """The memory after a call, and what has to hold in it for all compilers to agree."""
    terms = Terms(dict(inputs), exact=exact, loose=loose)
    terms.block(pou, "", {name: name for name in in_outs(pou)})
    return terms.store, terms.obligations
