"""What tells one state of a map from another."""

from dataclasses import fields, replace
from typing import Any

from driveblocks.maps.model import Drive, Entry, Worded
from driveblocks.st.fingerprint import fingerprint


def revision(drive: Drive) -> int:
    """A hash of a map's facts, 32 bits: what it says in English, wherever in the file it stands."""
    return int(fingerprint([repr(english(drive))]), 16)


def english(drive: Drive) -> Drive:
    """A map without a word in another language."""
    plain: Drive = _english(drive)
    return plain


def _english(value: Any) -> Any:
    if isinstance(value, tuple):
        return tuple(map(_english, value))
    if not isinstance(value, Entry):
        return value
    said: dict[str, Any] = {one.name: _english(getattr(value, one.name)) for one in fields(value)}
    if isinstance(value, Worded):
        said.update(zh=None, zh_used=None, wording=None)
    return replace(value, **said)
