"""CRC and LRC against their definitions, in the driver itself: all (state, byte) pairs, all lengths, the table."""

from collections.abc import Iterator, Sequence

from tests.native.exhaustive.bench import Bench, Finding

SEED = 20


def checksums(benches: Sequence[Bench], _short: bool) -> Iterator[Finding]:
    """2^24 pairs for each CRC block, 2^16 for the LRC, 65536 lengths for each, 256 entries; always whole."""
    for bench in benches:
        yield bench.command("checksums", SEED)
