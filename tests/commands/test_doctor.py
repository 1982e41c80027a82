"""`driveblocks doctor`: what is there, what is missing, what that costs, where to get it."""

import json
from dataclasses import replace
from pathlib import Path
from typing import Any
from unittest.mock import MagicMock

import pytest
import yaml
from click.testing import CliRunner, Result

from driveblocks.cli import app
from structured_text.engines import discovery
from structured_text.engines.discovery import Candidate, survey
from structured_text.engines.engine import Engine
from structured_text.engines.matiec import MatiecEngine

NOWHERE = {"PATH": "", "HOME": "/nonexistent"}


@pytest.fixture
def bare(tmp_path: Path) -> dict[str, str]:
    """The environment of a machine that has Python and nothing else."""
    return {**NOWHERE, "MATIEC_HOME": "", "CC": "", "DRIVEBLOCKS_CACHE": str(tmp_path / "cache")}


def run(*words: str, **environment: str) -> Result:
    """Run the command as the command line does."""
    return CliRunner().invoke(app, ["doctor", *words], env=environment)


def parts(report: dict[str, Any]) -> dict[str, str]:
    return {part["name"]: part["state"] for part in report["parts"]}


def test_bare_machine_is_told_where_to_get_what_is_missing(bare: dict[str, str]) -> None:
    result = run(**bare)
    for place in (
        "https://beremiz.org",
        "https://autonomylogic.com",
        "https://github.com/beremiz/matiec",
        "apt install",
    ):
        assert place in result.output
    assert "\x1b" not in result.output


def test_bare_machine_works_on_the_embedded_engine(bare: dict[str, str]) -> None:
    result = run("--json", **bare)
    report = json.loads(result.output)
    assert result.exit_code == 0
    assert report["works"] is True
    assert parts(report) == {
        "Python": "ok",
        "PyYAML": "ok",
        "embedded": "ok",
        "matiec-beremiz": "missing",
        "matiec-openplc": "missing",
        "C compiler": "missing",
        "build cache": "ok",
    }
    assert report["matiec"] == []
    expected = ["matiec, line of Beremiz", "matiec, line of OpenPLC", "C compiler"]
    assert [each["missing"] for each in report["missing"]][:3] == expected
    assert all(each["cost"] and each["remedy"] for each in report["missing"])


def test_matiec_found_is_named_with_its_place(bare: dict[str, str], matiec: MatiecEngine) -> None:
    found = matiec.installation
    cache = str(matiec.cache.root)
    environment = {
        **bare,
        "MATIEC_HOME": str(found.iec2c),
        "CC": matiec.compiler.command[0],
        "DRIVEBLOCKS_CACHE": cache,
    }
    environment["PATH"] = "/usr/bin:/bin"  # the assembler and the linker
    report = json.loads(run("--json", **environment).output)
    assert parts(report)[matiec.name] == "ok"
    (entry,) = report["matiec"]
    assert (entry["engine"], entry["iec2c"], entry["library"]) == (matiec.name, str(found.iec2c), str(found.library))
    assert entry["behaviour"]["for_turns"] in (0, 1)
    assert len([each for each in report["missing"] if each["missing"].startswith("matiec")]) == 1


def test_matiec_without_a_c_compiler_lacks_the_compiler_only(bare: dict[str, str], matiec: MatiecEngine) -> None:
    result = run("--json", **bare | {"MATIEC_HOME": str(matiec.installation.iec2c)})
    report = json.loads(result.output)
    assert [each["missing"] for each in report["missing"]] == ["C compiler"]
    assert parts(report)["iec2c"] == "broken"


def test_cache_that_cannot_be_written_is_said(bare: dict[str, str], tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    result = run(**bare | {"DRIVEBLOCKS_CACHE": str(tmp_path / "file" / "x")})
    assert result.exit_code == 0
    assert "cannot write the build cache" in result.output


WRONG = MagicMock(Engine)
WRONG.build.return_value.instance.return_value = MagicMock(__getitem__=lambda *_: 43)


@pytest.mark.usefixtures("bare")
@pytest.mark.parametrize(("made", "note", "said"), [(None, "gone", "gone"), (WRONG, "", "21 + 21 gave 43")])
def test_embedded_engine_that_does_not_work_is_a_failure(
    made: Engine | None, note: str, said: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    found = replace(survey(NOWHERE), embedded=Candidate("embedded", made, note))
    monkeypatch.setattr(discovery, "survey", lambda: found)
    result = run()
    assert (result.exit_code, said in result.output) == (1, True)


def test_libyaml_missing_is_said(bare: dict[str, str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(yaml, "__with_libyaml__", False)
    result = run(**bare)
    assert "without libyaml" in result.output
    assert "slower" in result.output
