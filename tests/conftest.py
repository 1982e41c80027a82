"""Run engine tests on every engine found; say at the top which run, and why another does not.

`DRIVEBLOCKS_REQUIRE=matiec` (or `matiec-beremiz`, `matiec-openplc`; several with commas) makes a missing one a failure
of the whole run. `engine` is one engine after the other, `matiec` those of matiec alone; a test that needs matiec is
skipped, with the reason, where there is none. What a test records as the property `summary` is printed at the end.

Properties are tried on the same examples on every machine and in every run, however long that takes. The long run
`make long WHAT=fuzz` looks for others with the profile `search`; what it finds becomes an example of the suite.
"""

import functools
import os
import signal
from types import ModuleType
from typing import Any

import pytest
from hypothesis import HealthCheck, settings
from tests import selection
from tests.progress import Progress

from structured_text.engines.discovery import EMBEDDED, MATIEC_NAMES, Candidate, survey
from structured_text.engines.engine import Engine

REQUIRE = "DRIVEBLOCKS_REQUIRE"
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


def pytest_addoption(parser: pytest.Parser) -> None:
    """The options of the choice of tests."""
    selection.add_options(parser)


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Choose the tests of the default, the rest, or all."""
    selection.choose(config, items)


@pytest.hookimpl(optionalhook=True)
def pytest_testnodedown(node: Any) -> None:
    """Keep how many tests a process of xdist has chosen; each has collected all."""
    if counts := getattr(node, "workeroutput", {}).get("tally"):
        selection.write(node.config, counts)


def pytest_configure(config: pytest.Config) -> None:
    """Refuse to run where a required engine is missing: a green run would claim what was not tested."""
    if not hasattr(config, "workerinput") and (complaints := missing(os.environ.get(REQUIRE, ""))):
        raise pytest.UsageError("\n".join(complaints))
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:  # in the background of a script; its children inherit that
        signal.signal(signal.SIGINT, signal.default_int_handler)


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


def pytest_runtest_teardown(item: pytest.Item, nextitem: pytest.Item | None) -> None:
    """What a module has worked out once for its tests ends with the last of them: trees of libraries are large."""
    module = getattr(item, "module", None)
    if isinstance(module, ModuleType) and module is not getattr(nextitem, "module", None):
        for each in vars(module).values():
            if isinstance(each, functools._lru_cache_wrapper) and each.__module__ == module.__name__:
                each.cache_clear()


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
