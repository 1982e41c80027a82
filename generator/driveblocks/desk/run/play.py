"""What happens to the simulated drives of a run: a scenario, and what a person types meanwhile."""

import re
from collections.abc import Callable, Iterator, Mapping, Sequence

from driveblocks.desk import scenario
from driveblocks.desk.scenario import Happening
from driveblocks.maps.model import Drive
from driveblocks.maps.problem import MapError

WORDS = frozenset(verb.word for verb in scenario.VERBS)
_KEY = re.compile(r"(?P<key>[tdr]) (?P<unit>[0-9]{1,3})")


class Play:
    """Happenings in the order of their times, which count from the first scan."""

    def __init__(self, drives: Mapping[int, Drive], happenings: Sequence[Happening] = ()) -> None:
        """For drives at these units; whoever simulates them sets `act`."""
        self._drives, self._waiting = drives, list(happenings)
        self.act: Callable[[Happening], None]

    def due(self, at_us: int) -> Iterator[str]:
        """Let happen what is due, and say what it is."""
        while self._waiting and self._waiting[0].at_us <= at_us:
            happening = self._waiting.pop(0)
            self.act(happening)
            yield happening.says

    def takes(self, line: str) -> bool:
        """Whether a line says that something happens, right or wrong."""
        return bool(_KEY.fullmatch(line)) or line.split(" ", maxsplit=1)[0] in WORDS

    def typed(self, line: str, at_us: int) -> None:
        """Let it happen from now on. Raises ValueError, which says what would be right."""
        for text in self._sentences(line):
            try:
                found = scenario.said(text, self._drives)
            except MapError as error:
                raise ValueError("; ".join(f"{each.wrong}; {each.right}" for each in error.problems)) from None
            self._waiting += [Happening(at_us + each.at_us, each.says, each.act) for each in found]
        self._waiting.sort(key=lambda each: each.at_us)

    def _sentences(self, line: str) -> list[str]:
        """What a key means, or the line itself."""
        found = _KEY.fullmatch(line)
        if found is None:
            return [line]
        unit = int(found["unit"])
        drive = self._drives.get(unit)
        fault = next((each.code for each in drive.faults.codes if each.code), 1) if drive else 1
        texts = {"t": (f"trip {fault}",), "d": ("power off",), "r": ("clear", "power on", "reset")}[found["key"]]
        return [f"{text} {unit}" for text in texts]


class Plays:
    """The same at the lines of a program: a drive is named by its block, or by its unit address where that is clear."""

    def __init__(self, lines: Sequence[Play], names: Mapping[str, tuple[Play, int]]) -> None:
        """`names` are the drive blocks, each with its line and its unit address."""
        self.lines, self._names = lines, {name.upper(): each for name, each in names.items()}

    def due(self, at_us: int) -> Iterator[str]:
        """Let happen what is due, and say what it is."""
        for each in self.lines:
            yield from each.due(at_us)

    def takes(self, line: str) -> bool:
        """Whether a line says that something happens, right or wrong."""
        return self.lines[0].takes(self._meant(line)[1])

    def typed(self, line: str, at_us: int) -> None:
        """Let it happen from now on. Raises ValueError, which says what would be right."""
        lines, text = self._meant(line)
        if len(lines) > 1 and text.split()[-1].isdecimal() and not text.startswith("trip "):
            raise ValueError(f"there are {len(lines)} lines: name the drive, such as {next(iter(self._names))}")
        for each in lines:
            each.typed(text, at_us)

    def _meant(self, line: str) -> tuple[Sequence[Play], str]:
        """The lines that are meant, and what is said with the unit address of the drive."""
        before, _, name = line.rpartition(" ")
        found = self._names.get(name.upper())
        return ([found[0]], f"{before} {found[1]}") if found else (self.lines, line)
