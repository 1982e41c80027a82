"""The words that we do not use, in all that a person reads: docs/style.md says what is written instead."""

import io
import re
import tokenize
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
SOURCES = ROOT / "generator"

WORST = {
    r"\bbehind\b": "after, or a place",
    r"\bin vain\b": "unanswered",
    r"\bby chance\b": "random",
    r"\b(is|are|was|were|be|been) told\b": "is reported",
    r"\btells? (of|whether|how|which|what|why|that|apart)\b": "shows, says",
    r"\bwish(es)?\b": "request",
    r"\b(poll|stop|frame|read|write|request|reply|command|byte)s? (goes|go|leaves|leave)\b": "is sent",
    r"\b(motor|drive|shaft)s? stands?\b": "is at standstill",
    r"\bknown to stand\b": "is at standstill",
    r"\bstands (at|behind|beside|for|in|on|there|twice)\b": "is, means",
    r"\b(that|so) many\b": "the number",
    r"\bby halves\b": "only complete",
    r"\bthese are they\b": "the characters",
}
"""A pattern in small letters, so that it finds no name, and what to say."""

PLACES = {
    "docs/testing.md": "a mistake behind every pin",
    "engines/embedded/global_variables.py": "the slot behind each name",
    "templates/motor/Motor.st.j2": '"/behind.j2"',
    "commands/run.py": "simulated drives behind --tcp",
    "engines/embedded/ranges.py": "change behind our back",
    "plc/options.py": "what is behind an address",
    "plc/simulated.py": "behind a TCP port",
    "plc/wiring.py": "The variable behind a pin",
}
"""Where `behind` is a place: the end of a path, and the words."""


def worst(text: str) -> list[tuple[int, str, str]]:
    """What a text should not say: its line, the words, and what to say."""
    found = [
        (text.count("\n", 0, match.start()) + 1, " ".join(match[0].split()), instead)
        for pattern, instead in WORST.items()
        for match in re.finditer(pattern.replace(" ", r"\s+"), text)
    ]
    return sorted(found)


def words_of(path: Path, text: str) -> str:
    """The text with blanks for all that is neither a comment nor a text: names may be what they are."""
    if path.suffix == ".py":
        spans = _python(text)
    elif path.suffix == ".st" or (path.suffix == ".j2" and ".md" not in path.suffixes):
        spans = (match.span() for match in re.finditer(r'\(\*.*?\*\)|\{#.*?#\}|"[^"]*"', text, re.DOTALL))
    else:
        spans = iter([(0, len(text))])
    kept, made = 0, list[str]()
    for start, end in spans:
        made += [re.sub(r"[^\n]", " ", text[kept:start]), text[start:end]]
        kept = end
    return "".join(made)


def _python(text: str) -> Iterator[tuple[int, int]]:
    starts = [0]
    for line in text.splitlines(keepends=True):
        starts.append(starts[-1] + len(line))
    wanted = (tokenize.COMMENT, tokenize.STRING, getattr(tokenize, "FSTRING_MIDDLE", -1))
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type in wanted:
            start, end = (starts[row - 1] + column for row, column in (token.start, token.end))
            yield from _apart(text, start, end) if token.type == tokenize.STRING else [(start, end)]


def _apart(text: str, start: int, end: int) -> Iterator[tuple[int, int]]:
    """A text without the expressions in it, if it is an f-string in one token, as before Python 3.12."""
    kept = start
    if "f" in text[start : start + 2].lower().partition('"')[0]:
        for match in re.compile(r"\{[^{}]*\}").finditer(text, start, end):
            yield kept, match.start()
            kept = match.end()
    yield kept, end


def faults(path: Path) -> list[str]:
    """The findings in a file, without the allowed places; the words are looked for first, since few files have any."""
    text = path.read_text(encoding="utf-8")
    name = path.relative_to(ROOT).as_posix()
    for end, place in PLACES.items():
        if name.endswith(end):
            text = text.replace(place, place.replace("behind", "......"))
    found = worst(words_of(path, text)) if worst(text) else []
    return [f"{name}:{line}: {words!r}: {instead}" for line, words, instead in found]


PAGES = [
    *ROOT.glob("*.md"),
    *(path for path in ROOT.glob("docs/**/*.md") if path.name != "style.md"),
    ROOT / "vendor_maps/README.md",
    *SOURCES.rglob("*.md"),
    *ROOT.glob("blocks/**/*.md"),
]
TESTS = [path for path in ROOT.glob("tests/**/*.py") if path != Path(__file__)]
KINDS = {
    "pages": PAGES,
    "maps": [*ROOT.glob("vendor_maps/*.yaml"), *ROOT.glob("examples/*.st")],
    "templates": [*SOURCES.rglob("*.j2"), *SOURCES.rglob("*.st")],
    "messages and docstrings": [*SOURCES.rglob("*.py"), *SOURCES.rglob("*.yaml")],
    "tests": [*TESTS, *ROOT.glob("tests/**/*.yaml"), *ROOT.glob("tests/**/*.diff"), ROOT / "Makefile"],
}


@pytest.mark.parametrize("kind", KINDS)
def test_what_a_person_reads_has_none_of_the_worst_words(kind: str) -> None:
    assert KINDS[kind]
    assert [fault for path in sorted(KINDS[kind]) for fault in faults(path)] == []


def test_the_name_of_a_test_is_a_sentence_with_none_of_them() -> None:
    names = [name for path in TESTS for name in re.findall(r"^def (test_\w+)", path.read_text("utf-8"), re.MULTILINE)]
    assert len(names) > 1000
    assert [name for name in names if worst(name.replace("_", " "))] == []


@pytest.mark.parametrize(("end", "place"), PLACES.items())
def test_each_place_is_still_there(end: str, place: str) -> None:
    paths = [path for paths in KINDS.values() for path in paths if path.as_posix().endswith(end)]
    assert any(place in path.read_text(encoding="utf-8") for path in paths)


def test_each_of_them_is_found() -> None:
    text = (
        "A poll goes\nbehind the stop by chance; it is told, in vain, as a wish, that many, by halves: a motor "
        "stands.\n"
        "It tells of words, known to\nstand, and these are they; it stands for one."
    )
    assert [line for line, _, _ in worst(text)] == [1, *[2] * 8, *[3] * 2, *[4] * 2]
    assert {words for _, words, _ in worst(text)} >= {"known to stand", "behind", "poll goes"}


def test_names_are_not_judged() -> None:
    python = 'behind = 1  # a word\nsay(f"{behind} behind")\n'
    assert worst(words_of(Path("one.py"), python)) == [(2, "behind", "after, or a place")]
    block = "Behind := behinds; (* not behind *)\n"
    assert worst(words_of(Path("one.st"), block)) == [(1, "behind", "after, or a place")]
