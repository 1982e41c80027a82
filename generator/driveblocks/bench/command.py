"""Programs for the command block: what each combination of pins sends to the drive, and sequences of them."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import fields, replace
from itertools import product

from driveblocks.bench import kit
from driveblocks.bench.code import NUMBERS, WORDS
from driveblocks.bench.script import MOST_STAGES, Script
from driveblocks.bench.table import Table
from driveblocks.maps.model import Drive
from driveblocks.meaning.words import words
from driveblocks.reference.command import MOTIONS, Commands, Pins

_PINS = {
    field.name: "".join(part.capitalize() for part in field.name.split("_"))
    for field in fields(Pins)
    if field.name != "keep"
}
"""Name in the reference model -> pin: run_forward -> RunForward."""

KEPT = 0xFFFF
"""What is in every command register, unless a case says otherwise."""

STOPS = ("enable", "stop", "quick_stop", "coast_stop")


def scripts(drive: Drive, stem: str) -> Iterator[Script]:
    """One program of combinations and some of sequences; each has a command block of its own, which remembers.

    None where a command takes several writes: such a drive has no command block.
    """
    if not drive.operation.in_one_word:
        return
    for subject, title, steps in (
        ("Command", "what each combination of pins sends to the drive", _combinations()),
        ("Sequence", "what the pins send to the drive one after the other", _sequences()),
        ("JogForward", "jogging forward, and how it ends", _jogs("jog_forward", "jog_reverse")),
        ("JogReverse", "jogging in reverse, and how it ends", _jogs("jog_reverse", "jog_forward")),
        ("FaultReset", "a fault reset, and what it holds back", _resets()),
        ("ResetStop", "a fault reset, and the stops that go before it", _reset_stops()),
        ("KeepWord", "bits beside the commands' own pass through", _kept(drive)),
    ):
        sources = dict.fromkeys(command.source for command in words(drive).commands)
        program = kit.script(drive, stem, subject, title, "; ".join(sources))
        kit.declare(program, Command=f"{drive.prefix}_Command")
        rows = list(steps)
        assert len(rows) <= MOST_STAGES  # noqa: S101  (a second program would have a block that remembers nothing)
        _steps(_table(program, drive), drive, rows)
        yield program


def keeps(model: Commands) -> dict[int, str]:
    """The command registers with bits that pass through, and the pin of each."""
    return {
        register: "KeepWord" if register == model.home else f"KeepWord{register:04X}H"
        for register, bits in sorted(model.kept.items())
        if bits
    }


def _table(program: Script, drive: Drive) -> Table:
    table, model = Table(program), Commands(drive)
    for name, pin in _PINS.items():
        table.column(pin, "BOOL", name == "enable", "input of Command, see there")
    for pin in keeps(model).values():
        table.column(pin, "WORD", KEPT, "input of Command, see there")
    table.column("WantedAddress", "WORD", model.home, "register to write")
    table.column("WantedValue", "WORD", 0, "word to write")
    table.column("WantedError", "UINT", 0, "ErrorID that Command must give")
    table.column("WantedStopping", "BOOL", True, "whether the word is a stop")
    table.column("WantedResetting", "BOOL", False, "whether the word is the fault reset")
    table.column("WantedChanged", "BOOL", False, "whether it is to be written")
    table.do(
        f"Command({', '.join(f'{pin} := {pin}' for pin in (*_PINS.values(), *keeps(model).values()))});",
        kit.is_word("Command.Address", "WantedAddress", "Address"),
        kit.is_word("Command.Value", "WantedValue", "Value"),
        kit.is_number("Command.ErrorID", "WantedError", "ErrorID"),
        kit.is_flag("Command.Stopping", "WantedStopping", "Stopping"),
        kit.is_flag("Command.Resetting", "WantedResetting", "Resetting"),
        kit.is_flag("Command.Changed", "WantedChanged", "Changed"),
    )
    return table


def _steps(table: Table, drive: Drive, steps: list[tuple[str, Pins]]) -> None:
    """Rows in their order: the block remembers, and so does the reference model."""
    model = Commands(drive)
    for about, pins in steps:
        kept = {**dict.fromkeys(keeps(model), KEPT), **pins.keep}
        told = model.step(replace(pins, keep=kept))
        values: dict[str, bool | int] = {pin: getattr(pins, name) for name, pin in _PINS.items()}
        values |= {pin: kept[register] for register, pin in keeps(model).items()}
        said = "a stop" if told.stopping else "the reset" if told.resetting else f"{told.value:04X}H"
        wanted = {
            "WantedAddress": told.address,
            "WantedValue": told.value,
            "WantedError": NUMBERS[told.result],
            "WantedStopping": told.stopping,
            "WantedResetting": told.resetting,
            "WantedChanged": told.changed,
        }
        words = f"{about}: {said}" + (f", {WORDS[told.result]}" if told.result != "OK" else "")
        table.row(words, values | wanted)


def _pins(*names: str, keep: Mapping[int, int] | None = None) -> tuple[str, Pins]:
    """Pins that are TRUE beside Enable (`-enable`: without it), and words for them."""
    given = {name: True for name in names if not name.startswith("-")}
    pins = Pins(enable="-enable" not in names, keep=dict(keep or {}), **given)
    shown = [_PINS[name] for name in given]
    return " and ".join([*(["not Enable"] if not pins.enable else []), *shown]) or "nothing", pins


def _combinations() -> Iterator[tuple[str, Pins]]:
    """All motions, all stops with no motion, with one, and with everything; and a reset that is held over motions."""
    for chosen in product((False, True), repeat=len(MOTIONS)):
        yield _pins(*(name for name, wanted in zip(MOTIONS, chosen, strict=True) if wanted))
    for chosen in product((False, True), repeat=len(STOPS)):
        stops = [name if name != "enable" else "-enable" for name, on in zip(STOPS, chosen, strict=True) if on]
        for others in ((), ("run_forward",), MOTIONS, ("jog_reverse",)) if stops else ():
            yield _pins(*stops, *others)
    for chosen in product((False, True), repeat=len(MOTIONS)):
        yield _pins("fault_reset", *(name for name, wanted in zip(MOTIONS, chosen, strict=True) if wanted))


def _sequences() -> Iterator[tuple[str, Pins]]:
    yield from _named("first call", ("run_forward",), ("run_forward",), ())
    yield from _named("turning round", ("run_forward",), ("run_reverse",), ("run_forward", "run_reverse"), ())
    for stop in STOPS:
        asked = f"-{stop}" if stop == "enable" else stop
        yield from _named("a run, and a stop", ("run_forward",), ("run_forward", asked), ("run_forward",), (asked,))
        yield from _named("a stop is sent anew when its pin rises", (), (asked,), (asked,), ())


def _resets() -> Iterator[tuple[str, Pins]]:
    """A reset from its edge to its acknowledgement, beside every motion."""
    over = ("stop_acknowledged",), ("fault_reset", "reset_acknowledged"), ()
    yield from _named("first call", ("fault_reset",), ("fault_reset",), ())
    yield from _named("its stop and itself acknowledged", *over)
    for running in ("run_forward", "run_reverse", "jog_forward", "jog_reverse"):
        held = (running,), (running, "fault_reset"), (running, "stop_acknowledged"), (running,)
        yield from _named(f"with {_PINS[running]} held", *held, (running, "reset_acknowledged"), (running,), ())
        yield from _named("pressed again", (running,), ())
    pressed = ("stop_acknowledged",), ("fault_reset",), ("run_forward",), ("run_forward", "reset_acknowledged")
    yield from _named("a run that rose before the acknowledgement", *pressed, ("run_forward",), (), ("run_forward",))
    both = ("run_forward", "run_reverse")
    yield from _named("both directions", (), both, (*both, "fault_reset"), (*both, "stop_acknowledged"), both)
    yield from _named("both directions after it", (*both, "reset_acknowledged"), both, ())
    twice = ("stop_acknowledged",), ("fault_reset",), (), ("fault_reset",), ("reset_acknowledged",)
    yield from _named("asked twice", *twice, ("fault_reset",), ("stop_acknowledged",), ("reset_acknowledged",), ())
    yield from _named("nothing to acknowledge", ("reset_acknowledged",), ("run_forward", "stop_acknowledged"), ())
    yield from _named("before its stop is acknowledged", ("fault_reset",), ("reset_acknowledged",), (), *over)
    early = ("run_forward",), ("fault_reset", "stop_acknowledged"), ("stop_acknowledged",), ("reset_acknowledged",)
    yield from _named("no stop was sent that could be acknowledged", ("reset_acknowledged",), (), *early)
    yield from _named("with the pin held on", ("fault_reset", "run_forward"), ("fault_reset",), ("fault_reset", "stop"))


def _reset_stops() -> Iterator[tuple[str, Pins]]:
    """A reset under a stop that is TRUE, and beside one that rises."""
    for stop in ("-enable", "stop", "quick_stop", "coast_stop"):
        steady = (stop,), (stop, "stop_acknowledged"), (stop, "fault_reset"), (stop,), (stop, "reset_acknowledged")
        yield from _named("under a steady stop", *steady, (stop,), ())
        rising = ("stop_acknowledged",), ("fault_reset",), (stop,), (stop, "stop_acknowledged"), (stop,)
        yield from _named("a stop is sent first when it rises", *rising, (stop, "reset_acknowledged"), ())
        late = ("stop_acknowledged",), ("fault_reset",), (stop, "reset_acknowledged"), (stop, "stop_acknowledged"), ()
        yield from _named("acknowledged while the stop is sent first", *late)


def _jogs(jog: str, other: str) -> Iterator[tuple[str, Pins]]:
    yield from _named("a jog and its end", (jog,), (jog,), (), ())
    yield from _named("a jog, then a run", (jog,), ("run_forward",), (), (jog,), ("run_reverse",), ())
    yield from _named("a jog beside a run", ("run_forward",), ("run_forward", jog), (jog,), ())
    yield from _named("a run, then a jog", ("run_forward",), (jog,), ("run_reverse",), (jog,), ())
    yield from _named("a jog the other way", (jog,), (other,), (jog, other), (), ())
    for stop in ("stop", "quick_stop", "coast_stop", "-enable"):
        yield from _named("a jog and a stop", (jog,), (jog, stop), (), (), (jog,), (stop,), ())
    reset = (jog,), (jog, "fault_reset"), ("stop_acknowledged",), ("reset_acknowledged",), (), (jog,), ()
    yield from _named("a jog and a reset", *reset)


def _named(about: str, *steps: Iterable[str]) -> Iterator[tuple[str, Pins]]:
    for step in steps:
        words, pins = _pins(*step)
        yield f"{about}: {words}", pins


def _kept(drive: Drive) -> Iterator[tuple[str, Pins]]:
    """Each command with all sorts of bits beside its own, other ones in each register."""
    registers = keeps(Commands(drive))
    for keep in (0x0000, 0xFFFF, 0xAAAA, 0x5555) if registers else ():
        words = {register: keep ^ (0x00FF * bool(number)) for number, register in enumerate(registers)}
        for names in _COMMANDS:
            about, pins = _pins(*names, keep=words)
            yield f"kept bits {keep:04X}H: {about}", pins


_COMMANDS: tuple[tuple[str, ...], ...] = (
    (), ("run_forward",), ("run_reverse",), ("jog_forward",), ("jog_reverse",), MOTIONS, ("quick_stop",),
    ("coast_stop",), (), ("stop_acknowledged",), ("fault_reset",), ("reset_acknowledged",), (),
)  # fmt: skip
"""Pins that give each command once."""
