"""A scene that failed, played once more: pins and frames scan by scan, as a table and as a picture."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from driveblocks.bench.scenes.reason import REASONS
from driveblocks.bench.script import SCAN_MS, Program
from driveblocks.docs.canvas import Canvas
from structured_text.engines.engine import EngineError, Instance, Library, Value

INPUTS = (
    "Enable", "RunForward", "RunReverse", "JogForward", "JogReverse", "QuickStop", "CoastStop", "FaultReset",
    "MonitorOnly", "SpeedOnly", "SupplyOff", "StopAll", "Restart",
)  # fmt: skip
"""Pins that a scene sets."""
OUTPUTS = (
    "CommOk", "Ready", "Running", "Reverse", "AtSpeed", "ZeroSpeed", "Warning", "Fault", "StopConfirmed", "StopOverdue",
    "Error",
)  # fmt: skip
"""Pins that the drive block shows."""
_NAMES = {number: name for name, number in REASONS.items()}
ROWS, EARLIER = 16, 8
"""Lines of a table: the last ones before the failure, and of those before only what changes a pin or is a write."""
READS = ("03", "04")
"""Function codes that change nothing in a drive."""


@dataclass(frozen=True)
class Moment:
    """A scan: time in the scene, step, pins that are TRUE, Reason, speeds in Hz, characters sent and heard."""

    ms: int
    step: str
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    reason: int
    shown: float
    true: float
    sent: str
    heard: str

    @property
    def pins(self) -> tuple[object, ...]:
        """What makes a line of its own."""
        return self.step, self.inputs, self.outputs, self.reason


def recorded(library: Library, program: Program, at: int | None) -> tuple[Moment, ...]:
    """Play a program up to the stage of a check, by its place; the moments of the check's scene. None: nothing."""
    if at is None:
        return ()
    check = program.checks[at]
    steps = {one.stage: one.words.partition(": ")[0] for one in program.checks if one.scene == check.scene}
    try:
        return tuple(_moments(library.instance(program.name), program, steps, check.stage))
    except (EngineError, KeyError, ValueError):
        return ()


def _moments(instance: Instance, program: Program, steps: dict[int, str], last: int) -> Iterator[Moment]:
    begin = min(steps)
    ms = 0
    for _ in range(sum(program.scans[: last + 1])):
        stage = instance["Stage"]
        assert isinstance(stage, int)  # noqa: S101  (a UINT)
        if stage > last:
            return
        instance.scan()
        if stage >= begin:
            yield _moment(instance, ms, steps.get(stage, ""))
            elapsed = instance["Pins.ElapsedMs"]
            assert isinstance(elapsed, int)  # noqa: S101  (a UINT)
            ms += elapsed


def _moment(instance: Instance, ms: int, step: str) -> Moment:
    hertz, milli, reason = instance["Motor.OutputFrequencyHz"], instance["Seen.Milli"], instance["Motor.Reason"]
    assert isinstance(hertz, float)  # noqa: S101  (a REAL)
    assert isinstance(milli, int)  # noqa: S101  (a DINT)
    assert isinstance(reason, int)  # noqa: S101  (a UINT)
    return Moment(
        ms,
        step,
        tuple(name for name in INPUTS if instance[f"Pins.{name}"]),
        tuple(name for name in OUTPUTS if instance[f"Motor.{name}"]),
        reason,
        hertz,
        milli / 1000,
        _characters(instance["TxChars"], instance["TxCount"]),
        _characters(instance["RxChars"], instance["RxCount"]),
    )


def _characters(box: Value, count: Value) -> str:
    if not isinstance(box, list) or not isinstance(count, int):
        return ""
    return bytes(octet for octet in box[:count] if isinstance(octet, int)).hex(" ").upper()


# ---------------------------------------------------------------- as a table


def table(record: Sequence[Moment]) -> str:
    """The last lines before the failure: each change of a pin and each frame; before them, what reads do not hide."""
    rows: list[list[str]] = []
    telling: list[bool] = []
    before: tuple[object, ...] = ()
    for one in record:
        frames = [*([f"> {one.sent}"] if one.sent else []), *([f"< {one.heard}"] if one.heard else [])]
        for frame in frames or ([""] if one.pins != before or one is record[-1] else []):
            rows.append(_row(one, frame))
            telling.append(one.pins != before or frame[5:7] not in READS)
            before = one.pins
        before = one.pins
    earlier = [row for row, tells in zip(rows[:-ROWS], telling[:-ROWS], strict=True) if tells]
    kept = [["ms", "set", "shown", "Reason", "Hz", "motor", "frame"], *earlier[-EARLIER:], *rows[-ROWS:]]
    widths = [max(len(row[column]) for row in kept) for column in range(len(rows[0]))]
    lines = ["  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)) for row in kept]
    return "\n".join(line.rstrip() for line in lines)


def _row(one: Moment, frame: str) -> list[str]:
    shown, true = f"{one.shown:.1f}", f"{one.true:.1f}"
    return [str(one.ms), " ".join(one.inputs), " ".join(one.outputs), _NAMES.get(one.reason, "?"), shown, true, frame]


# ---------------------------------------------------------------- as a picture

WIDTH, LEFT, TOP, ROW, HIGH = 1000, 150, 60, 24, 14
TITLE = 105
"""Characters of a title that find room."""
PICTURE = rb"<svg [^>]*>\n<title>\w+ on [\w-]+: "
"""How a picture begins."""


def picture(title: str, record: Sequence[Moment]) -> str:
    """A timing diagram: pins that change, the speed, and when frames are sent and heard."""
    lanes = [*_lanes(record, "inputs", INPUTS), *_lanes(record, "outputs", OUTPUTS)]
    canvas = Canvas(title, WIDTH, TOP + ROW * (len(lanes) + 3) + 50)
    canvas.text(16, 24, title if len(title) <= TITLE else f"{title[: TITLE - 1]}…", "head")
    scale = (WIDTH - LEFT - 20) / max(record[-1].ms + SCAN_MS, 1)
    _steps(canvas, record, scale, ROW * (len(lanes) + 3))
    for lane, (name, kind) in enumerate(lanes):
        base = TOP + ROW * lane + 18
        canvas.text(LEFT - 10, base - 2, name, "mono", "end")
        shares = [float(name in getattr(one, kind)) for one in record]
        canvas.path(_curve(record, shares, base, scale), "go" if kind == "inputs" else "line")
    base = TOP + ROW * (len(lanes) + 1) + 10
    canvas.text(LEFT - 10, base - 2, "speed", "mono", "end")
    most = max([1.0, *(abs(one.true) for one in record)])
    canvas.path(_curve(record, [abs(one.true) / most * 1.8 for one in record], base, scale), "stop")
    for lane, (name, kind) in enumerate((("sent", "sent"), ("heard", "heard"))):
        top = base + 8 + ROW / 2 * lane
        canvas.text(LEFT - 10, top + 10, name, "small", "end")
        for one in record:
            if getattr(one, kind):
                canvas.box(LEFT + one.ms * scale, top, max(SCAN_MS * scale, 1.5), 9, "mark")
    canvas.text(LEFT, canvas.height - 10, f"0 to {record[-1].ms} ms; the end is where the check failed", "small")
    return canvas.svg()


def _lanes(record: Sequence[Moment], kind: str, names: Sequence[str]) -> Iterator[tuple[str, str]]:
    """The pins that are TRUE at some time, but not always."""
    for name in names:
        if 0 < sum(name in getattr(one, kind) for one in record) < len(record):
            yield name, kind


def _steps(canvas: Canvas, record: Sequence[Moment], scale: float, tall: float) -> None:
    before = ""
    for one in record:
        if one.step != before:
            x = LEFT + one.ms * scale
            canvas.path([(x, TOP - 14), (x, TOP + tall)], "thin")
            canvas.text(x + 2, TOP - 18, one.step.rpartition(", ")[2], "small")
        before = one.step


def _curve(record: Sequence[Moment], shares: Sequence[float], base: float, scale: float) -> list[tuple[float, float]]:
    points: list[tuple[float, float]] = []
    for one, share in zip(record, shares, strict=True):
        y = base - HIGH * share
        if len(points) > 1 and points[-1][1] == points[-2][1] == y:
            points.pop()
        points += [(LEFT + one.ms * scale, y), (LEFT + (one.ms + SCAN_MS) * scale, y)]
    return points
