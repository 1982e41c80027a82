"""What ST declares that iec2c's C no longer has: array bounds, sections of variables, defaults, spelling, order.

Only declarations are read, and only text that iec2c has accepted; so this works also for ST that our own front end
does not know, and both engines stay independent of each other.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Named:
    """A type by its upper-case name."""

    name: str


@dataclass(frozen=True)
class ArrayOf:
    """An array with (low, high) of each dimension."""

    bounds: tuple[tuple[int, int], ...]
    element: "Spec"


@dataclass(frozen=True)
class Record:
    fields: dict[str, "Spec"]


Spec = Named | ArrayOf | Record


@dataclass(frozen=True)
class Variable:
    """A declared variable: its section (`VAR_INPUT`, `VAR_TEMP` ...), type, and initial value as written."""

    section: str
    spec: Spec
    initial: str | None


@dataclass
class Unit:
    """A function, function block, program or configuration: name and 1-based line, variables by upper-case name."""

    kind: str
    name: str
    line: int = 0
    variables: dict[str, Variable] = field(default_factory=dict)


@dataclass
class Declarations:
    """Everything declared, by upper-case name in source order."""

    types: dict[str, Spec] = field(default_factory=dict)
    units: dict[str, Unit] = field(default_factory=dict)
    defaults: dict[str, str] = field(default_factory=dict)

    def resolve(self, spec: Spec | None) -> Spec | None:
        """Follow names of declared types to what they mean; an elementary or block name stays."""
        seen = set()
        while isinstance(spec, Named) and spec.name in self.types and spec.name not in seen:
            seen.add(spec.name)
            spec = self.types[spec.name]
        return spec

    def initial(self, variable: Variable) -> str | None:
        """The initial value as written: the variable's own, else that of the nearest type by name that has one."""
        found, spec = variable.initial, variable.spec
        seen = set()
        while found is None and isinstance(spec, Named) and spec.name in self.types and spec.name not in seen:
            seen.add(spec.name)
            found, spec = self.defaults.get(spec.name), self.types[spec.name]
        return found


_TOKEN = re.compile(
    r"""\(\*.*?\*\) | \{.*?\} | \s+
    | (?P<token> '(?:\$.|[^'$])*' | "(?:\$.|[^"$])*" | %[\w.*]+ | \w[\w\#]* | := | \.\. | .)""",
    re.DOTALL | re.VERBOSE,
)
_SUBRANGE = re.compile(r"\w+\((?P<low>.+?)\.\.")
_UNITS = ("FUNCTION", "FUNCTION_BLOCK", "PROGRAM", "CONFIGURATION")
_SECTIONS = frozenset(
    ("VAR", "VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT", "VAR_TEMP", "VAR_EXTERNAL", "VAR_GLOBAL", "VAR_ACCESS")
)
_QUALIFIERS = frozenset(("CONSTANT", "RETAIN", "NON_RETAIN", "PERSISTENT", "R_EDGE", "F_EDGE"))


def read_declarations(text: str) -> Declarations:
    """Read the declarations of ST that iec2c has accepted."""
    return _Reader(text).read()


class _Reader:
    """Goes through the tokens once; `_at` is the next one."""

    def __init__(self, text: str) -> None:
        matches = [match for match in _TOKEN.finditer(text) if match["token"]]
        self._text = text
        self._tokens = [match["token"] for match in matches]
        self._starts = [match.start() for match in matches]
        self._tokens.append("")
        self._at = 0
        self._found = Declarations()

    def read(self) -> Declarations:
        while word := self._word():
            if word == "TYPE":
                self._types()
            elif word in _UNITS:
                self._unit(word)
        return self._found

    def _peek(self) -> str:
        return self._tokens[self._at].upper()

    def _raw(self) -> str:
        token = self._tokens[self._at]
        self._at = min(self._at + 1, len(self._tokens) - 1)
        return token

    def _word(self) -> str:
        return self._raw().upper()

    def _skip(self, *ends: str) -> list[str]:
        """Pass tokens up to one of `ends` outside brackets, which stays next; give them back."""
        passed: list[str] = []
        depth = 0
        while self._peek() and not (depth <= 0 and self._peek() in ends):
            depth += {"(": 1, "[": 1, ")": -1, "]": -1}.get(self._peek(), 0)
            passed.append(self._raw())
        return passed

    def _types(self) -> None:
        while self._peek() not in ("END_TYPE", ""):
            name = self._word()
            self._word()  # the colon
            start = self._at
            self._found.types[name] = self._spec()
            lowest = _SUBRANGE.match("".join(self._tokens[start : self._at]))
            initial = self._initial() or (lowest and lowest["low"])
            if initial is not None:
                self._found.defaults[name] = initial

    def _unit(self, kind: str) -> None:
        line = self._text.count("\n", 0, self._starts[self._at]) + 1 if self._at < len(self._starts) else 0
        unit = Unit(kind, self._raw(), line)
        self._found.units[unit.name.upper()] = unit
        end = f"END_{kind}"
        while (word := self._word()) not in (end, ""):
            if word in _SECTIONS:
                self._section(unit, word)

    def _section(self, unit: Unit, section: str) -> None:
        while self._peek() in _QUALIFIERS:
            section += f" {self._word()}"
        while self._peek() not in ("END_VAR", ""):
            names = list(self._names())
            spec = self._spec()
            variable = Variable(section, spec, self._initial())
            unit.variables.update(dict.fromkeys(names, variable))

    def _names(self) -> Iterator[str]:
        """`a, b AT %IX0.0 :` - the words before the colon that are names."""
        while (word := self._word()) not in (":", ""):
            if word == "AT":
                self._word()
            elif word != ",":
                yield word

    def _initial(self) -> str | None:
        while self._peek() in _QUALIFIERS:
            self._word()
        initial = None
        if self._peek() == ":=":
            self._word()
            initial = "".join(self._skip(";"))
        self._skip(";")
        self._word()
        return initial

    def _spec(self) -> Spec:
        word = self._word()
        if word == "ARRAY":
            return self._array()
        if word == "STRUCT":
            return self._record()
        if word == "(":  # an enumeration
            self._at -= 1
            self._skip(":=", ";")
        elif self._peek() in ("(", "["):  # a subrange, or the length of a string
            self._skip(":=", ";", "END_VAR")
        return Named(word)

    def _array(self) -> ArrayOf:
        bounds = []
        self._word()  # the opening bracket
        while self._peek() not in ("OF", ""):
            low = integer("".join(self._skip("..")))
            self._word()
            high = integer("".join(self._skip(",", "]")))
            self._word()
            bounds.append((low, high))
        self._word()
        return ArrayOf(tuple(bounds), self._spec())

    def _record(self) -> Record:
        fields: dict[str, Spec] = {}
        while self._peek() not in ("END_STRUCT", ""):
            names = list(self._names())
            spec = self._spec()
            self._initial()
            fields.update(dict.fromkeys(names, spec))
        self._word()
        return Record(fields)


def integer(text: str) -> int:
    """The value of an integer literal: `-5`, `16#FF`, `UINT#1_000`. Raises ValueError."""
    sign = -1 if text.startswith("-") else 1
    parts = text.lstrip("+-").replace("_", "").split("#")
    base = int(parts[-2]) if len(parts) > 1 and parts[-2].isdigit() else 10
    return sign * int(parts[-1], base)
