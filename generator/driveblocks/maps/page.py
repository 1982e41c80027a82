"""What the pages on the format take from elsewhere: the smallest map, and every key with its meaning and an example."""

from collections.abc import Iterator
from importlib.resources import files

from driveblocks.maps.model import Cited, Drive
from driveblocks.maps.shape import EntryOf, Key, ListOf, OneOf, keys_of, told_last

BEGIN, END = "<!-- skeleton:begin -->", "<!-- skeleton:end -->"

PREFIX = "ACME"
"""What the names of the skeleton's blocks start with."""

_KEYS = """# Every key of a map

The reference to [the guide](README.md). Written by `driveblocks schema vendor_maps` from the model of maps. `must`
marks the keys that cannot be left out.
"""
_ANY_SOURCE = """
## Wherever a source may be

Every entry with a `source` has these keys, too; a [Register](#register) and a [Fault](#fault) have the first two, and a
[Frame](#frame) is printed as a whole.
"""
HEAD = "| key | must | meaning | example |\n|---|---|---|---|\n"


def update(text: str) -> str:
    """Return the guide's text with the map between the markers made anew. Raises ValueError without markers."""
    before, begin, rest = text.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not begin or not end:
        raise ValueError(f"the page lacks the markers {BEGIN} and {END}")
    return f"{before}{BEGIN}\n```yaml\n{skeleton()}```\n{END}{after}"


def skeleton() -> str:
    """The smallest whole map, with comments that say what to replace."""
    return (files(__package__) / "skeleton.yaml").read_text(encoding="utf-8")


def reference() -> str:
    """Markdown: one table per kind of entry, in the order in which they first appear in a map."""
    any_source = "".join(row(key) for key in keys_of(Cited).values())
    return _KEYS + f"{_ANY_SOURCE}\n{HEAD}{any_source}" + "".join(_table(cls) for cls in classes())


def classes() -> Iterator[type]:
    """Every model class that a map is made of, parents before parts, each once."""
    seen: list[type] = [Drive]
    for cls in seen:
        yield cls
        seen.extend(part for part in _parts(cls) if part not in seen)


def _parts(cls: type) -> list[type]:
    shapes = [key.shape.item if isinstance(key.shape, ListOf) else key.shape for key in keys_of(cls).values()]
    return list(dict.fromkeys(shape.cls for shape in shapes if isinstance(shape, EntryOf)))


def _table(cls: type) -> str:
    purpose = (cls.__doc__ or "").strip().splitlines()[0]
    rows = "".join(row(key) for name, key in keys_of(cls).items() if name not in told_last(cls))
    return f"\n## {cls.__name__}\n\n{purpose}\n\n{HEAD}{rows}"


def row(key: Key) -> str:
    """A key with its meaning and an example, as a row of a table."""
    example = f"{key.name}: {key.example}".replace("|", "\\|")
    link = _link(key)
    return f"| `{key.name}` | {'yes' if key.required else ''} | {key.doc}{_words(key)}{link} | `{example}` |\n"


def _words(key: Key) -> str:
    """The words that a key can have, where these are all."""
    shape = key.shape.item if isinstance(key.shape, ListOf) else key.shape
    if not isinstance(shape, OneOf):
        return ""
    return f"; {'one of ' if len(shape.words) > 1 else ''}{', '.join(f'`{word}`' for word in shape.words)}"


def _link(key: Key) -> str:
    many = isinstance(key.shape, ListOf)
    shape = key.shape.item if isinstance(key.shape, ListOf) else key.shape
    if not isinstance(shape, EntryOf):
        return " (list)" if many else ""
    name = shape.cls.__name__
    return f" ({'list of ' if many else ''}[{name}](#{name.lower()}))"
