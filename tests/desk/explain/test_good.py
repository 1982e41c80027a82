"""Good frames: every example of the manuals, and what words mean on the shipped drives, typed from the manuals."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.desk.explain.explaining import Explain, rtu

from driveblocks.desk.explain.explanation import Explanation
from driveblocks.modbus.frame import seal
from driveblocks.reference.request import Asked, Requests

PREFIXES = ["CHF", "EX100", "JSCC", "SN300G5"]


def lines(made: Explanation) -> list[tuple[int | None, str, str, str]]:
    """Address, mark, English and Chinese of everything below the registers of the first reading."""
    return [(one.address, line.mark, line.name, line.zh) for one in made.readings[0].registers for line in one.lines]


@pytest.mark.parametrize("prefix", PREFIXES)
def test_every_example_frame_says_what_the_map_says(explain: Explain, prefix: str) -> None:
    drive = explain.of[prefix].drive
    assert drive is not None
    frames = {frame.id: frame for frame in drive.frames}
    for frame in frames.values():
        request = frames[frame.answers].correct.hex() if frame.answers else None
        made = explain(prefix, frame.correct.hex(), request)
        assert made.good, frame.id
        assert made.wire.mode == frame.mode
        directions = [one.direction for one in made.readings]
        assert frame.direction in directions, frame.id
        told = made.readings[directions.index(frame.direction)]
        if frame.means.error is None:
            assert tuple(one.word for one in told.registers if one.word is not None) == frame.means.values, frame.id
        assert {field.name: field.data for field in told.fields}["unit"] == bytes([frame.means.unit])
        for quantity in frame.means.quantities:
            (held,) = (one for one in told.registers if one.address == quantity.register)
            assert (held.value, held.unit) == (quantity.value, quantity.unit)
        assert f"The manual's example {frame.id}: {frame.means.says}." in made.notes


@pytest.mark.parametrize("prefix", PREFIXES)
def test_every_misprinted_example_is_named(explain: Explain, prefix: str) -> None:
    drive = explain.of[prefix].drive
    assert drive is not None
    for frame in (one for one in drive.frames if one.printed != one.correct):
        made = explain(prefix, frame.printed.hex())
        assert not made.good
        assert f"The manual prints its example {frame.id} like this, with a wrong checksum." in made.notes
        if made.wire.mode == "rtu":
            assert made.wire.expected == frame.correct[-2:]


@pytest.mark.parametrize(
    ("prefix", "body", "says"),
    [
        ("JSCC", "01 03 20 00 00 01", "request to unit 1: read 1 register from 2000H"),
        ("JSCC", "01 03 02 01 F4", "reply of unit 1: 1 register read"),
        ("JSCC", "01 06 10 00 00 03", "request to unit 1: write 3 to 1000H"),
        ("JSCC", "01 10 10 00 00 02", "reply of unit 1: 2 registers written at 1000H"),
        ("SN300G5", "00 10 00 00 00 01 02 00 00", "broadcast to all drives: write 1 register at 0000H"),
        (
            "SN300G5",
            "1F 90 21",
            "reply of unit 31: refuses function 10H, reason 21H Data setting error  非法数据,或超限数据",
        ),
        ("SN300G5", "01 08 00 00 12 AB", "request to unit 1: diagnostics 0000H, data 12ABH"),
        (
            "CHF",
            "01 06 50 01 00 08",
            "reply of unit 1: refuses, reason 08H Drive busy storing to EEPROM  变频器忙（EEPROM 正在存储中）",
        ),
        (
            "JSCC",
            "01 83 02",
            "reply of unit 1: refuses function 03H, reason 02H Illegal data address  不合法数据地址, by the standard",
        ),
        ("", "01 83 02", "reply of unit 1: refuses function 03H, reason 02H Illegal data address"),
        ("", "01 01 00 00 00 08", "request to unit 1: read 8 coils from 0000H"),
        ("", "01 0F 00 00 00 0A 02 CD 01", "request to unit 1: write 10 coils at 0000H"),
        ("", "01 11", "request to unit 1: Report server ID"),
    ],
)
def test_what_a_frame_says(explain: Explain, prefix: str, body: str, says: str) -> None:
    made = explain(prefix, rtu(body))
    assert made.good
    assert made.readings[0].says == says


def test_a_refusal_means_what_the_manual_says_of_it(explain: Explain) -> None:
    (reply,) = explain("JSCC", rtu("01 83 02")).readings
    assert any(each.startswith("Means: The data address received is one") for each in reply.notes)
    (foreign,) = explain("CHF", rtu("01 83 08")).readings  # in a form that the drive has not
    assert not foreign.notes


def test_request_and_reply_of_a_single_write_are_the_same(explain: Explain) -> None:
    made = explain("JSCC", "01 06 10 00 00 01 4C CA")
    assert [one.direction for one in made.readings] == ["request", "reply"]
    alone = explain("JSCC", "01 06 10 00 00 01 4C CA", "01 06 10 00 00 01 4C CA")
    assert [one.direction for one in alone.readings] == ["reply"]


@pytest.mark.parametrize(
    ("prefix", "body", "request_body", "expected"),
    [
        (
            "SN300G5",
            "01 03 06 00 A3 00 18 00 00",
            "01 03 00 10 00 03",
            [
                (0x10, ".0", "Running", "1: 运行中"),
                (0x10, ".1", "Zero speed", "1: 零速"),
                (0x10, ".5", "Ready", "1: 变频器准备完了"),
                (0x10, ".7", "Major fault", "1: 重故障"),
                (0x11, ".3-4", "Device on connector 1CN: Computer", "11: 计算机"),
            ],
        ),
        ("SN300G5", "01 03 02 00 1E", "01 03 00 80 00 01", [(0x80, "fault", "Operator disconnected", "操作器拔出")]),
        (
            "SN300G5",
            "01 03 02 00 1D",
            "01 03 00 80 00 01",
            [(0x80, "fault", "code 1DH, which the map does not list", "")],
        ),
        ("SN300G5", "01 03 02 80 00", "01 03 00 10 00 01", [(0x10, ".8-F", "not used by the manual, but not 0", "")]),
        (
            "JSCC",
            "01 03 02 00 09",
            "01 03 20 01 00 01",
            [(0x2001, ".0", "Running forward", "正转运行中"), (0x2001, ".3", "Fault", "故障")],
        ),
        ("JSCC", "01 03 02 00 00", "01 03 30 00 00 01", [(0x3000, "=", "No fault", "无异常")]),
        ("CHF", "01 03 02 00 17", "01 03 50 00 00 01", [(0x5000, "fault", "code 17H; the map has no list", "")]),
        (
            "CHF",
            "01 06 10 00 00 06",
            "01 06 10 00 00 06",
            [
                (0x1000, "=", "Coast to stop (emergency stop)", "自由停机 (紧急停机)"),
                (0x1000, "command", "coast stop", ""),
            ],
        ),
        (
            "SN300G5",
            "01 03 02 00 00",
            "01 03 00 0F 00 01",
            [
                (0xF, ".0", "Frequencies in 0.01 Hz", "频率/监测单位为 0.01Hz"),
                (0xF, ".1", "PID target from bus disabled", "数据总线传送来的 PID 目标值无效"),
            ],
        ),
    ],
)
def test_bits_values_and_faults(
    explain: Explain, prefix: str, body: str, request_body: str, expected: list[tuple[int, str, str, str]]
) -> None:
    made = explain(prefix, rtu(body), rtu(request_body))
    assert made.good
    assert lines(made) == expected


@pytest.mark.parametrize(
    ("prefix", "body", "expected", "note"),
    [
        ("JSCC", "01 06 10 01 01 F4", (500, None), ""),
        ("CHF", "01 06 20 00 D8 F0", (-10000, "-100.00"), ""),
        ("CHF", "01 06 20 00 27 11", (10001, "100.01"), "outside the range -10000 to 10000"),
        ("CHF", "01 06 10 00 01 00", (256, None), "no listed value; with its bytes swapped it is 1, Run forward"),
        ("CHF", "01 06 80 07 00 05", (5, None), "RAM only, not stored; it cannot be read at this address"),
        ("CHF", "01 06 00 07 00 05", (5, None), "stored in EEPROM, which frequent writes wear out; 8007H is RAM only"),
        ("GD200A", "01 06 80 04 13 88", (5000, "50.00"), "RAM only, not stored; it cannot be read at this address"),
        (
            "GD200A",
            "01 06 00 04 13 88",
            (5000, "50.00"),
            "stored in EEPROM, which frequent writes wear out; 8004H is RAM only",
        ),
        ("JSCC", "01 06 00 12 00 05", (5, None), "counts as a write to EEPROM: the manual does not say"),
        ("SN300G5", "01 10 FF FD 00 01 02 00 00", (0, None), "stores all parameters, at most 100000 times"),
        ("SN300G5", "01 10 00 01 00 01 02 13 88", (5000, "50.00"), "only while 000FH bit 0 = 0"),
    ],
)
def test_numbers_and_what_is_to_be_known(
    explain: Explain, prefix: str, body: str, expected: tuple[int, str | None], note: str
) -> None:
    made = explain(prefix, rtu(body))
    assert made.good
    (held,) = made.readings[0].registers
    value = None if held.value is None else str(held.value)
    assert ((held.number, value), held.note) == (expected, note)


@pytest.mark.parametrize(
    ("words", "note"),
    [
        ("00 04", "as at standstill"),
        ("00 01", "no standstill"),
        ("00 10", "bits 0010H are not listed; no standstill"),
    ],
)
def test_what_a_status_says_of_standstill(explain: Explain, words: str, note: str) -> None:
    made = explain("JSCC", rtu(f"01 03 02 {words}"), rtu("01 03 20 01 00 01"))
    assert made.readings[0].registers[0].note == note


def test_without_the_request_a_reply_has_no_names(explain: Explain) -> None:
    made = explain("JSCC", "01 03 02 01 F4 B8 53")
    (held,) = made.readings[0].registers
    assert (held.address, held.word, held.name) == (None, 500, "")
    assert "give its --request" in made.readings[0].notes[0]


def test_a_tolerated_two_byte_count(explain: Explain) -> None:
    frame, request = "01 03 00 04 00 02 00 00", rtu("01 03 00 04 00 02")
    tolerant = explain.of["CHF"].dialect.two_byte_count
    made = explain("CHF", rtu(frame), request)
    assert made.good is tolerant
    assert not explain("JSCC", rtu(frame), rtu("01 03 00 04 00 02")).good


@pytest.mark.parametrize("prefix", PREFIXES)
@given(st.data())
def test_every_request_that_a_drive_takes_is_good(explain: Explain, prefix: str, draw: st.DataObject) -> None:
    drive = explain.of[prefix].drive
    assert drive is not None
    requests = Requests(drive)
    codes = st.sampled_from(sorted(set(requests.functions) & {3, 4, 6, 8, 16}))
    function = draw.draw(codes)
    allowed = requests.readable if function in (3, 4) else requests.writable
    asked = Asked(
        function,
        unit=draw.draw(st.integers(drive.serial.unit.min, drive.serial.unit.max)),
        address=draw.draw(st.sampled_from(sorted(allowed))),
        quantity=1,
        value=draw.draw(st.integers(0, 0xFFFF)),
        words=(draw.draw(st.integers(0, 0xFFFF)),),
        ascii=draw.draw(st.booleans()),
    )
    built = requests.build(asked)
    if built.result != "OK":
        assert built.result == "MODE"
        return
    made = explain(prefix, seal("ascii" if asked.ascii else "rtu", built.body).hex())
    assert made.good
    assert "request" in [one.direction for one in made.readings] or drive.errors.form is not None


def test_a_word_that_is_no_command_is_said_by_what_its_bits_do(explain: Explain) -> None:
    made = explain("PF4", rtu("01 06 20 00 00 0A"), rtu("01 06 20 00 00 0A"))
    assert (0x2000, "command", "starts the motor, by bit 1 `Start` at 1", "") in lines(made)
