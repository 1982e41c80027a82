"""What is given to a block or a function and what it answers, record by record, and the C that does it."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Scan:
    """Pins of a block, each as a path: `Length`, `Adu`, `Adu[3]`, `Request.Quantity`.

    A record holds `given`, an answer `answered`; before each scan, in-outs named in `filled` get again what the head
    of the input holds. An answer such as `Words[:WordCount]` is the whole array, with 0 after the first WordCount.
    """

    block: str
    given: tuple[str, ...]
    answered: tuple[str, ...]
    filled: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        """The name by which the driver knows it."""
        return self.block

    @property
    def c_function(self) -> str:
        """The function of the driver that makes this scan."""
        kinds = [f"    __typeof__({_place(path)}) filled_{at};" for at, path in enumerate(self.filled)]
        takes = [f"    TAKE(filled_{at});" for at in range(len(self.filled))]
        fills = [f"        {_place(path)} = filled_{at};" for at, path in enumerate(self.filled)]
        given = [f"        TAKE({_place(path)});" for path in self.given]
        answers = [f"        {_give(path)};" for path in self.answered]
        kind = self.block.upper()
        start = [f"    static {kind} x;", *kinds, f"    START({kind}, x);", *takes, "    while (more()) {"]
        body = [*start, *fills, *given, f"        {kind}_body__(&x);", *answers, "    }"]
        return "\n".join([f"static void scan_{self.block}(void)", "{", *body, "}", ""])


def _place(path: str) -> str:
    """A pin as iec2c declares it: an array's elements are in `table`, a structure's fields have no `value`."""
    name, _, rest = path.replace("]", "").partition("[")
    if rest:
        return f"x.{name.upper()}.value.table[{rest}]"
    name, _, field = path.partition(".")
    return f"x.{name.upper()}.value" + (f".{field.upper()}" if field else "")


def _give(path: str) -> str:
    """The statement that writes a pin to the answer."""
    name, _, count = path.rstrip("]").partition("[:")
    return f"GIVE_FIRST({_place(name)}.table, {_place(count)})" if count else f"GIVE({_place(path)})"


@dataclass(frozen=True)
class Call:
    """A function of words or bytes, each in 16 bits of a record; the answer is its result, a text in 128 bytes."""

    function: str
    arguments: int = 1
    text: bool = False

    @property
    def name(self) -> str:
        """The name by which the driver knows it."""
        return self.function

    @property
    def c_function(self) -> str:
        """The function of the driver that makes these calls."""
        given = ", ".join(f"given[{at}]" for at in range(self.arguments))
        call = f"{self.function.upper()}(1, NULL, {given})"
        answer = f"give_text({call});" if self.text else f"__typeof__({call}) answer = {call};\n        GIVE(answer);"
        loop = ["    while (more()) {", "        TAKE(given);", f"        {answer}", "    }"]
        head = [f"static void scan_{self.function}(void)", "{", f"    uint16_t given[{self.arguments}];"]
        return "\n".join([*head, *loop, "}", ""])


AnyScan = Scan | Call


def table(scans: tuple[AnyScan, ...]) -> str:
    """The functions of the scans and the table that the driver looks them up in."""
    rows = [f'    {{"{scan.name}", scan_{scan.name}}},' for scan in scans]
    functions = [scan.c_function for scan in scans]
    return "\n".join([*functions, "static const Scanning SCANNING[] = {", *rows, "    {NULL, NULL},", "};", ""])
