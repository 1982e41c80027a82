"""A map while it is drawn at random: its rows, and how its manual writes names and addresses."""

from dataclasses import dataclass, field
from random import Random
from typing import Any

Row = dict[str, Any]


def hexadecimal(number: int) -> str:
    """As a manual prints an address."""
    return f"{number:04X}H"


@dataclass
class Sheet:
    """A map while it is drawn."""

    chance: Random
    language: str = "en"
    numbers: int = 0
    """What is added to an address where the manual numbers its registers; 0: it gives addresses."""
    tables: dict[str, int] = field(default_factory=dict)
    """The same of other tables, where their numbers start elsewhere."""
    settings: list[Row] = field(default_factory=list)
    commands: list[Row] = field(default_factory=list)
    words: list[Row] = field(default_factory=list)
    """Rows that are written."""
    shown: list[Row] = field(default_factory=list)
    """Rows that are read alone."""
    status: dict[str, Row] = field(default_factory=dict)
    """What pins show, by their names: a condition."""
    states: list[Row] = field(default_factory=list)
    coils: list[Row] = field(default_factory=list)
    inputs: list[Row] = field(default_factory=list)
    """Rows of coils and of discrete inputs."""

    def maybe(self, part: float = 0.5) -> bool:
        """With a chance."""
        return self.chance.random() < part

    def base(self, space: str) -> int:
        """What is added to an address of a table."""
        return self.tables.get(space, self.numbers)

    def place(self, number: int, space: str = "") -> str:
        """A register as this manual writes it, with its table where that is not the one of holding registers."""
        written = str(number + self.base(space)) if self.numbers else hexadecimal(number)
        return f"{space} {written}" if space else written

    def named(self, name: str, **keys: object) -> Row:
        """A row with its name, as the language of the manual wants it."""
        own: Row = {"en": {}, "zh": {"zh": f"名称 {name}"}, "de": {"wording": f"Bezeichnung {name}"}}[self.language]
        return {"name": name, **own, **keys}

    def text(self, words: str) -> Row:
        """A text in the manual's language."""
        own = {"en": {}, "zh": {"zh": f"文字 {words}"}, "de": {"wording": f"Wortlaut {words}"}}[self.language]
        return {"en": words, **own}

    def setting(self, number: int, name: str, **keys: object) -> str:
        """A setting of the keypad; its id."""
        self.settings.append(self.named(name, id=f"P3.{number:02}", source="section 1", **keys))
        return f"P3.{number:02}"

    def listed(self, *names: str) -> list[Row]:
        """Values from 0, with these names."""
        return [self.named(name, value=value) for value, name in enumerate(names)]

    def bits(self, number: int) -> list[int]:
        """So many different bits of a word."""
        return self.chance.sample(range(16), number)


def moved(place: str, number: int) -> str:
    """A register so many further on."""
    return hexadecimal(int(place[:-1], 16) + number) if place.endswith("H") else str(int(place) + number)


def bit(number: int | str) -> str | int:
    """A bit as maps write it."""
    return number if isinstance(number, str) or number < 10 else f"{number:X}"
