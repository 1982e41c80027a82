"""Every broken map in `bad/` gives exactly the messages of its `# expect:` lines, and every message has such a map."""

import ast
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from types import FrameType

import pytest

from driveblocks.maps import load, nodes, syntax, trap
from driveblocks.maps.problem import MapError, Place, Report

FOLDER = Path(__file__).parent / "bad"
FILES = sorted(FOLDER.glob("*.yaml"))
SOURCE = Path(load.__file__).parent
MARK = "# expect: "
YAML_TROUBLE = re.compile(r"trap_|anchor|alias|tag_|directive|text_starts|.*_closed|list_|key_|escape|indented|colon")
"""Maps whose message comes from the YAML parser, which is the same with libyaml and without."""

Site = tuple[str, int]
"""File and line of a call."""


def expected(path: Path) -> list[str]:
    """The messages that a broken map states of itself, without the name of the file."""
    lines = path.read_text(encoding="utf-8").split("\n")
    return [line.removeprefix(MARK) for line in lines if line.startswith(MARK)]


def found(path: Path) -> list[str]:
    """The messages that the loader gives for a map, without the name of the file."""
    try:
        load.load(path)
    except MapError as error:
        return [str(problem).removeprefix(f"{path}:") for problem in error.problems]
    return []


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_a_bad_map_gets_its_messages(path: Path) -> None:
    assert found(path) == expected(path)


@pytest.mark.parametrize("path", [p for p in FILES if YAML_TROUBLE.match(p.stem)], ids=lambda path: path.stem)
def test_the_messages_are_the_same_without_libyaml(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(nodes, "_LIBYAML", None)
    assert found(path) == expected(path)


def test_there_are_enough() -> None:
    assert len(FILES) >= 200
    assert all(expected(path) for path in FILES)


def test_every_message_has_a_bad_map(monkeypatch: pytest.MonkeyPatch) -> None:
    hit = _traced(monkeypatch)
    missed = [site for site in _sites() if not any(_within(site, one) for one in hit)]
    assert missed == []


def test_every_trap_has_a_bad_map() -> None:
    said = "\n".join(message for path in FILES for message in expected(path))
    assert [reading for _, reading, _ in trap._TRAPS if reading not in said] == []


def test_every_complaint_of_the_parser_has_a_bad_map() -> None:
    said = "\n".join(message for path in FILES for message in expected(path))
    patterns = (re.escape(words.wrong.format("@", "@")).replace("@", ".+") for words in syntax._WORDS)
    assert [pattern for pattern in patterns if not re.search(pattern, said)] == []


def _traced(monkeypatch: pytest.MonkeyPatch) -> set[Site]:
    """Load every bad map; return each line of the maps package that stood on the stack when a mistake was noted."""
    hit: set[Site] = set()
    add = Report.add

    def record(self: Report, place: Place, wrong: str, right: str) -> None:
        hit.update(_stack(sys._getframe(1)))
        add(self, place, wrong, right)

    monkeypatch.setattr(Report, "add", record)
    for path in FILES:
        found(path)
    _what_no_small_file_shows(monkeypatch)
    return hit


def _what_no_small_file_shows(monkeypatch: pytest.MonkeyPatch) -> None:
    found(Path("...yaml"))
    monkeypatch.setattr(nodes, "MAX_NODES", 10)
    found(FILES[0])
    with pytest.raises(MapError):
        load.loads('a: "\\UFFFFFFFF"', "escape.yaml")


def _stack(frame: FrameType | None) -> Iterator[Site]:
    while frame is not None and frame.f_code.co_filename.startswith(str(SOURCE)):
        yield frame.f_code.co_filename, frame.f_lineno
        frame = frame.f_back


def _sites() -> Iterator[tuple[str, int, int]]:
    """File, first and last line of every call that may note a mistake."""
    for path in sorted(SOURCE.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and _notes(node.func):
                yield str(path), node.lineno, node.end_lineno or node.lineno


def _notes(function: ast.expr) -> bool:
    if isinstance(function, ast.Name):
        return function.id in ("unique", "known", "carried", "of_form")
    owner = ast.unparse(function.value) if isinstance(function, ast.Attribute) else ""
    name = function.attr if isinstance(function, ast.Attribute) else ""
    return (owner.endswith("report") and name in ("add", "miss")) or (
        owner in ("self", "events") and name in ("refuse", "stop")
    )


def _within(site: tuple[str, int, int], line: Site) -> bool:
    return site[0] == line[0] and site[1] <= line[1] <= site[2]
