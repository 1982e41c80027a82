"""`driveblocks listen`: a line that others speak on, heard and never spoken on."""

import datetime
import signal
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import TextIO

from rich.console import Group
from rich.live import Live

from driveblocks import console
from driveblocks.desk.clock import Clock, RealClock
from driveblocks.desk.port import Tap, reason
from driveblocks.explain import page
from driveblocks.explain.guess import shown
from driveblocks.maps import catalog
from driveblocks.maps.load import load
from driveblocks.maps.model import Drive
from driveblocks.maps.problem import MapError
from driveblocks.modbus.envelope import open_
from driveblocks.plc.drives import named, words
from driveblocks.plc.options import Refused
from driveblocks.plc.options import time as microseconds
from driveblocks.site import adapter, spoken
from driveblocks.site.findings import Findings
from driveblocks.site.found import Way
from driveblocks.site.overheard import Caught, Ear
from driveblocks.site.tuning import LOOK_US, Chunk, Search, framings, ways

DRAW_US, KEEP_US = 500_000, 5_000_000
LONGEST_US = 30 * 86_400_000_000
NAMES = {"SIGINT": "Ctrl-C", "SIGHUP": "the terminal is gone", "SIGTERM": "SIGTERM", "SIGBREAK": "Ctrl-Break"}


@dataclass(frozen=True, kw_only=True)
class Words:
    """The words of the command line."""

    maps: tuple[str, ...] = ()
    port: str | None = None
    tcp: str | None = None
    rate: int | None = None
    form: str | None = None
    mode: str | None = None
    length: str | None = None
    log: Path | None = None
    csv: Path | None = None
    json: bool = False

    def wrong(self) -> Iterator[str]:
        """What does not go together."""
        yield from adapter.wrong(self.port, self.tcp, self.rate, self.form, who="the line")
        try:
            self.length_us()
        except Refused as refused:
            yield str(refused)
        for option, path in (("--log", self.log), ("--csv", self.csv)):
            if path is not None and path.exists():
                yield f"{option} {path} is there already; name another file"

    def length_us(self) -> int:
        """How long it listens after rate and format are known. Raises Refused."""
        return LONGEST_US if self.length is None else microseconds("--for", self.length, 1_000_000, LONGEST_US)


@dataclass
class Heard:
    """What came of it."""

    way: Way | None = None
    findings: Findings | None = None
    ended: str = ""
    """Why it ended."""
    failed: list[str] = field(default_factory=list)
    """What did not work."""


class Log:
    """A file with a line per frame, each written whole; lines that begin with # are about the log."""

    def __init__(self, path: Path, where: str) -> None:
        """A new file. Raises OSError."""
        self._file: TextIO | None = path.open("x", encoding="utf-8")
        self._path, self._begun = path, time.time() - time.monotonic()
        self.wrong = ""
        self.note(f"driveblocks listen {where}, {datetime.datetime.now():%Y-%m-%d %H:%M:%S}")

    def add(self, one: Caught, mark: str) -> None:
        """A frame: time, `>` for a request or `<` for a reply where that is known, bytes as `explain` reads them."""
        at = datetime.datetime.fromtimestamp(self._begun + one.at_us / 1e6)
        text = page.written(open_(one.data))
        text = text if text.isascii() and text.isprintable() and not text.endswith("...") else shown(one.data)
        self._write(f"{at:%H:%M:%S}.{at.microsecond // 1000:03} {mark}{' ' if mark else ''}{text}\n")

    def note(self, text: str) -> None:
        """A line about the log itself."""
        self._write(f"# {text}\n")

    def close(self) -> None:
        """No more lines."""
        if self._file is not None:
            self._file.close()

    def _write(self, line: str) -> None:
        if self._file is None or self.wrong:
            return
        try:
            self._file.write(line)
            self._file.flush()
        except OSError as error:
            self.wrong = f"{self._path} ends early: {reason(error)}"


@dataclass
class Desk:
    """Where a line is heard: its port, the time, what a person sees, and the files."""

    words: Words
    tap: Tap
    clock: Clock
    drives: dict[int, Drive]
    other: Drive | None
    over: Callable[[], str]
    """Why it is to end; empty while it goes on."""
    show: Callable[[Findings | str, Way | None], None]
    log: Log | None = None

    def hear(self) -> Heard:
        """Find the rate and format, then take every frame until the end."""
        heard, words_ = Heard(), self.words
        known = [*self.drives.values(), *([self.other] if self.other else [])]
        form = words_.form.upper() if words_.form else None
        fixed = (words_.rate or 9600, form or "8N1") if words_.tcp else (words_.rate, form)
        every = ways(known, *fixed)
        chunks: list[Chunk] = []
        search = Search(self.tap, self.clock, lambda: bool(self.over()), lambda text: self.show(text, None))
        try:
            if len(every) == 1 and words_.mode is not None:
                heard.way = framings(every[0], words_.mode)[0]
                if not self.tap.tune(heard.way.rate, heard.way.form):
                    heard.failed.append(f"the port refuses {heard.way}")
                    return heard
            else:
                heard.way, chunks = search.find(every, words_.mode)
            if heard.way is None:
                heard.failed.append(_nothing(search.bytes, len(every)))
            else:
                heard.findings = Findings(self.drives, self.other)
                self._listen(heard.way, heard.findings, chunks)
            heard.ended = self.over()
        except OSError as error:
            heard.ended = f"the port does not work any more: {reason(error)}"
            heard.failed.append(heard.ended)
        finally:
            self._end(heard)
        return heard

    def _listen(self, way: Way, found: Findings, chunks: list[Chunk]) -> None:
        """Until it is over. Raises OSError."""
        self._note(f"{way}")
        ear = Ear(way.mode, way.character_us)
        for at, data in chunks:
            self._take(found, ear.take(at, data))
        end = self.clock.now_us() + self.words.length_us()
        drawn = kept = 0
        try:
            while (now := self.clock.now_us()) < end and not self.over():
                self._take(found, ear.take(now, self.tap.receive()))
                if now >= drawn + DRAW_US:
                    drawn = now
                    self.show(found, way)
                if now >= kept + KEEP_US:
                    kept = now
                    self._keep(found)
                self.clock.sleep_until(now + LOOK_US)
        finally:
            self._take(found, (one for one in ear.end() if one.body is not None))  # the rest is only not whole yet
            found.finish()

    def _take(self, found: Findings, caught: Iterator[Caught]) -> None:
        for one in caught:
            mark = found.take(one)
            if self.log is not None:
                self.log.add(one, mark)

    def _note(self, text: str) -> None:
        if self.log is not None:
            self.log.note(text)

    def _keep(self, found: Findings) -> str:
        """Put the table in its file, in one step; what is wrong."""
        path = self.words.csv
        if path is None:
            return ""
        part = path.with_name(f".{path.name}.part")
        try:
            part.write_text(spoken.rows(found), encoding="utf-8")
            part.replace(path)
        except OSError as error:
            return f"{path} is not written: {reason(error)}"
        finally:
            with suppress(OSError):
                part.unlink(missing_ok=True)
        return ""

    def _end(self, heard: Heard) -> None:
        """Both files say how far they came."""
        found = heard.findings
        many = f"{found.good} good frames, {found.damaged} damaged" if found else "no frame"
        self._note(f"ended, {heard.ended or 'its time is over'}: {many}")
        wrong = [self._keep(found) if found else "", self.log.wrong if self.log is not None else ""]
        heard.failed += [each for each in wrong if each]
        if self.log is not None:
            self.log.close()


def _nothing(many: int, tried: int) -> str:
    if not many:
        return "no byte came: nobody speaks, or the wires are not on the line"
    heard = f"{many} bytes came, and in none of {tried} rates and formats did they make frames"
    return f"{heard}: another rate, A and B swapped, no common wire, or no Modbus; it could not be found out"


def run(chosen: Words) -> Heard:
    """Listen at a real port. Raises Refused."""
    wrong, drives, other = list(chosen.wrong()), dict[int, Drive](), None
    try:
        drives, other = _maps(chosen.maps)
    except Refused as refused:
        wrong.append(str(refused))
    if wrong:
        raise Refused("\n".join(wrong))
    where, clock = chosen.port or chosen.tcp or "", RealClock()
    try:
        tap = adapter.tap(chosen.port, chosen.tcp, Way(chosen.rate or 9600, (chosen.form or "8N1").upper()))
    except ImportError as error:
        raise Refused(f"--port needs pyserial, which does not run here: {error}") from None
    except (OSError, ValueError, OverflowError) as error:
        raise Refused(f"{where}: {reason(error)}") from None
    try:
        log = Log(chosen.log, where) if chosen.log is not None else None
    except OSError as error:
        tap.close()
        raise Refused(f"{chosen.log}: {reason(error)}") from None
    try:
        with _signals() as over, _screen(quiet=chosen.json) as show:
            return Desk(chosen, tap, clock, drives, other, over, show, log).hear()
    finally:
        tap.close()


def _maps(given: tuple[str, ...]) -> tuple[dict[int, Drive], Drive | None]:
    """Maps by unit address, and that of all other units. Raises Refused."""

    def read(name: str) -> tuple[Path, Drive]:
        path = catalog.resolve(name)
        return path, load(path)

    every = words(list(given))
    try:
        drives = {each.unit: each.drive for each in named([one for one in every if one.unit], read)}
        rest = [read(one.name)[1] for one in every if not one.unit]
    except (catalog.UnknownDrive, MapError) as error:
        raise Refused(str(error)) from None
    if len(rest) > 1:
        raise Refused("two maps without a unit: write which unit each is for, as chf@1 jscc@2")
    return drives, rest[0] if rest else None


@contextmanager
def _signals() -> Iterator[Callable[[], str]]:
    """Signals end it between two frames, and never within one."""
    got: list[str] = []
    numbers = {getattr(signal, name): name for name in NAMES if hasattr(signal, name)}
    if threading.current_thread() is not threading.main_thread():
        numbers = {}  # only the main thread gets signals
    before = {each: signal.signal(each, lambda number, _: got.append(NAMES[numbers[number]])) for each in numbers}
    try:
        yield lambda: got[0] if got else ""
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


@contextmanager
def _screen(*, quiet: bool) -> Iterator[Callable[[Findings | str, Way | None], None]]:
    """A table on a terminal, drawn anew in its place; nothing elsewhere."""
    terminal = console.terminal()
    if quiet or not terminal.is_terminal:
        yield lambda _found, _way: None
        return
    with Live(console=terminal, auto_refresh=False, transient=True) as live:

        def show(found: Findings | str, way: Way | None) -> None:
            if isinstance(found, str) or way is None:
                live.update(str(found), refresh=True)
            else:
                live.update(Group(*spoken.tables(found, way, brief=True)), refresh=True)

        with suppress(OSError):
            yield show
