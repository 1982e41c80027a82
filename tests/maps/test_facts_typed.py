"""Maps against the facts in `tests/families/`, which were typed from the documents by hand, in the form named there."""

from collections.abc import Callable, Iterable

import pytest
from tests import families
from tests.shipped import drives

from driveblocks.maps.form import is_bit, wire
from driveblocks.maps.model import Command, Condition, Drive, Register, Step

pytestmark = pytest.mark.every_family


def place(register: int) -> str:
    """An address as the tables write it: `006F`, or `coil 0001`."""
    number = f"{wire(register):04X}"
    return f"coil {number}" if is_bit(register) else number


def rows(drive: Drive) -> dict[str, list[str]]:
    """Every row by its address: id, access, unit, factor with `signed` and `words 2`."""
    return {
        place(row.address.first): [row.id or "-", row.access or section.access, row.unit or "-", _number(row)]
        for section in drive.sections
        for row in section.registers
    }


def _number(row: Register) -> str:
    factor = f"{row.scale.factor:f}" if row.scale else ""
    parts = [factor, "signed" * bool(row.signed), "words 2" * (row.words == 2)]
    return " ".join(filter(None, parts)) or "-"


def written(one: Command | Step) -> str:
    """A write: `2000=0001`, or bits set and cleared, `2000+1-0`."""
    if one.value is not None:
        return f"{place(one.register)}={one.value & 0xFFFF:04X}"
    bits = [f"{sign}{bit:X}" for sign, some in (("+", one.set), ("-", one.clear)) for span in some for bit in span]
    return place(one.register) + "".join(bits)


def asked(one: Condition) -> str:
    """A condition: `0003.2=1`, `0003&0104=0104`, `0003!=0`, `0003<0`."""
    bit = f".{f'{one.bit.last:X}-' * (one.bit.last != one.bit.first)}{one.bit.first:X}" if one.bit else ""
    mask = f"&{one.mask:04X}" if one.mask is not None else ""
    if one.equals is not None:
        value = one.equals if one.mask is None else f"{one.equals:04X}"
        test = f"{'!' * bool(one.differs)}={value}"
    else:
        test = f"<{one.below}" if one.below is not None else f">{one.above}"
    return f"{place(one.register)}{bit}{mask}{test}"


def _all(some: Iterable[Condition]) -> str:
    return " ".join(map(asked, some))


def _reference(drive: Drive) -> str:
    one = drive.operation.reference
    scale = [] if one.full_scale is None else [str(one.full_scale)]
    return " ".join([place(one.register), one.means, *scale])


def _rates(drive: Drive) -> dict[int, int] | list[int]:
    codes = drive.serial.baud.codes if drive.serial.baud else ()
    coded = {one.code: one.baud for one in codes if one.code is not None}
    return coded or [one.baud for one in codes]


def _forms(drive: Drive) -> dict[int, str]:
    codes = drive.serial.format.codes if drive.serial.format else ()
    return {
        one.code: f"{one.data_bits}{one.parity[0].upper()}{one.stop_bits or ''}"
        for one in codes
        if one.code is not None
    }


def _watchdog(drive: Drive) -> tuple[str | None, int, int | None] | None:
    one = drive.watchdog
    time = one.time if one else None
    return (time.setting, int(time.milliseconds), one.fault) if one and time else None


SAYS: dict[str, Callable[[Drive], object]] = {
    "COMMANDS": lambda one: {
        str(each.does): " ".join([*map(written, each.first), written(each)]) for each in one.operation.commands
    },
    "WAITS": lambda one: tuple(step.until or step.for_ms for step in one.operation.commands[0].first),
    "REFERENCE": _reference,
    "STANDSTILL": lambda one: _all(one.operation.standstill.all),
    "SHOWS": lambda one: {str(each.shows): _all(each.any) for each in one.operation.status},
    "MEASURES": lambda one: {str(each.shows): place(each.register) for each in one.operation.measures},
    "NEEDED": lambda one: {
        each.id: each.needed.value for each in one.settings if each.needed and each.needed.value is not None
    },
    "RATES": _rates,
    "FORMS": _forms,
    "FUNCTIONS": lambda one: [each.code for each in one.functions],
    "REFUSALS": lambda one: {each.code: each.name for each in one.errors.codes},
    "FAULTS": lambda one: {each.code: each.name for each in one.faults.codes},
    "LIMITS": lambda one: {
        name: limit.value for name in ("read_words", "write_words") if (limit := getattr(one.limits, name))
    },
    "UNIT": lambda one: (one.serial.unit.min, one.serial.unit.max, one.serial.unit.default),
    "WATCHDOG": _watchdog,
}
"""Name in a module -> what the map says of it, in the same form."""
TYPED = [(prefix, name) for name in SAYS for prefix in families.own(name)]


@pytest.mark.parametrize(("prefix", "name"), TYPED)
def test_the_map_says_what_was_typed(prefix: str, name: str) -> None:
    held, typed = SAYS[name](drives()[prefix]), families.own(name)[prefix]
    assert (list(held) if isinstance(typed, list) and isinstance(held, dict) else held) == typed


@pytest.mark.parametrize("prefix", families.own("ROWS"))
def test_the_rows_are_those_that_were_typed(prefix: str) -> None:
    held = rows(drives()[prefix])
    typed = [line.split(" | ") for line in families.own("ROWS")[prefix].strip().splitlines()]
    assert [[at, *held.get(at, ["is not in the map"])] for at, *_ in typed] == typed


def test_forty_facts_were_typed_of_each_family_that_came_by_this_table() -> None:
    def count(one: object) -> int:
        lines = one.strip().splitlines() if isinstance(one, str) else []
        return len(one) if isinstance(one, dict | list) else 1 if len(lines) == 1 else 4 * len(lines)

    named = [*SAYS, "ROWS"]
    facts = {
        prefix: sum(count(families.said(name)[prefix]) for name in named if prefix in families.said(name))
        for prefix in families.own("ROWS")
    }
    assert {prefix: number for prefix, number in facts.items() if number < 40} == {}
