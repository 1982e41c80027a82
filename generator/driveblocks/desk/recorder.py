"""Keeps what scans have seen, in a thread of its own: a full pipe or a slow disk never makes a scan wait."""

import queue
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import chain, islice
from pathlib import Path

from driveblocks.desk import record
from driveblocks.desk.port import reason
from driveblocks.desk.record import Trace
from driveblocks.desk.run.picture import HEAD, Mark, Timing
from driveblocks.desk.words import spare
from structured_text import files
from structured_text.engines.engine import Value
from structured_text.visible import file_name

MOST_WAITING = 5_000
"""Scans that may wait to be written."""
LOOK_S = 0.05

Row = tuple[int, Mapping[str, Value]]
"""Microseconds since the start, and values."""


class Recorder:
    """Takes a row from each scan. Where the file does not keep up, rows are dropped and counted."""

    def __init__(self, name: str, keep: Callable[[Iterator[Row]], None], *, waits: bool = False) -> None:
        """`keep` writes rows, and may raise OSError; `waits`: a scan may wait, since its time is computed."""
        self._name = name
        self._rows: queue.Queue[Row] = queue.Queue(MOST_WAITING)
        self._waits = waits
        self._over = threading.Event()
        self._error = self._said = ""
        self._dropped = 0
        self._thread = threading.Thread(target=self._keep, args=(keep,), daemon=True)
        self._thread.start()

    def add(self, at_us: int, values: Mapping[str, Value]) -> None:
        try:
            self._rows.put((at_us, values), block=self._waits)
        except queue.Full:
            self._dropped += 1

    def news(self) -> str:
        """What has gone wrong since somebody asked; empty for nothing."""
        wrong = self._error or (f"{self._name}: rows are dropped, since nobody takes them" if self._dropped else "")
        news = "" if wrong == self._said else wrong
        self._said = wrong
        return news

    @property
    def failed(self) -> bool:
        return bool(self._error)

    def end(self) -> None:
        self._over.set()

    def finish(self, within_s: float) -> str:
        """Wait for the file; what is not in it, empty if all is."""
        self.end()
        self._thread.join(within_s)
        if self._thread.is_alive():
            lost = self._dropped + self._rows.qsize()
            return f"{self._name} is not whole, since nobody takes it: {lost} rows dropped"
        return self._error or (f"{self._name}: {self._dropped} rows dropped" if self._dropped else "")

    def _keep(self, keep: Callable[[Iterator[Row]], None]) -> None:
        try:
            keep(self._taken())
        except OSError as error:
            self._error = f"{self._name} cannot be written: {reason(error)}"
            for _ in self._taken():  # a scan that waits would wait for ever
                continue

    def _taken(self) -> Iterator[Row]:
        while True:
            over = self._over.is_set()
            try:
                yield self._rows.get(timeout=LOOK_S)
            except queue.Empty:
                if over:
                    return


def _unbuffered(path: Path) -> Callable[[str], object]:
    """Writes to an emptied file without a buffer, whose lock a thread that is stuck would keep to the very end."""
    file = files.opened(path)
    if path.is_file():
        file.truncate(0)
    return lambda text: file.add(text.encode("utf-8", "replace"))


def trace(path: Path, names: Sequence[str], port: str, *, waits: bool) -> Recorder:
    """A trace as CSV, which takes the place of the last one with its first row. Raises OSError."""
    pipe = _tried(path, record.TRACE)

    def keep(rows: Iterator[Row]) -> None:
        begun = [] if pipe else [*islice(rows, 1)]
        if pipe or begun:
            made = Trace(_unbuffered(path), names, port)
            for row in chain(begun, rows):
                made.add(*row)

    return Recorder(file_name(path), keep, waits=waits)


def picture(path: Path, made: Timing, marks: Sequence[Mark], *, waits: bool) -> Recorder:
    """A picture as SVG, with the marks that there are in the end. Raises OSError."""
    _tried(path, HEAD)

    def keep(rows: Iterator[Row]) -> None:
        for row in rows:
            made.add(*row)
        files.put(path, made.svg(marks))

    return Recorder(file_name(path), keep, waits=waits)


def _tried(path: Path, head: bytes) -> bool:
    """Whether it is a pipe, which opening would wait for. Raises OSError for a file that cannot be written."""
    spare(path, head, "no run")
    if not path.is_fifo():
        files.opened(path).close()
    return path.is_fifo()
