"""The figures of a line, typed and of a program: beside simulated drives, and the page of stops."""

from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import pytest
from tests.desk.run.desk import BOX, maps

from driveblocks.bench.simulator.drive import SimulatedDrive
from driveblocks.bench.simulator.habits import Habits
from driveblocks.desk.bus import Bus
from driveblocks.desk.clock import VirtualClock
from driveblocks.desk.port import WirePort
from driveblocks.desk.run import source, wiring
from driveblocks.desk.run.controller import Controller
from driveblocks.desk.site import asked
from driveblocks.desk.site.line import Line, figures
from driveblocks.meaning.polls import polls

PAGE = Path(__file__).parents[3] / "docs" / "stop.md"
MAPS = {each.drive.prefix: each.drive for each in maps()}
SETTINGS = "Enable := TRUE, RunForward := Go, SpeedReferenceHz := 25.0, MaximumHz := 50.0, FullScaleHz := 50.0"


def program(families: list[str], *, rate: int, keeps: bool = False, watchdog: int = 0, within: int = 20000) -> str:
    """A program with these drives, whose turn-round is set to 20 ms."""
    drives = "".join(f"  M{at} : {each}_Drive;\n" for at, each in enumerate(families))
    calls = "".join(
        f"  M{at}({SETTINGS}, Address := {at + 1}, StopWithinMs := {within}, Settings := S, Slot := Slots[{at}]);\n"
        for at in range(len(families))
    )
    return (
        "PROGRAM Several\nVAR_INPUT\n  Go : BOOL;\n  Ms : UINT;\n  First : BOOL;\nEND_VAR\nVAR\n  S : VFD_Settings;\n"
        "  Count : UINT;\n  Rx : MB_Adu;\n  Tx : MB_LineFrame;\n  Bus : MB_ByteLine8;\n  Slots : MB_Slots8;\n"
        f"{drives}END_VAR\n  S.TurnRoundMs := 20;\n  S.ReferenceScale := 100.0;\n  S.WatchdogMs := {watchdog};\n{calls}"
        f"  Bus(ElapsedMs := Ms, BitRate := {rate}, Restart := First, MaxScanMs := 20, RxCount := Count, RxChars := Rx,"
        f" KeepsSilence := {keeps}, TxChars := Tx, Slots := Slots);\nEND_PROGRAM\n"
    )


def of_program(folder: Path, text: str, *, form: str | None = None, stop_within: str | None = None) -> Line:
    """The line of a program in a file."""
    path = folder / "line.st"
    path.write_text(text, encoding="utf-8")
    return asked.line(asked.Words(line=(str(path),), form=form, stop_within=stop_within))


class Plant:
    """A program at simulated drives, in virtual time."""

    def __init__(self, families: list[str], text: str, rate: int) -> None:
        drives = [SimulatedDrive(MAPS[each], at + 1, Habits(turn_us=20_000)) for at, each in enumerate(families)]
        loaded = source.load("line.st", text, maps())
        self.controller = Controller(
            loaded.library, "Several", wiring.find(loaded.program, set(loaded.drives)), loaded.drives, 10_000
        )
        self.clock = VirtualClock()
        self.sent: list[tuple[int, bytes]] = []
        port = WirePort(Bus(drives, rate, 10), self.clock)
        send = port.send
        port.send = lambda data: (self.sent.append((self.clock.now_us() // 1000, data)), send(data))[1]  # type: ignore
        self.controller.connect(port, None)

    def run(self, ms: int, *watched: str) -> dict[str, int]:
        """Scan for a time; the largest values of what is watched."""
        most = dict.fromkeys(watched, 0)
        for _ in range(ms // 10):
            self.clock.sleep_until(self.clock.now_us() + 10_000)
            self.controller.scan(self.clock.now_us())
            most = {name: max(value, self.controller.number(name)) for name, value in most.items()}
        return most


def gaps(plant: Plant, at: int, family: str) -> list[int]:
    """Times between two reads of a drive's status, ms."""
    poll = polls(MAPS[family])[0]
    head = bytes([at + 1, poll.function]) + poll.address.to_bytes(2, "big")
    sent = [ms for ms, frame in plant.sent if frame.startswith(head)]
    return [after - before for before, after in pairwise(sent)]


@pytest.mark.parametrize(
    ("families", "rate", "keeps"),
    [
        (["CHF"] * 3, 19200, True),
        (["CHF", "JSCC", "SN300G5"], 9600, False),
        pytest.param(["JSCC"] * 7, 57600, True, marks=pytest.mark.thorough),
    ],
)
def test_figures_bound_what_simulated_drives_see(tmp_path: Path, families: list[str], rate: int, keeps: bool) -> None:
    text = program(families, rate=rate, keeps=keeps, watchdog=2000)
    made = figures(of_program(tmp_path, text), rate)
    plant = Plant(families, text, rate)
    plant.run(6000)
    plant.sent.clear()
    plant.run(3000)
    number = plant.controller.number
    assert (made.alone, made.worst, made.cut) == tuple(
        number(f"Bus.{name}") for name in ("StopAloneMs", "WorstStopMs", "CutToContactMs")
    )
    assert abs(made.load - number("Bus.LoadPercent")) <= 10
    for at, each in enumerate(made.ages):
        assert 0.75 * each.every <= max(gaps(plant, at, families[at])) <= each.every
    plant.controller.instance["Go"] = True
    plant.run(9000)
    plant.sent.clear()
    aging = "Diagnosis.StatusAgeMs", "Diagnosis.MeasuresAgeMs", "Control.Run.AloneMs"
    most = plant.run(3000, *(f"M{at}.{name}" for at in range(len(families)) for name in aging))
    for at, each in enumerate(made.ages):
        assert plant.controller.instance[f"M{at}.Running"] is True
        # as the line has it, whose drives begin to reply up to a scan sooner than it may see
        found = [number(f"Bus.Slots[{at}].{name}") for name in ("ReadMs", "WorstReadMs", "WorstFeedMs", "StaleMs")]
        wanted = [each.promised.read, each.promised.worst, each.promised.feed, each.promised.stale]
        assert all(0.75 * high <= value <= high for value, high in zip(found, wanted, strict=True)), (found, wanted)
        assert max(gaps(plant, at, families[at])) <= each.promised.read
        assert 0.5 * each.promised.read <= most[f"M{at}.Diagnosis.StatusAgeMs"] <= each.promised.read
        assert most[f"M{at}.Diagnosis.MeasuresAgeMs"] <= (each.rest or 0)
        # a reference is sent three times in the time of the watchdog
        assert 2000 // 3 - 20 <= most[f"M{at}.Control.Run.AloneMs"] <= 2000 // 3 + 20 + (each.feed or 0)


def rows() -> Iterator[tuple[str, int, bool, list[int]]]:
    """Family, rate, whether the port keeps the silence, and the worst stops of 1, 2, 4, 6 and 8 drives on the page."""
    for row in PAGE.read_text(encoding="utf-8").splitlines():
        if " bit/s 8N1, the " in row:
            name, *cells = (cell.strip() for cell in row.strip("|").split("|"))
            yield name.split(",")[0], int(name.split()[1]), "the port" in name, [int(cell.split()[0]) for cell in cells]


@pytest.mark.parametrize(("family", "rate", "keeps", "worst"), list(rows()))
def test_stops_are_those_of_the_page(tmp_path: Path, family: str, rate: int, keeps: bool, worst: list[int]) -> None:
    for count, ms in zip((1, 6), (worst[0], worst[3]), strict=True):
        made = of_program(tmp_path, program([family] * count, rate=rate, keeps=keeps))
        assert figures(made, rate).worst == ms


def test_a_port_that_is_late_makes_each_round_longer() -> None:
    made = asked.line(asked.Words(line=("chf",) * 3, scan="10ms"))
    assert figures(replace(made, port_late=20), 9600).round > figures(made, 9600).round


def test_ascii_takes_twice_the_characters_and_devices_take_their_turn() -> None:
    plain = asked.line(asked.Words(line=("jscc@5",), device=(2, 16), scan="1ms", form="8E1"))
    both = figures(plain, 9600), figures(replace(plain, ascii=True), 9600)
    assert [each.unit.unit for each in both[0].spent] == [5, 1, 2]
    (rtu, spoken) = ([round((each.request + each.reply) * 9.6 / 11, 6) for each in one.spent] for one in both)
    assert rtu[1:] == [8 + 5 + 2 * 2, 8 + 5 + 2 * 16]
    assert spoken == [2 * each + 2 for each in rtu]
    assert both[1].worst > both[0].worst
    assert [each.promised.read > 0 or each.rest is not None for each in both[0].ages] == [True, False, False]


def test_nine_units_take_the_longer_line() -> None:
    made = asked.line(asked.Words(line=("chf",) * 9))
    assert (made.size, len(made.units), [each.unit for each in made.units]) == (32, 9, list(range(1, 10)))
    eight = asked.line(asked.Words(line=("chf",) * 8))
    assert eight.size == 8
    assert figures(made, 9600).worst > figures(eight, 9600).worst


@pytest.mark.thorough
def test_rates_are_those_that_every_manual_names() -> None:
    assert asked.line(asked.Words(line=("jscc", "sn300g5"))).rates() == (4800, 9600)
    assert asked.line(asked.Words(line=("chf",), rate=14400)).rates()[4:6] == (14400, 19200)


def test_what_breaks_is_named_and_a_port_that_is_late_counts(tmp_path: Path) -> None:
    text = program(["CHF"] * 3, rate=19200, watchdog=500)
    made = of_program(tmp_path, text, stop_within="200ms")
    assert figures(made, 19200).broken == ["stops", "watchdog"]
    assert figures(replace(made, within=None), 19200).broken == ["watchdog"]
    assert figures(replace(made, port_late=50), 19200).alone == figures(made, 19200).alone + 3 * 50


def test_a_status_that_can_get_too_old_is_found(tmp_path: Path) -> None:
    made = figures(of_program(tmp_path, program(["CHF"] * 3, rate=19200)), 19200)
    (one,) = {each.promised for each in made.ages}
    assert (one.stale, made.broken, made.slow) == (5000, [], ())
    for stale, slow in ((one.read - 1, True), (one.worst - 1, True), (one.worst, False)):
        made = replace(made, promised=(replace(one, stale=stale),) * 3)
        assert (made.broken, made.slow) == ((["status"], made.ages) if slow else ([], ()))


def test_a_program_with_a_mailbox_and_a_meter_says_what_its_line_is(tmp_path: Path) -> None:
    text = (Path(__file__).parents[3] / "examples" / "meter_and_sensor.st").read_text(encoding="utf-8")
    made = of_program(tmp_path, text)
    assert [(each.name, each.unit, each.every_ms) for each in made.units] == [
        ("Motor", 1, 0), ("device", 10, 1000), ("device", 11, 0),
    ]  # fmt: skip
    mailbox = BOX.replace("Divisor : INT := 1;", "Divisor : INT := 1;\n  Late : UINT := 30;").replace(
        "  Quotient := 1", "  Box.LateMs := Late;\n  Box.KeepsSilence := TRUE;\n  Quotient := 1"
    )
    made = of_program(tmp_path, mailbox, form="8E1")
    assert (made.port_late, made.keeps, made.bits, made.rate) == (30, True, 11, 19200)
