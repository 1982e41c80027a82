"""Random programs that are Structured Text in form. Most fit in their types, too, and run; wild ones fit nowhere."""

from __future__ import annotations

import random
from collections.abc import Callable

from structured_text.language.standard import BLOCKS, FUNCTIONS, Signature
from structured_text.language.types import ELEMENTARY, Kind

LITERALS = {
    "BOOL": ["TRUE", "FALSE", "BOOL#1", "0", "1"],
    "INT": ["0", "7", "-3", "INT#5", "16#FF", "32767"],
    "UINT": ["0", "9", "UINT#60000", "2#1010"],
    "DINT": ["0", "DINT#70000", "-1", "2147483647"],
    "USINT": ["0", "255", "USINT#16#FE"],
    "BYTE": ["BYTE#16#FF", "BYTE#1", "16#0F"],
    "WORD": ["WORD#16#00FF", "WORD#0", "2", "16#FFFF"],
    "DWORD": ["DWORD#16#FFFFFFFF", "8#17"],
    "REAL": ["0.0", "1.5", "-2.5E3", "REAL#3.0", "1.0E-30", "3.4E38"],
    "LREAL": ["LREAL#0.1", "1.0E300", "0.5"],
    "TIME": ["T#0s", "T#1d2h3m4s5.5ms", "TIME#-1s"],
    "STRING": ["''", "'ab'", "'$C4$27$'x'"],
    "E_Colour": ["red", "E_Colour#green", "E_Colour.blue"],
}
WILD = [
    "32768",
    "256",
    "1E-30",
    "3.5E38",
    "T#1us",
    "'é'",
    "STRING#'a'",
    '"w"',
    "D#2020-01-01",
    "SQRT(2)",
    "row",
    "pair",
]
KINDS = list(LITERALS)
NUMBERS = [kind for kind in KINDS if kind in ELEMENTARY and kind != "TIME"]
NAMES = ["a", "__a", "_b", "c_", "s", "t1", "self", "None", "run", "globals_", "Count", "int32", "x_y", "_", "名"]
TYPES = """TYPE E_Colour : (red, green, blue); END_TYPE
TYPE T_Row : ARRAY[-1..3] OF INT; END_TYPE
TYPE T_Pair : STRUCT __f : INT; Row : T_Row; Text : STRING; END_STRUCT; END_TYPE
TYPE T_Small : INT(-5..5) := 1; END_TYPE
FUNCTION Twice : INT VAR_INPUT i : INT; END_VAR VAR_IN_OUT j : INT; END_VAR Twice := i + j; j := i; END_FUNCTION
FUNCTION_BLOCK Inner VAR_INPUT i : INT; x : BOOL; END_VAR VAR_OUTPUT o : INT; END_VAR VAR_IN_OUT r : T_Row; END_VAR
VAR_TEMP t : INT; END_VAR VAR k : WORD; END_VAR t := i; o := t; r[0] := o; END_FUNCTION_BLOCK
"""


class Program:
    """One program, drawn from a stream of random numbers; `wild` is how often something stands where it may not."""

    def __init__(self, source: random.Random, wild: float) -> None:
        """Draw the names first."""
        self.draw, self.wild = source, wild
        names = [f"{name}{number or ''}" for number in range(2) for name in NAMES]
        source.shuffle(names)
        self.variables = {kind: [names.pop(), names.pop()] for kind in KINDS}
        self.word = source.choice(["FUNCTION_BLOCK", "PROGRAM", "FUNCTION"])
        self.loops = 0

    def text(self) -> str:
        """The whole source."""
        function = self.word == "FUNCTION"
        declared = "".join(map(self.declaration, KINDS))
        more = "VAR row : T_Row; pair : T_Pair; pairs : ARRAY[0..1, 2..3] OF T_Pair; small : T_Small; END_VAR\n"
        blocks = "".join(f"{name.lower()}_1 : {name}; " for name in self.draw.sample(sorted(BLOCKS), 3))
        instances = f"VAR inner1 : Inner; timer : TON; {blocks}END_VAR\n" * (not function)
        head = f"{self.word} Example{' : INT' * function}\n{declared}{more}{instances}{'Example := 0;' * function}"
        return f"{TYPES}{head}\n{self.statements(3)}END_{self.word}\n"

    def declaration(self, kind: str) -> str:
        """Variables of one type."""
        sections = ["VAR", "VAR", "VAR", "VAR_INPUT", "VAR_OUTPUT", "VAR_TEMP", "VAR CONSTANT", "VAR_IN_OUT"]
        section = self.draw.choice(sections if self.strays() else sections[: 5 if self.word == "FUNCTION" else 6])
        start = f" := {self.literal(kind)}" if self.draw.random() < 0.2 else ""
        return f"{section} {', '.join(self.variables[kind])} : {kind}{start}; END_VAR\n"

    def strays(self) -> bool:
        """Whether something stands here that may not."""
        return self.draw.random() < self.wild

    # ------------------------------------------------------------ statements

    def statements(self, depth: int) -> str:
        """Some statements."""
        compound: list[Callable[[int], str]] = [self.choice, self.case, self.loop]
        simple = [self.assignment, self.assignment, self.call, self.jump]
        made = ""
        for _ in range(self.draw.randrange(1, 4)):
            deep = depth and self.draw.random() < 0.5
            made += f"{self.draw.choice(compound)(depth - 1) if deep else self.draw.choice(simple)()};\n"
        return made

    def assignment(self) -> str:
        """An assignment of any type."""
        kind = self.draw.choice(KINDS)
        return f"{self.place(kind)} := {self.expression(kind, 3)}"

    def jump(self) -> str:
        """What ends a loop or the program; rarely, since nothing after it runs."""
        words = ["EXIT", "CONTINUE", "RETURN"] if self.loops or self.strays() else ["RETURN"]
        return self.draw.choice(words) if self.draw.random() < 0.3 else self.assignment()

    def call(self) -> str:
        """A call of a function or block."""
        if self.word == "FUNCTION" or self.draw.random() < 0.3:
            return f"{self.place('INT')} := Twice({self.expression('INT', 1)}, {self.place('INT')})"
        if self.draw.random() < 0.5:
            return f"timer(IN := {self.expression('BOOL', 2)}, PT := {self.expression('TIME', 1)})"
        given = [f"i := {self.expression('INT', 2)}", f"o => {self.place('INT')}", *["t := 1"] * self.strays()]
        return f"inner1({', '.join([*self.draw.sample(given, self.draw.randrange(1, len(given) + 1)), 'r := row'])})"

    def choice(self, depth: int) -> str:
        """IF, sometimes with a long chain of ELSIF."""
        many = self.draw.choice([0, 1, 40])
        more = "".join(f"ELSIF {self.expression('BOOL', 1)} THEN {self.assignment()}; " for _ in range(many))
        other = f"ELSE {self.statements(depth)}" if self.draw.random() < 0.5 else ""
        return f"IF {self.expression('BOOL', 2)} THEN {self.statements(depth)}{more}{other}END_IF"

    def case(self, depth: int) -> str:
        """CASE, sometimes with many branches."""
        starts = range(0, self.draw.choice([8, 160]), 4)
        labels = [f"{each}" if self.draw.random() < 0.7 else f"{each}..{each + 3}" for each in starts]
        branches = "".join(f"{label}: {self.assignment()}; " for label in labels)
        kind = self.draw.choice(KINDS if self.strays() else ["INT", "UINT"])
        return f"CASE {self.expression(kind, 2)} OF {branches}ELSE {self.statements(depth)}END_CASE"

    def loop(self, depth: int) -> str:
        """WHILE, REPEAT or FOR."""
        self.loops += 1
        body, test = self.statements(depth), self.expression("BOOL", 2)
        self.loops -= 1
        step = f" BY {self.literal('INT')}" if self.draw.random() < 0.3 else ""
        head = f"{self.variables['INT'][0]} := {self.expression('INT', 1)} TO {self.expression('INT', 1)}{step}"
        forms = [f"WHILE {test} DO {body}END_WHILE", f"REPEAT {body}UNTIL {test} END_REPEAT"]
        return self.draw.choice([*forms, f"FOR {head} DO {body}END_FOR"])

    # ------------------------------------------------------------ expressions

    def expression(self, kind: str, depth: int) -> str:
        """An expression of a type."""
        if self.strays():
            kind = self.draw.choice(KINDS)
        if depth == 0 or self.draw.random() < 0.3:
            return self.place(kind) if self.draw.random() < 0.5 else self.literal(kind)
        makers = [self.operation, self.operation, self.function, self.conversion, self.sign]
        return self.draw.choice(makers)(kind, depth - 1)

    def literal(self, kind: str) -> str:
        """A literal, or what is wild."""
        return self.draw.choice(WILD if self.strays() else LITERALS[kind])

    def place(self, kind: str) -> str:
        """A variable, field or element."""
        index = self.variables["INT"][1]
        places = ["row[0]", f"row[{index}]", "pair.__f", "pair.Row[1]", f"pairs[{index}, 2].__f", "small"]
        if kind == "INT" and self.draw.random() < 0.4:
            return self.draw.choice([*places, *["inner1.t", "row[9]", "timer.Q"] * self.strays()])
        return self.draw.choice(self.variables[kind])

    def operation(self, kind: str, depth: int) -> str:
        """Two operands and an operator."""
        operand = self.draw.choice(NUMBERS) if kind == "BOOL" and self.draw.random() < 0.7 else kind
        left, right = self.expression(operand, depth), self.expression(operand, depth)
        group = _kind(operand)
        fits = {
            Kind.BITS: ["AND", "OR", "XOR", "&"],
            Kind.INTEGER: ["+", "-", "*", "/", "MOD"],
            Kind.REAL: ["+", "-", "*", "/", "**"],
            Kind.BOOL: ["AND", "OR", "XOR"],
            Kind.TIME: ["+", "-"],
        }.get(group, [])
        if kind == "BOOL" and operand != kind:
            fits = ["=", "<>", "<", ">", "<=", ">="]
        every = ["+", "-", "*", "/", "MOD", "**", "AND", "&", "OR", "XOR", "=", "<>", "<", ">", "<=", ">="]
        operators = every if self.strays() else fits
        return f"({left} {self.draw.choice(operators)} {right})" if operators else left

    def sign(self, kind: str, depth: int) -> str:
        """A sign or NOT."""
        fits = {Kind.BITS: "NOT ", Kind.BOOL: "NOT ", Kind.REAL: "-"}.get(_kind(kind), "")
        word = self.draw.choice(["NOT ", "-", "+"]) if self.strays() else "-" if kind in ("INT", "DINT") else fits
        return f"{word}({self.expression(kind, depth)})"

    def function(self, kind: str, depth: int) -> str:
        """A standard function, operators in the form of a call among them."""
        fitting = [name for name, each in FUNCTIONS.items() if each.result == "T" and _kind(kind) in each.group]
        name = self.draw.choice(list(FUNCTIONS) if self.strays() or not fitting else fitting)
        given = [f"{formal} := {value}" for formal, value in self.arguments(FUNCTIONS[name], kind, depth)]
        if name == "NOT" or self.draw.random() < 0.7:
            given = [each.split(" := ", 1)[1] for each in given]
        return f"{name}({', '.join(given[: 1 if self.strays() else None])})"

    def arguments(self, signature: Signature, kind: str, depth: int) -> list[tuple[str, str]]:
        """The arguments of a standard function by their formal names."""
        formals = list(signature.formals)
        if signature.extensible and self.draw.random() < 0.3:
            last, wanted = formals[-1]
            formals.append((f"IN{int(last[2:]) + 1}", wanted))
        kinds = [
            kind if wanted == "T" else "INT" if isinstance(wanted, frozenset) else str(wanted) for _, wanted in formals
        ]
        return [
            (formal, self.expression(each if each in LITERALS else "TIME", depth))
            for (formal, _), each in zip(formals, kinds, strict=True)
        ]

    def conversion(self, kind: str, depth: int) -> str:
        """A conversion from another type."""
        if kind not in NUMBERS and not self.strays():
            return self.expression(kind, depth)
        source = self.draw.choice(NUMBERS)
        return f"{source}_TO_{kind}({self.expression(source, depth)})"


def _kind(name: str) -> Kind:
    """The kind of a type; that of enumerations and strings has no operators."""
    if name == "STRING":
        return Kind.STRING
    return ELEMENTARY[name].kind if name in ELEMENTARY else Kind.ENUM
