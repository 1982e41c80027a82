"""The numbers that the settings of a line must have for a unit address, a bit rate and a character."""

from collections.abc import Iterator

from driveblocks.maps.model import BaudChoice, Drive, FormatChoice, ModeChoice, StopBitsChoice
from driveblocks.meaning.serial import PARITIES, Character, serial
from driveblocks.modbus.frame import Mode

Choice = ModeChoice | BaudChoice | FormatChoice | StopBitsChoice


def chosen(drive: Drive, unit: int, rate: int, character: Character, mode: Mode | None = None) -> dict[str, int]:
    """Setting -> number; a setting that cannot be so is left out. Without a mode RTU, where the drive has it."""
    mode = mode or ("ascii" if serial(drive).ascii else "rtu")
    found = {drive.serial.unit.setting: unit} if drive.serial.unit.setting else {}
    for id_ in dict.fromkeys(each.setting for each in _choices(drive) if each.setting):
        some = [_codes(each, rate, character, mode) for each in _choices(drive) if each.setting == id_]
        number = min(set.intersection(*map(set, some)), default=None)
        if number is not None:
            found[id_] = number
    return found


def rates(drive: Drive) -> tuple[int, ...]:
    """The bit rates that a drive has; none where its map lists none."""
    return tuple(sorted(serial(drive).rates))


def forms(drive: Drive, mode: Mode | None = None) -> tuple[str, ...]:
    """The characters that a drive has in a framing, else in the one that is used; none where its map lists none."""
    found = dict.fromkeys(each for each in serial(drive).characters)
    asked = {each.setting for each in (drive.serial.format, drive.serial.stop_bits) if each and each.setting}
    return tuple(each.form for each in found if asked <= chosen(drive, 1, serial(drive).rate, each, mode).keys())


def _choices(drive: Drive) -> list[Choice]:
    line = drive.serial
    return [each for each in (line.mode, line.baud, line.format, line.stop_bits) if each is not None]


def _codes(choice: Choice, rate: int, character: Character, mode: Mode) -> Iterator[int]:
    """The codes of a setting that choose what is wanted."""
    for each in choice.codes:
        wanted = (
            ("mode", mode),
            ("baud", rate),
            ("data_bits", character.data),
            ("stop_bits", character.stops),
        )
        alike = all(getattr(each, key, None) in (None, value) for key, value in wanted)
        if each.code is not None and alike and PARITIES.get(getattr(each, "parity", ""), "?") in "?" + character.parity:
            yield each.code
