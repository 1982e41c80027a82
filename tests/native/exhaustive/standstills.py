"""Whether the motor is at standstill: all pairs of words, against a truth table of each word from the model."""

import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path

from tests.blocks.meanings import word_pin
from tests.native.exhaustive.bench import Bench, Finding
from tests.shipped import drives

from driveblocks.maps.model import Drive
from driveblocks.reference.standstill import holds


def families() -> dict[str, Drive]:
    """Drives whose standstill two words prove, which can be tried in pairs.

    The others, and their references, are tried at every limit by tests/blocks.
    """
    return {prefix: drive for prefix, drive in drives().items() if len(addresses(drive)) == 2}


def pins(drive: Drive) -> list[str]:
    """The block's words."""
    return [word_pin(drive, address) for address in addresses(drive)]


def addresses(drive: Drive) -> list[int]:
    """The registers that prove standstill."""
    return list(dict.fromkeys(one.register for one in drive.operation.standstill.all))


def truths(drive: Drive, address: int) -> bytes:
    """For each word of a register whether the conditions on it hold. All conditions together are those of each word."""
    conditions = [one for one in drive.operation.standstill.all if one.register == address]
    return bytes(all(holds(one, word) for one in conditions) for word in range(0x10000))


def standstills(benches: Sequence[Bench], short: bool) -> Iterator[Finding]:
    """2^32 pairs of words of each drive; short: the pairs with a word that has at most one bit, or all."""
    for prefix, drive in families().items():
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "truths")
            path.write_bytes(b"".join(truths(drive, address) for address in addresses(drive)))
            for bench in benches:
                yield bench.command("standstill", prefix, path, 0 if short else 1)
