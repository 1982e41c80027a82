"""A driver runs the library's C without Python, and a driver that does not compile is reported."""

import os
from pathlib import Path

import pytest
from tests.native.driver import Driver, run

from structured_text.engines.engine import EngineError
from structured_text.engines.matiec import MatiecEngine
from structured_text.engines.matiec.cache import SEAL

CRC = """
static MB_CRC16 crc;
int main(void)
{
    START(MB_CRC16, crc);
    memcpy(crc.ADU.value.table, "\\x01\\x03\\x00\\x00\\x00\\x02", 6);
    crc.LENGTH.value = 6;
    MB_CRC16_body__(&crc);
    printf("%04X %d\\n", crc.CRC.value, MB_HEXVALUE(1, NULL, 'B'));
    return 0;
}
"""


def test_driver_runs_blocks_and_functions(matiec: MatiecEngine) -> None:
    """01 03 00 00 00 02 has the CRC C4 0B on the wire, low byte first (Modbus over serial line 1.02, 6.2.2)."""
    assert run(Driver(CRC).build(matiec)).stdout == "0BC4 11\n"


def test_a_driver_that_runs_counts_as_used(tmp_path: Path) -> None:
    """What is longest unused leaves the cache: a program must not go during a run of an hour."""
    program, seal = tmp_path / "driver", tmp_path / SEAL
    program.write_text("#!/bin/sh\nexit 0\n", encoding="utf-8")
    program.chmod(0o755)
    seal.touch()
    os.utime(seal, (1, 1))
    run(program)
    assert seal.stat().st_mtime > 1


def test_mistake_is_reported(matiec: MatiecEngine) -> None:
    with pytest.raises(EngineError, match=r"driver\.c:1:"):
        Driver("int main(void) { return undeclared; }").build(matiec)
