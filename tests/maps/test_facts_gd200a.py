"""The map of Goodrive200A against its manual, typed by hand a second time. Only the loader is shared."""

from tests.maps.facts import gd200a
from tests.maps.test_facts import access, crc, rows, shown
from tests.shipped import drives

from driveblocks.maps.model import Register

GD = drives()["GD200A"]


def count(row: Register) -> str:
    """What one count is worth, as the tables of facts write it."""
    scale = row.scale
    return f"{scale.factor.normalize():f} {row.unit}" if scale else "-"


def test_its_registers_are_those_of_9_5_2_and_what_one_count_is_worth() -> None:
    found, may = rows(GD), access(GD)
    for table, given in ((gd200a.WRITTEN, "rw"), (gd200a.READ, "r")):
        listed = dict(line.split(" ", 1) for line in table.strip().splitlines())
        addresses = [address for address in found if address >= 0x2000 and may[address] == given]
        assert {f"{address:04X}H": count(found[address]) for address in addresses} == listed


def test_its_settings_are_at_their_codes_and_must_be_what_the_bus_wants() -> None:
    made = []
    for one in GD.settings:
        must = "-" if one.needed is None or one.needed.value is None else one.needed.value
        made.append(f"{one.id} {one.register:04X}H {one.default} {must}")
        assert one.register is not None
        group, number = one.id.removeprefix("P").split(".")
        assert one.register == int(group) << 8 | int(number)
        assert rows(GD)[one.register].id == one.id
    assert made == gd200a.SETTINGS.strip().splitlines()


def test_its_commands_its_faults_and_what_its_pins_show_are_the_manuals() -> None:
    commands = GD.operation.commands
    assert {one.does: one.value for one in commands} == gd200a.COMMANDS
    assert {one.register for one in commands} == {0x2000}
    assert ",".join(f"{one.code} {one.id}" for one in GD.faults.codes) == gd200a.FAULTS
    assert list(shown(GD)) == gd200a.SHOWS.strip().splitlines()
    assert [one.code for one in GD.errors.codes] == list(range(1, 10))


def test_its_line_speaks_as_p14_01_and_p14_02_say() -> None:
    assert GD.serial.baud is not None
    assert [(one.code, one.baud) for one in GD.serial.baud.codes] == list(enumerate(gd200a.RATES))
    assert GD.serial.format is not None
    made = [f"{one.data_bits}{one.parity[0].upper()}{one.stop_bits}" for one in GD.serial.format.codes]
    assert [one.code for one in GD.serial.format.codes] == list(range(18))
    assert made == gd200a.FORMATS.split()
    modes = [one.mode for one in GD.serial.mode.codes]
    assert modes == ["rtu"] * 6 + ["ascii"] * 12


def test_its_frames_have_the_checksums_of_their_bytes() -> None:
    for frame in GD.frames:
        if frame.mode == "rtu":
            assert crc(frame.correct[:-2]) == frame.correct[-2:], frame.id
        else:
            assert sum(bytes.fromhex(frame.correct[1:-2].decode())) % 256 == 0, frame.id
    wrong = [frame.id for frame in GD.frames if frame.checksum == "wrong"]
    assert wrong == ["write_words_rtu_request", "write_words_rtu_reply"]
