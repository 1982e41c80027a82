"""Scenes of the blocks that a drive block and a line are made of, each by itself: the tables of part.yaml and family.

What they are given in one call, no drive shows at will, and a restart in the midst of it least of all.
"""

import re
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from importlib.resources import files
from typing import Any

import yaml

from driveblocks.maps.model import Drive
from driveblocks.testing.scenes import family
from driveblocks.testing.scenes.scene import More, Scene, Shows, Step, Value, scene, script
from driveblocks.testing.script import SCAN_MS, Script
from structured_text.language.writing import WIDTH, byte, flowing, word

BLOCKS = {
    "Part": ("UINT", "which block is called, 0: none"),
    "Given": ("MB_Words", "its inputs"),
    "Nothing": ("MB_Words", "none"),
    "Known": ("VFD_Seen", "what it gets about the drive"),
    "Unknown": ("VFD_Seen", "nothing"),
    "Wish": ("VFD_Asked", "what it gets about the pins"),
    "NoWish": ("VFD_Asked", "nothing"),
    "Kept": ("VFD_Diagnosis", "what is kept of a drive"),
    "Lone": ("MB_Slot", "a slot that no line serves"),
    "Trail": ("MB_StopTrack", "what is kept about a stop"),
    "Ear": ("MB_LineFrame", "a reply"),
    "Count": ("UDINT", "what a user keeps"),
    "Preset": ("VFD_Settings", "settings"),
    "Call": ("MB_Open", "a request"),
    "Fetched": ("MB_Words16", "what was read"),
    "Rack": ("MB_Slots8", "the slots of a line"),
    "NoRack": ("MB_Slots8", "empty ones"),
    "Plug": ("MB_Port", "its port"),
    "NoPlug": ("MB_Port", "a blank one"),
}
_INPUT = re.compile(r"(\w+)([?#=~])(\w*)")


@cache
def parts() -> dict[str, Any]:
    """The table: of each block its inputs and calls."""
    text = (files(__package__) / "part.yaml").read_text(encoding="utf-8")
    found: dict[str, Any] = yaml.safe_load(text)
    return found


def scripts(drive: Drive, stem: str) -> Iterator[Script]:
    """One program."""
    every = parts() | family.parts(drive)
    blocks = BLOCKS | {_instance(block): (block, "under test") for block in every}
    calls = ["CASE Part OF"]
    for number, (block, part) in enumerate(every.items(), 1):
        calls += [f"  {number}:", *_call(block, part["inputs"])]
    more = More(blocks=blocks, calls=(*calls, "ELSE", "  Part := 0; (* none *)", "END_CASE;", "Part := 0;"))
    scenes = (each for number, (block, part) in enumerate(every.items(), 1) for each in _scenes(number, block, part))
    yield script(drive, stem, "MotorParts", "blocks that others are made of", scenes, more)


def _instance(block: str) -> str:
    return f"The{block.partition('_')[2]}"


def _call(block: str, inputs: str) -> list[str]:
    """The call, broken between its inputs."""
    first, *others, last = _inputs(inputs)
    pieces = (f"{_instance(block)}({first}", *others)
    lines = flowing([*(f"{each}," for each in pieces), f"{last});"], " " * 6, WIDTH - 2)
    return [lines[0][2:], *lines[1:]]


def _inputs(inputs: str) -> Iterator[str]:
    for at, (name, kind, type_) in enumerate(_INPUT.findall(inputs)):
        number = f"WORD_TO_UINT(Given[{at}])"
        if type_:
            number = f"UINT_TO_{type_}({number})"
        shapes = {"?": f"Given[{at}] <> WORD#16#0000", "~": f"Given[{at}]", "=": type_, "#": number}
        yield f"{name} := {shapes[kind]}"


def _scenes(number: int, block: str, part: Mapping[str, Any]) -> Iterator[Scene]:
    """A scene, and one more after each row that is but its name."""
    name, rows = block, list[Any]()
    for row in part["calls"]:
        if len(row) == 1:
            yield _scene(name, number, block, part["inputs"], rows)
            name, rows = f"{block}, {row[0]}", []
        else:
            rows.append(row)
    yield _scene(name, number, block, part["inputs"], rows)


def _scene(name: str, number: int, block: str, inputs: str, rows: Iterable[Any]) -> Scene:
    """A step lasts one call, in which all is as in the call before but what it is given."""
    blank: Shows = {
        ".Part": 0, ".Given": "Nothing", ".Known": "Unknown", ".Wish": "NoWish", ".Rack": "NoRack", ".Plug": "NoPlug",
    }  # fmt: skip
    places = {pin: at for at, (pin, *_) in enumerate(_INPUT.findall(inputs))}
    steps = [Step("nothing", blank, ms=SCAN_MS)]
    for words, gets, shows in _each(rows, port="Port" in places):
        given = dict(_given(places, key, value) for key, value in gets.items())
        seen = dict(
            _shown(key if "." in key and not key.startswith("Asked.") else f"{_instance(block)}.{key}", value)
            for key, value in shows.items()
        )
        steps.append(Step(words, {".Part": number} | given, ms=SCAN_MS, shows=seen))
    return scene(name, steps)


def _each(rows: Iterable[Any], *, port: bool) -> Iterator[tuple[str, Mapping[str, Any], Mapping[str, Any]]]:
    """The calls; of several for one row, what they show is looked at after the last."""
    for words, gets, shows, *more in rows:
        given: list[dict[str, Any]] = [{}]
        for one in more:
            octets = [] if isinstance(one, int) else [int(each, 16) for each in one.split()]
            given = [_received(octets)] if port else [{"Character": each} for each in octets] or one * [gets]
        for at, each in enumerate(given):
            yield words, (each if at else gets | each), (shows if at + 1 == len(given) else {})


def _received(octets: list[int]) -> dict[str, Any]:
    """Characters in the port, which is empty after each call."""
    ring: dict[str, Any] = {f"Plug.Rx[{at}]": byte(octet) for at, octet in enumerate(octets)}
    return ring | {"Plug.RxOut": 0, "Plug.RxIn": len(octets)}


def _given(places: Mapping[str, int], key: str, value: Any) -> tuple[str, Value]:
    return (f".Given[{places[key]}]", word(int(value))) if key in places else (key, value)


def _shown(key: str, value: Value) -> tuple[str, Value]:
    """A number is compared whatever its type."""
    return (key, value) if isinstance(value, bool) else (f"{key.removeprefix('.')} = {value}", True)
