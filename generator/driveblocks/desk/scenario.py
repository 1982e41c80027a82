"""Scenarios: what happens when to simulated drives and their line, as YAML: `- at 3 s: trip OC`."""

import difflib
import json
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from driveblocks.bench.simulator.drive import SimulatedDrive
from driveblocks.bench.simulator.habits import Habits
from driveblocks.desk.bus import Loss
from driveblocks.desk.script import duration_us
from driveblocks.maps import nodes, source
from driveblocks.maps.model import Drive
from driveblocks.maps.nodes import Entries, Items, Node, Scalar
from driveblocks.maps.problem import MapError, Problem, Report

TIME = r"[0-9]{1,12}(\.[0-9]{1,12})? ?(ms|s|min)"
UNIT = r"( (?P<unit>[1-9][0-9]{0,2}))?"
PERCENT = r" (?P<percent>[0-9]{1,3}(\.[0-9]+)?) ?%"
LASTS = rf"( for (?P<lasts>{TIME}))?"
SWITCH = r" (?P<switch>on|off)"
_AT = re.compile(rf"at (?P<time>{TIME})")
_EXAMPLE = "- at 3 s: trip 4"

Words = Mapping[str, str | None]
Act = Callable[[Sequence[SimulatedDrive], Loss], None]


@dataclass(frozen=True)
class Happening:
    at_us: int
    says: str
    act: Act


@dataclass(frozen=True)
class Verb:
    """A word that begins what happens; `rest` is what may follow it."""

    word: str
    rest: str
    sample: str
    means: str
    does: Callable[[SimulatedDrive, Words], object] | None = None
    """To each drive, or to the one that is named; None: `Loss` or time has a part in it."""


def _on(words: Words) -> bool:
    return words["switch"] == "on"


def _set(name: str) -> Callable[[SimulatedDrive, Words], None]:
    return lambda drive, words: setattr(drive, name, _on(words))


VERBS = (
    Verb("trip", rf" (?P<fault>\S.*?){UNIT}", "trip OC 2", "a fault, by its code, short display or name in the map"),
    Verb("clear", UNIT, "clear", "the fault's cause is gone; the fault stays until it is reset",
         lambda drive, _: drive.clear_cause()),
    Verb("reset", UNIT, "reset 2", "somebody resets the fault at the keypad", lambda drive, _: drive.reset()),
    Verb("power", SWITCH + UNIT, "power off 2", "supply off or on",
         lambda drive, words: drive.power(on=_on(words))),
    Verb("inhibit", SWITCH + UNIT, "inhibit on 2", "a safe torque off, or another interlock",
         lambda drive, words: drive.inhibit(on=_on(words))),
    Verb("local", SWITCH + UNIT, "local on 2", "the keypad is in control: commands are acknowledged and not followed",
         _set("local")),
    Verb("warning", SWITCH + UNIT, "warning on 2", "a warning", _set("warning")),
    Verb("run", rf" (?P<hz>[0-9]{{1,3}}(\.[0-9]+)?) ?Hz{UNIT}", "run 20 Hz 2", "somebody starts it at the keypad",
         lambda drive, words: drive.keypad_run(float(words["hz"] or 0))),
    Verb("stop", UNIT, "stop 2", "somebody stops it at the keypad", lambda drive, _: drive.keypad_stop()),
    Verb("load", PERCENT + UNIT, "load 80 % 2", "the motor's load",
         lambda drive, words: setattr(drive, "load", round(float(words["percent"] or 0)))),
    Verb("late", rf" (?P<late>{TIME}){LASTS}{UNIT}", "late 80 ms for 5 s 2", "replies begin this long after a request",
         lambda drive, words: setattr(drive, "turn_us", duration_us(words["late"] or ""))),
    Verb("drop", PERCENT + LASTS, "drop 10 % for 5 s", "this share of all frames, both ways, is lost"),
    Verb("damage", PERCENT + LASTS, "damage 1 %", "this share of all frames arrives with a wrong bit"),
)  # fmt: skip
"""Without a unit, what happens to a drive happens to all; without `for`, it lasts."""
_BY_WORD = {verb.word: verb for verb in VERBS}


def read(path: Path, drives: Mapping[int, Drive]) -> list[Happening]:
    """A scenario for the drives at these units, in the order of its times. Raises MapError with all that is wrong."""
    return loads(source.read(path), str(path), drives)


def loads(text: str, name: str, drives: Mapping[int, Drive]) -> list[Happening]:
    """The same from a text; `name` is the one in messages."""
    report = Report(name)
    if not re.sub(r"(?m)^\s*#.*$", "", text).strip():
        raise MapError([Problem(name, 1, 1, "nothing happens here", f"write {_EXAMPLE}")])
    root = nodes.parse(text, report)
    found = list(_steps(root, report, drives)) if root is not None else []
    report.raise_if_any()
    return sorted(found, key=lambda each: each.at_us)


def said(text: str, drives: Mapping[int, Drive]) -> list[Happening]:
    """What happens now, and what of it ends later, by one sentence. Raises MapError."""
    quoted = text.replace("'", "''")
    return loads(f"- at 0 s: '{quoted}'\n", "keyboard", drives)


def _steps(root: Node, report: Report, drives: Mapping[int, Drive]) -> Iterator[Happening]:
    if not isinstance(root, Items):
        report.add(root.at, "a scenario is a list", f"write {_EXAMPLE}")
        return
    for item in root.items:
        if not isinstance(item, Entries):
            report.add(item.at, "this step has no time", f"write {_EXAMPLE}")
            continue
        for key, value in item.entries.values():
            yield from _Step(report, drives, key).happenings(value)


class _Step:
    def __init__(self, report: Report, drives: Mapping[int, Drive], key: Scalar) -> None:
        self._report, self._drives = report, drives
        found = _AT.fullmatch(key.text)
        self._at_us = duration_us(found["time"]) if found else 0
        if not found and not key.refused:
            report.add(key.at, f"`{key.text}` is no time", "write `at 3 s`, in ms, s or min")

    def happenings(self, value: Node) -> Iterator[Happening]:
        """What happens; nothing where it is wrong."""
        if not isinstance(value, Scalar) or not value.text:
            self._report.add(value.at, "nothing happens here", f"write one of {', '.join(_BY_WORD)}")
            return
        if value.refused:
            return
        word = value.text.split(" ")[0]
        verb = _BY_WORD.get(word)
        if verb is None:
            near = difflib.get_close_matches(word.lower(), _BY_WORD, 1)
            right = f"did you mean `{near[0]}`?" if near else f"write one of {', '.join(_BY_WORD)}"
            self._report.add(value.at, f"`{word}` is nothing that happens", right)
            return
        found = re.fullmatch(verb.rest, value.text.removeprefix(word))
        if found is None:
            self._wrong(value, word, f"`{value.text}` is not complete, or says too much", f"write `{verb.sample}`")
            return
        yield from self._made(verb, value, found.groupdict())

    def _wrong(self, value: Scalar, before: str, wrong: str, right: str) -> None:
        """Note a mistake after the part of a text that is right."""
        line, column = value.at
        there = len(before) + (not value.plain) + (before != value.text)
        self._report.add((line, column + there), wrong, right)

    def _made(self, verb: Verb, value: Scalar, words: dict[str, str | None]) -> Iterator[Happening]:
        units = self._units(value, words)
        percent = float(words.get("percent") or 0)
        if percent > 100:
            self._wrong(value, verb.word, f"{words['percent']} % is more than all", "write 0 % to 100 %")
        if not units or percent > 100:
            return
        does = verb.does
        usual = f"late {Habits.turn_us / 1000:g} ms" + (f" {words['unit']}" if words.get("unit") else "")
        end = _each(units, lambda drive: setattr(drive, "turn_us", Habits.turn_us))
        if verb.word in ("drop", "damage"):
            act, end, usual = _loses(verb.word, percent / 100), _loses(verb.word, 0.0), f"{verb.word} 0 %"
        elif does is None:
            codes = self._codes(value, words["fault"] or "", units)
            act = _each(units, lambda drive: drive.trip(codes[drive.unit]))
        else:
            act = _each(units, lambda drive: does(drive, words))
        yield Happening(self._at_us, value.text, act)
        if lasts := words.get("lasts"):
            yield Happening(self._at_us + duration_us(lasts), usual, end)

    def _units(self, value: Scalar, words: Words) -> tuple[int, ...]:
        named = words.get("unit")
        if named is None:
            return tuple(self._drives)
        if int(named) not in self._drives:
            units = ", ".join(map(str, self._drives))
            self._wrong(
                value, value.text[: value.text.rindex(" ")], f"there is no drive at unit {named}", f"units: {units}"
            )
            return ()
        return (int(named),)

    def _codes(self, value: Scalar, word: str, units: tuple[int, ...]) -> dict[int, int]:
        """The fault's code at each unit; 0 where it is wrong."""
        codes = {unit: _code(self._drives[unit], word) for unit in units}
        for unit in (unit for unit, code in codes.items() if not code):
            drive = self._drives[unit]
            known = {name.lower(): name for each in drive.faults.codes for name in (each.id, each.name) if name}
            near = difflib.get_close_matches(word.lower(), known, 1, 0.5)
            right = (
                f"did you mean `{known[near[0]]}`?" if near else "write its number, or name the unit of another drive"
            )
            self._wrong(value, "trip", f"{drive.prefix} at unit {unit} has no fault `{word}`", right)
            break
        return codes


def _code(drive: Drive, word: str) -> int:
    """A fault's number; 0: there is none."""
    if re.fullmatch(r"[0-9]{1,5}|[0-9A-F]{1,4}H", word):
        number = int(word[:-1], 16) if word.endswith("H") else int(word)
        listed = [each.code for each in drive.faults.codes]
        return number if number <= 0xFFFF and (number in listed or not listed) else 0
    names = {name.lower(): each.code for each in reversed(drive.faults.codes) for name in (each.name, each.id) if name}
    return names.get(word.lower(), 0)


def _each(units: tuple[int, ...], does: Callable[[SimulatedDrive], object]) -> Act:
    def act(drives: Sequence[SimulatedDrive], _: Loss) -> None:
        for drive in drives:
            if drive.unit in units:
                does(drive)

    return act


def _loses(name: str, share: float) -> Act:
    return lambda _, loss: setattr(loss, name, share)


def schema() -> str:
    """The JSON Schema (draft 7) of scenarios, for editors."""
    nameless = {verb: re.sub(r"\?P<\w+>", "", verb.rest) for verb in VERBS}  # as its regular expressions are
    steps = [
        {"pattern": f"^{verb.word}{rest}$", "description": f"{verb.means}: {verb.sample}"}
        for verb, rest in nameless.items()
    ]
    step = {
        "type": "object",
        "additionalProperties": False,
        "minProperties": 1,
        "patternProperties": {f"^at {TIME}$": {"type": "string", "anyOf": steps}},
    }
    head = {"$schema": "http://json-schema.org/draft-07/schema#", "title": "DriveBlocks scenario"}
    return json.dumps({**head, "type": "array", "minItems": 1, "items": step}, indent=1) + "\n"
