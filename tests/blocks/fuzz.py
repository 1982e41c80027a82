"""Damaged replies through each drive's chain of framing and reply block on the embedded engine.

Every reply's result, words and reason are compared with the reference model; an index out of bounds raises, and so does
a scan that takes more turns of its loops than the longest frame needs.

    python -m tests.blocks.fuzz [--count N] [--seed S] [--drive PREFIX]
"""

import argparse
import random
import sys
import time
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

from tests.blocks.damage import damaged, line
from tests.blocks.library import NAMES, sources
from tests.shipped import drives

from driveblocks.maps.model import Drive
from driveblocks.reference.framing import ascii_decode, rtu_open
from driveblocks.reference.reply import Answer, dialect, parse
from driveblocks.reference.request import Asked
from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.embedded.library import EmbeddedLibrary
from structured_text.engines.engine import ScanError, Source

TURNS = 1100
"""Turns of loops in one scan: 256 bytes of two characters, their LRC, 125 words, and the looks that end the loops."""

LINES = 400
"""Open requests among which the replies are divided, half of them RTU and half ASCII."""

CHAIN = """
FUNCTION_BLOCK {prefix}_Chain
VAR_INPUT
  Ascii : BOOL; (* which framing *)
  Count : UINT; (* bytes or characters received *)
END_VAR
VAR_OUTPUT
  ErrorID : UINT;   (* of the first block that finds something *)
  WordCount : UINT; (* registers read *)
  Reason : UINT;    (* of a refusal *)
END_VAR
VAR
  Adu : MB_Adu;            (* bytes *)
  Chars : MB_Chars;        (* characters *)
  Words : MB_Words;        (* registers *)
  Request : MB_Request;    (* what was asked *)
  Open : MB_RtuOpen;       (* RTU *)
  Decode : MB_AsciiDecode; (* ASCII *)
  Parse : {prefix}_Reply;  (* the drive's own *)
  Length : UINT;           (* bytes of the body *)
END_VAR

  WordCount := 0;
  Reason := 0;
  IF Ascii THEN
    Decode(CharCount := Count, Chars := Chars, Adu := Adu);
    ErrorID := Decode.ErrorID;
    Length := Decode.Length;
  ELSE
    Open(AduLength := Count, Adu := Adu);
    ErrorID := Open.ErrorID;
    Length := Open.Length;
  END_IF;
  IF ErrorID = 0 THEN
    Parse(Length := Length, Adu := Adu, Request := Request, Words := Words);
    ErrorID := Parse.ErrorID;
    WordCount := Parse.WordCount;
    Reason := Parse.Reason;
  END_IF;
END_FUNCTION_BLOCK
"""


@dataclass
class Tally:
    """What a run saw."""

    results: Counter[str] = field(default_factory=Counter)
    wrong: list[str] = field(default_factory=list)
    seconds: float = 0.0


class Chain:
    """One drive's chain; its variables are set from outside at the cost of a slice, since a path would cost more."""

    def __init__(self, library: EmbeddedLibrary, prefix: str) -> None:
        """Make an instance and take hold of its arrays, which keep their identity."""
        instance = library.instance(f"{prefix}_Chain")
        self.scan: Callable[[], None] = instance.scan
        self.root: Any = instance._root
        self.boxes: tuple[list[int], list[int]] = (self.root.ADU, self.root.CHARS)

    def ask(self, asked: Asked, in_ascii: bool) -> None:
        """Open a request."""
        request = self.root.REQUEST
        request.UNITADDRESS, request.FUNCTIONCODE, request.ADDRESS = asked.unit, asked.function, asked.address
        request.QUANTITY, request.SUBFUNCTION, request.VALUE = asked.quantity, asked.sub_function, asked.value
        self.root.ASCII = in_ascii

    def receive(self, data: bytes, in_ascii: bool) -> Answer:
        """One reply. Raises ScanError when the blocks leave their bounds or turn too often."""
        box, root = self.boxes[in_ascii], self.root
        room = len(box)
        box[: min(len(data), room)] = data[:room]
        root.COUNT = len(data)
        self.scan()
        return Answer(NAMES[root.ERRORID], tuple(root.WORDS[: root.WORDCOUNT]), root.REASON)


def build() -> EmbeddedLibrary:
    """The shipped library and a chain for each drive."""
    chains = "".join(CHAIN.format(prefix=prefix) for prefix in drives())
    return EmbeddedEngine(loop_limit=TURNS).build([*sources(), Source("chains", chains)])


def wanted(drive_manner: Any, asked: Asked, data: bytes, in_ascii: bool) -> Answer:
    """What the reference model says."""
    opened = ascii_decode(data) if in_ascii else rtu_open(data)
    return parse(drive_manner, asked, opened.data) if opened.result == "OK" else Answer(opened.result)


def run(library: EmbeddedLibrary, drive: Drive, count: int, seed: int, lines: int = LINES) -> Tally:
    """So many replies through one drive's chain."""
    chance, spoken, tally = random.Random(f"{seed} {drive.prefix}"), dialect(drive), Tally()
    chain = Chain(library, drive.prefix)
    start = time.perf_counter()
    for number in range(lines):
        in_ascii = number % 2 == 1
        wire = line(drive, chance, in_ascii)
        chain.ask(wire.asked, in_ascii)
        share = count * (number + 1) // lines - count * number // lines
        for data in damaged(wire, in_ascii, share, chance):
            try:
                found = chain.receive(data, in_ascii)
            except ScanError as error:
                found = Answer(str(error))
            due = wanted(spoken, wire.asked, data, in_ascii)
            tally.results[due.result] += 1
            if found != due:
                tally.wrong.append(f"{wire.asked} {data!r}: found {found}, the reference says {due}")
    tally.seconds = time.perf_counter() - start
    return tally


def report(drive: Drive, tally: Tally) -> str:
    """A few lines on a run."""
    count = tally.results.total()
    taken = tally.results["OK"] + tally.results["REFUSED"]
    seen = ", ".join(f"{name} {number}" for name, number in tally.results.most_common())
    head = f"{drive.prefix}_Reply: {count} replies in {tally.seconds:.1f} s, {taken} believed, {len(tally.wrong)} wrong"
    return "\n".join([head, f"  {seen}", *(f"  {text}" for text in tally.wrong[:10])])


def main(arguments: Sequence[str] | None = None) -> int:
    """Fuzz the drives that are asked for. Exit status 1 when any reply was judged wrongly."""
    parser = argparse.ArgumentParser(description="Damaged replies through the reply blocks.")
    parser.add_argument("--count", type=int, default=1_000_000, help="replies per drive")
    parser.add_argument("--seed", type=int, default=random.randrange(10**9), help="at random without it")
    parser.add_argument("--drive", choices=list(drives()), action="append", help="all without it")
    given = parser.parse_args(arguments)
    print(f"seed {given.seed}", flush=True)
    library, failed = build(), False
    for prefix in given.drive or drives():
        tally = run(library, drives()[prefix], given.count, given.seed)
        print(report(drives()[prefix], tally))
        failed = failed or bool(tally.wrong)
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
