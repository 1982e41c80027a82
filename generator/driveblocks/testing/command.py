"""Programs for the command block: what each combination of pins tells the drive, and sequences of them."""

from collections.abc import Iterable, Iterator
from dataclasses import fields
from itertools import product

from driveblocks.maps.model import Drive
from driveblocks.reference.command import Commands, Pins
from driveblocks.testing import bench
from driveblocks.testing.code import NUMBERS, WORDS
from driveblocks.testing.script import MOST_STAGES, Script
from driveblocks.testing.table import Table

_PINS = {field.name: "".join(part.capitalize() for part in field.name.split("_")) for field in fields(Pins)}
"""Name in the reference model -> pin: run_forward -> RunForward."""

KEPT = 0xFFFF
"""What stands in the command register beside the commands' bits, unless a case says otherwise."""

STOPS = ("enable", "stop", "quick_stop", "coast_stop")
MOTIONS = ("run_forward", "run_reverse", "jog_forward", "jog_reverse")


def scripts(drive: Drive, stem: str) -> Iterator[Script]:
    """One program of combinations and some of sequences; each has a command block of its own, which remembers."""
    for subject, title, steps in (
        ("Command", "what each combination of pins tells the drive", _combinations()),
        ("Sequence", "what the pins tell the drive one after the other", _sequences()),
        ("JogForward", "jogging forward, and how it ends", _jogs("jog_forward", "jog_reverse")),
        ("JogReverse", "jogging in reverse, and how it ends", _jogs("jog_reverse", "jog_forward")),
        ("KeepWord", "bits beside the commands' own pass through", _kept(drive)),
    ):
        program = bench.script(drive, stem, subject, title, _source(drive))
        bench.declare(program, Command=f"{drive.prefix}_Command")
        rows = list(steps)
        assert len(rows) <= MOST_STAGES  # noqa: S101  (a second program would have a block that remembers nothing)
        _steps(_table(program, drive), drive, rows)
        yield program


def _source(drive: Drive) -> str:
    return "; ".join(dict.fromkeys(command.source for command in drive.operation.commands))


def keeps(drive: Drive) -> bool:
    """Whether the drive is commanded by bits, so that its block has the pin KeepWord."""
    return any(command.value is None for command in drive.operation.commands)


def _table(program: Script, drive: Drive) -> Table:
    table = Table(program)
    pins = {name: pin for name, pin in _PINS.items() if name != "keep"}
    for name, pin in pins.items():
        table.column(pin, "BOOL", name == "enable", "input of Command, see there")
    if keeps(drive):
        table.column("KeepWord", "WORD", KEPT, "input of Command, see there")
        pins["keep"] = "KeepWord"
    table.column("WantedAddress", "WORD", Commands(drive).known["stop"].register, "register to write")
    table.column("WantedValue", "WORD", 0, "word to write")
    table.column("WantedError", "UINT", 0, "ErrorID that Command must give")
    table.column("WantedStopping", "BOOL", True, "whether the word is a stop")
    table.column("WantedChanged", "BOOL", False, "whether the telegram differs from the one before")
    table.do(
        f"Command({', '.join(f'{pin} := {pin}' for pin in pins.values())});",
        bench.is_word("Command.Address", "WantedAddress", "Address"),
        bench.is_word("Command.Value", "WantedValue", "Value"),
        bench.is_number("Command.ErrorID", "WantedError", "ErrorID"),
        bench.is_flag("Command.Stopping", "WantedStopping", "Stopping"),
        bench.is_flag("Command.Changed", "WantedChanged", "Changed"),
    )
    return table


def _steps(table: Table, drive: Drive, steps: list[tuple[str, Pins]]) -> None:
    """Rows in their order: the block remembers, and so does the reference model."""
    model = Commands(drive)
    last: tuple[int, int] | None = None
    for about, pins in steps:
        told = model.step(pins)
        values = {pin: getattr(pins, name) for name, pin in _PINS.items() if name != "keep"}
        if keeps(drive):
            values["KeepWord"] = pins.keep
        said = "a stop" if told.stopping else f"{told.value:04X}H"
        wanted = {
            "WantedAddress": told.address,
            "WantedValue": told.value,
            "WantedError": NUMBERS[told.result],
            "WantedStopping": told.stopping,
            "WantedChanged": last != (told.address, told.value),
        }
        words = f"{about}: {said}" + (f", {WORDS[told.result]}" if told.result != "OK" else "")
        table.row(words, values | wanted)
        last = (told.address, told.value)


def _pins(*names: str, keep: int = KEPT) -> tuple[str, Pins]:
    """Pins that are TRUE beside Enable (`-enable`: without it), and words for them."""
    given = {name: True for name in names if not name.startswith("-")}
    pins = Pins(enable="-enable" not in names, keep=keep, **given)
    shown = [_PINS[name] for name in given]
    return " and ".join([*(["not Enable"] if not pins.enable else []), *shown]) or "nothing", pins


def _combinations() -> Iterator[tuple[str, Pins]]:
    """All motions with and without a rising reset; all stops with no motion, with one, and with everything."""
    for chosen in product((False, True), repeat=len(MOTIONS)):
        motion = [name for name, wanted in zip(MOTIONS, chosen, strict=True) if wanted]
        yield _pins(*motion)
        yield _pins(*motion, "fault_reset")
    for chosen in product((False, True), repeat=len(STOPS)):
        stops = [name if name != "enable" else "-enable" for name, on in zip(STOPS, chosen, strict=True) if on]
        for others in ((), ("run_forward",), (*MOTIONS, "fault_reset"), ("jog_reverse",)) if stops else ():
            yield _pins(*stops, *others)


def _sequences() -> Iterator[tuple[str, Pins]]:
    yield from _named("first call", ("run_forward",), ("run_forward",), ())
    yield from _named("reset is an edge", ("fault_reset",), ("fault_reset",), ("fault_reset",), (), ("fault_reset",))
    yield from _named("reset while running", ("run_forward",), ("run_forward", "fault_reset"), ("run_forward",))
    yield from _named(
        "reset held before Enable", ("-enable", "fault_reset"), ("fault_reset",), (), ("fault_reset",), ()
    )
    yield from _named("turning round", ("run_forward",), ("run_reverse",), ("run_forward", "run_reverse"), ())


def _jogs(jog: str, other: str) -> Iterator[tuple[str, Pins]]:
    yield from _named("a jog and its end", (jog,), (jog,), (), ())
    yield from _named("a jog, then a run", (jog,), ("run_forward",), (), ())
    yield from _named("a jog beside a run", ("run_forward",), ("run_forward", jog), (jog,), ())
    yield from _named("a jog the other way", (jog,), (other,), (jog, other), (), ())
    for stop in ("stop", "quick_stop", "coast_stop", "-enable"):
        yield from _named("a jog and a stop", (jog,), (jog, stop), (), (), (jog,), (stop,), ())
    yield from _named("a jog and a reset", (jog,), (jog, "fault_reset"), (), ())


def _named(about: str, *steps: Iterable[str]) -> Iterator[tuple[str, Pins]]:
    for step in steps:
        words, pins = _pins(*step)
        yield f"{about}: {words}", pins


def _kept(drive: Drive) -> Iterator[tuple[str, Pins]]:
    """Each command with all sorts of bits beside its own; nothing where whole words are written."""
    for keep in (0x0000, 0xFFFF, 0xAAAA, 0x5555) if keeps(drive) else ():
        for names in (
            (),
            ("run_forward",),
            ("run_reverse",),
            ("jog_forward",),
            ("coast_stop",),
            ("fault_reset",),
            MOTIONS,
        ):
            words, pins = _pins(*names, keep=keep)
            yield f"kept bits {keep:04X}H: {words}", pins
