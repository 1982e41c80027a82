"""The Jinja environment: strict, no escaping, and the few functions that templates may call."""

from functools import cache

import jinja2

from driveblocks.maps import form
from driveblocks.render import literal, results

ABI = 1
"""Version of the shared types; blocks of one ABI number fit together."""

_RULE = "   " + "-" * 97


@cache
def environment() -> jinja2.Environment:
    """The environment of all templates. An undefined name is an error."""
    made = jinja2.Environment(
        loader=jinja2.PackageLoader("driveblocks.render"),
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=False,  # noqa: S701  (the output is Structured Text, not HTML)
    )
    made.globals.update(
        head=head, type_head=type_head, crc_table=crc_table, result=results.code, fail=results.fail, abi=ABI
    )
    made.filters.update(
        word=literal.word,
        byte=literal.byte,
        comment=literal.comment,
        span=form.span_text,
        address=form.address_text,
        assign=assign,
    )
    return made


def render(template: str, **context: object) -> str:
    """The text of one template. Raises jinja2.UndefinedError for a name that the context lacks."""
    return literal.aligned(environment().get_template(template).render(**context))


def head(  # noqa: PLR0913  (the five parts of every head)
    name: str, title: str, *, purpose: str, source: str, call: str, loops: str
) -> str:
    """The comment at the top of a block: what it is for, where its facts come from, how to call it, what it costs."""
    parts = [("Purpose", purpose), ("Source", source), ("Call", call), ("Loops", loops)]
    return _comment(f"{name}: {title}", parts)


def type_head(name: str, title: str, note: str) -> str:
    """The comment at the top of a type."""
    return _comment(f"{name}: {title}", [("Note", note)])


def _comment(title: str, parts: list[tuple[str, str]]) -> str:
    body = "\n".join(literal.paragraph(label, text) for label, text in parts)
    last = literal.paragraph(
        "Made by", "DriveBlocks; written by the generator, so changes belong into its template or map."
    )
    return f"(* {literal.comment(title)}\n{_RULE}\n{body}\n{last} *)"


def assign(name: str) -> str:
    """A formal parameter in the example call of a head comment."""
    return f"{name} := ..."


def crc_table(octets: int = 1) -> str:
    """The 256 words of the CRC table, from the polynomial A001H, eight to a row: the change by one byte, and zeros."""
    return literal.rows(literal.word(_crc_entry(index, octets)) for index in range(256))


def _crc_entry(index: int, octets: int) -> int:
    value = index
    for _ in range(8 * octets):
        value = (value >> 1) ^ 0xA001 if value & 1 else value >> 1
    return value
