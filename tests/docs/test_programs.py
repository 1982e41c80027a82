"""Every program in Structured Text on the pages is taken from there, found clean, and run for some scans."""

import re
from pathlib import Path

import pytest
from tests import shipped
from tests.blocks.library import sources
from tests.examples.test_examples import PARTS, SPARE

from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.engine import Library, Source
from structured_text.language.lint import lint_sources

ROOT = Path(__file__).parents[2]
FENCE = re.compile(r"^```\n(.*?)^```$", re.MULTILINE | re.DOTALL)
ELSEWHERE = {
    "before-buying.md", "ci.md", "first-hour.md", "lint.md", "linux.md", "listen.md", "plant-test.md", "program.md",
    "prove.md", "run.md", "save-parameters.md", "simulate.md", "stop.md", "what-changed.md",
}  # fmt: skip
"""Pages whose blocks are commands, rules, formulas or C; tests of their own take what runs."""
HARD_STOP = (
    "PROGRAM HardStops\nVAR\n  HardStop : VFD_HardStop;\n  Bus, Bus1, Bus2 : MB_ByteLine8;\n  FirstScan : BOOL;\n"
    "  ResetButton : BOOL;\nEND_VAR\n{}END_PROGRAM\n"
)


def _programs() -> dict[str, str]:
    found = dict[str, str]()
    for page in (*ROOT.glob("docs/*.md"), *ROOT.glob("blocks/docs/*.md")):
        for text in FENCE.findall(page.read_text(encoding="utf-8")):
            program = HARD_STOP.format(text) if page.stem == "VFD_HardStop" else text
            if page.name not in ELSEWHERE:
                (name,) = re.findall(r"\APROGRAM (\w+)\n", program)
                found[name] = program
    return found


PROGRAMS = _programs()


@pytest.fixture(scope="module")
def library() -> Library:
    """The library with every program of the pages."""
    parts = (*PARTS, *(f"{each.path.stem}/" for each in shipped.sources()))
    texts = [each for each in sources() if each.path.startswith(parts) and not SPARE.search(each.path)]
    texts += [Source(f"{name}.st", text) for name, text in PROGRAMS.items()]
    assert [
        each for each in lint_sources((each.path, each.text) for each in texts) if "HardStops" not in each.path
    ] == []
    return EmbeddedEngine().build(texts)


def test_the_pages_have_programs() -> None:
    assert {"Plant", "Parameters", "HardStops", *(f"{prefix}_Motor" for prefix in shipped.drives())} <= PROGRAMS.keys()


@pytest.mark.parametrize("name", PROGRAMS)
def test_a_program_of_a_page_runs(name: str, library: Library) -> None:
    program = library.instance(name)
    for _ in range(5):
        program.scan(10_000_000)
    assert program.state()


def test_the_call_on_the_page_of_linux_names_pins_that_are_there() -> None:
    page = (ROOT / "docs/linux.md").read_text(encoding="utf-8")
    (call,) = re.findall(r"^Bus\((.*?)\);", page, re.MULTILINE | re.DOTALL)
    block = (ROOT / "blocks/openplc/shared/LX_Port.st").read_text(encoding="utf-8")
    declared = set(re.findall(r"^  (\w+) :", block, re.MULTILINE))
    assert {name for name, _ in re.findall(r"(\w+) := ([^,]+)", call)} <= declared
