"""What is wrong with a map: where, what, and what would be right. Collected, so that a file's mistakes come at once."""

from dataclasses import dataclass, field

from structured_text.visible import file_name

Place = tuple[int, int]
"""1-based line and column in the file."""


class Taken(tuple[int, int]):
    """The place where a map asks for its base, of something that it takes over; and where the base says that."""

    file: str
    there: Place
    without: Place | None

    def __new__(cls, at: Place, file: str, there: Place, without: Place | None) -> "Taken":
        """`without`: where the map says what it leaves out."""
        made = super().__new__(cls, at)
        made.file, made.there, made.without = file, there, without
        return made


def line(place: Place) -> str:
    """A line of this file, or of the base's."""
    return f"line {place.there[0]} of {place.file}" if isinstance(place, Taken) else f"line {place[0]}"


MAX_PROBLEMS = 1000
"""Nobody reads more, and each costs time: a hostile file can hold a mistake in every byte."""


@dataclass(frozen=True, order=True)
class Problem:
    file: str
    line: int
    column: int
    wrong: str
    right: str

    def __str__(self) -> str:
        """Print as `file:line:col: what is wrong; what would be right`."""
        return f"{file_name(self.file)}:{self.line}:{self.column}: {self.wrong}; {self.right}"


class Refused(Exception):  # noqa: N818  (bad input is no error of the program)
    """What is wrong with the words of the command line, or with what they name; a command then ends with status 2."""


class MapError(Refused):
    """A map that cannot be used; `problems` holds every mistake found, in file order."""

    def __init__(self, problems: list[Problem]) -> None:
        """Sort the problems and drop exact repetitions."""
        self.problems = tuple(sorted(set(problems)))
        super().__init__("\n".join(map(str, self.problems)))


@dataclass
class Report:
    """Collects the problems of one file while it is read and checked."""

    file: str
    problems: list[Problem] = field(default_factory=list)
    partial: bool = False
    """Set when a part of the file could not be read: what seems to be missing may be in that part."""

    def add(self, place: Place, wrong: str, right: str) -> None:
        """Note a mistake at a 1-based line and column. Raises MapError when there are more than anyone reads."""
        if isinstance(place, Taken):
            wrong = f"taken over from {place.file}:{place.there[0]}:{place.there[1]}: {wrong}"
        self.problems.append(Problem(self.file, place[0], place[1], wrong, right))
        if len(self.problems) >= MAX_PROBLEMS:
            wrong = f"more than {MAX_PROBLEMS} mistakes, of which the first are shown"
            line = max(self.problems).line + 1  # so that it comes after all others
            self.problems.append(Problem(self.file, line, 1, wrong, "correct these and check again"))
            self.raise_if_any()

    def miss(self, place: Place, wrong: str, right: str) -> None:
        """Note that something is missing, unless it may be in a part of the file that could not be read."""
        if not self.partial:
            kept = isinstance(place, Taken) and place.without
            more = f", unless what `without` leaves out in line {kept[0]} is to stay" if kept else ""
            self.add(place, wrong, right + more)

    def raise_if_any(self) -> None:
        """Raise MapError with all that was noted; do nothing when all is well."""
        if self.problems:
            raise MapError(self.problems)
