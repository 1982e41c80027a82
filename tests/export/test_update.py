"""An update replaces the library: no file of it holds a program of the user, and the page says how."""

import re

import pytest
from tests.export.stock import made

from driveblocks.export.target import WRITERS

MOTORS = {
    "codesys": "CHF_Motor.xml",
    "plcopen": "CHF_Motor.xml",
    "twincat": "motor/CHF_Motor.TcPOU",
    "siemens": "CHF_Motor.scl",
    "openplc": "CHF_Motor.st",
}


@pytest.mark.parametrize("target", MOTORS)
@pytest.mark.thorough
def test_no_file_of_the_library_holds_a_program_of_the_user(target: str) -> None:
    files = {path.removeprefix(f"{target}/"): text for path, text in WRITERS[target](made()).items()}
    holding = {path for path, text in files.items() if re.search(r"PROGRAM CHF_Motor|\"CHF_Motor\"", text)}
    assert MOTORS[target] in holding
    own = re.compile(r"(motor/)?CHF_(Motor|MotorBytes|Task)\.\w+|README\.md")
    assert [path for path in holding if not own.fullmatch(path)] == []
    section = files["README.md"].partition("\n## 5. Update\n")[2].partition("\n## ")[0]
    assert "_Version" in section
    assert "standstill" in section or "motors\n   stand" in section
