"""The block with the mailbox inside: bytes in, bytes out."""

from functools import cache

import pytest
from tests.line.vline import line_sources

from driveblocks.reference.checksum import crc16
from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.embedded.library import EmbeddedLibrary
from structured_text.engines.engine import Instance


@cache
def built() -> EmbeddedLibrary:
    return EmbeddedEngine(coverage=True).build(line_sources())


@pytest.mark.parametrize("slots", [8, 32])
def test_a_poll_is_sent_and_answered(slots: int) -> None:
    """A drive that answers in the next scan."""
    bus = built().instance(f"MB_ByteLine{slots}")
    for pin, value in (("BitRate", 19200), ("CharacterBits", 11), ("MaxScanMs", 20)):
        bus[pin] = value
    bus["Slots[3].UnitAddress"], bus["Slots[3].TurnRoundMs"], bus["Slots[3].LongestMs"] = 4, 20, 40
    for field, value in (("Number", 1), ("FunctionCode", 3), ("Quantity", 2), ("Address", 0x1234)):
        bus[f"Slots[3].Ask[3].{field}"] = value
    reply, asked = b"", set[bytes]()
    for number in range(60):
        bus["Slots[3].Alive"] = number % 256
        bus["ElapsedMs"], bus["RxCount"] = 10, len(reply)
        bus["RxChars"] = reply or b"\xff" * 256
        bus.scan()
        sent = frame(bus, "TxChars", "TxCount")
        asked |= {sent} if sent else set()
        reply = b"\x04\x03\x04\x11\x22\x33\x44" if sent else b""
        reply += crc16(reply).to_bytes(2, "little") if reply else b""
    assert asked == {b"\x04\x03\x12\x34\x00\x02" + crc16(b"\x04\x03\x12\x34\x00\x02").to_bytes(2, "little")}
    assert (bus["Slots[3].PollWords[0]"], bus["Slots[3].PollWords[1]"]) == (0x1122, 0x3344)
    assert bus["Good"] == bus["Slots[3].Good"] != 0
    assert bus["ErrorID"] == 0


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
