"""The maps of MX2, Altivar 312, V20 and ACS355 against their manuals, typed by hand a second time."""

import pytest
from tests.maps.facts import acs355, altivar_312, mx2, v20
from tests.shipped import drives

from driveblocks.maps.model import Register

pytestmark = pytest.mark.every_family

MX, ATV, V20, ACS = (drives()[prefix] for prefix in ("MX2", "ATV312", "V20", "ACS355"))


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


def test_v20_registers_scales_and_signs() -> None:
    found = {row.id: row for section in V20.sections for row in section.registers if row.id}
    assert {name: found[name].address.first for name in v20.WIRE} == v20.WIRE
    for name, (times, unit) in v20.SCALING.items():
        scale = found[name].scale
        assert scale is not None, name
        assert (float(scale.factor * times), found[name].unit) == (1.0, unit), name
        assert found[name].signed == (name in v20.NEGATIVE), name
    for wire, bit in v20.SINGLE.items():
        row = V20.register_at(wire)
        assert row is not None
        assert row.note == f"bit {bit} of STW"


def test_v20_commands_and_status_are_those_of_the_words() -> None:
    said = {str(one.does): (*(step.value for step in one.first), one.value) for one in V20.operation.commands}
    assert said == v20.WORDS
    assert {one.register for one in V20.operation.commands} == {99}
    assert V20.operation.reference.register == 100
    bits = {str(one.shows): one.any[0].bit for one in V20.operation.status}
    assert {shows: bit.first for shows, bit in bits.items() if bit} == v20.STATUS
    assert {one.any[0].register for one in V20.operation.status} == {109}


def test_v20_line_settings_and_watchdog() -> None:
    needed = {one.id: one.needed.value for one in V20.settings if one.needed}
    assert {name: needed[name] for name in v20.NEEDED} == v20.NEEDED
    assert V20.serial.baud is not None
    assert {one.code: one.baud for one in V20.serial.baud.codes} == v20.RATES
    assert {name: getattr(V20.limits, name).value for name in v20.LIMITS} == v20.LIMITS
    assert (V20.serial.unit.min, V20.serial.unit.max, V20.serial.unit.default) == v20.UNIT
    assert [one.code for one in V20.errors.codes] == v20.REFUSALS
    assert V20.serial.pins is not None
    assert {one.pin: one.label for one in V20.serial.pins.pins} == v20.TERMINALS
    watchdog = V20.watchdog
    assert watchdog is not None
    assert watchdog.time is not None
    assert (watchdog.time.setting, int(watchdog.time.milliseconds), watchdog.fault) == v20.WATCHDOG
    assert set(watchdog.fed_by) == {99, 100}


def test_acs355_registers_commands_and_status() -> None:
    found = {row.address.first + 40001: row for section in ACS.sections for row in section.registers}
    assert {number: found[number].access or "r" for number in acs355.REGISTERS} == acs355.REGISTERS
    assert {row.id: number for number, row in found.items() if row.id} == acs355.PARAMETERS
    said = {str(one.does): (*(step.value for step in one.first), one.value) for one in ACS.operation.commands}
    assert said == acs355.WORDS
    run = ACS.operation.commands[0]
    assert tuple(step.until or step.for_ms for step in run.first) == acs355.WAITS
    bits = {str(one.shows): one.any[0].bit for one in ACS.operation.status}
    assert {shows: bit.first for shows, bit in bits.items() if bit} == acs355.STATUS
    assert ACS.operation.reference.full_scale == acs355.FULL_SCALE


def test_acs355_line_settings_refusals_and_faults() -> None:
    needed = {one.id: one.needed.value for one in ACS.settings if one.needed and one.needed.value is not None}
    assert needed == acs355.NEEDED
    assert ACS.serial.baud is not None
    assert ACS.serial.format is not None
    assert [one.baud for one in ACS.serial.baud.codes] == acs355.RATES
    assert {one.code: (one.parity, one.stop_bits) for one in ACS.serial.format.codes} == acs355.FORMS
    assert [one.code for one in ACS.functions] == acs355.FUNCTIONS
    assert [one.code for one in ACS.errors.codes] == acs355.REFUSALS
    assert {one.code: one.name for one in ACS.faults.codes} == acs355.FAULTS
