"""Simulated drives on a line behind a TCP port of this computer, in a process of their own.

    python -m driveblocks.plc.simulated '{"drives": [...], "rate": 19200, "bits": 11, "ascii": false}'

It prints the number of its port, serves one connection after the other, and ends when its standard input does.
"""

import json
import os
import select
import signal
import socket
import subprocess
import sys
import threading
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from driveblocks.host.embedded.certainty import present
from driveblocks.maps.load import load
from driveblocks.plc.clock import RealClock
from driveblocks.plc.wanted import Wanted
from driveblocks.plc.wire import Wire

HOST = "127.0.0.1"
LOOK_S = 0.001


class Simulation:
    """The process, from the side of the one who starts it."""

    def __init__(self, drives: Sequence[Wanted], rate: int, bits: int, *, ascii_mode: bool) -> None:
        """Start it and wait until it listens. Raises OSError."""
        words = json.dumps({"drives": rows(drives), "rate": rate, "bits": bits, "ascii": ascii_mode})
        self._process = subprocess.Popen(
            [sys.executable, "-m", "driveblocks.plc.simulated", words],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        line = present(self._process.stdout).readline()
        if not line.strip().isdigit():
            raise OSError("the simulated drives did not start")
        self.port = int(line)

    def close(self) -> None:
        """End it."""
        self._process.communicate()


def rows(drives: Sequence[Wanted]) -> list[list[Any]]:
    """Drives as JSON can say them."""
    return [[str(one.path.resolve()), one.unit, one.maximum_hz, one.scales] for one in drives]


def wanted(rows: Sequence[Sequence[Any]]) -> list[Wanted]:
    """The drives of such rows. Raises MapError."""
    return [
        Wanted(Path(path), load(Path(path)), unit, hz, tuple((name, number) for name, number in scales))
        for path, unit, hz, scales in rows
    ]


def main(words: str) -> None:
    """Serve."""
    for name in ("SIGINT", "SIGHUP"):  # meant for the one who started this, who still has drives to stop
        if hasattr(signal, name):
            signal.signal(getattr(signal, name), signal.SIG_IGN)
    threading.Thread(target=_end_with_input, daemon=True).start()
    given = json.loads(words)
    drives = [one.made(ascii_mode=given["ascii"]) for one in wanted(given["drives"])]
    wire = Wire(drives, given["rate"], given["bits"], ascii_mode=given["ascii"])
    with socket.create_server((HOST, 0)) as server:
        print(server.getsockname()[1], flush=True)
        begun = RealClock().now_us()
        while True:
            connection, _ = server.accept()
            with connection:
                _serve(connection, wire, begun)


def _serve(connection: socket.socket, wire: Wire, begun: int) -> None:
    connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    clock = RealClock()
    try:
        while True:
            ready, _, _ = select.select([connection], [], [], LOOK_S if wire.speaking else None)
            if ready:
                data = connection.recv(4096)
                if not data:
                    return
                wire.send(data, clock.now_us() - begun)
            heard = wire.receive(clock.now_us() - begun) if wire.speaking else b""
            if heard:
                connection.sendall(heard)
    except OSError:
        return


def _end_with_input() -> None:
    sys.stdin.read()
    os._exit(0)


if __name__ == "__main__":
    main(sys.argv[1])
