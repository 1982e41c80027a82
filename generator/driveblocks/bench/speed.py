"""The program for the reference block: counts, halves, limits, and what is no reference."""

from collections.abc import Iterator
from fractions import Fraction

from driveblocks.bench import kit
from driveblocks.bench.code import NUMBERS, WORDS
from driveblocks.bench.script import Probe, Script
from driveblocks.bench.table import Table
from driveblocks.maps.model import Drive
from driveblocks.meaning.reference import reference
from driveblocks.reference.single import stored
from driveblocks.reference.speed import SpeedReference
from structured_text.language.writing import word

Case = tuple[str, float, float, float, float]
"""What it is about; SpeedReferenceHz, MaximumHz, FullScaleHz, ReferenceScale."""

LARGEST_EXACT = 2**24
"""From here on REAL has no halves."""

USUAL_MAXIMUM, USUAL_SCALE = 50.0, 10.0


def scripts(drive: Drive, stem: str) -> Iterator[Script]:
    source = reference(drive).said.source
    program = kit.script(drive, stem, "Reference", "a frequency as the word for the reference register", source)
    kit.declare(program, Encode=f"{drive.prefix}_Reference")
    model = SpeedReference(drive)
    table = _table(program, model)
    for case in dict.fromkeys(_cases(model)):
        _row(table, model, case)
    for case in dict.fromkeys(_cases(model)) if model.by_sign else ():
        _row(table, model, case, reverse=True)
    yield program


def _table(program: Script, model: SpeedReference) -> Table:
    table = Table(program)
    table.column("Hertz", "REAL", 0.0, "SpeedReferenceHz")
    table.column("Maximum", "REAL", USUAL_MAXIMUM, "MaximumHz")
    table.column("Full", "REAL", USUAL_MAXIMUM if model.percent else 0.0, "FullScaleHz")
    pins = "SpeedReferenceHz := Hertz, MaximumHz := Maximum, FullScaleHz := Full"
    if model.turns:
        table.column("Pairs", "UINT", 0, "PolePairs")
        pins += ", PolePairs := Pairs"
    elif model.factor is None:
        table.column("Scale", "REAL", USUAL_SCALE, "ReferenceScale")
        pins += ", ReferenceScale := Scale"
    if model.by_sign:
        table.column("Reverse", "BOOL", False, "Reverse")
        pins += ", Reverse := Reverse"
    table.column("WantedError", "UINT", 0, "ErrorID that Encode must give")
    table.column("WantedLimited", "BOOL", False, "whether the reference is clamped")
    table.column("WantedHz", "REAL", 0.0, "AskedHz that it must give, Hz")
    table.column("Lowest", "UINT", 0, "Value that it must give, at least")
    table.column("Highest", "UINT", 0, "... and at most: more only where REAL allows two")
    table.do(
        f"Encode({pins});",
        kit.is_number("Encode.ErrorID", "WantedError", "ErrorID"),
        kit.is_flag("Encode.Limited", "WantedLimited", "Limited"),
        kit.is_between("WORD_TO_UINT(Encode.Value)", "Lowest", "Highest", "Value"),
        Probe("Real", "Expected := WantedHz, Actual := Encode.AskedHz, Tolerance := 0.0", "AskedHz"),
        kit.is_word("Encode.Address", word(model.address), "Address"),
    )
    return table


def _row(table: Table, model: SpeedReference, case: Case, *, reverse: bool = False) -> None:
    about, hertz, maximum, full, scale = case
    found = model.encode(hertz, maximum, full, scale, reverse=reverse)
    if found.at_the_end or (len(found.results) > 1 and not _exact(model, hertz, scale)):
        return  # beside the end of the word, or half a count below zero: single precision decides which side it is on
    if reverse and 0 in found.near and len(found.near) > 1:
        return  # 0 and -1 are no neighbours as words
    near = {found.value} if _exact(model, hertz, scale) else found.near
    values = {"Hertz": hertz, "Maximum": maximum, "Full": full} | _scale(model, scale)
    says = f"{found.value}{', limited' if found.limited else ''}" if found.result == "OK" else WORDS[found.result]
    words = f"{about}: {hertz:.9g} Hz of {maximum:.9g} Hz, {full:.9g} Hz is all" + (
        f", {scale:.9g} per Hz" if model.factor is None else f", {scale:.9g} pole pairs" if model.turns else ""
    )
    if model.by_sign:
        values["Reverse"], words = reverse, f"{words}{', in reverse' if reverse else ''}"
    wanted = {"WantedError": NUMBERS[found.result], "WantedLimited": found.limited, "WantedHz": found.hertz}
    bounds = {"Lowest": min(near) & 0xFFFF, "Highest": max(near) & 0xFFFF}
    table.row(f"{words}: {says}", values | wanted | bounds)


def _scale(model: SpeedReference, scale: float) -> dict[str, float | int]:
    """The pin that says how the reference counts, where the map does not."""
    if model.turns:
        return {"Pairs": int(min(max(scale, 0), 65535))}
    return {"Scale": scale} if model.factor is None else {}


def _exact(model: SpeedReference, hertz: float, scale: float) -> bool:
    """Whether REAL holds the counts, and them and a half, exactly, so that one answer is right."""
    if model.factor is not None or model.percent or model.turns:
        return False
    if not 0 < scale < LARGEST_EXACT or not abs(hertz) < LARGEST_EXACT:
        return False
    counts = Fraction(stored(hertz)) * Fraction(stored(scale))
    return all(Fraction(stored(float(each))) == each for each in (counts, counts + Fraction(1, 2)))


def _cases(model: SpeedReference) -> Iterator[Case]:
    """As the full scale: the maximum, where the reference is a part of it, else none; then both apart."""
    for about, hertz, maximum, scale in _limited(model):
        fits = LEAST <= maximum <= MOST
        yield about, hertz, maximum, (maximum if fits else USUAL_MAXIMUM) if model.percent else 0.0, scale
    for full in (0.0, -1.0, 0.099, 0.1, 10000.0, 10001.0, -2.0e30, 2.0e30):
        for hertz in (10.0, 0.0):
            yield "full scale" if full else "full scale not set", hertz, 50.0, full, USUAL_SCALE
    for maximum, full in ((40.0, 50.0), (50.0, 40.0), (60.0, 50.0)):
        for hertz in (20.0, 39.0, 40.0, 45.0, 50.0, 55.0):
            yield "a limit and a full scale", hertz, maximum, full, USUAL_SCALE


LEAST, MOST = 0.1, 10000.0
"""A maximum outside of these is none, Hz."""


def _limited(model: SpeedReference) -> Iterator[tuple[str, float, float, float]]:
    for maximum in (50.0, 60.0, 400.0, 10000.0):
        yield from _at(model, maximum, USUAL_SCALE)
    if model.factor is None:
        for scale in (1.0, 0.5, 100.0, 1000.0, 16383.75):
            yield from _at(model, 50.0, scale)
        for scale in (0.0, -1.0, -9.0e29, 2.0e30):
            yield "bad scale" if scale else "scale not set", 10.0, 50.0, scale
    for pairs in (0.0, 1.0, 2.0, 3.0, 100.0, 101.0, 65535.0) if model.turns else ():
        yield "pole pairs" if pairs else "pole pairs not set", 10.0, 50.0, pairs
    for hertz in (0.0, 0.25, 0.5, 1.0):
        yield "a low maximum", hertz, 0.5, USUAL_SCALE
    for maximum in (0.0, -1.0, 0.099, 0.1, 10000.0, 10001.0, 1.0e30, -2.0e30, 2.0e30):
        for hertz in (10.0, 0.0):
            yield "maximum" if maximum else "maximum not set", hertz, maximum, USUAL_SCALE
    for hertz in (-0.001, -50.0, -9.0e29, -1.1e30, 1.1e30, 3.0e38, -3.0e38):
        yield "beyond", hertz, 50.0, USUAL_SCALE
        yield "beyond, with nothing set", hertz, 0.0, 0.0


def _at(model: SpeedReference, maximum: float, scale: float) -> Iterator[tuple[str, float, float, float]]:
    """References from nothing to far too much; near the steps of the word where the frequency allows."""
    top = maximum
    for hertz in (0.0, 0.01, 0.1, 0.5, 1.0, 10.0, 25.0, 33.3, 49.99, 50.0):
        yield "reference", hertz, maximum, scale
    for hertz in (top / 2, top * 0.999, top, top * 1.001, top * 2.0, 65535.0, 1.0e6, 9.0e29):
        yield "reference near or above the maximum", stored(hertz), maximum, scale
    step = _step(model, maximum, scale)
    for counts in (-1.0, -0.51, -0.5, -0.49, -0.01, 0.25, 0.49, 0.5, 0.51, 1.0, 1.5, 2.5, 3.0, 100.5, 101.5):
        yield f"{counts} counts", stored(float(step * Fraction(counts))), maximum, scale
    for counts in (-0.75, -0.25, 0.25, 1.0):
        yield "near the end of the word", stored(float(step * (model.highest + Fraction(counts)))), maximum, scale


def _step(model: SpeedReference, maximum: float, scale: float) -> Fraction:
    if model.factor is None:
        return 1 / Fraction(scale)
    if model.turns:
        return model.factor * Fraction(scale) / 60
    return model.factor * Fraction(maximum) / 100 if model.percent else model.factor
