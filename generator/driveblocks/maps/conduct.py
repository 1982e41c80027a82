"""What a drive does and says without being asked, in words: a silent line, a trip, who commands it, what it is."""

from collections.abc import Iterator

from driveblocks.maps import plan
from driveblocks.maps.form import address_text, bits_text, masked_text
from driveblocks.maps.model import Condition, Drive, Reaction, Setting, State, Watchdog

UNKNOWN = "the manual does not say"
_DOES = {
    "stop": "the motor ramps down", "quick_stop": "the motor stops quickly", "coast_stop": "the motor coasts",
    "trips": "the drive trips", "runs_on": "the motor runs on", "other_speed": "the motor changes to another speed",
}  # fmt: skip
_FEEDS = {
    "read": "a read", "reference": "a written reference", "run": "a written run command", "any": "any good frame",
}  # fmt: skip
_TRIPS = {
    "coasts": "the output is switched off and the motor coasts", "ramps": "the motor is decelerated",
    "differs": "the motor coasts or is decelerated, by the fault or a setting",
}  # fmt: skip


def silent_line(drive: Drive) -> str:
    """What the motor does when the cable is cut."""
    watchdog = drive.watchdog
    return UNKNOWN + ": count on a motor that runs on" if watchdog is None else "; ".join(_watchdog(drive, watchdog))


def _watchdog(drive: Drive, watchdog: Watchdog) -> Iterator[str]:
    settings = {setting.id: setting for setting in drive.settings}
    chosen = settings.get(watchdog.chosen_by or "")
    does = ", ".join(_reaction(one, chosen) for one in watchdog.reactions)
    yield f"{chosen.id} = {does}" if chosen else does
    if watchdog.disabled_by is not None:
        yield f"{watchdog.disabled_by.setting} = {watchdog.disabled_by.value}: the motor runs on, whatever else is set"
    time, feeds = watchdog.time, watchdog.feeds
    open_ = [*(["after how long"] if time is None else []), *(["what feeds the watchdog"] if feeds is None else [])]
    if time is not None:
        where = time.setting if time.setting is not None else address_text(time.register or 0)
        yield f"after {where} x {time.milliseconds} ms"
    if feeds is not None:
        yield f"fed by {_FEEDS[feeds]}"
    if open_:
        yield f"{UNKNOWN} {' nor '.join(open_)}"
    if watchdog.note is not None:
        yield watchdog.note


def _reaction(one: Reaction, chosen: Setting | None) -> str:
    if chosen is None:
        return _DOES[one.does]
    named = next((f" {value.name.lower()}" for value in chosen.values if value.value == one.value), "")
    factory = " (factory)" if chosen.default == str(one.value) else ""
    return f"{one.value}{named}{factory}: {_DOES[one.does]}"


def reply_delay(drive: Drive) -> str | None:
    """What lets the drive answer later, and how much; None where nothing is known to."""
    delay, (factory, longest) = drive.serial.reply_delay, plan.reply_delay(drive)
    if delay is None:
        return None
    said = [f"{factory} ms as delivered"] if factory is not None else []
    said += [f"{longest} ms at most"] if longest is not None else []
    return f"by {delay.setting}, " + (", ".join(said) or f"{delay.milliseconds} ms for each count")


def trip(drive: Drive) -> str:
    """What becomes of the motor when the drive trips."""
    output = drive.faults.trip_output
    if output is None:
        return UNKNOWN + " whether the motor coasts or is ramped down"
    return f"{_TRIPS[output.motor]}{f'; {output.note}' if output.note else ''}"


def in_command(drive: Drive) -> str:
    """How the drive shows that the bus is in command."""
    bus = drive.operation.commanded_by
    return UNKNOWN + " how to see it" if bus is None else f"while {' and '.join(map(condition, bus.all))}"


def recognised(drive: Drive) -> str:
    """By what one sees that the drive is of this family."""
    identity = drive.identity
    return UNKNOWN + " how to see it" if identity is None else " and ".join(map(condition, identity.all))


def own_maximum(drive: Drive) -> str:
    """Where the drive's own maximum frequency can be read."""
    maximum = drive.operation.own_maximum
    row = drive.register_at(maximum.register) if maximum else None
    if maximum is None or row is None or row.scale is None:
        return UNKNOWN + " where to read it, or on which scale"
    return f"{address_text(maximum.register)}{f' ({row.id})' if row.id else ''} x {row.scale.factor} Hz"


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


def condition(one: Condition | State) -> str:
    """A condition or state in words: `000FH bit 0 = 0`."""
    is_ = "<>" if isinstance(one, Condition) and one.differs else "="
    if one.mask is not None:
        return masked_text(one.register, one.mask, one.equals, is_)
    bit = f" bit {bits_text(one.bit)}" if isinstance(one, Condition) and one.bit is not None else ""
    return f"{address_text(one.register)}{bit} {is_} {one.equals}"
