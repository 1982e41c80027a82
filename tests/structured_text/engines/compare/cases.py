"""The blocks of the corpus and how each is driven: corpus.yaml as typed data, and the stimulus that follows from it.

Words of an input: `chance: p` a BOOL that is TRUE with probability p; `whole: [low, high]` an integer;
`real: [low, high]` a double, `single: yes` rounded to REAL; `bytes: n` n bytes; `wholes: n` with `from: [low, high]`
n integers; `text: [...]` one of these strings. `often: [...]` values that come up a quarter of the time (of `bytes`
and `wholes`: per element). `change: p` the probability of a new draw per scan, otherwise the input stays; 1 if absent.
A `scenario` draws all inputs together. `step_ms` is what the clock may move by, `jitter_ns` is added to it.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import yaml
from tests.structured_text.engines.compare.draws import Draws, single
from tests.structured_text.engines.compare.scenarios import SCENARIOS, Inputs

from structured_text.engines.engine import Source, Value

CORPUS = Path(__file__).parent.parent / "corpus"
OFTEN = 0.25

Draw = Callable[[Draws], Value]


@dataclass(frozen=True)
class Input:
    """One path of the instance with how its next value is drawn."""

    path: str
    draw: Draw
    change: float = 1.0


@dataclass(frozen=True)
class Stimulus:
    """What happens before one scan: the clock in nanoseconds, the values to set."""

    clock: int
    inputs: Inputs


@dataclass(frozen=True)
class Case:
    """A block of the corpus. `scans`: in the suite; `trace`: recorded; both in numbers of scans.

    `handed_on` and `library` name paths in upper case, as explained in corpus.yaml.
    """

    name: str
    block: str
    scans: int
    trace: int
    steps_ns: tuple[int, ...]
    jitter_ns: tuple[int, ...]
    inputs: tuple[Input, ...]
    scenario: str = ""
    handed_on: tuple[str, ...] = ()
    library: tuple[str, ...] = ()
    sources: tuple[Source, ...] = field(default=(), repr=False)

    def stimuli(self, seed: int) -> Iterator[Stimulus]:
        """An endless stimulus that depends on nothing but the case's name and the seed."""
        draws = Draws(self.name, seed)
        values = SCENARIOS[self.scenario](draws) if self.scenario else self._values(draws)
        clock = 0
        for inputs in values:
            yield Stimulus(clock, inputs)
            clock += draws.one_of(self.steps_ns) + draws.one_of(self.jitter_ns)

    def _values(self, draws: Draws) -> Iterator[Inputs]:
        yield {each.path: each.draw(draws) for each in self.inputs}
        while True:
            yield {each.path: each.draw(draws) for each in self.inputs if draws.chance(each.change)}


def load_cases() -> dict[str, Case]:
    """All cases of the corpus by name, in the order of corpus.yaml."""
    data = yaml.safe_load((CORPUS / "corpus.yaml").read_text(encoding="utf-8"))
    return {name: _case(name, entry) for name, entry in data.items()}


def _case(name: str, entry: dict[str, Any]) -> Case:
    return Case(
        name=name,
        block=entry["block"],
        scans=entry["scans"],
        trace=entry["trace"],
        steps_ns=tuple(ms * 1_000_000 for ms in entry.get("step_ms", [10])),
        jitter_ns=tuple(entry.get("jitter_ns", [0])),
        inputs=tuple(
            Input(path, _draw(words), words.get("change", 1.0)) for path, words in entry.get("inputs", {}).items()
        ),
        scenario=entry.get("scenario", ""),
        handed_on=tuple(path.upper() for path in entry.get("handed_on", [])),
        library=tuple(path.upper() for path in entry.get("library", [])),
        # Read in binary so that messages and cache keys are the same on every system.
        sources=(Source(f"{name}.st", (CORPUS / f"{name}.st").read_bytes().decode()),),
    )


def _draw(words: dict[str, Any]) -> Draw:
    often = words.get("often", [])
    match words:
        case {"chance": probability}:
            return lambda draws: draws.chance(probability)
        case {"text": texts}:
            return lambda draws: draws.one_of(texts).encode()
        case {"whole": [low, high]}:
            return lambda draws: _whole(draws, low, high, often)
        case {"bytes": count}:
            return lambda draws: bytes(_whole(draws, 0, 255, often) for _ in range(count))
        case {"wholes": count, "from": [low, high]}:
            return lambda draws: [_whole(draws, low, high, often) for _ in range(count)]
        case {"real": [low, high]}:
            return lambda draws: _real(draws, low, high, often, bool(words.get("single")))
    raise ValueError(f"no known way to draw in {words}")


def _whole(draws: Draws, low: int, high: int, often: list[int]) -> int:
    return draws.one_of(often) if often and draws.chance(OFTEN) else draws.whole(low, high)


def _real(draws: Draws, low: float, high: float, often: list[float], narrow: bool) -> float:
    value = draws.one_of(often) if often and draws.chance(OFTEN) else draws.between(low, high)
    return single(value) if narrow else value
