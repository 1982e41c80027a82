"""What the rules of a drive block take from its map: the frames of every command, and what proves standstill.

Taken from the map itself, not from what the generator made of it.
"""

from collections.abc import Iterable, Iterator, Mapping

from driveblocks.maps.form import is_bit
from driveblocks.maps.model import Drive
from driveblocks.maps.plan import busy, writes_by
from driveblocks.maps.revision import checked
from driveblocks.maps.rivals import first_reads, refusals
from driveblocks.maps.trust import second_hand
from driveblocks.meaning.measure import PINS, Measure, measures, own_maximum
from driveblocks.meaning.pattern import Pattern
from driveblocks.meaning.polls import Poll, fast_words, fault_words, polls, schedule, slow_words
from driveblocks.meaning.reference import reference
from driveblocks.meaning.roles import roles
from driveblocks.meaning.serial import serial
from driveblocks.meaning.status import status
from driveblocks.meaning.words import MOTIONS, STOPS, Command, CommandWord, Field, words
from driveblocks.modbus.layout import COIL_ON
from driveblocks.render.context import word_input
from driveblocks.render.decoded import Decoded
from driveblocks.render.drive import CONSTANTS, STATUS
from structured_text.language.writing import word

SENT = {does: CONSTANTS[does] for does in (*MOTIONS, "fault_reset")}
"""What the control calls a command."""
ALL, SIGN = 0xFFFF, 0x8000
BELIEVED = "NOT Doubtful AND (Surplus = Was.SurplusSeen)"
"""What nobody else can have asked for."""
NEAR = (
    "AtSpeed = (Running AND Diagnosis.OutputFrequencyValid AND (OutputFrequencyHz >= Speed.AskedHz - REAL#0.5) "
    "AND (OutputFrequencyHz <= Speed.AskedHz + REAL#0.5))"
)
"""When AtSpeed is shown where the drive does not say so itself."""


def facts(drive: Drive) -> dict[str, str]:
    """The facts of a family by the names under which the rules have them, as ST."""
    commands = words(drive).named
    shows, speed = status(drive), reference(drive)
    found = {
        "P": drive.prefix,
        "lowest": str(serial(drive).lowest),
        "highest": str(serial(drive).highest),
        "write": str(writes_by(drive, words(drive).stop.last.register)),
        "reference": word(speed.register),
        "written": _written(drive),
        "sent_word": f"Slot.Ask[1].Words[{speed.quantity.low - speed.register}]",
        "holds_reference": _is_reference(drive),
        "standstill": _every(_holds(drive, each) for each in shows.standstill.patterns),
        "proof_since": _each("Reads.Since{n}", roles(drive).proof),
        **_read(drive),
        **_shown(drive),
        **_reference(drive),
        "holds_ms": _every(_holds_ms(drive)),
        "at_a_write": _every(_writes(commands, "(Control.Sent <> {name}) OR (Control.StepNumber <= {last})")),
        "all_written": _every(_writes(commands, "(Control.Send.Order <> {name}) OR (Control.Send.OrderStep = {last})")),
        "unwritable": _every(_beside(each) for each in sorted(_command_registers(drive)) if not is_bit(each)),
        "keep": "Settings.KeepWord" if any(one.last.keeps for one in commands.values()) else word(0),
    }
    shown = {one.name for one in shows.shown}
    measured = {one.name for one in measures(drive)}
    for pin in ("reverse", "fault", "warning", "at_speed", "zero_speed"):
        computed = pin.endswith("speed") and "output_frequency" in measured
        found[f"shows_{pin}"] = str(pin in shown or computed).upper()
    for name, member in (("may_stop", "MayStop"), ("known", "Known"), ("wrong", "Wrong")):
        found[name] = f"Identity.{member}" if first_reads(drive) else str(name != "wrong").upper()
    running, by_bus = shows.shows("running"), shows.by_bus.patterns
    found["running"] = _any(_holds(drive, each) for each in running)
    found["by_bus"] = _every(_holds(drive, each) for each in by_bus)
    found["says_by_bus"] = _every(Decoded(drive).holds(each) for each in by_bus)
    found["others_command"] = f"Control.Seen.OthersCommand <> ({found['says_by_bus']})" if by_bus else "TRUE"
    found["says_running"] = _any(Decoded(drive).holds(each) for each in running)
    for does in (*MOTIONS, *STOPS, "fault_reset"):
        one = commands.get(does)
        ask = "Slot.Ask[0]" if does in STOPS else "Slot.Ask[1]"
        found[does] = _any(_frames(drive, one, ask)) if one else "FALSE"
        found[f"last_{does}"] = list(_frames(drive, one, ask))[-1] if one else "FALSE"
        found[f"can_{does}"] = str(one is not None).upper()
    copies = {"copy_stop": ("stop", "Slot.Stop"), "copy_jog_stop": ("jog_stop", "Slot.JogStop")}
    for name, (stop, copy) in copies.items():
        frame = found[f"last_{stop}"].replace("Slot.Ask[0].Address", f"{copy}Register")
        found[name] = frame.replace("Slot.Ask[0].Words[0]", f"{copy}Word") if stop in commands else "TRUE"
    found["stop_moves"], found["reset_moves"] = _moves(drive, "Slot.Ask[0]"), _moves(drive, "Slot.Ask[1]")
    found["quick_or_stop"] = found["quick_stop"] if "quick_stop" in commands else found["stop"]
    found["coast_or_stop"] = found["coast_stop"] if "coast_stop" in commands else found["stop"]
    return found


def _frames(drive: Drive, one: Command, ask: str) -> Iterator[str]:
    """Each write of a command as a condition on a request: its register, and its word with the bits that are kept."""
    for write in one.writes:
        value = word(COIL_ON * write.word if is_bit(write.register) else write.word)
        sent = f"({ask}.Words[0] AND {word(ALL ^ write.keeps)})" if write.keeps else f"{ask}.Words[0]"
        by = _by(drive, write.register) if ask == "Slot.Ask[1]" else ""
        yield f"({ask}.Address = {word(write.register)}) AND ({sent} = {value}){by}"


def _moves(drive: Drive, ask: str) -> str:
    """That a request writes what may move the motor: some field of its word starts it, and none holds it still."""
    return _any(
        f"({ask}.Address = {word(one.register)}){_by(drive, one.register) if ask == 'Slot.Ask[1]' else ''} "
        f"AND ({_any(_starts(one, ask))}) AND NOT ({_any(_does(one, ask, holds=True))})"
        for one in words(drive).registers
    )


def _starts(one: CommandWord, ask: str) -> Iterator[str]:
    yield from _does(one, ask, holds=False)
    for field in one.fields:
        if field.rest.moves and len(field.effects) <= field.ones:
            listed = {0} | {value for value, _ in field.effects}
            yield _every(f"NOT ({_is(one, field, value, ask)})" for value in sorted(listed))


def _does(one: CommandWord, ask: str, *, holds: bool) -> Iterator[str]:
    """The values of fields that start the motor, or that hold it still."""
    for field in one.fields:
        for value, effect in field.effects:
            if effect.holds if holds else effect.moves:
                yield _is(one, field, value, ask)


def _is(one: CommandWord, field: Field, value: int, ask: str) -> str:
    times, mask = (COIL_ON, ALL) if is_bit(one.register) else (1 << field.first, field.ones << field.first)
    return f"({ask}.Words[0] AND {word(mask)}) = {word(value * times)}"


def _by(drive: Drive, register: int) -> str:
    """The function that writes a register, where it is not the same for all: two tables have the same addresses."""
    return f" AND (Slot.Ask[1].FunctionCode = {writes_by(drive, register)})" if len(_functions(drive)) > 1 else ""


def _functions(drive: Drive) -> set[int]:
    return {writes_by(drive, register) for register in _command_registers(drive)}


def _is_reference(drive: Drive) -> str:
    register = reference(drive).register
    return f"(Slot.Ask[1].Address = {word(register)}){_by(drive, register)}"


def _written(drive: Drive) -> str:
    """The function and the quantity of a write: one word, or two of a reference of 32 bits."""
    codes = _any(f"Slot.Ask[1].FunctionCode = {code}" for code in sorted(_functions(drive)))
    has = reference(drive)
    if not has.pair:
        return f"({codes}) AND (Slot.Ask[1].Quantity = 1)"
    above, below = (f"Slot.Ask[1].Words[{each - has.register}]" for each in (has.quantity.high, has.quantity.low))
    zero, is_ = f"({above} = {word(0)})", _is_reference(drive)
    if has.signed:
        negative = f"({below} AND {word(SIGN)}) <> {word(0)}"
        zero = f"({zero} AND NOT ({negative}) OR ({above} = {word(ALL)}) AND ({negative}))"
    pair = f"(Slot.Ask[1].Quantity = 2) AND {zero}"
    return f"({codes}) AND (({is_}) AND {pair} OR NOT ({is_}) AND (Slot.Ask[1].Quantity = 1))"


def _holds(drive: Drive, one: Pattern) -> str:
    """A pattern on the word that the drive block has read."""
    name = f"Reads.{word_input(drive, one.register).name}"
    found = name if one.mask == ALL else f"({name} AND {word(one.mask)})"
    if one.is_ in ("=", "<>"):
        return f"{found} {one.is_} {word(one.value)}"
    number = f"WORD_TO_UINT({found} XOR {word(SIGN)})" if one.signed else f"WORD_TO_UINT({found})"
    return f"{number} {one.is_} {one.value ^ SIGN if one.signed else one.value}"


def _comes(number: int, poll: Poll) -> str:
    """That a good reply to a poll has come in this call."""
    return f"Fresh AND NOT Anew AND (Entry = {number}) AND (Count >= {poll.words})"


def _at_once(drive: Drive, poll: Poll) -> bool:
    """Whether its words count though they are doubtful: they show motion, or that there is a fault."""
    if poll.fast or status(drive).shows("fault"):
        return poll.fast
    return not fault_words(drive).isdisjoint(poll.addresses)


def _read(drive: Drive) -> dict[str, str]:
    """What the block that reads owes: which word of a poll is which, whose turn it is, what ages, and what is proof."""
    reads = polls(drive)
    taken: list[str] = []
    for number, poll in enumerate(reads, 1):
        come = _comes(number, poll) + ("" if _at_once(drive, poll) else f" AND {BELIEVED}")
        for address in sorted((fast_words(drive) | slow_words(drive)) & set(poll.addresses)):
            name, at = word_input(drive, address).name, address - poll.address
            said = f"(SHR(Words[0], {at}) AND {word(1)})" if is_bit(address) else f"Words[{at}]"
            taken.append(f"({come}) AND ({name} = {said}) OR NOT ({come}) AND ({name} = Was.{name})")
    first = "First OR " if first_reads(drive) else ""
    turns = [
        f"{first}(Turn <> {turn}) OR (NextEntry = {index + 1}) "
        f"AND (Ask.Address = {word(reads[index].address)}) AND (Ask.Quantity = {reads[index].words}) "
        f"AND (Ask.FunctionCode = {reads[index].function})"
        for turn, index in enumerate(schedule(reads))
    ]
    fast, numbers = roles(drive).fast, range(1, len(reads) + 1)
    return {
        "words_taken": _every(taken),
        "settings_read": _settings(drive),
        "turns": _every(turns),
        "oldest": _each("StatusAgeMs >= Age{n}", fast),
        "one_is_oldest": _any(f"StatusAgeMs = Age{number}" for number in fast),
        "status_age": _each("Reads.StatusAgeMs >= Reads.Age{n}", fast)
        + f" AND ({_any(f'Reads.StatusAgeMs = Reads.Age{number}' for number in fast)})",
        "proves": _each("Sure{n}", roles(drive).proof),
        "sure": _each("(Sure{n} = (Since{n} AND (Since{n}Ms > LongestMs)))", numbers),
        "sure_since": _each("(NOT Since{n} OR (Since{n}Ms > LongestMs))", numbers),
        "believed_since": _each(
            f"(NOT Since{{n}} OR Was.Since{{n}} AND NOT (Anew OR Forget OR Reread) OR {BELIEVED})", numbers
        ),
        "speed": _any(f"({_comes(number, reads[number - 1])}) AND {BELIEVED}" for number in roles(drive).speed),
        "ages": _each(
            "(Age{n} = MB_Plus(Number := Was.Age{n}, More := PassedMs)) "
            "OR Fresh AND (Entry = {n}) AND (Age{n} = PassedMs)",
            numbers,
        ),
        "since": _each("NOT Since{n} OR Was.Since{n} OR Fresh AND (Entry = {n})", numbers),
        "none_since": _each("NOT Since{n} OR Fresh AND (Entry = {n})", numbers),
        "all_old": _each("(Age{n} = 65535) OR Fresh AND (Entry = {n})", numbers),
    }


def _each(form: str, numbers: Iterable[int]) -> str:
    """That something is so of each of some reads."""
    return _every(form.format(n=number) for number in numbers)


def _settings(drive: Drive) -> str:
    """When all of them were answered."""
    brings = roles(drive).verify
    if not brings:
        return "SettingsRead"
    come = _every(f"Sure{number}" for number in brings)
    return (
        f"(SettingsRead = (Was.SettingsRead AND NOT Anew AND NOT Verify OR {come})) "
        f"AND (NOT (Anew OR Verify) OR {_every(f'NOT Since{n} OR Fresh AND (Entry = {n})' for n in brings)})"
    )


def _shown(drive: Drive) -> dict[str, str]:
    """That the pins show what the map says of the words that were read, and what is handed to the line."""
    said, pins = [], []
    dialect = refusals(drive)
    shows = status(drive)
    for one in shows.shown:
        holds = _any(_holds(drive, each) for each in one.patterns)
        said.append(f"({_any(Decoded(drive).holds(each) for each in one.patterns)}) = ({holds})")
        if one.name in STATUS:
            pins.append(f"{STATUS[one.name]} = ({'Running AND ' * (one.name == 'at_speed')}({holds}))")
    told = [
        f"Slot.TwoByteCount = {dialect.two_byte_count}".upper(),
        f"Slot.SilenceMs = {int(serial(drive).silence_ms)}",
        f"Slot.ExceptionAdd = {dialect.add}",
        f"Slot.ErrorFunction = {dialect.function or 0}",
        f"Slot.ErrorAddress = {word(dialect.address or 0)}",
        f"Slot.BusyReason = {busy(drive)}",
    ]
    ready = [_holds(drive, each) for each in shows.shows("ready")]
    forbids = [each for one in shows.forbids for each in one.patterns]
    decoded = [*shows.verify, *forbids]
    return {
        "ready_shown": f"(CommOk AND ({_any(ready)}))" if ready else "TRUE",
        "verified": _every(_holds(drive, each) for each in shows.verify),
        "forbidden": _any(_holds(drive, each) for each in forbids),
        "settings_since": _each("Reads.Sure{n}", roles(drive).verify),
        "settings_seen": _each("Reads.Since{n}", roles(drive).setting) if shows.verify else "FALSE",
        "settled_read": "(NOT Known.Settled.Proved OR Reads.SettingsRead)" if roles(drive).verify else "TRUE",
        "settings_said": _every(f"({Decoded(drive).holds(each)}) = ({_holds(drive, each)})" for each in decoded),
        "said": _every(said),
        "pins": _every(pins),
        "told": _every(told),
        "at_speed": "(Running OR NOT AtSpeed)" if shows.shows("at_speed") else NEAR,
        "unchecked": f"(ManualChecked <> {checked(drive)})" if second_hand(drive) else "FALSE",
        "other_maximum": "(Reads.SettingsRead AND NOT SameMaximum)" if own_maximum(drive) else "FALSE",
        "valid": _every(_valid(drive, one) for one in measures(drive)),
    }


def _valid(drive: Drive, one: Measure) -> str:
    """When a measure may be shown as valid: it is young, and its scale is known."""
    name, _, setting = PINS[one.name]
    number = next(number for number, poll in enumerate(polls(drive), 1) if one.register in poll.addresses)
    scaled = "TRUE" if one.quantity.factors else f"(Settings.{setting} > 0.0) AND (Settings.{setting} <= 1.0E6)"
    return f"NOT Diagnosis.{name}Valid OR CommOk AND (Reads.Age{number} <= Usual.StaleMs) AND {scaled}"


def _reference(drive: Drive) -> dict[str, str]:
    """When the errors of a reference are so that depend on what the map knows of its scale."""
    has = reference(drive)
    scaled, usable = has.scaled, "(ReferenceScale > 0.0) AND (ReferenceScale <= 1.0E6)"
    if has.in_rpm:
        scaled, usable = False, "(PolePairs >= 1) AND (PolePairs <= 100)"
    by_sign, signed = has.signed, has.quantity.signed and (has.signed or not has.pair)
    negative = "({word} AND WORD#16#8000) <> WORD#16#0000"
    word_sign = f"(Value = WORD#16#0000) OR (({negative.format(word='Value')}) = {'Reverse' if by_sign else 'FALSE'})"
    sent = negative.format(word="Control.SentWord")
    reverses = f"(Control.SentWord = WORD#16#0000) OR (({sent}) = (Control.Send.Order = GO_REVERSE))"
    given = f"(Speed.Value = WORD#16#0000) OR (({negative.format(word='Speed.Value')}) = Speed.Reverse)"
    return {
        "word_sign": word_sign if signed else "TRUE",
        "given_sign": given if by_sign else "TRUE",
        "sent_sign": reverses if by_sign else "TRUE",
        "scale_known": "TRUE" if scaled else f"({usable})",
        "no_scale": "FALSE" if scaled else f"(ErrorID = 15) AND NOT ({usable})",
        "no_full_scale": "TRUE" if has.percent else "NOT ((FullScaleHz >= 0.0) AND (FullScaleHz <= 0.0))",
    }


def _writes(commands: Mapping[str, Command], form: str) -> Iterator[str]:
    """Something about each command and the number of its last write, from 0."""
    return (form.format(name=SENT[does], last=len(one.writes) - 1) for does, one in commands.items() if does in SENT)


def _holds_ms(drive: Drive) -> Iterator[str]:
    """For how long each word of a command has to stay, where one has several."""
    commands = words(drive).commands
    several = any(len(one.writes) > 1 for one in commands)
    for one in commands:
        if several and one.does in SENT:
            for step, write in enumerate(one.writes):
                sent = f"(Control.Sent = {SENT[one.does]}) AND (Control.StepNumber = {step})"
                yield f"NOT ({sent}) OR (Orders.HoldMs = {write.stays_ms})"


def _command_registers(drive: Drive) -> set[int]:
    return {one.register for one in words(drive).registers} | {*reference(drive).registers}


def _beside(register: int) -> str:
    """That a parameter request does not touch a register."""
    first = "WORD_TO_UDINT(Slot.Ask[2].Address)"
    return f"({register} < {first}) OR ({register} >= {first} + USINT_TO_UDINT(Slot.Ask[2].Quantity))"


def _every(conditions: Iterable[str]) -> str:
    return " AND ".join(f"({each})" for each in conditions) or "TRUE"


def _any(conditions: Iterable[str]) -> str:
    return " OR ".join(f"({each})" for each in conditions) or "FALSE"
