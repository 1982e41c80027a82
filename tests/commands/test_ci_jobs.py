"""The jobs for users' continuous integration: their form, and what their lines do in a fresh clone."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import jinja2
import pytest
from tests.commands import ci_jobs

SCALE = Path("generator/driveblocks/render/templates/drive/Scale.st.j2")
NO_SHELL = os.name == "nt" or shutil.which("bash") is None


def test_both_jobs_run_the_same_lines() -> None:
    files = ci_jobs.jobs(ci_jobs.PAGE)
    assert list(files) == ["github", "gitlab"]
    assert ci_jobs.lines(files["github"]) == ci_jobs.lines(files["gitlab"])
    words = [line.split()[:2] for line in ci_jobs.lines(files["github"])]
    assert words == [["pip", "install"], *(["driveblocks", each] for each in ("check", "build", "test"))]


def test_github_publishes_the_report_also_of_a_failure() -> None:
    file = ci_jobs.jobs(ci_jobs.PAGE)["github"]
    (job,) = file["jobs"].values()
    assert set(file) == {"name", True, "permissions", "env", "jobs"}  # to YAML 1.1 the key `on` is TRUE
    assert all(re.fullmatch(r"[\w-]+/[\w-]+@v\d+", step["uses"]) for step in job["steps"] if "uses" in step)
    last = {step["uses"].partition("@")[0]: step for step in job["steps"][-2:]}
    assert all(step["if"] == "always()" for step in last.values())
    assert last["actions/upload-artifact"]["with"]["path"].split() == ["blocks", "report.xml"]
    assert last["mikepenz/action-junit-report"]["with"] == {"report_paths": "report.xml", "annotate_only": True}


def test_gitlab_publishes_the_report_also_of_a_failure() -> None:
    (job,) = ci_jobs.jobs(ci_jobs.PAGE)["gitlab"].values()
    assert job["artifacts"]["when"] == "always"
    assert job["artifacts"]["reports"] == {"junit": "report.xml"}


class Runner:
    """A fresh clone, a virtual environment that has it instead of what `pip` would fetch, and a user's folder."""

    def __init__(self, folder: Path) -> None:
        """Make the three in a folder."""
        self.clone = ci_jobs.clone(folder)
        self.venv, self.mine = folder / "venv", folder / "mine"
        self.mine.mkdir()
        subprocess.run([sys.executable, "-m", "venv", "--without-pip", str(self.venv)], check=True)
        self._install()

    def _install(self) -> None:
        (packages,) = self.venv.glob("lib/python*/site-packages")
        needed = Path(jinja2.__file__).parents[1]
        (packages / "clone.pth").write_text(f"{self.clone / 'generator'}\n{needed}\n", encoding="utf-8")
        command = self.venv / "bin" / "driveblocks"
        text = f"#!{self.venv / 'bin' / 'python'}\nfrom driveblocks.cli import main\nmain()\n"
        command.write_text(text, encoding="utf-8")
        command.chmod(0o755)

    def map(self, old: str = "", new: str = "") -> None:
        """Put the map of the example drive into the user's folder, with one text changed."""
        text = ci_jobs.EXAMPLE.read_text(encoding="utf-8")
        assert old in text
        (self.mine / "my_drive.yaml").write_text(text.replace(old, new) if old else text, encoding="utf-8")

    def run(self) -> "subprocess.CompletedProcess[str]":
        """Run the lines of the jobs after the one that installs."""
        install, *lines = ci_jobs.lines(ci_jobs.jobs(ci_jobs.PAGE)["github"])
        assert install == ci_jobs.INSTALL
        return ci_jobs.run(lines, self.mine, ci_jobs.environment(self.venv, str(self.clone)))

    def report(self) -> ElementTree.Element:
        """The JUnit XML."""
        return ElementTree.parse(self.mine / "report.xml").getroot()  # noqa: S314  (our own file)


@pytest.fixture
def runner(tmp_path: Path) -> Runner:
    """Skipped where there is nothing to clone, as in a source distribution, or no bash."""
    if NO_SHELL:
        pytest.skip("needs bash")
    if shutil.which("git") is None or not (ci_jobs.ROOT / ".git").exists():
        pytest.skip("needs git and a checkout: there is nothing to clone")
    return Runner(tmp_path)


def test_a_good_map_is_checked_built_and_tested(runner: Runner) -> None:
    runner.map()
    done = runner.run()
    assert done.returncode == 0, done.stdout + done.stderr
    assert sorted(path.name for path in runner.mine.iterdir()) == ["blocks", "my_drive.yaml", "report.xml"]
    assert (runner.mine / "blocks" / "iec61131" / "my_drive" / "EX100_Command.st").is_file()
    root = runner.report()
    assert 10_000 <= int(root.attrib["tests"]) <= 20_000, "as the page says"
    assert 1.5e6 < (runner.mine / "report.xml").stat().st_size < 2.5e6, "as the page says"
    assert (root.attrib["failures"], root.attrib["errors"]) == ("0", "0")
    cases = [(case.attrib["classname"], case.attrib["name"]) for case in root.iter("testcase")]
    assert len(cases) == len(set(cases))  # GitLab shows only the first of those with one class and name
    assert done.stderr == ""
    assert len(done.stdout.splitlines()) < 100  # a log that a person reads


def test_a_mistake_in_the_map_fails_at_check_and_nothing_follows(runner: Runner) -> None:
    runner.map("baud: 19200", "boud: 19200")
    done = runner.run()
    assert done.returncode == 2
    assert f"```\n{done.stderr}```\n" in ci_jobs.PAGE.read_text(encoding="utf-8")
    assert [path.name for path in runner.mine.iterdir()] == ["my_drive.yaml"]


def test_a_failed_check_fails_the_job_and_is_in_the_report(runner: Runner) -> None:
    template = runner.clone / SCALE
    text = template.read_text(encoding="utf-8")
    assert "_TO_REAL(Count) {{ scale.factor | times }};" in text
    template.write_text(text.replace("| times }};", "| times }} + 1.0;"), encoding="utf-8")
    runner.map()
    done = runner.run()
    assert done.returncode == 1, done.stdout + done.stderr
    (shown,) = re.findall(r"^```\n(tests/.*?)```$", ci_jobs.PAGE.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)
    assert shown in done.stdout
    failures = list(runner.report().iter("failure"))
    assert any(failure.attrib["message"] == "expected 548.8, found 549.8" for failure in failures)
    places = {found for failure in failures for found in re.findall(r"^at (\S+):\d+$", failure.text or "", re.M)}
    assert places
    assert all((runner.mine / "blocks" / place).is_file() for place in places)
