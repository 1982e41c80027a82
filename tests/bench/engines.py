"""Measurement of the engines against each other, driven from Python, and of the front end that reads the ST."""

import tempfile
import time
from collections.abc import Callable, Iterable
from dataclasses import replace
from pathlib import Path

from tests.bench.record import Rows
from tests.blocks.library import sources

from driveblocks.reference.checksum import crc16
from structured_text.engines.engine import Engine, Instance, Source
from structured_text.engines.matiec import MatiecEngine
from structured_text.engines.matiec.cache import Cache
from structured_text.language.checker import analyse
from structured_text.language.lexer import tokenize
from structured_text.language.lint import lint
from structured_text.language.parser import parse

CRC = Path(__file__).parents[1] / "structured_text/engines/corpus/crc_table.st"
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
Work = Callable[[], object]


def measure(engines: Iterable[Engine]) -> Rows:
    """For each engine: seconds to build the library anew, MB/s of a CRC over 256 bytes, scans/s of a small block."""
    return {
        engine.name: {
            "build s": build_seconds(engine),
            "CRC MB/s": crc_rate(engine),
            "scans/s": scan_rate(engine),
        }
        for engine in engines
    }


def build_seconds(engine: Engine) -> float:
    """Seconds of the wall clock from the text of the library to something that runs; no cache helps."""
    with tempfile.TemporaryDirectory() as folder:
        if isinstance(engine, MatiecEngine):
            engine = replace(engine, cache=Cache(Path(folder)))
        return least(lambda: engine.build(sources()), 1, time.perf_counter)


def crc_rate(engine: Engine, frames: int = 200) -> float:
    """MB/s of the table-driven CRC of the corpus over frames of 256 bytes, one scan each. ValueError if it is wrong."""
    instance = engine.build([Source.read(CRC)]).instance("CrcTable")
    instance["Frame"], instance["Count"] = FRAME, len(FRAME)
    seconds = least(lambda: scan_many(instance, frames), 5, time.perf_counter)
    if instance["Crc"] != crc16(FRAME):
        raise ValueError("the CRC is wrong")
    return frames * len(FRAME) / seconds / 1e6


def scan_rate(engine: Engine, scans: int = 100_000) -> float:
    """Scans per second of a block with two statements, each scan called from Python with its time."""
    instance = engine.build([Source("simple.st", SIMPLE)]).instance("Simple")
    instance["Enable"] = True
    return scans / least(lambda: scan_many(instance, scans), 5, time.perf_counter)


def scan_many(instance: Instance, count: int) -> None:
    """So many scans, one call each, a millisecond apart."""
    for now in range(0, count * 1_000_000, 1_000_000):
        instance.scan(now)


def least(work: Work, rounds: int, clock: Callable[[], float]) -> float:
    """Seconds of the fastest of some runs."""
    times = []
    for _ in range(rounds):
        start = clock()
        work()
        times.append(clock() - start)
    return max(min(times), 1e-9)


def front_end() -> Rows:
    """Lines per second of processor time of each step on the library of the shipped drives."""
    text = "\n".join(source.text for source in sources())
    return {"lines/s": steps(text), "lines": {"library": text.count("\n")}}


def steps(text: str, rounds: int = 3) -> dict[str, float]:
    """Lines per second: `lex` alone, `parse` with lexing, `check` of a parsed text, `lint`. Raises ParseError."""
    trees = [parse(text, "speed.st") for _ in range(2 * rounds)]  # a tree is completed once only
    works: dict[str, Work] = {
        "lex": lambda: tokenize(text),
        "parse": lambda: parse(text, "speed.st"),
        "check": lambda: analyse([trees.pop()]),
        "lint": lambda: lint([trees.pop()]),
    }
    return {name: text.count("\n") / least(work, rounds, time.process_time) for name, work in works.items()}
