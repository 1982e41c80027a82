"""What distinguishes one state of a map from another."""

import re
from dataclasses import replace
from typing import Any

from driveblocks.maps.model import Drive, Entry, Setting, Value, Worded, kept
from driveblocks.maps.trust import MOTION, facts
from structured_text.language.fingerprint import fingerprint

_LATER = {
    "None": "base numbering document trust differs no_address reply_delay group present_bits needs full_scale "
    "full_scale_hz warnings silent_ms coil discrete input by counts lower_limit stop_bits below above delivered "
    "profile help display pins",
    "()": "never without twins twin_ranges otherwise does at_0 fed_by editions forbids remedies",
    "False": "negative holds power_cycle",
}
"""Keys that the format has learned since the first numbers were printed, by what they are when they are left out."""
_LEFT_OUT = re.compile(
    "|".join(f", (?:{'|'.join(keys.split())})={re.escape(is_)}(?=[,)])" for is_, keys in _LATER.items())
    + r"|, causes=\(\)(?=, remedies=)"  # those of a fault; an error code has had its own from the first
    + "|, space=None(?:, words=None, order=None)?(?=[,)])"  # an example frame has `words` of its own
)


@kept
def revision(drive: Drive) -> int:
    """A hash of a map's facts, 32 bits: what it says in English, wherever in the file it is.

    What helps against a fault, and where the line is connected, is for a person, and no part of it.
    """
    return int(fingerprint([_facts(_without_help(english(drive)))]), 16)


@kept
def checked(drive: Drive) -> int:
    """The number by which a user says that the manual was checked: 1 to 65535, a hash of what a motion depends on."""
    said = (one.said for one in facts(english(drive)) if one.part in MOTION)
    return (
        int(fingerprint([_facts(one) for one in dict.fromkeys(each for some in said for each in some)]), 16) % 65535 + 1
    )


@kept
def english(drive: Drive) -> Drive:
    """A map without a word in another language, and without the looks of a keypad."""
    plain: Drive = _english(drive)
    return plain


def _english(value: Any) -> Any:
    if isinstance(value, tuple):
        return tuple(map(_english, value))
    if not isinstance(value, Entry):
        return value
    facts = value.__dataclass_fields__
    inner = {name: each for name, each in vars(value).items() if isinstance(each, (tuple, Entry)) and name in facts}
    said: dict[str, Any] = {name: _english(each) for name, each in inner.items()}
    if isinstance(value, Worded):
        said.update(zh=None, zh_used=None, wording=None)
    if isinstance(value, (Setting, Value)):
        said.update(display=None)
    return replace(value, **said)


def _without_help(drive: Drive) -> Drive:
    known = drive.faults
    codes = tuple(replace(one, causes=(), remedies=(), power_cycle=False) for one in known.codes)
    faults, serial = replace(known, codes=codes, help=None), replace(drive.serial, pins=None)
    plain = replace(drive, faults=faults, serial=serial)
    alone = _named(drive) - _named(plain)
    return replace(plain, documents=tuple(one for one in drive.documents if one.id not in alone))


def _named(value: Any) -> set[str]:
    """The documents that something names, also as what agrees with it."""
    if isinstance(value, tuple):
        return set[str]().union(*map(_named, value))
    if not isinstance(value, Entry):
        return set()
    own = getattr(value, "document", None)
    return ({own} if isinstance(own, str) else set[str]()).union(
        *(_named(getattr(value, name)) for name in value.__dataclass_fields__)
    )


def _facts(value: Any) -> str:
    """What an entry says; keys that are left out change nothing, so that a new key changes no old number."""
    said = _LEFT_OUT.sub("", repr(value)).replace("(rung=None, rule=None, ", "(")
    return said.replace("Drive(format=2", "Drive(format=1")  # it says nothing of a drive
