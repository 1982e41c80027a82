"""What is refused and which ids prove a register, on maps that no manual has."""

from dataclasses import replace

import pytest
from tests import families
from tests.shipped import drives

from driveblocks.maps.form import Span
from driveblocks.maps.model import Drive, Range, Step
from driveblocks.maps.plan import plan
from driveblocks.reference.permission import Judge, Write, parameters
from driveblocks.render.parameter import NumberAddress, ParameterAddress, addresses, may_write, passing


def with_id(id_: str, address: Span) -> Drive:
    """A drive whose only register with an id is this."""
    drive = drives()["JSCC"]
    row = replace(drive.sections[0].registers[2], id=id_, address=address)
    return replace(drive, sections=(replace(drive.sections[0], registers=(row,)),))


def with_step(register: int) -> Drive:
    """A drive whose run command begins with a write to another register."""
    drive = drives()["CHF"]
    run, *others = drive.operation.commands
    commands = (replace(run, first=(Step(register=register, value=1),)), *others)
    return replace(drive, operation=replace(drive.operation, commands=commands))


def test_what_is_sent_before_a_command_moves_the_motor_too() -> None:
    drive = with_step(0x0042)
    refused = {name: spans for name, _, spans in may_write(drive, plan(drive)).refused}
    assert {Span(0x0042, 0x0042), Span(0x8042, 0x8042)} <= set(refused["OWNED"])
    judge = Judge(drive)
    assert [judge.result(Write(at)) for at in (0x0042, 0x8042, 0x0043)] == ["OWNED", "OWNED", "OK"]


def test_what_is_refused_is_refused_at_its_address_in_ram_too() -> None:
    drive = drives()["GD200A"]
    judge = Judge(drive)
    refused = {name: spans for name, _, spans in may_write(drive, plan(drive)).refused}
    settings = [one.register for one in drive.settings if one.register is not None and not drive.adjusts(one)]
    assert {0x0001, 0x0003, 0x0006, 0x0E00} <= {*settings}
    for address in settings:
        for again in (address, address + 0x8000):
            assert any(again in span for span in refused["LINE_SETTING"])
            assert judge.result(Write(again, 1, unknown=True)) == "LINE_SETTING"


def test_limits_and_ramps_may_be_written_though_a_person_sets_them_too() -> None:
    free = {"GD200A": (0x0004, 0x0005, 0x000B, 0x000C), "ATV312": (0x0C21, 0x2329, 0x232A), "PF525": (0x29, 0x2A)}
    for name, places in free.items():
        drive = drives()[name]
        refused = {name: spans for name, _, spans in may_write(drive, plan(drive)).refused}
        for at in places:
            assert not any(at in span for span in refused["LINE_SETTING"])
            assert Judge(drive).result(Write(at, 1)) == "OK"


def test_the_maximum_that_the_full_scale_is_compared_with_is_refused() -> None:
    drive = drives()["ATV312"]
    assert drive.operation.own_maximum is not None
    at = drive.operation.own_maximum.register
    assert at in {one.register for one in drive.settings if drive.adjusts(one)}
    refused = {name: spans for name, _, spans in may_write(drive, plan(drive)).refused}
    assert any(at in span for span in refused["LINE_SETTING"])
    assert Judge(drive).result(Write(at, 500, unknown=True)) == "LINE_SETTING"


def test_a_write_after_which_the_next_is_stored_is_refused() -> None:
    drive = drives()["MX2"]
    assert any(0x0901 in span for span in may_write(drive, plan(drive)).fixed)
    assert {Judge(drive).result(Write(0x0901, 1, unknown=unknown)) for unknown in (False, True)} == {"NOT_WRITABLE"}


def test_a_parameter_may_be_written_to_ram_within_its_range() -> None:
    drive = drives()["GD200A"]
    *others, codes = drive.sections
    rows = [replace(row, range=Range(min=10, max=20)) if row.address.first == 4 else row for row in codes.registers]
    drive = replace(drive, sections=(*others, replace(codes, registers=tuple(rows))))
    allowed = plan(drive)
    assert any(0x8004 in span for span in allowed.writable)
    assert not any(0x8004 in span for span in allowed.readable)
    assert not any(0xA000 in span for span in allowed.writable)
    made = may_write(drive, allowed)
    assert [one.span.first for one in made.ranges if (one.min, one.max) == (10, 20)] == [0x0004, 0x8004]
    assert not any(0x8004 in span for span in made.fixed)
    judge = Judge(drive)
    assert [judge.result(Write(0x8004, value)) for value in (9, 10, 20, 21)] == ["RANGE", "OK", "OK", "RANGE"]


@pytest.mark.parametrize(
    ("id_", "parts"),
    [
        ("H5-02", ("H", 5, 2)),
        ("A40", ("A", 0, 40)),
        ("F-18", ("F", 0, 18)),
        ("20.01", ("", 20, 1)),
        ("b1-01", ("b", 1, 1)),
        ("0107", ("", 0, 107)),
        ("cL1-1", None),
        ("A1-B2", None),
    ],
)
def test_an_id_is_a_letter_a_group_and_a_number(id_: str, parts: tuple[str, int, int] | None) -> None:
    drive = with_id(id_, Span(0x0500, 0x0500))
    found = addresses(drive)
    if parts is None:
        assert isinstance(found, NumberAddress)
        return
    letter, group, number = parts
    assert isinstance(found, ParameterAddress)
    (run,) = found.letters[ord(letter or "\0")][group].runs
    assert (run.first, run.last, run.base) == (number, number, 0x0500)
    assert parameters(drive) == {parts: 0x0500}


def test_a_range_of_ids_is_one_run() -> None:
    drive = with_id("A2-01..A2-32", Span(0x0106, 0x0125))
    found = addresses(drive)
    assert isinstance(found, ParameterAddress)
    (run,) = found.letters[65][2].runs
    assert (run.first, run.last, run.base, run.away) == (1, 32, 0x0106, 0x0105)
    assert parameters(drive)["A", 2, 32] == 0x0125


def test_two_areas_prove_no_number() -> None:
    drive = drives()["CHF"]
    two = replace(drive, areas=(*drive.areas, replace(drive.areas[0], id="other", addresses=Span(0x0600, 0x0601))))
    assert addresses(two) is None
    assert parameters(two) == {}


def test_what_passes_keeps_to_the_drives_functions_and_limits() -> None:
    found = {prefix: passing(drive, plan(drive)) for prefix, drive in drives().items()}
    limits = {prefix: (one.read, one.most_read, one.most_written) for prefix, one in found.items()}
    assert limits == families.said("PASSING")
