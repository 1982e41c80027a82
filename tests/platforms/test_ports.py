"""Whatever a maker's block makes of a frame, the next one starts soon, and the user sees the maker's number."""

import pytest
from tests.platforms.ports import FAILURES, GOOD, MAKERS, SCAN_MS, End, Maker, Rig

from driveblocks.platforms.port import adapter
from driveblocks.render import library
from driveblocks.render.text import languages

platforms = pytest.mark.parametrize("maker", MAKERS, ids=str)
RECEIVER = {"siemens": ("Receive.Fails", True), "codesys": ("Reading.Fails", True), "twincat": ("Receiver.Error", 24)}
"""What the maker's block has while it cannot receive."""


def alone(maker: Maker) -> Rig:
    """A port that has sent frames well for more than a second."""
    rig = Rig(maker, "X_Alone")
    for _ in range(110):
        rig.scan()
    assert rig.attempts > 1
    assert rig.number("Port.ErrorID") == 0
    return rig


def until_attempt(rig: Rig) -> int:
    """Scans until the maker's block is asked to send another frame."""
    before = rig.attempts
    for scans in range(1, 100):
        rig.scan()
        if rig.attempts > before:
            return scans
    return 100


def taken(rig: Rig, end: End) -> int:
    """Scans for which a frame that ends so may keep others waiting."""
    return -(-rig.maker.limit_ms // SCAN_MS) if end.call is None else end.call


@platforms
@pytest.mark.parametrize("call", range(7))
def test_every_frame_that_a_port_takes_is_given_to_the_makers_block(maker: Maker, call: int) -> None:
    """Also one that waits when the frame before it ends: the block needs an edge for each."""
    rig = alone(maker)
    rig.end(End(call))
    rig.scan()
    began = rig.attempts - rig.number("Offered")
    for _ in range(200):
        rig.scan()
    assert abs(rig.attempts - rig.number("Offered") - began) <= 1


@platforms
@pytest.mark.parametrize("end", FAILURES, ids=str)
def test_a_frame_that_failed_is_reported_until_another_went(maker: Maker, end: End) -> None:
    rig = alone(maker)
    rig.end(end)
    until_attempt(rig)
    for _ in range(taken(rig, end) + 2):
        if rig.number("Port.ErrorID"):
            break
        rig.scan()
    assert rig.number("Port.ErrorID") == (maker.overtime if end.call is None else maker.failure)
    rig.end(GOOD)
    until_attempt(rig)
    rig.scan()
    rig.scan()
    assert rig.number("Port.ErrorID") == 0


@platforms
@pytest.mark.parametrize("end", FAILURES, ids=str)
def test_a_port_that_stays_broken_is_reported_all_the_time_and_tried_again_and_again(maker: Maker, end: End) -> None:
    rig = alone(maker)
    rig.end(end)
    for _ in range(taken(rig, end) + 4):
        rig.scan()
    wait, shown = 0, set[int]()
    for _ in range(300):
        before = rig.attempts
        rig.scan()
        shown.add(rig.number("Port.ErrorID"))
        wait = wait + 1 if rig.attempts == before else 0
        assert wait <= taken(rig, end) + 8, "not tried again"
    assert shown == {maker.overtime if end.call is None else maker.failure}
    if maker.target == "codesys":
        assert 3 <= rig.number("Port.Opening.Asked") <= 1 + rig.ms // 1000


@platforms
def test_a_receiver_that_stays_broken_is_reported_and_holds_no_frame_up(maker: Maker) -> None:
    rig = alone(maker)
    name, value = RECEIVER[maker.target]
    wait, shown = 0, set[int]()
    for scans in range(300):
        before = rig.attempts
        rig.program[f"Port.{name}"] = value
        rig.scan()
        if scans:
            shown.add(rig.number("Port.ErrorID"))
        wait = wait + 1 if rig.attempts == before else 0
        assert wait <= 8
    assert shown == {{"siemens": 0x80E1, "codesys": 5006, "twincat": 24}[maker.target]}
    if maker.target == "codesys":
        assert 3 <= rig.number("Port.Opening.Asked") <= 1 + rig.ms // 1000


def lined(maker: Maker) -> Rig:
    """A line that polls a drive, which is silent."""
    rig = Rig(maker, "X_Lined")
    slot = {"UnitAddress": 1, "TurnRoundMs": 20, "LongestMs": 40}
    slot |= {"Ask[3].Number": 1, "Ask[3].FunctionCode": 3, "Ask[3].Quantity": 2}
    slot |= {"Ask[0].FunctionCode": 6, "Ask[0].Address": 0x2000, "Ask[0].Words[0]": 6}
    for name, value in slot.items():
        rig.program[f"Slots[0].{name}"] = value
    return rig


def turn(rig: Rig) -> None:
    """One scan with a drive block that is called."""
    rig.program["Slots[0].Alive"] = rig.ms // SCAN_MS % 256
    rig.scan()


@platforms
def test_a_disturbed_character_is_shown_and_is_no_port_that_does_not_work(maker: Maker) -> None:
    """The line judges itself what it receives: one bad character stopped all its motors."""
    rig = lined(maker)
    name, value = RECEIVER[maker.target]
    for scan in range(200):
        rig.program[f"Bus.Port.{name}"] = value if scan % 40 in (10, 11, 12) else type(value)(0)
        turn(rig)
        assert rig.number("Bus.ErrorID") != 57
    assert rig.number("Bus.PortErrorID") != 0


@platforms
@pytest.mark.parametrize("end", FAILURES, ids=str)
def test_a_stop_is_sent_in_time_after_a_frame_that_failed(maker: Maker, end: End) -> None:
    for later in (0, 1, 2, 4, 7):
        rig = lined(maker)
        for _ in range(30):
            turn(rig)
        rig.end(end)
        requests = rig.number("Bus.Requests")
        while rig.number("Bus.Requests") == requests:
            turn(rig)
            assert rig.ms < 3000
        for _ in range(later):
            turn(rig)
        start = rig.ms
        rig.program["Bus.StopAll"] = True
        while not sent_stop(rig):
            if not rig.program[f"{rig.port}.TxBusy"]:
                rig.end(GOOD)
            turn(rig)
            assert rig.ms - start <= rig.number("Bus.StopAloneMs")


def sent_stop(rig: Rig) -> bool:
    """Whether the last frame that the maker's block was given is a stop."""
    frame = "Wire" if rig.maker.target == "siemens" else ""
    return rig.number(f"{rig.port}.{'Send.' + frame if frame else 'Frame'}[1]") == 6


@platforms
@pytest.mark.parametrize("end", FAILURES, ids=str)
def test_the_line_shows_the_number_for_a_second(maker: Maker, end: End) -> None:
    rig = lined(maker)
    for _ in range(30):
        turn(rig)
    assert rig.number("Bus.PortErrorID") == 0
    rig.end(end)
    while not rig.number("Bus.PortErrorID"):
        turn(rig)
        assert rig.ms < 3000
    rig.end(GOOD)
    rig.program["Bus.StopAll"] = True  # so that there is a next frame
    wanted = maker.overtime if end.call is None else maker.failure
    assert shown(rig) == wanted
    assert rig.number("Bus.ErrorID") == 57
    assert [shown(rig) for _ in range(99)] == [wanted] * 99
    assert shown_after(rig, 100) == 0


def shown(rig: Rig) -> int:
    """What the line shows after one more scan."""
    turn(rig)
    return rig.number("Bus.PortErrorID")


def shown_after(rig: Rig, scans: int) -> int:
    """What the line shows after some more scans."""
    return [shown(rig) for _ in range(scans)][-1]


ADAPTERS = {
    file.name: file.text
    for target in ("siemens", "codesys", "twincat", "linux")
    for file in adapter(target, languages(["en"], "utf-8"))
}
SHARED = list(library.generic(languages(["en"], "utf-8")))


@pytest.mark.parametrize("name", ADAPTERS)
def test_nothing_depends_on_an_initial_value(name: str) -> None:
    """Some platforms lose them; those of the pins of every line belong to MB_Line."""
    declared = ADAPTERS[name].partition("VAR_INPUT\n")[2].rpartition("END_VAR\n")[0]
    lines = next(file.text for file in SHARED if file.name == "MB_Line8")
    assert [line for line in declared.splitlines() if ":=" in line and line not in lines] == []


def test_a_pin_that_is_left_at_0_means_its_default() -> None:
    for maker in MAKERS:
        rig = lined(maker)
        turn(rig)
        assert rig.number("Bus.LateMs") == {"siemens": 20, "codesys": 60, "twincat": 40}[maker.target]
        rig.program["Bus.PortLateMs"] = 33
        turn(rig)
        assert rig.number("Bus.LateMs") == 33
    rig = alone(MAKERS[1])
    assert [rig.program[f"Port.Settings[{each}].udiValue"] for each in (1, 2, 6)] == [1, 9600, 8]


@pytest.mark.parametrize(("parity", "bits", "data"), [(0, 0, 8), (2, 0, 8), (1, 11, 8), (2, 10, 7)])
def test_a_port_with_parity_alone_has_eight_data_bits(parity: int, bits: int, data: int) -> None:
    """Ten bits of a character, the usual number, are 7E1 with parity, which no MODBUS RTU can use."""
    rig = Rig(MAKERS[1], "X_Lined")
    rig.program["Bus.Parity"], rig.program["Bus.CharacterBits"] = parity, bits
    for _ in range(10):
        rig.scan()
    assert rig.number("Bus.Port.Settings[6].udiValue") == data
