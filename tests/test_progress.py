"""What a run says while it goes on."""

from types import SimpleNamespace

from tests.progress import Progress


def test_each_file_is_named_once_with_the_share_that_has_ended() -> None:
    said: list[str] = []
    progress = Progress(lambda: 4, said.append)
    for name in ("a/test_b.py::test_c", "test_d.py::test_e[::]", "a/test_b.py::test_f"):
        progress.pytest_runtest_logstart(f"tests/{name}")
        progress.pytest_runtest_logfinish()
    assert said == ["  0 %  a/test_b.py", " 25 %  test_d.py"]


def test_nothing_that_has_not_passed_is_kept_back() -> None:
    progress = Progress(lambda: 1, print)
    shown = [
        progress.pytest_report_teststatus(SimpleNamespace(passed=passed, when=when))  # type: ignore[arg-type]
        for passed, when in ((True, "call"), (False, "call"), (False, "setup"), (True, "teardown"))
    ]
    assert shown == [("passed", "", ""), None, None, None]
