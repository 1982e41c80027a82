"""The keypad settings that a drive's manual names: what each is as delivered, and must be before the drive listens."""

import re
from dataclasses import dataclass

from driveblocks.maps.model import Drive, kept
from driveblocks.meaning.citation import Citation, cited


@dataclass(frozen=True)
class Needed:
    """What it must be: one of these numbers, or what the PLC also uses; for runs by the terminals, another."""

    right: tuple[int, ...]
    by_terminals: int | None
    why: str


@dataclass(frozen=True)
class Setting:
    """One of them; bounds and register only where the manual has them."""

    id: str
    name: str
    said: Citation
    register: int | None
    default: str
    """As printed; of several editions each with its own."""
    editions: bool
    """It differs by edition."""
    bounds: tuple[int, int] | None
    values: tuple[tuple[int, str], ...]
    needed: Needed | None
    shown_while: tuple[tuple[str, int], ...]
    """Other settings, and what they are while the keypad shows it."""
    note: str

    def named(self, number: int | None) -> str:
        """What the manual calls a value."""
        return next((name for value, name in self.values if value == number), "")

    @property
    def factory(self) -> int | None:
        """The number as delivered, where one is printed."""
        said = None if self.editions else re.match("[0-9]{1,9}", self.default)
        return int(said[0]) if said else None


@kept
def settings(drive: Drive) -> tuple[Setting, ...]:
    """The settings of a map, in its order."""
    return tuple(
        Setting(
            id=one.id,
            name=one.name,
            said=cited(one),
            register=one.register,
            default=one.default or " or ".join(f"{each.default} ({each.edition})" for each in one.editions),
            editions=bool(one.editions),
            bounds=(one.range.min, one.range.max) if one.range else None,
            values=tuple((each.value, each.name) for each in one.values),
            needed=Needed(one.needed.right, one.needed.by_terminals, one.needed.why) if one.needed else None,
            shown_while=tuple((each.setting, each.value) for each in one.visible_when),
            note=one.note or "",
        )
        for one in drive.settings
    )


def setting(drive: Drive, id_: str | None) -> Setting | None:
    """A setting by its id."""
    return next((one for one in settings(drive) if one.id == id_), None)
