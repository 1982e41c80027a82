"""A life of each map that is drawn at random: `driveblocks test` passes, and finds a simulated drive that lies.

`python -m tests.shapes.life [--first SEED] [--count N] [--store FILE]` judges batches of them; a batch that is stored
is not judged again. `--lies` gives each another fact than its block has, which some program has to find.
"""

import json
import sys
from collections import Counter
from collections.abc import Sequence
from dataclasses import fields, replace
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

from tests.line.many import Judged, arguments, judged, summary
from tests.shapes import drawn
from tests.shapes.sheet import Row, moved

from driveblocks.bench import runner
from driveblocks.bench.unit import Unit
from driveblocks.maps import model
from driveblocks.maps.collection import Source
from driveblocks.maps.load import load, loads
from driveblocks.maps.problem import MapError
from driveblocks.maps.shape import keys_of
from driveblocks.output.units import units
from driveblocks.render.text import languages
from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.language.lint import lint_sources

BATCH = 5
"""Maps that are compiled together."""
EACH = 20
"""So many of them have each key of the format."""
SISTERS = 13
"""So many apart are the maps that have a base."""
ENGLISH = languages(["en"], "utf-8")


def made(seeds: Sequence[int]) -> list[Source]:
    """Their maps, as `check` reads them; some are sisters, with the drawn map as their base. Raises MapError."""
    return [_sister(seed) if seed % SISTERS == 0 else Source(Path(f"d{seed}.yaml"), loads(
        drawn.text(seed), f"d{seed}.yaml")) for seed in seeds]  # fmt: skip


def _sister(seed: int) -> Source:
    with TemporaryDirectory() as folder:
        base, own = Path(folder) / f"d{seed}.yaml", Path(folder) / f"s{seed}.yaml"
        base.write_text(drawn.text(seed), encoding="utf-8")
        own.write_text(drawn.written(drawn.sister(seed, base.stem)), encoding="utf-8")
        return Source(Path(own.name), load(own))


def judge(name: str) -> Judged:
    """Judge a batch: `20` is the one of seeds 20 to 24."""
    out, first = Judged(name), int(name)
    try:
        some = made(range(first, first + BATCH))
    except MapError as error:
        out.tell("check", str(error))
        return out
    for source in some:
        for key in keys(source.drive):
            out.figures[key] = out.figures.get(key, 0) + 1
    built = units(some, ENGLISH)[1:]
    blocks = {each.path: each for unit in built for each in unit.blocks}
    if wrong := lint_sources([(each.path, each.text) for each in blocks.values()]):
        out.tell("lint", str(wrong[0]))
    return _run(built, out)


def _run(built: Sequence[Unit], out: Judged) -> Judged:
    for result in runner.run(built, [EmbeddedEngine()]).results:
        for bad in result.bad:
            out.tell(result.program, f"{bad.words}: {bad.message}"[:300])
    return out


def keys(part: object) -> set[str]:
    """The keys that a map has, as `Drive.watchdog`."""
    found: set[str] = set()
    if isinstance(part, tuple):
        return found.union(*map(keys, part))
    for each in fields(part) if isinstance(part, model.Entry) else ():
        value = getattr(part, each.name)
        if "doc" in each.metadata and value != each.default:
            found |= {f"{type(part).__name__}.{each.name}"} | keys(value)
    return found


def format_keys() -> set[str]:
    """Those of the format."""
    kinds: list[type] = [one for one in vars(model).values() if isinstance(one, type) and issubclass(one, model.Entry)]
    used = [kind for kind in kinds if kind not in (model.Entry, model.Named, model.Returned, model.Choice)]
    return {f"{kind.__name__}.{name}" for kind in used for name in keys_of(kind)}


# ---------------------------------------------------------------- lies


def lie(name: str) -> Judged:
    """Judge one whose simulated drive is another than the map of its block says."""
    out, seed = Judged(name), int(name)
    true = Source(Path(f"d{seed}.yaml"), loads(drawn.text(seed), f"d{seed}.yaml"))
    rows, told = _another(drawn.draw(seed), Random(f"lie {seed}"))
    try:
        false = Source(true.path, loads(drawn.written(rows), "lie.yaml"))
    except MapError:
        out.most("found by `check`", 1)
        return out
    block, other = units([true], ENGLISH)[1], units([false], ENGLISH)[1]
    found = _run([replace(other, blocks=block.blocks)], Judged(name))
    if not found.told:
        out.tell("believed", told)
    return out


def _another(rows: Row, chance: Random) -> tuple[Row, str]:
    """One fact is another: the word of a command, the present fault, a scale."""
    return chance.choice((_command, _fault, _reference, _frequency))(_unproved(rows))


def _unproved(rows: Row) -> Row:
    """The same without example frames, by which `check` finds a wrong scale."""
    rows |= {"frames": []}
    rows.get("numbering", {}).pop("proof", None)
    for row in (row for part in rows["sections"] for row in part["registers"]):
        row.get("scale", {}).pop("proof", None)
    for each in rows["errata"]:
        each["about"] = [name for name in each["about"] if not name.startswith("frame ")]
    rows["errata"] = [each for each in rows["errata"] if each["about"]]
    return rows


def _row(rows: Row, place: str) -> Row:
    """The row of a register, whose table may be named before its address."""
    table, _, address = place.rpartition(" ")
    found = [(part, row) for part in rows["sections"] for row in part["registers"]]
    spaces = [(row.get("space") or part.get("space") or "holding", row) for part, row in found]
    return next(row for space, row in spaces
                if space == (table or "holding") and row["address"].partition("-")[0] == address)  # fmt: skip


def _command(rows: Row) -> tuple[Row, str]:
    """A run is another value, where values are listed."""
    every = rows["operation"]["commands"]
    one = next(each for each in every if each["does"] == "run_forward")
    row = _row(rows, one["register"])
    listed = [each for each in row.get("values", ()) if each["value"] == one.get("value")]
    if not listed or one["register"].startswith("coil"):
        return _frequency(rows)
    for each in every:
        if each["register"] == one["register"] and each.get("value") == listed[0]["value"]:
            each["value"] = 77
    listed[0]["value"] = 77
    return rows, "a run is 77"


def _fault(rows: Row) -> tuple[Row, str]:
    """The present fault is elsewhere."""
    if "present" not in rows["faults"]:
        return _frequency(rows)
    at = rows["faults"]["present"].rpartition(" ")[2]
    there = moved(at, 5)
    made: Row = json.loads(json.dumps(rows).replace(at, there))
    return made, f"the present fault is at {there}"


def _reference(rows: Row) -> tuple[Row, str]:
    """The reference is ten times as large, where it has a scale."""
    row = _row(rows, rows["operation"]["reference"]["register"])
    if "scale" not in row:
        return _frequency(rows)
    row["scale"]["factor"] *= 10
    return rows, "the reference is ten times as large"


def _frequency(rows: Row) -> tuple[Row, str]:
    """The output frequency is ten times as large."""
    row = _row(rows, rows["operation"]["standstill"]["all"][1]["register"])
    row["scale"]["factor"] *= 10
    return rows, "the output frequency is ten times as large"


def report(found: Sequence[Judged]) -> int:
    """What they have shown, and which keys too few of them have; 1 where one failed."""
    bad, count = summary(found), Counter[str]()
    for each in found:
        count.update({key: int(number) for key, number in each.figures.items()})
    every = format_keys()
    rare = {key: count[key] for key in sorted(every) if count[key] < EACH}
    print(f"keys: {len(every)}, fewer than {EACH} times: {rare}")
    return bad


def main() -> int:
    """Judge."""
    parser = arguments(__doc__ or "", 1000)
    parser.add_argument("--only", help="one of them")
    parser.add_argument("--lies", action="store_true", help="simulated drives that lie")
    options = parser.parse_args()
    step = 1 if options.lies else BATCH
    names = [options.only] if options.only else [
        str(options.first + at) for at in range(0, options.count, step)]  # fmt: skip
    return report(judged(names, lie if options.lies else judge, options.jobs, options.store))


if __name__ == "__main__":
    sys.exit(main())
