"""The block with the mailbox inside, as the page wires it: bytes in, bytes out."""

import re
from functools import cache
from pathlib import Path

import pytest
from tests.line.vline import line_sources

from driveblocks.host.embedded.engine import EmbeddedEngine
from driveblocks.host.embedded.library import EmbeddedLibrary
from driveblocks.host.engine import Instance, Source
from driveblocks.reference.checksum import crc16
from driveblocks.st.lint import lint_sources

PAGE = Path(__file__).parents[2] / "docs" / "line.md"
PROGRAM = re.findall(r"```\n(PROGRAM .*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)[0]
FILES = [*line_sources(), Source("page.st", PROGRAM)]


@cache
def built() -> EmbeddedLibrary:
    return EmbeddedEngine(coverage=True).build(FILES)


def test_the_program_on_the_page_is_clean() -> None:
    assert lint_sources((each.path, each.text) for each in FILES) == []


@pytest.mark.parametrize("slots", [8, 32])
def test_a_poll_goes_round(slots: int) -> None:
    """The page's program with a drive that answers in the next scan; 32 slots by the block alone."""
    bus = built().instance("Pumps" if slots == 8 else "MB_ByteLine32")
    path = "Bus." if slots == 8 else ""
    names = ("Elapsed", "Received", "Rx", "Tx") if slots == 8 else ("ElapsedMs", "RxCount", "RxChars", "TxChars")
    bus["Slots[3].UnitAddress"], bus["Slots[3].TurnRoundMs"], bus["Slots[3].LongestMs"] = 4, 20, 40
    for field, value in (("Number", 1), ("FunctionCode", 3), ("Quantity", 2), ("Address", 0x1234)):
        bus[f"Slots[3].Ask[3].{field}"] = value
    reply, asked = b"", set[bytes]()
    for number in range(60):
        bus["Slots[3].Alive"] = number % 256
        bus[names[0]], bus[names[1]] = 10, len(reply)
        bus[names[2]] = reply or b"\xff" * 256
        bus.scan()
        sent = frame(bus, names[3], path + "TxCount")
        asked |= {sent} if sent else set()
        reply = b"\x04\x03\x04\x11\x22\x33\x44" if sent else b""
        reply += crc16(reply).to_bytes(2, "little") if reply else b""
    assert asked == {b"\x04\x03\x12\x34\x00\x02" + crc16(b"\x04\x03\x12\x34\x00\x02").to_bytes(2, "little")}
    assert (bus["Slots[3].PollWords[0]"], bus["Slots[3].PollWords[1]"]) == (0x1122, 0x3344)
    assert bus[path + "Good"] == bus["Slots[3].Good"] != 0
    assert bus[path + "ErrorID"] == 0


def frame(bus: Instance, array: str, count: str) -> bytes:
    """What is to be sent in this scan."""
    value, length = bus[array], bus[count]
    assert isinstance(value, list)
    assert isinstance(length, int)
    return bytes(value[:length])  # type: ignore[arg-type]  # elements of an array of BYTE


def test_a_busy_port_takes_nothing_and_trouble_is_passed_on() -> None:
    bus = built().instance("MB_ByteLine8")
    bus["Slots[0].UnitAddress"], bus["Slots[0].Ask[0].FunctionCode"], bus["Slots[0].Ask[0].Number"] = 1, 6, 1
    bus["TxBusy"], bus["PortErrorID"], bus["ElapsedMs"] = True, 9, 10
    for _ in range(5):
        bus.scan()
        assert bus["TxCount"] == 0
    assert bus["ErrorID"] == 57
    bus["TxBusy"] = False
    bus.scan()
    assert bus["TxCount"] == 8


def test_every_line_of_it_has_run() -> None:
    test_a_poll_goes_round(8)
    test_a_poll_goes_round(32)
    test_a_busy_port_takes_nothing_and_trouble_is_passed_on()
    hits, outcomes = built().coverage(), built().branches()
    assert [line for line, count in hits["line/MB_ByteLine8.st"].items() if not count] == []
    assert [each for each, count in outcomes["line/MB_ByteLine8.st"].items() if not count] == []
