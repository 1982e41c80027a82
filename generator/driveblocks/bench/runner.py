"""Run suites on engines: build once per engine, run its programs, and keep going whatever goes wrong."""

import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from dataclasses import replace
from functools import partial
from itertools import groupby
from multiprocessing import Array
from operator import itemgetter
from typing import Any

from driveblocks.bench.coverage import Counted, Coverage
from driveblocks.bench.execute import Setting, execute
from driveblocks.bench.outcome import ERROR, PASSED, Outcome, Result, Run
from driveblocks.bench.suite import ROOT
from driveblocks.bench.unit import Unit
from driveblocks.maps.view import UNPROVED
from structured_text.engines.discovery import EMBEDDED
from structured_text.engines.embedded import EmbeddedEngine
from structured_text.engines.engine import Engine, EngineError, Library, Source
from structured_text.language.collector import paused

SECONDS = 120.0
"""Time limit of one program, for one that never ends; the longest takes some hundredths of a second."""

BUILDS = 2
"""Builds at once, where compilers are processes of their own."""

LOOK_S = 0.2
"""Between two looks at how far the processes are."""

Tell = Callable[[float, float, str], None]
"""Takes how much of how much is done, and what is at hand."""

_Built = Library | EngineError
_COME: list[Any] = []
"""In a process that runs a share: how far each of them has come, from 0 to 2."""


def run(  # noqa: PLR0913, PLR0917 - what runs on what, how, and who is told of it
    units: Sequence[Unit],
    engines: Sequence[Engine],
    seconds: float = SECONDS,
    coverage: Sequence[Coverage] = (),
    jobs: int = 1,
    tell: Tell = lambda *_: None,
) -> Run:
    """Run every program of every unit on every engine; results in the order of engines, units and programs.

    What has run of the blocks is added to the `coverage` of an engine's name, if the engine counts. Where nothing is
    counted, `jobs` processes of the embedded engine compile and run a share of the programs each.
    """
    start, total = time.perf_counter(), sum(len(unit.suite.programs) for unit in units) or 1
    results: list[Result] = []
    with paused(), ThreadPoolExecutor(BUILDS) as pool:
        for engine in engines:
            sums = [each for each in coverage if each.engine == engine.name]
            if jobs > 1 and engine.name == EMBEDDED and not sums:
                results += _side_by_side(units, seconds, jobs, tell)
                continue
            ran, before = 0, 0
            tell(0, 2, f"compiling for {engine.name}")
            if isinstance(engine, EmbeddedEngine):  # which compiles all at first; that takes about as long as to run it
                before, engine.told = 1, partial(_compiling, tell)
            made = zip(units, _builds(engine, units, pool), strict=True)
            for built, those in groupby(made, key=itemgetter(1)):
                sharing = [unit for unit, _ in those]
                for unit in sharing:
                    for at, result in enumerate(_results(engine, unit, built, seconds)):
                        results.append(result)
                        tell(before + (2 - before) * (ran + at) / total, 2, f"{unit.suite.name} on {engine.name}")
                    ran += len(unit.suite.programs)
                results += [trouble for each in sums for trouble in _counted(each, sharing, built)]
    return Run(results, time.perf_counter() - start)


def _compiling(tell: Tell, share: float) -> None:
    tell(share, 2, f"compiling for {EMBEDDED}")


def _side_by_side(units: Sequence[Unit], seconds: float, jobs: int, tell: Tell) -> list[Result]:
    """What the embedded engine finds, in as many processes, in the order of units and programs."""
    come = Array("d", jobs)
    shares = [[_share(unit, at, jobs) for unit in units] for at in range(jobs)]
    try:
        with ProcessPoolExecutor(jobs, initializer=_COME.append, initargs=(come,)) as pool:
            parts = [pool.submit(_embedded, share, seconds, at) for at, share in enumerate(shares)]
            while wait(parts, LOOK_S).not_done:
                far = sum(come[:])
                tell(far, 2 * jobs, f"{'compiling for' if far < jobs else 'running on'} {EMBEDDED}")
            found = [result for part in parts for result in part.result()]
    except BrokenProcessPool:  # a process was killed, as for its memory
        return _embedded(units, seconds)
    order = {unit.suite.name: {each.name: at for at, each in enumerate(unit.suite.programs)} for unit in units}
    names = list(order)
    unlike = [each for at, each in enumerate(found) if each not in found[:at] or each.group != "Build"]
    return sorted(unlike, key=lambda each: (names.index(each.unit), order[each.unit].get(each.program, -1)))


def _share(unit: Unit, at: int, jobs: int) -> Unit:
    return replace(unit, suite=replace(unit.suite, programs=unit.suite.programs[at::jobs]))


def _embedded(units: Sequence[Unit], seconds: float, at: int | None = None) -> list[Result]:
    """What the embedded engine finds, in this process, or in one of several; `at`: which."""

    def tell(done: float, *_: object) -> None:
        for come in _COME if at is not None else ():
            come[at] = done

    return run(units, [EmbeddedEngine()], seconds, tell=tell).results


def _counted(coverage: Coverage, units: Sequence[Unit], built: _Built) -> Iterator[Result]:
    """Add what has run of one build of some units; a result only where that is not known."""
    blocks = {block.path: block for unit in units for block in unit.blocks}
    try:
        if isinstance(built, Counted):
            coverage.add(blocks.values(), built)
    except EngineError as error:
        outcome = Outcome("what has run is known", ERROR, str(error))
        yield Result(coverage.engine, units[0].suite.name, "coverage", (outcome,))


def _builds(engine: Engine, units: Sequence[Unit], pool: ThreadPoolExecutor) -> Iterable[_Built]:
    build = partial(_built, engine)
    if engine.name != EMBEDDED:
        return pool.map(build, (unit.sources for unit in units))
    whole = _whole(units)
    built = build(whole) if whole else None
    if built is None or isinstance(built, EngineError):
        return map(build, (unit.sources for unit in units))
    return [built] * len(units)


def _whole(units: Sequence[Unit]) -> list[Source] | None:
    """All sources, what units share but once, so that it is compiled once; None where they differ in it."""
    found: dict[str, Source] = {}
    for unit in units:
        for source in unit.sources:
            if found.setdefault(source.path, source) != source:
                return None
    return [*found.values()]


def _built(engine: Engine, sources: Sequence[Source]) -> _Built:
    try:
        return engine.build(sources)
    except EngineError as error:
        return error


def _results(engine: Engine, unit: Unit, built: _Built, seconds: float) -> Iterator[Result]:
    name = unit.suite.name
    yield Result(engine.name, name, "build", tuple(_preparations(engine, unit, built)), group="Build")
    if isinstance(built, EngineError):
        return
    setting = Setting(engine.name, name, ROOT, seconds)
    for program in unit.suite.programs:
        yield execute(built, program, setting)


def _preparations(engine: Engine, unit: Unit, built: _Built) -> Iterator[Outcome]:
    """What must be true before any program runs."""
    if isinstance(built, EngineError):
        yield Outcome("library and programs compile", ERROR, f"{engine.name} refuses them:\n{built}")
    else:
        yield Outcome("library and programs compile", PASSED)
    yield Outcome("there are vectors" if unit.suite.vectors else UNPROVED)
