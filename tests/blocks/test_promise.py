"""What `check` calls good builds, lints clean and passes its generated tests."""

import contextlib
import json
import random
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from tests.maps import mutate
from tests.shipped import BOTH

from driveblocks.bench import runner
from driveblocks.bench.suite import ROOT, drive_suite
from driveblocks.bench.unit import Unit
from driveblocks.docs.page import documents
from driveblocks.maps import catalog, collection, page
from driveblocks.maps.load import loads
from driveblocks.maps.model import Drive
from driveblocks.maps.problem import MapError
from driveblocks.render import expression, library
from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.engine import Source
from structured_text.language.lint import lint_sources

Plain = dict[str, Any]
READ_TOGETHER = 60
"""More terms than a statement has, and no more words than a drive block reads."""
OTHERS = Path(__file__).parent / "fourth_drive"
NAMES = {
    path.name: mutate.Text(path.name, path.read_text("utf-8")) for path in (*catalog.shipped(), *OTHERS.glob("*.yaml"))
}


@cache
def shared() -> tuple[library.File, ...]:
    """What every drive's blocks need."""
    return tuple(library.generic(BOTH))


def rendered(map_text: str) -> tuple[Drive, list[library.File]]:
    """The drive and its blocks. Raises MapError."""
    drive = loads(map_text, "map.yaml")
    return drive, list(library.drive("map", drive, BOTH))


def broken(map_text: str) -> Iterator[str]:
    """What the blocks of a map break of the promise. Raises MapError for a map that `check` refuses."""
    drive, blocks = rendered(map_text)
    documents([*shared(), *blocks], [drive])
    files = [each for each in shared() if "Text" not in each.name] + blocks  # no block needs the texts of results
    suite = drive_suite(collection.Source(Path("map.yaml"), drive), BOTH)
    unit = Unit(suite, tuple(Source(each.path, each.text) for each in files))
    own = {each.path for each in blocks} | {ROOT + each.path for each in suite.programs}
    for problem in lint_sources([(each.path, each.text) for each in unit.sources]):
        if problem.path in own:
            yield f"lint: {problem}"
    for result in runner.run([unit], [EmbeddedEngine()]).results:
        for outcome in result.bad:
            yield f"test {result.program}: {outcome.words}: {outcome.message}"


def document(name: str) -> Plain:
    """A map as mappings and lists that may be changed."""
    made: Plain = mutate.plain(NAMES[name].root)
    return made


def judged(changed: Plain) -> list[str]:
    """What breaks the promise of a map that `check` calls good."""
    return list(broken(json.dumps(changed, ensure_ascii=False)))


def rows(changed: Plain, count: int, **keys: Any) -> list[str]:
    """Add registers that stand apart; their addresses."""
    first = 0xA000 + 0x400 * len(keys)
    made = [{"address": f"{first + 2 * n:04X}H", "name": f"Row {first + n}", "zh": "行", **keys} for n in range(count)]
    changed["sections"][1]["registers"] += made
    return [str(row["address"]) for row in made]


def factors(changed: Plain) -> None:
    """Scales that no REAL holds; the reference counts in one of them."""
    for number, factor in enumerate(("0.03", "0.333333333", "0.123456789", "999999999.999999999", "0.007", "7")):
        row = {"name": f"Scaled {number}", "zh": "值", "unit": "V", "scale": {"factor": factor, "source": "part C"}}
        changed["sections"][1]["registers"].append({"address": f"{0xB000 + number:04X}H", **row})
    changed["sections"][0]["registers"][1]["scale"] = {"factor": "0.03", "source": "part C"}


def frequency(changed: Plain) -> None:
    """A reference in Hz whose word ends where a usual frequency falls."""
    changed["sections"][0]["registers"][1] |= {
        "unit": "Hz", "scale": {"factor": "0.007", "source": "part C"}, "range": {"min": "0", "max": "7142"}
    }  # fmt: skip
    changed["operation"]["reference"] = {"register": "8001H", "means": "frequency", "source": "part C"}


def lists(changed: Plain, count: int) -> None:
    """So many of everything that becomes the terms of one statement."""
    subs = [{"code": f"{0x200 + n:04X}H", "name": f"Test {n}", "zh": "试"} for n in range(count)]
    changed["functions"][1]["sub_functions"] += subs
    starts = rows(changed, count, access="rw")
    changed["serial"]["broadcast"]["start_addresses"] += starts
    changed["limits"]["read_words"]["value"] = "16"
    proof = [f"{0xD000 + n:04X}H" for n in range(min(count, READ_TOGETHER))]
    changed["sections"][1]["registers"] += [
        {"address": address, "name": f"Proof {address}", "zh": "零", "access": "r"} for address in proof
    ]
    changed["operation"]["standstill"]["all"] += [{"register": address, "equals": "0"} for address in proof]
    values = [{"value": f"{n * 3}", "name": f"Kind {n}", "zh": f"种{n}"} for n in range(count)]
    changed["sections"][1]["registers"].append({"address": "F000H", "name": "Kinds", "zh": "种", "values": values})


def many_codes(changed: Plain) -> None:
    """Hundreds of faults, with texts of every kind."""
    texts = ("85 °C", "it's $5", "(* a *)", "a *) b", "{{ x }}", "Überlast", "long " * 14 + "end")
    changed["faults"]["codes"] = [
        {"code": f"{n + 1}", "name": f"{texts[n % len(texts)]} {n}", "zh": f"{'过' * (n % 24)}(*{n}"}
        for n in range(400)
    ]


def names(changed: Plain) -> None:
    """Names that are words of the language, but no names of a pin or block by themselves."""
    for number, name in enumerate(("Step", "Limit", "Over 85 °C", "Real to int", "Check", "Test mode", "Max")):
        row = {"address": f"{0xB000 + number:04X}H", "name": name, "zh": "值"}
        changed["sections"][1]["registers"].append({**row, "values": [{"value": "1", "name": "On site", "zh": "一"}]})


CHANGES: list[tuple[str, Callable[[Plain], None]]] = [
    ("baumhof.yaml", factors),
    ("baumhof.yaml", frequency),
    ("baumhof.yaml", many_codes),
    ("nordwind.yaml", names),
]


@pytest.mark.thorough
@pytest.mark.parametrize(("name", "change"), CHANGES, ids=[change.__name__ for _, change in CHANGES])
def test_a_good_map_builds_lints_clean_and_passes(name: str, change: Callable[[Plain], None]) -> None:
    changed = document(name)
    change(changed)
    assert judged(changed) == []


def test_the_smallest_map_keeps_the_promise() -> None:
    assert list(broken(page.skeleton())) == []


@pytest.mark.thorough
def test_what_is_split_into_several_statements_means_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(expression, "TERMS", 3)
    changed = document("nordwind.yaml")
    lists(changed, 7)
    assert judged(changed) == []


def test_lists_longer_than_a_statement_lint_clean() -> None:
    changed = document("nordwind.yaml")
    lists(changed, 260)
    _, made = rendered(json.dumps(changed, ensure_ascii=False))
    assert lint_sources((each.path, each.text) for each in (*shared(), *made)) == []


@pytest.mark.thorough
def test_a_map_with_another_fact_builds_or_is_refused() -> None:
    chance, good = random.Random(7), []
    for _ in range(30):
        text = mutate.change_a_fact(chance.choice(list(NAMES.values())), chance).data.decode()
        with contextlib.suppress(MapError):
            rendered(text)
            good.append(text)
    assert list(broken(good[0])) == []
