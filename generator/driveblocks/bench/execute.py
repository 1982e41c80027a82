"""One test program on one engine: scan until it is done, and note each check as the program reports it."""

import ctypes
import time
from dataclasses import dataclass

from driveblocks.bench.outcome import ERROR, FAILED, PASSED, Outcome, Result
from driveblocks.bench.record import recorded
from driveblocks.bench.script import Check, Program
from structured_text.engines.engine import EngineError, Instance, Library, ScanError, Value

SCAN_NS = 10_000_000
"""How far the clock advances from scan to scan."""


@dataclass(frozen=True)
class Setting:
    """Where a program runs: engine, drive or `modbus`, what comes before its path, seconds that it may take."""

    engine: str
    unit: str
    root: str
    seconds: float


def execute(library: Library, program: Program, setting: Setting) -> Result:
    """Run a program. Raises nothing of the engine's: what goes wrong is an outcome of the checks that it affects."""
    start = time.perf_counter()
    run = _Run(program, setting, start + setting.seconds)
    try:
        run.scan(library.instance(program.name))
    except (EngineError, KeyError, ValueError) as error:
        run.give_up(f"cannot be run: {error.args[0] if error.args else error}")
    seconds = time.perf_counter() - start
    record = recorded(library, program, _first_bad(run.outcomes))
    return Result(
        setting.engine, setting.unit, program.name, tuple(run.outcomes), seconds, group=program.group, record=record
    )


def _first_bad(outcomes: list[Outcome]) -> int | None:
    """Place of the first check of a scene that failed."""
    return next((at for at, one in enumerate(outcomes) if one.scene and one.status == FAILED), None)


class _Run:
    def __init__(self, program: Program, setting: Setting, deadline: float) -> None:
        self.program, self.path = program, setting.root + program.path
        self.deadline, self.seconds = deadline, setting.seconds
        self.outcomes: list[Outcome] = []

    def scan(self, instance: Instance) -> None:
        """Scan stage by stage. A scan that goes wrong costs its own checks and no others."""
        for stage, checks in enumerate(_by_stage(self.program)):
            if time.perf_counter() > self.deadline:
                self.give_up(f"the program was not done after {self.seconds:g} s")
                return
            trouble = self._stage(instance, stage)
            self._note(instance, checks, trouble)
            self._go_on(instance, stage + 1)
        self._once(instance, self.program.stages)
        if instance["Done"] is not True:
            scans = self.program.stages + 1
            self.outcomes.append(
                Outcome("ends", FAILED, f"the program is not Done after {scans} scans", path=self.path)
            )

    def _go_on(self, instance: Instance, stage: int) -> None:
        """Put the program where it would be after a good scan: a bad one may have stopped short of it."""
        if instance["Stage"] != stage:
            instance["Stage"] = stage
        if instance["Report.Checks"] != len(self.outcomes):
            instance["Report.Checks"] = len(self.outcomes)

    def _stage(self, instance: Instance, stage: int) -> str:
        """Scan until a stage is over; what went wrong, or nothing."""
        trouble = self._once(instance, stage)
        for _ in range(1, self.program.scans[stage]):
            if trouble or instance["Stage"] != stage:
                break
            trouble = self._once(instance, stage)
        return trouble

    def _once(self, instance: Instance, stage: int) -> str:
        """Scan once; what went wrong, or nothing."""
        try:
            instance.scan(stage * SCAN_NS)
        except ScanError as error:
            return str(error)
        return ""

    def _note(self, instance: Instance, checks: list[Check], trouble: str) -> None:
        """The checks of one stage, by what the report says."""
        failed = _failed(instance)
        done = _number(instance["Report.Checks"])
        for check in checks:
            number = len(self.outcomes) + 1
            if number in failed:
                self._add(check, FAILED, *_shown(check, instance, failed[number]))
            elif number > done:
                self._add(check, ERROR, trouble or "the check was not reached")
            elif trouble and number == done and check.probe.block == "Text":
                self._add(check, FAILED, *_texts(instance))
            else:
                self._add(check, PASSED)

    def give_up(self, why: str) -> None:
        """Count all checks that are still to come as lost."""
        for check in self.program.checks[len(self.outcomes) :]:
            self._add(check, ERROR, why)

    def _add(self, check: Check, status: str, message: str = "", expected: str = "", actual: str = "") -> None:
        words, line = f"{len(self.outcomes) + 1}: {check.words}", self.program.line(check)
        self.outcomes.append(Outcome(words, status, message, expected, actual, self.path, line, check.scene))


def _by_stage(program: Program) -> list[list[Check]]:
    stages: list[list[Check]] = [[] for _ in range(program.stages)]
    for check in program.checks:
        stages[check.stage].append(check)
    return stages


def _number(value: Value) -> int:
    assert isinstance(value, int)  # noqa: S101  (the report's fields are numbers)
    return value


def _failed(instance: Instance) -> dict[int, str]:
    """Number of each check that failed in the last scan -> the path of its entry in the report."""
    paths = [f"Report.Failed[{index}]" for index in range(_number(instance["Report.InScan"]))]
    return {_number(instance[f"{path}.Number"]): path for path in paths}


def _shown(check: Check, instance: Instance, path: str) -> tuple[str, str, str]:
    """Message, expected and actual value of a check that failed."""
    if check.probe.block == "Text":
        return _texts(instance)
    suffix = "Real" if check.probe.block == "Real" else ""
    expected, actual = (printed(check, instance[f"{path}.{name}{suffix}"]) for name in ("Expected", "Actual"))
    return f"expected {expected}, found {actual}", expected, actual


def _texts(instance: Instance) -> tuple[str, str, str]:
    values = (instance["Report.ExpectedText"], instance["Report.ActualText"])
    expected, actual = (_text(value) if isinstance(value, bytes) else str(value) for value in values)
    return f"expected `{expected}`, found `{actual}`", expected, actual


def _text(data: bytes) -> str:
    """Bytes of a text: UTF-8 or, failing that, GB18030; what is neither is shown in hexadecimal."""
    for encoding in ("utf-8", "gb18030"):
        try:
            return data.decode(encoding)
        except UnicodeDecodeError:
            continue
    return data.hex(" ").upper()


def _real(value: float) -> str:
    """A REAL with as few digits as distinguish it from its neighbours."""
    texts = (f"{value:.{digits}g}" for digits in range(6, 10))
    return next((text for text in texts if ctypes.c_float(float(text)).value == value), f"{value:.9g}")


def printed(check: Check, value: Value) -> str:
    """A value as the check's kind is read: 16#01F4, 500, TRUE, 01 F4, 50.0."""
    if isinstance(value, float):
        return _real(value)
    number = _number(value)
    if check.probe.block == "Word":
        return f"16#{number:04X}"
    if check.probe.block == "Flag":
        return "TRUE" if number else "FALSE"
    if check.probe.block in ("Adu", "Chars"):
        return (number & 0xFFFFFFFF).to_bytes(4, "big")[4 - check.probe.size :].hex(" ").upper()
    if check.probe.names:
        return ", ".join(name for place, name in enumerate(check.probe.names) if number >> place & 1) or "none of them"
    return str(number)
