"""Map -> values for the drive block: what it reads, what each pin is made of, and what each command writes."""

from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache

from driveblocks.maps import names
from driveblocks.maps.model import Command, Condition, Drive, Measured
from driveblocks.maps.plan import plan
from driveblocks.maps.polls import Poll, beyond, fast_words, identity_read, polls, schedule, slow_words
from driveblocks.maps.revision import checked
from driveblocks.maps.view import error_number
from driveblocks.render import context
from driveblocks.render.constants import ORDERS, STOPS
from driveblocks.render.context import Context, Word, word_input
from driveblocks.render.decoded import Decoded
from driveblocks.render.expression import Test

CONSTANTS = {
    "stop": "RAMP_STOP", "quick_stop": "QUICK_STOP", "coast_stop": "COAST_STOP", "jog_stop": "JOG_STOP",
    "run_forward": "GO_FORWARD", "run_reverse": "GO_REVERSE", "jog_forward": "JOG_AHEAD", "jog_reverse": "JOG_BACK",
    "fault_reset": "RESET_FAULT",
}  # fmt: skip
"""Command -> the constant of that number, as VFD_Control has it."""
MEASURES = {
    "output_frequency": ("OutputFrequency", "Hz", "FrequencyScale"),
    "output_current": ("OutputCurrent", "A", "CurrentScale"),
    "output_voltage": ("OutputVoltage", "V", "VoltageScale"),
    "dc_bus_voltage": ("DcBusVoltage", "V", "DcVoltageScale"),
    "output_power": ("OutputPower", "KW", "PowerScale"),
}
"""What a register can show -> the pin, its unit, and the setting that replaces a scale."""
PINNED = ("output_frequency", "output_current")
"""The measures that are outputs of the block; the rest are members of Diagnosis."""
STATUS = {
    "running": "Running", "reverse": "Reverse", "at_speed": "AtSpeed", "zero_speed": "ZeroSpeed",
    "warning": "Warning", "fault": "Fault",
}  # fmt: skip
"""What a drive can show -> the pin or variable."""


@lru_cache
def drive_block(drive: Drive) -> Context:
    """For Drive."""
    reads = polls(drive)
    places = list(_places(drive, reads))
    commands = {one.does: one for one in drive.operation.commands}
    written = [(one, list(_writes(drive, one, commands["stop"]))) for one in commands.values()]
    number = {each.address: each.number for each in places}
    turns = [index + 1 for index in schedule(reads)]
    reference, operation, dialect = context.reference(drive), drive.operation, context.reply(drive)
    orders = {ORDERS[one.does]: writes for one, writes in written if one.does in ORDERS}
    told = Decoded(drive)
    says = {one.shows: [told.holds(each) for each in one.any] for one in operation.status}
    verified = [told.holds(each) for each in operation.reference.verify]
    measures = {one.shows: _measure(drive, one, told) for one in operation.measures}
    waits = list(_waits(drive, told))
    return {
        "source": context.source_of(drive, commands["stop"].source),
        "prefix": drive.prefix,
        "unit": drive.serial.unit,
        "reads": [
            _read(drive, index, read, places, {each.words for each in reads}) for index, read in enumerate(reads, 1)
        ],
        "number": number,
        "turns": turns,
        "places": {index: [turn for turn, each in enumerate(turns) if each == index] for index in turns},
        "shown": STATUS,
        "status": {one.shows: [_condition(drive, each) for each in one.any] for one in operation.status},
        "says": says,
        "verified": verified,
        "decoders": told.used,
        "proof": [word_input(drive, each) for each in _proof(drive)],
        "proof_reads": sorted({number[each] for each in _proof(drive)}),
        "fault": _fault(drive),
        "fault_reads": _fault_reads(drive, number),
        "fast_reads": [index for index, read in enumerate(reads, 1) if read.fast],
        "state_reads": sorted({number[each.register] for each in operation.states}),
        "verify": [_condition(drive, each) for each in operation.reference.verify],
        "verify_reads": _verify_reads(drive, number),
        "measures": measures,
        "measure_reads": sorted({number[one.register] for one in operation.measures}),
        "pins": {shows: pin_of(shows) for shows in MEASURES},
        "stops": {STOPS[one.does]: writes[0] for one, writes in written if one.does in STOPS},
        "orders": orders,
        "order_names": {ORDERS[does]: does.replace("_", " ") for does in ORDERS},
        "order_constants": {ORDERS[does]: CONSTANTS[does] for does in ORDERS},
        "stop_names": {STOPS[does]: does.replace("_", " ") for does in STOPS},
        "stop_constants": {STOPS[does]: CONSTANTS[does] for does in STOPS},
        "longest": max(map(len, orders.values())),
        "waits": waits,
        "reference": operation.reference.register,
        "scaled": reference["scale"] is not None,
        "percent": reference["percent"],
        "can": commands,
        "keeps": context.kept(drive),
        "write": 6 if 6 in plan(drive).functions else 16,
        "dialect": dialect["form"],
        "two_byte_count": dialect["two_byte_count"],
        "busy": next((error_number(one) or 0 for one in drive.errors.codes if one.busy), 0),
        "silence": _silence(drive),
        "second_hand": drive.manual.second_hand,
        "checked": checked(drive),
        "maximum": reference["maximum"],
        "identity": _identity(drive),
        "commanded_by": _commanded_by(drive, number, told),
        "own_maximum": _own_maximum(drive),
        "feeds": drive.watchdog.feeds if drive.watchdog else None,
    }


def _writes(drive: Drive, one: Command, stop: Command) -> Iterator[Context]:
    """All writes of a command in order: register, bits, and the mask of the bits that pass through.

    Bits that a write neither sets nor clears stay as the write before has left them; a reset begins as a stop.
    """
    kept = context.kept(drive)
    image = {stop.register: context.bits_of(stop.set)} if one.does == "fault_reset" else {}
    holds = [*(step.for_ms or 0 for step in one.first), 0]
    moves = one.does in ORDERS and one.does != "fault_reset"
    for write, hold in zip(one.writes, holds, strict=True):
        if write.value is not None:
            image[write.register] = write.value
        else:
            before = image.get(write.register, 0) & ~context.bits_of(write.clear)
            image[write.register] = before | context.bits_of(write.set)
        keep = 0 if write.value is not None else kept.get(write.register, 0)
        yield {
            "register": write.register,
            "bits": image[write.register],
            "keep": keep,
            "hold": hold,
            "moves": moves and write is one,
        }


def _waits(drive: Drive, told: Decoded) -> Iterator[Context]:
    """The state that a write but the last of a command waits for, where it waits for one."""
    states = {one.name: one for one in drive.operation.states}
    for command in drive.operation.commands:
        for number, step in enumerate(command.first):
            if step.until is not None:
                state = states[step.until]
                yield {"order": ORDERS[command.does], "step": number, "state": state, "says": told.holds(state)}


def _places(drive: Drive, reads: tuple[Poll, ...]) -> Iterator[Word]:
    """Each word that the block keeps, and the number of the read that brings it."""
    for address in sorted(fast_words(drive) | slow_words(drive)):
        for number, read in enumerate(reads, 1):
            if read.address <= address < read.address + read.words:
                yield replace(word_input(drive, address), number=number, index=address - read.address)


def _read(drive: Drive, number: int, read: Poll, places: list[Word], taken: set[int]) -> Context:
    words = [place for place in places if place.number == number]
    return {"number": number, "read": read, "words": words, "other": beyond(drive, read, taken)}


def _identity(drive: Drive) -> Context | None:
    """The one read that shows the family, and the bits that count in each of its words, in their place."""
    read = identity_read(drive)
    if read is None or drive.identity is None:
        return None
    tests = [_condition(drive, each) for each in drive.identity.all]
    words = [each.register - read.address for each in drive.identity.all]
    return {
        "function": read.function,
        "address": read.address,
        "words": read.words,
        "tests": [
            {"index": index, "mask": test.mask or 0xFFFF, "value": test.value}
            for index, test in zip(words, tests, strict=True)
        ],
        "source": context.source_of(drive, drive.identity.source),
    }


def _commanded_by(drive: Drive, number: dict[int, int], told: Decoded) -> Context | None:
    """What all has to hold while the bus is in command, and the reads that bring it."""
    bus = drive.operation.commanded_by
    if bus is None:
        return None
    return {
        "holds": [told.holds(each) for each in bus.all],
        "reads": sorted({number[each.register] for each in bus.all}),
        "source": context.source_of(drive, bus.source),
    }


def _own_maximum(drive: Drive) -> Context | None:
    """The word of the drive's own maximum frequency, and its scale."""
    maximum = drive.operation.own_maximum
    row = drive.register_at(maximum.register) if maximum else None
    if maximum is None or row is None:
        return None
    return {
        "word": word_input(drive, maximum.register),
        "scale": row.scale,
        "function": names.block(drive.prefix, names.symbol(row) + names.UNIT_NAMES[row.unit or "Hz"]),
        "source": context.source_of(drive, maximum.source),
    }


def _proof(drive: Drive) -> list[int]:
    return list(dict.fromkeys(one.register for one in drive.operation.standstill.all))


def _condition(drive: Drive, one: Condition) -> Test:
    return context.tested(word_input(drive, one.register).name, one)


def _fault(drive: Drive) -> Context:
    """Where the code of the present fault comes from."""
    if drive.faults.present is not None:
        return {"word": word_input(drive, drive.faults.present), "words": []}
    numbers = context.fault_number(drive)
    return {"word": None, "words": numbers["words"] if numbers else []}


def _verify_reads(drive: Drive, number: dict[int, int]) -> list[int]:
    """The reads that show what the reference means."""
    operation = drive.operation
    registers = {each.register for each in operation.reference.verify}
    registers |= {operation.own_maximum.register} if operation.own_maximum else set()
    return sorted(number[each] for each in registers)


def _fault_reads(drive: Drive, number: dict[int, int]) -> list[int]:
    """The reads that show whether there is a fault, and which."""
    shown = [each.register for one in drive.operation.status if one.shows == "fault" for each in one.any]
    fault = _fault(drive)
    words = [fault["word"]] if fault["word"] else fault["words"]
    return sorted({number[each] for each in (*shown, *(word.address for word in words))})


def pin_of(shows: str) -> Context:
    """Where a drive block shows a measure: two have pins of their own, all say in Diagnosis whether they are valid."""
    name, unit, setting = MEASURES[shows]
    where = "" if shows in PINNED else "Diagnosis."
    return {"pin": f"{where}{name}{unit}", "valid": f"{name}Valid", "unit": unit, "setting": setting}


def _measure(drive: Drive, one: Measured, told: Decoded) -> Context:
    row = drive.register_at(one.register)
    assert row is not None  # noqa: S101  (a checked map lists the registers that it measures)
    scale = row.scale if names.UNIT_NAMES.get(row.unit or "") == MEASURES[one.shows][1] else None
    return {
        **pin_of(one.shows),
        "word": word_input(drive, one.register),
        "scale": scale,
        "function": names.block(drive.prefix, names.symbol(row) + MEASURES[one.shows][1]),
        "when": told.holds(scale.when) if scale and scale.when else None,
        "signed": row.signed,
    }


def _silence(drive: Drive) -> int:
    silence = drive.serial.silence
    return int(silence.milliseconds or 0) if silence else 0
