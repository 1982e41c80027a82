"""What the test programs are made of beside the library: a report, and one small block per kind of check."""

from functools import cache
from importlib.resources import files

FOLDER = "harness"
PER_SCAN = 32
"""Most checks of one scan: so many failures find room in the report."""

NAMES = (
    "DB_Failure", "DB_Failures", "DB_Report", "DB_CheckBytes", "DB_CheckWord", "DB_CheckNumber", "DB_CheckFlag",
    "DB_CheckBetween", "DB_CheckReal", "DB_CheckText", "DB_CheckAdu", "DB_CheckChars",
)  # fmt: skip
"""Types and blocks each behind what it uses."""


@cache
def texts() -> dict[str, str]:
    """Path below the folder of the tests -> text, in that order."""
    folder = files(__package__) / "st"
    return {f"{FOLDER}/{name}.st": (folder / f"{name}.st").read_text(encoding="utf-8") for name in NAMES}
