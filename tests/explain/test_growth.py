"""Long pastes: twice the text is twice the work, which is counted and not timed."""

import sys

import pytest
from tests.explain.explaining import rtu

from driveblocks.explain import scan
from driveblocks.explain.explanation import Explainer
from driveblocks.explain.paste import read
from driveblocks.modbus import frame
from driveblocks.modbus.checksum import crc_bytes

READ = "01 03 20 00 00 01 8F CA"
LONG = {
    "double-spaced bytes": lambda size: "01  " * size,
    "bytes between tabs": lambda size: "41\t" * size,
    "lines of two bytes": lambda size: "01  02\n" * (size // 2),
    "bytes between bars": lambda size: "01 |" * size,
    "ASCII frames in one line": lambda size: ":01" * size,
    "labels": lambda size: "> " * size + READ,
}


def calls(text: str) -> int:
    """How many functions are called while a text is read."""
    counted = 0

    def count(*_: object) -> None:
        nonlocal counted
        counted += 1

    before = sys.getprofile()
    sys.setprofile(count)
    try:
        read(text)
    finally:
        sys.setprofile(before)
    return counted


@pytest.mark.parametrize("name", LONG)
def test_reading_grows_with_the_text(name: str) -> None:
    assert calls(LONG[name](1600)) < 2.5 * calls(LONG[name](800))


def test_checksums_grow_with_the_zeros_after_a_frame(monkeypatch: pytest.MonkeyPatch) -> None:
    summed = 0

    def count(data: bytes) -> bytes:
        nonlocal summed
        summed += len(data)
        return crc_bytes(data)

    for module in (scan, frame):
        monkeypatch.setattr(module, "crc_bytes", count)
    nobody = rtu("FF 03 20 00 00 01")
    sums = []
    for size in (2000, 4000):
        summed = 0
        assert not Explainer().explain(read(nobody + " 00" * size)).good
        sums.append(summed)
    assert sums[1] < 2.5 * sums[0]
