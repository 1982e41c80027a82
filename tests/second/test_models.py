"""The second models against the manuals: example frames, runs through every event, and both faces of each option."""

from dataclasses import fields
from itertools import chain
from typing import Any, get_args, get_type_hints

import pytest
from tests.second.drive import Options
from tests.second.frames import rtu
from tests.second.jscc import FAULTS
from tests.second.script import KINDS, Talk, drive
from tests.second.sn300g5 import MINOR_AT, SERIOUS_AT, Sn300g5


def talk(kind: str, **given: Any) -> Talk:
    """A conversation with a new drive."""
    return Talk(kind, drive(kind, **given))


EXAMPLES = [
    # SN300G5 lines 91 to 116, 122 to 149, 159 to 183, 828 to 840 (its reply is not printed)
    ("sn", {}, "", "01 03 00 26 00 02 25 C0", "01 03 04 02 4D 00 00 6B 9C"),
    ("sn", {}, "", "01 10 00 00 00 01 02 00 01 67 90", "01 10 00 00 00 01 01 C9"),
    ("sn", {}, "", "01 10 FF FD 00 01 02 00 00 BC B2", rtu(bytes.fromhex("01 10 FF FD 00 01")).hex()),
    ("sn", {}, "", "01 08 00 00 12 AB AD 14", "01 08 00 00 12 AB AD 14"),
    # JSCC lines 144 to 164, 168 to 212, 220 to 241, 247 to 285
    ("jscc", {}, "", "01 06 10 00 00 01 4C CA", "01 06 10 00 00 01 4C CA"),
    ("jscc", {"ascii": True}, "", ":010610000001E8", ":010610000001E8"),
    ("jscc", {}, "w1001=1F4 w1000=1 9s", "01 03 20 00 00 01 8F CA", "01 03 02 01 F4 B8 53"),
    ("jscc", {"ascii": True}, "w1001=1F4 w1000=1 9s", ":010320000001DB", ":01030201F405"),
    # GD200A pages 131 to 138, 144
    ("gd", {}, "w4=1388", "01 03 00 04 00 02 85 CA", "01 03 04 13 88 00 00 7E 9D"),
    ("gd", {"unit": 2}, "", "02 06 00 04 13 88 C5 6E", "02 06 00 04 13 88 C5 6E"),
    ("gd", {}, "", "01 08 00 00 12 AB AD 14", "01 08 00 00 12 AB AD 14"),
    ("gd", {"unit": 2, "ascii": True}, "", ":021000040002041388003217", ":021000040002E8"),
    ("gd", {}, "", "01 06 00 01 00 03 98 0B", rtu(bytes.fromhex("01 86 04")).hex()),
    # ATV312 M pages 12 to 14; MX2 I585 pages 6-11 and 6-20
    ("atv", {"unit": 2}, "wC1E=28 wC1F=258 wC20=1F4", "02 03 0C 1E 00 04 27 6C",
     "02 03 08 00 28 02 58 01 F4 00 00 52 B0"),
    ("atv", {"unit": 2}, "", "02 06 23 29 00 0D 92 70", "02 06 23 29 00 0D 92 70"),
    ("atv", {"unit": 2}, "", rtu(bytes.fromhex("02 10 23 29 00 02 04 00 14 00 1E")).hex(),  # printed: wrong checksums
     rtu(bytes.fromhex("02 10 23 29 00 02")).hex()),
    ("mx", {}, "", "01 05 00 00 FF 00 8C 3A", "01 05 00 00 FF 00 8C 3A"),
    ("mx", {"unit": 8}, "", "08 06 08 FF 00 01 7A C3", "08 06 08 FF 00 01 7A C3"),
    # CHF lines 110 to 135 (the CRC is that of a byte count of two bytes), 137 to 177, 183 to 247, 366 to 395
    ("chf", {"two_byte_count": True}, "", "01 03 00 04 00 02 85 CA", "01 03 00 04 00 00 00 00 43 07"),
    ("chf", {"ascii": True}, "w4=2", ":010300040002F6", ":01030400020000F6"),
    ("chf", {"unit": 2}, "", "02 06 00 08 13 88 05 6D", "02 06 00 08 13 88 05 6D"),
    ("chf", {"unit": 2, "ascii": True}, "", ":02060008138855", ":02060008138855"),
    ("chf", {}, "", "01 06 20 00 40 00 B3 CA", "01 06 50 01 00 05 09 09"),
    ("chf", {"ascii": True}, "", ":01062000400099", ":010650010005A3"),
]  # fmt: skip


@pytest.mark.parametrize(("kind", "given", "before", "request_", "reply"), EXAMPLES)
def test_the_manuals_own_frames(kind: str, given: dict[str, Any], before: str, request_: str, reply: str) -> None:
    one = talk(kind, **given)
    assert one.say(before) == ""
    sent, expected = (text.encode() + b"\r\n" if text[0] == ":" else bytes.fromhex(text) for text in (request_, reply))
    [(at, got)] = one.drive.receive(sent, one.now + 50_000)
    assert (at, got) == (one.now + 50_000 + one.drive.o.reply_us[0], expected)


RUNS: list[tuple[str, dict[str, Any], str, str]] = [
    # start, speed, reverse, stop
    ("sn", {},
     "where state go hz state 1s hz where poll2s where state w1=7D0 poll2s hz r20 back poll9s hz where halt 1s hz "
     "state where 9s where state",
     "22 0 standstill 0.1 starting 10.1 21 42b 31 9c4 at speed 20 7d0 -25 35 9c4 -14.9 ramping down 25 598 22 0 "
     "standstill"),
    ("jscc", {},
     "where go 1s hz where w1000=0 2s hz where back 9s hz where halt 1s hz where state 9s where state",
     "4 0 10.1 1 6b 25 1 fa -25 2 fa -14.9 2 8e ramping down 4 0 standstill"),
    ("chf", {},
     "where go 1s hz where state 2s where w2000=FC18 9s hz back 9s hz where halt 1s hz where 9s where state",
     "3 0 10.1 1 42b starting 1 9c4 -5 -25 2 9c4 -14.9 2 598 3 0 standstill"),
    ("gd", {},
     "where state go 1s hz where r2101 state 2s where w2001=7D0 9s hz back 9s hz where halt 1s hz where state 9s where "
     "state",
     "3 0 standstill 10.1 1 42b 41 starting 1 9c4 20 -25 2 9c4 -14.9 2 598 ramping down 3 0 standstill"),
    ("gd", {},
     "go 9s trip:4 where r2102 r5000 1s w2000=1 1s where 9s w2000=7 where hz go 1s hz w2000=6 by 9s where",
     "4 0 4 4 4 0 3 0 0 10.1 nobody 3 0"),
    ("gd", {"settings": {"P14_05": 2}, "comm_us": 2_000_000}, "go 1900ms by 200ms by where r2102", "bus bus 1 728 0"),
    ("gd", {"comm_us": 2_000_000}, "go 1900ms by 200ms by where r2102", "bus nobody 4 0 12"),
    ("gd", {},
     "w2001=1389 w2000=0 w2000=9 w2100=1 w4000=1 w8007=5 r7 stores w7=6 stores r8007 go w3=1 w2000=3 hz",
     "!4 !4 !4 !2 !2 5 0 1 !2 !8 0.8"),
    ("pf", {"comm_us": None},
     "where state go 1s hz where state 2s where w2001=C8 9s hz back 9s hz where halt 1s hz where state 9s where state",
     "60d 0 standstill 10.1 61f 6a starting 70f fa 20 -25 703 fa -14.9 623 8f ramping down 601 0 standstill"),
    # a 0 stops nothing, nor does a direction; a jog lasts as long as its bit; the frequency of another source
    ("pf", {"comm_us": None}, "w2000=0 go 9s w2000=0 9s hz w2000=10 9s hz w2000=1 9s hz w2000=2 9s hz", "25 25 0 25"),
    ("pf", {"comm_us": None},
     "w2001=FA w2000=14 2s hz w2000=10 2s hz w2000=3012 9s hz w2000=2012 9s hz", "5 0 25 20"),
    # both words at once
    ("sn", {}, "w0=1,9C4 poll4s hz r0+2", "25 1 9c4"),
    ("jscc", {}, "w1000=1,FA 4s hz", "25"),
    ("chf", {}, "w1000=1,FA x011010000001020001 r5001", "!2 010650010002 2"),
    # jog and its two stops, coast
    ("chf", {},
     "w1000=3 2s hz where w1000=8 2s hz w1000=4 2s hz where w1000=5 2s hz go 9s w1000=6 1s hz state where 9s where",
     "5 1 1f4 0 -5 2 1f4 0 20 coasting 3 0 3 0"),
    ("chf", {"stop_ends_jog": False},
     "w1000=4 2s w1000=5 2s hz state w1000=8 2s hz w1000=3 2s w1000=6 2s hz",
     "-5 at speed 0 0"),
    # trip and reset
    ("sn", {"key_cuts_line": False},
     "go poll3s trip:OC where r14+5 r80+4 state 9s go 1s hz reset where go poll1s hz trip!:CPF02 r10 r17 r80 reset "
     "r10 halt cure reset r10",
     "82 0 40 0 0 0 0 7 7 9c4 9c4 tripped 0 22 0 13.5 82 4 0 82 22"),
    ("jscc", {},
     "go 9s trip:3 where r3000 halt where 9s go 1s hz reset where r3000 go 1s hz",
     "8 0 3 8 0 0 4 0 0 10.1"),
    ("chf", {},
     "go 9s trip:5 where r5000 1s state w1000=1 1s where w1000=7 9s where hz go 1s hz trip!:5 w1000=7 where cure "
     "w1000=7 where",
     "4 0 5 tripped 4 0 3 0 0 10.1 4 0 3 0"),
    ("pf", {"comm_us": None},
     "go 9s trip:12 where r2101 1s state w2000=12 1s where w2000=1 w2000=8 9s where hz go 1s hz",
     "68c 0 c tripped 68c 0 60d 0 0 10.1"),
    ("pf", {}, "go 1s trip!:12 w2000=8 r2101 cure w2000=8 r2101 w2000=0 w2000=8 r2101", "c c 0"),
    # keypad, LOCAL, terminals
    ("chf", {}, "go 9s stop 1s hz state 9s hz where w1000=1 1s hz by", "15 ramping down 0 3 0 10.1 bus"),
    ("sn", {}, "go poll1s stop 9s hz r10 off 1s on r10", "0 - 22"),
    ("sn", {"key_cuts_line": False},
     "local go state start 9s hz by state halt hz stop 9s local go poll1s hz by",
     "local 20 keypad local 20 13.5 bus"),
    ("jscc", {"settings": {"F0_04": 1, "F0_08": 1}},
     "go 2s hz close 2s hz by state off 1s on 2s by open 9s hz",
     "0 20 terminals local nobody 0"),
    ("jscc", {"settings": {"F0_04": 2, "F0_08": 1}}, "close 2s hz off 1s on 2s hz by", "20 20 terminals"),
    ("chf", {"settings": {"run": 0}},
     "go 2s hz start 9s hz by set:run=2 w1000=5 9s hz w1000=1 9s by",
     "0 25 keypad 0 bus"),
    ("chf", {}, "go 9s set:speed=0 9s hz", "20"),
    ("sn", {}, "w181=0 go poll1s hz", "13.5"),
    ("sn", {"settings_act": "at once"}, "w181=0 go poll1s hz", "0"),
    # power
    ("sn", {}, "go poll9s off 1s hz state r10 on r0 r1 where 9s hz where", "20 off - 0 0 22 0 0 22 0"),
    ("sn", {}, "set:H5_01=5 r10 off on r41C w41C=7 r41C off on r41C w41C=7 wFFFD=0 off on r41C", "22 5 7 5 7"),
    ("chf", {}, "w8=5 w8009=6 r8+2 off on r8+2 stores", "!8 5 0 5 0 1"),
    ("chf", {"over": "limited"}, "w2000=7530 w1000=1 9s hz w2000=8AD0 20s hz", "50 -50"),
    ("sn", {}, "w200=" + ",".join("1" * 17) + " r200 w200=" + ",".join("1" * 16) + " r200", "!3 0 1"),
    ("sn", {},
     "w41D=4 w41D=5 w41E=2 w41E=3 w41F=3 w41F=4 w420=1 w420=2 w180=4 w180=5 w181=4 w181=5 w41C=20 w41C=21 "
     "w7=2D6 w7=2D7 w8=FD2A w8=FD29 wF=FFFF", "!21 !21 !21 !21 !21 !21 !21 !21 !21"),
    # an interlock
    ("sn", {}, "inhibit r19 r10 go poll1s hz free where w0=1 poll1s hz inhibit 1s hz state",
     "80 42 0 22 0 13.5 8.5 coasting"),
    # the line is lost
    ("sn", {}, "go poll3s 1900ms by 200ms hz state r16 r80 r10 9s reset r10", "bus 19.5 tripped 1 21 81 -"),
    ("sn", {"key_cuts_line": False}, "go poll3s 2100ms r80 9s reset r80 poll1s reset r80 off on r80", "21 21 0 0"),
    ("sn", {"settings": {"H5_04": 0}}, "go poll3s 2500ms hz r10", "19.9 81"),
    ("sn", {"settings": {"H5_04": 2}}, "go poll3s 2500ms hz r10", "22.5 82"),
    ("sn", {"settings": {"H5_04": 3}}, "go poll3s 9s hz r10 r1A r10 r1A", "25 71 0 31 0"),
    ("sn", {"settings": {"H5_05": 0}}, "go 9s 9s hz r10", "25 31"),
    ("pf", {}, "go 4900ms by 200ms by where r2101", "bus nobody 68c 0 51"),
    ("pf", {"settings": {"A105": 2}}, "go 4900ms 600ms by hz where r2101", "bus 19.9 66f c1 0"),
    ("pf", {"settings": {"A105": 3}}, "go 4900ms by 200ms by where r2101", "bus bus 74f fa 0"),
    ("chf", {}, "go 9s 9s hz", "25"),
    ("jscc", {"comm_us": 1000000}, "go 3s where r3000", "8 0 9"),
    # the chart of BBV51701, pages 10 to 13
    ("atv", {},
     "where state go hz state 1s hz where state 2s where rC81 w2136=FF38 9s hz back 9s hz rC82 halt 1s hz where rC81 "
     "state 9s where rC81",
     "4002 0 standstill 0.1 starting 10.1 4252 6a starting 4012 fa 627 -20 -25 ff06 -14.9 c452 ff71 8223 ramping down "
     "c002 0 623"),
    ("atv", {},
     "w2135=F rC81 w2135=7 rC81 w2135=6 rC81 w2135=F 2s hz w2135=0 rC81 w2135=6 w2135=7 rC81 w2135=2 rC81 w2135=6 "
     "w2135=0 rC81",
     "660 660 621 0 660 623 660 660"),
    ("atv", {},
     "go 3s w2135=2 rC81 100ms hz w2135=7 w2135=F rC81 9s hz rC81 w2135=0 rC81 go 1s hz w2135=6 state rC81",
     "207 17.8 207 0 607 660 10.1 coasting 621"),
    ("atv", {},
     "go 3s w2135=100F 1s hz rC81 9s hz rC81 w2135=F 1s hz",
     "14.9 227 0 627 10.1"),
    ("atv", {},
     "go 3s trip:3 rC81 r1BD1 w2135=F 9s rC81 w2135=0 w2135=80 rC81 r1BD1 hz w2135=6 w2135=7 rC81",
     "628 3 628 660 3 0 623"),
    ("atv", {"trip_output": "ramp"},
     "go 3s trip!:3 rC81 9s rC81 w2135=80 rC81 cure w2135=0 w2135=80 rC81",
     "20f 628 628 660"),
    ("atv", {"leaves": "at standstill"},
     "go 3s stop 1s hz rC81 9s rC81 go 1s hz halt 100ms w2135=2 100ms hz rC81",
     "15 227 660 10.1 3.5 207"),
    ("atv", {},
     "go 3s stop rC81 9s w2135=F 1s hz rC81 go 1s hz",
     "260 0 660 10.1"),
    ("atv", {},
     "go 3s inhibit rC81 state w2135=6 rC81 free rC81 9s w2135=F 1s hz go 1s hz",
     "660 coasting 660 660 0 10.1"),
    ("atv", {},
     "go 3s w2329=5 w2BC1=1 halt 9s rC81 w2BC1=0 rC81 w6=1 wC82=1 w4000=1 r4000 x01032136001E x010400000001",
     "!4 623 660 !2 !2 !2 !2 018303 018401"),
    ("atv", {"settings": {"STT": 1}},
     "go 3s halt 100ms hz",
     "19.5"),
    ("atv", {},
     "go 9s 9900ms by 200ms by rC81 r1BD1",
     "nobody nobody 628 5"),
    ("atv", {"settings": {"SLL": 0}},
     "go 9s 9s hz rC81",
     "25 6a7"),
    # coils, a pair, and what is refused
    ("mx", {},
     "where state go hz state 1s hz where 2s where s14 w1=1F4 9s hz c1=0 back 9s hz where halt 1s hz where state 9s "
     "where",
     "0 0 0 standstill 0.1 starting 10.1 1 0 42b 1 0 9c4 1 5 -25 1 0 9c4 -14.9 1 0 598 ramping down 0 0 0"),
    ("mx", {},
     "go 1s trip:3 s18 sF r3 r11+5 1s c1=1 hz c1=0 9s c4=1 2s c4=0 2s s18 r11 go 1s hz",
     "1 0 2 3 4 0 3f1 64 4.2 0 0 10.1"),
    ("mx", {},
     "go 3s inhibit s11 sF state c1=0 free go 1s hz c3=1 r11",
     "0 0 coasting 25 c"),
    ("mx", {"settings": {"C077": 200}},
     "go 1900ms by 200ms by r11",
     "bus nobody 29"),
    ("mx", {"settings": {"C077": 200, "C076": 4}},
     "go 1900ms 200ms by hz s18",
     "bus 18.9 0"),
    ("mx", {"settings": {"C077": 200, "C076": 2}},
     "go 9s by s18 s16",
     "bus 0 0"),
    ("mx", {},
     "w0=0,1389 cF=1 c60=1 s1+21 r4000 w2=1 w8FF=1 stores go w8FF=1 x010500000001 x010400000001 w1203=1",
     "!21 !23 !2 10000 !2 !23 1 !22 018503 018401 !22"),
    # refusals
    ("sn", {},
     "w1=1389 w7=2D7 w7=FD2A w9=3 r9 w10=1 w2F0=1 r2F0 r12+3 w180=5 w200=64 stores r200 wFFFD=0 stores wFFFD=1 1s "
     "go w200=1 wFFFD=0 halt 9s busy w200=1 r200 x0106000000 x010600000001 x010300000011 x010800010000",
     "!21 !21 3 !22 !2 !2 0 0 0 !21 0 64 1 !24 !22 !22 !24 64 018601 018601 018303 018801"),
    ("pf", {"comm_us": None},
     "r1 go 9s r1 r2103 r2102 r2100+2 r26 w27=5 r27 stores x011000010001020001 w2100=1 w2001=1F5",
     "0 fa fa !2 !3 5 5 1 019001 !2 !3"),
    ("sn", {"settings": {"H5_05": 0}}, "trip:UV1 w200=1 9s off on trip:CPF03 w200=1 r200 w100=1 r100", "!23 !22 0 1"),
    ("jscc", {},
     "w1000=4 w1001=1F5 w2000=1 r4000 r1000 r2000+3 w5=7 stores r5 w6=1 1s w1000=1 w6=1 x0103000000 x010400000001 "
     "x010800000000 x0110100000010200 x01030000000D",
     "!3 !3 !2 !2 !2 !2 1 7 !6 !7 - 018401 018801 019003 018303"),
    ("chf", {},
     "w1000=9 w1000=0 w2000=2711 w2000=D8EF w2000=D8F0 w1001=1 w4000=1 r4000 r8007 r3000+16 w8007=5 r7 stores w7=6 "
     "stores w7=7 1s w7=7 r5001 x010310010000 x010300000011 x011010000001020001 w9000=1",
     "!5 !5 !5 !5 !4 !4 !4 !4 0 1388 21c 0 0 0 0 0 0 0 0 0 0 0 0 0 5 0 1 !8 8 010650010005 010650010005 "
     "010650010002 !4"),
]  # fmt: skip
"""What is said to a drive, and what is seen: replies, !codes of refusals, - for silence, and the true motor."""


@pytest.mark.parametrize(("kind", "given", "words", "seen"), RUNS)
def test_what_happens(kind: str, given: dict[str, Any], words: str, seen: str) -> None:
    assert talk(kind, **given).say(words) == seen


FACES: dict[str, tuple[str, str, dict[str, Any], str]] = {
    # option: family, words, other options (= are its values where no Literal or bool lists them), seen with each value
    "maximum_hz": ("chf", "go 9s hz", {"=": (50.0, 40.0)}, "25 | 20"),
    "own_hz": ("jscc", "w1001=FA w1000=1 9s hz", {"=": (20.0, 30.0), "settings": {"F0_08": 1}}, "20 | 30"),
    "jog_hz": ("chf", "w1000=3 3s hz", {"=": (5.0, 6.0)}, "5 | 6"),
    "up_hz_s": ("chf", "go 1s hz", {"=": (10.0, 20.0)}, "10.1 | 20.2"),
    "down_hz_s": ("chf", "go 9s halt 1s hz", {"=": (10.0, 20.0)}, "14.9 | 4.8"),
    "quick_hz_s": ("sn", "go 500ms poll9s halt w0=4 200ms hz",
        {"=": (50.0, 90.0), "terminals": ("quick",)}, "14.2 | 5.8"),
    "coast_hz_s": ("chf", "go 9s w1000=6 1s hz", {"=": (5.0, 2.0)}, "20 | 23"),
    "start_us": ("chf", "go 1s hz state", {"=": (0, 500_000)}, "10.1 starting | 5.1 starting"),
    "stop_mode": ("sn", "go poll4s halt 1s hz state r21", {}, "14.9 ramping down 5b9 | 20 coasting 0"),
    "reply_us": ("chf", "r1001 wait", {"=": ((5000, 5000), (9000, 9000))}, "3 5000 | 3 9000"),
    "late_per_1000": ("chf", "r1001 wait", {"=": (0, 1000), "late_us": 50_000}, "3 5000 | 3 55000"),
    "late_us": ("chf", "r1001 wait", {"=": (0, 70_000), "late_per_1000": 1000}, "3 5000 | 3 75000"),
    "seed": ("chf", "r1001 wait r1001 wait", {"=": (0, 1), "reply_us": (1000, 9000)}, "3 7917 3 4155 | 3 2100 3 5662"),
    "boot_us": ("chf", "off on r1001 2s r1001", {"=": (0, 1_000_000)}, "3 3 | - 3"),
    "broadcast": ("chf", "W2000=1388 W1000=1 2s hz", {}, "0 | 20"),
    "settings_act": ("sn", "set:b1_02=0 go poll2s hz", {}, "25 | 0"),
    "stop_key": ("chf", "go 9s stop 9s hz", {}, "25 | 0"),
    "start_key": ("jscc", "w1001=FA start 9s hz by", {}, "0 nobody | 25 keypad"),
    "stop_key_holds": ("chf", "go 9s stop 9s w1000=1 9s hz halt w1000=1 9s hz", {}, "25 25 | 0 25"),
    "terminals_act": ("chf", "w2000=1388 close 9s hz by open 9s hz", {}, "0 nobody 0 | 25 terminals 0"),
    "bus_stop_ends_others": ("jscc", "start 9s hz halt 9s hz", {"settings": {"F0_04": 3, "F0_08": 1}}, "20 20 | 20 0"),
    "not_in_command": ("sn", "w0=1 hz", {"settings": {"b1_02": 0}}, "0 | !22 0"),
    "local_key": ("sn", "local go poll3s hz", {"key_cuts_line": False}, "25 | 0"),
    "resumes_remote": ("sn", "local go poll3s local poll3s hz", {"key_cuts_line": False}, "0 | 25"),
    "ignores": ("chf", "go 9s halt 9s hz", {"=": (frozenset(), frozenset({"stop"}))}, "0 | 25"),
    "signed_monitors": ("jscc", "back 9s r2000", {}, "fa | ff06"),
    "coast_shows": ("chf", "go 9s w1000=6 r3000", {}, "0 | 9b2"),
    "running_in_ramp": ("jscc", "go 9s halt r2001", {}, "4 | 1"),
    "code_after_reset": ("jscc", "trip:3 reset r3000", {}, "0 | 3"),
    "trip_output": ("chf", "go 9s trip:5 1s hz", {}, "20 | 15"),
    "latched": ("chf", "trip!:5 cure r1001", {}, "3 | 4"),
    "power_cycle_only": ("chf", "trip:5 w1000=7 r1001 off on r1001", {"=": (frozenset(), frozenset({5}))}, "3 3 | 4 3"),
    "fault_survives_power": ("chf", "trip:5 off 1s on r1001", {}, "3 | 4"),
    "reset_needs_stop": ("chf", "go trip:5 w1000=7 r1001 halt w1000=7 r1001", {}, "3 3 | 4 3"),
    "reset_needs_standstill": ("chf", "go 9s trip:5 w1000=7 r1001 9s w1000=7 r1001", {}, "3 3 | 4 3"),
    "resumes_after_reset": ("chf", "go 9s trip:5 9s w1000=7 9s hz", {}, "0 | 25"),
    "resumes_after_inhibit": ("chf", "go 9s inhibit 9s free 9s hz", {}, "0 | 25"),
    "retry_us": ("chf", "go 9s trip:5 9s hz", {"=": (None, 1_000_000)}, "0 | 25"),
    "resumes_after_power": ("chf", "go 9s off 9s on 9s hz r2000", {}, "0 0 | 25 1388"),
    "ride_us": ("chf", "go 9s off 300ms on 300ms by hz", {"=": (0, 500_000)}, "nobody 22 | bus 25"),
    "dip_trips": ("sn", "go poll9s off 300ms on r14 r80", {}, "0 0 | 2 2"),
    "comm_us": ("chf", "go 2s hz 9s r1001", {"=": (None, 1_000_000)}, "20.1 1 | 5 4"),
    "comm_action": ("chf", "go 2500ms 500ms hz r1001 state",
        {"comm_us": 2_500_000, "up_hz_s": 25.0}, "19.9 4 tripped | 0 4 tripped | 22.5 4 tripped | 25 1 at speed"),
    "comm_trips": ("chf", "go 9s state", {"comm_us": 2_000_000}, "standstill | tripped"),
    "fed_by": ("chf", "go 800ms r1001 800ms by x020310010001 800ms by",
        {"comm_us": 1_500_000}, "1 bus - bus | 1 bus - nobody | 1 nobody - nobody"),
    "comm_when": ("chf", "9s state", {"comm_us": 2_000_000}, "standstill | tripped"),
    "forbidden": ("chf", "r1001 r3000+4", {"=": (frozenset(), frozenset({0x3003}))}, "3 0 0 21c 0 | 3 !4"),
    "holes": ("chf", "r1FE+3 r1FF r4000", {}, "!4 0 !4 | 0 0 0 0 !4 | 0 0 0 0 0"),
    "over": ("jscc", "w1001=258 w1000=1 9s hz", {}, "!3 0 | 50"),
    "busy_refuses": ("chf", "busy r1001 w2000=1 w8=1", {}, "3 !8 | 3 !8 !8 | !8 !8 !8"),
    "store_us": ("chf", "w8=1 200ms w8=2", {"=": (100_000, 900_000)}, " | !8"),
    "unused_rows": ("sn", "r2 r13", {}, "!2 !2 | 0 0"),
    "key_cuts_line": ("sn", "reset r10 off on r10", {}, "22 22 | - 22"),
    "both_runs": ("sn", "w1=9C4 w0=3 poll2s hz r19", {}, "0 0 | 0 40 | 25 0"),
    "run_needs_edge": ("sn", "go trip:OC 9s reset w0=1 1s hz", {"key_cuts_line": False}, "10.1 | 0"),
    "strict_bits": ("sn", "w0=100", {}, " | !21"),
    "terminals": ("sn", "trip:OC w0=4 r10 w0=0 reset poll1s w0=4 poll1s hz",
        {"=": (("",), ("reset",), ("jog",)), "key_cuts_line": False}, "82 0 | 2a 0 | 82 5"),
    "unit_hz": ("sn", "wF=1 w1=64 w0=1 poll9s hz r21", {"=": (0.1, 0.2)}, "10 64 | 20 64"),
    "select_word": ("sn", "w1=64 w0=1 poll9s hz", {"=": (0, 1)}, "1 | 10"),
    "moved": ("sn", "w1=100 r20 w1=9C4 w0=1 poll3s hz w2=9C4 w1=2 poll9s hz r20", {}, "100 25 0 2 | 0 0 -25 9c4"),
    "zero_speed_of": ("sn", "go poll3s trip:OC r10", {}, "82 | 80"),
    "enter_readable": ("sn", "rFFFD", {}, "!2 | 0"),
    "reference_milli_hz": ("jscc", "go 9s hz", {}, "25 | 2.5"),
    "commands_readable": ("jscc", "w1001=FA r1001", {}, "!2 | fa"),
    "stop_resets": ("jscc", "trip:3 halt r2001", {}, "8 | 4"),
    "fault_word": ("jscc", "trip:3 r2001", {}, "8 | 9 | c"),
    "parameters_store": ("jscc", "w5=7 stores off on r5", {}, "0 0 | 1 7"),
    "parameters_while_running": ("jscc", "go w5=7", {}, "!7 | "),
    "codes": ("jscc", "r4000", {"=": ((1, 2, 3, 4, 5, 6, 7, 8), (17, 18, 19, 20, 21, 22, 23, 24))}, "!2 | !12"),
    "error_form": ("jscc", "r4000", {}, "!2 | -"),
    "most_words": ("jscc", "r0+13", {"=": (12, 125)}, "!3 | 0 0 0 0 0 0 0 0 0 0 0 0 0"),
    "coast_stopped": ("gd", "go 9s w2000=6 r2100 9s r2100", {}, "1 3 | 3 3"),
    "faulty": ("gd", "trip:4 halt", {}, " | !1"),
    "beyond": ("gd", "w1=3", {}, "!4 | !7"),
    "start_acts": ("pf", "go trip:12 9s w2000=8 w2000=1A 1s hz trip:12 9s w2000=12 w2000=1A w2000=12 1s hz", {},
        "10.1 0 | 10.1 10.4"),
    "both_directions": ("pf", "w2001=FA w2000=32 3s hz", {}, "-25 | 25"),
    "two_byte_count": ("chf", "x010310010001", {}, "0103020003 | 010300020003"),
    "stop_ends_jog": ("chf", "w1000=3 2s w1000=5 2s hz w1000=8 2s hz", {}, "5 0 | 0 0"),
    "jog_stop_ends_run": ("chf", "go 9s w1000=8 9s hz", {}, "25 | 0"),
    "jogs_from_run": ("chf", "go 9s w1000=3 9s hz", {}, "25 | 5"),
    "negative": ("chf", "w2000=EC78 w1000=1 9s hz w1000=2 9s hz", {}, "-25 25 | 25 -25 | !5 0 0"),
    "zero_command": ("chf", "w1000=0", {}, "!5 | "),
    "standby_in_coast": ("chf", "go 9s w1000=6 r1001 9s r1001", {}, "1 3 | 3 3"),
    "monitor_milli_hz": ("chf", "go 9s r3000+2", {}, "9c4 9c4 | fa fa | 19 19"),
    "reserved_rows": ("chf", "r300E", {}, "!4 | 0"),
    "fixed": ("chf", "go w8=1", {}, "!6 | "),
    "locked": ("chf", "w8=1 r8", {}, "1 | !7 0"),
    "password": ("chf", "w8=1", {}, " | !1"),
    "lock_covers_commands": ("chf", "go 1s hz", {"locked": True}, "10.1 | !7 !7 0"),
    "command_stores": ("chf", "w2000=1 stores", {}, "0 | 1"),
    "maximum_at": ("chf", "w2000=1388 w4=FA0 w1000=1 9s hz", {"=": (None, 4)}, "25 | 20"),
    "disable_stops": ("atv", "go poll4s w2135=7 hz 1s hz rC81", {"settings": {"STT": 2}}, "25 20 623 | 24.9 14.9 223"),
    "leaves": ("atv", "go poll4s w2135=7 rC81 9s rC81", {}, "223 623 | 227 623"),
    "reset_to": ("atv", "trip:3 w2135=0 w2135=80 rC81", {}, "660 | 621"),
    "reached_at_rest": ("atv", "rC81", {}, "260 | 660"),
    "run_acts": ("mx", "go 3s stop 4s c1=1 2s hz", {}, "0 | 20.1"),
    "way_while_running": ("mx", "go 3s c2=1 9s hz", {}, "-25 | 25"),
    "reset_acts": ("mx", "trip:3 c4=1 2s s18 c4=0 2s s18", {}, "0 0 | 1 0"),
    "reset_cuts": ("mx", "go 3s c4=1 100ms state", {}, "at speed | coasting"),
    "reset_keeps_coils": ("mx", "c2=1 c4=1 2s s1+4", {}, "0 | a"),
    "reset_deaf_us": ("mx", "c4=1 r11 2s r11", {"=": (0, 1_000_000)}, "0 0 | - 0"),
    "coil_13": ("mx", "go 1s s13 trip:3 s13", {}, "1 0 | 0 1"),
    "coast_runs": ("mx", "go 3s inhibit sF r2", {}, "0 2 | 1 4"),
    "half_pairs": ("mx", "r1 r0+2 r1000+2 r1001", {}, "!2 0 0 0 0 !2 | 0 0 0 0 0 0"),
    "volts": ("mx", "trip:3 r16", {}, "11c | b18"),
    "readable_coils": ("mx", "s1+4 sF", {}, "!2 0 | 0 0"),
    "bus_volts": ("chf", "r3002", {"=": (540, 560)}, "21c | 230"),
    "amperes": ("chf", "go r3004 halt 9s r3004", {"=": (100, 50)}, "64 0 | 32 0"),
}  # fmt: skip


NOT_IN_WORDS = {"ascii", "char_us", "silence_us", "hears_while_owing", "answers_bad_crc"}
"""Options of the wire itself, which a test of their own shows."""


def values(options: type[Options], name: str, given: dict[str, Any]) -> tuple[Any, ...]:
    """What an option may be."""
    hint = get_type_hints(options)[name]
    listed = (False, True) if hint is bool else get_args(hint)
    return tuple(given.get("=", listed))


@pytest.mark.parametrize("name", FACES)
def test_each_value_of_an_option_shows(name: str) -> None:
    kind, words, given, seen = FACES[name]
    others = {key: value for key, value in given.items() if key != "="}
    found = [talk(kind, **others, **{name: each}).say(words) for each in values(KINDS[kind][1], name, given)]
    assert found == seen.split(" | ")
    assert len(set(found)) == len(found) > 1


def test_each_option_has_its_row() -> None:
    named = {each.name for each in chain.from_iterable(fields(options) for _, options in KINDS.values())}
    assert named == {*FACES, *NOT_IN_WORDS}


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
    for hears in (True, False):
        one = drive("chf", hears_while_owing=hears, late_per_1000=1000, late_us=300_000)
        [(late, _)] = one.receive(read, 100_000)
        assert late == 405_000
        assert bool(one.receive(stop, 200_000)) == hears
    # while it sends it hears nothing
    assert one.receive(stop, 407_000) == []
    assert one.receive(stop, 450_000)


def test_a_damaged_frame_is_not_answered_unless_the_drive_has_a_code_for_it() -> None:
    damaged = rtu(bytes.fromhex("01 06 10 00 00 01"))[:-1] + b"\0"
    for kind in KINDS:
        assert drive(kind).receive(damaged, 100_000) == []
    [(_, reply)] = drive("chf", answers_bad_crc=True).receive(damaged, 100_000)
    assert reply == rtu(bytes.fromhex("01 06 50 01 00 03"))


def test_others_frames_and_broadcasts_get_no_reply() -> None:
    one = drive("chf", unit=3)
    for unit in (0, 1, 2, 4):
        assert one.receive(rtu(bytes([unit, 6, 0x10, 0, 0, 1])), 100_000 * (unit + 1)) == []
    assert one.commanded == "run_forward"
    # SN300G5 takes broadcasts that begin at 0000H, 0001H or 0002H
    assert talk("sn").say("W0=1,9C4 200ms by W180=0 r180") == "bus 2"


def test_how_one_looks_does_not_change_what_happens() -> None:
    seen = []
    for step in (1_000_000, 10_000, 777):
        one = drive("chf", comm_us=4_000_000)
        one.receive(rtu(bytes.fromhex("01 06 20 00 13 88")), 100_000)
        one.receive(rtu(bytes.fromhex("01 06 10 00 00 02")), 200_000)
        for now in range(200_000, 6_000_001, step):
            one.advance(now)
        seen.append([one.shaft_hz(at) for at in (6_000_000, 6_500_001, 9_000_000)])
    assert seen[0] == seen[1] == seen[2]
    assert seen[0][0] == pytest.approx(-16.0)


def test_a_look_back_does_not_show_what_had_not_begun() -> None:
    one = drive("chf", own_hz=30.0, settings={"run": 0, "speed": 0})
    one.press("start", 1_000_000)
    assert one.shaft_hz(0) == 0.0
    assert one.shaft_hz(2_000_000) == pytest.approx(10.0)


def test_every_fault_of_the_manuals_shows() -> None:
    numbers = {"FU": 0x01, "RH": 0x10, "EF3": 0x11, "LF": 0x1C, "OPR": 0x1E, "ERR": 0x1F, "CE": 0x21, "CF": 0x25,
               "SVE": 0x26, "CPF02": 0, "CPF23": 0, "-": 0}  # fmt: skip
    for name, (row, bit) in SERIOUS_AT.items():
        rows = ["0"] * 5
        rows[row] = f"{1 << bit:x}"
        if name != "-":
            assert talk("sn").say(f"trip:{name} r14+5 r10") == " ".join([*rows, "82"])
        if name in numbers and name != "-":
            assert Sn300g5.number(name) == numbers[name]
    for name, (row, bit) in MINOR_AT.items():
        one = talk("sn")
        one.drive.warn(name)  # type: ignore[attr-defined]  # of this family
        assert one.say("r19+2 r10") == " ".join([*(f"{1 << bit:x}" if at == row else "0" for at in (0, 1)), "62"])
    for code in FAULTS:
        assert talk("jscc").say(f"trip:{code} r3000") == f"{code:x}"


@pytest.mark.parametrize(
    ("kind", "spans"),
    [
        # SN300G5 tables (I) to (VI), JSCC section 5, PowerFlex 4 pages C-3 to C-5, CHF 11.6.4, GD200A 9.5
        ("sn", "0-9 e-1a 20-36 39-3b 80-8d 90-97 100-125 180-1a5 200-242 280-296 300-30c 30e-324 380-397 400-420 "
               "480-4b1 500-50d fffd-fffd"),
        ("jscc", "0-ff 1000-1002 2000-2001 3000-3000"),
        ("gd", " ".join(f"{256 * group:x}-{256 * group + 39:x}" for group in range(18))
               + " 2000-200e 2100-2103 3000-300e 3010-3010 3012-3016 5000-5000"),
        ("pf", "1-1 24-24 26-27 67-6b 2000-2001 2100-2101 2103-2103"),
        # its sisters, from the pages that their models name
        ("pf40p", "1-1 24-24 26-27 67-6b cf-cf f9-f9 2000-2001 2100-2101 2103-2103"),
        ("pf4m", "1-1 6c-6c 12e-132 2000-2001 2100-2101 2103-2103"),
        ("pf400", "1-1 24-24 26-27 66-69 2000-2001 2100-2101 2103-2103"),
        ("pf525", "1-1 29-29 2e-2f 79-7f 2000-2001 2100-2106"),
        ("chf", "0-1ff 1000-1001 2000-2000 3000-3014 5000-5001"),
    ],
)  # fmt: skip
def test_the_addresses_that_a_manual_lists(kind: str, spans: str) -> None:
    one = drive(kind)
    listed = {*one.ram, *one.LIVE}
    first = sorted(each for each in listed if each - 1 not in listed)
    last = sorted(each for each in listed if each + 1 not in listed)
    assert " ".join(f"{a:x}-{b:x}" for a, b in zip(first, last, strict=True)) == spans
