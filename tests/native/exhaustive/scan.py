"""What is given to a block or a function and what it answers, record by record, and the C that does it."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Scan:
    """Pins of a block; a record holds `given`, an answer `answered`."""

    block: str
    given: tuple[str, ...]
    answered: tuple[str, ...]

    @property
    def name(self) -> str:
        """The name by which the driver knows it."""
        return self.block

    @property
    def c_function(self) -> str:
        """The function of the driver that makes this scan."""
        kind = self.block.upper()
        given = [f"        TAKE(x.{pin.upper()}.value);" for pin in self.given]
        answers = [f"        GIVE(x.{pin.upper()}.value);" for pin in self.answered]
        start = [f"    static {kind} x;", f"    START({kind}, x);", "    while (more()) {"]
        body = [*start, *given, f"        {kind}_body__(&x);", *answers, "    }"]
        return "\n".join([f"static void scan_{self.block}(void)", "{", *body, "}", ""])


@dataclass(frozen=True)
class Call:
    """A function of a word, in 16 bits of a record; the answer is its result."""

    function: str

    @property
    def name(self) -> str:
        """The name by which the driver knows it."""
        return self.function

    @property
    def c_function(self) -> str:
        """The function of the driver that makes these calls."""
        call = f"{self.function.upper()}(1, NULL, given[0])"
        loop = ["    while (more()) {", "        TAKE(given);", f"        __typeof__({call}) answer = {call};"]
        head = [f"static void scan_{self.function}(void)", "{", "    uint16_t given[1];"]
        return "\n".join([*head, *loop, "        GIVE(answer);", "    }", "}", ""])


AnyScan = Scan | Call


def table(scans: tuple[AnyScan, ...]) -> str:
    """The functions of the scans and the table that the driver looks them up in."""
    rows = [f'    {{"{scan.name}", scan_{scan.name}}},' for scan in scans]
    functions = [scan.c_function for scan in scans]
    return "\n".join([*functions, "static const Scanning SCANNING[] = {", *rows, "    {NULL, NULL},", "};", ""])
