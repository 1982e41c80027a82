"""Engines are found, or it is said why not."""

import os
from pathlib import Path

from structured_text.engines.discovery import EMBEDDED, NO_COMPILER, NO_IEC2C, survey
from structured_text.engines.matiec import MatiecEngine

NOWHERE = {"PATH": "", "HOME": "/nonexistent"}


def notes(**environment: str) -> dict[str, str]:
    """Name -> note of what is not found."""
    return {each.name: each.note for each in survey({**NOWHERE, **environment}).candidates() if each.engine is None}


def test_embedded_is_always_there() -> None:
    first = survey(NOWHERE).candidates()[0]
    assert first.name == EMBEDDED
    assert first.engine is not None
    assert first.engine.name == EMBEDDED


def test_no_matiec() -> None:
    assert notes() == {"matiec-beremiz": NO_IEC2C, "matiec-openplc": NO_IEC2C}


def test_no_c_compiler(matiec: MatiecEngine, tmp_path: Path) -> None:
    iec2c = matiec.installation.iec2c
    found = notes(MATIEC_HOME=str(iec2c), DRIVEBLOCKS_CACHE=str(tmp_path))
    assert found == dict.fromkeys(("matiec-beremiz", "matiec-openplc"), f"{iec2c}: {NO_COMPILER}")


def test_one_line_only(matiec: MatiecEngine) -> None:
    iec2c, compiler = matiec.installation.iec2c, matiec.compiler.command[0]
    cache = str(matiec.cache.root)
    found = notes(MATIEC_HOME=str(iec2c), CC=compiler, DRIVEBLOCKS_CACHE=cache, PATH=os.environ["PATH"].split(":")[-1])
    other = {"matiec-beremiz": "matiec-openplc", "matiec-openplc": "matiec-beremiz"}[matiec.name]
    assert list(found) == [other]
    assert str(iec2c) in found[other]


def test_cache_that_cannot_be_written(matiec: MatiecEngine, tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    found = notes(
        MATIEC_HOME=str(matiec.installation.iec2c),
        CC=matiec.compiler.command[0],
        DRIVEBLOCKS_CACHE=str(tmp_path / "file" / "x"),
    )
    assert len(found) == 2
    assert all("cannot write the build cache" in note for note in found.values())


def test_iec2c_that_is_none(tmp_path: Path, matiec: MatiecEngine) -> None:
    (tmp_path / "iec2c").write_text("#!/bin/sh\nexit 7\n", encoding="utf-8")
    (tmp_path / "iec2c").chmod(0o755)
    (tmp_path / "lib").mkdir()
    (tmp_path / "lib" / "ieclib.txt").touch()
    (tmp_path / "lib" / "iec_std_lib.h").touch()
    found = notes(MATIEC_HOME=str(tmp_path), CC=matiec.compiler.command[0], DRIVEBLOCKS_CACHE=str(tmp_path / "cache"))
    assert found["matiec-openplc"] == found["matiec-beremiz"]
    assert "failed with status 7" in found["matiec-openplc"]
