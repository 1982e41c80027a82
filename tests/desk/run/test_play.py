"""What happens to simulated drives while a program runs: by a scenario, and by what a person types."""

import socket
from pathlib import Path

import pytest
from tests.desk.run.desk import Desk
from tests.simulator.talk import MAPS

from driveblocks.bench.simulator.drive import SimulatedDrive
from driveblocks.desk import scenario
from driveblocks.desk.bus import Loss
from driveblocks.desk.run.drives import Named
from driveblocks.desk.run.play import Play, Plays
from driveblocks.desk.run.simulated import Simulation
from driveblocks.maps import catalog
from driveblocks.modbus.frame import seal

NET = 600
"""Seconds that no machine needs, for what would hang."""
UNITS = {7: MAPS["JSCC"]}


def playing(text: str = "", *lines: str) -> Desk:
    """A desk after eight seconds, at which something happens and a person has typed lines at first."""
    desk = Desk()
    play = Play(UNITS, scenario.loads(text, "s.yaml", UNITS) if text else ())
    desk.session.play = Plays([play], {"Motor": (play, 7)})
    play.act = lambda happening: happening.act(desk.drives, Loss())
    for line in lines:
        desk.session.typed.put(line)
    desk.session.run(8_000_000)
    return desk


def test_a_scenario_begins_with_the_first_scan_and_is_printed() -> None:
    desk = playing("- at 2 s: trip 4\n- at 3 s: power off 7\n- at 9 s: clear\n")
    assert (desk.drives[0].last_fault, desk.drives[0].powered) == (4, False)
    assert [line for line in desk.told() if line.startswith(" ")] == ["  2.0 s  trip 4", "  3.0 s  power off 7"]


@pytest.mark.parametrize(
    ("lines", "says"),
    [
        (("t 7",), ["trip 1 7"]),
        (("t Motor", "power off motor"), ["trip 1 7", "power off 7"]),
        (("d 7", "r 7"), ["power off 7", "clear 7", "power on 7", "reset 7"]),
        (("late  80 ms for 1 s",), ["late 80 ms for 1 s", "late 5 ms"]),
        (("reset 7",), ["reset 7"]),
    ],
)
def test_what_is_typed_happens_at_once_and_what_lasts_ends(lines: tuple[str, ...], says: list[str]) -> None:
    told = playing("", *lines).told()
    assert [line.split(" s  ", 1)[1] for line in told if line.startswith(" ")] == says


def test_a_drive_that_is_tripped_and_restored_by_keys_has_no_fault() -> None:
    assert playing("", "t 7").drives[0].fault == MAPS["JSCC"].faults.codes[0].code
    assert playing("", "t 7", "r 7").drives[0].fault == 0


@pytest.mark.parametrize(
    ("line", "says"),
    [
        ("t 9", "there is no drive at unit 9; units: 7"),
        ("trip XX", "JSCC at unit 7 has no fault `XX`; write its number, or name the unit of another drive"),
        ("power of", "`power of` is not complete, or says too much; write `power off 2`"),
        ("trip 'x", "JSCC at unit 7 has no fault `'x`; write its number, or name the unit of another drive"),
    ],
)
def test_what_cannot_happen_is_reported(line: str, says: str) -> None:
    assert says in playing("", line).told()


def test_a_name_of_the_program_is_none_of_a_scenario() -> None:
    desk = Desk()
    play = desk.session.play = Plays([Play({})], {})
    desk.controller.instance["Start"] = False
    assert not play.takes("Start")
    assert play.takes("stop")
    desk.session.typed.put("start")
    desk.session.run(100_000)
    assert desk.instance["Start"] is True


def test_an_input_that_is_toggled_twice_between_two_scans_is_as_it_was() -> None:
    desk = Desk()
    for line in ("1", "1", "Hz := 12", "Hz := nothing"):
        desk.session.typed.put(line)
    desk.session.run(100_000)
    assert (desk.instance["Start"], desk.instance["Hz"]) == (False, 12.0)
    assert "Hz takes a number, not `nothing`" in desk.told()


def test_a_drive_of_several_lines_is_named_by_its_block() -> None:
    plays, told = (Play(UNITS), Play(UNITS)), list[tuple[int, str]]()
    for at, each in enumerate(plays):
        each.act = lambda happening, at=at: told.append((at, happening.says))  # type: ignore[misc]
    both = Plays(plays, {"Motor": (plays[0], 7), "Fan": (plays[1], 7)})
    with pytest.raises(ValueError, match="there are 2 lines: name the drive, such as MOTOR"):
        both.typed("d 7", 0)
    for line in ("d Fan", "trip 4 motor", "clear"):
        assert both.takes(line)
        both.typed(line, 0)
    assert [*both.due(0)] == ["trip 4 7", "clear", "power off 7", "clear"]
    assert told == [(0, "trip 4 7"), (0, "clear"), (1, "power off 7"), (1, "clear")]


def test_what_happens_reaches_drives_in_another_process_that_runs_nothing_of_the_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("yaml.py", "types.py", "socket.py"):
        (tmp_path / name).write_text("import os; os.mkdir('was-run')", encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    made = Simulation([Named(catalog.resolve("jscc"), MAPS["JSCC"], 7)], 19200, 10, ascii_mode=False)
    tripped, request = SimulatedDrive(MAPS["JSCC"], 7), bytes.fromhex("07 03 20 01 00 01")
    standing = tripped.reply(request)
    tripped.trip(4)
    assert tripped.reply(request) != standing
    for happening in scenario.said("trip 4 7", UNITS):
        made.happen(happening)
    reply = b""
    with socket.create_connection(("127.0.0.1", made.port)) as line:
        line.settimeout(NET)
        while reply[:-2] != tripped.reply(request):
            line.sendall(seal("rtu", request))
            reply = b""
            while len(reply) < 7:
                reply += line.recv(7)
    made.close()
    assert not (tmp_path / "was-run").exists()
