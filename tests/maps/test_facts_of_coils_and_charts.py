"""The maps of MX2 and Altivar 312 against their manuals, typed by hand a second time."""

import pytest
from tests.maps.facts import altivar_312, mx2
from tests.shipped import drives

from driveblocks.maps.model import Register

pytestmark = pytest.mark.every_family

MX, ATV = (drives()[prefix] for prefix in ("MX2", "ATV312"))


def by_id() -> dict[str, Register]:
    """Rows of the Altivar by id."""
    return {row.id: row for section in ATV.sections for row in section.registers if row.id}


def test_altivar_312_registers_and_scales() -> None:
    found = by_id()
    assert {name: found[name].address.first for name in altivar_312.REGISTERS} == altivar_312.REGISTERS
    for name in altivar_312.TENTHS:
        scale = found[name].scale
        assert scale is not None, name
        assert str(scale.factor) == "0.1", name


def test_altivar_312_commands_follow_the_chart() -> None:
    said = {str(one.does): (*(step.value for step in one.first), one.value) for one in ATV.operation.commands}
    assert said == altivar_312.WORDS
    assert {one.name: (one.mask, one.equals) for one in ATV.operation.states} == altivar_312.STATES
    waits = [step.until for step in ATV.operation.commands[0].first]
    assert waits == list(altivar_312.STATES)


def test_altivar_312_line_settings_and_faults() -> None:
    assert {one.id: one.needed.value for one in ATV.settings if one.needed and one.needed.value is not None} == (
        altivar_312.NEEDED
    )
    assert ATV.serial.baud is not None
    assert ATV.serial.format is not None
    assert ATV.watchdog is not None
    assert {one.code: one.baud for one in ATV.serial.baud.codes} == altivar_312.RATES
    formats = {one.code: f"{one.data_bits}{one.parity[0].upper()}{one.stop_bits}" for one in ATV.serial.format.codes}
    assert formats == altivar_312.FORMATS
    assert {one.value: one.does for one in ATV.watchdog.reactions} == altivar_312.SILENT
    assert [str(one.code) for one in ATV.faults.codes] == altivar_312.FAULTS.split()
    assert {name: getattr(ATV.limits, name).value for name in altivar_312.LIMITS} == altivar_312.LIMITS


def test_altivar_312_and_mx2_say_how_often_their_memory_can_be_written() -> None:
    assert {one.prefix: (one.storage.method, one.storage.max_writes) for one in (ATV, MX)} == {
        "ATV312": ("enter_register", 1_000_000),
        "MX2": ("enter_register", 100_000),
    }


def test_mx2_coils_are_sent_as_the_list_prints() -> None:
    rows = [row for section in MX.sections for row in section.registers if section.id.endswith("_coils")]
    sent = {row.address.first & 0xFFFF for row in rows}
    assert set(mx2.COILS.values()) <= sent
    assert all(wire == number - 1 for number, wire in mx2.COILS.items())


def test_mx2_registers_pairs_and_scales() -> None:
    rows = {
        row.address.first + 1: row
        for section in MX.sections
        for row in section.registers
        if not section.id.endswith("_coils")
    }
    assert tuple(sorted(number for number, row in rows.items() if row.words == 2)) == mx2.PAIRS
    for number in mx2.HUNDREDTHS:
        scale = rows[number].scale
        assert scale is not None, hex(number)
        assert str(scale.factor) == "0.01", hex(number)
    for number, values in ((3, mx2.STATUS_A), (4, mx2.STATUS_B), (5, mx2.STATUS_C)):
        assert {one.value for one in rows[number].values} == values


def test_mx2_errors_trips_line_and_watchdog() -> None:
    assert tuple(one.code for one in MX.errors.codes) == mx2.ERRORS
    assert tuple(one.code for one in MX.faults.codes) == mx2.TRIPS
    assert MX.serial.baud is not None
    assert MX.watchdog is not None
    assert {one.code: one.baud for one in MX.serial.baud.codes} == mx2.RATES
    assert {one.value: one.does for one in MX.watchdog.reactions} == mx2.SILENT
