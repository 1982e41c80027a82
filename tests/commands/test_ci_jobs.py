"""The jobs for users' continuous integration: both run the same lines, publish the report, and fail as shown."""

import re
from pathlib import Path
from typing import Any

import pytest
import yaml
from click.testing import CliRunner

from driveblocks.cli import app

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "ci.md").read_text(encoding="utf-8")


def jobs() -> tuple[dict[str, Any], dict[str, Any]]:
    """The jobs for GitHub and for GitLab that the page shows."""
    files = [yaml.safe_load(text) for text in re.findall(r"^```yaml\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)]
    (github,) = (job for file in files if "jobs" in file for job in file["jobs"].values())
    (gitlab,) = (job for file in files for job in file.values() if isinstance(job, dict) and "script" in job)
    return github, gitlab


def test_both_jobs_run_the_same_lines_and_publish_the_report_also_of_a_failure() -> None:
    github, gitlab = jobs()
    lines = [step["run"] for step in github["steps"] if "run" in step]
    assert lines == gitlab["script"]
    words = [line.split()[:2] for line in lines]
    assert words == [["pip", "install"], *(["driveblocks", each] for each in ("check", "build", "test"))]
    last = {step["uses"].partition("@")[0]: step for step in github["steps"][-2:]}
    assert all(step["if"] == "always()" for step in last.values())
    assert last["actions/upload-artifact"]["with"]["path"].split() == ["blocks", "report.xml"]
    assert last["mikepenz/action-junit-report"]["with"] == {"report_paths": "report.xml", "annotate_only": True}
    assert (gitlab["artifacts"]["when"], gitlab["artifacts"]["reports"]) == ("always", {"junit": "report.xml"})


def test_a_mistake_in_the_map_is_told_as_the_page_shows(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    text = (ROOT / "tests/maps/example.yaml").read_text(encoding="utf-8").replace("baud: 19200", "boud: 19200")
    Path("my_drive.yaml").write_text(text, encoding="utf-8")
    checks = next(step["run"] for step in jobs()[0]["steps"] if step.get("run", "").startswith("driveblocks check"))
    result = CliRunner().invoke(app, checks.split()[1:])
    assert result.exit_code == 2
    assert f"```\n{result.stderr}```\n" in PAGE
