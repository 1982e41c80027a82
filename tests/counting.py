"""Leaves work out of the coverage of Python, which makes it take four times as long."""

import functools
import importlib
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, ParamSpec, TypeVar

from coverage.tracer import CTracer
from tests.rooms import modules

P = ParamSpec("P")
T = TypeVar("T")

NOT_COUNTED = (
    "bench/", "blocks/", "native/", "regression/", "drives/", "line/", "reference/", "shapes/",
    "output/test_build.py::test_english",
    "commands/test_build.py::test_what_is_checked_in", "commands/test_explain.py::test_an_explanation_fits",
    "commands/test_show.py::test_a_page_fits", "commands/test_test.py", "diff/test_diff.py::test_no_fact",
    "docs/test_pages.py::test_the_block", "docs/test_pages.py::test_the_example",
    "export/test_tc6.py::test_a_first_motor_for", "export/test_tc6.py::test_what_is_written",
    "maps/test_agreement.py", "maps/test_bad.py::test_every", "maps/test_form.py", "maps/test_fuzz.py",
    "maps/test_hostile.py", "maps/test_load.py::test_a_good_map", "maps/test_meaning.py",
    "maps/test_schema.py::test_a_good_map", "maps/test_view.py", "render/test_house.py",
    "plc/test_session.py::test_a_signal",
    "prove/test_prove.py::test_some_of", "prove/test_prove.py::test_the_rules", "prove/test_prove.py::test_the_terms",
    "second/test_matrix.py", "second/test_mended.py",
    "site/test_commission.py::test_a_drive_is_found", "site/test_commission.py::test_another_family",
    "site/test_commission.py::test_pages_say", "site/test_commission.py::test_what_is_wrong_with",
    "site/test_line.py::test_figures", "site/test_line.py::test_rounds", "site/test_line.py::test_stops",
    "structured_text/engines/compare/", "structured_text/engines/traces/",
    "structured_text/engines/embedded/test_accepted.py",
    "structured_text/engines/embedded/test_control.py::test_chains",
    "structured_text/engines/embedded/test_ranges.py", "structured_text/language/test_hostile.py",
    "structured_text/language/test_programs.py::test_random",
    "testing/test_mutants.py", "testing/test_programs.py", "testing/test_runner.py",
    "testing/test_scenes.py::test_a_mistake", "testing/test_scenes.py::test_a_wrong_token",
    "testing/test_scenes.py::test_scenes_pass",
)  # fmt: skip
"""Where the names begin of tests that are left out as a whole.

What they run others run, too; that of Structured Text has counters of its own.
"""


ALL_CASES = ("desk/", "explain/", "maps/", "plc/", "prove/", "simulator/", "stand/", "structured_text/")
"""Where the names begin of tests each case of which goes its own way through the code; of others the first is counted.

A counted test takes up to twelve times as long.
"""
_begun = set[str]()


def left_out(name: str) -> bool:
    """Whether a test that begins is left out: by its name, or after another case of it has run."""
    function, _, case = name.partition("[")
    again = bool(case) and function in _begun and not name.startswith(ALL_CASES)
    _begun.add(function)
    return again or name.startswith(NOT_COUNTED)


ENGINE = ("structured_text/", "commands/test_lint.py")
"""Where the names begin of tests that count the embedded engine and the linter; in all others they are uncounted."""
at: list[str] = [""]
"""The name of the test that runs."""


def without_engine() -> None:
    """From now on leave out what the embedded engine and the linter read, compile and run, but in their own tests."""
    from structured_text.engines.embedded import EmbeddedEngine, EmbeddedLibrary  # which a test takes away
    from structured_text.language import checker, lint, parser

    parser._parsed = _aside(parser._parsed)
    checker._checked = _aside(checker._checked)
    lint._pou = _aside(lint._pou)
    EmbeddedEngine.build = _aside(EmbeddedEngine.build)  # type: ignore[method-assign]
    scanner = EmbeddedLibrary._scanner
    EmbeddedLibrary._scanner = lambda *made: _aside(scanner(*made))  # type: ignore[method-assign]


def _aside(run: Callable[P, T]) -> Callable[P, T]:
    """A function during which the tracer of coverage rests; its own stack of calls stays even."""

    @functools.wraps(run)
    def rested(*args: P.args, **named: P.kwargs) -> T:
        tracer: Any = None if at[0].startswith(ENGINE) else sys.gettrace()
        if not isinstance(tracer, CTracer):
            return run(*args, **named)
        tracer.stop()
        try:
            return run(*args, **named)
        finally:
            tracer.start()

    return rested


@functools.cache
def imported() -> None:
    """Import every module once: its first lines would be missing if the first test to need it were not counted."""
    for name in modules():
        if not name.endswith("__main__"):
            importlib.import_module(name)


@contextmanager
def uncounted() -> Iterator[None]:
    """Run without a trace function.

    The marker `no_cover` would do for a test, but in processes of pytest-xdist it stops one of two measurements only.
    """
    tracer = sys.gettrace()
    sys.settrace(None)
    try:
        yield
    finally:
        sys.settrace(tracer)
