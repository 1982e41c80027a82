"""Run iec2c: ST in, C out, and what it says about the ST."""

import re
from dataclasses import dataclass
from pathlib import Path

from structured_text.engines.engine import BuildError, EngineError, Message
from structured_text.engines.matiec.declarations import read_declarations
from structured_text.engines.matiec.errors import CompilerCrashError, RefusedWithCrashError
from structured_text.engines.matiec.installation import Installation
from structured_text.engines.matiec.process import Outcome, run
from structured_text.engines.matiec.text import Listing
from structured_text.files import data, put

# -f whole token positions, -p forward references, -i blocks without parameters; -O l puts #line into the C.
_OPTIONS = ("-f", "-p", "-i", "-O", "l")

# `file:line-column..line-column: error: text`; the second place may name its file, some messages have a line only.
_MESSAGE = re.compile(
    r"^(?P<path>[^:]+(?::[\\/][^:]+)?):(?P<line>\d+)(?:-(?P<column>\d+)\.\.(?:.*:)?\d+-\d+)?: "
    r"(?P<kind>error|warning)(?: while generating C code)?\s?: (?P<text>.*)$"
)
# The one refusal that has no place.
_LOST = re.compile(r"^Parsing failed because of too many consecutive syntax errors", re.MULTILINE)
_INTERNAL = re.compile(r"^Internal compiler error.*$", re.MULTILINE)
# Said without a place: a limit was reached, a file is not readable ...
_SUMMARY = re.compile(r"^(\d+ error\(s\) found\. Bailing out!|.*\.(c|h|csv)|)$")
_QUOTED_LINES = 8
_COLLISION = (
    "iec2c stumbled over its own library: {} is named as a parameter there (such as P, L, N, G or IN);"
    " give it another name"
)
_LOST_COLLISION = Message(Listing.NAME, 1, 0, _COLLISION.format("a type, function, block or program"))
_WORD = re.compile(r"\w+")


@dataclass(frozen=True)
class Translator:
    """iec2c of one installation with its time limit."""

    installation: Installation
    seconds: float = 60.0

    def run(self, listing: Listing, directory: Path) -> list[Message]:
        """Translate; the C is then in `directory`. Give the warnings back, on lines of the joined text.

        Raises BuildError with iec2c's messages on our files; CompilerCrashError, CompilerTimeoutError; EngineError
        if it cannot run, says what nobody understands or writes no C.
        """
        put(directory / listing.NAME, listing.text, sync=False)
        program = str(self.installation.iec2c)
        command = [program, *_OPTIONS, "-I", str(self.installation.library), "-T", ".", listing.NAME]
        outcome = run(command, directory, self.seconds)
        errors, warnings = _messages(outcome.output)
        if not errors and (lost := _LOST.search(outcome.output)):
            errors.append(Message(listing.NAME, 1, 0, lost[0]))
        if foreign := [each for each in errors if each.path != listing.NAME]:
            errors = [each for each in errors if each not in foreign]
            errors += self._collisions(listing, foreign) or [*foreign, *([] if errors else [_LOST_COLLISION])]
        if outcome.status != 0 or errors:
            raise self._failure(outcome, listing.locate(errors))
        for name in ("POUS.c", "POUS.h"):
            if not (directory / name).is_file():
                raise EngineError(f"{program} said that it was done but wrote no {name}{_quote(outcome.output)}")
        return warnings

    def _collisions(self, listing: Listing, foreign: list[Message]) -> list[Message]:
        """What causes messages on iec2c's own library: names of ours that its lines use for parameters."""
        words = {word.upper() for each in foreign for word in _WORD.findall(self._library_line(each))}
        declared = read_declarations(listing.text)
        found = [
            Message(listing.NAME, unit.line, 0, _COLLISION.format(unit.name))
            for name, unit in declared.units.items()
            if name in words
        ]
        types = [f"the type {name}" for name in declared.types if name in words]
        return [*found, *(Message(listing.NAME, 1, 0, _COLLISION.format(name)) for name in types)]

    def _library_line(self, message: Message) -> str:
        try:
            text = data(self.installation.library / Path(message.path).name).decode(errors="replace")
        except OSError:
            return ""
        return text.splitlines()[message.line - 1] if message.line <= text.count("\n") else ""

    def _failure(self, outcome: Outcome, errors: list[Message]) -> EngineError:
        program = self.installation.iec2c
        signal = outcome.signal_name
        if errors:
            return (
                RefusedWithCrashError(errors, f"iec2c crashed ({signal}) after this") if signal else BuildError(errors)
            )
        if signal:
            return CompilerCrashError(
                f"{program} crashed ({signal}) without a word; it does so on a reserved word as a name, on names like"
                " a__b or x_, on an empty VAR block and on much else that `driveblocks lint` points at"
            )
        if internal := _INTERNAL.search(outcome.output):
            return CompilerCrashError(f"{program} gave up: {internal[0].strip()}")
        return EngineError(f"{program} failed with status {outcome.status}{_quote(outcome.output)}")


def _messages(output: str) -> tuple[list[Message], list[Message]]:
    """Errors and warnings, each once: iec2c repeats itself when several passes meet the same mistake."""
    kinds: dict[str, dict[Message, None]] = {"error": {}, "warning": {}}
    for line in output.splitlines():
        if match := _MESSAGE.match(line):
            kinds[match["kind"]][_message(match)] = None
    return list(kinds["error"]), list(kinds["warning"])


def _message(match: re.Match[str]) -> Message:
    path = Listing.NAME if Path(match["path"]).name == Listing.NAME else match["path"]
    return Message(path, int(match["line"]), int(match["column"] or 0), match["text"])


def _quote(output: str) -> str:
    shown = "".join(each if each.isprintable() or each == "\n" else "?" for each in output)
    lines = [line for line in shown.split("\n") if line.strip() and not _SUMMARY.match(line.strip())]
    return ": " + "\n".join(line[:200] for line in lines[:_QUOTED_LINES]) if lines else " and no message"
