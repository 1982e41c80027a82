"""What a drive does and says without being asked, in words: a silent line, a trip, who commands it, what it is."""

from collections.abc import Iterator

from driveblocks.maps.form import address_text, bits_text
from driveblocks.maps.model import Drive
from driveblocks.meaning import measure
from driveblocks.meaning.reference import reference
from driveblocks.meaning.serial import serial
from driveblocks.meaning.setting import Setting, setting
from driveblocks.meaning.status import status
from driveblocks.meaning.watchdog import Watchdog, watchdog

UNKNOWN = "the manual does not say"
_DOES = {
    "stop": "the motor ramps down", "quick_stop": "the motor stops quickly", "coast_stop": "the motor coasts",
    "trips": "the drive trips", "runs_on": "the motor runs on", "other_speed": "the motor changes to another speed",
}  # fmt: skip
_FEEDS = {"any": "any good frame", "reads": "any good read", "writes": "any good write"}
_COUNTS = {
    "running": "while the motor runs", "always": "at standstill, too", "bus_in_command": "while the bus is in command",
}  # fmt: skip
_TRIPS = {
    "coasts": "the output is switched off and the motor coasts", "ramps": "the motor is decelerated",
    "differs": "the motor coasts or is decelerated, by the fault or a setting",
}  # fmt: skip


def silent_line(drive: Drive) -> str:
    """What the motor does when the cable is cut."""
    own = watchdog(drive)
    return UNKNOWN + ": count on a motor that runs on" if own is None else "; ".join(_watchdog(drive, own))


def delivered(drive: Drive) -> str:
    """What the motor does when the cable is cut and nobody has changed what the watchdog is set to."""
    own = watchdog(drive)
    if own is None:
        return UNKNOWN + ": count on a motor that runs on"
    off = setting(drive, own.off[0]) if own.off else None
    if own.off and off and off.factory == own.off[1]:
        return f"as delivered ({off.keypad.code} {off.delivered}) the motor runs on"
    chosen, by = setting(drive, own.chosen_by), setting(drive, own.time.setting) if own.time else None
    factory = chosen.factory if chosen else None
    does = next((_DOES[does] for value, does in own.reactions if factory == value), None)
    if does is None:
        return f"what {chosen.keypad.code} says; how it is delivered is not known" if chosen else UNKNOWN
    if own.off and off and off.editions:
        return f"{off.keypad.code} as delivered {off.delivered}: with {own.off[1]} the motor runs on, otherwise {does}"
    after = (
        f"after {by.delivered} of silence ({by.keypad.code})" if by and by.default else "after a time that is not known"
    )
    return f"as delivered{f' ({chosen.keypad.code} {chosen.delivered})' if chosen else ''} {does} {after}"


def _watchdog(drive: Drive, own: Watchdog) -> Iterator[str]:
    chosen = setting(drive, own.chosen_by)
    does = ", ".join(_reaction(*each, chosen) for each in own.reactions)
    yield f"by {chosen.keypad.code}: {does}" if chosen else does
    if own.off is not None and own.off[0] != own.chosen_by:
        yield f"{own.off[0]} = {own.off[1]}: the motor runs on, whatever else is set"
    time, fed = own.time, _FEEDS.get(own.feeds or "")
    if own.fed_by:
        fed = f"writes to {', '.join(map(address_text, own.fed_by))} alone"
    open_ = [*(["after how long"] if time is None else []), *(["what feeds the watchdog"] if fed is None else [])]
    if time is not None:
        by = setting(drive, time.setting)
        yield f"after {_shown(by)}" if by else f"after {address_text(time.register or 0)} x {time.count_ms} ms"
    if fed is not None:
        yield f"fed by {fed}"
    if own.counts is not None:
        yield f"it counts {_COUNTS[own.counts]}"
    if open_:
        yield f"{UNKNOWN} {' nor '.join(open_)}"
    if own.note is not None:
        yield own.note


def _shown(by: Setting) -> str:
    """A time at the keypad: A106, 0.1 to 60.0 s."""
    return f"{by.keypad.code}, {by.allowed or f'in {by.keypad.unit}'}"


def _reaction(value: int | None, does: str, chosen: Setting | None) -> str:
    if chosen is None:
        return _DOES[does]
    factory = " (factory)" if chosen.default == str(value) else ""
    return f"{value} {chosen.named(value).lower()}".strip() + f"{factory}: {_DOES[does]}"


def reply_delay(drive: Drive) -> str | None:
    """What lets the drive answer later, and how much; None where nothing is known to."""
    delay = serial(drive).delay
    if delay is None:
        return None
    said = [f"{delay.factory_ms} ms as delivered"] if delay.factory_ms is not None else []
    said += [f"{delay.most_ms} ms at most"] if delay.most_ms is not None else []
    return f"by {delay.setting}, " + (", ".join(said) or f"{delay.count_ms} ms for each count")


def trip(drive: Drive) -> str:
    """What becomes of the motor when the drive trips."""
    output = drive.faults.trip_output
    if output is None:
        return UNKNOWN + " whether the motor coasts or is ramped down"
    return f"{_TRIPS[output.motor]}{f'; {output.note}' if output.note else ''}"


def in_command(drive: Drive) -> str:
    """How the drive shows that the bus is in command."""
    bus = status(drive).by_bus.patterns
    return f"while {' and '.join(map(str, bus))}" if bus else UNKNOWN + " how to see it"


def recognised(drive: Drive) -> str:
    """By what one sees that the drive is of this family."""
    return " and ".join(map(str, status(drive).identity.patterns)) or UNKNOWN + " how to see it"


def own_maximum(drive: Drive) -> str:
    """Where the drive's own maximum frequency can be read."""
    maximum = measure.own_maximum(drive)
    row = drive.register_at(maximum.register) if maximum else None
    if maximum is None or row is None or maximum.quantity.factor is None:
        return UNKNOWN + " where to read it, or on which scale"
    return f"{address_text(maximum.register)}{f' ({row.id})' if row.id else ''} x {maximum.quantity.factor} Hz"


def lower_limit(drive: Drive) -> str:
    """What the motor does where less is asked for than the drive gives."""
    one = reference(drive).lower_limit
    return f"{one}: with less, 0 too, the motor may turn at it" if one else UNKNOWN + " whether 0 Hz may turn the motor"


def silenced(drive: Drive) -> str | None:
    """How long the drive is silent in a fault reset, where the map says it."""
    found = drive.operation.silenced
    if found is None:
        return None
    writes = next(len(one.writes) for one in drive.operation.commands if one.does == "fault_reset")
    after = f"write {found[0] + 1} of {writes} of a fault reset" if writes > 1 else "a fault reset"
    return f"it answers nothing for {found[1]} ms after {after}; the block does not ask it meanwhile, and sends stops"


def nevers(drive: Drive) -> Iterator[str]:
    """What must never be sent, and what the drive would do."""
    for _, row in drive.registers():
        for one in row.never:
            bits = f"bit{'s' * (len(one.bit) > 1)} {bits_text(one.bit)}"
            yield f"{address_text(row.address.first)} {bits} = {one.equals}: {one.why}"
