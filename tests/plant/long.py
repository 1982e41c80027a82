"""Plants drawn at random: each is good, and its motors turn and stop; `make long WHAT=plants`.

`python -m tests.plant.long [--first 0] [--count 200] [--only-check]`: programs run in virtual time.
"""

import argparse
import sys
import tempfile
from pathlib import Path

from tests.plant.bench import Bench, loaded
from tests.plant.draw import draw

from driveblocks.maps.problem import Refused
from driveblocks.plant.check import judged
from driveblocks.plant.model import Plant

READY_MS, TURNS_MS, STANDS_MS = 30_000, 90_000, 90_000
"""From power-up until all may start, from a start until all turn, from a stop until all are proved at standstill."""


def turned(plant: Plant) -> None:
    """Start everything that a hand can start, then stop it all. Raises AssertionError."""
    bench = Bench(plant)
    alone = [name for name, each in plant.drives.items() if each.mode == "full"]
    alone = [name for name in alone if not any(name in group.drives for group in plant.groups.values())]
    members = [name for group in plant.groups.values() for name in group.drives]
    for name, each in plant.drives.items():
        if each.speed is None and each.mode != "monitor":
            bench.give(**{f"{name}_Hertz": 0.6 * float(each.maximum_hz)})
    for name, one in plant.inputs.items():
        bench.give(**{name: sum(one.raw) // 2})
    bench.run(1000)
    bench.until(lambda: all(bench[f"{name}.Ready"] for name in [*alone, *members]), READY_MS)
    for start in [*alone, *plant.groups]:
        bench.give(**{f"{start}_Start": True})
    bench.run(50)
    most = {
        name: each.duty or 1 if each.kind == "duty_standby" else len(each.drives) for name, each in plant.groups.items()
    }
    bench.until(
        lambda: (
            bench.turning() >= {*alone}
            and all(len(bench.turning() & {*group.drives}) == most[name] for name, group in plant.groups.items())
        ),
        TURNS_MS,
    )
    bench.give(Hmi_StopAll=True)
    bench.until(lambda: not bench.turning(), STANDS_MS)
    bench.until(lambda: all(bench[f"{name}.StopConfirmed"] for name in [*alone, *members]), STANDS_MS)


def main() -> int:
    """Print each plant that is not good or does not turn, and how many; the exit status is 1 if there is one."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--first", type=int, default=0, help="the first seed")
    parser.add_argument("--count", type=int, default=200, help="how many")
    parser.add_argument("--only-check", action="store_true", help="start no motor")
    words, bad = parser.parse_args(), 0
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "plant.yaml"
        for seed in range(words.first, words.first + words.count):
            path.write_text(draw(seed), encoding="utf-8")
            try:
                plant = judged(path).plant
                if not words.only_check:
                    turned(plant)
                    loaded.cache_clear()  # a program is not seen twice
            except (Refused, AssertionError) as error:
                bad += 1
                print(f"seed {seed}: {error}", flush=True)
    print(f"{words.count - bad} of {words.count} plants are good{'' if words.only_check else ', and turn and stop'}")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
