"""What a drive block asks its words, answered by the family's decoders: one fact is decided in one place."""

from dataclasses import dataclass

from driveblocks.maps.model import Drive
from driveblocks.meaning.pattern import WORD, Pattern
from driveblocks.render import context
from driveblocks.render.context import Row, Word
from driveblocks.render.expression import Test, holds


@dataclass(frozen=True)
class Call:
    """A decoder that a drive block calls: the name of its instance, its block, and the word that it takes apart."""

    instance: str
    block: str
    word: str
    address_text: str


class Decoded:
    """The decoders that a drive block calls, found by what it asks of their words."""

    def __init__(self, drive: Drive) -> None:
        """None is called yet."""
        self._drive = drive
        self._decoders = {one.address_text: one for one in context.decoders(drive) if one.read}
        self.used: list[Call] = []

    def holds(self, one: Pattern) -> str:
        """An expression that is TRUE when a pattern holds: an output of a decoder, or a test of the word itself."""
        word = context.word_input(self._drive, one.register)
        test = context.tested("Value", one)
        decoder = self._decoders.get(word.address_text)
        parts = decoder.parts if decoder else ()
        flags = {_exact(part.test): part.name for part in parts if part.kind == "flag"}
        for asked, said in () if test.is_ != "=" else ((test, "{}.{}"), (_set(test), "NOT {}.{}")):
            if decoder and asked and _exact(asked) in flags:
                return said.format(self._instance(decoder, word), flags[_exact(asked)])
        pin = f"Reads.{word.name}"
        return f"({holds(test._replace(pin=pin))})"

    def _instance(self, decoder: Row, word: Word) -> str:
        name = f"{word.name.removesuffix('Word')}Bits"
        found = Call(name, decoder.name, word.name, word.address_text)
        if found not in self.used:
            self.used.append(found)
        return name


def _exact(test: Test) -> tuple[int, int]:
    """The bits that count, and what they must be."""
    return test.mask or WORD, test.value


def _set(test: Test) -> Test | None:
    """The test of a single bit for 1, where it is one for 0."""
    single = test.mask & (test.mask - 1) == 0
    return test._replace(value=test.mask) if test.mask and single and not test.value else None
