"""Rules on what commands do: each must be what it is called, by what the fields of its words are declared to do."""

from driveblocks.maps.form import address_text
from driveblocks.maps.model import Act, Bit, Does, Drive, Register, Value
from driveblocks.maps.problem import Report
from driveblocks.meaning.pattern import WORD
from driveblocks.meaning.words import DOES, KINDS, MOTIONS, STOPS, UNKNOWN, Cause, Command, Words, Write, words

_KIND = {does: act for act, does in KINDS.items()}
"""How each stop stops."""
_ORDER = "write the direction first and the run bit last"
_MOST_TOLD = 3
_CORRECT = "correct the command, or what the register's row says that it `does`"


def check(drive: Drive, good: set[Does], report: Report) -> None:
    """Note every register that says nothing of its words, and every command, of the good ones, that does otherwise."""
    known = words(drive)
    commands = [one for one in known.commands if one.does in good]
    silent = {one.register for one in known.registers if not one.declared}
    for register in sorted(silent & {write.register for one in commands for write in one.writes}):
        _silent(register, drive.register_at(register, "w"), report)
    for _, row in drive.registers():
        _row(row, report)
    for command in commands:
        if silent.isdisjoint(write.register for write in command.writes):
            _command(known, command, report)


def _silent(register: int, row: Register | None, report: Report) -> None:
    """Note a command register that says nothing of what its words do."""
    if row is not None:
        key, what = ("bits", "bits") if row.bits else ("values", "values") if row.values else ("address", "value")
        wrong = f"nothing says what the {what} of {address_text(register)} do{'es' * (what == 'value')} to the motor"
        right = "write beside each what it does: `does: [starts]`, `[stops]`, `[resets]`, `[reverses]`, `[nothing]`"
        report.miss(row.place(key), wrong, right)


def _row(row: Register, report: Report) -> None:
    """Note what no field can do."""
    values = (*row.values, *(value for bit in row.bits for value in bit.values))
    every: tuple[Register | Bit | Value, ...] = (row, *row.bits, *values)
    for one in every:
        if "nothing" in one.does and len(one.does) > 1:
            report.add(one.place("does"), "`nothing` beside something else", "keep one of them")
        if not isinstance(one, Register) and one.holds:
            zero = one.at_0 if isinstance(one, Bit) else ()
            if not set(KINDS) & {*one.does, *zero} or (set(KINDS) & {*one.does} and one.by == "edge"):
                report.add(one.place("holds"), "only a stop holds the motor, by its level", "remove `holds`")


def _command(known: Words, command: Command, report: Report) -> None:
    """Note a write that moves the motor and must not, or the contrary, and one that hands the drive over."""
    for write in command.writes:
        over = [one for one in known.of(write).causes(write.held) if "hands_over" in one.effect.acts]
        if over:
            report.add(write.at, _wrong(command, write, over[0], "hands_over"), "clear it, or keep it out by `never`")
    moving = known.moving(command)
    if command.does in MOTIONS:
        for _, write, cause in moving[:-1]:
            wrong = f"{_wrong(command, write, cause)} before its last write"
            report.add(write.at, wrong, _ORDER)
        _motion(known, command, moving, report)
        return
    for _, write, cause in moving:
        right = "clear it, or say under the register what it `does`, or that a stop of this word `holds`"
        report.add(write.at, _wrong(command, write, cause), right)
    if not moving:
        (_stop if command.does in STOPS else _reset)(known, command, report)


def _wrong(command: Command, write: Write, cause: Cause, act: Act | None = None) -> str:
    """What a field of a write does and must not."""
    where = f"`{command.does}` writes {write.word:04X}H to {address_text(write.register)}"
    kept = write.keeps >> cause.field.first & cause.field.ones
    if kept:
        where = f"`{command.does}` keeps bits of {address_text(write.register)} as they are"
    if not cause.effect.declared:
        return f"{where}, and nothing says what {cause} does, so that it counts as starting"
    return f"{where}, where {cause} {DOES[act or ('starts' if 'starts' in cause.effect.acts else 'jogs')]}"


def _lacks(known: Words, command: Command, write: Write, act: Act) -> str:
    """That nothing of a write does what it must, and what the fields do that it gives a value."""
    where = f"`{command.does}` writes {write.word:04X}H to {address_text(write.register)}, where nothing {DOES[act]}"
    named = [each for each in known.of(write).certain(write.held) if write.names >> each.field.first & each.field.ones]
    told = [f"{each} {_does(each)}" for each in named if each.value or write.names != WORD]
    return f"{where}: {', '.join(told[:_MOST_TOLD])}" if told else where


def _does(cause: Cause) -> str:
    return " and ".join(DOES[act] for act in sorted(cause.effect.acts) if act in DOES) or "does nothing"


def _motion(known: Words, command: Command, moving: list[tuple[int, Write, Cause]], report: Report) -> None:
    """Note a motion that does not move, that is of the other kind or way, or that stops or resets as well."""
    wanted: Act = "starts" if command.does.startswith("run") else "jogs"
    if not moving:
        report.miss(command.last.at, _lacks(known, command, command.last, wanted), _CORRECT)
        return
    number, write, cause = moving[-1]
    if wanted not in cause.effect.acts or not cause.effect.declared:
        report.add(write.at, _wrong(command, write, cause), _CORRECT)
    for one in known.of(write).certain(write.held):
        also = next((act for act in (*KINDS, "resets") if one.value and act in one.effect.acts), None)
        if also:
            report.add(write.at, _wrong(command, write, one, also), _CORRECT)
    _way(known, command, number, report)


def _way(known: Words, command: Command, number: int, report: Report) -> None:
    """Note a motion that turns the other way, or may: its direction must be written up to its start."""
    write = command.writes[number]
    held = {one.register: one.held for one in command.writes[: number + 1]}
    every = [
        (word, one)
        for word in known.registers
        for one in word.causes(held.get(word.register, UNKNOWN))
        if word.register == write.register or not one.effect.moves
    ]
    backward = command.does.endswith("reverse") and not command.negative
    right: Act = "reverses" if backward else "forward"
    wrong: Act = "forward" if backward else "reverses"
    sure = {
        act for word, one in every for act in one.effect.acts if one in word.certain(held.get(word.register, UNKNOWN))
    }
    for word, one in every:
        if wrong in one.effect.acts:
            told = word.register in held
            where = f"`{command.does}` does not write {address_text(word.register)}, where {one} {DOES[wrong]}"
            if told:
                report.add(write.at, _wrong(command, write, one, wrong), _CORRECT)
            else:
                report.add(write.at, where, _ORDER)
            return
    ways = {act for word in known.registers for one in word.causes(UNKNOWN) for act in one.effect.acts}
    if right in ways | {"reverses"} and right not in sure:
        report.miss(write.at, _lacks(known, command, write, right), _CORRECT)


def _stop(known: Words, command: Command, report: Report) -> None:
    """Note a stop that stops nothing, or in another way; a word that ends a jog may stop a run as well."""
    write, wanted = command.last, _KIND[command.does]
    word = known.of(write)
    kind = word.stops(write.held)
    cause = word.gives(kind, write.held) if kind else None
    if kind is None or cause is None:
        report.miss(write.at, _lacks(known, command, write, wanted), _CORRECT)
    elif kind != wanted and not (wanted == "ends_jog" and word.gives(wanted, write.held)):
        report.add(write.at, _wrong(command, write, cause, kind), _CORRECT)


def _reset(known: Words, command: Command, report: Report) -> None:
    """Note a fault reset that resets nothing."""
    if not any(known.of(write).gives("resets", write.held) for write in command.writes):
        report.miss(command.last.at, _lacks(known, command, command.last, "resets"), _CORRECT)
