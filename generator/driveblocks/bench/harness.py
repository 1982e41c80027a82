"""What the test programs are made of beside the library: a report, and one small block per kind of check."""

from functools import cache
from importlib.resources import files

FOLDER = "harness"
PER_SCAN = 32
"""Most checks of one scan: the report has room for this number of failures."""

NAMES = (
    "VFD_Failure", "VFD_Failures", "VFD_Report", "VFD_CheckBytes", "VFD_CheckWord", "VFD_CheckNumber", "VFD_CheckFlag",
    "VFD_CheckBetween", "VFD_CheckReal", "VFD_CheckText", "VFD_CheckAdu", "VFD_CheckChars",
)  # fmt: skip
"""Types and blocks, each after what it uses."""

SIMULATION = (
    "VFD_TestTimes", "VFD_TestFlags", "VFD_TestFate", "VFD_TestSeen", "VFD_TestPins", "VFD_TestMotor", "VFD_TestHear",
    "VFD_TestSay", "VFD_TestWatch",
)  # fmt: skip
"""The same, of what simulated drives have in common; these need the library."""


@cache
def texts() -> dict[str, str]:
    """Path below the folder of the tests -> text, in that order."""
    return _read(NAMES)


@cache
def simulation() -> dict[str, str]:
    """The same of what simulated drives have in common."""
    return _read(SIMULATION)


def _read(names: tuple[str, ...]) -> dict[str, str]:
    folder = files(__package__) / "st"
    return {f"{FOLDER}/{name}.st": (folder / f"{name}.st").read_text(encoding="utf-8") for name in names}
