"""`driveblocks listen`: from the words of the command line to what is shown and kept of a line that others speak on."""

import csv
import datetime
import io
import os
import re
import signal
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import NoReturn

from rich.console import Group
from rich.live import Live

from driveblocks import console
from driveblocks.desk.clock import Clock, RealClock
from driveblocks.desk.exchange import Exchanges
from driveblocks.desk.frames import Cutter, Frame
from driveblocks.desk.port import reason
from driveblocks.desk.site import adapter, overheard
from driveblocks.desk.site import ear as ears
from driveblocks.desk.site.ear import Ear, SerialEar, TcpEar, find, ways
from driveblocks.desk.site.found import Way
from driveblocks.desk.words import opening, time
from driveblocks.maps.load import named
from driveblocks.maps.model import Drive
from driveblocks.maps.problem import Refused
from driveblocks.modbus.envelope import mode_of
from structured_text import files
from structured_text.visible import file_name

SHOWN_US = 500_000
"""Between two looks at the tables."""
LONGEST_US = 30 * 24 * 3600 * 1_000_000


@dataclass(frozen=True, kw_only=True)
class Words:
    maps: Sequence[str] = ()
    port: str | None = None
    tcp: str | None = None
    rate: int | None = None
    form: str | None = None
    length: str | None = None
    log: Path | None = None
    csv: Path | None = None

    @property
    def tried(self) -> list[Way]:
        """Rates and formats; the server at the other end of TCP has its own, and is taken to have the usual ones."""
        rate, form = self.rate, self.form and self.form.upper()
        return ways(rate, form) if self.port is not None else [Way(rate or 9600, form or "8N1")]

    def wrong(self) -> Iterator[str]:
        yield from adapter.wrong(self.port, self.tcp, self.rate, self.form, who="the line")
        for option, path in (("--log", self.log), ("--csv", self.csv)):
            if path is not None and os.path.lexists(path):
                yield f"{option} {file_name(path)} is there already; name another file"
        if self.log is not None and self.log == self.csv:
            yield "--log and --csv name one file; name two"


def run(words: Words, clock: Clock | None = None) -> tuple[Way | None, Exchanges, str, list[str]]:
    """Listen until a person or --for ends it. Raises Refused.

    How the line is spoken on, what was heard, why it ended early, and which files are not complete.
    """
    wrong = list(words.wrong())
    try:
        length_us = time("--for", words.length, 1, LONGEST_US) if words.length else None
    except Refused as refused:
        wrong.append(str(refused))
    drives = _drives(words.maps, wrong)
    if wrong:
        raise Refused("\n".join(wrong))
    clock, traffic = clock or RealClock(), Exchanges(*drives)
    with ExitStack() as stack:
        with opening(str(words.port or words.tcp)):
            ear = SerialEar(words.port) if words.port is not None else TcpEar(*adapter.host_and_port(words.tcp))
            ear.tune(words.tried[0])
        stack.callback(ear.close)
        log, table = (_kept(path, stack) for path in (words.log, words.csv))
        table.write(_row(overheard.COLUMNS))
        stack.enter_context(_hang_up())
        session = Session(ear, clock, traffic, log, table)
        try:
            session.find(words.tried)
            session.listen(length_us)
        except KeyboardInterrupt:
            pass
        except EOFError:
            session.ended = "the terminal was closed"
        except OSError as error:
            session.ended = reason(error)
        session.end()
    return session.way, traffic, session.ended, [each.wrong for each in (log, table) if each.wrong]


def _drives(names: Sequence[str], wrong: list[str]) -> tuple[dict[int, Drive], Drive | None]:
    """Maps by unit, and the one that is named without a unit."""
    found: dict[int, Drive] = {}
    anyone: Drive | None = None
    for word in names:
        name, at, unit = word.rpartition("@") if "@" in word else (word, "", "")
        try:
            _, drive = named(name)
        except Refused as error:
            wrong.append(str(error))
            continue
        if at and re.fullmatch("[0-9]{1,3}", unit) and 1 <= int(unit) <= 255 and int(unit) not in found:
            found[int(unit)] = drive
        elif at:
            wrong.append(f"{word}: write MAP@UNIT, each unit of 1 to 255 once")
        elif anyone is not None:
            wrong.append(f"{word}: only one map may be without a unit; write {name}@UNIT")
        else:
            anyone = drive
    return found, anyone


class File:
    """A new file of whole lines, or none; `wrong`: why nothing more could be written."""

    def __init__(self, path: Path | None) -> None:
        """Raises OSError."""
        self._name, self.wrong = file_name(path or ""), ""
        self.file = None if path is None else files.opened(path, new=True)

    def write(self, text: str) -> None:
        """A line, or nothing of it."""
        if self.file is None or self.wrong:
            return
        whole = self.file.tell()
        try:
            self.file.add(text.encode())
        except OSError as error:
            self.wrong = f"{self._name} is not complete: {reason(error)}"
            with suppress(OSError):
                self.file.truncate(whole)


def _kept(path: Path | None, stack: ExitStack) -> File:
    """A new file, closed at the end. Raises Refused."""
    with opening(str(path)):
        made = File(path)
    if made.file is not None:
        stack.callback(made.file.close)
    return made


def _row(cells: Sequence[str]) -> str:
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerow(cells)
    return text.getvalue()


@contextmanager
def _hang_up() -> Iterator[None]:
    """A closed terminal ends it as Ctrl-C does, so that the log says so."""

    def end(*_: object) -> NoReturn:
        raise EOFError

    hang_up = getattr(signal, "SIGHUP", None)  # Windows has none
    before = signal.signal(hang_up, end) if hang_up else None
    try:
        yield
    finally:
        if hang_up:
            signal.signal(hang_up, before)


class Session:
    """A line that is listened to, and what is shown and kept of it."""

    def __init__(self, ear: Ear, clock: Clock, traffic: Exchanges, log: File, table: File) -> None:
        self._ear, self._clock, self._log, self._table = ear, clock, log, table
        self.traffic = traffic
        self.way: Way | None = None
        self.came = 0
        """Bytes that were heard before a way was found."""
        self.ended = ""
        self._day = datetime.datetime.now(), clock.now_us()
        self._cutter = Cutter(traffic.dialects, 1)
        self._screen = console.terminal()

    def find(self, tried: Sequence[Way]) -> None:
        """Find how the line is spoken on; what a person named alone is taken as it is."""
        if len(tried) == 1:
            self.way = tried[0]
        else:
            with Live(console=self._screen, transient=True, auto_refresh=False) as live:

                def progress(way: Way, came: int) -> None:
                    self.came = came
                    if self._screen.is_terminal:
                        live.update(f"listening at {way.rate} bit/s {way.form}; {came} bytes so far", refresh=True)

                self.way, self.came = find(self._ear, self._clock, tried, self.traffic.dialects, progress)
        if self.way is not None:
            self._cutter = Cutter(self.traffic.dialects, self.way.character_us)
            self._log.write(f"# {self._now(self._clock.now_us())} {self.way.rate} bit/s {self.way.form}\n")

    def listen(self, length_us: int | None) -> None:
        """Hear everything until it is over. Raises OSError for a port that has gone."""
        begun = shown = self._clock.now_us()
        if self.way is None:
            return
        with Live(console=self._screen, transient=True, auto_refresh=False, vertical_overflow="crop") as live:
            while length_us is None or self._clock.now_us() < begun + length_us:
                self._clock.sleep_until(self._clock.now_us() + ears.LOOK_US)
                data = self._ear.receive()
                self.hear(self._cutter.take(self._clock.now_us(), data))
                if self._screen.is_terminal and self._clock.now_us() >= shown + SHOWN_US:
                    shown = self._clock.now_us()
                    live.update(Group(*overheard.tables(self.way, self.traffic)), refresh=True)

    def hear(self, frames: Iterator[Frame]) -> None:
        for frame in frames:
            said = self.traffic.hear(frame)
            if self.way is not None and frame.good:
                self.way = replace(self.way, mode=mode_of(frame.data))
            self._log.write(overheard.line(said, self._now(frame.begin_us)))
            self._table.write(_row(overheard.row(said, self.traffic.begin_us)))

    def end(self) -> None:
        """The last frame, and the last line of the log: without it the log is that of a listening that was cut off."""
        rest = list(self._cutter.rest())
        self.hear(iter(rest if not rest or rest[-1].good else rest[:-1]))  # the last may only not be whole
        self._log.write(f"# {self._now(self._clock.now_us())} ended{f': {self.ended}' if self.ended else ''}\n")

    def _now(self, us: int) -> str:
        day, at = self._day
        return f"{day + datetime.timedelta(microseconds=us - at):%H:%M:%S.%f}"[:-3]
