"""What two versions of a map say differently: every key of every entry, nothing left out."""

from collections.abc import Iterator
from typing import Any

from driveblocks.diff.change import Change, Kind
from driveblocks.maps.form import SPACES, Numbered, Span, address_text, bits_text, span_text

KNOWN_BY = (
    "id",
    "plate",
    "does",
    "code",
    "value",
    "bit",
    "name",
    "what",
    "where",
    "address",
    "register",
    "measure",
    "shows",
)
"""By what an entry of a list is found again, the surest first."""
SINGULAR = {
    "registers": "register", "faults": "fault", "warnings": "warning",
    "errors": "error", "commands": "command", "settings": "setting",
    "frames": "frame", "errata": "erratum", "documents": "document", "notices": "notice", "sections": "section",
    "areas": "area", "functions": "function", "bits": "bit", "enum": "value", "values": "value",
    "models": "model", "tolerances": "tolerance", "status": "status", "measures": "measure",
}  # fmt: skip
WORDS = {
    "absent", "confidence", "corroborated", "document", "documents", "errata", "family", "frames", "id_forms", "manual",
    "meaning", "models", "name", "name_zh", "note", "notices", "numbering", "printed", "rule", "rung", "sections",
    "short", "source", "sources", "symbol", "text_zh", "title", "vendor", "why", "wording", "zh", "zh_used",
}  # fmt: skip
"""Keys that a person reads, or that are seen in the names of blocks and pins."""
OWN = {"drive", "revision", "format", "prefix"}
"""What every version has of its own, or what is compared with its blocks."""
ADDRESSES = {"address", "register", "stored", "ram", "base", "read"}
BITS = {"bit", "set", "clear", "present_bits"}
"""Keys of spans that are no addresses."""


def compared(old: dict[str, Any], new: dict[str, Any]) -> Iterator[Change]:
    """What differs between two maps as `maps.view` shows them."""
    for key in dict.fromkeys((*old, *new)):
        if key not in OWN:
            yield from _value((key,), *(_readable(each.get(key), each.get("numbering")) for each in (old, new)))


def _readable(value: Any, numbers: dict[str, Any] | None, key: str = "") -> Any:
    """The same with addresses and spans as a map writes them, each address with its table."""
    if isinstance(value, list):
        return [_readable(each, numbers, key) for each in value]
    if not isinstance(value, dict):
        return value
    ends = [value[end] for end in ("first", "last") if isinstance(value.get(end), int)]
    if len(ends) == len(value) == 2:
        return bits_text(Span(*ends)) if key in BITS else span_text(Span(_at(numbers, "holding", ends[0]), ends[1]))
    places = [each for each in (*ADDRESSES, *(("first", "last") if len(ends) == 2 else ())) if each in value]
    space = str(value["space"]) if places and value.get("space") in SPACES else "holding"
    rest = {name: _readable(one, numbers, name) for name, one in value.items() if space == "holding" or name != "space"}
    told = {each: address_text(_at(numbers, space, value[each])) for each in places if isinstance(value[each], int)}
    return rest | told


def _at(numbers: dict[str, Any] | None, space: str, address: int) -> int:
    """An address with the manual's number, where the map numbers registers."""
    at = SPACES[space] + address
    return Numbered(at, numbers.get(space, numbers["first"]), hexadecimal=numbers["hexadecimal"]) if numbers else at


def _value(path: tuple[str, ...], old: Any, new: Any) -> Iterator[Change]:
    if old == new:
        return
    if isinstance(old, dict) and isinstance(new, dict):
        for key in dict.fromkeys((*old, *new)):
            yield from _value((*path, key), old.get(key), new.get(key))
    elif _entries(old) and _entries(new):
        for before, after in _paired(old or [], new or []):
            named = (*path[:-1], _named(path[-1], before or after))
            if before is None or after is None:
                yield _change(named, None if before is None else "", None if after is None else "")
            else:
                yield from _value(named, before, after)
    else:
        yield _change(path, old, new)


def _entries(value: Any) -> bool:
    return value is None or (isinstance(value, list) and all(isinstance(each, dict) for each in value))


def _paired(old: list[Any], new: list[Any]) -> Iterator[tuple[Any, Any]]:
    """Entries found again by the first key that names each of them, in the order of the old list; then the others."""
    pairs: dict[int, Any] = {}
    left = list(new)
    for key in KNOWN_BY:
        names = {id(each): _name(each, key) for each in (*old, *left)}
        for before in old:
            same = [after for after in left if names[id(after)] is not None and names[id(after)] == names[id(before)]]
            twins = [each for each in old if id(each) not in pairs and names[id(each)] == names[id(before)]]
            if id(before) not in pairs and len(same) == 1 and len(twins) == 1:
                pairs[id(before)] = same[0]
                left = [each for each in left if each is not same[0]]
    yield from ((before, pairs.get(id(before))) for before in old)
    yield from ((None, after) for after in left)


def _name(entry: dict[str, Any], key: str) -> str | None:
    value = entry.get(key)
    return None if value in (None, "", []) else repr(value)


def _named(list_: str, entry: dict[str, Any]) -> str:
    """An entry of a list as a person calls it: by its id or number, and by its name; a coil is called one."""
    first, _, rest = str(entry.get("address", "")).partition(" ")
    table, number = (first, rest) if first in SPACES else ("", f"{first} {rest}".rstrip())
    word = table or SINGULAR.get(list_, list_)
    known = next((key for key in KNOWN_BY if _name(entry, key) is not None), "")
    found = [number if known == "address" else _shown(known, entry[known])] if known else []
    if known != "name" and entry.get("name"):
        found.append(str(entry["name"]))
    return " ".join([word, *found])


def _change(path: tuple[str, ...], old: Any, new: Any) -> Change:
    where = ", ".join(path[:-1]) or path[0]
    words = any(part.partition(" ")[0] in WORDS | {SINGULAR.get(each, each) for each in WORDS} for part in path)
    key = path[-1]
    entry = "" in (old, new) and None in (old, new)
    if entry:
        kind = Kind.NEW if old is None else Kind.ACTS
        return Change(Kind.WORDS if words else kind, ", ".join(path), "is new" if old is None else "is gone")
    lead = "" if len(path) == 1 else f"{key.replace('_', ' ')} "
    return Change(Kind.WORDS if words else Kind.ACTS, where, f"{lead}{_shown(key, old)}, now {_shown(key, new)}")


def _shown(key: str, value: Any) -> str:
    if value is None:
        return "not said"
    if isinstance(value, dict):
        return ", ".join(f"{name} {_shown(name, one)}" for name, one in value.items())
    if isinstance(value, list):
        return "; ".join(_shown(key, one) for one in value) or "none"
    return str(value)
