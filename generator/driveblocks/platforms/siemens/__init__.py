"""TIA Portal: the S7-1200 and S7-1500."""

from driveblocks.platforms.record import Platform

RECORD = Platform(
    "siemens",
    6,
    title="TIA Portal",
    where="an RS-485 module of the S7-1200 or S7-1500",
    prefix="SI",
    drawn="an FB in LAD",
    quote='"',
    member="#",
    comment="//",
)
