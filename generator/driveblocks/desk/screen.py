"""What a person sees of a run: a live table on a terminal, lines elsewhere. All of it shows whose port it is."""

import sys
from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Protocol

from rich.columns import Columns
from rich.console import Console, Group, RenderableType
from rich.live import Live
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from driveblocks import console
from driveblocks.desk.seen import Seen, View, is_bad, spelled
from structured_text.engines.engine import Value

HELP = "Type a number to toggle, NAME := VALUE, or help; q stops all and ends."
BAD, GOOD = "bold red1", "bold green4"
"""Colours of fixed shade, readable on black and on white; the red and green of a palette are too dark or too bright."""
COLUMNS = ("drive", "unit", "0 to maximum", "Hz", "asked", "state")
LONGEST_NAME, BAR = 24, 20
"""Columns of a drive's name, and of its speed."""
ROWS, ROOM = 4, 8
"""Rows of a terminal that a drive may take with its reason, and those of everything else."""
LAST = 3
"""Lines of what was said that are seen in any case."""
MOST_SAID = 200
WIDE = 110
"""Columns from which there is room for plots."""
BARS = "▁▂▃▄▅▆▇█"
PLOTTED, PLOT_US = 24, 500_000
"""Columns of a plot, and the time of each."""
EVERY_US = 1_000_000
"""Between two lines on a number that changes all the time."""


class Screen(Protocol):
    """Where a run shows itself."""

    def say(self, text: str) -> None:
        """One line that stays."""

    def show(self, view: View) -> None:
        """How things are."""

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
        sys.stdout.write(f"{self._label}  {text}\n")
        sys.stdout.flush()

    def show(self, view: View) -> None:
        for drive in view.drives:
            now = drive.state if self._brief else f"{drive.state}; {drive.why}"
            if self._drives.get(drive.name) != now:
                self._drives[drive.name] = now
                hertz = "" if drive.hertz is None else f"{drive.hertz:.1f} Hz "
                self._at(view, f"  {drive.name} {hertz}{now}")
        for name, value in view.shown.items():
            at, old = self._shown.get(name, (-EVERY_US, None))
            settled = isinstance(value, bool) or view.at_us - at >= EVERY_US
            if old != value and settled:
                self._shown[name] = view.at_us, value
                self._at(view, f"  {name} = {spelled(value)}")

    def close(self) -> None:
        """Nothing to be put right."""

    def _at(self, view: View, text: str) -> None:
        self.say(f"{view.at_us / 1e6:5.1f} s{text}")


@dataclass(frozen=True)
class Heading:
    """What is above a table: whose port it is, and the program."""

    label: str
    title: str
    real: bool


class Plots:
    """The frequency of each drive, now and, on a terminal that has room for it, over the last seconds."""

    def __init__(self, terminal: Console) -> None:
        self._terminal = terminal
        self._hertz: dict[tuple[str, int], deque[float]] = {}
        self._next_us = 0

    @property
    def fit(self) -> bool:
        """Whether there is room, and the terminal has the characters."""
        return self._terminal.width >= WIDE and not self._terminal.options.ascii_only

    def rows(self, drives: int) -> int:
        """How many rows each of so many drives has room for."""
        return (self._terminal.height - ROOM) // max(1, drives)

    def bar(self, drive: Seen) -> str:
        """How much of its maximum a drive turns at; up to what it is asked for, or what is above that."""
        if drive.hertz is None or drive.most_hz <= 0:
            return ""
        turns, missing, above, free = "#-+." if self._terminal.options.ascii_only else "█░▓·"
        now, asked = (round(BAR * min(1.0, abs(hertz) / drive.most_hz)) for hertz in (drive.hertz, drive.asked_hz))
        rest = missing * (asked - now) if now < asked else above * (now - asked)
        return (turns * min(now, asked) + rest).ljust(BAR, free)

    def add(self, view: View) -> None:
        if view.at_us >= self._next_us:
            self._next_us = view.at_us + PLOT_US
            for each in view.drives:
                made = self._hertz.setdefault((each.name, each.unit), deque(maxlen=PLOTTED))
                made.append(abs(each.hertz or 0.0))

    def line(self, drive: Seen) -> str:
        """A drive's plot; its highest bar is what is asked, or the most that was seen."""
        seen = self._hertz.get((drive.name, drive.unit), deque()) if drive.hertz is not None else ()
        most = max(1.0, abs(drive.asked_hz), *seen)
        return "".join(BARS[round((len(BARS) - 1) * hertz / most)] for hertz in seen)


class LiveTable:
    """A table on a terminal, drawn anew in its place; messages go above it."""

    def __init__(self, heading: Heading) -> None:
        self._heading = heading
        self._console = console.terminal()
        self._plots = Plots(self._console)
        self._live = Live(console=self._console, auto_refresh=False, redirect_stdout=False, redirect_stderr=False)
        self._live.start()

    def say(self, text: str) -> None:
        """One line above the table."""
        self._console.print(Text(text, overflow="fold"))

    def show(self, view: View) -> None:
        self._plots.add(view)
        self._live.update(Group(*_parts(self._heading, view, self._plots)), refresh=True)

    def close(self) -> None:
        """Leave the last table as it is, and the cursor visible."""
        self._live.stop()


class Desk:
    """A whole terminal: a table at its top, and its last row for what a person types, which no drawing touches."""

    def __init__(self, heading: Heading) -> None:
        self._heading = heading
        self._console = console.terminal()
        self._plots = Plots(self._console)
        self._said: deque[str] = deque(maxlen=MOST_SAID)
        self._view: View | None = None
        self._console.set_alt_screen(True)
        self._console.file.write(f"\x1b[{self._console.height};1H")

    def say(self, text: str) -> None:
        """One line below the table; all of them stay after the end."""
        self._said.append(text)

    def show(self, view: View) -> None:
        """Draw everything but the last row, and keep the cursor where it is."""
        self._view = view
        self._plots.add(view)
        height = self._console.height - 1
        with self._console.capture() as capture:
            self._console.print(Group(*_parts(self._heading, view, self._plots), *_keys(view)))
        table = capture.get().splitlines()[: height - min(LAST, len(self._said))]
        rows = [*table, *list(self._said)[max(0, len(self._said) + len(table) - height) :]]
        rows += [""] * (height - len(rows))
        drawn = "\r\n".join(f"{row}\x1b[K" for row in rows)
        self._console.file.write(f"\x1b7\x1b[H{drawn}\x1b8")
        self._console.file.flush()

    def close(self) -> None:
        """Give the terminal back, with what was said and the last table."""
        self._console.set_alt_screen(False)
        for text in self._said:
            self._console.print(Text(text, overflow="fold"))
        if self._view is not None:
            self._console.print(Group(*_parts(self._heading, self._view, self._plots)))


def _parts(heading: Heading, view: View, plots: Plots) -> list[RenderableType]:
    head = Text.assemble(
        (f" {heading.label} ", "bold white on red" if heading.real else "bold reverse"),
        f"  {heading.title}  {view.at_us / 1e6:.1f} s",
    )
    parts: list[RenderableType] = [head, *_drives(view.drives, plots)]
    if view.port_error:
        parts.append(Text(f"the port does not work: {view.port_error}", BAD))
    if view.dropped:
        parts.append(Text(f"{view.dropped} frames not sent: only reads and stops are", "bold"))
    if view.shown:
        parts += [Text(), _values(view.shown)]
    return parts


def _keys(view: View) -> list[Columns | Text]:
    """The inputs by number, and how they are set."""
    words = [f"{number} {name} {spelled(value)}" for number, (name, value) in enumerate(view.inputs.items(), 1)]
    return [Text(), Columns(words, padding=(0, 3)), Text(HELP)] if words else []


def _drives(drives: Sequence[Seen], plots: Plots) -> Iterator[RenderableType]:
    """A row for each drive, and below it why it is so, and what to do.

    With less room that is cut to a row; with none it is there only where there is something to do.
    """
    rows = plots.rows(len(drives))
    name = max([5, *(min(len(each.name), LONGEST_NAME) for each in drives)])
    last = [f"Hz, last {PLOTTED * PLOT_US // 1_000_000} s"] if plots.fit else []
    yield _row(name, (*COLUMNS[:-1], *last, COLUMNS[-1]), "bold")
    for each in drives:
        hertz = "-" if each.hertz is None else f"{each.hertz:.1f}"
        plot = [plots.line(each)] if plots.fit else []
        row = (each.name, str(each.unit), plots.bar(each), hertz, f"{each.asked_hz:.1f}", *plot)
        yield _row(name, (*row, Text(each.state, _style(each.state))))
        if each.remedy or rows > 1:
            told = Text.assemble(each.why, (f" - {each.remedy}", "bold") if each.remedy else "")
            told.no_wrap, told.overflow = rows < ROWS, "ellipsis" if rows < ROWS else "fold"
            yield Padding(told, (0, 0, 0, name + 2))


def _row(name: int, cells: Sequence[str | Text], style: str = "") -> Table:
    """Cells in columns that are as wide in every row."""
    row = Table.grid(padding=(0, 2, 0, 0))
    widths = (name, 4, BAR, 6, 6, *([PLOTTED] if len(cells) > len(COLUMNS) else ()))
    for width, right in zip(widths, (False, True, False, True, True, False), strict=False):
        row.add_column(width=width, justify="right" if right else "left", overflow="fold")
    row.add_column(overflow="fold")
    row.add_row(*cells, style=style)
    return row


def _style(state: str) -> str:
    if is_bad(state):
        return BAD
    return GOOD if state.startswith(("forward", "reverse", "running")) else ""


def _values(values: dict[str, Value]) -> Table:
    table = Table(box=None, padding=(0, 2, 0, 0), show_header=False)
    for name, value in values.items():
        table.add_row(name, spelled(value))
    return table
