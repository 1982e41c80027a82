"""Run engine tests on every engine found; say at the top which run, and why another does not.

`DRIVEBLOCKS_REQUIRE=matiec` (or `matiec-beremiz`, `matiec-openplc`; several with commas) makes a missing one a failure
of the whole run. `engine` is one engine after the other, `matiec` those of matiec alone; a test that needs matiec is
skipped, with the reason, where there is none. What a test records as the property `summary` is printed at the end.

Properties are tried on the same examples on every machine and in every run, however long that takes. `make fuzz` looks
for others with the profile `search`; what it finds becomes an example of the suite.
"""

import functools
import gc
import os
import signal
import sys
from collections.abc import Generator, Sequence
from contextlib import nullcontext
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING

import pytest
from hypothesis import HealthCheck, settings
from tests import counting
from tests.progress import Progress

from driveblocks.maps import catalog, load
from driveblocks.maps.collection import Source
from driveblocks.maps.model import Drive
from driveblocks.maps.problem import Report
from structured_text.engines.discovery import EMBEDDED, MATIEC_NAMES, Candidate, survey
from structured_text.engines.engine import Engine

if TYPE_CHECKING:
    from driveblocks.plc import source

REQUIRE = "DRIVEBLOCKS_REQUIRE"
MANY = 4_000_000
"""Objects, some 400 MB, after which garbage is looked for between two modules: to walk over all takes seconds."""
_blocks = [0]
WITHOUT_WALK = SimpleNamespace(collect=int, freeze=gc.freeze, unfreeze=gc.unfreeze)
"""What a run in real time does with garbage, but look for it: among the trees of all tests that takes a second."""
_programs: dict[tuple[object, ...], "source.Loaded"] = {}
MOST_PROGRAMS = 20
settings.register_profile(
    "suite", derandomize=True, deadline=None, database=None, suppress_health_check=[HealthCheck.too_slow]
)
settings.register_profile("search", settings.get_profile("suite"), derandomize=False, max_examples=2000)
settings.load_profile("suite")


@functools.cache
def candidates() -> tuple[Candidate, ...]:
    """Every engine by name, found or not; looked for once."""
    return tuple(survey().candidates())


def missing(required: str) -> list[str]:
    """What a list such as `matiec-beremiz,matiec-openplc` asks for and is not there, each with the reason.

    The embedded engine is part of DriveBlocks, so it is always required.
    """
    found = {each.name: each for each in candidates()}
    complaints = []
    for name in [EMBEDDED, *(word.strip() for word in required.split(",") if word.strip())]:
        group = MATIEC_NAMES if name == "matiec" else (name,)
        if unknown := [each for each in group if each not in found]:
            complaints.append(f"{REQUIRE} knows no engine {unknown[0]!r}: matiec, {', '.join(found)}")
        elif not any(found[each].engine for each in group):
            complaints.append(f"{name} is required, but: {found[group[0]].note}")
    return complaints


def pytest_configure(config: pytest.Config) -> None:
    """Refuse to run where a required engine is missing: a green run would claim what was not tested."""
    if not hasattr(config, "workerinput") and (complaints := missing(os.environ.get(REQUIRE, ""))):
        raise pytest.UsageError("\n".join(complaints))
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:  # in the background of a script; its children inherit that
        signal.signal(signal.SIGINT, signal.default_int_handler)
    if config.getoption("cov_source", None):
        counting.without_engine()
    maps_once()
    programs_once()
    gc.set_threshold(100_000, 20, 20)


def maps_once() -> None:
    """From now on load each shipped map once in a process, but in the tests of the loader."""
    loaded = load._loaded

    @functools.cache
    def known(text: str, path: Path) -> Drive:
        return loaded(text, Report(str(path)), path)

    def once(text: str, report: Report, path: Path | None = None) -> Drive:
        if path is None or path.parent != catalog.folder() or counting.at[0].startswith("maps/"):
            return loaded(text, report, path)
        return known(text, path)

    load._loaded = once


def programs_once() -> None:
    """From now on compile a program once for a module's tests, but for those of programs; no run walks over trees."""
    from driveblocks.plc import live, source  # here: the check of engines comes first

    # a namespace in place of a module, which is no type that mypy knows
    live.gc = WITHOUT_WALK  # type: ignore[assignment, attr-defined]
    load = source.load

    def once(path: str, text: str, maps: Sequence[Source], name: str | None = None) -> source.Loaded:
        if counting.at[0].startswith("plc/"):
            return load(path, text, maps, name)
        key = path, text, name, *(part for each in maps for part in (each.path, id(each.drive)))
        if key not in _programs:
            if len(_programs) == MOST_PROGRAMS:
                _programs.clear()
            _programs[key] = load(path, text, maps, name)
        return _programs[key]

    source.load = once


def pytest_collection_finish() -> None:
    """Look for garbage rarely, and never among the tests: most objects are trees that live as long as the process."""
    gc.collect()
    gc.freeze()


@pytest.hookimpl(trylast=True)
def pytest_sessionstart(session: pytest.Session) -> None:
    """Print the engines; as a header it would be left out of a quiet run, and this must be seen."""
    reporter = session.config.pluginmanager.get_plugin("terminalreporter")
    if reporter is None or hasattr(session.config, "workerinput"):
        return
    for each in candidates():
        reporter.write_line(f"engine {each.name}: {'runs' if each.engine else 'does not run'}, {each.note}")
    if session.config.pluginmanager.hasplugin("dsession"):
        reporter._show_progress_info = False  # its share is of tests that have a dot
        session.config.pluginmanager.register(Progress(lambda: session.testscollected, reporter.write_line))


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Generator[None, object, object]:
    """Leave tests out of the coverage that say nothing of it."""
    counting.at[0] = item.nodeid.removeprefix("tests/")
    left_out = counting.left_out(counting.at[0])
    if left_out and sys.gettrace() is not None:
        counting.imported()
    with counting.uncounted() if left_out else nullcontext():
        return (yield)


def pytest_runtest_teardown(item: pytest.Item, nextitem: pytest.Item | None) -> None:
    """What a module has worked out once for its tests ends with the last of them: trees of libraries are large."""
    module = getattr(item, "module", None)
    if module is None or getattr(nextitem, "module", None) is module:
        return
    caches = [each for each in vars(module).values() if isinstance(each, functools._lru_cache_wrapper)]
    own = [each for each in caches if each.__module__ == module.__name__ and each.cache_info().currsize]
    for each in own:
        each.cache_clear()
    _programs.clear()
    if sys.getallocatedblocks() > _blocks[0] + MANY:
        gc.collect()  # trees go in rings
        _blocks[0] = sys.getallocatedblocks()


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Print below the results what tests have recorded as their property `summary`, whichever process they ran in."""
    reports = (report for status in ("passed", "failed") for report in terminalreporter.stats.get(status, ()))
    recorded = (text for report in reports for name, text in report.user_properties if name == "summary")
    for text in dict.fromkeys(recorded):
        terminalreporter.write_line(str(text))


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """Run a test that takes `engine` or `matiec` on each such engine."""
    for fixture in ("engine", "matiec"):
        if fixture in metafunc.fixturenames:
            chosen = [each for each in candidates() if fixture == "engine" or each.name in MATIEC_NAMES]
            metafunc.parametrize(fixture, _parameters(chosen), indirect=True)


def _parameters(chosen: list[Candidate]) -> list[object]:
    found = [pytest.param(each.engine, id=each.name) for each in chosen if each.engine is not None]
    if found:
        return list(found)
    reason = "; ".join(sorted({each.note for each in chosen}))
    return [pytest.param(None, id="none", marks=pytest.mark.skip(reason=f"needs matiec: {reason}"))]


@pytest.fixture
def engine(request: pytest.FixtureRequest) -> Engine:
    """Each engine found, the embedded one first."""
    found: Engine = request.param
    return found


@pytest.fixture
def matiec(request: pytest.FixtureRequest) -> Engine:
    """Each line of matiec found."""
    found: Engine = request.param
    return found
