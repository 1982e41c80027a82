"""The blocks that a drive block and a line are made of, each in a program of its own: the tables of part.yaml, family.

What they are given in one call, no drive shows at will, and a restart in the midst of it least of all.
"""

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import cache
from importlib.resources import files
from itertools import pairwise
from typing import Any

import yaml

from driveblocks.bench import kit
from driveblocks.bench.scenes import family
from driveblocks.bench.scenes.scene import Value, checks, statements
from driveblocks.bench.script import Item, Script, Stage
from driveblocks.maps.model import Drive
from structured_text.language.writing import byte, word

VARIABLES = {
    "Given": ("MB_Words", "its inputs"),
    "NotGiven": ("MB_Words", "none"),
    "Known": ("VFD_Seen", "what it gets about the drive"),
    "NotKnown": ("VFD_Seen", "nothing"),
    "Wish": ("VFD_Asked", "what it gets about the pins"),
    "NotWish": ("VFD_Asked", "nothing"),
    "Kept": ("VFD_Diagnosis", "what is kept of a drive"),
    "Lone": ("MB_Slot", "a slot that no line serves"),
    "Said": ("MB_Answer", "the answer to a stop"),
    "Told": ("MB_Answer", "the answer to a command"),
    "Trail": ("MB_StopTrack", "what is kept about a stop"),
    "Ear": ("MB_LineFrame", "characters of a frame"),
    "Written": ("MB_Words4", "what is written"),
    "Count": ("UDINT", "what a user keeps"),
    "Preset": ("VFD_Settings", "settings"),
    "Call": ("MB_Open", "a request"),
    "Fetched": ("MB_Words16", "what was read"),
    "Rack": ("MB_Slots8", "the slots of a line"),
    "NotRack": ("MB_Slots8", "empty ones"),
    "Plug": ("MB_Port", "its port"),
    "NotPlug": ("MB_Port", "a blank one"),
}
"""What a program may need; a scene begins with a blank one of those that have one."""
_INPUT = re.compile(r"(\w+)([?#=~])(\w*)")


@cache
def parts() -> dict[str, Any]:
    """The table: of each block its inputs and calls."""
    text = (files(__package__) / "part.yaml").read_text(encoding="utf-8")
    found: dict[str, Any] = yaml.load(text, getattr(yaml, "CSafeLoader", yaml.SafeLoader))  # noqa: S506 - both are safe
    return found


def scripts(drive: Drive, stem: str) -> Iterator[Script]:
    own = (_filled(block, part) for block, part in family.parts(drive).items())
    for part in (*_shared(), *own):
        block = part.name
        one = kit.script(drive, stem, f"Part{block.partition('_')[2]}", f"{block}, called by itself")
        yield replace(part, folder=one.folder, name=one.name, title=one.title, source=one.source)


@cache
def _shared() -> list[Script]:
    """Those of the blocks that every drive has, without a head."""
    return [_filled(block, part) for block, part in parts().items()]


def _filled(block: str, part: Mapping[str, Any]) -> Script:
    """The block is called first in each scan, with what the stage before has set."""
    one = Script("", block, "", "")
    text = f"{part['inputs']} {part['calls']}"
    used = [name for name in VARIABLES if re.search(rf"\b{name}\b", text) or name == "Given"]
    blanks = {f".{name}": f"Not{name}" for name in used if f"Not{name}" in VARIABLES}
    for name in (*used, *blanks.values()):
        one.variables[name] = VARIABLES[name]
    one.variables[_instance(block)] = (block, "under test")
    one.defaults = _call(block, part["inputs"])
    one.stages = [stage for scene in _scenes(block, part) for stage in _stages(*scene, blanks)]
    return one


def _instance(block: str) -> str:
    return f"The{block.partition('_')[2]}"


def _call(block: str, inputs: str) -> list[str]:
    first, *others, last = _inputs(inputs)
    return [*(f"{each}," for each in (f"{_instance(block)}({first}", *others)), f"{last});"]


def _inputs(inputs: str) -> Iterator[str]:
    for at, (name, kind, type_) in enumerate(_INPUT.findall(inputs)):
        number = f"WORD_TO_UINT(Given[{at}])"
        if type_:
            number = f"UINT_TO_{type_}({number})"
        shapes = {"?": f"Given[{at}] <> WORD#16#0000", "~": f"Given[{at}]", "=": type_, "#": number}
        yield f"{name} := {shapes[kind]}"


_Call = tuple[str, Mapping[str, Value], list[Item]]
"""In words, what is set before it, what must be so after it."""


def _scenes(block: str, part: Mapping[str, Any]) -> Iterator[tuple[str, list[_Call]]]:
    """A scene, and one more after each row that is but its name."""
    name, rows = block, list[Any]()
    for row in part["calls"]:
        if len(row) == 1:
            yield name, _calls(block, part["inputs"], rows)
            name, rows = f"{block}, {row[0]}", []
        else:
            rows.append(row)
    yield name, _calls(block, part["inputs"], rows)


def _calls(block: str, inputs: str, rows: Iterable[Any]) -> list[_Call]:
    """All is as in the call before but what it is given."""
    places = {pin: at for at, (pin, *_) in enumerate(_INPUT.findall(inputs))}
    found = list[_Call]()
    for words, gets, shows in _each(rows, port="Port" in places):
        given = dict(_given(places, key, value) for key, value in gets.items())
        seen = dict(
            _shown(key if "." in key and not key.startswith("Asked.") else f"{_instance(block)}.{key}", value)
            for key, value in shows.items()
        )
        found.append((words, given, checks(seen)))
    return found


def _stages(scene: str, calls: list[_Call], blanks: Mapping[str, Value]) -> Iterator[Stage]:
    """What a call must have shown, then what the next one is given."""
    first: _Call = ("nothing", blanks, [])
    for number, (one, after) in enumerate(pairwise([first, *calls, ("", {}, [])]), 1):
        words, given = one[0], {**(blanks if one is first else {}), **after[1]}
        yield Stage(f"{scene}, {number}: {words}", "", [*one[2], *statements(given)], scene=scene)


def _each(rows: Iterable[Any], *, port: bool) -> Iterator[tuple[str, Mapping[str, Any], Mapping[str, Any]]]:
    """The calls; of several for one row, what they show is looked at after the last."""
    for words, gets, shows, *more in rows:
        given: list[dict[str, Any]] = [{}]
        for one in more:
            if isinstance(one, int):
                given = one * [gets]
                continue
            octets = [int(each, 16) for each in one.split()]
            given = [_received(octets)] if port else [{"Character": each} for each in octets]
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
