"""Speeds of an engine: CRC over a table, simple scans. Every function takes any engine of the face."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path

from structured_text.engines.engine import Engine, Instance, Source

CORPUS = Path(__file__).parent.parent / "corpus"
FRAME = bytes((37 * place + 11) % 256 for place in range(256))
SIMPLE = """FUNCTION_BLOCK Simple
VAR_INPUT
  Enable : BOOL;
  Inhibit : BOOL;
END_VAR
VAR_OUTPUT
  Running : BOOL;
  Scans : UINT;
END_VAR
  Running := Enable AND NOT Inhibit;
  IF Running THEN
    Scans := (Scans + 1) MOD 1000;
  END_IF;
END_FUNCTION_BLOCK
"""


def crc(data: bytes) -> int:
    """CRC-16 bit by bit (Modbus over serial line, V1.02, section 6.2.2)."""
    value = 0xFFFF
    for byte in data:
        value ^= byte
        for _ in range(8):
            value = value >> 1 ^ (0xA001 if value & 1 else 0)
    return value


def best(work: Callable[[], None], repeats: int = 5) -> float:
    """Seconds of the fastest of some runs."""
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return min(times)


def crc_rate(engine: Engine, frames: int = 200) -> float:
    """MB/s of the table-driven CRC of the corpus over frames of 256 bytes, one scan each. ValueError if it is wrong."""
    source = Source("crc_table.st", (CORPUS / "crc_table.st").read_text(encoding="utf-8"))
    instance = engine.build([source]).instance("CrcTable")
    instance["Frame"], instance["Count"] = FRAME, len(FRAME)
    seconds = best(lambda: scan_many(instance, frames))
    if instance["Crc"] != crc(FRAME):
        raise ValueError("the CRC is wrong")
    return frames * len(FRAME) / seconds / 1e6


def scan_rate(engine: Engine, scans: int = 100_000) -> float:
    """Scans per second of a block with two statements, each scan called from Python with its time."""
    instance = engine.build([Source("simple.st", SIMPLE)]).instance("Simple")
    instance["Enable"] = True
    return scans / best(lambda: scan_many(instance, scans))


def scan_many(instance: Instance, count: int) -> None:
    """So many scans, one call each, a millisecond apart."""
    scan = instance.scan
    for now in range(0, count * 1_000_000, 1_000_000):
        scan(now)
