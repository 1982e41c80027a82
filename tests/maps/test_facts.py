"""The shipped maps against the manuals, typed by hand a second time: a slip in a map turns one of these red.

Nothing here uses the rules that check a map; the oracle is the manual. Only the loader is shared.
"""

import re
from collections.abc import Iterable, Iterator
from decimal import Decimal
from pathlib import Path
from typing import Any

import pytest
from tests.maps.facts import chf, gd200a, glossary, jscc, powerflex_4, sn300g5
from tests.maps.facts.powerflex_sisters import SISTERS
from tests.shipped import drives

from driveblocks.maps.model import Bit, Condition, Drive, Frame, Register

pytestmark = pytest.mark.every_family

MAPS = Path(__file__).parents[2] / "vendor_maps"

SN, JS, CH, GD, PF = (drives()[prefix] for prefix in ("SN300G5", "JSCC", "CHF", "GD200A", "PF4"))
DRIVES = {"sn300g5": SN, "jscc": JS, "chf": CH, "gd200a": GD, "powerflex_4": PF}
DRIVES |= {name: drives()[name] for name in SISTERS}
TYPED: dict[str, Any] = {"sn300g5": sn300g5, "jscc": jscc, "chf": chf, "gd200a": gd200a, "powerflex_4": powerflex_4}
TYPED |= SISTERS
WHOLE = {"gd200a": {"commanded_by", "own_maximum"}, "powerflex_4": {"commanded_by"}}
WHOLE |= {name: {"commanded_by"} for name in SISTERS}
"""What a manual says in full of what a drive does by itself and says of itself."""
TOLD = {
    "sn300g5": ["watchdog"],
    "jscc": [],
    "chf": [],
    "gd200a": ["watchdog", "commanded_by", "own_maximum"],
    "powerflex_4": ["watchdog", "commanded_by"],
    **{name: ["watchdog", "commanded_by"] for name in SISTERS},
    "PF400": ["commanded_by"],
}
"""... and what it says at all."""

ERRATA = {name: each.ERRATA for name, each in TYPED.items()}
ABSENT = {name: each.ABSENT for name, each in TYPED.items()}
NOTICES = {name: each.NOTICES for name, each in TYPED.items()}


def bare(text: str | None) -> str:
    """Text without white space, which the manuals set as it comes."""
    return re.sub(r"\s", "", text or "")


def rows(drive: Drive) -> dict[int, Register]:
    """Every address of every section and the row that describes it; no address may stand twice."""
    found: dict[int, Register] = {}
    for section in drive.sections:
        for row in section.registers:
            for address in row.address:
                assert address not in found, f"{address:04X}H is there twice"
                found[address] = row
    return found


def access(drive: Drive) -> dict[int, str]:
    """How each address may be used."""
    return {
        address: row.access or section.access
        for section in drive.sections
        for row in section.registers
        for address in row.address
    }


def runs(table: str) -> Iterator[tuple[int, str, str]]:
    """Address, id and Chinese of a table of runs: `B7-01 01A0H first name|second name`."""
    for line in table.strip().splitlines():
        first, base, names = line.split(" ", 2)
        group, number = first.split("-")
        for n, name in enumerate(names.split("|")):
            yield int(base[:-1], 16) + n, f"{group}-{int(number) + n:02d}", name


def spans(text: str) -> list[int]:
    """Addresses of `0100H-0185H 0242H`, in that order."""
    ends = [[int(end[:-1], 16) for end in span.split("-")] for span in text.split()]
    return [address for span in ends for address in range(span[0], span[-1] + 1)]


def triples(table: str) -> list[tuple[str, str, str]]:
    """Lines of `a | b | c`."""
    return [(a, b, c) for a, b, c in (line.split(" | ") for line in table.strip().splitlines())]


def cases(tables: dict[str, str]) -> list[tuple[str, str, str, str]]:
    """One case per line of the tables of all drives."""
    return [(drive, *line) for drive, table in tables.items() for line in triples(table)]


# ---------------------------------------------------------------- all drives


@pytest.mark.parametrize(("drive", "about", "printed", "used"), cases(ERRATA))
def test_misprint_is_an_erratum(drive: str, about: str, printed: str, used: str) -> None:
    held = [one for one in DRIVES[drive].errata if any(names(ref, about) for ref in one.about)]
    assert held, f"no erratum about {about}"
    assert any(printed in one.printed and used in one.used for one in held), [(one.printed, one.used) for one in held]


def names(reference: str, about: str) -> bool:
    """Whether a reference is `about`, or a range of registers that holds it."""
    kind, _, place = about.partition(" ")
    if kind != "register" or not reference.startswith("register "):
        return reference == about
    return int(place[:-1], 16) in spans(reference.removeprefix("register "))


@pytest.mark.parametrize(("drive", "about", "word", "other"), cases(ABSENT))
def test_what_the_manual_does_not_say_is_listed(drive: str, about: str, word: str, other: str) -> None:
    held = [one for one in DRIVES[drive].absent if any(names(ref, about) for ref in one.about)]
    said = [" ".join((one.what, one.matters, one.find_out)) for one in held]
    assert any(word in text and other in text for text in said), said


@pytest.mark.parametrize(("drive", "about", "chinese", "english"), cases(NOTICES))
def test_what_the_manual_asks_for_is_a_notice(drive: str, about: str, chinese: str, english: str) -> None:
    held = [one for one in DRIVES[drive].notices if any(names(ref, about) for ref in one.about)]
    said = [(one.text.own, f"{one.text.en} {one.note}") for one in held]
    assert any(chinese in zh and english in en for zh, en in said), said


@pytest.mark.parametrize("drive", DRIVES)
def test_what_a_drive_does_by_itself_and_says_of_itself_is_there_or_listed_as_absent(drive: str) -> None:
    known = DRIVES[drive]
    told = {
        "identity": known.identity,
        "watchdog": known.watchdog,
        "commanded_by": known.operation.commanded_by,
        "own_maximum": known.operation.own_maximum,
        "trip_output": known.faults.trip_output,
    }
    assert [key for key, one in told.items() if one] == TOLD[drive]
    for key in told.keys() - WHOLE.get(drive, set()):
        assert any(key in one.about and one.find_out for one in known.absent), key


SHOWS = {
    "sn300g5": sn300g5.SHOWS,
    "jscc": jscc.SHOWS,
    "chf": chf.SHOWS,
    "gd200a": gd200a.SHOWS,
    "powerflex_4": powerflex_4.SHOWS,
    **{name: each.SHOWS for name, each in SISTERS.items()},
}


@pytest.mark.parametrize("drive", DRIVES)
def test_the_pins_show_what_the_manual_says(drive: str) -> None:
    assert list(shown(DRIVES[drive])) == SHOWS[drive].strip().splitlines()
    assert not DRIVES[drive].manual.second_hand
    assert DRIVES[drive].operation.in_one_word
    assert not DRIVES[drive].operation.states


def shown(drive: Drive) -> Iterator[str]:
    """What the pins show, a line for each."""
    for status in drive.operation.status:
        yield f"{status.shows} | {', '.join(map(asked, status.any))}"
    for measured in drive.operation.measures:
        yield f"{measured.shows} | {measured.register:04X}H"
    present, bits = drive.faults.present, drive.faults.bits
    yield f"fault code | {f'{bits.first:04X}H-{bits.last:04X}H' if bits else f'{present:04X}H'}"


def asked(one: Condition) -> str:
    """A condition as the tables of facts write it."""
    bit = f".{one.bit.first:X}" if one.bit else ""
    mask = f" AND {one.mask}" if one.mask is not None else ""
    return f"{one.register:04X}H{bit}{mask} = {one.equals}"


def crc(body: bytes) -> bytes:
    """CRC-16 of Modbus, low byte first, as the C function of both Chinese manuals has it."""
    value = 0xFFFF
    for byte in body:
        value ^= byte
        for _ in range(8):
            value = (value >> 1) ^ 0xA001 if value & 1 else value >> 1
    return value.to_bytes(2, "little")


def octets(text: str) -> bytes:
    """A frame as typed: RTU bytes, or ASCII characters to which CR LF belong."""
    return text.encode() + b"\r\n" if text.startswith(":") else bytes.fromhex(text)


@pytest.mark.parametrize("drive", DRIVES)
def test_every_correct_frame_has_the_checksum_of_its_bytes(drive: str) -> None:
    for frame in DRIVES[drive].frames:
        if frame.mode == "rtu":
            assert crc(frame.correct[:-2]) == frame.correct[-2:], frame.id
        else:
            assert frame.correct[-2:] == b"\r\n", frame.id
            assert sum(bytes.fromhex(frame.correct[1:-2].decode())) % 256 == 0, frame.id


def named(drive: Drive) -> Iterator[tuple[str, str, str]]:
    """Place, English and Chinese of everything that a map names in its tables."""
    for address, row in rows(drive).items():
        if row.name and address == row.address.first:
            yield f"{address:04X}H", row.name, bare(row.text_zh)
        for bit in row.bits:
            if bit.name:
                yield f"{address:04X}H.{bit.bit.first:X}", bit.name, bare(bit.text_zh)
        for value in (*row.values, *(value for bit in row.bits for value in bit.values)):
            yield f"{address:04X}H = {value.value}", value.name, bare(value.text_zh)
    for fault in drive.faults.codes:
        yield f"fault {fault.code}", fault.name, bare(fault.text_zh)
    for setting in drive.settings:
        yield setting.id, setting.name, bare(setting.text_zh)
        for one in setting.values:
            yield f"{setting.id} = {one.value}", one.name, bare(one.text_zh)


@pytest.mark.parametrize("drive", DRIVES)
def test_english_names_hold_what_the_chinese_terms_mean(drive: str) -> None:
    missing = []
    for place, english, chinese in named(DRIVES[drive]):
        said = re.sub("|".join([*glossary.APART, *given_elsewhere(drive, place)]), "", chinese)
        missing += [
            f"{place} {english} | {chinese}: {term}"
            for term, pattern in glossary.TERMS.items()
            if term in said and not re.search(pattern, english, re.IGNORECASE)
        ]
    assert missing == []


def given_elsewhere(drive: str, place: str) -> list[str]:
    """The Chinese term that a name leaves because another document has a better one."""
    found = {f"{address:04X}H": term for address, (_, term, _) in sn300g5.CORROBORATED.items() if term}
    return [found[place]] if drive == "sn300g5" and place in found else []


def test_a_name_that_says_more_than_the_chinese_rests_on_a_document() -> None:
    found = rows(SN)
    for address, (name, _, document) in sn300g5.CORROBORATED.items():
        assert found[address].name == name, f"{address:04X}H"
        assert document in {one.document for one in found[address].corroborated}, f"{address:04X}H"
    for address, name in sn300g5.LITERAL.items():
        assert (found[address].name, found[address].corroborated) == (name, ()), f"{address:04X}H"
    assert {one.id: one.name for one in SN.faults.codes}["UV3"] == "MC fault"
    assert {one.code: one.name for one in JS.faults.codes}[10] == "Motor thermal overload protection"


def test_english_names_have_the_numbers_of_the_chinese() -> None:
    for address, row in rows(SN).items():
        if not row.name or address in glossary.UNNUMBERED or "次" in bare(row.text_zh):  # ordinals are words in English
            continue
        assert re.findall(r"\d+", row.name) == re.findall(r"\d+", row.text_zh or ""), f"{address:04X}H"


def test_a_fault_has_one_english_name_in_bits_and_codes() -> None:
    found = rows(SN)
    bits = {bit.id: bit.name for word in range(0x14, 0x19) for bit in found[word].bits if bit.id}
    assert {one.id: one.name for one in SN.faults.codes} == bits
    fault_type = {one.value: one.name for one in rows(JS)[0x3000].values if one.value}
    assert {one.code: one.name for one in JS.faults.codes} == fault_type
    refused = {one.value: one.name for one in rows(CH)[0x5001].values if one.value}
    assert {one.code: one.name for one in CH.errors.codes} == refused


def test_a_busy_drive_is_asked_again() -> None:
    """CHF, its table of errors, code 8; JSCC, "slave device busy", 6 of the standard; SN300G5, 24H by its note."""
    assert [one.code for one in CH.errors.codes if one.busy] == [8]
    assert [number for number, one in enumerate(JS.errors.codes, start=1) if one.busy] == [6]
    assert [one.code for one in SN.errors.codes if one.busy] == [0x24]


def test_corroborated_codes_are_those_of_the_map() -> None:
    assert {c.value for one in SN.errors.codes for c in one.corroborated} == {one.code for one in SN.errors.codes}
    for one in SN.errors.codes:
        assert {c.value for c in one.corroborated} == {one.code}
    for number, error in enumerate(JS.errors.codes, start=1):
        assert {c.value for c in error.corroborated} == {number}


def by_id(frames: Iterable[Frame]) -> dict[str, Frame]:
    """Frames by their names."""
    return {frame.id: frame for frame in frames}


# ---------------------------------------------------------------- SN300G5


def test_sn300g5_addresses_are_those_of_sections_i_to_vi() -> None:
    listed = {address for address, _, _ in runs(sn300g5.MONITORS)}
    parameters = {address for address, _, _ in runs(sn300g5.PARAMETERS)}
    user = set(range(0x0106, 0x0126))
    assert len(listed) == 48
    assert len(parameters) == 291
    words = {*sn300g5.COMMANDS, *sn300g5.STATUS, sn300g5.ENTER}
    assert set(rows(SN)) == listed | parameters | user | words | sn300g5.UNUSED


def test_sn300g5_access() -> None:
    given = access(SN)
    for address in given:
        readable = 0x0010 <= address < 0x0100
        assert given[address] == ("r" if readable else "w" if address == sn300g5.ENTER else "rw"), f"{address:04X}H"


@pytest.mark.parametrize("table", [sn300g5.MONITORS, sn300g5.PARAMETERS], ids=["monitors", "parameters"])
def test_sn300g5_parameters_have_their_ids_and_names(table: str) -> None:
    found = rows(SN)
    for address, id_, name in runs(table):
        row = found[address]
        assert (row.id, bare(row.text_zh)) == (id_, bare(name)), f"{address:04X}H"
        assert len(row.address) == 1


def test_sn300g5_user_parameters_are_32_registers() -> None:
    first, last, id_, end, name = sn300g5.USER_PARAMETERS
    row = rows(SN)[first]
    assert (row.address.first, row.address.last, row.id, row.zh) == (first, last, f"{id_}..{end}", name)


def test_sn300g5_words_of_section_i() -> None:
    found = rows(SN)
    for address, name in (sn300g5.COMMANDS | sn300g5.STATUS).items():
        assert (found[address].id, bare(found[address].text_zh)) == (None, name), f"{address:04X}H"
    assert {address for address, row in found.items() if row.unused} == sn300g5.UNUSED


def test_sn300g5_rows_stand_in_the_manuals_order() -> None:
    section = next(one for one in SN.sections if one.id == "parameters")
    order = [address for row in section.registers for address in row.address]
    wanted = [address for address in spans(sn300g5.ORDER) if address not in range(0x0126, 0x0180)]
    assert order == wanted
    for one in SN.sections:
        if one is not section:
            here = [address for row in one.registers for address in row.address]
            assert here == sorted(here), one.id


def told(bit: Bit) -> str:
    """A bit as the tables of facts write it."""
    where = f"{bit.bit.first:X}" if len(bit.bit) == 1 else f"{bit.bit.first:X}-{bit.bit.last:X}"
    return " ".join([where, "-"] if bit.unused else [where, *([bit.id] if bit.id else []), bare(bit.text_zh)])


def test_sn300g5_bits() -> None:
    found = {address: row for address, row in rows(SN).items() if row.bits}
    assert set(found) == set(sn300g5.BITS)
    for address, table in sn300g5.BITS.items():
        assert [told(bit) for bit in found[address].bits] == table.strip().splitlines(), f"{address:04X}H"


def test_sn300g5_values_of_bits_and_fields() -> None:
    held = {
        (address, bit.bit.first): {value.value: bare(value.text_zh) for value in bit.values}
        for address, row in rows(SN).items()
        for bit in row.bits
        if bit.values
    }
    assert held == sn300g5.FIELDS
    assert not any(row.values for row in rows(SN).values())


def test_sn300g5_only_frequencies_have_a_scale() -> None:
    scaled = {address: row for address, row in rows(SN).items() if row.scale or row.unit}
    assert set(scaled) == sn300g5.HERTZ
    for row in scaled.values():
        assert row.unit == "Hz"
        assert row.scale is not None
        assert row.scale.factor == Decimal("0.01")
        when = row.scale.when
        assert when is not None
        assert when.bit is not None
        assert (when.register, when.bit.first, when.bit.last, when.equals) == (0x000F, 0, 0, 0)


def test_sn300g5_analog_outputs_are_signed_counts() -> None:
    for address, row in rows(SN).items():
        if address in (0x0007, 0x0008):
            assert row.signed
            assert row.range is not None
            assert (row.range.min, row.range.max) == (-726, 726)
        else:
            assert not row.signed
            assert row.range is None


def test_sn300g5_faults() -> None:
    lines = (*sn300g5.FAULTS.strip().splitlines(), *sn300g5.CPF_FAULTS.strip().splitlines())
    wanted = [line.split(" ", 2) for line in lines]
    assert [[f"{one.code:02X}", one.id, bare(one.text_zh)] for one in SN.faults.codes] == [
        [code, id_, bare(text)] for code, id_, text in wanted
    ]
    printed = {one.code: one.printed_code for one in SN.faults.codes if one.printed_code}
    assert printed == sn300g5.PRINTED_CODES
    assert {address for span in SN.faults.registers for address in span} == sn300g5.FAULT_REGISTERS


def test_sn300g5_fault_number_is_16_x_word_plus_bit_plus_1() -> None:
    codes = {one.id: one.code for one in SN.faults.codes}
    found = rows(SN)
    bits = {bit.id: (word, bit.bit.first) for word in range(0x14, 0x19) for bit in found[word].bits if bit.id}
    assert codes == {id_: 16 * (word - 0x14) + bit + 1 for id_, (word, bit) in bits.items()}
    assert SN.faults.bits is not None
    assert (SN.faults.bits.first, SN.faults.bits.last) == (0x14, 0x18)


def test_sn300g5_errors_by_their_meaning() -> None:
    held = {
        one.code: (
            bare(one.text_zh),
            bare(one.meaning.zh_used or one.meaning.zh) if one.meaning else "",
            [bare(cause.zh_used or cause.zh) for cause in one.causes],
        )
        for one in SN.errors.codes
    }
    assert held == sn300g5.ERRORS
    assert SN.errors.form is not None
    assert (SN.errors.form.kind, SN.errors.form.add) == ("exception", 0x80)


def test_sn300g5_settings() -> None:
    held = {
        one.id: (
            one.register,
            one.range.min if one.range else None,
            one.range.max if one.range else None,
            one.default,
            [bare(value.zh) for value in one.values],
        )
        for one in SN.settings
    }
    assert held == sn300g5.SETTINGS
    assert all([value.value for value in one.values] == list(range(len(one.values))) for one in SN.settings)
    assert {one.id: one.needed.value for one in SN.settings if one.needed and one.needed.value} == {
        "B1-01": 2,
        "B1-02": 2,
        "H5-05": 1,
    }


def test_sn300g5_watchdog_is_h5_04_and_h5_05() -> None:
    watchdog = SN.watchdog
    assert watchdog is not None
    assert (watchdog.chosen_by, {one.value: one.does for one in watchdog.reactions}) == ("H5-04", sn300g5.REACTIONS)
    assert watchdog.disabled_by is not None
    assert (watchdog.disabled_by.setting, watchdog.disabled_by.value, watchdog.fault) == ("H5-05", 0, 0x21)
    assert (watchdog.feeds, watchdog.time) == (None, None)
    noted = {one.code: one.note or "" for one in SN.faults.codes}[0x21]
    assert all("2 s before the reset signal" in text for text in (noted, watchdog.note or ""))
    assert "without communication" in noted


def test_sn300g5_settings_that_may_stop_another_way_or_act_later_say_so() -> None:
    settings = {one.id: one for one in SN.settings}
    for one in (each for each in SN.settings if each.source == "table of communication parameters"):
        assert "acts only after the supply was switched off and on" in (one.note or ""), one.id
    for value, other in ((1, "coast"), (2, "decelerate")):
        note = settings["H5-04"].values[value].note or ""
        assert "another drive" in note, value
        assert other in note, value
    for id_, words in (("B1-03", "by a ramp or by coasting"), ("O2-01", "the keypad is in control")):
        needed = settings[id_].needed
        assert needed is not None
        assert words in needed.why
    for id_ in ("H5-01", "H5-02", "H5-03"):
        assert "taken over at power-up" in (settings[id_].note or ""), id_


def test_sn300g5_refusals_list_attempts_and_forbid_nothing() -> None:
    """Lines 22H to 24H of the table name what the PLC tried as a cause, and not what it may not do."""
    note = next(one for one in SN.sections if one.id == "parameters").note or ""
    assert "an attempt to write a parameter while the drive runs is listed as a cause" in note
    about = [one for one in SN.notices if any(ref.startswith("error 2") for ref in one.about)]
    assert len(about) == 4
    assert all(one.kind == "warning" and re.match("Causes? of error 2[234]H: ", one.text.en) for one in about)


def test_sn300g5_reasons_of_errata_hold_for_every_row() -> None:
    found = rows(SN)
    times = next(one for one in SN.errata if "转矩补偿参数" in one.printed)
    for address in (int(one.split()[1][:-1], 16) for one in times.about):
        gain = "系数" in (found[address - 1].text_zh or "")
        assert gain or "时" in (found[address].zh or ""), f"{address:04X}H"
    enter = next(one for one in SN.errata if "上位 BCH" in one.printed)
    assert len(by_id(SN.frames)["enter_request"].correct[:-2]) == 9
    assert "nine bytes" in enter.why


def test_sn300g5_line() -> None:
    line = SN.serial
    assert bare(line.interface.zh) == "RS485硬件接口"
    assert line.mode.modes == ("rtu",)
    assert line.baud is not None
    assert ({one.code: one.baud for one in line.baud.codes}, line.baud.default) == (sn300g5.BAUD, 3)
    assert line.format is not None
    assert ({one.code: one.parity for one in line.format.codes}, line.format.default) == (sn300g5.PARITY, 1)
    assert {(one.data_bits, one.stop_bits) for one in line.format.codes} == {(8, None)}
    assert (line.unit.min, line.unit.max, line.unit.default) == (1, 0x20, 0x1F)
    assert line.silence is not None
    assert (line.silence.characters, line.silence.gap_characters) == (Decimal("3.5"), Decimal("1.5"))
    assert line.silence.milliseconds is None
    assert line.broadcast is not None
    assert (line.broadcast.address, line.broadcast.replies, line.broadcast.start_addresses) == (0, False, (0, 1, 2))


def test_sn300g5_limits_and_functions() -> None:
    assert SN.limits.read_words is not None
    assert SN.limits.write_words is not None
    assert (SN.limits.read_words.value, SN.limits.write_words.value) == (16, 16)
    assert {one.code: bare(one.zh) for one in SN.functions} == {
        0x03: "读多个寄存器参数",
        0x10: "写多个寄存器参数",
        0x08: "回路侦测",
    }
    assert [sub.code for one in SN.functions for sub in one.sub_functions] == [0]


def test_sn300g5_commands_reference_and_storage() -> None:
    moves = {
        one.does: (one.register, [bit for span in one.set for bit in span], [bit for span in one.clear for bit in span])
        for one in SN.operation.commands
    }
    assert moves == {"run_forward": (0, [0], [1]), "run_reverse": (0, [1], [0]), "stop": (0, [], [0, 1])}
    assert all(one.value is None for one in SN.operation.commands)
    reference = SN.operation.reference
    assert (reference.register, reference.means, reference.negative_reverses) == (1, "frequency", False)
    verified = [(one.register, one.bit.first if one.bit else None, one.equals) for one in reference.verify]
    assert verified == [(0x000F, 0, 0)]
    storage = SN.storage
    assert (storage.method, storage.register, storage.value, storage.max_writes) == (
        "enter_register",
        0xFFFD,
        0,
        100_000,
    )


def test_sn300g5_standstill_is_not_running_zero_speed_and_no_frequency() -> None:
    held = [(one.register, one.bit.first if one.bit else None, one.equals) for one in SN.operation.standstill.all]
    assert held == [(0x0010, 0, 0), (0x0010, 1, 1), (0x0021, None, 0)]


def test_sn300g5_frames() -> None:
    found = by_id(SN.frames)
    assert list(found) == list(sn300g5.FRAMES)
    for id_, (text, direction, address, words, quantity) in sn300g5.FRAMES.items():
        frame = found[id_]
        assert frame.printed == frame.correct == octets(text), id_
        assert (frame.checksum, frame.direction, frame.mode) == ("right", direction, "rtu"), id_
        means = frame.means
        assert (means.unit, means.function, means.address) == (1, octets(text)[1], address), id_
        assert (means.values, means.words) == (words, quantity), id_
        loop = (0x0000, 0x12AB) if means.function == 8 else (None, None)
        assert (means.sub_function, means.data) == loop, id_


def test_sn300g5_printed_ids_and_addresses() -> None:
    printed = {row.address.first: row.printed for row in rows(SN).values() if row.printed}
    ids = {address: one.id for address, one in printed.items() if one.id and address != 0x0106}
    assert ids == sn300g5.PRINTED_IDS
    assert {address: one.address for address, one in printed.items() if one.address} == sn300g5.PRINTED_ADDRESSES
    torn = {(address, bit.bit.first): bit.printed for address, row in rows(SN).items() for bit in row.bits}
    assert {place: one.id or one.bit for place, one in torn.items() if one} == sn300g5.PRINTED_BITS


def test_sn300g5_series_start_where_their_first_id_is() -> None:
    typed = {id_: address for table in (sn300g5.MONITORS, sn300g5.PARAMETERS) for address, id_, _ in runs(table)}
    first, _, id_, _, _ = sn300g5.USER_PARAMETERS
    typed[id_] = first
    series = [one for section in SN.sections for one in section.series]
    assert {one.ids.partition("..")[0]: one.base for one in series} == {
        id_: address for id_, address in typed.items() if id_ == "A1-00" or (id_ != "A1-01" and id_.endswith("-01"))
    }
    assert {id_ for one in series for id_ in one.apart} == {"C3-05", "C5-08", "F1-14"}


# ---------------------------------------------------------------- JSCC


def test_jscc_registers() -> None:
    ways = access(JS)
    assert {address: (bare(row.text_zh), ways[address]) for address, row in rows(JS).items()} == jscc.REGISTERS
    assert not any(row.unused or row.bits for row in rows(JS).values())
    assert {address for address, row in rows(JS).items() if row.masks} == {0x2001}


def test_jscc_values_and_faults() -> None:
    held = {address: {one.value: bare(one.text_zh) for one in row.values} for address, row in rows(JS).items()}
    assert {address: values for address, values in held.items() if values} == jscc.VALUES
    assert {one.code: bare(one.text_zh) for one in JS.faults.codes} == jscc.FAULTS
    assert [(span.first, span.last) for span in JS.faults.registers] == [(0x3000, 0x3000)]


def test_jscc_only_the_output_frequency_has_a_scale() -> None:
    scaled = {address: row for address, row in rows(JS).items() if row.scale or row.unit}
    assert set(scaled) == {0x2000}
    scale = scaled[0x2000].scale
    assert scale is not None
    assert (scaled[0x2000].unit, scale.factor, scale.when, scale.proof) == (
        "Hz",
        Decimal("0.1"),
        None,
        "read_frequency_rtu_reply",
    )


def test_jscc_commands_and_standstill() -> None:
    operation = JS.operation
    assert {one.does: one.value for one in operation.commands} == jscc.COMMANDS
    assert {one.register for one in operation.commands} == {0x1000}
    assert not any(one.set or one.clear for one in operation.commands)
    assert (operation.reference.register, operation.reference.means) == (0x1001, "frequency")
    assert [(one.register, one.bit, one.equals) for one in operation.standstill.all] == [
        (0x2001, None, 4),
        (0x2000, None, 0),
    ]


def test_jscc_settings() -> None:
    held = {
        one.id: (one.default, one.needed.value if one.needed else None, [bare(value.zh) for value in one.values])
        for one in JS.settings
    }
    assert held == jscc.SETTINGS
    assert all([value.value for value in one.values] == list(range(1, len(one.values) + 1)) for one in JS.settings)
    ranges = {one.id: (one.range.min, one.range.max) for one in JS.settings if one.range}
    assert ranges == {"FA.00": (1, 247)}


def test_jscc_line() -> None:
    line = JS.serial
    assert set(line.mode.modes) == {"rtu", "ascii"}
    assert ({one.code: one.mode for one in line.mode.codes}, line.mode.default) == (jscc.MODE, 2)
    assert line.baud is not None
    assert ({one.code: one.baud for one in line.baud.codes}, line.baud.default) == (jscc.BAUD, 3)
    assert line.format is not None
    held = {one.code: (one.data_bits, one.parity, one.stop_bits) for one in line.format.codes}
    assert (held, line.format.default) == (jscc.FORMAT, 2)
    assert (line.unit.min, line.unit.max, line.unit.default) == (1, 247, 1)
    assert line.silence is not None
    assert (line.silence.milliseconds, line.silence.characters) == (Decimal(10), None)
    assert line.broadcast is None


def test_jscc_limits_functions_and_parameters() -> None:
    limits = JS.limits
    assert limits.data_bytes is not None
    assert limits.ascii_data_bytes is not None
    assert (limits.data_bytes.value, limits.ascii_data_bytes.value) == (25, 25)
    assert limits.read_words is None
    assert limits.write_words is None
    assert [one.code for one in JS.functions] == [0x03, 0x06, 0x10]
    area = JS.areas[0]
    assert (area.addresses.first, area.addresses.last, area.numbered_by) == (0x0000, 0x00FF, "parameter_number")
    assert [(one.id, one.number, one.address) for one in area.examples] == [("F-18", 18, 0x0012)]
    assert JS.storage.method == "unexplained"


def test_jscc_errors_have_no_codes_and_no_form() -> None:
    assert [(one.code, bare(one.zh)) for one in JS.errors.codes] == [(None, text) for text in jscc.ERRORS]
    assert JS.errors.form is None


def test_jscc_frames() -> None:
    found = by_id(JS.frames)
    assert list(found) == list(jscc.FRAMES)
    for id_, (text, address, words) in jscc.FRAMES.items():
        frame = found[id_]
        assert frame.printed == frame.correct == octets(text), id_
        assert frame.checksum == "right", id_
        assert frame.direction == id_.rpartition("_")[2], id_
        means = frame.means
        assert (means.unit, means.address, means.values) == (1, address, words), id_
        hertz = [(one.register, one.value, one.unit) for one in means.quantities]
        assert hertz == ([(0x2000, Decimal("50.0"), "Hz")] if words == (500,) else []), id_


def test_jscc_tables_of_plc_registers() -> None:
    for id_, (first, bits, text, misprint) in jscc.TABLES.items():
        table = by_id(JS.frames)[id_].plc
        assert table is not None, id_
        contents = text.split()
        assert (table.first, table.bits, list(table.registers)) == (first, bits, contents), id_
        if misprint is not None:
            contents[misprint[0]] = misprint[1]
        assert list(table.printed or table.registers) == contents, id_


# ---------------------------------------------------------------- CHF


def test_chf_registers() -> None:
    ways = access(CH)
    assert {address: (bare(row.text_zh), ways[address]) for address, row in rows(CH).items()} == chf.REGISTERS
    assert {address for address, row in rows(CH).items() if row.unused} == chf.RESERVED
    assert [one.id for one in CH.settings] == ["P0.04"]
    assert not any(row.bits or row.masks for row in rows(CH).values())


def test_chf_values_and_errors() -> None:
    held = {address: {one.value: bare(one.text_zh) for one in row.values} for address, row in rows(CH).items()}
    assert {address: values for address, values in held.items() if values} == chf.VALUES
    assert {one.code: bare(one.text_zh) for one in CH.errors.codes} == chf.ERRORS
    form = CH.errors.form
    assert form is not None
    assert (form.kind, form.function, form.address) == ("write_reply", 0x06, 0x5001)
    assert [(span.first, span.last) for span in CH.faults.registers] == [(0x5000, 0x5000)]
    assert CH.faults.codes == ()


def test_chf_only_the_communication_setting_has_a_scale() -> None:
    scaled = {address: row for address, row in rows(CH).items() if row.scale or row.unit or row.signed or row.range}
    assert set(scaled) == {0x2000}
    row = scaled[0x2000]
    assert row.scale is not None
    assert row.range is not None
    assert (row.unit, row.scale.factor, row.signed) == ("%", Decimal("0.01"), True)
    assert (row.range.min, row.range.max) == (-10000, 10000)


def test_chf_commands_reference_and_standstill() -> None:
    operation = CH.operation
    assert {one.does: one.value for one in operation.commands} == chf.COMMANDS
    assert {one.register for one in operation.commands} == {0x1000}
    reference = operation.reference
    assert (reference.register, reference.means, reference.maximum) == (0x2000, "percent_of_maximum", "P0.04")
    assert reference.negative_reverses
    assert [(one.register, one.bit, one.equals) for one in operation.standstill.all] == [
        (0x1001, None, 3),
        (0x3000, None, 0),
    ]


def test_chf_line_limits_and_functions() -> None:
    line = CH.serial
    assert bare(line.interface.zh) == "RS485硬件接口"
    assert set(line.mode.modes) == {"rtu", "ascii"}
    assert line.baud is None
    assert line.format is None
    assert (line.unit.min, line.unit.max, line.unit.default) == (1, 247, None)
    assert line.silence is not None
    assert (line.silence.characters, line.silence.gap_characters) == (Decimal("3.5"), Decimal("1.5"))
    assert line.broadcast is not None
    assert (line.broadcast.address, line.broadcast.replies, line.broadcast.start_addresses) == (0, False, ())
    limits = {key: getattr(CH.limits, key) for key in ("read_words", "write_words", "data_bytes", "ascii_data_bytes")}
    assert {key: one.value for key, one in limits.items() if one} == {
        "read_words": 16,
        "write_words": 1,
        "ascii_data_bytes": 16,
    }
    assert {one.code: bare(one.zh) for one in CH.functions} == {0x03: "读从机参数", 0x06: "写从机参数"}


def test_chf_function_codes_and_their_ram_only_addresses() -> None:
    area = CH.areas[0]
    assert (area.addresses.first, area.addresses.last, area.numbered_by) == (0x0000, 0x01FF, "sequence_number")
    assert [(one.id, one.number, one.address) for one in area.examples] == [
        ("P5.05", 58, 0x003A),
        ("P0.07", 7, 0x0007),
    ]
    assert [one.ids for one in area.excluded] == ["PE"]
    storage = CH.storage
    assert (storage.method, storage.add, storage.area, storage.readable) == (
        "ram_address_bit",
        0x8000,
        area.id,
        False,
    )


def test_chf_frames_and_the_one_wrong_crc() -> None:
    found = by_id(CH.frames)
    assert list(found) == list(chf.FRAMES)
    wrong, printed, owner = chf.WRONG_CRC
    for id_, (text, unit, address, words) in chf.FRAMES.items():
        frame = found[id_]
        assert frame.correct == octets(text), id_
        assert frame.printed == octets(printed if id_ == wrong else text), id_
        assert frame.checksum == ("wrong" if id_ == wrong else "right"), id_
        assert (frame.means.unit, frame.means.address, frame.means.values) == (unit, address, words), id_
        assert frame.means.error == (5 if "error" in id_ else None), id_
    assert found[wrong].printed_checksum_of == octets(owner)
    assert crc(octets(owner)) == octets(printed)[-2:]


def test_chf_alone_tolerates_a_byte_count_of_two_bytes() -> None:
    assert [one.kind for one in CH.tolerances] == ["two_byte_count"]
    assert SN.tolerances == JS.tolerances == ()


# ---------------------------------------------------------------- PowerFlex 4


def places(bit: Bit) -> str:
    """Bit numbers as the manual prints them: decimal, the highest first."""
    return ",".join(map(str, sorted(bit.bit, reverse=True)))


def plainly(text: str) -> str:
    """A name without the manual's short forms and capitals."""
    longer = (("HW ", "Hardware "), ("Cmd", "Command"), ("(300%)", "(300 %)"), ("Params ", "Parameters "))
    for short, long in (*longer, ("Net Loss", "Network Loss"), ("Comm Loss", "Communication Loss")):
        text = text.replace(short, long)
    return text.lower()


def test_powerflex_4_bits_and_faults() -> None:
    found = rows(PF)
    for address, table in ((8192, powerflex_4.COMMAND), (8448, powerflex_4.STATUS)):
        bits = [f"{places(bit)} {'-' if bit.unused else bit.name}" for bit in found[address].bits]
        assert [plainly(each) for each in bits] == [plainly(each) for each in table.split("|")]
    assert [one.name for one in found[8192].bits[4].values] == powerflex_4.DIRECTION
    printed = [each.strip().split(" ", 1) for each in powerflex_4.FAULTS.strip().split("|")]
    assert [[str(one.code), plainly(one.name)] for one in PF.faults.codes] == [
        [code, plainly(name)] for code, name in printed
    ]


def test_powerflex_4_commands_are_words_of_the_table_and_no_stop_runs() -> None:
    words = {}
    for one in PF.operation.commands:
        set_, cleared = ({place for span in spans for place in span} for spans in (one.set, one.clear))
        words[one.does] = sum(1 << place for place in set_)
        assert one.register == 8192
        assert sum(1 << place for place in set_ | cleared) == powerflex_4.TOUCHED
        assert not set_ & cleared
    assert words == powerflex_4.WORDS
    assert {address for address, row in rows(PF).items() if row.scale and str(row.scale.factor) == "0.1"} == (
        powerflex_4.TENTHS
    )


def test_powerflex_40_is_the_same_by_its_own_manual() -> None:
    found = rows(PF)
    faults = [each.strip().split(" ", 1) for each in " ".join(powerflex_4.FORTY_FAULTS.split()).split(",")]
    assert [[str(one.code), plainly(one.name)] for one in PF.faults.codes] == [
        [code, plainly(name)] for code, name in faults
    ]
    bits = {one.bit.first: plainly(one.name or "") for one in found[8192].bits}
    directions = found[8192].bits[4]
    for bit, name in powerflex_4.FORTY_BITS.items():
        assert bits[bit] == plainly(name)
    assert [plainly(one.name) for one in directions.values[1:3]] == [*map(plainly, powerflex_4.FORTY_DIRECTION)]
    status = [plainly(one.name or "") for one in found[8448].bits]
    assert [*map(plainly, powerflex_4.FORTY_STATUS)] == status[: len(powerflex_4.FORTY_STATUS)]
    for address, (raw, shown) in powerflex_4.FORTY_TENTHS.items():
        scale = found[address].scale
        assert scale is not None
        assert raw * scale.factor == Decimal(shown)


def test_powerflex_4_settings_and_what_it_does_without_its_line() -> None:
    held = {one.id: (one.register, one.default, one.needed.value if one.needed else None) for one in PF.settings}
    assert held == powerflex_4.SETTINGS
    assert all(one.register == int(one.id[1:]) for one in PF.settings)
    assert PF.serial.baud is not None
    assert PF.serial.format is not None
    assert PF.watchdog is not None
    assert {one.code: one.baud for one in PF.serial.baud.codes} == powerflex_4.BAUD
    assert {
        one.code: f"{one.data_bits}{one.parity[0].upper()}{one.stop_bits}" for one in PF.serial.format.codes
    } == powerflex_4.FORMAT
    assert {one.value: one.does for one in PF.watchdog.reactions} == powerflex_4.SILENT


@pytest.mark.parametrize("drive", SISTERS)
def test_a_sister_of_the_powerflex_4_has_the_bits_and_faults_of_its_own_manual(drive: str) -> None:
    typed, known = SISTERS[drive], DRIVES[drive]
    printed = dict(each.strip().split(" ", 1) for each in powerflex_4.FAULTS.strip().split("|"))
    printed |= dict(each.strip().split(" ", 1) for each in typed.faults.strip().split("|") if each)
    assert {str(one.code): plainly(one.name) for one in known.faults.codes} == {
        code: plainly(name) for code, name in printed.items() if int(code) not in typed.lacks or code in typed.faults
    }
    found = rows(known)
    for address, table in ((8192, typed.command), (8448, typed.status)):
        named = ((bit, "-" if bit.unused else plainly(bit.name or "")) for bit in found[address].bits)
        bits = {place: name for bit, name in named for place in bit.bit}
        for place, name in (each.split(" ", 1) for each in table.split("|")):
            assert bits[int(place)] == plainly(name)
    for place, name in (each.split(" ", 1) for each in powerflex_4.STATUS.split("|")[:9]):
        assert place == "6" or bits[int(place)] == plainly(name)  # the last table is that of 8448
    assert {tuple(one.bit): one.equals for one in found[8192].never} == dict(typed.never)


@pytest.mark.parametrize("drive", SISTERS)
def test_a_sister_of_the_powerflex_4_has_its_words_scales_and_settings(drive: str) -> None:
    typed, known = SISTERS[drive], DRIVES[drive]
    words = {one.does: sum(1 << place for span in one.set for place in span) for one in known.operation.commands}
    assert words == powerflex_4.WORDS
    for one in known.operation.commands:
        assert sum(1 << place for span in (*one.set, *one.clear) for place in span) == typed.touched
    scales = {at: str(row.scale.factor) for at, row in rows(known).items() if row.scale and row.unit == "Hz"}
    tenths = powerflex_4.TENTHS - typed.hundredths
    assert scales == dict.fromkeys(typed.hundredths, "0.01") | dict.fromkeys(tenths, "0.1")
    held = {one.id: (one.register, one.needed.value if one.needed else None) for one in known.settings}
    assert held == typed.settings
    assert all(one.register == int(one.id[1:]) for one in known.settings)
    assert known.operation.reference.register == 8193
    still = {(one.register, one.bit.first if one.bit else None, one.equals) for one in known.operation.standstill.all}
    assert still == {(8448, 1, 0), (8451, None, 0)}
    assert all(known.row_at(row) for row in (8192, 8193, 8448, 8449, 8451))


# ---------------------------------------------------------------- GD200A


def count(row: Register) -> str:
    """What one count is worth, as the tables of facts write it."""
    scale = row.scale
    return f"{scale.factor.normalize():f} {row.unit}" if scale else "-"


def test_gd200a_registers_are_those_of_9_5_2_and_what_one_count_is_worth() -> None:
    found, may = rows(GD), access(GD)
    for table, given in ((gd200a.WRITTEN, "rw"), (gd200a.READ, "r")):
        listed = dict(line.split(" ", 1) for line in table.strip().splitlines())
        addresses = [address for address in found if address >= 0x2000 and may[address] == given]
        assert {f"{address:04X}H": count(found[address]) for address in addresses} == listed


def test_gd200a_settings_are_at_their_codes_and_must_be_what_the_bus_wants() -> None:
    made = []
    for one in GD.settings:
        must = "-" if one.needed is None or one.needed.value is None else one.needed.value
        made.append(f"{one.id} {one.register:04X}H {one.default} {must}")
        assert one.register is not None
        group, number = one.id.removeprefix("P").split(".")
        assert one.register == int(group) << 8 | int(number)
        assert rows(GD)[one.register].id == one.id
    assert made == gd200a.SETTINGS.strip().splitlines()


def test_gd200a_commands_its_faults_and_what_its_pins_show_are_the_manuals() -> None:
    commands = GD.operation.commands
    assert {one.does: one.value for one in commands} == gd200a.COMMANDS
    assert {one.register for one in commands} == {0x2000}
    assert ",".join(f"{one.code} {one.id}" for one in GD.faults.codes) == gd200a.FAULTS
    assert list(shown(GD)) == gd200a.SHOWS.strip().splitlines()
    assert [one.code for one in GD.errors.codes] == list(range(1, 10))


def test_gd200a_function_codes_are_stored_unless_their_address_has_8000h() -> None:
    storage = GD.storage
    assert (storage.method, storage.add, storage.readable) == ("ram_address_bit", 0x8000, False)
    codes = {address for address in rows(GD) if address < 0x2000}
    assert {address for span in GD.ram_only for address in span} == {address + 0x8000 for address in codes}


def test_gd200a_line_speaks_as_p14_01_and_p14_02_say() -> None:
    assert GD.serial.baud is not None
    assert [(one.code, one.baud) for one in GD.serial.baud.codes] == list(enumerate(gd200a.RATES))
    assert GD.serial.format is not None
    made = [f"{one.data_bits}{one.parity[0].upper()}{one.stop_bits}" for one in GD.serial.format.codes]
    assert [one.code for one in GD.serial.format.codes] == list(range(18))
    assert made == gd200a.FORMATS.split()
    modes = [one.mode for one in GD.serial.mode.codes]
    assert modes == ["rtu"] * 6 + ["ascii"] * 12


def test_gd200a_frames_with_a_wrong_checksum() -> None:
    wrong = [frame.id for frame in GD.frames if frame.checksum == "wrong"]
    assert wrong == ["write_words_rtu_request", "write_words_rtu_reply"]
