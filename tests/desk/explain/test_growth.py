"""Long pastes: twice the text is twice the work, which is counted and not timed."""

from collections.abc import Callable

import pytest
from tests.desk.explain.explaining import rtu
from tests.steps import grows_evenly

from driveblocks.desk.explain.explanation import Explainer
from driveblocks.desk.explain.paste import read
from driveblocks.modbus import frame, scan
from driveblocks.modbus.checksum import crc_bytes

READ = "01 03 20 00 00 01 8F CA"
LONG: dict[str, Callable[[int], str]] = {
    "double-spaced bytes": lambda size: "01  " * size,
    "bytes between tabs": lambda size: "41\t" * size,
    "lines of two bytes": lambda size: "01  02\n" * (size // 2),
    "bytes between bars": lambda size: "01 |" * size,
    "ASCII frames in one line": lambda size: ":01" * size,
    "labels": lambda size: "> " * size + READ,
}


@pytest.mark.parametrize("name", LONG)
def test_reading_grows_with_the_text(name: str) -> None:
    assert grows_evenly(lambda size: lambda: read(LONG[name](1600 * size)))


def test_checksums_grow_with_the_zeros_after_a_frame(monkeypatch: pytest.MonkeyPatch) -> None:
    summed: list[int] = []

    def count(data: bytes) -> bytes:
        summed.append(len(data))
        return crc_bytes(data)

    for module in (scan, frame):
        monkeypatch.setattr(module, "crc_bytes", count)
    sums = []
    for size in (2000, 4000):
        summed.clear()
        assert not Explainer().explain(read(rtu("FF 03 20 00 00 01") + " 00" * size)).good
        sums.append(sum(summed))
    assert sums[1] < 2.5 * sums[0]
