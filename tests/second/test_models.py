"""The second models against the manuals: their example frames, and what a drive hears."""

from typing import Any

import pytest
from tests.second.frames import ascii_, rtu
from tests.second.kinds import KINDS, drive

EXAMPLES = [
    # SN300G5 lines 91 to 116, 122 to 149, 159 to 183, 828 to 840 (its reply is not printed)
    ("sn", {}, "", "01 03 00 26 00 02 25 C0", "01 03 04 02 4D 00 00 6B 9C"),
    ("sn", {}, "", "01 10 00 00 00 01 02 00 01 67 90", "01 10 00 00 00 01 01 C9"),
    ("sn", {}, "", "01 10 FF FD 00 01 02 00 00 BC B2", rtu(bytes.fromhex("01 10 FF FD 00 01")).hex()),
    ("sn", {}, "", "01 08 00 00 12 AB AD 14", "01 08 00 00 12 AB AD 14"),
    # JSCC lines 144 to 164, 168 to 212, 220 to 241, 247 to 285
    ("jscc", {}, "", "01 06 10 00 00 01 4C CA", "01 06 10 00 00 01 4C CA"),
    ("jscc", {"ascii": True}, "", ":010610000001E8", ":010610000001E8"),
    ("jscc", {}, "0106100101F4 010610000001", "01 03 20 00 00 01 8F CA", "01 03 02 01 F4 B8 53"),
    ("jscc", {"ascii": True}, "0106100101F4 010610000001", ":010320000001DB", ":01030201F405"),
    # GD200A pages 131 to 138, 144
    ("gd", {}, "010600041388", "01 03 00 04 00 02 85 CA", "01 03 04 13 88 00 00 7E 9D"),
    ("gd", {"unit": 2}, "", "02 06 00 04 13 88 C5 6E", "02 06 00 04 13 88 C5 6E"),
    ("gd", {}, "", "01 08 00 00 12 AB AD 14", "01 08 00 00 12 AB AD 14"),
    ("gd", {"unit": 2, "ascii": True}, "", ":021000040002041388003217", ":021000040002E8"),
    ("gd", {}, "", "01 06 00 01 00 03 98 0B", rtu(bytes.fromhex("01 86 04")).hex()),
    # ATV312 M pages 12 to 14; MX2 I585 pages 6-11 and 6-20
    ("atv", {"unit": 2}, "02060C1E0028 02060C1F0258 02060C2001F4", "02 03 0C 1E 00 04 27 6C",
     "02 03 08 00 28 02 58 01 F4 00 00 52 B0"),
    ("atv", {"unit": 2}, "", "02 06 23 29 00 0D 92 70", "02 06 23 29 00 0D 92 70"),
    ("atv", {"unit": 2}, "", rtu(bytes.fromhex("02 10 23 29 00 02 04 00 14 00 1E")).hex(),  # printed: wrong checksums
     rtu(bytes.fromhex("02 10 23 29 00 02")).hex()),
    ("mx", {}, "", "01 05 00 00 FF 00 8C 3A", "01 05 00 00 FF 00 8C 3A"),
    ("mx", {"unit": 8}, "", "08 06 08 FF 00 01 7A C3", "08 06 08 FF 00 01 7A C3"),
    # CHF lines 110 to 135 (the CRC is that of a byte count of two bytes), 137 to 177, 183 to 247, 366 to 395
    ("chf", {"two_byte_count": True}, "", "01 03 00 04 00 02 85 CA", "01 03 00 04 00 00 00 00 43 07"),
    ("chf", {"ascii": True}, "010600040002", ":010300040002F6", ":01030400020000F6"),
    ("chf", {"unit": 2}, "", "02 06 00 08 13 88 05 6D", "02 06 00 08 13 88 05 6D"),
    ("chf", {"unit": 2, "ascii": True}, "", ":02060008138855", ":02060008138855"),
    ("chf", {}, "", "01 06 20 00 40 00 B3 CA", "01 06 50 01 00 05 09 09"),
    ("chf", {"ascii": True}, "", ":01062000400099", ":010650010005A3"),
]  # fmt: skip


@pytest.mark.parametrize(("kind", "given", "before", "request_", "reply"), EXAMPLES)
def test_the_manuals_own_frames(kind: str, given: dict[str, Any], before: str, request_: str, reply: str) -> None:
    one, now = drive(kind, **given), 1_000_000
    for body in map(bytes.fromhex, before.split()):
        one.receive(ascii_(body) if one.o.ascii else rtu(body), now)
        now += 5_000_000
    sent, expected = (text.encode() + b"\r\n" if text[0] == ":" else bytes.fromhex(text) for text in (request_, reply))
    assert one.receive(sent, now) == [(now + one.o.reply_us[0], expected)]


def test_a_frame_needs_its_silence() -> None:
    # 8 characters of 573 us; JSCC asks for 10 ms, the others for 3.5 characters
    frame = rtu(bytes.fromhex("02 03 20 01 00 01"))  # to another unit
    for kind, quiet in (("sn", 2005), ("chf", 2005), ("gd", 2005), ("pf", 2005), ("jscc", 10_000)):
        for wait, heard in ((quiet - 1, False), (quiet, True)):
            one = drive(kind, reply_us=(1000, 1000))
            one.receive(frame, 0)
            at = wait + 8 * 573
            mine = rtu(bytes.fromhex("01 03 20 01 00 01" if kind != "sn" else "01 03 00 10 00 01"))
            assert [at for at, _ in one.receive(mine, at)] == [at + 1000] * heard
            assert one.unheard == (not heard)
    # a slower line has longer characters
    assert not drive("chf", char_us=2000).receive(frame, 0)


def test_a_late_reply_and_what_is_asked_meanwhile() -> None:
    read, stop = (rtu(bytes.fromhex(text)) for text in ("01 03 10 01 00 01", "01 06 10 00 00 05"))
    one, other = (drive("chf", late_per_1000=1000, late_us=300_000) for _ in range(2))
    assert [at for at, _ in one.receive(read, 100_000)] == [at for at, _ in other.receive(read, 100_000)] == [405_000]
    assert other.receive(stop, 200_000)
    # while it sends it hears nothing
    assert one.receive(stop, 407_000) == []
    assert one.receive(stop, 450_000)


def test_a_damaged_frame_is_not_answered() -> None:
    damaged = rtu(bytes.fromhex("01 06 10 00 00 01"))[:-1] + b"\0"
    for kind in KINDS:
        assert drive(kind).receive(damaged, 100_000) == []


def test_others_frames_and_broadcasts_get_no_reply() -> None:
    one = drive("chf", unit=3)
    for unit in (0, 1, 2, 4):
        assert one.receive(rtu(bytes([unit, 6, 0x10, 0, 0, 1])), 100_000 * (unit + 1)) == []
    assert one.commanded == "run_forward"


PATHS = [
    # the start of H page 165, with half of REF1 in reverse; OFF1; OFF3, after which it is inhibited; no 0006H before
    ("acs355", "0001D8F0 00000006 00000007 0000000F 0000002F 0000006F", 3, 0x1337, -25.0),
    ("acs355", "0001D8F0 00000006 00000007 0000000F 0000002F 0000006F 0000006E", 3, 0x1231, 0.0),
    ("acs355", "0001D8F0 00000006 00000007 0000000F 0000002F 0000006F 0000006B 0000006F", 3, 0x1270, 0.0),
    ("acs355", "0001D8F0 00000007 0000000F 0000006F", 3, 0x1270, 0.0),
    # G pages 194 to 199: ON is a rising edge after 047EH; without bit 10 the word is ignored; bit 11 turns it round
    ("v20", "00642000 0063047E 0063047F", 0x6D, 0xEB37, 25.0),
    ("v20", "00642000 0063047E 0063047F 00630000", 0x6D, 0xEB37, 25.0),
    ("v20", "00642000 00630C7E 00630C7F", 0x6D, 0xAB37, -25.0),
    ("v20", "00642000 0063047E 0063047F 0063047E", 0x6D, 0xEA31, 0.0),
    ("v20", "00642000 0063047F", 0x6D, 0xEA70, 0.0),
]


@pytest.mark.parametrize(("kind", "words", "status", "shown", "hz"), PATHS)
def test_a_control_word_leads_through_its_chart(kind: str, words: str, status: int, shown: int, hz: float) -> None:
    one, now = drive(kind, comm_us=None, ready_us=100_000 * (kind == "acs355")), 1_000_000
    for body in (bytes.fromhex(f"0106{each}") for each in words.split()):
        assert [text for _, text in one.receive(rtu(body), now)] == [rtu(body)]
        now += 10_000_000 if body[5] in (0x6F, 0x7F, 0x6E, 0x6B) else 200_000
    assert one.shaft_hz(now + 10_000_000) == hz
    ((_, reply),) = one.receive(rtu(bytes((1, 3, 0, status, 0, 1))), now + 10_000_000)
    assert int.from_bytes(reply[3:5], "big") == shown


def test_process_data_alone_feed_a_v20() -> None:
    # V page 115: F72 after P2014, once process data have come, and not by reads
    for words, reads, tripped in (("", True, False), ("0063047E", True, True), ("0063047E", False, True)):
        one = drive("v20", comm_us=2_000_000)
        for body in (bytes.fromhex(f"0106{each}") for each in words.split()):
            one.receive(rtu(body), 1_000_000)
        for at in range(1_500_000, 3_500_000, 500_000) if reads else ():
            one.receive(rtu(bytes.fromhex("0103006D0001")), at)
        one.advance(3_500_000)
        assert one.fault == (72 if tripped else None)
