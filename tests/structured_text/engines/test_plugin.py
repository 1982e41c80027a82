"""A run of the tests says which engines ran, and fails where a required one is missing."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).parents[3]
CONFTEST = REPOSITORY / "tests" / "conftest.py"
TESTS = """
import pytest

def test_each(engine):
    assert engine.name

def test_matiec(matiec):
    assert matiec.name.startswith("matiec-")

@pytest.mark.parametrize("right", [True, False])
def test_it(right, record_property):
    record_property("summary", f"right: {right}")
    record_property("other", "not shown")
    assert right
"""


@pytest.fixture
def run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> "Runner":
    """Run pytest on two tests under our conftest.py, in a process of its own."""
    (tmp_path / "conftest.py").write_text(CONFTEST.read_text(encoding="utf-8"), encoding="utf-8")
    (tmp_path / "test_it.py").write_text(TESTS, encoding="utf-8")
    (tmp_path / "pytest.ini").write_text("[pytest]\n", encoding="utf-8")
    for name in ("PYTEST_ADDOPTS", "PYTEST_XDIST_WORKER", "PYTEST_XDIST_WORKER_COUNT", "DRIVEBLOCKS_REQUIRE"):
        monkeypatch.delenv(name, raising=False)
    return Runner(tmp_path)


class Runner:
    """Calls pytest; `bare` hides every iec2c of this machine."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def __call__(self, *arguments: str, bare: bool = False, **environment: str) -> tuple[int, str]:
        code = "import sys, pytest;"
        environment["PYTHONPATH"] = os.pathsep.join(
            [environment.get("PYTHONPATH", ""), str(REPOSITORY)]
        )  # of our conftest.py
        if bare:
            environment |= {"PATH": "", "MATIEC_HOME": ""}
        done = subprocess.run(
            [sys.executable, "-c", f"{code} sys.exit(pytest.main(sys.argv[1:]))", *arguments],
            cwd=self.folder,
            env={**os.environ, **environment},
            capture_output=True,
            text=True,
            timeout=600,
            check=False,
        )
        return done.returncode, done.stdout + done.stderr


@pytest.mark.parametrize("arguments", [["-rs"], ["-rs", "-q", "-n", "2"]])
def test_engines_are_named_once_at_the_top_and_what_tests_say_once_at_the_end(
    run: Runner, arguments: list[str]
) -> None:
    status, output = run(*arguments, bare=True)
    assert status == 1
    assert output.count("engine embedded: runs") == 1
    assert output.count("engine matiec-beremiz: does not run, no iec2c found") == 1
    assert output.count("engine matiec-openplc: does not run, no iec2c found") == 1
    assert "1 failed, 2 passed, 1 skipped" in output
    assert "needs matiec: no iec2c found" in output
    lines = output.splitlines()
    assert [lines.count(f"right: {right}") for right in (True, False)] == [1, 1]
    assert "not shown" not in lines


@pytest.mark.parametrize("required", ["matiec", "embedded,matiec-openplc"])
def test_missing_engine_that_is_required_fails_the_run(run: Runner, required: str) -> None:
    status, output = run(bare=True, DRIVEBLOCKS_REQUIRE=required)
    assert status == pytest.ExitCode.USAGE_ERROR
    assert "is required, but: no iec2c found" in output
    assert "passed" not in output


def test_embedded_engine_is_always_required(run: Runner) -> None:
    """A folder that hides the package makes it fail to import."""
    hidden = run.folder / "sitecustomize.py"
    hidden.write_text("import sys\nsys.modules['structured_text.engines.embedded'] = None\n", encoding="utf-8")
    status, output = run(bare=True, PYTHONPATH=str(run.folder))
    assert status == pytest.ExitCode.USAGE_ERROR
    assert "embedded is required, but: cannot be imported" in output


def test_required_name_that_nobody_knows(run: Runner) -> None:
    status, output = run(bare=True, DRIVEBLOCKS_REQUIRE="matjec")
    assert status == pytest.ExitCode.USAGE_ERROR
    assert "knows no engine 'matjec': matiec, embedded, matiec-beremiz, matiec-openplc" in output


def test_every_engine_found_runs(run: Runner, matiec: object) -> None:
    assert matiec
    status, output = run("-v", "-k", "each or matiec", DRIVEBLOCKS_REQUIRE="matiec")
    assert status == 0
    assert "test_each[embedded]" in output
    assert "test_matiec[matiec-" in output
    assert "skipped" not in output
