"""The Jinja environment: strict, no escaping, and the few functions that templates may call."""

from collections.abc import Iterable, Sequence
from contextlib import suppress
from functools import cache
from itertools import chain

import jinja2

from driveblocks.maps import form, view
from driveblocks.modbus.checksum import MODBUS
from driveblocks.render import constants, expression, results
from structured_text.language import writing
from structured_text.language.fingerprint import body, fingerprint, stream

ABI = 4
"""Version of the shared types; blocks of one ABI number fit together."""

WIDE = 80
"""Characters of an expression that still fits on one line."""

_PRINT = "\x01" * 8
"""In place of the hash of the body in its head, until the body is rendered; no map can hold it."""
_RULE = "   " + "-" * 97
_MADE_BY = ("Made by", "DriveBlocks; written by the generator, so make changes in its template or map.")


def strict(package: str, *others: jinja2.BaseLoader) -> jinja2.Environment:
    """The environment of the templates of a package, and of others. An undefined name is an error."""
    return jinja2.Environment(
        loader=jinja2.ChoiceLoader([jinja2.PackageLoader(package), *others]),
        bytecode_cache=_kept(),
        auto_reload=False,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=False,  # noqa: S701  (the output is Structured Text, not HTML)
    )


@cache
def environment() -> jinja2.Environment:
    """The environment of the templates of all blocks and pages."""
    made = strict("driveblocks.render", jinja2.PackageLoader("driveblocks.platforms", ""))  # each in its own folder
    made.globals.update(
        head=head,
        type_head=type_head,
        crc_table=crc_table,
        result=results.code,
        fail=results.fail,
        abi=ABI,
        named=constants.named,
    )
    made.filters.update(
        word=writing.word,
        plain=view.markdown,
        sentence=view.sentence,
        byte=writing.byte,
        comment=writing.comment,
        span=form.span_text,
        address=form.address_text,
        assign=assign,
        passed=passed,
        since=since,
        age=age,
        oldest=oldest,
        entries=entries,
        errors=constants.errors,
        taken=taken,
        turns=turns,
        either=either,
        holds=expression.holds,
        statements=expression.statements,
        within=expression.within,
        label=expression.label,
        more=expression.more,
        each=expression.each,
        none_of=expression.none_of,
        times=expression.times,
        real=expression.real,
    )
    return made


def _kept() -> jinja2.BytecodeCache | None:
    """Compiled templates in the user's own folder of the system's temporary one: a third of the time of a command."""
    with suppress(OSError, RuntimeError):  # no such folder can be made, or it is somebody else's
        return jinja2.FileSystemBytecodeCache()
    return None


def render(template: str, **context: object) -> str:
    """The text of one template. Raises jinja2.UndefinedError for a name that the context lacks."""
    text = environment().get_template(template).render(**context)
    if _PRINT in text:
        text = text.replace(_PRINT, fingerprint(stream(body(text))))
    text = writing.aligned(text)
    return writing.folded(text) if template.endswith(".st.j2") else text


def head(  # noqa: PLR0913  (the parts of every head)
    name: str, title: str, *, purpose: str, call: str, loops: str, source: str = ""
) -> str:
    """The comment at the top of a block: what it is for, where its facts come from, how to call it, what it costs."""
    hashed = f"{_PRINT}, a hash of its tokens, which is the same in every form of this block"
    parts = [("Purpose", purpose), ("Source", source), ("Call", call), ("Loops", loops), ("Body", hashed)]
    return _comment(f"{name}: {title}", [(label, text) for label, text in parts if text])


def type_head(name: str, title: str, note: str) -> str:
    """The comment at the top of a type."""
    return _comment(f"{name}: {title}", [("Note", note)])


def _comment(title: str, parts: list[tuple[str, str]]) -> str:
    lines = (writing.paragraph(f"   {label:<9}", text, width=100) for label, text in (*parts, _MADE_BY))
    body = "\n".join(chain.from_iterable(lines))
    return f"(* {writing.comment(title)}\n{_RULE}\n{body} *)"


def assign(name: str) -> str:
    """A formal parameter in the example call of a head comment."""
    return f"{name} := ..."


def passed(name: str) -> str:
    """A formal parameter that gets a variable of its own name."""
    return f"{name} := {name}"


def taken(name: str) -> str:
    """A formal parameter that gets the word of its own name from what a drive block has read."""
    return f"{name} := Reads.{name}"


def since(read: int) -> str:
    """The flag that a read has come since it was asked for, and was ours."""
    return f"Sure{read}"


def age(read: int) -> str:
    """The age of the words of a read."""
    return f"Age{read}"


def entries(numbers: Sequence[int]) -> str:
    """Whether one of these reads has come in this call, and without a doubt."""
    return either([f"(Reads.BelievedEntry = {number})" for number in numbers]).strip()


def oldest(ages: Iterable[str]) -> str:
    """The largest of some ages."""
    first, *others = ages
    return f"MAX({first}, {oldest(others)})" if others else first


def turns(numbers: Sequence[int]) -> str:
    """Whether a drive block's polls have come to one of these turns of their round."""
    return " OR ".join(f"(Turn = {number})" for number in numbers) if len(numbers) > 1 else f"Turn = {numbers[0]}"


def either(tests: Sequence[str]) -> str:
    """An expression that is TRUE when one of some others is."""
    if len(tests) == 1:
        return tests[0]
    apart = "\n      OR " if sum(map(len, tests)) > WIDE else " OR "
    return f"({apart.join(tests)})"


def crc_table(octets: int = 1) -> str:
    """The 256 words of the CRC table, eight to a row: the change by one byte, or by it and a zero after it."""
    entries = [entry if octets == 1 else entry >> 8 ^ MODBUS[entry & 0xFF] for entry in MODBUS]
    words = [writing.word(entry) for entry in entries]
    return ",\n".join("    " + ", ".join(words[at : at + 8]) for at in range(0, len(words), 8))
