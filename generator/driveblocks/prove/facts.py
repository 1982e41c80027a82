"""What the rules of a drive block take from its map: the frames of every command, and what proves standstill.

Taken from the map itself, not from what the generator made of it.
"""

from collections.abc import Iterable, Iterator, Mapping

from driveblocks.maps.form import is_bit
from driveblocks.maps.model import Bits, Condition, Does, Drive, Measured
from driveblocks.maps.names import UNIT_NAMES
from driveblocks.maps.pair import places, whole
from driveblocks.maps.plan import writes_by
from driveblocks.maps.polls import Poll, fast_words, polls, schedule, slow_words
from driveblocks.maps.revision import checked
from driveblocks.maps.rivals import first_reads, refusals
from driveblocks.maps.trust import second_hand
from driveblocks.maps.view import error_number
from driveblocks.meaning.words import MOTIONS, STOPS, Command, CommandWord, Field, words
from driveblocks.modbus.layout import COIL_ON
from driveblocks.render.context import word_input
from driveblocks.render.decoded import Decoded
from driveblocks.render.drive import MEASURES
from structured_text.language.writing import word

PINS = {
    "running": "Running", "reverse": "Reverse", "at_speed": "AtSpeed", "zero_speed": "ZeroSpeed", "warning": "Warning",
    "fault": "Fault", "limit": "Diagnosis.LimitActive",
}  # fmt: skip
"""What a drive can show -> the pin."""
SENT = dict(
    zip((*MOTIONS, "fault_reset"), ("GO_FORWARD", "GO_REVERSE", "JOG_AHEAD", "JOG_BACK", "RESET_FAULT"), strict=True)
)
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
    commands = {one.does: one for one in words(drive).commands}
    row = drive.register_at(drive.operation.reference.register, "w")
    found = {
        "P": drive.prefix,
        "lowest": str(drive.serial.unit.min),
        "highest": str(drive.serial.unit.max),
        "write": str(writes_by(drive, words(drive).stop.last.register)),
        "reference": word(drive.operation.reference.register),
        "written": _written(drive),
        "sent_word": f"Slot.Ask[1].Words[{places(row, 1)[1] - 1 if row and row.words else 0}]",
        "holds_reference": _is_reference(drive),
        "standstill": _every(_holds(drive, each) for each in drive.operation.standstill.all),
        "proof_since": _every(f"Reads.Since{number}" for number in _proof_reads(drive)),
        **_read(drive),
        **_shown(drive),
        **_reference(drive),
        "holds_ms": _every(_holds_ms(drive)),
        "at_a_write": _every(_writes(commands, "(Control.Sent <> {name}) OR (Control.StepNumber <= {last})")),
        "all_written": _every(_writes(commands, "(Control.Send.Order <> {name}) OR (Control.Send.OrderStep = {last})")),
        "unwritable": _every(_beside(each) for each in sorted(_command_registers(drive)) if not is_bit(each)),
        "keep": "Settings.KeepWord" if any(one.last.keeps for one in commands.values()) else word(0),
    }
    shown = {one.shows for one in drive.operation.status}
    measured = {one.shows for one in drive.operation.measures}
    for pin in ("reverse", "fault", "warning", "at_speed", "zero_speed"):
        computed = pin.endswith("speed") and "output_frequency" in measured
        found[f"shows_{pin}"] = str(pin in shown or computed).upper()
    for name, member in (("may_stop", "MayStop"), ("known", "Known"), ("wrong", "Wrong")):
        found[name] = f"Identity.{member}" if first_reads(drive) else str(name != "wrong").upper()
    running = next(one for one in drive.operation.status if one.shows == "running")
    found["running"] = _any(_holds(drive, each) for each in running.any)
    by_bus = drive.operation.commanded_by.all if drive.operation.commanded_by else ()
    found["by_bus"] = _every(_holds(drive, each) for each in by_bus)
    found["says_by_bus"] = _every(Decoded(drive).holds(each) for each in by_bus)
    found["others_command"] = f"Control.Seen.OthersCommand <> ({found['says_by_bus']})" if by_bus else "TRUE"
    found["says_running"] = _any(Decoded(drive).holds(each) for each in running.any)
    every: tuple[Does, ...] = (*MOTIONS, *STOPS, "fault_reset")
    for does in every:
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
    reference = drive.operation.reference.register
    return f"(Slot.Ask[1].Address = {word(reference)}){_by(drive, reference)}"


def _written(drive: Drive) -> str:
    """The function and the quantity of a write: one word, or two of a reference of 32 bits."""
    codes = _any(f"Slot.Ask[1].FunctionCode = {code}" for code in sorted(_functions(drive)))
    if len(whole(drive, drive.operation.reference.register)) == 1:
        return f"({codes}) AND (Slot.Ask[1].Quantity = 1)"
    row = drive.register_at(drive.operation.reference.register, "w")
    high = 1 if row is not None and row.order == "low_first" else 0
    above, below, is_ = f"Slot.Ask[1].Words[{high}]", f"Slot.Ask[1].Words[{1 - high}]", _is_reference(drive)
    zero = f"({above} = {word(0)})"
    if drive.operation.by_sign:
        negative = f"({below} AND {word(SIGN)}) <> {word(0)}"
        zero = f"({zero} AND NOT ({negative}) OR ({above} = {word(ALL)}) AND ({negative}))"
    pair = f"(Slot.Ask[1].Quantity = 2) AND {zero}"
    return f"({codes}) AND (({is_}) AND {pair} OR NOT ({is_}) AND (Slot.Ask[1].Quantity = 1))"


def _mask(spans: Iterable[Bits]) -> int:
    return sum(1 << bit for bit in {bit for span in spans for bit in span})


def _holds(drive: Drive, one: Condition) -> str:
    """A condition of the map on the word that the drive block has read."""
    name, is_ = f"Reads.{word_input(drive, one.register).name}", "<>" if one.differs else "="
    if one.mask is not None:
        return f"({name} AND {word(one.mask)}) {is_} {word(one.equals & one.mask)}"
    if one.bit is None:
        return f"{name} {is_} {word(one.equals)}"
    bits = list(one.bit)
    return f"({name} AND {word(_mask([one.bit]))}) {is_} {word(one.equals << min(bits))}"


def _comes(number: int, poll: Poll) -> str:
    """That a good reply to a poll has come in this call."""
    return f"Fresh AND NOT Anew AND (Entry = {number}) AND (Count >= {poll.words})"


def _at_once(drive: Drive, poll: Poll) -> bool:
    """Whether its words count though they are doubtful: they show motion, or that there is a fault."""
    if poll.fast or any(one.shows == "fault" for one in drive.operation.status):
        return poll.fast
    words = set(range(poll.address, poll.address + poll.words))
    bits = drive.faults.bits
    faults = set(range(bits.first, bits.last + 1)) if bits else {drive.faults.present}
    return bool(words & faults)


def _read(drive: Drive) -> dict[str, str]:
    """What the block that reads owes: which word of a poll is which, whose turn it is, what ages, and what is proof."""
    reads = polls(drive)
    taken: list[str] = []
    for number, poll in enumerate(reads, 1):
        words = range(poll.address, poll.address + poll.words)
        come = _comes(number, poll) + ("" if _at_once(drive, poll) else f" AND {BELIEVED}")
        for address in sorted((fast_words(drive) | slow_words(drive)) & set(words)):
            name, at = word_input(drive, address).name, address - poll.address
            said = f"(SHR(Words[0], {at}) AND {word(1)})" if is_bit(address) else f"Words[{at}]"
            taken.append(f"({come}) AND ({name} = {said}) OR NOT ({come}) AND ({name} = Was.{name})")
    turns = [
        f"(Turn <> {turn}) OR (NextEntry = {index + 1}) AND (Register = {word(reads[index].address)}) "
        f"AND (Quantity = {reads[index].words})"
        + (f" AND (FunctionCode = {reads[index].function})" if len({each.function for each in reads}) > 1 else "")
        for turn, index in enumerate(schedule(reads))
    ]
    fast = [number for number, poll in enumerate(reads, 1) if poll.fast]
    return {
        "words_taken": _every(taken),
        "settings_read": _settings(drive),
        "turns": _every(turns),
        "oldest": _every(f"StatusAgeMs >= Age{number}" for number in fast),
        "one_is_oldest": _any(f"StatusAgeMs = Age{number}" for number in fast),
        "status_age": _every(f"Reads.StatusAgeMs >= Reads.Age{number}" for number in fast)
        + f" AND ({_any(f'Reads.StatusAgeMs = Reads.Age{number}' for number in fast)})",
        "proves": _every(f"Sure{number}" for number in _proof_reads(drive)),
        "sure": _every(
            f"(Sure{number} = (Since{number} AND (Since{number}Ms > LongestMs)))" for number in range(1, len(reads) + 1)
        ),
        "sure_since": _every(
            f"(NOT Since{number} OR (Since{number}Ms > LongestMs))" for number in range(1, len(reads) + 1)
        ),
        "believed_since": _every(
            f"(NOT Since{number} OR Was.Since{number} AND NOT (Anew OR Forget OR Reread) OR {BELIEVED})"
            for number in range(1, len(reads) + 1)
        ),
        "speed": _any(f"({_comes(number, reads[number - 1])}) AND {BELIEVED}" for number in _speed_reads(drive)),
        "ages": _every(
            f"(Age{number} = MB_Plus(Number := Was.Age{number}, More := PassedMs)) "
            f"OR Fresh AND (Entry = {number}) AND (Age{number} = PassedMs)"
            for number in range(1, len(reads) + 1)
        ),
        "since": _every(
            f"NOT Since{number} OR Was.Since{number} OR Fresh AND (Entry = {number})"
            for number in range(1, len(reads) + 1)
        ),
        "none_since": _every(
            f"NOT Since{number} OR Fresh AND (Entry = {number})" for number in range(1, len(reads) + 1)
        ),
        "all_old": _every(
            f"(Age{number} = 65535) OR Fresh AND (Entry = {number})" for number in range(1, len(reads) + 1)
        ),
    }


def _settings_reads(drive: Drive) -> list[int]:
    """The numbers of the polls that bring what the reference rests on."""
    wanted = {one.register for one in drive.operation.reference.verify}
    if drive.operation.own_maximum:
        wanted.add(drive.operation.own_maximum.register)
    numbered = enumerate(polls(drive), 1)
    return [number for number, poll in numbered if wanted & set(range(poll.address, poll.address + poll.words))]


def _verifying(drive: Drive) -> list[int]:
    """The numbers of the polls that bring a setting that is compared."""
    wanted = {one.register for one in drive.operation.reference.verify}
    numbered = enumerate(polls(drive), 1)
    return [number for number, poll in numbered if wanted & set(range(poll.address, poll.address + poll.words))]


def _settings(drive: Drive) -> str:
    """When all of them were answered."""
    brings = _settings_reads(drive)
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
    dialect, silence = refusals(drive), drive.serial.silence
    busy = next((error_number(one) or 0 for one in drive.errors.codes if one.busy), 0)
    for one in drive.operation.status:
        holds = _any(_holds(drive, each) for each in one.any)
        said.append(f"({_any(Decoded(drive).holds(each) for each in one.any)}) = ({holds})")
        if one.shows in PINS:
            pins.append(f"{PINS[one.shows]} = ({'Running AND ' * (one.shows == 'at_speed')}({holds}))")
    tolerant = any(each.kind == "two_byte_count" for each in drive.tolerances)
    told = [
        f"Slot.TwoByteCount = {tolerant}".upper(),
        f"Slot.SilenceMs = {int(silence.milliseconds or 0) if silence else 0}",
        f"Slot.ExceptionAdd = {dialect.add}",
        f"Slot.ErrorFunction = {dialect.function or 0}",
        f"Slot.ErrorAddress = {word(dialect.address or 0)}",
        f"Slot.BusyReason = {busy}",
    ]
    ready = [_holds(drive, each) for one in drive.operation.status if one.shows == "ready" for each in one.any]
    verify = [(Decoded(drive).holds(each), _holds(drive, each)) for each in drive.operation.reference.verify]
    return {
        "ready_shown": f"(CommOk AND ({_any(ready)}))" if ready else "TRUE",
        "verified": _every(word for _, word in verify),
        "settings_since": _every(f"Reads.Sure{number}" for number in _settings_reads(drive)),
        "settings_seen": _every(f"Reads.Since{number}" for number in _verifying(drive)) if verify else "FALSE",
        "settled_read": "(NOT Settled.Proved OR Reads.SettingsRead)" if _settings_reads(drive) else "TRUE",
        "settings_said": _every(f"({decoded}) = ({word})" for decoded, word in verify),
        "said": _every(said),
        "pins": _every(pins),
        "told": _every(told),
        "at_speed": "(Running OR NOT AtSpeed)" if "at_speed" in {one.shows for one in drive.operation.status} else NEAR,
        "unchecked": f"(ManualChecked <> {checked(drive)})" if second_hand(drive) else "FALSE",
        "other_maximum": "(Reads.SettingsRead AND NOT SameMaximum)" if drive.operation.own_maximum else "FALSE",
        "valid": _every(_valid(drive, one) for one in drive.operation.measures),
    }


def _valid(drive: Drive, one: Measured) -> str:
    """When a measure may be shown as valid: it is young, and its scale is known."""
    reads, row, (name, unit, setting) = enumerate(polls(drive), 1), drive.register_at(one.register), MEASURES[one.shows]
    number = next(number for number, poll in reads if poll.address <= one.register < poll.address + poll.words)
    known = row is not None and row.scale is not None and UNIT_NAMES.get(row.unit or "") == unit
    scaled = "TRUE" if known else f"(Settings.{setting} > 0.0) AND (Settings.{setting} <= 1.0E6)"
    return f"NOT Diagnosis.{name}Valid OR CommOk AND (Reads.Age{number} <= Usual.StaleMs) AND {scaled}"


def _reference(drive: Drive) -> dict[str, str]:
    """When the errors of a reference are so that depend on what the map knows of its scale."""
    row = drive.register_at(drive.operation.reference.register, "w")
    spec = drive.operation.reference
    scaled = (row is not None and row.scale is not None) or spec.full_scale is not None
    percent = scaled and (
        spec.means == "percent_of_maximum" or (spec.means.endswith("full_scale") and not spec.full_scale_hz)
    )
    usable = "(ReferenceScale > 0.0) AND (ReferenceScale <= 1.0E6)"
    if scaled and spec.means == "speed":
        scaled, usable = False, "(PolePairs >= 1) AND (PolePairs <= 100)"
    by_sign = drive.operation.by_sign
    signed = row is not None and row.signed and (by_sign or not row.words)
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
        "no_full_scale": "TRUE" if percent else "NOT ((FullScaleHz >= 0.0) AND (FullScaleHz <= 0.0))",
    }


def _writes(commands: Mapping[Does, Command], form: str) -> Iterator[str]:
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


def _proof_reads(drive: Drive) -> list[int]:
    """The numbers of the polls that bring what proves standstill."""
    wanted = {one.register for one in drive.operation.standstill.all}
    numbered = enumerate(polls(drive), 1)
    return [number for number, poll in numbered if wanted & set(range(poll.address, poll.address + poll.words))]


def _speed_reads(drive: Drive) -> list[int]:
    """The numbers of the polls that bring the frequency among the proof; all of the proof where it has none."""
    proof = {one.register for one in drive.operation.standstill.all}
    speed = {one.register for one in drive.operation.measures if one.shows == "output_frequency"} & proof
    numbered = enumerate(polls(drive), 1)
    return [at for at, poll in numbered if (speed or proof) & set(range(poll.address, poll.address + poll.words))]


def _command_registers(drive: Drive) -> set[int]:
    return {one.register for one in words(drive).registers} | {*whole(drive, drive.operation.reference.register)}


def _beside(register: int) -> str:
    """That a parameter request does not touch a register."""
    first = "WORD_TO_UDINT(Slot.Ask[2].Address)"
    return f"({register} < {first}) OR ({register} >= {first} + USINT_TO_UDINT(Slot.Ask[2].Quantity))"


def _every(conditions: Iterable[str]) -> str:
    return " AND ".join(f"({each})" for each in conditions) or "TRUE"


def _any(conditions: Iterable[str]) -> str:
    return " OR ".join(f"({each})" for each in conditions) or "FALSE"
