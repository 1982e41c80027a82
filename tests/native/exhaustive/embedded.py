"""What the embedded engine does of this in minutes: a scan costs it a thousand times what it costs compiled C."""

import time
from collections.abc import Iterator, Sequence

from tests.blocks import meanings
from tests.blocks.library import Blocks, built, scan
from tests.native.exhaustive.bench import Finding
from tests.native.exhaustive.checks import Report
from tests.native.exhaustive.words import some
from tests.shipped import drives

from driveblocks.maps.model import Drive, Register
from driveblocks.reference import register
from driveblocks.reference.checksum import crc16, lrc
from driveblocks.reference.naming import name_of
from structured_text.engines.embedded import EmbeddedEngine

LINE = "embedded"


def embedded(names: Sequence[str]) -> Iterator[Report]:
    """Some of PARTS, each named as the check of which it does a part. Raises KeyError for another."""
    for name in names:
        begin = time.monotonic()
        finding = PARTS[name](built(EmbeddedEngine()))
        yield Report(name, time.monotonic() - begin, (finding,))


def checksums(blocks: Blocks) -> Finding:
    """All frames of two bytes, which are all pairs for the LRC, and all first steps and then one for the CRC."""
    wrong = []
    models = {"MB_Crc16": ("Crc", crc16), "MB_Crc16Compact": ("Crc", crc16), "MB_Lrc": ("Lrc", lrc)}
    for block, (pin, model) in models.items():
        instance = blocks.library.instance(block)
        for number in range(0x10000):
            data = number.to_bytes(2, "big")
            if scan(instance, {"Length": 2, "Adu": data})[pin] != model(data):
                wrong.append(f"{block} of {data.hex(' ')}")
    return Finding(LINE, len(models) * 0x10000, len(wrong), tuple(wrong[:5]), "frames of two bytes")


def decoders(blocks: Blocks) -> Finding:
    """Each 61st word, and those that tell bits and values apart."""
    rows = [(drive, row) for drive in drives().values() for row in meanings.decoded(drive)]
    wrong = [text for drive, row in rows for text in _decoder(blocks, drive, row)]
    return Finding(LINE, sum(len(some(row)) for _, row in rows), len(wrong), tuple(wrong[:5]), "each 61st word")


def _decoder(blocks: Blocks, drive: Drive, row: Register) -> Iterator[str]:
    instance = blocks.library.instance(f"{drive.prefix}_{name_of(row)}")
    for word in some(row):
        scan(instance, {"Value": word})
        wanted = register.decode(row, word)
        if {name: instance[name] for name in wanted} != wanted:
            yield f"{drive.prefix}_{name_of(row)} of {word:04X}H"


def scales(blocks: Blocks) -> Finding:
    """All 65536 words."""
    rows = [(drive, row) for drive in drives().values() for row in meanings.scaled(drive)]
    wrong = [
        f"{meanings.scale_name(drive, row)} of {word:04X}H"
        for drive, row in rows
        for word in range(0x10000)
        if blocks.call(meanings.scale_name(drive, row), {"Raw": word}) != register.engineering(row, word)
    ]
    return Finding(LINE, len(rows) * 0x10000, len(wrong), tuple(wrong[:5]))


PARTS = {"checksums": checksums, "decoders": decoders, "scales": scales}
