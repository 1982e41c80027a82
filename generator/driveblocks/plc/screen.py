"""What a person sees of a run: a live table on a terminal, lines elsewhere. Whose port it is stands on all of it."""

import sys
from collections.abc import Sequence
from typing import Protocol

from rich.console import Group
from rich.control import Control
from rich.live import Live
from rich.table import Table
from rich.text import Text

from driveblocks import console
from driveblocks.host.engine import Value
from driveblocks.plc.view import Seen, View, spelled

HELP = "Enter: NUMBER toggles, NAME := VALUE sets; Ctrl-C stops every drive and ends"
EVERY_US = 1_000_000
"""Between two lines on a number that changes all the time."""


class Screen(Protocol):
    """Where a run shows itself."""

    def say(self, text: str) -> None:
        """One line that stays."""

    def show(self, view: View) -> None:
        """How things are."""

    def typed(self) -> None:
        """A person has pressed Enter."""

    def close(self) -> None:
        """No more."""


class Lines:
    """Plain lines: a drive when its state or the reason changes, a variable when it does."""

    def __init__(self, label: str, *, brief: bool = False) -> None:
        """`label` begins every line; brief: no reasons."""
        self._label, self._brief = label, brief
        self._drives: dict[str, str] = {}
        self._shown: dict[str, tuple[int, Value]] = {}

    def say(self, text: str) -> None:
        """One line."""
        sys.stdout.write(f"{self._label}  {text}\n")
        sys.stdout.flush()

    def show(self, view: View) -> None:
        """What has changed."""
        for drive in view.drives:
            now = drive.state if self._brief else f"{drive.state}; {drive.why}"
            if self._drives.get(drive.name) != now:
                self._drives[drive.name] = now
                hertz = "" if drive.hertz is None else f"{drive.hertz:.1f} Hz "
                self._at(view, f"  {drive.name} {hertz}{now}")
        for name, value in view.shown.items():
            at, old = self._shown.get(name, (-EVERY_US, None))
            settled = not isinstance(value, float) or view.at_us - at >= EVERY_US
            if old != value and settled:
                self._shown[name] = view.at_us, value
                self._at(view, f"  {name} = {spelled(value)}")

    def typed(self) -> None:
        """Nothing moves."""

    def close(self) -> None:
        """Nothing to be put right."""

    def _at(self, view: View, text: str) -> None:
        self.say(f"{view.at_us / 1e6:5.1f} s{text}")


class LiveTable:
    """A table on a terminal, drawn anew in its place."""

    def __init__(self, label: str, title: str, *, real: bool, keys: bool) -> None:
        """Begin; `keys`: a person may set inputs."""
        self._label, self._title, self._real, self._keys = label, title, real, keys
        self._console = console.terminal()
        self._live = Live(console=self._console, auto_refresh=False, redirect_stdout=False, redirect_stderr=False)
        self._live.start()

    def say(self, text: str) -> None:
        """One line above the table."""
        self._console.print(Text(text, overflow="fold"))

    def show(self, view: View) -> None:
        """Draw the table."""
        self._live.update(Group(*self._parts(view)), refresh=True)

    def typed(self) -> None:
        """Enter has moved the cursor below the table."""
        self._console.control(Control.move(0, -1))

    def close(self) -> None:
        """Leave the last table as it is, and the cursor visible."""
        self._live.stop()

    def _parts(self, view: View) -> Sequence[Table | Text]:
        head = Text.assemble(
            (f" {self._label} ", "bold white on red" if self._real else "bold reverse"),
            f"  {self._title}  {view.at_us / 1e6:.1f} s",
        )
        parts: list[Table | Text] = [head, _drives(view.drives)]
        if view.port_error:
            parts.append(Text(f"the port does not work: {view.port_error}", "bold red"))
        if view.dropped:
            parts.append(Text(f"{view.dropped} frames not sent: only reads and stops leave", "bold"))
        if view.shown:
            parts.append(_values(view.shown))
        if self._keys and view.inputs:
            parts.append(_listed(view.inputs))
            parts.append(Text(HELP, "dim"))
        return parts


def _drives(drives: Sequence[Seen]) -> Table:
    table = Table(box=None, padding=(0, 2, 0, 0), expand=True, header_style="bold")
    for name, justify in (("drive", "left"), ("unit", "right"), ("state", "left"), ("asked", "right"), ("Hz", "right")):
        table.add_column(name, justify=justify, no_wrap=True)  # type: ignore[arg-type]  # a literal of rich
    table.add_column("why", ratio=1)
    for each in drives:
        hertz = "-" if each.hertz is None else f"{each.hertz:.1f}"
        state = Text(each.state, _style(each.state))
        table.add_row(each.name, str(each.unit), state, f"{each.asked_hz:.1f}", hertz, each.why)
    return table


def _style(state: str) -> str:
    if state.startswith(("fault", "STOP", "no reply")):
        return "bold red"
    return "bold green" if state.startswith(("forward", "reverse")) else ""


def _values(values: dict[str, Value]) -> Table:
    table = Table(box=None, padding=(0, 2, 0, 0), show_header=False)
    for name, value in values.items():
        table.add_row(name, spelled(value))
    return table


def _listed(inputs: dict[str, Value]) -> Text:
    words = (f"{number} {name} {spelled(value)}" for number, (name, value) in enumerate(inputs.items(), 1))
    return Text("   ".join(word.replace(" ", "\N{NO-BREAK SPACE}") for word in words))
