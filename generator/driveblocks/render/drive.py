"""Map -> values for the drive block: what it reads, what each pin is made of, and what each command writes."""

from collections.abc import Iterator

from driveblocks.maps import names
from driveblocks.maps.model import Command, Drive, Measured, Register, Step
from driveblocks.maps.plan import plan
from driveblocks.maps.polls import MOST_WORDS, Poll, polls, schedule
from driveblocks.maps.view import error_number
from driveblocks.render import context
from driveblocks.render.context import Context, word_input
from driveblocks.render.expression import Test

STOPS = {"stop": 1, "quick_stop": 2, "coast_stop": 3, "jog_stop": 4}
"""Command -> its number as StopKind of DB_Control."""
ORDERS = {"run_forward": 5, "run_reverse": 6, "jog_forward": 7, "jog_reverse": 8, "fault_reset": 9}
"""Command -> its number as Order or Sent of DB_Control."""
MEASURES = {
    "output_frequency": ("OutputFrequency", "Hz", "FrequencyScale"),
    "output_current": ("OutputCurrent", "A", "CurrentScale"),
    "output_voltage": ("OutputVoltage", "V", "VoltageScale"),
    "dc_bus_voltage": ("DcBusVoltage", "V", "DcVoltageScale"),
    "output_power": ("OutputPower", "KW", "PowerScale"),
}
"""What a register can show -> the pin, its unit, and the setting that stands in for a scale."""
STATUS = ("running", "reverse", "at_speed", "zero_speed", "ready", "warning", "fault")


def drive_block(drive: Drive) -> Context:
    """For Drive."""
    reads = polls(drive)
    commands = {one.does: one for one in drive.operation.commands}
    written = _Written(drive)
    return {
        "source": context.source_of(drive, commands["stop"].source),
        "unit": drive.serial.unit,
        "reads": [_read(drive, number, read) for number, read in enumerate(reads, 1)],
        "turns": [number + 1 for number in schedule(reads)],
        "status": {one.shows: [_condition(drive, each) for each in one.any] for one in drive.operation.status},
        "proof": [word_input(drive, each) for each in _proof(drive)],
        "fault": _fault(drive),
        "verify": [_condition(drive, each) for each in drive.operation.reference.verify],
        "measures": {one.shows: _measure(drive, one) for one in drive.operation.measures},
        "pins": MEASURES,
        "stops": {STOPS[does]: written.last(one) for does, one in commands.items() if does in STOPS},
        "orders": {ORDERS[does]: list(written.all(one)) for does, one in commands.items() if does in ORDERS},
        "waits": list(_waits(drive)),
        "reference": drive.operation.reference.register,
        "scaled": context.reference(drive)["scale"] is not None,
        "can": commands,
        "write": 6 if 6 in plan(drive).functions else 16,
        "manners": context.reply(drive)["form"],
        "two_byte_count": context.reply(drive)["two_byte_count"],
        "busy": next((error_number(one) or 0 for one in drive.errors.codes if one.busy), 0),
        "silence": _silence(drive),
        "second_hand": drive.manual.second_hand,
        "age": {each["address"]: each["number"] for each in _places(drive, reads)},
    }


class _Written:
    """What commands write: the register, the bits, and the mask of the bits that pass through."""

    def __init__(self, drive: Drive) -> None:
        self.drive = drive

    def last(self, one: Command | Step) -> Context:
        """A write of a value, or of bits in the place of those that no command uses."""
        if one.value is not None:
            return {"register": one.register, "bits": one.value, "keep": 0}
        keep = context.kept(self.drive).get(one.register, 0)
        return {"register": one.register, "bits": context.bits_of(one.set), "keep": keep}

    def all(self, one: Command) -> Iterator[Context]:
        """All writes of a command, in order."""
        yield from map(self.last, one.first)
        yield self.last(one)


def _waits(drive: Drive) -> Iterator[Context]:
    """What each write but the last of a command waits for: a state, a time."""
    states = {one.name: one for one in drive.operation.states}
    for command in drive.operation.commands:
        for number, step in enumerate(command.first):
            state = states[step.until] if step.until else None
            yield {
                "key": ORDERS[command.does] * 16 + number,
                "does": command.does,
                "state": state,
                "test": _test(drive, state.register, state.mask or 0, state.equals) if state else None,
                "hold": step.for_ms or 0,
            }


def _places(drive: Drive, reads: tuple[Poll, ...]) -> Iterator[Context]:
    """Each word that the block keeps, and the number of the read that brings it."""
    from driveblocks.maps.polls import fast_words, slow_words

    for address in sorted(fast_words(drive) | slow_words(drive)):
        for number, read in enumerate(reads, 1):
            if read.address <= address < read.address + read.words:
                yield {**word_input(drive, address), "number": number, "index": address - read.address}


def _read(drive: Drive, number: int, read: Poll) -> Context:
    words = [place for place in _places(drive, polls(drive)) if place["number"] == number]
    beyond = read.address + read.words
    others = plan(drive).readable
    varied = any(read.address in span and beyond in span for span in others) and read.words < MOST_WORDS
    return {"number": number, "read": read, "words": words, "other": read.words + 1 if varied else 0}


def _proof(drive: Drive) -> list[int]:
    return list(dict.fromkeys(one.register for one in drive.operation.standstill.all))


def _condition(drive: Drive, one: context.Condition) -> Test:
    return context.tested(word_input(drive, one.register)["name"], one)


def _test(drive: Drive, register: int, mask: int, value: int) -> Test:
    return Test(word_input(drive, register)["name"], mask, value)


def _fault(drive: Drive) -> Context:
    """Where the code of the present fault comes from."""
    if drive.faults.present is not None:
        return {"word": word_input(drive, drive.faults.present), "words": []}
    numbers = context.fault_number(drive)
    return {"word": None, "words": numbers["words"] if numbers else []}


def _measure(drive: Drive, one: Measured) -> Context:
    row = drive.register_at(one.register)
    assert row is not None  # noqa: S101  (a checked map lists the registers that it measures)
    return {
        "word": word_input(drive, one.register),
        "scale": row.scale if _same_unit(row, one) else None,
        "when": _condition(drive, row.scale.when) if row.scale and row.scale.when else None,
        "signed": row.signed,
    }


def _same_unit(row: Register, one: Measured) -> bool:
    return row.scale is not None and names.UNIT_NAMES.get(row.unit or "") == MEASURES[one.shows][1]


def _silence(drive: Drive) -> int:
    silence = drive.serial.silence
    return int(silence.milliseconds or 0) if silence else 0
