"""What was proved of the blocks that every drive shares, kept until their text, their rules or the prover change."""

import json
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import asdict
from hashlib import sha256
from importlib.resources import files as resources
from pathlib import Path
from typing import Any

import z3

from driveblocks.bench.outcome import Outcome, Result
from driveblocks.bench.runner import Tell
from driveblocks.maps.collection import Source
from driveblocks.prove import prover, report, rules
from driveblocks.prove.facts import facts
from structured_text import files
from structured_text.engines.engine import EngineError
from structured_text.engines.engine import Source as Text
from structured_text.engines.matiec.cache import Cache, cache_folder

FILE = "proofs.json"


def run(
    sources: Sequence[Source], cache: Cache | None = None, tell: Tell = lambda *_: None
) -> Iterator[tuple[Result, bool]]:
    """The results of the shared blocks, then of each drive, and whether they were kept from an earlier run.

    Raises UnsupportedError, CheckError.
    """
    cache = cache or Cache(cache_folder())
    made = dict(prover.texts(sources))
    key = _key(made[prover.GENERIC])
    folder = cache.found(key)
    if folder is not None:
        yield from ((each, True) for each in _read(folder / FILE))
    else:
        done = []
        for each in prover.proved(made[prover.GENERIC], {prover.GENERIC: rules.shared()}, tell):
            done.append(report.result(each))
            yield done[-1], False
        if all(each.passed for each in done):
            with suppress(EngineError):  # where nothing can be kept it is proved again
                cache.entry(key, lambda making: _write(making / FILE, done))
    every = {each.path: each for some in made.values() for each in some}
    subjects = {each.path.stem: rules.family(facts(each.drive)) for each in sources}
    for proof in prover.proved(list(every.values()), subjects, tell):
        yield report.result(proof), False


def _key(texts: Sequence[Text]) -> str:
    """All that the proofs of the shared blocks are made of."""
    digest = sha256(z3.get_version_string().encode())
    for each in texts:
        digest.update(f"{each.path}\n{each.text}\n".encode())
    for package in ("driveblocks.prove", "structured_text.language", "structured_text.engines.embedded"):
        for file in sorted(resources(package).iterdir(), key=lambda each: each.name):
            if file.name.endswith((".py", ".yaml")):
                digest.update(file.read_bytes())
    return digest.hexdigest()


def _write(path: Path, done: Sequence[Result]) -> None:
    files.put(path, json.dumps([asdict(each) for each in done]), new=True)


def _read(path: Path) -> list[Result]:
    kept: list[dict[str, Any]] = json.loads(path.read_text("utf-8"))
    return [
        Result(
            **each
            | {
                "outcomes": tuple(Outcome(**one) for one in each["outcomes"]),
                "properties": tuple(map(tuple, each["properties"])),
                "record": (),
            }
        )
        for each in kept
    ]
