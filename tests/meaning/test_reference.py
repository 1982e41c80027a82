"""How a speed becomes a word, by what the manual says the word is."""

from dataclasses import replace
from decimal import Decimal
from typing import Any

import pytest
from tests import shipped

from driveblocks.maps.model import Scale
from driveblocks.meaning.reference import Reference, reference

JSCC = shipped.drives()["JSCC"]


def given(factor: str | None, **said: Any) -> Reference:
    """The reference of a drive whose register has a factor, and whose map says so of it."""
    scale = None if factor is None else Scale(factor=Decimal(factor), source="page 1")
    spec = replace(JSCC.operation.reference, **said)
    sections = tuple(
        replace(
            section,
            registers=tuple(
                replace(row, scale=scale) if spec.register in row.address else row for row in section.registers
            ),
        )
        for section in JSCC.sections
    )
    return reference(replace(JSCC, sections=sections, operation=replace(JSCC.operation, reference=spec)))


@pytest.mark.parametrize(
    ("factor", "said", "found"),
    [
        ("0.01", {}, (100, True, False, False)),
        (None, {}, (1, False, False, False)),
        ("0.01", {"means": "percent_of_maximum"}, (10000, True, True, False)),
        (None, {"means": "percent_of_maximum"}, (100, False, False, False)),
        (None, {"means": "fraction_of_full_scale", "full_scale": 0x4000}, (0x4000, True, True, False)),
        (None, {"full_scale": 20000, "full_scale_hz": Decimal(50)}, (400, True, False, False)),
        ("0.1", {"means": "speed"}, (600, True, False, True)),
        (None, {"means": "speed"}, (1, False, False, False)),
    ],
)
def test_counts(factor: str | None, said: dict[str, Any], found: tuple[object, ...]) -> None:
    """How many a hertz has, or 100 %; whether that is known; whether it is of 100 %, or in r/min."""
    one = given(factor, **said)
    assert (one.ratio, one.scaled, one.percent, one.in_rpm) == found
