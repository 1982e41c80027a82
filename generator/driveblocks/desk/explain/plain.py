"""An explanation as plain data for JSON: bytes as upper-case pairs, numbers as numbers."""

from typing import Any

from driveblocks.desk.explain.explanation import Explanation
from driveblocks.desk.explain.guess import shown
from driveblocks.desk.explain.meaning import Held
from driveblocks.desk.explain.reading import Reading, Wrong
from driveblocks.maps.view import plain
from driveblocks.modbus.envelope import Wire

Plain = dict[str, Any]


def of_explanation(made: Explanation, drive: str | None) -> Plain:
    return {
        "drive": drive,
        "good": made.good,
        "mode": made.wire.mode,
        "frame": shown(made.wire.frame),
        "request": shown(made.asked) if made.asked is not None else None,
        "checksum": _checksum(made.wire),
        "wrong": [_wrong(wrong) for wrong in made.all_wrongs],
        "read_as": shown(made.meant.frame) if made.meant is not None else None,
        "readings": [_reading(one) for one in made.readings],
        "notes": list(made.notes),
        "inside": [of_explanation(one, drive) for one in made.inside],
    }


def _checksum(wire: Wire) -> Plain:
    return {"kind": wire.name, "found": shown(wire.found), "expected": shown(wire.expected), "right": wire.right}


def _wrong(wrong: Wrong) -> Plain:
    return {"what": wrong.what, "perhaps": list(wrong.instead)}


def _reading(one: Reading) -> Plain:
    return {
        "direction": one.direction,
        "says": one.says,
        "fields": [{"name": each.name, "bytes": shown(each.data), "means": each.means} for each in one.fields],
        "registers": [_register(each) for each in one.registers],
        "wrong": [_wrong(wrong) for wrong in one.wrongs],
        "notes": list(one.notes),
    }


def _register(one: Held) -> Plain:
    return {
        "address": one.address,
        "id": one.id,
        "name": one.name,
        "name_zh": one.zh,
        "in_map": one.known,
        "word": one.word,
        "number": one.number,
        "value": plain(one.value) if one.value is not None else None,
        "unit": one.unit,
        "note": one.note,
        "parts": [
            {"mark": each.mark, "id": each.id, "name": each.name, "name_zh": each.zh, "value": each.value}
            for each in one.lines
        ],
    }
