"""Drives of three families on one virtual line: polled, started, stopped, refused."""

from tests.line.vline import COMMAND, PARAMETER, POLL, STOP
from tests.simulator.bench import DriveBench
from tests.simulator.talk import MAPS

from driveblocks.maps.polls import polls
from driveblocks.simulator.drive import SimulatedDrive

THREE = ("CHF", "JSCC", "SN300G5")


def line() -> DriveBench:
    """CHF, JSCC and SN300G5 at units 5, 6 and 7, each polled by the first read of its plan."""
    bench = DriveBench([SimulatedDrive(MAPS[prefix], 5 + place) for place, prefix in enumerate(THREE)])
    stops = ((6, 0x1000, 5), (6, 0x1000, 3), (16, 0x0000, 0))
    for slot, (drive, (function, address, word)) in enumerate(zip(bench.simulated, stops, strict=True)):
        bench.fill(slot, STOP, function, address, word=word)
        first = polls(MAPS[THREE[slot]])[0]
        bench.ask(slot, POLL, first.function, first.address, quantity=first.words)
        assert drive.mode == "standstill"
    bench.run(1500)
    return bench


def words(bench: DriveBench, slot: int) -> list[int]:
    """What the last poll has read."""
    value = bench.block[f"Slots[{slot}].PollWords"]
    assert isinstance(value, list)
    return [int(word) for word in value[:8]]  # type: ignore[arg-type]  # an array of WORD


def test_three_families_run_and_stop_on_one_line() -> None:
    bench = line()
    for slot, (address, function, word) in enumerate([(0x2000, 6, 4000), (0x1001, 6, 2000), (0x0001, 16, 2000)]):
        bench.ask(slot, COMMAND, function, address, word=word)
    bench.run(200)
    for slot, (address, function) in enumerate([(0x1000, 6), (0x1000, 6), (0x0000, 16)]):
        bench.ask(slot, COMMAND, function, address, word=1)
    bench.run(3000)
    assert [drive.hertz for drive in bench.simulated] == [20, 20, 20]
    # CHF: 1 is running forward; JSCC: 20.0 Hz and 1; SN300G5: 0010H is the second word, running, agree, ready
    assert [words(bench, 0)[0], words(bench, 1)[:2], words(bench, 2)[1]] == [1, [200, 1], 0x31]
    for slot in range(3):
        bench.stop(slot)
    bench.run(2500)
    assert [drive.mode for drive in bench.simulated] == ["standstill"] * 3
    assert [words(bench, 0)[0], words(bench, 1)[:2], words(bench, 2)[1]] == [3, [0, 4], 0x22]
    assert [drive.stores for drive in bench.simulated] == [0, 0, 0]


def test_refusals_come_in_each_drives_form_and_a_drive_without_power_is_silent() -> None:
    bench = line()
    for slot in range(3):
        bench.ask(slot, PARAMETER, 3, 0x7777)
    bench.run(500)
    assert [bench.answer(slot, PARAMETER) for slot in range(3)] == ["REFUSED"] * 3
    assert [bench.slot(slot, "RefusedReason") for slot in range(3)] == [4, 2, 2]
    bench.simulated[1].power(on=False)
    bench.run(2000)
    assert [bench.slot(slot, "Online") for slot in range(3)] == [True, False, True]
