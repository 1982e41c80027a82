"""The text of the line: all sizes are one, and no call exceeds the loops that its head states."""

import re

from tests.blocks.library import sources
from tests.line.vline import Bench, line_sources

from structured_text.engines.embedded import EmbeddedEngine
from structured_text.engines.embedded.library import EmbeddedLibrary

SLOTS = (2, 8, 32)
"""The sizes of a line."""


def test_all_sizes_are_one_text() -> None:
    """They differ only in the number of slots and in its double."""
    texts = {each.path: each.text for each in sources()}
    for block in ("Line", "ByteLine"):
        bodies = [texts[f"line/MB_{block}{slots}.st"].partition("END_VAR")[2] for slots in SLOTS]
        pieces = [re.split(r"(\d+)", re.sub(" +", " ", body)) for body in bodies]
        found = {row for row in zip(*pieces, strict=True) if len(set(row)) > 1}
        assert found <= {tuple(str(times * slots) for slots in SLOTS) for times in (1, 2)}


def test_no_call_exceeds_the_loops_that_its_head_states() -> None:
    """As many characters as a ring can hold beside those that come, and a request to make."""
    library = EmbeddedEngine(coverage=True).build(line_sources())
    bench = Bench(block=library.instance("MB_Line8")).ready()
    before = turns(library)
    bench.block["Port.RxIn"] = (bench["Port.RxOut"] + 200) % 256
    bench.scan()
    rounds = turns(library) - before
    text = next(each.text for each in line_sources() if each.path == "line/MB_Line8.st")
    stated = re.search(r"Loops .*?(\d+)\n {3}Body", text, re.DOTALL)
    assert stated is not None
    assert 200 < rounds <= int(stated[1])


def turns(library: EmbeddedLibrary) -> int:
    """How often the first statement in a loop has run."""
    total = 0
    for source in line_sources():
        hits = library.coverage().get(source.path, {})
        starts = [n for n, text in enumerate(source.text.splitlines(), start=1) if text.endswith(" DO")]
        total += sum(hits[min(line for line in hits if line > start)] for start in starts if hits)
    return total
