"""What of a library has run while its programs ran: lines, outcomes of decisions, and what was missed."""

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cache
from importlib.resources import files
from typing import Protocol, TypeVar, runtime_checkable

import yaml

from driveblocks.bench.outcome import FAILED, PASSED, Outcome, Result
from structured_text.engines.coverage import Branches, Lines
from structured_text.engines.embedded import EmbeddedEngine
from structured_text.engines.engine import Engine, Source
from structured_text.engines.matiec import MatiecEngine

_Key = TypeVar("_Key")

_TWIN = re.compile(r"(MB_\w+?)32\.st")
"""The same statements for 32 drives instead of 8: where nothing but that number differs, the smaller one is counted."""


@runtime_checkable
class Counted(Protocol):
    def coverage(self) -> Lines:
        """How often each line with a statement has run; empty without counters."""

    def branches(self) -> Branches:
        """How often each outcome of each decision came about. Raises EngineError where that is not known."""


def counting(engine: Engine) -> Engine:
    """The same engine with counters; one that has none as it is."""
    if isinstance(engine, EmbeddedEngine):
        return EmbeddedEngine(loop_limit=engine.loop_limit, coverage=True)
    if isinstance(engine, MatiecEngine):
        return replace(engine, flags=replace(engine.flags, coverage=True))
    return engine


@dataclass(frozen=True)
class Exemption:
    """An outcome that nothing reaches, with the reason; `block` and `text` (of the line) may hold * for anything."""

    block: str
    text: str
    outcome: str
    why: str
    lines: int = 0


@cache
def exemptions() -> tuple[Exemption, ...]:
    """What is known to be out of reach."""
    text = (files(__package__) / "unreachable.yaml").read_text(encoding="utf-8")
    return tuple(Exemption(**row) for row in yaml.safe_load(text))


@dataclass(frozen=True, order=True)
class Miss:
    """A line that never ran (column 0), or an outcome that never came about; `why` if that is explained."""

    path: str
    line: int
    column: int
    text: str
    why: str = ""

    def __str__(self) -> str:
        place = f"{self.path}:{self.line}:{self.column}" if self.column else f"{self.path}:{self.line}"
        return f"{place}: {self.text}{f'; explained: {self.why}' if self.why else ''}"


@dataclass
class Coverage:
    """What has run on one engine, over all builds that hold a block: `texts` has their lines by path."""

    engine: str
    lines: Lines = field(default_factory=dict)
    branches: Branches = field(default_factory=dict)
    texts: dict[str, list[str]] = field(default_factory=dict)
    twins: set[str] = field(default_factory=set)
    """Blocks that are counted as another one, which has the same statements."""

    def add(self, blocks: Iterable[Source], library: Counted) -> None:
        """Count what has run of some blocks of a library. Raises EngineError."""
        texts = {block.path: block.text for block in blocks}
        twins = {path for path in texts if _is_twin(path, texts)}
        own = {path: text for path, text in texts.items() if path not in twins}
        self.twins |= twins
        self.texts |= {path: text.split("\n") for path, text in own.items()}
        _sum(self.lines, library.coverage(), own)
        _sum(self.branches, library.branches(), own)

    @property
    def misses(self) -> list[Miss]:
        """All that never ran or came about, by place."""
        return sorted(each for path in self.texts for each in self._missed(path))

    def _missed(self, path: str) -> Iterator[Miss]:
        explained: dict[int, str] = {}
        for outcome, hits in self.branches.get(path, {}).items():
            if not hits:
                found = self._exemption(path, outcome.line, outcome.text)
                if found is not None:
                    below = range(outcome.line + 1, outcome.line + 1 + found.lines)
                    explained |= dict.fromkeys(below, f"see line {outcome.line}")
                yield Miss(path, outcome.line, outcome.column, f"never {outcome.text}", found.why if found else "")
        for line, hits in self.lines.get(path, {}).items():
            if not hits:
                yield Miss(path, line, 0, "never ran", explained.get(line, ""))

    def _exemption(self, path: str, line: int, outcome: str) -> Exemption | None:
        block, text = path.rpartition("/")[2].removesuffix(".st"), self.texts[path][line - 1].strip()
        fitting = (each for each in exemptions() if each.outcome == outcome)
        return next((each for each in fitting if _fits(each.block, block) and _fits(each.text, text)), None)

    def count(self, path: str = "") -> "Figures":
        """The figures of one file, or of all."""
        missed = [each for each in self.misses if path in ("", each.path)]
        lines, branches = (
            sum(len(hits) for each, hits in table.items() if path in ("", each))
            for table in (self.lines, self.branches)
        )
        return Figures(
            lines, branches, [each for each in missed if not each.column], [each for each in missed if each.column]
        )


@dataclass(frozen=True)
class Figures:
    """How many lines and outcomes there are, and which were missed."""

    lines: int
    branches: int
    missed_lines: list[Miss]
    missed_branches: list[Miss]

    @property
    def lines_run(self) -> str:
        """Lines that have run, of how many."""
        return f"{self.lines - len(self.missed_lines)}/{self.lines}"

    @property
    def branches_run(self) -> str:
        """Outcomes that came about, of how many."""
        return f"{self.branches - len(self.missed_branches)}/{self.branches}"

    @property
    def explained(self) -> int:
        """How much of what was missed is explained."""
        return sum(bool(each.why) for each in (*self.missed_lines, *self.missed_branches))

    def __str__(self) -> str:
        explained = f" ({self.explained} explained)" if self.explained else ""
        return f"lines {self.lines_run}, branches {self.branches_run}{explained}"

    @property
    def percent(self) -> tuple[float, float]:
        """Lines and branches that have run, of those that can."""
        return _percent(self.lines, self.missed_lines), _percent(self.branches, self.missed_branches)


def _percent(total: int, missed: list[Miss]) -> float:
    """The share of what has run; what is explained is left out. Where there is nothing, nothing has run: 0."""
    reachable = total - sum(bool(each.why) for each in missed)
    return 100.0 * (1 - sum(not each.why for each in missed) / reachable) if reachable else 0.0


def _is_twin(path: str, texts: Mapping[str, str]) -> bool:
    """Whether a block for 32 drives has just the statements of that for 8."""
    smaller = _TWIN.sub(r"\g<1>8.st", path)
    return smaller != path and smaller in texts and _statements(texts[path]) == _statements(texts[smaller])


def _statements(text: str) -> str:
    """The body without comments, the number of drives left open."""
    body = re.sub(r"\(\*.*?\*\)", "", text, flags=re.DOTALL).rpartition("END_VAR")[2]
    return re.sub(r"\b(?:8|32)\b|(?<=[a-z])(?:8|32)\b", "N", body)


def _sum(totals: dict[str, dict[_Key, int]], more: dict[str, dict[_Key, int]], paths: Iterable[str]) -> None:
    for path in paths:
        table = totals.setdefault(path, {}) if path in more else {}
        for key, hits in more.get(path, {}).items():
            table[key] = table.get(key, 0) + hits


def _fits(pattern: str, text: str) -> bool:
    return re.fullmatch(".*".join(map(re.escape, pattern.split("*"))), text) is not None


def result(coverage: Coverage, least: float = 0.0) -> Result:
    """The coverage as checks of lines and of branches: each must reach `least` percent of what can be reached."""
    figures = coverage.count()
    checks = zip(("lines", "branches"), figures.percent, (figures.missed_lines, figures.missed_branches), strict=True)
    outcomes = [_check(words, percent, missed, least) for words, percent, missed in checks]
    properties = (("lines", figures.lines_run), ("branches", figures.branches_run))
    return Result(coverage.engine, "library", "coverage", tuple(outcomes), properties=properties)


def _check(words: str, percent: float, missed: list[Miss], least: float) -> Outcome:
    if percent >= least:
        return Outcome(words, PASSED)
    rest = "\n".join(str(each) for each in missed if not each.why)
    return Outcome(words, FAILED, f"{percent:.2f} % have run, {least:g} % are required:\n{rest}")
