"""Signals that do not come from a scan do what they did before."""

import signal
import subprocess
import sys

import pytest

from structured_text.engines.matiec import MatiecEngine

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such signals")

PROGRAM = """
import faulthandler, os, signal, sys
from structured_text.engines.discovery import survey
from structured_text.engines.engine import Source

if sys.argv[2] == "faulthandler":
    faulthandler.enable()
if sys.argv[2] == "own":
    signal.signal(signal.SIGFPE, lambda *_: sys.exit(7))
engine = next(each.engine for each in survey().candidates() if each.name == sys.argv[1])
text = "FUNCTION_BLOCK B VAR_OUTPUT X : DINT; Zero : DINT; END_VAR X := 1; X := X / Zero; END_FUNCTION_BLOCK"
block = engine.build([Source("b.st", text)]).instance("B")
try:
    block.scan(0)
except Exception as error:
    print(type(error).__name__)
print("scanned", flush=True)
os.kill(os.getpid(), signal.SIGFPE)
print("alive", flush=True)
"""


@pytest.mark.parametrize(
    ("mode", "status", "said"),
    [
        ("plain", -signal.SIGFPE, ""),
        ("faulthandler", -signal.SIGFPE, "Floating point exception"),
        ("own", 7, ""),
    ],
)
def test_signal_outside_a_scan(matiec: MatiecEngine, mode: str, status: int, said: str) -> None:
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, matiec.name, mode], capture_output=True, text=True, timeout=600, check=False
    )
    assert "scanned" in done.stdout
    assert "alive" not in done.stdout
    assert said in done.stderr
    assert done.returncode == status
