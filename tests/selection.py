"""Which tests run: the default's, or all. `--scope default` chooses by these rules, `--scope rest` takes the others.

Each rule of line, drive, map, export and command has its least case, and that is a test without a mark. A test that is
marked `thorough` finds little that the others miss, for what it costs. What is said of each family runs for two of
them, unless it is marked `every_family`: a new family must not make the default longer.
"""

import json
import re
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
TWO = {"CHF", "ATV312"}
"""Families that go through everything: one whose commands are words, and one that starts by a path of states."""
SCOPES = ("all", "default", "rest")


@cache
def families() -> dict[str, str]:
    """The prefix of each shipped map, by what an id can call it: its prefix, or the name of its file."""
    found: dict[str, str] = {}
    for path in ROOT.glob("vendor_maps/*.yaml"):
        said = re.search(r"^prefix: (\w+)", path.read_text("utf-8"), re.MULTILINE)
        if said is not None:
            found |= {said[1]: said[1], said[1].lower(): said[1], path.stem: said[1], path.name: said[1]}
    return found


def of_families(item: pytest.Item) -> set[str]:
    """The families that the case of a test names, by their prefixes."""
    case = item.name.partition("[")[2].removesuffix("]")
    return {families()[word] for word in re.split(r"[-/:@ ]", case) if word in families()}


def is_default(item: pytest.Item) -> bool:
    """Whether the default runs a test."""
    if item.get_closest_marker("thorough") is not None:
        return False
    named = of_families(item)
    return item.get_closest_marker("every_family") is not None or not named or bool(named & TWO)


def add_options(parser: pytest.Parser) -> None:
    """`--scope` and `--tally` for the command line of pytest; who names tests by hand gets them all."""
    parser.addoption("--scope", choices=SCOPES, default="all", help="the tests of the default, the rest, or all")
    parser.addoption("--tally", help="file for the number of tests that ran, and of those that there are")


def choose(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leave in `items` what the scope has, and keep how many tests there are; a process of xdist hands that on."""
    scope, there = config.getoption("scope"), len(items)
    if scope != "all":
        default = [is_default(each) for each in items]
        left = [each for each, chosen in zip(items, default, strict=True) if chosen != (scope == "default")]
        config.hook.pytest_deselected(items=left)
        items[:] = [each for each, chosen in zip(items, default, strict=True) if chosen == (scope == "default")]
    counts = {"ran": len(items), "there": there}
    if hasattr(config, "workeroutput"):
        config.workeroutput["tally"] = counts
    else:
        write(config, counts)


def write(config: pytest.Config, counts: dict[str, int]) -> None:
    """Write the numbers of tests where `--tally` says."""
    if config.getoption("tally"):
        Path(config.getoption("tally")).write_text(json.dumps(counts), encoding="utf-8")
