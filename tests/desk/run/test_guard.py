"""On a real port only reads and the maps' stops are sent, judged by the bytes, whatever the program wants."""

import pytest
from tests.desk.run.desk import EXAMPLE, ONE, Desk
from tests.maps import bad
from tests.simulator.talk import MAPS

from driveblocks.bench.simulator.drive import SimulatedDrive
from driveblocks.desk.run.guard import Guard, stop_request, stops
from driveblocks.maps import load
from driveblocks.maps.model import Drive
from driveblocks.meaning.words import STOPS
from driveblocks.modbus.frame import seal

UNITS: dict[int, Drive] = {1: MAPS["SN300G5"], 2: MAPS["JSCC"], 3: MAPS["CHF"]}


def rtu(text: str) -> bytes:
    """A request with its checksum."""
    return seal("rtu", bytes.fromhex(text))


LEAVES = [
    "01 03 00 10 00 12", "02 04 20 00 00 02", "09 03 00 00 00 01",  # reads, of any unit
    "01 10 00 00 00 01 02 00 00",  # SN300G5: bits 0 and 1 of 0000H cleared
    "02 06 10 00 00 03",  # JSCC: 3 is stop
    "03 06 10 00 00 05", "03 06 10 00 00 06", "03 06 10 00 00 08",  # CHF: stop, coast, end of a jog
]  # fmt: skip
DROPPED = [
    "01 10 00 00 00 01 02 00 01", "01 10 00 00 00 01 02 00 02",  # run
    "01 10 00 00 00 01 02 00 04",  # a terminal by the bus, which may be set to anything
    "01 10 00 00 00 02 04 00 00 13 88",  # a stop with a reference after it
    "01 06 00 00 00 01", "01 10 00 01 00 01 02 13 88", "01 10 09 00 00 01 02 00 00",
    "02 06 10 00 00 01", "02 06 10 01 0B B8", "02 06 10 00 00 05",
    "03 06 10 00 00 03", "03 06 10 00 00 07", "03 06 20 00 27 10",  # what stops JSCC jogs CHF
    "04 06 10 00 00 03",  # a unit of which nothing is known
    "00 06 10 00 00 03", "00 03 00 00 00 01",  # to all
    "01 08 00 00 AA 55", "02 17 00 00 00 01 10 00 00 01 02 00 01", "02 05 00 00 FF 00", "02 2B 0D 01 00",
    "02 03 10 00 00 03 01", "02 10 10 00 00 01 02 00 03 00",  # longer than they say
]  # fmt: skip


@pytest.mark.parametrize("text", LEAVES)
def test_a_read_and_a_stop_of_the_map_leave(text: str) -> None:
    assert Guard(UNITS).passes(rtu(text))
    assert Guard(UNITS).passes(seal("ascii", bytes.fromhex(text)))


@pytest.mark.parametrize("text", DROPPED)
def test_nothing_else_is_sent_and_all_of_it_is_counted(text: str) -> None:
    guard = Guard(UNITS)
    assert not guard.passes(rtu(text))
    assert not guard.passes(seal("ascii", bytes.fromhex(text)))
    assert sum(guard.dropped.values()) == 2


def test_what_is_no_whole_frame_or_two_at_once_does_not_leave() -> None:
    guard = Guard(UNITS, frozenset({2}))
    stop = rtu("02 06 10 00 00 03")
    for frame in (stop[:-1], stop + stop, stop[:-1] + b"\0", b"", b"\x02", b":0206", stop + rtu("02 06 10 00 00 01")):
        assert not guard.passes(frame)
    assert guard.dropped == {"what is no request": 7}


def test_a_drive_that_a_person_let_run_may_get_everything_and_no_other() -> None:
    guard = Guard(UNITS, frozenset({2}))
    assert guard.passes(rtu("02 06 10 00 00 01"))
    assert not guard.passes(rtu("03 06 10 00 00 01"))
    assert guard.dropped == {"write to 1000H of unit 3": 1}


@pytest.mark.parametrize("family", sorted(MAPS))
def test_the_stop_of_a_map_stops_its_drive(family: str) -> None:
    drive = SimulatedDrive(MAPS[family], 5)
    drive.keypad_run(20)
    drive.step(5000)
    request = stop_request(5, MAPS[family])
    assert Guard({5: MAPS[family]}).passes(seal("rtu", request))
    assert (drive.reply(request) or b"")[:6] == request[:6]
    drive.step(5000)
    assert drive.mode == "standstill"


def test_of_a_drive_that_coils_command_only_the_stop_of_its_coil_is_sent() -> None:
    coils = load.load(bad.FOLDER / "coils.yaml")
    assert stop_request(5, coils) == bytes.fromhex("05 05 00 00 00 00")
    guard = Guard({5: coils})
    assert guard.passes(rtu("05 05 00 00 00 00"))
    for text in (
        "05 05 00 00 FF 00",
        "05 05 00 01 00 00",
        "05 05 00 00 00 01",
        "05 06 00 00 00 00",
        "05 0F 00 00 00 01 01 00",
    ):
        assert not guard.passes(rtu(text)), text
    assert guard.dropped["write to coil 0000H of unit 5"] == 1


def test_no_word_of_a_motion_is_a_stop() -> None:
    for drive in MAPS.values():
        moving = {(each.register, each.value) for each in drive.operation.commands if each.does not in STOPS}
        assert not moving & set(stops(drive))


# ------------------------------------------------------------ at a program


def test_a_program_that_wants_to_run_a_real_drive_only_reads_and_stops() -> None:
    desk = Desk(free=frozenset()).started()
    assert desk.drives[0].mode == "standstill"
    assert desk.instance["Motor.CommOk"]
    assert {frame[1] for frame in desk.line.sent} == {3, 6}
    assert {frame[:6] for frame in desk.line.sent if frame[1] == 6} == {bytes.fromhex("07 06 10 00 00 03")}
    assert desk.controller.dropped["write to 1001H of unit 7"] > 0


def test_the_same_program_runs_it_where_a_person_has_typed_its_name_and_unit() -> None:
    assert Desk(free=frozenset({(7, "Motor")})).started().drives[0].mode == "running"
    assert Desk(free=frozenset({(8, "Motor"), (7, "Other")})).started().drives[0].mode == "standstill"


def test_a_drive_that_takes_another_unit_address_has_lost_its_permission() -> None:
    text = ONE.replace("Address := 7", "Address := Unit").replace("  Hz :", "  Unit : USINT := 7;\n  Hz :")
    desk = Desk(text, [SimulatedDrive(MAPS["JSCC"], 7), SimulatedDrive(MAPS["JSCC"], 9)], frozenset({(7, "Motor")}))
    desk.scan(2000)
    desk.instance["Unit"] = 9
    desk.scan(3000)
    assert desk.instance["Motor.Ready"]
    desk.instance["Start"] = True
    desk.scan(3000)
    assert [drive.mode for drive in desk.drives] == ["standstill", "standstill"]
    assert desk.controller.dropped["write to 1001H of unit 9"] > 0


def test_a_unit_address_that_two_maps_claim_gets_reads_only() -> None:
    """The line would still stop a motor through the drive block that moved it."""
    text = EXAMPLE.read_text(encoding="utf-8").replace("Address := 2", "Address := Unit")
    text = text.replace("  Setting :", "  Unit : USINT := 2;\n  Setting :")
    drives = [SimulatedDrive(each, unit) for unit, each in UNITS.items()]
    desk = Desk(text, drives, frozenset({(3, "Fan"), (3, "Pump2")}))
    desk.scan(10000)
    desk.instance["FanHertz"], desk.instance["FanOn"] = 20.0, True
    desk.scan(5000)
    assert desk.drives[2].mode == "running"
    assert not desk.controller.dropped
    desk.instance["Unit"] = 3
    desk.scan(20)
    desk.line.sent.clear()
    desk.scan(2000)
    assert {frame[1] for frame in desk.line.sent if frame[0] == 3} <= {3}
    assert desk.controller.dropped.keys() == {"write to 1000H of unit 3"}
