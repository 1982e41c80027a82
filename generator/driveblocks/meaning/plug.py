"""Where the line is connected: the pins or terminals of a drive in its maker's words and in those of the standard."""

from dataclasses import dataclass

from driveblocks.maps.model import Drive, Pin, Wire, kept
from driveblocks.maps.trust import words

CONNECTORS = {"rj45": "RJ45 socket", "terminals": "Terminals", "d_sub": "D-sub connector"}


@dataclass(frozen=True)
class Plug:
    """What a map says of it; what it does not say is empty."""

    connector: str
    pins: tuple[Pin, ...]
    termination: str
    bias: str
    shield: str
    never: tuple[str, ...]
    source: str
    """Place and document, and how far that can be trusted."""
    agreed: tuple[str, ...]
    """What other documents say."""
    gaps: tuple[tuple[str, str], ...]
    """What no text says, and how a person finds it out."""

    @property
    def drawn(self) -> bool:
        """Whether there is a picture: of a socket whose pins are known."""
        return self.connector == CONNECTORS["rj45"] and bool(self.pins)

    def at(self, *wires: Wire) -> str:
        """Where some wires are, with the maker's words."""
        found = [one for one in self.pins if one.wire in wires]
        return "; ".join(", ".join(filter(None, (_pin(one), one.label))) for one in found)


def _pin(one: Pin) -> str:
    """A pin by its number, or a terminal by its name."""
    return f"pin {one.pin}" if one.pin.isdecimal() else one.pin


@kept
def plug(drive: Drive) -> Plug:
    """What a map says of the plug of a drive."""
    one, titles = drive.serial.pins, {each.id: each for each in drive.documents}
    gaps = tuple((each.what, each.find_out) for each in drive.absent if "pins" in each.about)
    if one is None:
        return Plug("", (), "", "", "", (), "", (), gaps)
    by = titles.get(one.document or "")
    trust = (by and by.trust) or ("transcribed" if by or drive.manual.second_hand else "read")
    return Plug(
        connector=CONNECTORS[one.connector] if one.connector else "",
        pins=one.pins,
        termination=one.termination or "",
        bias=one.bias or "",
        shield=one.shield or "; ".join(_pin(each) for each in one.pins if each.wire == "shield"),
        never=one.never,
        source=f"{by.title if by else drive.manual.title.en}, {one.source} ({words(trust)})",
        agreed=tuple(f"{titles[each.document].title}, {each.page}: {each.reads}" for each in one.corroborated),
        gaps=gaps,
    )
