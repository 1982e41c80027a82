"""A test program under construction: stages of statements and checks, and the text with the place of each check."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import groupby
from typing import NamedTuple

from driveblocks.bench.harness import PER_SCAN
from structured_text.language.writing import comment, flowing, paragraph, remarked

MOST_STAGES = 100
"""Stages of one program; what needs more becomes several programs."""

_COUNTERS = [
    ("Checks", "UINT", "checks done"),
    ("Failures", "UINT", "checks that failed; 0 when Done means: passed"),
    ("FirstFailed", "UINT", "number of the first check that failed, as in the comments; 0: none"),
    ("Expected", "DWORD", "what that check expected"),
    ("Actual", "DWORD", "what it found"),
    ("Done", "BOOL", "TRUE: all checks are done"),
]


class Probe(NamedTuple):
    """A call of one of the harness's blocks: VFD_Check + `block`, its pins, and what it looks at in words."""

    block: str
    pins: str
    words: str
    size: int = 4
    """Bytes that it compares; for Adu and Chars."""
    names: tuple[str, ...] = ()
    """What the bits mean, from bit 0; for Bytes."""

    @property
    def call(self) -> str:
        return f"Check{self.block}({self.pins}, Report := Report);"


Item = str | Probe

SCAN_MS = 20
"""Time of a scan, where time counts."""


@dataclass(frozen=True)
class Span:
    """How long a stage lasts: until a condition holds, a time at most; without a condition just that time."""

    until: str
    ms: int
    least_ms: int = SCAN_MS

    @property
    def over(self) -> str:
        """The condition that it is over."""
        late = f"WaitedMs > {self.ms}"
        return f"((WaitedMs > {self.least_ms}) AND ({self.until})) OR ({late})" if self.until else late

    @property
    def scans(self) -> int:
        """Most scans that it takes."""
        return self.ms // SCAN_MS + 3


@dataclass(frozen=True)
class Stage:
    """What is done in one scan, or over a span of time: what it is about, where that is in the manual.

    Statements and checks; over a span the statements at its begin, the checks at its end. `scene` is where it belongs.
    """

    words: str
    source: str
    items: Sequence[Item]
    span: Span | None = None
    scene: str = ""


class Check(NamedTuple):
    """One check of a program as reports show it; `scene` where it is one of a scene's."""

    words: str
    probe: Probe
    stage: int
    line: int
    """Of the program without its head."""
    scene: str = ""


@dataclass(frozen=True)
class Body:
    """A program but for its head, and its checks by number, from 1."""

    text: str
    checks: tuple[Check, ...]
    scans: tuple[int, ...]
    """Most scans of each stage."""


@dataclass(frozen=True)
class Program:
    """A finished program: the place of its file, its head of some lines, and the rest."""

    folder: str
    name: str
    title: str
    head: list[str]
    body: Body
    group: str = ""
    """What it is about, in the words of a user, together with other programs."""

    @property
    def text(self) -> str:
        return "\n".join([*self.head, self.body.text])

    @property
    def checks(self) -> tuple[Check, ...]:
        return self.body.checks

    @property
    def scans(self) -> tuple[int, ...]:
        """Most scans of each stage."""
        return self.body.scans

    def line(self, check: Check) -> int:
        """Where a check is in the text."""
        return len(self.head) + check.line

    @property
    def stages(self) -> int:
        return len(self.scans)

    @property
    def path(self) -> str:
        return f"{self.folder}/{self.name}.st"


@dataclass(frozen=True)
class Suite:
    """The programs of one drive, or of the shared blocks; `vectors` is how many example frames they are made from.

    `parts` are blocks that the programs need beside the harness: path below the folder of the tests -> text.
    """

    name: str
    programs: tuple[Program, ...]
    vectors: int
    parts: Mapping[str, str] = field(default_factory=dict)
    unreached: Mapping[str, str] = field(default_factory=dict)
    """Reasons that no scene reaches, and why."""


@dataclass
class Script:
    """Collects the stages of a program.

    `variables` maps a name to type and comment. `defaults` is done before each stage, `tail` after each, with its
    checks; so a table of cases is a program whose stages are assignments alone.
    """

    folder: str
    name: str
    title: str
    source: str
    variables: dict[str, tuple[str, str]] = field(default_factory=dict)
    defaults: list[str] = field(default_factory=list)
    tail: list[Item] = field(default_factory=list)
    stages: list[Stage] = field(default_factory=list)
    plant: str = ""
    """Lines that run in every scan, before the stages: what the stages of scenes wait for."""
    bodies: list[Body] = field(default_factory=list)
    """What it prints below the heads, once it is finished; copies of it for other drives have it in common."""

    def stage(self, words: str, *items: Item, source: str = "") -> None:
        """Add a stage; one with more checks than a scan may have becomes several."""
        room = PER_SCAN - len(_probes(self.tail))
        part: list[Item] = []
        checks = 0
        for item in items:
            if isinstance(item, Probe):
                if checks == room:
                    self.stages.append(Stage(words, source, part))
                    part, checks = [], 0
                checks += 1
            part.append(item)
        self.stages.append(Stage(words, source, part))

    def programs(self) -> Iterator[Program]:
        """The finished programs: one, or several with a number after the name; none without stages."""
        if not self.bodies:
            self.bodies += [_Printer(self, chunk).body() for chunk in _chunks(self.stages)]
        for number, body in enumerate(self.bodies, 1):
            name = f"{self.name}{number}" if len(self.bodies) > 1 else self.name
            yield Program(self.folder, name, self.title, self._head(name), body)

    def _head(self, name: str) -> list[str]:
        pace = "Stage by stage, each some scans long." if self.plant else "One case per scan."
        run = f"In a cyclic task until Done; it has passed when Failures is 0 and Checks is not. {pace}"
        lines = [f"(* {name}: {comment(self.title)}", "   " + "-" * 97]
        for label, text in (("Source", self.source), ("Run", run)):
            lines += paragraph(f"   {label:<9}", text)
        return [*lines, "   Made by  DriveBlocks; written by the generator from the drive's map. *)", f"PROGRAM {name}"]


def _chunks(stages: Sequence[Stage]) -> Iterator[list[Stage]]:
    """The stages of each program; a scene is never cut."""
    chunk: list[Stage] = []
    for scene, run in groupby(stages, key=lambda stage: stage.scene):
        whole = list(run)
        if scene and chunk and len(chunk) + len(whole) > MOST_STAGES:
            yield chunk
            chunk = []
        chunk += whole
        while not scene and len(chunk) > MOST_STAGES:
            yield chunk[:MOST_STAGES]
            chunk = chunk[MOST_STAGES:]
    if chunk:
        yield chunk


def _probes(items: Sequence[Item]) -> list[Probe]:
    return [item for item in items if isinstance(item, Probe)]


class _Printer:
    """Prints the body of a program and notes on which line each check is."""

    def __init__(self, script: Script, stages: list[Stage]) -> None:
        self.script, self.stages = script, stages
        self.last = _probes(script.tail)
        self.lines: list[str] = []
        self.checks: list[Check] = []

    def body(self) -> Body:
        self._declarations()
        self.lines += ["", "  Report.InScan := 0;"]
        if self.script.defaults:
            self.lines += ["  (* what every case starts from *)", *flowing(self.script.defaults, "  ")]
        self.lines += self.script.plant.splitlines()
        self.lines.append("  CASE Stage OF")
        for index, stage in enumerate(self.stages):
            self._stage(index, stage)
        self.lines += ["  ELSE", "    Done := TRUE;", "  END_CASE;"]
        self._tail()
        text = "\n".join([*self.lines, "END_PROGRAM", ""])
        scans = tuple(stage.span.scans if stage.span else 1 for stage in self.stages)
        return Body(text, tuple(self.checks), scans)

    def _declarations(self) -> None:
        items = [item for stage in self.stages for item in stage.items]
        blocks = dict.fromkeys(item.block for item in (*_probes(items), *self.last))
        rows = [
            ("Report", "VFD_Report", "what the checks have found"),
            *((f"Check{block}", f"VFD_Check{block}", "counts and notes a check") for block in blocks),
            ("Stage", "UINT", "case of this scan"),
            *((name, type_, text) for name, (type_, text) in self.script.variables.items()),
        ]
        self.lines += ["VAR_OUTPUT", *_declared(_COUNTERS), "END_VAR", "VAR", *_declared(rows), "END_VAR"]

    def _stage(self, index: int, stage: Stage) -> None:
        first, probes = len(self.checks) + 1, _probes(stage.items)
        last = first + len(probes) + len(self.last) - 1
        numbers = f"{first}" if first == last else f"{first} to {last}"
        words = f"{numbers}: {stage.words}" + (f"; {stage.source}" if stage.source else "")
        label = f"    {index}: "
        place = len(self.lines) + 1
        self.lines += paragraph(f"{label}(* ", words, " *)")
        if stage.span:
            self._span(stage, stage.span, index, probes)
        else:
            self._items(stage, stage.items, index, "      ")
        self.checks += [Check(f"{stage.words}: {item.words}", item, index, place) for item in self.last]

    def _span(self, stage: Stage, span: Span, index: int, probes: list[Probe]) -> None:
        """What begins it, then what ends it with its checks."""
        begins = [item for item in stage.items if isinstance(item, str)]
        if begins:
            self.lines += [f"      IF WaitedMs = {SCAN_MS} THEN", *flowing(begins, "        "), "      END_IF;"]
        self.lines += [*flowing([f"Next := {span.over};"], "      "), "      IF Next THEN"]
        self._items(stage, probes, index, "        ")
        self.lines.append("      END_IF;")

    def _items(self, stage: Stage, items: Sequence[Item], index: int, indent: str) -> None:
        lines, checks, about, scene = self.lines, self.checks, f"{stage.words}: ", stage.scene
        run: list[str] = []
        for item in items:
            if isinstance(item, str):
                run.append(item)
                continue
            if run:
                lines += flowing(run, indent)
                run = []
            checks.append(Check(about + item.words, item, index, len(lines) + 1, scene))
            lines += remarked(item.call, f"{len(checks)}: {item.words}", indent)
        lines += flowing(run, indent)

    def _tail(self) -> None:
        self.lines += ["  IF NOT Done THEN"]
        for item in self.script.tail:
            if isinstance(item, Probe):
                self.lines += remarked(item.call, item.words, "    ")
            else:
                self.lines += flowing([item], "    ")
        if self.script.plant:
            self.lines += ["    IF Next THEN", "      Stage := Stage + 1;", "      WaitedMs := 0;", "    END_IF;"]
            self.lines += ["    Next := FALSE;", "  END_IF;"]
        else:
            self.lines += ["    Stage := Stage + 1;", "  END_IF;"]
        names = [name for name, _, _ in _COUNTERS if name != "Done"]
        self.lines += flowing([f"{name} := Report.{name};" for name in names], "  ")


def _declared(rows: Sequence[tuple[str, str, str]]) -> list[str]:
    """Declarations with their comments in one column."""
    width = max(len(name) + len(type_) for name, type_, _ in rows)
    return [
        f"  {name} : {type_};{' ' * (width - len(name) - len(type_))} (* {comment(text)} *)"
        for name, type_, text in rows
    ]
