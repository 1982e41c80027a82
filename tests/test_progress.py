"""What a run says while it goes on."""

from types import SimpleNamespace

from tests.progress import Progress


def test_each_file_is_named_once_with_how_far_and_how_long_still() -> None:
    said: list[str] = []
    seconds = iter((0, 30))
    progress = Progress(lambda: 80, said.append, lambda: next(seconds))
    for name in ("a/test_b.py::test_c", *("a/test_b.py::test_f",) * 19, "test_d.py::test_e[::]"):
        progress.pytest_runtest_logstart(f"tests/{name}")
        progress.pytest_runtest_logfinish()
    assert [line.split() for line in said] == [["0", "%", "a/test_b.py"], ["25", "%", "90", "s", "left", "test_d.py"]]


def test_nothing_that_has_not_passed_is_kept_back() -> None:
    progress = Progress(lambda: 1, print)
    shown = [
        progress.pytest_report_teststatus(SimpleNamespace(passed=passed, when=when))  # type: ignore[arg-type]
        for passed, when in ((True, "call"), (False, "call"), (False, "setup"), (True, "teardown"))
    ]
    assert shown == [("passed", "", ""), None, None, None]
