"""Measurement of the engines against each other, driven from Python, and of the front end that reads the ST."""

import tempfile
import time
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

from tests.bench import speed
from tests.bench.record import Rows
from tests.blocks.library import sources
from tests.structured_text.engines.embedded.bench import crc_rate, scan_rate

from structured_text.engines.engine import Engine
from structured_text.engines.matiec import MatiecEngine
from structured_text.engines.matiec.cache import Cache


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
        start = time.perf_counter()
        engine.build(sources())
        return time.perf_counter() - start


def front_end() -> Rows:
    """Lines per second of processor time of each step on the library of the shipped drives."""
    text = "\n".join(source.text for source in sources())
    return {"lines/s": speed.measure(text), "lines": {"library": text.count("\n")}}
