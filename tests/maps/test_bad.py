"""Every broken map of `bad/` gives exactly its messages, and every message has such a map."""

import ast
import re
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from types import FrameType

import pytest
from tests.maps import bad

from driveblocks.maps import load, nodes, syntax, trap
from driveblocks.maps.problem import MapError, Place, Report

SOURCE = Path(load.__file__).parent
YAML_TROUBLE = re.compile(r"trap_|anchor|alias|tag_|directive|text_starts|.*_closed|list_|key_|escape|indented|colon")
"""Maps whose message comes from the YAML parser, which is the same with libyaml and without."""

Site = tuple[str, int]
"""File and line of a call."""


def messages(text: str) -> list[str]:
    """The messages that the loader gives for a map, without the name of the file."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "map.yaml"
        path.write_bytes(text.encode("utf-8"))
        return found(path)


def found(path: Path) -> list[str]:
    """The messages that the loader gives for a file, without its name."""
    try:
        load.load(path)
    except MapError as error:
        return [str(problem).removeprefix(f"{path}:") for problem in error.problems]
    return []


def wrong(names: Iterable[str]) -> dict[str, tuple[list[str], list[str]]]:
    """The broken maps that get other messages than theirs: what they get, and what they should."""
    cases = bad.cases()
    said = {name: messages(cases[name].text) for name in names}
    return {name: (each, cases[name].messages) for name, each in said.items() if each != cases[name].messages}


def test_every_bad_map_gets_its_messages_and_every_message_has_a_bad_map(monkeypatch: pytest.MonkeyPatch) -> None:
    hit = _watched(monkeypatch)
    assert wrong(bad.cases()) == {}
    _assert_what_no_small_map_shows(monkeypatch)
    assert [site for site in _sites() if not any(_within(site, one) for one in hit)] == []


def test_the_messages_are_the_same_without_libyaml(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(nodes, "_LIBYAML", None)
    assert wrong(filter(YAML_TROUBLE.match, bad.cases())) == {}


def test_every_case_has_a_name_of_its_own_and_a_message() -> None:
    assert len(bad.cases()) == sum(map(len, bad.topics().values())) >= 600
    assert all(case.messages for case in bad.cases().values())


def test_a_case_is_written_out_as_a_whole_map(capfdbinary: pytest.CaptureFixture[bytes]) -> None:
    bad.main(["bit_twice"])
    text = capfdbinary.readouterr().out.decode("utf-8")
    good = (bad.FOLDER / "small.yaml").read_text(encoding="utf-8")
    assert text == good.replace("运行中}]", "运行中}, {bit: 0, name: Ready, zh: 准备}]")
    bad.main([])
    assert capfdbinary.readouterr().out.decode("utf-8").split() == list(bad.cases())


def test_a_text_too_long() -> None:
    text = (bad.FOLDER / "small.yaml").read_text(encoding="utf-8").replace("both say so", "x" * 4001)
    assert messages(text) == ["56:113: a value of 4001 characters; one value has at most 4000"]


def test_every_trap_has_a_bad_map() -> None:
    said = "\n".join(message for case in bad.cases().values() for message in case.messages)
    assert [reading for _, reading, _ in trap._TRAPS if reading not in said] == []


def test_every_complaint_of_the_parser_has_a_bad_map() -> None:
    said = "\n".join(message for case in bad.cases().values() for message in case.messages)
    patterns = (re.escape(words.wrong.format("@", "@")).replace("@", ".+") for words in syntax._WORDS)
    assert [pattern for pattern in patterns if not re.search(pattern, said)] == []


def _watched(monkeypatch: pytest.MonkeyPatch) -> set[Site]:
    """Where mistakes are noted from now on."""
    hit: set[Site] = set()
    add = Report.add

    def record(self: Report, place: Place, wrong: str, right: str) -> None:
        hit.update(_stack(sys._getframe(1)))
        add(self, place, wrong, right)

    monkeypatch.setattr(Report, "add", record)
    return hit


def _assert_what_no_small_map_shows(monkeypatch: pytest.MonkeyPatch) -> None:
    found(Path("...yaml"))
    monkeypatch.setattr(nodes, "MAX_TEXT", 10)
    found(bad.FOLDER / "small.yaml")
    monkeypatch.setattr(nodes, "MAX_NODES", 10)
    found(bad.FOLDER / "small.yaml")
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
