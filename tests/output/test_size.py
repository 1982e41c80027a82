"""How large the repository is, and what a further family adds to it on all platforms together."""

import re
from collections import Counter
from pathlib import Path

from tests.shipped import drives, sources

BLOCKS = Path(__file__).parents[2] / "blocks"
POU = re.compile(r"^ {3}<pou name=\"(\w+)\".*?^ {3}</pou>\n", re.MULTILINE | re.DOTALL)


def sizes() -> Counter[str]:
    """Bytes of what is of each family, by prefix, and of the rest, by "", with the test programs of one family."""
    found = Counter[str]()
    stems = {one.path.stem: one.drive.prefix for one in sources()}
    for path in (each for each in BLOCKS.rglob("*") if each.is_file()):
        parts = path.relative_to(BLOCKS).parts
        first = next((stems[each] for each in parts if each in stems), path.name.split("_")[0].split(".")[0])
        prefix = next((each for each in (first, *parts) if each in drives()), "")
        found["" if parts[0] == "tests" else prefix] += path.stat().st_size
    project = (BLOCKS / "beremiz/DriveBlocks/plc.xml").read_text("utf-8")
    for match in POU.finditer(project):
        if (prefix := match[1].split("_")[0]) in drives():
            found.update({prefix: len(match[0].encode()), "": -len(match[0].encode())})
    return found


def test_a_family_adds_less_than_a_megabyte_as_a_rule_and_two_thirds_more_at_most() -> None:
    found = sizes()
    own = {prefix: size for prefix, size in found.items() if prefix}
    assert own.keys() == drives().keys()
    assert max(own.values()) <= 1_650_000, own
    assert sum(own.values()) / len(own) <= 940_000, own
    assert found[""] <= 8_450_000, "what all share"
