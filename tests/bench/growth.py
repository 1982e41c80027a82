"""Measurement of how a build grows: with the number of maps, and with the registers of one map."""

import resource
import time
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import TypeVar

from tests.bench.record import Rows

from driveblocks.bench.suite import programs
from driveblocks.docs.page import documents
from driveblocks.maps import catalog, collection, load, nodes
from driveblocks.maps.model import Drive
from driveblocks.maps.page import skeleton
from driveblocks.render import library, text

Made = TypeVar("Made")
LANGUAGES = text.languages(["en", "zh"], "utf-8")
REGISTERS = (50, 100, 200, 400, 800)
MAPS = (10, 100, 1000)
WHOLE = (10, 30, 100)


def measure(
    maps: Sequence[int] = MAPS, whole: Sequence[int] = WHOLE, registers: Sequence[int] = REGISTERS, rounds: int = 5
) -> Rows:
    """Seconds of the processor for each step: `<n> maps`, `<n> maps whole` (400 registers each), `<n> registers`.

    `load` reads and checks the maps, `blocks` renders their blocks; `page` and `tests`, of a whole build, write the
    overview and the test programs. Nothing goes to disk.
    """
    whole_build(0, 120)
    rows: Rows = {"shipped": _least([_shipped() for _ in range(rounds)])}
    rows["shipped without libyaml"] = {"load": min(_without_libyaml() for _ in range(rounds))}
    for count in registers:
        rows[f"{count} registers"] = _least([whole_build(1, count) for _ in range(rounds)])
    for count in maps:
        rows[f"{count} maps"] = blocks_of_maps(count, 400)
    for count in whole:
        rows[f"{count} maps whole"] = whole_build(count, 400)
    return rows


def synthetic(number: int, registers: int) -> str:
    """A small map with parameters beside, to have this many registers; maps of different numbers differ."""
    head, behind, tail = skeleton().replace("prefix: ACME", f"prefix: SYN{number}").partition("\nstorage:")
    rows = (
        f"      - {{address: {0x3000 + index:04X}H, name: Parameter {index} of {number}, range: {{min: 0, max: 9}}}}\n"
        for index in range(registers - 5)
    )
    section = "  - id: parameters\n    title: {en: Parameters}\n    source: table 4\n    access: rw\n    registers:\n"
    return f"{head}\n{section}{''.join(rows).rstrip()}{behind}{tail}"


def blocks_of_maps(count: int, registers: int) -> dict[str, float]:
    """Loading and rendering map after map, none of them kept."""
    loading = rendering = 0.0
    for number in range(count):
        map_ = synthetic(number, registers)
        seconds, drive = timed(partial(load.loads, map_, "map.yaml"))
        loading += seconds
        rendering += timed(partial(_render, drive))[0]
    return {"load": loading, "blocks": rendering}


def _render(drive: Drive) -> list[library.File]:
    return list(library.drive("map", drive, LANGUAGES))


def whole_build(count: int, registers: int) -> dict[str, float]:
    """All that a build makes of this many maps at once, in memory, with the peak of it in MiB."""
    maps = [synthetic(number, registers) for number in range(count)]
    return _steps(
        lambda: [
            collection.Source(Path(f"map{number}.yaml"), load.loads(map_, f"map{number}.yaml"))
            for number, map_ in enumerate(maps)
        ]
    )


def _shipped() -> dict[str, float]:
    return _steps(lambda: collection.read(catalog.shipped()))


def _without_libyaml() -> float:
    fast, nodes._LIBYAML = nodes._LIBYAML, None
    try:
        return timed(lambda: collection.read(catalog.shipped()))[0]
    finally:
        nodes._LIBYAML = fast


def _steps(read: Callable[[], list[collection.Source]]) -> dict[str, float]:
    loading, sources = timed(read)
    rendering, made = timed(lambda: _blocks(sources))
    page, _ = timed(lambda: documents(made, [source.drive for source in sources]))
    tests, _ = timed(lambda: programs(sources, LANGUAGES))
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    return {"load": loading, "blocks": rendering, "page": page, "tests": tests, "MiB": peak}


def _blocks(sources: list[collection.Source]) -> list[library.File]:
    drives = (library.drive(source.path.stem, source.drive, LANGUAGES) for source in sources)
    return [*library.generic(LANGUAGES), *(file for files in drives for file in files)]


def _least(found: list[dict[str, float]]) -> dict[str, float]:
    return {step: min(one[step] for one in found) for step in found[0]}


def timed(work: Callable[[], Made]) -> tuple[float, Made]:
    """Seconds of the processor for one run, and what it made."""
    start = time.process_time()
    made = work()
    return time.process_time() - start, made
