"""What the tests of the matiec engine share: a block with everything in it, and compilers that misbehave."""

import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from structured_text.engines.engine import Source
from structured_text.engines.matiec import CCompiler, Installation, MatiecEngine
from structured_text.engines.matiec.cache import Cache
from structured_text.engines.matiec.library import MatiecLibrary

Builder = Callable[[str], MatiecLibrary]


@pytest.fixture
def build(matiec: MatiecEngine) -> Builder:
    """Build one text with each line of matiec."""
    return lambda text: matiec.build([Source("test.st", text)])


@pytest.fixture
def fresh(matiec: MatiecEngine, tmp_path: Path) -> MatiecEngine:
    """Each line of matiec with an empty cache of its own."""
    return replace(matiec, cache=Cache(tmp_path / "cache"))


def script(path: Path, body: str) -> Path:
    """Write a shell script that can be run."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"#!/bin/sh\n{body}\n", encoding="utf-8")
    path.chmod(0o755)
    return path


@pytest.fixture
def fake(tmp_path: Path) -> Callable[..., MatiecEngine]:
    """Make an engine of two shell scripts: iec2c, and a C compiler."""
    if sys.platform == "win32":
        pytest.skip("the fake compilers are shell scripts")

    def make(iec2c: str, compiler: str = "exit 1", seconds: float = 600.0) -> MatiecEngine:
        (tmp_path / "lib").mkdir(exist_ok=True)
        (tmp_path / "lib" / "ieclib.txt").touch()
        installation = Installation(script(tmp_path / "iec2c", iec2c), tmp_path / "lib", tmp_path / "lib")
        cc = CCompiler((str(script(tmp_path / "cc", compiler)),), "fake 1", seconds=seconds)
        return MatiecEngine(installation, cc, cache=Cache(tmp_path / "cache"), seconds=seconds)

    return make
