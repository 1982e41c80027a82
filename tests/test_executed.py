"""Product code is what some command executes; what only tests need is in the tests."""

import subprocess
import sys
from pathlib import Path

import pytest

ELSEWHERE = {
    "driveblocks.output.release": "`make release`",
}


@pytest.mark.skipif(sys.platform == "win32", reason="one of the commands serves a pseudo-terminal")
def test_every_module_is_executed_by_some_command(tmp_path: Path) -> None:
    """In a process of its own, in which nothing has run or been kept before."""
    arguments = [sys.executable, "-m", "tests.executed", str(tmp_path)]
    idle = subprocess.run(arguments, capture_output=True, text=True, check=False, timeout=600)
    assert idle.returncode == 0, idle.stderr
    assert set(idle.stdout.split()) <= ELSEWHERE.keys()
