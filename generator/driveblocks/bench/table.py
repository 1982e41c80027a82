"""A table of cases: variables with usual values, and rows that change some of them."""

from collections.abc import Callable, Mapping
from typing import Any

from driveblocks.bench.script import Item, Script
from structured_text.language.writing import byte, dword, flag, real, word

_LITERALS: dict[str, Callable[[Any], str]] = {
    "BOOL": flag, "BYTE": byte, "WORD": word, "DWORD": dword, "UINT": str, "REAL": real,
}  # fmt: skip


class Table:
    """Adds rows to a script. Each scan starts from the usual values, so that no row depends on the one before."""

    def __init__(self, script: Script) -> None:
        """Take the script; its tail is what is done with each row."""
        self.script = script
        self._usual: dict[str, tuple[str, Any]] = {}

    def column(self, name: str, type_: str, usual: Any, comment: str) -> None:
        self._usual[name] = (type_, usual)
        self.script.variables[name] = (type_, comment)
        self.script.defaults.append(self._assigned(name, usual))

    def always(self, *statements: str) -> None:
        """Add statements that every row starts from."""
        self.script.defaults += statements

    def do(self, *items: Item) -> None:
        """Add statements and checks that every row ends with."""
        self.script.tail += items

    def row(self, words: str, values: Mapping[str, Any], *statements: str, source: str = "") -> None:
        """Add a case: the variables that differ from the usual, and further statements."""
        changed = [self._assigned(name, value) for name, value in values.items() if value != self._usual[name][1]]
        if not (changed or statements):
            name = next(iter(values), next(iter(self._usual)))
            changed = [self._assigned(name, values.get(name, self._usual[name][1]))]
        self.script.stage(words, *statements, *changed, source=source)

    def _assigned(self, name: str, value: Any) -> str:
        return f"{name} := {_LITERALS[self._usual[name][0]](value)};"
