"""The requests of a program for one motor where the PLC's own master has a channel for each."""

from dataclasses import dataclass

from driveblocks.maps.model import Drive
from driveblocks.meaning.polls import Poll
from driveblocks.meaning.words import words
from driveblocks.render import context
from driveblocks.render.context import Word
from driveblocks.render.drive import drive_block
from driveblocks.render.motor import motor


@dataclass(frozen=True)
class Said:
    """A word, and the block that takes it apart or the function that scales it, where there is one."""

    word: Word
    decoder: str | None
    scale: str | None


@dataclass(frozen=True)
class Channel:
    """A read, and those of its words that matter."""

    read: Poll
    words: list[Said]


def channels(drive: Drive) -> dict[str, object]:
    """For codesys/Master: the requests with the words that matter, and the blocks that make and read them."""
    block = drive_block(drive)
    decoders = {one.address_text: one.name for one in context.decoders(drive) if one.read}
    scales = {one.address_text: one.name for one in context.scales(drive) if one.read}
    pins = {one.pin for one in block.showing.verify}
    needed = {one.name for one in block.reading.proof} | pins
    reads = [
        Channel(
            one.read,
            [
                Said(each, decoders.get(each.address_text), scales.get(each.address_text))
                for each in one.words
                if each.name in needed or each.address_text in decoders.keys() | scales.keys()
            ],
        )
        for one in block.reading.reads
    ]
    reads = [one for one in reads if one.words]
    checks = [turn for turn, one in enumerate(reads, 2) if pins & {each.word.name for each in one.words}]
    # checks: the channels that bring what a run waits for
    told = {"command": words(drive).stop.last.register, "reads": reads, "checks": checks}
    return block.values | motor(drive) | told
