"""Simulated drives on a line behind a TCP port of this computer, in a process of their own.

    python -P -m driveblocks.desk.run.simulated '{"drives": [...], "rate": 19200, "bits": 11, "ascii": false}'

It prints the number of its port, serves one master at a time, lets happen what its standard input says in
lines, such as `trip OC 2`, and ends when that does. `-P`: no module of the folder where it is started takes part.
"""

import json
import os
import queue
import select
import signal
import subprocess
import sys
import threading
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from driveblocks.desk.bus import Bus
from driveblocks.desk.clock import RealClock
from driveblocks.desk.run.drives import Named
from driveblocks.desk.scenario import Act, Happening, said
from driveblocks.desk.simulate.link import TcpLink
from driveblocks.maps.load import load
from driveblocks.maps.model import Drive
from structured_text.engines.embedded.certainty import present

LOOK_S, IDLE_S = 0.001, 0.05
Acts = queue.SimpleQueue[Act]


class Simulation:
    """The process, from the side of the one who starts it."""

    def __init__(self, drives: Sequence[Named], rate: int, bits: int, *, ascii_mode: bool) -> None:
        """Start it and wait until it listens. Raises OSError."""
        words = json.dumps({"drives": rows(drives), "rate": rate, "bits": bits, "ascii": ascii_mode})
        self._process = subprocess.Popen(
            [sys.executable, "-P", "-m", "driveblocks.desk.run.simulated", words],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        line = present(self._process.stdout).readline()
        if not line.strip().isdigit():
            raise OSError("the simulated drives did not start")
        self.port = int(line)

    def happen(self, happening: Happening) -> None:
        """Let something happen to its drives. Raises OSError."""
        said = present(self._process.stdin)
        said.write(f"{happening.says}\n")
        said.flush()

    def close(self) -> None:
        self._process.communicate()


def rows(drives: Sequence[Named]) -> list[list[Any]]:
    """Drives as JSON can say them."""
    return [[str(one.path.resolve()), one.unit, one.maximum_hz, one.scales] for one in drives]


def named(rows: Sequence[Sequence[Any]]) -> list[Named]:
    """The drives of such rows. Raises MapError."""
    return [
        Named(Path(path), load(Path(path)), unit, hz, tuple((name, number) for name, number in scales))
        for path, unit, hz, scales in rows
    ]


def main(words: str) -> None:
    for name in ("SIGINT", "SIGHUP"):  # meant for the one who started this, who still has drives to stop
        if hasattr(signal, name):
            signal.signal(getattr(signal, name), signal.SIG_IGN)
    given = json.loads(words)
    units = named(given["drives"])
    drives = [one.made(ascii_mode=given["ascii"]) for one in units]
    bus, now_us, acts = Bus(drives, given["rate"], given["bits"], ascii_mode=given["ascii"]), RealClock().now_us, Acts()
    threading.Thread(target=_listen, args=(acts, {one.unit: one.drive for one in units}), daemon=True).start()
    link = TcpLink(0)
    print(link.place.rpartition(":")[2], flush=True)
    while True:
        select.select(link.sockets, [], [], LOOK_S if bus.speaking else IDLE_S)
        while not acts.empty():
            bus.happen(acts.get(), now_us())
        if data := link.receive():
            bus.send(data, now_us())
        if bus.speaking and (heard := bus.receive(now_us())):
            link.send(heard)


def _listen(acts: Acts, drives: Mapping[int, Drive]) -> None:
    """Let happen what is said; what ends later is said then."""
    for text in sys.stdin:
        for happening in said(text.strip(), drives):
            if not happening.at_us:
                acts.put(happening.act)
    os._exit(0)


if __name__ == "__main__":
    main(sys.argv[1])
