"""Figures of the library's pages and of the bench that more than one part of the judge goes by."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tests.second.bench import Second

CHAR_US = 521
"""A character of 10 bits at 19,200 bit/s, rounded up."""
MAX_SCAN_US = 60_000
"""MaxScanMs of the bench."""
ATTEND_US = 1_000_000
"""AttendMs: for so long the line does not know that a block is called no longer, and sends the run that waits."""
CALM_US = 10_000_000
"""What is over for so long is not felt any more."""
SEEN_US = 300_000
"""What the age of words does not say: the reply's way, and the scan in which it is shown."""
AGE_MS = 2600
"""How old words may be on a line of three drives at most."""
BOOT_US = 10_000_000
"""After a restart silence is no alarm for so long, unless the drive has answered since."""
EVERY_US = 200_000
"""How often outputs are looked at."""
CODE_MOST = 5
"""Rounds until the code of a fault is read: three until the status shows the fault, and two more."""
REFUSED_US = 1_500_000
"""From the first refused read to its reason: StaleMs, this time, and the rounds of CODE_MOST."""
UNLEARNED_MS = 500
"""How long the line waits for a drive whose replies it has not learned yet: then only what it promises is owed."""
UNHURRIED_MS, QUARTER = 250, 4
"""The attempts of drives that may take longer than this to answer are spread over time, and all dead drives together
have this part of the wire."""
STOP_TRIES = 4
"""Attempts of a stop until it is overdue."""
FOREIGN, SHARED = 54, 56
"""Errors of the line: another master seems to be there; a slot has two blocks."""
EXCHANGE_US = 50_000
"""A request and its reply at 19,200 bit/s, up to 18 ms after it; or three scans, where those are longer."""
PATH_ROUNDS = {"ATV312": 5, "MX2": 1, "V20": 2, "ACS355": 13}
"""Rounds of the line by which a start of several writes is longer; a drive gets one write and one read in a round.

MX2 has one write more, its direction. Three writes of ATV312 each wait for a status that was read after them (BBV51701,
page 10), which is two reads of three: of any five in a row at least three.
So do three of the six of ACS355, one of which stays for 100 ms.
"""
TAKEN: dict[str, tuple[tuple[str, ...], int | None]] = {
    "Shared": (("SHARED", "NO_LINE"), SHARED), "Doubled": (("LINE",), None),
}  # fmt: skip
"""Pins of a drive that gets nothing but stops, each with the reasons that say so, and ErrorID: a slot with two blocks,
an address in two slots, which is an error of the line's own."""
ASTRAY = ("Left", *TAKEN)
"""Pins with which no block alone serves a drive."""
AWAY = (*ASTRAY, "SpeedOnly", "MonitorOnly")
"""The same, or not in full control."""
JOG_ENDS = {"CHF": b"\x06\x10\x00\x00\x08", "GD200A": b"\x06\x20\x00\x00\x08"}
"""8 ends a jog: at 1000H, line 326 of CHF's manual; at 2000H, page 139 of GD200A's."""
JOG_US = 500_000
"""How much later a drive stops that has a stop of its own for a jog: both are sent by turns, one every 500 ms."""


def round_us(bench: "Second") -> int:
    """A round of the line: two exchanges of each drive, a write and a read."""
    return 2 * len(bench.types) * max(EXCHANGE_US, 3000 * max(bench.ms, bench.was_ms))


def crowded(bench: "Second") -> bool:
    """Whether references and reads of the running drives have all the line: eight drives in slow scans; or most of them
    are dead, and each has four attempts before it rests."""
    return len(bench.types) > 3 and (bench.ms > 20 or len(bench.deaf) > 3)


RAMP_ROUNDS = {"ACS355": 3}
"""Rounds from the write that runs the motor to the one that lets it follow its reference: ACS550-02, page 246."""


def ramp_us(bench: "Second", index: int) -> int:
    """How much longer than a drive that runs at once this one stands in a start."""
    return RAMP_ROUNDS.get(bench.types[index], 0) * round_us(bench)


def path_us(bench: "Second", index: int) -> int:
    """How much longer a start of this drive takes than one by one write; in slow scans its reference has a round."""
    rounds = PATH_ROUNDS.get(bench.types[index], 0) + (len(bench.types) > 3 and max(bench.ms, bench.was_ms) > 20)
    return rounds * round_us(bench)
