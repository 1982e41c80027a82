"""Rules on identifiers: a block or a pin has a name that every compiler takes, and that nothing else has."""

import re
from collections.abc import Iterable, Iterator

from driveblocks.maps import names
from driveblocks.maps.form import span_text
from driveblocks.maps.model import Bit, Drive, Register, Value
from driveblocks.maps.problem import Report, line
from driveblocks.meaning.polls import fast_words, slow_words

LIBRARY = ("MB", "VFD", "LX", "CD", "SI", "TC")
"""Prefixes of the blocks that every drive shares, of the harness of the tests, and of the platforms' adapters."""

OWN_NAMES = (
    "CanRead", "CanWrite", "Request", "Reply", "Command", "Reference", "Standstill", "FaultNumber", "FaultTextEn",
    "WarningTextEn", "ErrorTextEn", "BitTextEn", "ValueTextEn", "Drive", "MayWrite", "ParameterAddress", "Store",
    "Version", "Reads", "Orders", "ParameterGate", "Identity",
)  # fmt: skip
"""The blocks that every drive has; texts in other languages end in two other letters."""

OWN = re.compile(
    r"CanRead|CanWrite|Request|Reply|Command|Reference|Standstill|FaultNumber|(Fault|Warning|Error|Bit|Value)Text[A-Z][A-Z]|"
    r"Drive|MayWrite|ParameterAddress|Store|Version|Reads|Orders|ParameterGate|Identity|"
    r"Test(([0-9A-F]{4}|Reply[0-9A-F]{2})H|Access|Command|FaultNumber|FaultReset|Frames|JogForward|JogReverse|KeepWord|"
    r"Motor\w*|Parameter\w*|Part\w*|"
    r"Reference|Request|ResetStop|Scales|Sequence|Standstill|Tables|Write|Drive|MayWrite|ParameterAddress|Store|Version|"
    r"(Fault|Warning|Error|Bit|Value)Text[A-Z][A-Z])[0-9]*",
    re.IGNORECASE,
)
"""What a register's block cannot be called: the other blocks of a drive, and its test programs."""

_OWN_PINS = ("Value", "Unknown")
"""What every decoder has."""

_OWN_WORDS = ("KeepWord",)
"""What a drive block may have."""


def check(drive: Drive, report: Report) -> None:
    """Note every name that makes no identifier, or one that is taken."""
    prefixed = _prefix(drive, report)
    blocks = _Taken("block", report)
    for _, row in drive.registers():
        for suffix in suffixes(row):
            name = names.symbol(row) + suffix
            made = names.block(drive.prefix, name)
            own = "is one of the drive's own" if OWN.fullmatch(name) else None
            blocks.add(row, made, own or (names.wrong_block(made) if prefixed else None))
        pins = _Taken("output", report, _OWN_PINS)
        for entry in _outputs(row):
            pins.add(entry, names.symbol(entry), names.wrong_pin(names.symbol(entry)))
    _words(drive, report)


def suffixes(row: Register) -> Iterator[str]:
    """The blocks that a register has: a decoder, a scale."""
    if row.values or any(bit.name and not bit.unused for bit in row.bits):
        yield ""
    if row.scale is not None:
        yield names.UNIT_NAMES.get(row.unit or "", "")


class _Taken:
    """Names of one kind that must differ, whatever the case of their letters."""

    def __init__(self, kind: str, report: Report, own: Iterable[str] = ()) -> None:
        """Start with the names that the block itself has."""
        self.kind, self.report = kind, report
        self.lines: dict[str, tuple[object, str]] = {name.upper(): (self, "the block itself") for name in own}

    def add(self, entry: Register | Bit | Value, made: str, wrong: str | None) -> None:
        """Note an entry's name that makes no identifier, that cannot be, or that an earlier entry has."""
        place = entry.place("symbol" if entry.symbol else "name")
        if no_symbol := names.wrong_symbol(entry):
            self.report.add(place, no_symbol, "add a `symbol` of letters A to Z and digits")
            return
        taken = self.lines.setdefault(made.upper(), (entry, line(entry.at)))
        if wrong is None and taken[0] is not entry:
            wrong = f"is taken by {taken[1]}"
        if wrong:
            right = "choose another `symbol`" if entry.symbol else "add a short `symbol`"
            self.report.add(place, f"the {self.kind} name {made} {wrong}", right)


def _prefix(drive: Drive, report: Report) -> bool:
    """Whether the prefix spoils none of the names that every drive has."""
    made = (names.block(drive.prefix, name) for name in OWN_NAMES)
    wrong = next((f"the block name {each} {why}" for each in made if (why := names.wrong_block(each))), None)
    if drive.prefix in LIBRARY:
        wrong = f"the prefix {drive.prefix} is the library's own"
    if wrong:
        report.add(drive.place("prefix"), wrong, "choose another prefix")
    return wrong is None


def _outputs(row: Register) -> Iterator[Bit | Value]:
    """What becomes outputs of a register's decoder."""
    for bit in row.bits:
        if bit.name and not bit.unused:
            yield bit
            yield from bit.values if len(bit.bit) > 1 else ()
    yield from row.values


def _words(drive: Drive, report: Report) -> None:
    """The registers whose words the drive block keeps; those of standstill and of fault bits are inputs, too."""
    pins = _Taken("input", report, _OWN_WORDS)
    before: Register | None = None
    for address in sorted(fast_words(drive) | slow_words(drive)):
        row = drive.register_at(address)
        if row is not None and row is before and not row.words:
            wrong = f"pins show two registers of the row {span_text(row.address)}, which has one name for both"
            report.add(row.place("address"), wrong, "write one row per register")
        elif row is not None:
            pin = names.word_pin(row, address)
            pins.add(row, pin, names.wrong_pin(pin))
        before = row
