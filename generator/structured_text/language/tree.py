"""The tree of a Structured Text source: what the parser builds, the checker completes, and everybody else reads.

Declarations make types and types know their declarations, so both are here; `types` has those that need no source.

Positions: `at` is the offset of the node's first character in `Unit.text`, `end` (declarations and statements) the
offset after its last. `unit.place(node.at)` gives the 1-based (line, column), `unit.line(node.at)` the line alone.

Names are kept as written; every table (`symbols`, `fields` ...) is keyed in upper case, since ST ignores case.

Slots that the checker fills carry a neutral default until then: `Expression.type` is `types.UNKNOWN`, `symbol` and
`target` are None. After `check` without errors every expression has its concrete type, untyped literals included.

Values of literals: BOOL bool; integers and bit strings int; REAL/LREAL float; STRING bytes, WSTRING str; TIME and
TIME_OF_DAY int nanoseconds; DATE and DATE_AND_TIME int nanoseconds since 1970-01-01.
"""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass, field
from enum import Enum as PythonEnum

from structured_text.language.problems import Problem
from structured_text.language.types import ENUM_BITS, UNKNOWN, Elementary, Type

LiteralValue = bool | int | float | bytes | str


@dataclass(slots=True, eq=False)
class Comment:
    """A comment or pragma. `text` is what is between its marks, stripped; `style` is `(*`, `//`, `/*` or `{`.

    `own_line` if nothing but white space comes before it on its line.
    """

    at: int
    end: int
    text: str
    style: str
    own_line: bool


@dataclass(slots=True, eq=False)
class Node:
    """Anything with a position."""

    at: int


# ---------------------------------------------------------------- expressions


@dataclass(slots=True, eq=False)
class Expression(Node):
    """An expression. `type` is set by the checker; `parentheses` counts the pairs written around it."""

    type: Type = field(default=UNKNOWN, init=False)
    parentheses: int = field(default=0, init=False)


class LiteralKind(PythonEnum):
    """How a literal is written."""

    BOOL = "bool"
    INTEGER = "integer"
    REAL = "real"
    STRING = "string"
    WSTRING = "wstring"
    TIME = "time"
    DATE = "date"
    TIME_OF_DAY = "time of day"
    DATE_AND_TIME = "date and time"


@dataclass(slots=True, eq=False)
class Literal(Expression):
    """`WORD#16#A001`: text as written, kind, value, `prefix` upper case or None, `base` 2 8 10 16."""

    text: str
    kind: LiteralKind
    value: LiteralValue
    prefix: str | None = None
    base: int = 10


@dataclass(slots=True, eq=False)
class Name(Expression):
    """An identifier. `symbol`: the variable (a function's own name: its RESULT variable) or the enumerated value."""

    name: str
    symbol: VarDecl | EnumValue | None = field(default=None, init=False)


@dataclass(slots=True, eq=False)
class Qualified(Expression):
    """`E_STATE#IDLE`."""

    type_name: str
    name: str
    symbol: EnumValue | None = field(default=None, init=False)


@dataclass(slots=True, eq=False)
class Member(Expression):
    """`base.name`: a field of a structure, or a variable of an instance (parameter, or a block's own variable).

    `symbol` is a `Field`, a `Parameter` (standard blocks) or a `VarDecl` (blocks in ST);
    an `EnumValue` for the third edition's `E_STATE.IDLE`.
    """

    base: Expression
    name: str
    symbol: Field | Parameter | VarDecl | EnumValue | None = field(default=None, init=False)


@dataclass(slots=True, eq=False)
class Index(Expression):
    """`base[i, j]`."""

    base: Expression
    indices: list[Expression]


@dataclass(slots=True, eq=False)
class BitAccess(Expression):
    """`w.3`, `w.%X3`, `d.%B1`: not in the second edition; `unit` is X B W or D, X for the bare form."""

    base: Expression
    number: int
    unit: str


@dataclass(slots=True, eq=False)
class Dereference(Expression):
    """`p^`: not in the second edition."""

    base: Expression


@dataclass(slots=True, eq=False)
class Direct(Expression):
    """A directly represented variable, `%IX0.0`; `text` as written."""

    text: str


@dataclass(slots=True, eq=False)
class Unary(Expression):
    """`-x`, `+x` or `NOT x`; `op` upper case. `open` as in Call."""

    op: str
    operand: Expression
    open: int = field(default=0, init=False)


@dataclass(slots=True, eq=False)
class Binary(Expression):
    """Two operands. `op`: OR XOR AND (also for `&`) = <> < > <= >= + - * / MOD **.

    Both operands have the same type afterwards, except for `**` and for TIME with a number.
    `operand_type` is the type in which the operation is done (of a comparison: that of its operands).
    `open` as in Call.
    """

    op: str
    left: Expression
    right: Expression
    operand_type: Type = field(default=UNKNOWN, init=False)
    open: int = field(default=0, init=False)


@dataclass(slots=True, eq=False)
class Argument(Node):
    """`name := value`, `name => value` (`output`), `NOT name => value` (`negated`), or positional (`name` None).

    `value` is None for `name :=` or `name =>` with nothing after it.
    """

    name: str | None
    value: Expression | None
    output: bool = False
    negated: bool = False


@dataclass(slots=True, eq=False)
class Binding:
    """A formal parameter with what the call gives it; `value` None: not given (default or left alone)."""

    parameter: Parameter
    value: Expression | None
    negated: bool = False


@dataclass(slots=True, eq=False)
class Call(Expression):
    """A call of a function (`target` Function or Builtin) or block instance (`target` Block, `callee` the instance).

    `bindings` lists every formal parameter in the order of declaration, EN and ENO apart; only parameters of a block
    that the call does not mention have value None and keep what they had; of a function they take their default.
    `en`, `eno`: what the implicit parameters are bound to. `type` is the function's result, VOID for a block.
    The `callee` of a function is its bare Name, which has neither type nor symbol; that of a block is the instance.
    `open` is not 0 where nothing says which type an overloaded function gives, as in `LEN(s) < 5`, and the checker
    chose one: how many bits a positive number has in the least type that compilers choose.
    """

    callee: Expression
    arguments: list[Argument]
    target: Function | Builtin | Block | None = field(default=None, init=False)
    bindings: list[Binding] = field(default_factory=list, init=False)
    en: Expression | None = field(default=None, init=False)
    eno: Expression | None = field(default=None, init=False)
    open: int = field(default=0, init=False)


@dataclass(slots=True, eq=False)
class Repeat(Expression):
    """`count(value)` in an array initialiser; `count()` has value None: the element type's initial value."""

    count: Expression
    value: Expression | None


@dataclass(slots=True, eq=False)
class ArrayInitial(Expression):
    """`[a, 3(b), c]`; row-major over all dimensions, elements left out keep the type's initial value."""

    items: list[Expression]


@dataclass(slots=True, eq=False)
class StructInitial(Expression):
    """`(a := 1, b := 2)` for a structure or a block instance; fields left out keep their own initial value."""

    items: list[Argument]


# ---------------------------------------------------------------- statements


@dataclass(slots=True, eq=False)
class Statement(Node):
    """A statement. `leading`: comments on lines of their own before it; `trailing`: the one after it on its line."""

    end: int = field(default=0, init=False)
    leading: tuple[Comment, ...] = field(default=(), init=False)
    trailing: Comment | None = field(default=None, init=False)


@dataclass(slots=True, eq=False)
class Assign(Statement):
    """`target := value`; `op` is `:=`, or `S=`, `R=`, `REF=` of other dialects."""

    target: Expression
    value: Expression
    op: str = ":="


@dataclass(slots=True, eq=False)
class CallStatement(Statement):
    """An invocation of a block instance, or a function call whose result is dropped (not in the second edition)."""

    call: Call


@dataclass(slots=True, eq=False)
class Branch(Node):
    """IF or ELSIF with its statements."""

    condition: Expression
    body: list[Statement]


@dataclass(slots=True, eq=False)
class If(Statement):
    """`branches` holds IF and every ELSIF; `otherwise` is None without ELSE."""

    branches: list[Branch]
    otherwise: list[Statement] | None


@dataclass(slots=True, eq=False)
class LabelRange(Node):
    """`3..7` as a label of CASE."""

    low: Expression
    high: Expression


@dataclass(slots=True, eq=False)
class CaseBranch(Node):
    """Labels and statements. Single labels are expressions (an integer literal, `-3`, an enumerated value)."""

    labels: list[Expression | LabelRange]
    body: list[Statement]
    leading: tuple[Comment, ...] = field(default=(), init=False)
    trailing: Comment | None = field(default=None, init=False)


@dataclass(slots=True, eq=False)
class Case(Statement):
    """`otherwise` is None without ELSE."""

    selector: Expression
    branches: list[CaseBranch]
    otherwise: list[Statement] | None


@dataclass(slots=True, eq=False)
class For(Statement):
    """`step` is None without BY."""

    variable: Expression
    start: Expression
    stop: Expression
    step: Expression | None
    body: list[Statement]


@dataclass(slots=True, eq=False)
class While(Statement):
    """WHILE condition DO body END_WHILE."""

    condition: Expression
    body: list[Statement]


@dataclass(slots=True, eq=False)
class RepeatUntil(Statement):
    """REPEAT body UNTIL condition END_REPEAT."""

    body: list[Statement]
    condition: Expression


@dataclass(slots=True, eq=False)
class Exit(Statement):
    """EXIT."""


@dataclass(slots=True, eq=False)
class Continue(Statement):
    """CONTINUE: not in the second edition."""


@dataclass(slots=True, eq=False)
class Return(Statement):
    """RETURN; `value` only in dialects that allow one."""

    value: Expression | None = None


@dataclass(slots=True, eq=False)
class Empty(Statement):
    """A lone `;`."""


# ---------------------------------------------------------------- type specifications


@dataclass(slots=True, eq=False)
class Spec(Node):
    """What follows the colon of a declaration; `type` is set by the checker.

    So is `start`: the initial value that the named TYPE declares, None if it is the one that `type` itself has.
    """

    type: Type = field(default=UNKNOWN, init=False)
    start: Expression | None = field(default=None, init=False)


@dataclass(slots=True, eq=False)
class NamedSpec(Spec):
    """The name of an elementary type, a declared type or a function block."""

    name: str


@dataclass(slots=True, eq=False)
class StringSpec(Spec):
    """`STRING`, `STRING[20]`, `STRING(20)`."""

    wide: bool
    length: Expression | None


@dataclass(slots=True, eq=False)
class Range(Node):
    """`low..high`."""

    low: Expression
    high: Expression


@dataclass(slots=True, eq=False)
class ArraySpec(Spec):
    """`ARRAY[0..9, 1..2] OF element`; a range is None for `*`."""

    ranges: list[Range | None]
    element: Spec


@dataclass(slots=True, eq=False)
class StructSpec(Spec):
    """`STRUCT ... END_STRUCT`; fields are declarations of kind FIELD."""

    fields: list[VarDecl]


@dataclass(slots=True, eq=False)
class EnumItem(Node):
    """A value of an enumeration; `value` if a number was written (not in the second edition)."""

    name: str
    value: Expression | None
    leading: tuple[Comment, ...] = field(default=(), init=False)
    trailing: Comment | None = field(default=None, init=False)


@dataclass(slots=True, eq=False)
class EnumSpec(Spec):
    """`(A, B, C)`, with `base` where one was written."""

    items: list[EnumItem]
    base: str | None = None


@dataclass(slots=True, eq=False)
class SubrangeSpec(Spec):
    """`INT(0..9)`."""

    base: str
    range: Range


@dataclass(slots=True, eq=False)
class PointerSpec(Spec):
    """`POINTER TO x`, `REF_TO x`, `REFERENCE TO x`; `word` is POINTER, REF_TO or REFERENCE."""

    word: str
    target: Spec


# ---------------------------------------------------------------- declarations


class VarKind(PythonEnum):
    """Where a variable is declared; RESULT is the function's own name as a variable, FIELD a structure's field."""

    LOCAL = "VAR"
    INPUT = "VAR_INPUT"
    OUTPUT = "VAR_OUTPUT"
    IN_OUT = "VAR_IN_OUT"
    TEMP = "VAR_TEMP"
    EXTERNAL = "VAR_EXTERNAL"
    GLOBAL = "VAR_GLOBAL"
    ACCESS = "VAR_ACCESS"
    CONFIG = "VAR_CONFIG"
    STAT = "VAR_STAT"
    INSTANCE = "VAR_INST"
    FIELD = "STRUCT"
    RESULT = "FUNCTION"


@dataclass(slots=True, eq=False)
class VarDecl(Node):
    """One name of a declaration: `a, b : INT := 1;` makes two that share `spec` and `initial`.

    `grouped` if it shares them with the name before it. `address` is the text after AT. `edge` is R_EDGE, F_EDGE or
    empty. `target` of an EXTERNAL is the global that it means. `path` is the left side of a VAR_CONFIG or VAR_ACCESS.
    """

    end: int
    name: str
    kind: VarKind
    spec: Spec
    initial: Expression | None
    address: str | None = None
    constant: bool = False
    retain: bool = False
    edge: str = ""
    grouped: bool = False
    type: Type = field(default=UNKNOWN, init=False)
    target: VarDecl | None = field(default=None, init=False)
    leading: tuple[Comment, ...] = field(default=(), init=False)
    trailing: Comment | None = field(default=None, init=False)

    @property
    def start(self) -> Expression | None:
        """The initial value, its own or that of the TYPE it names (clause 2.4.3.2); None for that of `type`."""
        return self.initial if self.initial is not None else self.spec.start


@dataclass(slots=True, eq=False)
class VarBlock(Node):
    """`VAR_INPUT ... END_VAR`; `qualifiers` are the words after it in upper case (CONSTANT, RETAIN, ...)."""

    end: int
    kind: VarKind
    qualifiers: tuple[str, ...]
    variables: list[VarDecl]
    leading: tuple[Comment, ...] = field(default=(), init=False)


@dataclass(slots=True, eq=False)
class TypeDecl(Node):
    """One `Name : spec := initial;` of a TYPE block; `block` numbers the TYPE...END_TYPE in which it is.

    `terminated` is False if `END_STRUCT` lacks its semicolon, which some compilers allow.
    """

    end: int
    name: str
    spec: Spec
    initial: Expression | None
    block: int
    terminated: bool = True
    type: Type = field(default=UNKNOWN, init=False)
    leading: tuple[Comment, ...] = field(default=(), init=False)
    trailing: Comment | None = field(default=None, init=False)


@dataclass(slots=True, eq=False)
class Unsupported(Node):
    """A construct that is skipped as a whole: METHOD, PROPERTY, ACTION, NAMESPACE, INTERFACE, CLASS, SFC ..."""

    end: int
    word: str
    name: str


@dataclass(slots=True, eq=False)
class Pou(Node):
    """A program organisation unit. `leading` are the comments before it, `head` those between its first line and the
    first VAR block. `symbols` (checker): every variable by upper-case name in order, of a function also its RESULT.
    """

    end: int
    name: str
    name_at: int
    blocks: list[VarBlock]
    body: list[Statement]
    extras: list[Unsupported]
    leading: tuple[Comment, ...] = field(default=(), init=False)
    head: tuple[Comment, ...] = field(default=(), init=False)
    unit: Unit | None = field(default=None, init=False)
    symbols: dict[str, VarDecl] = field(default_factory=dict, init=False)

    @property
    def word(self) -> str:
        """The keyword that opens it."""
        return "POU"


@dataclass(slots=True, eq=False)
class Function(Pou):
    """A function; `result` (checker) is the variable with the function's own name, `returns` None if it has none."""

    returns: Spec | None = None
    type: Type = field(default=UNKNOWN, init=False)
    result: VarDecl | None = field(default=None, init=False)
    parameters: dict[str, Parameter] = field(default_factory=dict, init=False)

    @property
    def word(self) -> str:
        """The keyword that opens it."""
        return "FUNCTION"


@dataclass(slots=True, eq=False)
class FunctionBlock(Pou):
    """A function block; `heritage` is the text of EXTENDS and IMPLEMENTS, which nothing here runs."""

    heritage: str = ""
    type: Block | None = field(default=None, init=False)

    @property
    def word(self) -> str:
        """The keyword that opens it."""
        return "FUNCTION_BLOCK"


@dataclass(slots=True, eq=False)
class Program(Pou):
    """A program."""

    type: Block | None = field(default=None, init=False)

    @property
    def word(self) -> str:
        """The keyword that opens it."""
        return "PROGRAM"


@dataclass(slots=True, eq=False)
class Task(Node):
    """`TASK name(SINGLE := .., INTERVAL := .., PRIORITY := ..);`, each None where not given."""

    name: str
    single: Expression | None
    interval: Expression | None
    priority: Expression | None


@dataclass(slots=True, eq=False)
class ProgramInstance(Node):
    """`PROGRAM name WITH task : TypeName(connections);`; `task` None: runs in every cycle.

    `target` and `task_target` are set by the checker.
    """

    name: str
    task: str | None
    type_name: str
    connections: list[Argument]
    retain: bool = False
    target: Program | None = field(default=None, init=False)
    task_target: Task | None = field(default=None, init=False)


@dataclass(slots=True, eq=False)
class Resource(Node):
    """`RESOURCE name ON processor`; a configuration without RESOURCE has one whose name is empty."""

    name: str
    processor: str
    blocks: list[VarBlock]
    tasks: list[Task]
    programs: list[ProgramInstance]


@dataclass(slots=True, eq=False)
class Configuration(Node):
    """`CONFIGURATION ... END_CONFIGURATION`; `symbols` (checker): its globals by upper-case name."""

    end: int
    name: str
    blocks: list[VarBlock]
    resources: list[Resource]
    leading: tuple[Comment, ...] = field(default=(), init=False)
    unit: Unit | None = field(default=None, init=False)
    symbols: dict[str, VarDecl] = field(default_factory=dict, init=False)


Element = TypeDecl | Function | FunctionBlock | Program | Configuration | VarBlock | Unsupported


@dataclass(slots=True, eq=False)
class Unit:
    """One source file. `elements` in source order; `comments` holds every comment and pragma, attached or not.

    `starts` holds the offset of each line. `notes` are spellings that have no trace in the tree but matter to a
    portability rule, as (name, offset): a missing semicolon, a byte order mark. `analysis` is what the checker made
    of the unit and those beside it: a tree is completed once.
    """

    path: str
    text: str
    elements: list[Element]
    comments: list[Comment]
    starts: list[int]
    notes: list[tuple[str, int]]
    analysis: Analysis | None = field(default=None, init=False, repr=False)

    def place(self, at: int) -> tuple[int, int]:
        """The 1-based line and column of an offset."""
        line = bisect_right(self.starts, at)
        return line, at - self.starts[line - 1] + 1

    def line(self, at: int) -> int:
        return bisect_right(self.starts, at)


# ---------------------------------------------------------------- the types that declarations make


@dataclass(slots=True, eq=False)
class Array(Type):
    """An array; `bounds` holds (low, high) per dimension, both inclusive; row-major, the last index fastest.

    `start` is the initial value of an element whose TYPE declares one; None for the element type's.
    """

    element: Type
    bounds: tuple[tuple[int, int], ...]
    initial: Expression | None = None
    start: Expression | None = None

    @property
    def length(self) -> int:
        count = 1
        for low, high in self.bounds:
            count *= high - low + 1
        return count

    @property
    def size(self) -> int:
        """Bytes of all elements."""
        return self.length * self.element.size


@dataclass(slots=True, eq=False)
class Field:
    """A field of a structure; `initial` is its own initial value or that of the TYPE it names, None for the type's."""

    name: str
    type: Type
    initial: Expression | None = None
    declaration: VarDecl | None = None


@dataclass(slots=True, eq=False)
class Struct(Type):
    """A structure; `fields` by upper-case name in the order of declaration."""

    fields: dict[str, Field] = field(default_factory=dict)
    initial: Expression | None = None

    @property
    def size(self) -> int:
        """Bytes of all fields."""
        return sum(each.type.size for each in self.fields.values())


@dataclass(slots=True, eq=False)
class EnumValue:
    """One value of an enumeration and its number (0, 1, ... or as written)."""

    name: str
    number: int
    type: Enum


@dataclass(slots=True, eq=False)
class Enum(Type):
    """An enumeration; `values` by upper-case name in order. `base` if one was written (third edition)."""

    values: dict[str, EnumValue] = field(default_factory=dict)
    base: Elementary | None = None
    initial: Expression | None = None

    @property
    def size(self) -> int:
        """Bytes of the number."""
        return self.base.size if self.base else ENUM_BITS // 8


class Direction(PythonEnum):
    """Which way a parameter passes."""

    INPUT = "VAR_INPUT"
    OUTPUT = "VAR_OUTPUT"
    IN_OUT = "VAR_IN_OUT"


@dataclass(slots=True, eq=False)
class Parameter:
    """A formal parameter of a function or block. `default` is its declared initial value (None: the type's).

    That is its own or the one of the TYPE that it names.
    For a standard function `type` is what the overload resolved to in this very call.
    """

    name: str
    type: Type
    direction: Direction = Direction.INPUT
    default: Expression | None = None
    declaration: VarDecl | None = None


@dataclass(slots=True, eq=False)
class Block(Type):
    """A function block or program as a type. `declaration` is None for a standard block (then `name` says which).

    `parameters` (inputs, outputs, in-outs) by upper-case name in the order of declaration; the variables that are no
    parameters are in `declaration.symbols`. `size` counts all of its variables, an in-out as the thing it refers to.
    """

    parameters: dict[str, Parameter] = field(default_factory=dict)
    declaration: FunctionBlock | Program | None = None

    @property
    def size(self) -> int:
        """Bytes of all variables; of a standard block those of its parameters."""
        if self.declaration is None:
            return sum(each.type.size for each in self.parameters.values())
        return sum(each.type.size for each in self.declaration.symbols.values())


@dataclass(slots=True, eq=False)
class Builtin:
    """A standard function as one call resolved it.

    `name` is upper case as called (`ADD`, `INT_TO_REAL`). `family` is what an engine dispatches on: the name itself,
    or `CONVERT` for every `X_TO_Y` (source is `parameters[0].type`, destination `result`), `TRUNC` for TRUNC and
    `X_TRUNC_Y`, `BCD_TO` and `TO_BCD`. Extensible functions (ADD, MUL, AND, OR, XOR, MAX, MIN, MUX, CONCAT, GT ... LE)
    have as many parameters as the call has arguments, named IN1, IN2 ... (MUX: K, IN0, IN1 ...).
    """

    name: str
    family: str
    parameters: tuple[Parameter, ...]
    result: Type


# ---------------------------------------------------------------- what the checker makes of units


@dataclass(slots=True)
class Checked:
    """Sources whose every expression has its type. All tables are keyed by upper-case name, in source order.

    `types` holds the declared types only (not the elementary ones, not the blocks). `callees_first` lists the
    functions and function blocks so that each comes after all that it calls or contains; recursion is an error.
    """

    units: list[Unit] = field(default_factory=list)
    types: dict[str, Type] = field(default_factory=dict)
    functions: dict[str, Function] = field(default_factory=dict)
    blocks: dict[str, FunctionBlock] = field(default_factory=dict)
    programs: dict[str, Program] = field(default_factory=dict)
    configurations: dict[str, Configuration] = field(default_factory=dict)
    callees_first: list[Function | FunctionBlock] = field(default_factory=list)


@dataclass(slots=True)
class Analysis:
    """What files that were analysed together came to: what could be typed, and every problem in order of place."""

    checked: Checked
    problems: list[Problem]


def line_starts(text: str) -> list[int]:
    """The offset of the first character of every line; a line ends with LF (a CR before it belongs to it)."""
    starts = [0]
    here = text.find("\n")
    while here >= 0:
        starts.append(here + 1)
        here = text.find("\n", here + 1)
    return starts
