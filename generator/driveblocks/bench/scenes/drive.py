"""The simulated drive of a family in Structured Text, from what the simulator knows of its map."""

from collections import Counter
from collections.abc import Iterable, Iterator
from functools import cache
from typing import Any

import jinja2

from driveblocks.bench.simulator.copies import RPM_OF_ONE_PAIR
from driveblocks.bench.simulator.face import misshown
from driveblocks.bench.simulator.habits import Habits
from driveblocks.bench.simulator.move import EFFECTS, STATE, Move, Need
from driveblocks.bench.simulator.plate import chosen, own_maximum_word
from driveblocks.bench.simulator.table import Gauge, Table, table
from driveblocks.maps.form import SPACES, Span, address_name, address_text, space_of, wire
from driveblocks.maps.model import Drive, kept
from driveblocks.maps.plan import busy, merged
from driveblocks.maps.rivals import own_address
from driveblocks.meaning.pattern import WORD, Pattern
from driveblocks.meaning.status import registers, status
from driveblocks.meaning.words import MOTIONS
from driveblocks.render.environment import strict
from structured_text.language.writing import byte, comment, word

Context = dict[str, Any]

KINDS = {"stop": 1, "quick_stop": 2, "coast_stop": 3, "jog_stop": 4}
ORDERS = {"run_forward": 5, "run_reverse": 6, "jog_forward": 7, "jog_reverse": 8, "fault_reset": 9}
MAXIMUM_HZ = 50


@cache
def environment() -> jinja2.Environment:
    return strict("driveblocks.bench.scenes")


def name(drive: Drive) -> str:
    return f"{drive.prefix}_TestDrive"


def text(drive: Drive, faults: Iterable[int]) -> str:
    return environment().get_template("TestDrive.st.j2").render(_context(drive, simulated(drive), tuple(faults)))


@kept
def simulated(drive: Drive) -> Table:
    return table(drive, Habits(maximum_hz=MAXIMUM_HZ))


def premises(drive: Drive) -> list[str]:
    """What the map says against what all scenes suppose of a drive, in words."""
    return list(misshown(drive, frozenset(each.register for each in simulated(drive).gauges)))


def counts_per_hertz(drive: Drive) -> float:
    """What the simulated drive takes its reference for, as a setting says it where the manual does not."""
    given = simulated(drive).reference
    return 1000.0 * given.per / given.times


def mark(address: int) -> int:
    """By what it tells registers apart, a WORD: those of other tables than the holding registers are high up."""
    return wire(address) + 0x4000 * (address >> 17)


def _marked(spans: Iterable[Span]) -> list[Span]:
    return [Span(mark(span.first), mark(span.first) + len(span) - 1) for span in spans]


def _context(drive: Drive, made: Table, numbers: tuple[int, ...]) -> Context:
    places = _places(drive, made)
    at = {address: index for index, address in enumerate(places)}
    moves = [_move(move, at, made) for move in sorted(made.moves, key=_weight)]
    return {
        "name": name(drive),
        "family": comment(drive.family.en),
        "source": comment(drive.manual.title.en),
        "places": [
            {"address": word(mark(each)), "word": word(places[each]) if places[each] else ""} for each in places
        ],
        "reference": _reference(made, at),
        "verify": bool(made.reference.verify),
        "functions": " AND ".join(
            f"(FunctionCode <> {one})" for one in sorted(made.functions & {1, 2, 3, 4, 5, 6, 16})
        ),
        "codes": made.codes,
        "busy": busy(drive),
        "two_byte_count": made.dialect.two_byte_count,
        "most": made.most,
        "tables": _tables(made),
        "readable": _within("Number", merged(_marked(made.readable))),
        "writable": _within("Number", merged(_marked(made.writable))),
        "limits": [_limit(one) for one in made.limits if one.above is None],
        "parameters": _within("Number", merged(made.storage.areas)) or "FALSE",
        "home": _home(made),
        "faces": [_face(made, register) for register in made.named],
        "shown": _shown(drive, made, numbers),
        "stored": _stored(made),
        **_proof(drive),
        "moves": moves,
        "after": _after(made, at),
        "silences": [
            {"test": f"Touched[{at[one.register]}] AND {_holds('Kept', one, at)}", "ms": ms}
            for one, ms in made.silences
        ],
        "commands": _commands(made, at),
        "refusal": _refusal(made),
    }


# ---------------------------------------------------------------- registers


def _places(drive: Drive, made: Table) -> dict[int, int]:
    """Registers that it keeps from power-up on, with their words: those of commands first."""
    words = {move.pattern.register: 0 for move in made.moves}
    words |= {need.pattern.register: 0 for move in made.moves for need in move.needs}
    words.setdefault(made.reference.register, 0)
    if made.reference.above is not None:
        words.setdefault(made.reference.above, 0)
    for pattern in status(drive).settled:
        words[pattern.register] = words.get(pattern.register, 0) & ~pattern.mask | pattern.value
    return words | own_maximum_word(drive, MAXIMUM_HZ)


def _reference(made: Table, at: dict[int, int]) -> Context:
    given = made.reference
    kept = f"Kept[{at[given.register]}]"
    times, per = _reduced(given.times, given.per)
    number = f"INT_TO_DINT(WORD_TO_INT({kept}))" if given.signed else f"UINT_TO_DINT(WORD_TO_UINT({kept}))"
    if given.above is not None:
        kind = "INT" if given.signed else "UINT"
        above = f"{kind}_TO_DINT(WORD_TO_{kind}(Kept[{at[given.above]}]))"
        number = f"UINT_TO_DINT(WORD_TO_UINT({kept})) + ({above} MOD {2**15 // times}) * 65536"  # no overflow below
    return {
        "place": at[given.register],
        "number": number,
        "signed": given.signed,
        "reverses": given.reverses,
        "times": times,
        "per": per,
    }


def _reduced(times: int, per: int) -> tuple[int, int]:
    from math import gcd

    common = gcd(times, per)
    return times // common, per // common


def _tables(made: Table) -> list[Context]:
    """What is added to the first register by each function of another table."""
    known = {space_of(span.first) for span in made.readable} | {space_of(span.first) for span in made.writable}
    codes = {"coil": (1, 5), "discrete": (2,), "input": (4,)}
    return [
        {"test": " OR ".join(f"(FunctionCode = {code})" for code in codes[table]), "add": mark(SPACES[table])}
        for table in codes
        if table in known
    ]


def _within(variable: str, spans: Iterable[Span]) -> str:
    """The test whether a number lies in one of some ranges, some to a line."""
    tests = [_between(variable, span) for span in spans]
    return "\n          OR ".join(" OR ".join(tests[at : at + 2]) for at in range(0, len(tests), 2))


def _between(variable: str, span: Span) -> str:
    if len(span) == 1:
        return f"({variable} = {span.first})"
    low = [f"({variable} >= {span.first})"] if span.first else []
    return f"({' AND '.join([*low, f'({variable} <= {span.last})'])})"


def _limit(one: Any) -> Context:
    number = "WORD_TO_INT(Value)" if one.signed else "WORD_TO_UINT(Value)"
    beyond = [f"({number} > {one.high})"]
    if one.low > (-32768 if one.signed else 0):
        beyond.insert(0, f"({number} < {one.low})")
    return {"register": mark(one.register), "beyond": " OR ".join(beyond)}


def _home(made: Table) -> Context | None:
    """Of a parameter that may be written with a bit added: where it is."""
    storage = made.storage
    if not storage.add:
        return None
    moved = [Span(span.first + storage.add, span.last + storage.add) for span in storage.areas]
    return {"test": _within("Number", merged(moved)), "add": storage.add}


def _stored(made: Table) -> str:
    """Whether a write is stored, or may be."""
    storage = made.storage
    if storage.method == "enter_register":
        return f"(Number = {storage.register})" if storage.register >= 0 else "FALSE"
    if not storage.at_once:
        return "FALSE"
    return _within("Number", merged(storage.areas)) or "FALSE"


def _refusal(made: Table) -> Context:
    dialect = made.dialect
    if dialect.address is None or dialect.function is None:
        return {"address": False, "add": dialect.added}
    high, low = divmod(dialect.address, 256)
    return {"address": True, "function": byte(dialect.function), "high": byte(high), "low": byte(low)}


# ---------------------------------------------------------------- what it shows


def _face(made: Table, register: int) -> Context:
    """The words of a status register: situations by word, but for the most frequent word."""
    words: dict[int, list[int]] = {}
    for (situation, state), face in made.faces.items():
        key = situation.key + 128 * (made.states.index(state) + 1 if state else 0)
        words.setdefault(face.get(register, 0), []).append(key)
    other = Counter({each: len(keys) for each, keys in words.items()}).most_common(1)[0][0]
    groups = [
        {"labels": ", ".join(map(str, sorted(keys))), "word": word(each)}
        for each, keys in sorted(words.items())
        if each != other
    ]
    names = {"name": f"Face{address_name(register)}", "comment": f"{address_text(register)}: status"}
    return {**names, "groups": groups, "other": word(other), "register": mark(register)}


def _shown(drive: Drive, made: Table, numbers: tuple[int, ...]) -> list[Context]:
    """Registers that show something: what is done with `Value`."""
    found: dict[int, list[str]] = {}
    for register, mask in made.named.items():
        face = f"Face{address_name(register)}"
        found.setdefault(register, []).append(f"Value := (Value AND {word(~mask)}) OR {face};")
    for gauge in made.gauges:
        found.setdefault(gauge.register, []).append(_gauge(gauge))
    if (own := own_address(drive)) is not None:
        found[own] = ["Value := UINT_TO_WORD(Fate.Unit);"]
    for register, statement in (*_faults(made, numbers), *_chosen(drive), *_mistaken(drive)):
        found.setdefault(register, []).append(statement)
    return [{"register": mark(register), "statements": lines} for register, lines in sorted(found.items())]


def _gauge(gauge: Gauge) -> str:
    shaft = "Seen.Milli" if gauge.signed else "ABS(Seen.Milli)"
    milli = {
        "output_frequency": shaft,
        "output_current": "Live",
        "output_voltage": "(Share MOD 101) * 4000",
        "dc_bus_voltage": "540000",
        "output_power": "(Share MOD 101) * 20",
        "output_speed": f"{RPM_OF_ONE_PAIR // Habits().pole_pairs} * ({shaft} MOD 10000001)",
        "output_torque": "10 * Live",
        "relative_power": "(Share MOD 101) * 500",
        "drive_temperature": "40000",
        "motor_temperature": "50000",
        "operating_time": "100000",
        "energy": "12000",
        "motor_torque": "Live",
    }[gauge.shows]
    counts = f"{milli} / {gauge.milli}"
    if gauge.shift is not None:
        low = f"(({counts}) MOD 65536 + 65536) MOD 65536"
        high = f"((({counts}) - {low}) / 65536 + 65536) MOD 65536"
        return f"Value := UDINT_TO_WORD(DINT_TO_UDINT({high if gauge.shift else low}));"
    if gauge.signed:
        return f"Value := INT_TO_WORD(DINT_TO_INT({counts}));"
    return f"Value := UDINT_TO_WORD(DINT_TO_UDINT({counts}));"


def _faults(made: Table, numbers: tuple[int, ...]) -> Iterator[tuple[int, str]]:
    if made.present is not None:
        times = f" * {2**made.present_shift}" if made.present_shift else ""
        others = f"(Value AND {word(WORD & ~made.present_mask)}) OR " if made.present_mask != WORD else ""
        yield made.present, f"Value := {others}UINT_TO_WORD(Motor.FaultCode{times});"
    if made.warned is not None:
        mask, code = made.warning
        yield made.warned, f"Value := Value AND {word(~mask)};"
        yield made.warned, f"IF Fate.Warns THEN Value := Value OR {word(code)}; END_IF;"
    if made.fault_bits:
        for code in numbers:
            place, bit = divmod(code - 1, 16)
            statement = f"IF Motor.FaultCode = {code} THEN Value := Value OR {word(1 << bit)}; END_IF;"
            yield made.fault_bits[0] + place, statement


def _chosen(drive: Drive) -> Iterator[tuple[int, str]]:
    """What chooses between the scales of a measure."""
    for each in chosen(drive):
        yield each.register, f"Value := (Value AND {word(~each.mask)}) OR {word(each.value)};"


def _mistaken(drive: Drive) -> Iterator[tuple[int, str]]:
    """What is otherwise than it should be, when the tests say so."""
    for pattern in status(drive).verify:
        bit = pattern.mask & -pattern.mask
        yield pattern.register, f"IF Fate.WrongSetting THEN Value := Value XOR {word(bit)}; END_IF;"
    for one in status(drive).forbids[:1]:
        bar = one.patterns[0]
        shown = f"(Value AND {word(~bar.mask)}) OR {word(bar.word)}"
        yield bar.register, f"IF Fate.Forbids THEN Value := {shown}; END_IF;"


def _proof(drive: Drive) -> Context:
    """The registers that prove standstill, each with the bits of the others."""
    read = sorted(registers(status(drive).standstill.patterns))
    every = (1 << len(read)) - 1
    proof = [(mark(register), word(every & ~(1 << place))) for place, register in enumerate(read)]
    return {"proof": proof, "unproved": word(every)}


# ---------------------------------------------------------------- what a write does


def _weight(move: Move) -> tuple[int, int]:
    """Their order: of two stops the weaker first, motions behind all; the last one counts."""
    if move.effect in KINDS:
        return (0, -EFFECTS.index(move.effect))
    return (1 + (move.effect in MOTIONS), 0)


def _move(move: Move, at: dict[int, int], made: Table) -> Context:
    return {
        "comment": comment(f"{move.effect.replace('_', ' ')}{f': {move.into}' if move.into else ''}"),
        "test": _fires(move, at, made),
        "statement": _does(move, made),
    }


def _does(move: Move, made: Table) -> str:
    if move.effect in KINDS:
        return f"Halt := {KINDS[move.effect]};"
    if move.effect == STATE:
        return f"Led := {made.states.index(move.into or '') + 1};"
    return "Resets := TRUE;" if move.effect == "fault_reset" else f"Order := {ORDERS[move.effect]};"


def _fires(move: Move, at: dict[int, int], made: Table) -> str:
    registers = [move.pattern.register]
    if not any(need.before for need in move.needs):
        registers += [need.pattern.register for need in move.needs]
    touched = " OR ".join(f"Touched[{at[each]}]" for each in dict.fromkeys(registers))
    tests = [f"({touched})", _holds("Kept", move.pattern, at)]
    if move.guard is not None:
        state = f"(Motor.State = {made.states.index(move.guard) + 1})"
        tests.append(f"({state} OR Seen.Driven)" if move.effect in MOTIONS else state)
    tests += [_needed(need, at) for need in move.needs]
    return " AND ".join(each for each in tests if each)


def _needed(need: Need, at: dict[int, int]) -> str:
    box, since = ("Earlier", "EarlierMs") if need.before else ("Kept", "Since")
    stands = f" AND ({since}[{at[need.pattern.register]}] >= {need.for_ms})" if need.for_ms else ""
    return f"{_holds(box, need.pattern, at)}{stands}"


def _holds(box: str, pattern: Pattern, at: dict[int, int]) -> str:
    kept = f"{box}[{at[pattern.register]}]"
    if pattern.mask == 0xFFFF:
        return f"({kept} = {word(pattern.value)})"
    return f"(({kept} AND {word(pattern.mask)}) = {word(pattern.value)})"


def _after(made: Table, at: dict[int, int]) -> list[Context]:
    """States that the word of a stop may lead to, once the motor is at standstill."""
    led = [move for move in made.moves if move.effect == STATE]
    return [
        {
            "test": f"Touched[{at[move.pattern.register]}] AND {_holds('Kept', move.pattern, at)}",
            "state": made.states.index(move.into or "") + 1,
        }
        for move in led
    ]


def _commands(made: Table, at: dict[int, int]) -> str:
    """Whether a register of commands was written."""
    registers = {move.pattern.register: None for move in made.moves}
    registers |= {need.pattern.register: None for move in made.moves for need in move.needs}
    return " OR ".join(f"Touched[{at[each]}]" for each in registers)
