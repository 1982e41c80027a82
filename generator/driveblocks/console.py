"""Where commands print: a terminal with colours, or a plain file or pipe; the same words and columns in both.

What users name and write into maps, sources and frames is printed, too. Control characters in it would steer the
terminal, and those that turn the direction of writing would show another text than is there: they are written out.
"""

import io
import os
import sys
import time
from collections.abc import Callable, Iterable
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, TextIO

from structured_text import files
from structured_text.visible import visible

if TYPE_CHECKING:  # what prints no table does not load rich
    from rich.console import Console, ConsoleOptions, RenderableType
    from rich.progress import Task
    from rich.segment import Segment

NARROWEST = 60
"""Columns below which tables would lose text; a narrower terminal breaks the lines itself."""
WIDEST = 1000
"""No terminal is wider; COLUMNS may say anything."""
BESIDE = 54
"""Columns of a bar beside what it is at."""
KNOWN = 0.05
"""The share of something from which its pace tells how long the rest takes."""
MINUTES_FROM = 100
"""Seconds from which a time is said in minutes."""


class Shown:
    """A stream on which everything is visible; `stream` is the one beneath."""

    def __init__(self, stream: TextIO) -> None:
        self.stream = stream

    def write(self, text: str) -> int:
        return self.stream.write(visible(text))

    def writelines(self, lines: Iterable[str]) -> None:
        for line in lines:
            self.write(line)

    def __getattr__(self, attribute: str) -> Any:
        """Whatever else the stream can do."""
        return getattr(self.stream, attribute)


def use_safe_utf8() -> None:
    """Make both standard streams UTF-8, and what is written there visible.

    Under a C locale Python may choose ASCII, and the manuals are Chinese.
    """
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name) or io.StringIO()  # None where it was closed before the start
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(encoding="utf-8", errors="replace")
        setattr(sys, name, Shown(stream))


def give_up_output() -> None:
    """Drop what could not be written to standard output, or Python would complain of it once more at its end."""
    with suppress(OSError, ValueError):
        os.dup2(files.opened(Path(os.devnull)).fileno(), sys.stdout.fileno())


def terminal(name: str = "stdout") -> "Console":
    """Standard output, or `stderr`, as rich has it; `is_terminal` says whether it is one."""
    from rich.console import Console
    from rich.text import Text

    class Visible(Console):
        """A console that makes texts visible before it colours them and computes their width."""

        def render_str(self, text: str, **options: Any) -> Text:
            """A text, or one in a cell of a table."""
            return super().render_str(visible(text), **options)

        def render(self, renderable: "RenderableType", options: "ConsoleOptions | None" = None) -> "Iterable[Segment]":
            """Anything; a text that has its colours already comes here only."""
            if isinstance(renderable, Text):
                renderable = renderable.copy()
                renderable.plain = visible(renderable.plain)
            return super().render(renderable, options)

    stream = getattr(sys, name)
    beneath = stream.stream if isinstance(stream, Shown) else stream
    return Visible(file=beneath, markup=False, emoji=False, highlight=False)


class Bar:
    """How far something is that takes its time, and for how long still: a line of a terminal, which goes away.

    Elsewhere nothing.
    """

    def __init__(self, screen: "Console", *, ticks: bool = True, clock: Callable[[], float] = time.monotonic) -> None:
        """`ticks`: it counts seconds in a thread of its own, which must not be where processes are forked."""
        from rich.progress import BarColumn, Progress, ProgressColumn, TextColumn
        from rich.text import Text

        class Pace(ProgressColumn):
            """The seconds so far, and those that are left."""

            def render(self, task: "Task") -> Text:  # noqa: ARG002  (the bar knows)
                return Text(f"{left(*bar.way)}:")

        bar, percent = self, TextColumn("{task.percentage:>3.0f} %")
        columns = BarColumn(20), percent, Pace(), TextColumn("{task.description}", markup=False)
        self._bar = Progress(
            *columns, console=screen, auto_refresh=ticks, transient=True, redirect_stdout=False, redirect_stderr=False
        )
        self._task = self._bar.add_task("")
        self._seen, self._runs, self._screen = screen.is_terminal, False, screen
        self._clock, self._since = clock, 0.0
        self._done, self._total = 0.0, 0.0

    @property
    def way(self) -> tuple[float, float]:
        """The share that is done, and the seconds since its beginning."""
        return self._done / self._total if self._total else 0.0, self._clock() - self._since

    def show(self, done: float, total: float, text: str) -> None:
        """So much of it is done, and this is what it is at; less than before, or another total, begins anew."""
        from rich.text import Text

        if total != self._total or done < self._done:
            self._since = self._clock()
        self._done, self._total = done, total
        words = Text(visible(text))
        words.truncate(max(self._screen.width - BESIDE, 0), overflow="ellipsis")
        self._bar.update(self._task, completed=done, total=total, description=words.plain, refresh=self._runs)
        if self._seen and not self._runs:
            self._runs = True
            self._bar.start()

    def close(self) -> None:
        """Take it away, so that something else can be printed; the next `show` brings it back."""
        if self._runs:
            self._bar.stop()
            self._runs = False


def left(share: float, seconds: float) -> str:
    """How long it took to come so far, and how long the rest takes at that pace, in words."""
    rest = (
        f", about {_time(max(1.0, seconds * (1 - share) / share))} left" if KNOWN <= share < 1 and seconds >= 1 else ""
    )
    return _time(seconds) + rest


def _time(seconds: float) -> str:
    return f"{seconds:.0f} s" if seconds < MINUTES_FROM else f"{seconds / 60:.0f} min"


def write(*pieces: "RenderableType") -> None:
    """Print text and tables as wide as the terminal or COLUMNS, or 80 columns where neither is known.

    Text is printed as it is: no markup, no emoji names, no colouring by guess. What does not go to a terminal has no
    escape codes and no blanks at the end of a line.
    """
    console = terminal()
    console.width = min(max(console.width, NARROWEST), WIDEST)
    if console.is_terminal:
        for piece in pieces:
            console.print(piece)
        return
    with console.capture() as capture:
        for piece in pieces:
            console.print(piece)
    console.file.write("".join(f"{line.rstrip()}\n" for line in capture.get().split("\n")[:-1]))
