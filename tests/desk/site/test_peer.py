"""pymodbus's server as the drive that is commissioned, over TCP and a pseudo-terminal: it is found by reads alone."""

import asyncio
import os
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from pymodbus import FramerType
from pymodbus.pdu import ModbusPDU
from pymodbus.server import ModbusSerialServer, ModbusTcpServer
from pymodbus.simulator import DataType, SimData, SimDevice
from tests.desk.site.test_commission import MAPS, quickly
from tests.desk.site.test_parameters import parameters

from driveblocks.desk.site import hour, kept, saved
from driveblocks.desk.site.register import rows
from driveblocks.maps.form import SPACES, Span, is_bit
from driveblocks.maps.plan import plan

UNIT = 5
FUNCTIONS: list[int] = []
"""Of the requests that the server has understood."""
READS = {1, 3, 17, 43}
"""Functions that change nothing."""

Carried = Callable[[bool, bytes], bytes]
"""What becomes of bytes on a cable, of the master (True) or the server."""
Blocks = tuple[list[SimData], list[SimData], list[SimData], list[SimData]]
"""Coils, discrete inputs, holding and input registers: in one memory each register would answer as 16 coils, too."""


def words(stem: str, *, everything: bool) -> Blocks:
    """The registers that a map lists as readable, or each that there is; those with listed values have one of them."""
    known = {row.address.first: row.values[0].value for _, row in MAPS[stem].registers() if row.values}
    identity = MAPS[stem].identity
    known |= {one.register: one.equals or 0 for one in identity.all if one.register is not None} if identity else {}
    found: Blocks = ([], [], [], [])
    spans = [Span(first, first + 0xFFFF) for first in (0, SPACES["coil"])] if everything else plan(MAPS[stem]).readable
    for span in spans:
        some = [known.get(each, 0) for each in span]
        block, kind = (found[0], DataType.BITS) if is_bit(span.first) else (found[2], DataType.REGISTERS)
        values = list[Any](map(bool, some) if kind == DataType.BITS else some)
        block.append(SimData(span.first % 0x10000, values=values, datatype=kind))
    for block, kind in zip(found, (DataType.BITS, DataType.BITS, DataType.REGISTERS, DataType.REGISTERS), strict=True):
        if not block:  # pymodbus wants one
            block.append(SimData(0xFFFF, values=[0] if kind == DataType.REGISTERS else [False], datatype=kind))
    return found


def noted(sending: bool, pdu: ModbusPDU) -> ModbusPDU:
    """Keep the function of a request."""
    if not sending:
        FUNCTIONS.append(pdu.function_code)
    return pdu


@contextmanager
def peer(where: str, device: SimDevice, carried: Carried = lambda _, data: data) -> Iterator[str]:
    """A server in a thread of its own, perhaps at the end of a cable; its place."""
    begun, place = threading.Event(), [""]
    loop, over = asyncio.new_event_loop(), asyncio.Event()

    async def serve() -> None:
        if where == "tcp":
            server: Any = ModbusTcpServer(
                device, framer=FramerType.RTU, address=("127.0.0.1", 0), trace_pdu=noted, ignore_missing_devices=True
            )
            await server.serve_forever(background=True)
            place[0] = f"127.0.0.1:{server.transport.sockets[0].getsockname()[1]}"
        else:
            place[0], other = _cable(loop, carried)
            server = ModbusSerialServer(device, port=other, baudrate=9600, trace_pdu=noted, ignore_missing_devices=True)
            await server.serve_forever(background=True)
        begun.set()
        await over.wait()
        await server.shutdown()

    thread = threading.Thread(target=loop.run_until_complete, args=(serve(),))
    thread.start()
    assert begun.wait(30)
    try:
        yield place[0]
    finally:
        loop.call_soon_threadsafe(over.set)
        thread.join()
        loop.close()


def _cable(loop: asyncio.AbstractEventLoop, carried: Carried) -> tuple[str, str]:
    """Two terminals, each of which gives what is said at the other."""
    import tty

    (one, here), (two, there) = (os.openpty() for _ in range(2))
    for each in (here, there):
        tty.setraw(each)
    for said, heard in ((one, two), (two, one)):
        loop.add_reader(
            said, lambda said, heard: os.write(heard, carried(said == one, os.read(said, 4096))), said, heard
        )
    return os.ttyname(here), os.ttyname(there)


@pytest.fixture(autouse=True)
def _none_yet() -> None:
    FUNCTIONS.clear()


def commissioned(stem: str, folder: Path, **words: Any) -> kept.Kept:
    """What is kept of a server where a person types the word, and nothing else."""
    typed, path = iter(["alone"]), folder / "site.yaml"
    made = hour.Words(map=stem, unit=UNIT, mode="rtu", label="Pump", file=path, **words)
    assert hour.run(made, lambda _: next(typed, ""), quickly).ended == ""
    return kept.read(path)["Pump"]


@pytest.mark.parametrize(
    ("stem", "where"),
    [
        *(pytest.param(stem, "tcp", marks=() if stem == "invt_chf" else pytest.mark.thorough) for stem in MAPS),
        pytest.param(
            "jscc", "pty", marks=pytest.mark.skipif(sys.platform == "win32", reason="Windows has no pseudo-terminals")
        ),
    ],
)
def test_a_server_with_the_registers_of_a_map_is_found_and_measured(stem: str, where: str, tmp_path: Path) -> None:
    with peer(where, SimDevice(UNIT, words(stem, everything=False))) as place:
        one = commissioned(stem, tmp_path, **{"tcp" if where == "tcp" else "port": place})
    right = "identity" if MAPS[stem].identity else "fits"
    assert (one.family, one.ended, one.line.unit, one.faults) == (right, None, UNIT, ())
    assert one.measured is not None
    assert one.measured.unlisted.endswith(": refused")
    assert set(FUNCTIONS) <= READS


@pytest.mark.parametrize("stem", MAPS)
@pytest.mark.thorough
def test_a_server_that_answers_every_address_is_of_a_family_by_its_identity_alone(stem: str, tmp_path: Path) -> None:
    with peer("tcp", SimDevice(UNIT, words(stem, everything=True))) as place:
        wanted = "identity" if MAPS[stem].identity else "unknown"
        assert commissioned(stem, tmp_path, tcp=place, skip=["measure"]).family == wanted
    assert set(FUNCTIONS) <= READS


def test_the_parameters_of_a_server_are_saved_continued_and_compared(tmp_path: Path) -> None:
    path, name = tmp_path / "pump.csv", f"jscc@{UNIT}"
    with peer("tcp", SimDevice(UNIT, words("jscc", everything=False))) as place:
        ways = "--tcp", place
        done = parameters("save", name, str(path), *ways)
        assert (done.exit_code, done.stderr) == (0, ""), done.stdout
        assert parameters("save", name, str(path), *ways).stderr == f"{path} is complete; name another file\n"
        same = parameters("compare", str(path), name, *ways)
        assert (same.exit_code, same.stderr) == (0, ""), same.stdout
        whole = saved.read(path).words
        begun: dict[int, saved.Word] = dict([*whole.items()][:100])
        first = next(row.address for row in rows(MAPS["jscc"]) if row.set)
        saved.write(path, "jscc", MAPS["jscc"], UNIT, begun | {first: 12345})
        path.write_text(path.read_text(encoding="utf-8") + "# pump 1 of hall 2\n", encoding="utf-8")
        before = path.read_bytes()
        other = parameters("save", name, str(path), *ways)
        assert (other.exit_code, "is of another drive, or it was changed since: " in other.stderr) == (2, True)
        assert path.read_bytes() == before
        path.write_text(before.decode().replace(",12345,", f",{whole[first]},"), encoding="utf-8")
        assert parameters("save", name, str(path), *ways).exit_code == 0
    assert saved.read(path).words == whole
    assert "# pump 1 of hall 2" in path.read_text(encoding="utf-8").splitlines()
    assert set(FUNCTIONS) <= READS
