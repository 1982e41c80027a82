"""pymodbus's client as the master, RTU and ASCII, over TCP and a pseudo-terminal: the frames that the manuals print."""

import os
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import pytest
from pymodbus import FramerType
from pymodbus.client import ModbusSerialClient, ModbusTcpClient
from tests.simulator.talk import body, pairs, prepared

from driveblocks.desk.bus import Bus
from driveblocks.desk.clock import RealClock
from driveblocks.desk.ending import Ending
from driveblocks.desk.port import Port
from driveblocks.desk.simulate.link import PtyLink, TcpLink
from driveblocks.desk.simulate.setup import Stand

MODES = {"rtu": FramerType.RTU, "ascii": FramerType.ASCII}
LINKS = [
    "tcp",
    pytest.param("pty", marks=pytest.mark.skipif(not hasattr(os, "openpty"), reason="no pseudo-terminals here")),
]


@contextmanager
def serving(bus: Bus, link: Port) -> Iterator[None]:
    """Serve in a thread of its own."""
    ending = Ending()
    stand = Stand(bus, link, RealClock(), ending)
    thread = threading.Thread(target=stand.run, args=(lambda _: None, lambda _: None))
    thread.start()
    try:
        yield
    finally:
        ending.ask("enough")
        thread.join()
        link.close()


def client(link: TcpLink | PtyLink, mode: str, trace: Callable[[bool, bytes], bytes]) -> Any:
    """A client that shows its bytes."""
    if isinstance(link, TcpLink):
        port = int(link.place.partition(":")[2])
        return ModbusTcpClient("127.0.0.1", port=port, framer=MODES[mode], trace_packet=trace, retries=0, timeout=9)
    return ModbusSerialClient(
        link.place, framer=MODES[mode], baudrate=115200, trace_packet=trace, retries=0, timeout=30
    )


def ask(master: Any, request: bytes) -> None:
    """Have the client make a request that is given as a body."""
    unit, function, first, number = request[0], request[1], request[2:4], int.from_bytes(request[4:6], "big")
    address = int.from_bytes(first, "big")
    if function == 3:
        master.read_holding_registers(address, count=number, device_id=unit)
    elif function == 6:
        master.write_register(address, number, device_id=unit)
    elif function == 16:
        words = [int.from_bytes(request[at : at + 2], "big") for at in range(7, len(request), 2)]
        master.write_registers(address, words, device_id=unit)
    else:
        assert (function, address) == (8, 0)
        master.diag_query_data(request[4:], device_id=unit)


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("where", LINKS)
def test_exchanges_are_those_that_the_manuals_print(where: str, mode: str) -> None:
    link = TcpLink(0) if where == "tcp" else PtyLink()
    bus = Bus([], 115200, 10, ascii_mode=mode == "ascii")
    sent, heard = bytearray(), bytearray()

    def trace(sending: bool, data: bytes) -> bytes:
        (sent if sending else heard)[:] = data  # what has come so far
        return data

    wanted = [each for each in pairs() if each[1].mode == mode]
    with serving(bus, link):
        master = client(link, mode, trace)
        assert master.connect()
        for prefix, request, reply in wanted:
            sent.clear()
            heard.clear()
            drive = prepared(prefix, request, reply)
            bus.drives = [*bus.drives, drive]
            ask(master, body(request))
            bus.drives = []
            assert (bytes(sent), bytes(heard)) == (request.correct, reply.correct), request.id
        master.close()
    assert len(wanted) >= 2
    assert sum(each.replied for each in bus.counts.values()) >= 1
