"""What the page on plants takes from elsewhere: the first plant, and every key with its meaning and an example."""

from driveblocks.maps.page import HEAD, row
from driveblocks.maps.shape import keys_of
from driveblocks.plant import draft
from driveblocks.plant.model import SECTIONS, Members, Plant

BEGIN, END = "<!-- keys:begin -->", "<!-- keys:end -->"


def update(text: str) -> str:
    """The page with its tables made anew. Raises ValueError without markers."""
    before, begin, rest = text.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not begin or not end:
        raise ValueError(f"the page lacks the markers {BEGIN} and {END}")
    return f"{before}{BEGIN}\n{reference()}{END}{after}"


def reference() -> str:
    """Markdown: the first plant, and a table per section."""
    tables: dict[str, type] = {"At the top": Plant}
    tables |= {f"`{name}`": each for name, each in SECTIONS.items()} | {"Members": Members}
    return f"```yaml\n{draft.example()}```\n" + "".join(_table(name, cls) for name, cls in tables.items())


def _table(name: str, cls: type) -> str:
    purpose = (cls.__doc__ or "").strip().splitlines()[0]
    return f"\n### {name}\n\n{purpose}\n\n{HEAD}{''.join(row(key) for key in keys_of(cls).values())}"
