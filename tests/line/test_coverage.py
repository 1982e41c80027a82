"""Random walks keep every rule, reach every line and outcome of the line's blocks, and stay within the loops it states."""

import re
from functools import cache

from tests.blocks.library import sources
from tests.line.vline import Bench, line_sources
from tests.line.walk import walk

from driveblocks.host.embedded import EmbeddedEngine
from driveblocks.host.embedded.library import EmbeddedLibrary

SEEDS = range(24)
UNREACHED: set[tuple[str, str]] = set()
"""What cannot come about, and why."""


@cache
def walked() -> EmbeddedLibrary:
    """A line of eight slots with counters, behind its walks."""
    library = EmbeddedEngine(coverage=True).build(line_sources())
    for seed in SEEDS:
        walk(seed, block=library.instance("MB_Line8"))
    return library


def test_walks_keep_the_rules_and_reach_everything() -> None:
    texts = {each.path: each.text.splitlines() for each in line_sources()}
    library = walked()
    lines = {(path, line) for path, hits in library.coverage().items() for line in hits if not hits[line]}
    for path, outcomes in library.branches().items():
        lines |= {(path, outcome.line) for outcome, hits in outcomes.items() if not hits}
    mine = {each for each in lines if each[0].startswith("line/") and not re.search("Line32|ByteLine", each[0])}
    assert {f"{path}:{line}: {texts[path][line - 1].strip()}" for path, line in sorted(mine)} == set()


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
    stated = re.search(r"Loops .*?(\d+)\n {3}Made", text, re.DOTALL)
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
