"""What the pages name is there: files of the project, subcommands, targets of make."""

import re
from collections.abc import Iterator
from pathlib import Path

import click

from driveblocks.cli import app
from driveblocks.render.reasons import REASONS

ROOT = Path(__file__).parents[2]
PAGES = sorted(
    [
        *(ROOT / name for name in ("README.md", "CONTRIBUTING.md", "vendor_maps/README.md")),
        *ROOT.glob("docs/**/*.md"),
        *ROOT.glob("blocks/**/*.md"),
    ]
)


def code(page: Path) -> Iterator[str]:
    """What is between backticks, a line of a table or of prose."""
    text = re.sub(r"^```.*?^```$", "", page.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)
    yield from re.findall(r"`([^`\n]+)`", text)


def paths(page: Path) -> set[str]:
    """Files and folders of the project by their paths, and modules that are to be run, as paths without an ending."""
    words = {word for words in code(page) for word in words.split()}
    modules = {found[1] for text in code(page) if (found := re.fullmatch(r"python -m ([\w.]+).*", text))}
    return {word for word in words if re.match(r"(tests|generator)/", word) and "iec61131" not in word} | {
        module.replace(".", "/") for module in modules
    }


def test_files_and_modules_are_there() -> None:
    missing = {
        path for page in PAGES for path in paths(page) if not any((ROOT / (path + end)).exists() for end in ("", ".py"))
    }
    assert not missing


def anchors(page: Path) -> set[str]:
    """What the headings of a page are called in links."""
    heads = re.findall(r"^#+ (.*)", page.read_text(encoding="utf-8"), re.MULTILINE)
    return {re.sub(r"[^\w -]", "", head.lower()).replace(" ", "-") for head in heads}


def test_links_lead_somewhere() -> None:
    for page in PAGES:
        for name, _, anchor in re.findall(r"\]\(([^)#:]*)(#([^)]*))?\)", page.read_text(encoding="utf-8")):
            there = page.parent / name if name else page
            assert there.exists(), f"{page}: {name}"
            assert not anchor or anchor in anchors(there), f"{page}: {name}#{anchor}"


def lines(page: Path) -> Iterator[str]:
    """The commands in blocks of their own, without what a second column says of them."""
    for block in re.findall(r"^```\n(.*?)^```$", page.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL):
        yield from (re.split(r"   +", line)[0] for line in block.splitlines() if line.startswith("driveblocks "))


def test_commands_and_their_options_are_there() -> None:
    for text in {text for page in PAGES for text in (*code(page), *lines(page))}:
        name, *words = text.removeprefix("driveblocks ").split()
        if text.startswith("driveblocks ") and "*" not in text:
            command = app.commands[name]
            if isinstance(command, click.Group) and words:
                command = command.commands[words[0]]
            known = {option for each in command.params for option in each.opts}
            assert {word for word in words if word.startswith("-")} <= known, text


def test_targets_of_make_are_there() -> None:
    targets = set(re.findall(r"^([\w -]+):", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE))
    known = {name for names in targets for name in names.split()}
    assert {text.split()[1] for page in PAGES for text in code(page) if text.startswith("make ")} <= known


def test_the_map_of_the_pages_names_each_of_them() -> None:
    linked = {
        ROOT / "docs" / link for link in re.findall(r"\]\(([^)#:]+)\)", (ROOT / "docs/README.md").read_text("utf-8"))
    }
    assert set(ROOT.glob("docs/**/*.md")) <= {path.resolve() for path in linked} | {ROOT / "docs/README.md"}


def test_the_page_of_motors_that_do_not_run_names_each_reason() -> None:
    page = (ROOT / "docs/not-running.md").read_text(encoding="utf-8")
    named = {int(each) for row in re.findall(r"`(?:Stop)?Reason` ([\d, ]+)", page) for each in re.findall(r"\d+", row)}
    running = {0, 1, 2, 3, 4, 5, 6}
    assert {each.code for each in REASONS} - running - named == {29}, "29 warns before 28"
    assert named <= {each.code for each in REASONS}
