"""Registers of a drive: what is written, what survives the power, and how often it was stored."""

from collections.abc import Iterable, Mapping

from driveblocks.bench.simulator.table import Storage
from driveblocks.maps.form import Span


class Memory:
    """Words by address. A register that was never written is 0.

    By the map's storage rule a write to a parameter is stored at once (`ram_address_bit` without the bit, all but the
    twins in RAM, and `unexplained`, which counts as EEPROM), with ENTER, all of them in one store, or never.
    """

    def __init__(self, storage: Storage, plate: Mapping[int, int], words: Mapping[int, int]) -> None:
        """Begin with what the drive says of itself, whatever its power does, and with these words, stored."""
        self.storage, self.plate = storage, plate
        self.words = {**plate, **words}
        self.stored = {address: word for address, word in words.items() if self.parameter(address)}
        self.stores = 0
        self.changed: dict[int, int] = {}

    def __getitem__(self, address: int) -> int:
        return self.words.get(self.home(address), 0)

    def home(self, address: int) -> int:
        """The register that an address means: it may have the bit for RAM added."""
        plain = address - self.storage.add
        return plain if self.storage.add and inside(self.storage.areas, plain) else address

    def parameter(self, address: int) -> bool:
        return inside(self.storage.areas, self.home(address))

    def write(self, address: int, word: int, now: int) -> bool:
        """Write a word at a time in ms; whether that stores."""
        home = self.home(address)
        if self[home] != word:
            self.changed[home] = now
        self.words[home] = word
        if address == self.storage.register and word == self.storage.value:
            self.stored = {each: self[each] for each in self.words if self.parameter(each)}
        elif self.storage.at_once and home == address and self.parameter(address):
            self.stored[address] = word
        else:
            return False
        self.stores += 1
        return True

    def lose(self, kept: Iterable[int] = ()) -> None:
        """What a loss of power keeps: what is stored, and some registers."""
        self.words = {**self.plate, **{address: self[address] for address in kept}, **self.stored}
        self.changed = {}


def inside(spans: Iterable[Span], address: int) -> bool:
    """Whether an address lies in one of these."""
    for span in spans:  # noqa: SIM110 - asked some ten times per request: `any` takes three times as long
        if span.first <= address <= span.last:
            return True
    return False
