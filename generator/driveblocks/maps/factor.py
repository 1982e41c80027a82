"""Which factors a scale of a drive can have: what is beyond is mostly meant the other way round, as counts per unit."""

from decimal import Decimal

from driveblocks.maps.model import Unit

BOUNDS: dict[Unit, tuple[str, str]] = {
    "Hz": ("0.0005", "1"), "kHz": ("0.0005", "1"), "r/min": ("0.001", "10"), "A": ("0.0001", "1"),
    "V": ("0.0001", "1"), "kW": ("0.0001", "1"), "W": ("0.01", "100"), "%": ("0.001", "1"), "Nm": ("0.0001", "10"),
    "s": ("0.0001", "60"), "ms": ("0.001", "1000"), "h": ("0.0001", "1000"), "°C": ("0.001", "1"),
    "Ohm": ("0.000001", "10"), "kWh": ("0.0001", "10000"),
}  # fmt: skip
"""Units per count: the least with which a word of 16 bits reaches what a small drive has, and the coarsest step."""


def doubt(factor: Decimal, unit: Unit, bits: int) -> tuple[str, str] | None:
    """What is wrong with a positive factor of a value of so many bits, and what is right; None where it may be."""
    least, most = map(Decimal, BOUNDS[unit])
    if factor <= most and (factor >= least or bits > 16):
        return None
    inverse = 1 / factor
    other = f"; for {factor:f} counts per {unit} write {inverse.normalize():f}" if factor > most else ""
    return f"{factor:f} {unit} per count is no factor of a drive", f"{least:f} to {most} {unit} per count are{other}"
