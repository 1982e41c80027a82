"""An explanation for a person: verdict, what is wrong, fields, registers, notes."""

from collections.abc import Iterator

from rich.console import RenderableType
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from driveblocks.desk.explain.explanation import Explanation
from driveblocks.desk.explain.guess import LONGEST, shown
from driveblocks.desk.explain.meaning import Held, Line
from driveblocks.desk.explain.reading import Field, Reading
from driveblocks.maps.form import address_text
from driveblocks.maps.model import Drive
from driveblocks.maps.view import title
from driveblocks.modbus.envelope import Wire
from driveblocks.show.layout import facts, own_head, table


def pages(made: Explanation, drive: Drive | None) -> Iterator[RenderableType]:
    yield _verdict(made)
    yield Padding(facts(*_facts(made, drive)), (0, 0, 0, 2))
    for wrong in made.all_wrongs:
        lines = facts(("wrong", Text(wrong.what, style="bold")), *(("perhaps", each) for each in wrong.instead))
        yield Padding(lines, (0, 0, 0, 2))
    yield from _readings(made)
    for note in made.notes:
        yield f"\nNote: {note}"
    for number, one in enumerate(made.inside, 1):
        yield ""
        several = len(made.inside) > 1
        yield Text(f"Frame {number} of {len(made.inside)}" if several else "The frame in it", style="bold underline")
        yield from pages(one, None)


def brief(made: Explanation) -> Iterator[str]:
    """The same in a few lines: verdict, what is wrong, and the registers with their values."""
    yield _verdict(made).plain
    yield from (f"  wrong: {wrong.what}" for wrong in made.all_wrongs)
    for one in made.readings[:1]:
        for register in one.registers:
            name = " ".join(filter(None, (register.id, register.name)))
            place = address_text(register.address) if register.address is not None else "word"
            if register.word is not None:
                yield f"  {place}  {_word(register)}  {': '.join(filter(None, (name, means(register))))}"


def written(wire: Wire) -> str:
    """A frame as it is written: bytes, or characters with CR and LF by name; what is far too long is cut off."""
    frame, more = wire.frame[:LONGEST], " ..." * (len(wire.frame) > LONGEST)
    if wire.mode == "rtu":
        return shown(frame) + more
    return frame.decode("latin-1").replace("\r", " CR").replace("\n", " LF") + more


def _verdict(made: Explanation) -> Text:
    kind = made.wire.mode.upper()
    says = _says(made) if made.meant is made.wire else ""
    if made.good:
        return Text.assemble(("Good", "bold green"), f" {kind} {says}")
    if says and made.wire.right:
        return Text.assemble(("Wrong", "bold red"), f" {kind} {says}")
    return Text.assemble(("Wrong", "bold red"), f" {kind} frame")


def _says(made: Explanation) -> str:
    if not made.readings:
        return "frame"
    more = ", or the reply that confirms it" if _same(made) else ""
    return f"{made.readings[0].says}{more}"


def _same(made: Explanation) -> bool:
    """Whether request and reply say the same."""
    return len(made.readings) > 1 and made.readings[0].registers == made.readings[1].registers


def _facts(made: Explanation, drive: Drive | None) -> Iterator[tuple[str, str]]:
    length = len(made.wire.frame)
    unit = "character" if made.wire.mode == "ascii" else "byte"
    yield "frame", written(made.wire)
    yield "length", f"{length} {unit}{'s' * (length != 1)}"
    if made.asked is not None and not made.inside:
        asked = shown(made.asked) if made.asked[:1] != b":" else made.asked.decode("latin-1").rstrip()
        yield "request", asked
    if drive is not None:
        yield "drive", title(drive)


def _readings(made: Explanation) -> Iterator[RenderableType]:
    if made.meant is not None and made.meant is not made.wire:
        yield f"\nRead as {made.meant.mode.upper()} {written(made.meant)}:"
    elif not made.wire.right and made.readings:
        yield "\nRead as if the checksum were right:"
    if _same(made):
        yield from _reading(made, made.readings[0], titled=False)
        return
    for one in made.readings:
        yield from _reading(made, one, titled=len(made.readings) > 1)


def _reading(made: Explanation, one: Reading, *, titled: bool) -> Iterator[RenderableType]:
    if titled or made.meant is not made.wire:
        yield f"\n{one.says[:1].upper()}{one.says[1:]}"
    yield ""
    yield _fields(one.fields)
    if any(each.word is not None for each in one.registers) or sum(bool(each.name) for each in one.registers) > 1:
        yield ""
        yield _registers(one.registers)
    for note in one.notes:
        yield f"\n{note}"


def _fields(fields: tuple[Field, ...]) -> Table:
    made = table("field", "bytes", "means", wide=("bytes", "means"))
    for field in fields:
        made.add_row(field.name, shown(field.data), field.means)
    return made


def _registers(registers: tuple[Held, ...]) -> Table:
    """Registers with their words; without words only their names, and without names only the words."""
    words = any(one.word is not None for one in registers)
    named = any(one.name or one.note for one in registers)
    own = [one.zh for one in registers] + [line.zh for one in registers for line in one.lines]
    head = own_head(own)
    columns = [name for name, shown in (("word", words), ("name", named), (head, any(own)), ("means", words)) if shown]
    made = table("address", *columns, wide={"name", head, "means"} & set(columns))
    for number, one in enumerate(registers, 1):
        place = address_text(one.address) if one.address is not None else f"word {number}"
        name = "  ".join(filter(None, (one.id, one.name))) or ("" if one.known else one.note)
        cells = {"word": _word(one), "name": name, head: one.zh, "means": means(one)}
        made.add_row(place, *(cells[column] for column in columns))
        for line in one.lines:
            cells = {**_line(line), head: line.zh}
            made.add_row(f" {line.mark}", *(cells[column] for column in columns))
    return made


def _word(one: Held) -> str:
    return "" if one.word is None else f"{one.word:04X}H"


def means(one: Held) -> str:
    """The number, its engineering value, and what is to be known of it."""
    if one.word is None:
        return ""
    number = f"{one.number}" + (f" = {one.value} {one.unit or ''}".rstrip() if one.value is not None else "")
    note = one.note if one.known else ""
    return "; ".join(filter(None, (number, note)))


def _line(line: Line) -> dict[str, str]:
    value = "" if line.value is None else f"= {line.value}"
    return {"word": value, "name": "  ".join(filter(None, (line.id, line.name))), "means": ""}
