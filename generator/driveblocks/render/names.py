"""Names in Structured Text: identifiers made from English names, checked against length and reserved words."""

import re

from driveblocks.st.names import reserved, reserved_outside

MAX_LENGTH = 31
"""Longest identifier that every target takes."""

_WORD = re.compile(r"[A-Za-z0-9]+")


def pascal(name: str) -> str:
    """`Output frequency` -> `OutputFrequency`; acronyms stay as written: `DC bus voltage` -> `DCBusVoltage`."""
    return "".join(word[0].upper() + word[1:] for word in _WORD.findall(name))


def identifier(name: str) -> str:
    """A legal identifier for an English name. Raises ValueError that says what is wrong with the name."""
    made = pascal(name)
    if not made or made[0].isdigit():
        raise ValueError(f"`{name}` makes no identifier: it must start with a letter")
    if len(made) > MAX_LENGTH:
        raise ValueError(f"`{name}` makes the identifier {made} of {len(made)} characters; {MAX_LENGTH} are allowed")
    if why := reserved(made):
        raise ValueError(f"`{name}` makes the identifier {made}, which is {why}")
    return made


def block(prefix: str, name: str) -> str:
    """The name of a drive's block, `SN300G5_DriveStatus`. Raises ValueError when it is too long or reserved."""
    made = f"{prefix}_{name}"
    if why := reserved_outside(made):
        raise ValueError(f"the block name {made} is {why}: give a `symbol`")
    if len(made) > MAX_LENGTH:
        raise ValueError(f"the block name {made} has {len(made)} characters; {MAX_LENGTH} are allowed: give a `symbol`")
    return made
