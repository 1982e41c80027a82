"""The serial line of a drive: modes, bit rates, characters, addresses, pauses, and what it has as delivered."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from decimal import Decimal
from math import ceil

from driveblocks.maps.model import (
    BaudChoice,
    BaudCode,
    Drive,
    FormatChoice,
    FormatCode,
    ReplyDelay,
    StopBitsChoice,
    StopBitsCode,
    kept,
)
from driveblocks.meaning.citation import Citation, cited
from driveblocks.meaning.setting import setting
from driveblocks.modbus.frame import Mode

FORMS = ("8N1", "8E1", "8O1", "8N2", "7E1", "7O1", "7N2")
"""The characters that a line may have, as people write them."""
USUAL_RATE, USUAL_BITS = 9600, 10
"""What a line takes where a pin is 0; of a drive as delivered, where its manual does not say."""
PARITIES = {"none": "N", "odd": "O", "even": "E"}


@dataclass(frozen=True)
class Character:
    """A character: a start bit, data bits, parity and stop bits; where a manual does not say, 8N1."""

    data: int = 8
    parity: str = "N"
    stops: int = 1

    @property
    def bits(self) -> int:
        """Its time on the wire, in bits."""
        return 1 + self.data + (self.parity != "N") + self.stops

    @property
    def form(self) -> str:
        """As people write it."""
        return f"{self.data}{self.parity}{self.stops}"

    @property
    def parity_number(self) -> int:
        """The parity as ports have it: 0 none, 1 odd, 2 even."""
        return "NOE".index(self.parity)


def character(form: str) -> Character:
    """The character that a person has written: 8N1."""
    return Character(int(form[0]), form[1].upper(), int(form[2]))


@dataclass(frozen=True)
class Broadcast:
    """The address at which all drives listen, and the only start addresses there, where not all are good."""

    said: Citation
    address: int
    starts: tuple[int, ...]


@dataclass(frozen=True)
class Delay:
    """A keypad setting that lets the drive answer later: as delivered, at most, and for each count of it."""

    said: Citation
    setting: str
    factory_ms: int | None
    most_ms: int | None
    count_ms: Decimal


@dataclass(frozen=True)
class Serial:
    """The line as a drive has it; of rates and characters the factory's first."""

    said: tuple[Citation, ...]
    """That of the modes first."""
    interface: str
    modes: tuple[Mode, ...]
    rates: tuple[int, ...]
    characters: tuple[Character, ...]
    rate: int
    """As delivered; where the manual does not say, the usual one."""
    character: Character
    known: bool
    """The manual says so."""
    differs: bool
    """... of each edition something else."""
    units_said: Citation
    lowest: int
    """The unit addresses, from ... to."""
    highest: int
    factory: int | None
    """The unit address as delivered."""
    setting: str | None
    """The keypad setting of the address."""
    no_address: int | None
    """The number of it at which the drive answers nobody."""
    silence_ms: Decimal
    """What the drive wants around a frame, whatever the rate; 0: it says nothing of the kind."""
    silence_characters: Decimal | None
    broadcast: Broadcast | None
    delay: Delay | None

    @property
    def delay_ms(self) -> int:
        """How much later the drive answers as delivered, as far as it is known."""
        return (self.delay and self.delay.factory_ms) or 0

    @property
    def silence(self) -> bool:
        """Whether it wants some around a frame, in ms or in characters."""
        return bool(self.silence_ms or self.silence_characters)

    @property
    def ascii(self) -> bool:
        """Whether it speaks ASCII alone."""
        return "rtu" not in self.modes

    @property
    def silent(self) -> bool:
        """Whether the drive as delivered answers nobody."""
        return self.no_address is not None and self.no_address == self.factory


@kept
def serial(drive: Drive) -> Serial:
    """What a map says of the line."""
    told, unit, silence, cast = drive.serial, drive.serial.unit, drive.serial.silence, drive.serial.broadcast
    rates, forms = told.baud, told.format
    named = [(_factory(rates, each), each.baud) for each in rates.codes] if rates else []
    written = list(_written(forms, told.stop_bits)) if forms else []
    by = (setting(drive, each.setting) for each in (rates, forms, told.stop_bits) if each)
    return Serial(
        said=tuple(cited(each) for each in (told.mode, rates, forms, told.stop_bits, silence) if each),
        interface=told.interface.en,
        modes=told.mode.modes,
        rates=tuple(each for _, each in sorted(named, key=lambda one: not one[0])),
        characters=tuple(each for _, each in sorted(written, key=lambda one: not one[0])),
        rate=next((each for factory, each in named if factory), USUAL_RATE),
        character=next((each for factory, each in written if factory), Character()),
        known=any(factory for factory, _ in named),
        differs=any(each.editions for each in by if each),
        units_said=cited(unit),
        lowest=unit.min,
        highest=unit.max,
        factory=unit.default,
        setting=unit.setting,
        no_address=unit.no_address,
        silence_ms=silence.milliseconds or Decimal(0) if silence else Decimal(0),
        silence_characters=silence.characters if silence else None,
        broadcast=Broadcast(cited(cast), cast.address, cast.start_addresses) if cast else None,
        delay=_delay(drive, told.reply_delay) if told.reply_delay else None,
    )


def _delay(drive: Drive, one: ReplyDelay) -> Delay:
    by = setting(drive, one.setting)
    counts = (by.factory, by.bounds[1] if by.bounds else None) if by else (None, None)
    factory, most = (None if each is None else ceil(each * one.milliseconds) for each in counts)
    return Delay(cited(one), one.setting, factory, most, one.milliseconds)


def delivered(drives: Iterable[Drive]) -> tuple[int, Character]:
    """Bit rate and character that some drives have as delivered, as far as known; where they differ, the usual ones."""
    found = {(one.rate, one.character) for one in map(serial, drives) if one.known}
    return found.pop() if len(found) == 1 else (USUAL_RATE, Character())


def _factory(choice: BaudChoice | FormatChoice | StopBitsChoice, code: BaudCode | FormatCode | StopBitsCode) -> bool:
    """Whether a drive as delivered has what a code chooses, or what nothing chooses."""
    if code.code is not None:
        return code.code == choice.default
    return len(choice.codes) == 1 or (not isinstance(code, StopBitsCode) and bool(code.delivered))


def _written(forms: FormatChoice, stops: StopBitsChoice | None) -> Iterator[tuple[bool, Character]]:
    """Each character that the settings can choose, and whether it is the factory's."""
    for form in forms.codes:
        factory, data, parity = _factory(forms, form), form.data_bits or 8, PARITIES[form.parity]
        if stops is None:
            yield factory, Character(data, parity, form.stop_bits or 1)
        else:
            for each in stops.codes:
                yield factory and _factory(stops, each), Character(data, parity, each.stop_bits)
