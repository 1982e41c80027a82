"""The tables of simulated drives in C, for vdrive.c: the same numbers as in Python."""

from collections.abc import Iterable, Sequence
from dataclasses import astuple, fields

from driveblocks.simulator.drive import SimulatedDrive
from driveblocks.simulator.habits import Habits
from driveblocks.simulator.move import EFFECTS, Move
from driveblocks.simulator.pattern import Pattern
from driveblocks.simulator.refusal import REASONS
from driveblocks.simulator.table import MEASURES, Limit, Table

HABITS = [field.name for field in fields(Habits) if field.name not in {"scale", "scales"}]
WATCHDOGS = ("trip", "stop", "coast")
METHODS = ("enter_register", "ram_address_bit", "unexplained")


def header(drives: Iterable[SimulatedDrive]) -> str:
    """`DRIVES`: one table after the other, for `vd_begin`."""
    parts, names = [_types()], []
    for number, drive in enumerate(drives):
        names.append(f"&VD{number}")
        parts.append(_table(f"VD{number}", drive))
    return "\n".join([*parts, f"static const VTable *DRIVES[] = {{{', '.join(names)}}};\n"])


def _types() -> str:
    """Names of effects, measures and reasons, and the habits, in the order of Python."""
    effects = ", ".join(f"E_{effect.upper()}" for effect in EFFECTS)
    reasons = ", ".join(f"R_{reason.upper()}" for reason in REASONS)
    measures = ", ".join(f"M_{measure.upper()}" for measure in MEASURES)
    methods = ", ".join(f"S_{method.upper()}" for method in METHODS)
    habits = " ".join(f"int {name};" for name in HABITS)
    lines = [f"enum {{ {names} }};" for names in (effects, reasons, measures, methods)]
    return "\n".join([*lines, f"typedef struct {{ {habits} }} VHabits;", '#include "vdrive.h"'])


def _rows(name: str, kind: str, rows: Sequence[Sequence[int]]) -> str:
    """An array; one with nothing in it has a row of zeros, which nobody looks at."""
    text = ", ".join("{" + ", ".join(map(str, map(int, row))) + "}" for row in rows) or "{0}"
    return f"static const {kind} {name}[] = {{{text}}};"


def _habits(habits: Habits) -> list[int]:
    values = {name: getattr(habits, name) for name in HABITS}
    values["watchdog"] = WATCHDOGS.index(habits.watchdog)
    values["watchdog_ms"] = -1 if habits.watchdog_ms is None else habits.watchdog_ms
    return [int(value) for value in values.values()]


def _moves(table: Table) -> tuple[list[list[int]], list[list[int]]]:
    needs: list[list[int]] = []
    rows = []
    for move in table.moves:
        rows.append([*_move(table, move), len(needs), len(move.needs)])
        needs += [[*_pattern(need.pattern), need.before, need.for_ms] for need in move.needs]
    return rows, needs


def _move(table: Table, move: Move) -> list[int]:
    return [
        EFFECTS.index(move.effect),
        *_pattern(move.pattern),
        _state(table, move.guard),
        _state(table, move.into),
        move.exact,
    ]


def _pattern(pattern: Pattern) -> list[int]:
    """What a write must be like; only a status may differ from a value."""
    assert not pattern.differs
    return [pattern.register, pattern.mask, pattern.value]


def _state(table: Table, name: str | None) -> int:
    return -1 if name is None else table.states.index(name)


def _limit(limit: Limit) -> list[int]:
    """Of one register: a drive with values of 32 bits has no twin in C."""
    assert limit.above is None
    return [limit.register, limit.low, limit.high, limit.signed]


def _table(name: str, drive: SimulatedDrive) -> str:
    table = drive.table
    moves, needs = _moves(table)
    named = sorted(table.named.items())
    faces = [
        [situation.key, _state(table, state), *(words.get(register, 0) for register, _ in named)]
        for (situation, state), words in table.faces.items()
    ]
    gauges = [[one.register, MEASURES.index(one.shows), one.milli, one.signed] for one in table.gauges]
    arrays: dict[str, tuple[str, Sequence[Sequence[int]]]] = {
        "readable": ("VSpan", [astuple(span) for span in table.readable]),
        "writable": ("VSpan", [astuple(span) for span in table.writable]),
        "parameters": ("VSpan", [astuple(span) for span in table.storage.areas]),
        "limits": ("VLimit", [_limit(limit) for limit in table.limits]),
        "moves": ("VMove", moves),
        "needs": ("VNeed", needs),
        "named": ("VNamed", named),
        "faces": ("VFace", faces),
        "gauges": ("VGauge", gauges),
        "verify": ("VPattern", [_pattern(each) for each in table.reference.verify]),
        "subs": ("VNumber", [[code] for code in table.sub_functions]),
        "broadcasts": ("VNumber", [[address] for address in table.broadcasts]),
        "plate": ("VNamed", sorted(drive.memory.plate.items())),
    }
    text = [_rows(f"{name}_{key}", kind, rows) for key, (kind, rows) in arrays.items()]
    text.append(_rows(f"{name}_habits", "VHabits", [_habits(drive.habits)]))
    pointers = [f".{key} = {name}_{key}, .{key}_count = {len(rows)}" for key, (_, rows) in arrays.items()]
    values = [f".{key} = {int(value)}" for key, value in _numbers(drive).items()]
    codes = ", ".join(str(code or 0) for code in table.codes.values())
    values.append(f".codes = {{{codes}}}, .habits = {name}_habits")
    return "\n".join([*text, f"static const VTable {name} = {{{', '.join([*pointers, *values])}}};"])


def _numbers(drive: SimulatedDrive) -> dict[str, int]:
    """The scalars of a table."""
    table, reference, storage = drive.table, drive.table.reference, drive.table.storage
    first, last = table.fault_bits or (1, 0)
    dialect = table.dialect
    return {
        "functions": sum(1 << code for code in table.functions if code < 32),
        "most_read": table.most.read,
        "most_write": table.most.write,
        "broadcast": -1 if table.broadcast is None else table.broadcast,
        "error_function": -1 if dialect.function is None else dialect.function,
        "error_address": -1 if dialect.address is None else dialect.address,
        "error_add": dialect.added,
        "reference": reference.register,
        "times": reference.times,
        "per": reference.per,
        "reference_signed": reference.signed,
        "reverses": reference.reverses,
        "method": METHODS.index(storage.method),
        "add": storage.add,
        "enter": storage.register,
        "enter_value": storage.value,
        "present": -1 if table.present is None else table.present,
        "fault_first": first,
        "fault_last": last,
        "unit": drive.unit,
    }
