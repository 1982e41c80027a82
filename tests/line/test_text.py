"""The text of the line: both sizes are one, and no call exceeds the loops that its head states."""

import re

from tests.blocks.library import sources
from tests.line.vline import Bench, line_sources

from structured_text.engines.embedded import EmbeddedEngine
from structured_text.engines.embedded.library import EmbeddedLibrary


def test_both_sizes_are_one_text() -> None:
    texts = {each.path: each.text for each in sources()}
    for block in ("Line", "ByteLine"):
        small, large = texts[f"line/MB_{block}8.st"], texts[f"line/MB_{block}32.st"]
        bodies = [re.sub(" +", " ", text.partition("END_VAR")[2].replace("32", "8")) for text in (small, large)]
        assert bodies[0] == bodies[1]


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
