"""The test of a plant: all its scenes, side by side, each from the state in which it begins."""

import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, ProcessPoolExecutor, wait
from dataclasses import dataclass, field
from itertools import groupby

from driveblocks.bench.outcome import ERROR, FAILED, PASSED, Outcome, Result, Run
from driveblocks.desk.run import source
from driveblocks.desk.site.line import Figures
from driveblocks.plant import scenes
from driveblocks.plant.crew import Crew
from driveblocks.plant.line import sources
from driveblocks.plant.model import Plant
from driveblocks.plant.scenes import OFF, READY, RUNNING, Scene
from driveblocks.plant.stand import Broken, Stand
from structured_text.engines.discovery import EMBEDDED
from structured_text.engines.engine import ScanError

LOOK_S = 0.2
"""Between two looks at what is done."""
Tell = Callable[[int, int, str], None]
"""Takes how many of how many scenes are done, and what is at hand."""
MOST = 4
"""Scenes that a process plays before it says so."""
Key = tuple[str, str]
"""Where a scene begins: its state, and the drive that has to run."""


@dataclass
class Trial:
    """A plant with its program; stands are kept where scenes begin."""

    plant: Plant
    text: str
    figures: Mapping[str, Figures]
    _kept: dict[Key, Stand | Broken | ScanError] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Compile it. Raises BuildError."""
        self._loaded = source.load(f"{self.plant.program}.st", self.text, sources(self.plant))

    def scenes(self) -> list[Scene]:
        return [*scenes.scenes(self.plant)]

    def play(self, scene: Scene) -> Outcome:
        """Play one."""
        begun = self._stand(_key(scene))
        if not isinstance(begun, Stand):
            said = f"the plant does not come so far: {begun}"
            return Outcome(scene.name, ERROR, said, scene=scene.name)
        stand = begun.copied()
        try:
            scene.play(Crew(stand, self.figures))
        except Broken as broken:
            after = f"{(stand.ms - begun.ms) / 1000:.1f} s after its beginning"
            return Outcome(
                scene.name, FAILED, f"{broken.expected}: {broken.actual}", broken.expected,
                "\n".join((f"{broken.actual}, {after}", *stand.seconds)), scene=scene.name,
            )  # fmt: skip
        except ScanError as error:
            return Outcome(scene.name, ERROR, str(error), scene=scene.name)
        return Outcome(scene.name, PASSED, scene=scene.name)

    def _stand(self, key: Key) -> Stand | Broken | ScanError:
        """A stand where scenes begin, or why there is none."""
        if key not in self._kept:
            self._kept[key] = self._brought(*key)
        return self._kept[key]

    def _brought(self, begins: str, drive: str) -> Stand | Broken | ScanError:
        if begins == OFF:
            return Stand(self.plant, self._loaded)
        before = self._stand((READY if begins == RUNNING else OFF, ""))
        if not isinstance(before, Stand):
            return before
        stand = before.copied()
        crew = Crew(stand, self.figures)
        try:
            scenes.ready(crew) if begins == READY else scenes.running(crew, drive)
        except (Broken, ScanError) as error:
            return error
        return stand


def _key(scene: Scene) -> Key:
    return scene.begins, scene.drive if scene.begins == RUNNING else ""


def run(trial: Trial, jobs: int = 1, tell: Tell = lambda *_: None, some: Iterable[Scene] | None = None) -> Run:
    """Play all scenes, or some, in so many processes; outcomes in their order."""
    start, listed = time.perf_counter(), trial.scenes() if some is None else [*some]
    order = sorted(range(len(listed)), key=lambda at: _key(listed[at]))
    alike = ([*each] for _, each in groupby(order, key=lambda at: _key(listed[at])))
    shares = [each[at : at + MOST] for each in alike for at in range(0, len(each), MOST)]
    found: dict[int, Outcome] = {}
    at = "the first scenes"
    for share, played in _played(trial, listed, shares, jobs):
        found |= zip(share, played, strict=True)
        at = listed[share[0]].name if share else at
        tell(len(found), len(listed), at)
    outcomes = tuple(found[at] for at in range(len(listed)))
    seconds = time.perf_counter() - start
    return Run([Result(EMBEDDED, trial.plant.program, "Plant", outcomes, seconds, group="Plant")], seconds)


def _played(
    trial: Trial, listed: Sequence[Scene], shares: Sequence[list[int]], jobs: int
) -> Iterator[tuple[list[int], list[Outcome]]]:
    """Shares of scenes, each with its outcomes as soon as they are known; none where time has passed without."""
    if jobs == 1:
        yield from ((share, [trial.play(listed[at]) for at in share]) for share in shares)
        return
    with ProcessPoolExecutor(jobs, initializer=_TRIALS.append, initargs=(trial,)) as pool:
        waiting = {pool.submit(_share, [listed[at].name for at in share]): share for share in shares}
        while waiting:
            done = wait(waiting, LOOK_S, FIRST_COMPLETED).done
            yield from ((waiting.pop(each), each.result()) for each in done)
            if not done:
                yield [], []


_TRIALS: list[Trial] = []
"""In a process that plays a share."""


def _share(names: Sequence[str]) -> list[Outcome]:
    trial = _TRIALS[0]
    by_name = {each.name: each for each in trial.scenes()}
    return [trial.play(by_name[each]) for each in names]
