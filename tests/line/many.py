"""Many random cases by their seeds: what broke is printed, and what a file has is not judged again."""

import argparse
import json
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass, field
from pathlib import Path

JOBS = 2


@dataclass
class Judged:
    """What has come of a case; `told` are broken rules, each once, the first one first."""

    name: str
    """How it is found again: a seed, or words."""
    told: list[str] = field(default_factory=list)
    figures: dict[str, float] = field(default_factory=dict)

    def tell(self, rule: str, seen: str) -> None:
        """A broken rule."""
        if rule not in self.rules:
            self.told.append(f"{rule}: {seen}")

    def most(self, figure: str, value: float) -> None:
        """A figure whose largest value counts."""
        self.figures[figure] = max(value, self.figures.get(figure, value))

    @property
    def rules(self) -> list[str]:
        """Their names."""
        return [each.partition(":")[0] for each in self.told]


def arguments(words: str, count: int) -> argparse.ArgumentParser:
    """What every such run understands."""
    parser = argparse.ArgumentParser(description=words.partition("\n")[0])
    parser.add_argument("--first", type=int, default=0, help="the first seed")
    parser.add_argument("--count", type=int, default=count, help="seeds")
    parser.add_argument("--jobs", type=int, default=JOBS, help="processes")
    parser.add_argument("--store", type=Path, help="one line for each case; what is there is not judged again")
    return parser


def judged(names: Iterable[str], judge: Callable[[str], Judged], jobs: int, store: Path | None) -> list[Judged]:
    """Judge cases by name, and print each that breaks a rule."""
    known = _stored(store)
    wanted = list(names)
    found = [known[each] for each in wanted if each in known]
    with ProcessPoolExecutor(jobs) as pool:
        for one in pool.map(judge, [each for each in wanted if each not in known], chunksize=4):
            found.append(one)
            if store:
                store.parent.mkdir(parents=True, exist_ok=True)
                with store.open("a", encoding="utf-8") as file:
                    file.write(json.dumps(asdict(one)) + "\n")
            if one.told:
                print(f"{one.name}: {'; '.join(one.told)}", flush=True)
    return found


def _stored(place: Path | None) -> dict[str, Judged]:
    if place is None or not place.exists():
        return {}
    rows = [json.loads(line) for line in place.read_text("utf-8").splitlines()]
    return {row["name"]: Judged(**row) for row in rows}


def summary(found: Sequence[Judged]) -> int:
    """Print how many broke which rule; 1 where one did."""
    bad = [each for each in found if each.told]
    rules = Counter(rule for each in bad for rule in each.rules)
    print(f"{len(found)} cases, {len(bad)} fail: {dict(rules.most_common())}")
    return 1 if bad else 0
