"""The listed differences: differences.yaml as data, and what each engine makes of them."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml

from structured_text.engines.engine import Engine, Library, ScanError, Source, Value
from structured_text.engines.matiec import BadCError

FILE = Path(__file__).parent / "differences.yaml"
# What is in the place of a value; no STRING of the list has these characters.
ERROR, BAD_C = b"error", b"badC"


@dataclass(frozen=True)
class Witness:
    """A program that shows a difference; `expected` by standard, beremiz, openplc."""

    name: str
    block: str
    text: str
    inputs: dict[str, Value]
    clocks_ns: tuple[int, ...]
    expected: dict[str, Value]
    fails: bool
    rules: tuple[str, ...]

    def value(self, engine: Engine) -> Value:
        """What `o` is after the last scan; `error` if a scan fails, `badC` if the C does not compile."""
        try:
            return self.run(engine.build([Source("witness.st", self.text)]))
        except BadCError:
            return BAD_C

    def run(self, library: Library) -> Value:
        """The same in a library that has its block."""
        instance = library.instance(self.block)
        for path, value in self.inputs.items():
            instance[path] = value
        try:
            for clock in self.clocks_ns:
                instance.scan(clock)
        except ScanError:
            return ERROR
        return instance["o"]


def build_together(engine: Engine, line: str) -> Library:
    """All witnesses in one library, but those whose C the line does not compile: a build takes matiec long."""
    sound = [each for each in load_witnesses().values() if each.expected[line] != BAD_C]
    return engine.build([Source(f"{each.name}.st", each.text) for each in sound])


def load_witnesses() -> dict[str, Witness]:
    """Every listed difference by name."""
    entries = yaml.safe_load(FILE.read_text(encoding="utf-8"))
    return {name: _witness(name, entry) for name, entry in entries.items()}


def _witness(name: str, entry: dict[str, Any]) -> Witness:
    block = "Show" + name.title().replace("-", "")
    return Witness(
        name=name,
        block=block,
        text=_text(block, entry),
        inputs={path: _value(value) for path, value in entry.get("set", {}).items()},
        clocks_ns=tuple(ms * 1_000_000 for ms in entry.get("scans_ms", [0])),
        expected={who: _value(entry[who]) for who in ("standard", "beremiz", "openplc")},
        fails=entry["fails"],
        rules=tuple(sorted(entry["rule"].replace("none", "").split())),
    )


def _value(value: Any) -> Any:
    return value.encode("latin-1") if isinstance(value, str) else value


def _text(block: str, entry: dict[str, Any]) -> str:
    before = entry.get("before", "")
    variables = f"VAR\n  {entry['vars']}\nEND_VAR\n" if "vars" in entry else ""
    output = f"VAR_OUTPUT\n  o : {entry['output']};\nEND_VAR\n"
    return f"{before}\nFUNCTION_BLOCK {block}\n{output}{variables}  {entry['body']}\nEND_FUNCTION_BLOCK\n"
