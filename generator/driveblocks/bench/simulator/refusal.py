"""Why a drive refuses, and the code that its map lists for it."""

import re
from collections.abc import Iterator

from driveblocks.maps.model import Drive, ErrorCode

REASONS = ("function", "address", "quantity", "value", "read_only", "running", "busy")
STANDARD = {"function": 1, "address": 2, "quantity": 3, "value": 3}
"""MODBUS Application Protocol V1.1b3, section 7; for a reason without a code see `codes`."""

_NAMES = {
    "function": r"function",
    "address": r"address",
    "quantity": r"quantity",
    "value": r"illegal data(?! address)|data setting|value",
    "busy": r"busy|processing",
}
_CAUSES = {"read_only": r"read-only|status register", "running": r"\bwhile the (drive runs|motor ran)"}
"""How maps name their codes, and what they give as causes: the codes' meaning is text for people."""


def codes(drive: Drive) -> dict[str, int | None]:
    """The code of each reason: the map's; the standard's where the map has none for it.

    A code without a number in the manual gets that of another document. `read_only` falls back to `address`,
    `quantity` to `value`; None is a reason for which this drive does not refuse.
    """
    found = {reason: _number(drive, reason) for reason in REASONS}
    found["value"] = found["value"] or STANDARD["value"]
    found["quantity"] = found["quantity"] or found["value"]
    for reason in ("function", "address"):
        found[reason] = found[reason] or STANDARD[reason]
    found["read_only"] = found["read_only"] or found["address"]
    return found


def refuses_beyond(drive: Drive) -> bool:
    """Whether the manual lists a refusal of values beyond a limit."""
    texts = (text for code in drive.errors.codes for text in _causes(code))
    return any(re.search(r"beyond .*limit", text, re.IGNORECASE) for text in texts)


def _number(drive: Drive, reason: str) -> int | None:
    for code in drive.errors.codes:
        texts = [code.name] if reason in _NAMES else _causes(code)
        if any(re.search(_NAMES.get(reason) or _CAUSES[reason], text, re.IGNORECASE) for text in texts):
            numbers = (each.value for each in code.corroborated)
            return code.code if code.code is not None else next((each for each in numbers if each is not None), None)
    return None


def _causes(code: ErrorCode) -> Iterator[str]:
    if code.meaning:
        yield code.meaning.en
    yield from (cause.en for cause in code.causes)
