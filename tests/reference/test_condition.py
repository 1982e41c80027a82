"""Conditions, fault numbers and texts, on values typed from the manuals."""

from dataclasses import replace

import pytest

from driveblocks.maps.form import Span
from driveblocks.maps.model import Bit, Condition, Drive, Fault, Short
from driveblocks.reference import text
from driveblocks.reference.fault import Faulted, numbered
from driveblocks.reference.standstill import holds
from driveblocks.reference.text import Texts

pytestmark = pytest.mark.every_family


def test_a_mask_asks_for_its_bits_alone() -> None:
    enabled = Condition(register=0x2100, mask=0x006F, equals=0x0027)
    assert [holds(enabled, word) for word in (0x0027, 0xFFB7, 0x0037, 0x002F, 0x0007, 0x0023, 0x0127)] == [
        True, True, True, False, False, False, True
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        ((0, 0, 0), Faulted(0, 0)),
        ((0x0001, 0, 0), Faulted(0x01, 1)),
        ((0x8002, 0, 0), Faulted(0x02, 2)),
        ((0, 0x2000, 0), Faulted(0x1E, 1)),
        ((0, 0x9000, 0), Faulted(0, 0)),
        ((0, 0, 0x0031), Faulted(0x21, 3)),
        ((0, 0, 0xFFCE), Faulted(0, 0)),
        ((0xFFFF, 0xFFFF, 0xFFFF), Faulted(1, 33)),
    ],
)
def test_fault_numbers_of_fault_words(drives: dict[str, Drive], words: tuple[int, int, int], expected: Faulted) -> None:
    assert numbered(drives["SN300G5"], (*words, 0, 0)) == expected


@pytest.mark.parametrize(
    ("words", "expected"), [((0x0004, 0), Faulted(0x33, 1)), ((0, 0x0001), Faulted(0x41, 1)), ((0xFFFF, 0xFFFF), None)]
)
def test_faults_of_the_control_circuit_have_the_numbers_after_them(
    drives: dict[str, Drive], words: tuple[int, int], expected: Faulted | None
) -> None:
    found = numbered(drives["SN300G5"], (0, 0, 0, *words))
    assert found == expected if expected else found.count == 9


def test_a_drive_without_fault_bits_has_no_numbers(drives: dict[str, Drive]) -> None:
    with pytest.raises(ValueError, match="no relation"):
        numbered(drives["JSCC"], (0,))


def test_texts(drives: dict[str, Drive]) -> None:
    assert text.fault(drives["SN300G5"], 0x18) == Texts("OS Overspeed", "OS 超速")
    assert text.fault(drives["SN300G5"], 0x1D) is None
    assert text.error(drives["CHF"], 8) == Texts("Drive busy storing to EEPROM", "变频器忙（EEPROM 正在存储中）")
    assert text.error(drives["JSCC"], 2) == Texts("Illegal data address", "不合法数据地址")
    assert text.error(drives["JSCC"], 9) is None
    assert text.bit(drives["SN300G5"], 0x0015, 7) == Texts("Overspeed", "超速")
    assert text.bit(drives["SN300G5"], 0x0015, 0xC) is None
    assert text.bit(drives["SN300G5"], 0x0013, 0) is None
    assert text.value(drives["CHF"], 0x1001, 3) == Texts("Standby", "变频器待机中")
    assert text.value(drives["CHF"], 0x1001, 9) is None
    assert text.value(drives["CHF"], 0x4000, 9) is None


def test_a_text_is_the_short_wording_where_there_is_one(drives: dict[str, Drive]) -> None:
    assert text.bit(drives["SN300G5"], 0x000F, 1) == Texts("PID target from bus", "总线 PID 目标值: 0 无效 1 有效")
    short = Short(en="fast", zh="快")
    assert text.of(Fault(code=1, name="Overspeed", zh="超速", short=short)) == Texts("fast", "快")
    assert text.of(Bit(bit=Span(0, 0), name="Ready", short=replace(short, en=None))) == Texts("Ready", "快")
