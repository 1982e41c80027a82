"""The statements of a block in SCL: the canonical text with what SCL wants beside each name."""

from driveblocks.platforms.part import Part
from driveblocks.platforms.siemens.names import Names
from driveblocks.platforms.siemens.words import ELEMENTARY, FORMAL, RESERVED, UNNAMED, converts
from structured_text.language import tree, walk
from structured_text.language.lexer import tokenize

_LITERALS = frozenset(
    {
        tree.LiteralKind.BOOL,
        tree.LiteralKind.INTEGER,
        tree.LiteralKind.REAL,
        tree.LiteralKind.STRING,
        tree.LiteralKind.TIME,
    }
)


def body(part: Part, names: Names) -> str:
    """The body, comments and lay-out as they are."""
    return _Body(part, names).text()


class _Body:
    """Collects what is put before, or after, the words of one body."""

    def __init__(self, part: Part, names: Names) -> None:
        pou = part.element
        assert isinstance(pou, tree.Pou)  # noqa: S101  (a type has no body)
        self.part, self.names, self.pou = part, names, pou
        self.variables = {one.name.upper(): one for block in pou.blocks for one in block.variables}
        self.result = pou.name.upper() if isinstance(pou, tree.Function) else ""
        self.puts: dict[int, str] = {}
        self.bare: set[int] = set()

    def text(self) -> str:
        """The canonical text with everything put in."""
        for statement in walk.statements(self.pou.body):
            self.statement(statement)
        if self.result and not _settles(self.pou.body, self.result):
            self.refuse(self.pou.name_at, f"{self.pou.name}: SCL gives no value to a result that a path does not set")
        self.comments()
        made, whole = "", self.part.unit.text
        here = whole.index(self.part.body, self.pou.blocks[-1].end if self.pou.blocks else self.pou.name_at)
        end = here + len(self.part.body)
        self.quotes(here)
        for at in sorted(self.puts):
            made += whole[here:at] + self.puts[at]
            here = at
        return made + whole[here:end]

    def comments(self) -> None:
        """SCL nests comments, and reads a pragma as something else."""
        for one in self.part.unit.comments:
            if one.style != "(*" or "(*" in one.text:
                self.refuse(one.at, "expected a plain (* comment *); SCL would read it as something else")

    def quotes(self, start: int) -> None:
        """Quotes around names that SCL reserves, but for the parameters of what the PLC brings."""
        tokens = tokenize(self.part.body)
        for kind, text, at in zip(tokens.kinds, tokens.texts, tokens.ats, strict=True):
            if kind == "name" and text.upper() in RESERVED and start + at not in self.bare:
                self.put(start + at, '"')
                self.put(start + at + len(text), '"')

    def refuse(self, at: int, text: str) -> None:
        """Note what SCL cannot say."""
        self.names.refuse(self.part, at, text)

    def put(self, at: int, text: str) -> None:
        """Put a text before an offset, after what was put there already."""
        self.puts[at] = self.puts.get(at, "") + text

    def statement(self, statement: tree.Statement) -> None:
        """The expressions of a statement, not of those inside it."""
        if (isinstance(statement, tree.Assign) and statement.op != ":=") or (
            isinstance(statement, tree.Return) and statement.value is not None
        ):
            self.refuse(statement.at, "SCL has no such statement")
        for value in walk.heads(statement):
            self.expression(value)

    def expression(self, value: tree.Expression) -> None:
        """A name gets its `#`, a function its quotes; operators and literals are alike."""
        if isinstance(value, tree.Name):
            self.name(value)
        elif isinstance(value, tree.Call):
            self.call(value)
        elif isinstance(value, tree.Literal):
            self.literal(value)
        elif isinstance(value, tree.Member | tree.Index | tree.Unary | tree.Binary):
            for each in walk.children(value):
                self.expression(each)
        else:
            self.refuse(value.at, "SCL has no such expression, or means something else by it")

    def name(self, value: tree.Name) -> None:
        """A variable of this block, or the result of this function."""
        if value.name.upper() not in self.variables and value.name.upper() != self.result:
            self.refuse(value.at, f"{value.name} is not declared in this block; SCL has no other names here")
        self.put(value.at, "#")

    def literal(self, value: tree.Literal) -> None:
        """Literals look alike as far as an S7-1200 has their type."""
        known = value.prefix in (None, "T", "TIME", "STRING") or value.prefix in ELEMENTARY
        if value.kind not in _LITERALS or not known:
            self.refuse(value.at, f"{value.text}: SCL has no such literal on an S7-1200")

    def call(self, call: tree.Call) -> None:
        """A call of an instance, a function of the library, or a standard function."""
        callee = call.callee
        if not isinstance(callee, tree.Name):
            self.expression(callee)
        elif callee.name.upper() in self.variables:
            self.name(callee)
            self.in_outs(call, self.variables[callee.name.upper()])
        elif (found := self.names.find(callee.name)) is not None:
            self.put(callee.at, '"')
            self.put(callee.at + len(callee.name), '"')
            self.inputs(call, found)
        else:
            self.standard(call, callee.name.upper())
        for argument in call.arguments:
            if argument.value is not None:
                self.expression(argument.value)

    def inputs(self, call: tree.Call, found: Part) -> None:
        """A function of SCL has no defaults: each input is in the call, by its name."""
        wanted = _parameters(found, tree.VarKind.INPUT) | _parameters(found, tree.VarKind.IN_OUT)
        self.given(call, found.name, wanted)

    def in_outs(self, call: tree.Call, instance: tree.VarDecl) -> None:
        """An in-out is a reference, so that each call names it."""
        found = self.names.find(instance.spec.name) if isinstance(instance.spec, tree.NamedSpec) else None
        if found is None:
            self.bare |= {argument.at for argument in call.arguments}
        elif isinstance(found.element, tree.FunctionBlock):
            self.given(call, instance.name, _parameters(found, tree.VarKind.IN_OUT))

    def given(self, call: tree.Call, name: str, wanted: dict[str, str]) -> None:
        """Refuse a call by position, or one that omits what SCL wants."""
        named = {argument.name.upper() for argument in call.arguments if argument.name and argument.value}
        if any(argument.name is None for argument in call.arguments):
            self.refuse(call.at, f"{name}: expected each argument by its name")
        for missing in wanted.keys() - named:
            self.refuse(call.at, f"{name}: expected {wanted[missing]} := ..., since SCL has no default for it")

    def standard(self, call: tree.Call, name: str) -> None:
        """SCL wants the parameters of a standard function named, unless there is but one."""
        if name in UNNAMED or converts(name):
            return
        if name not in FORMAL or len(call.arguments) != len(FORMAL[name]):
            self.refuse(call.at, f"{name}: SCL has no such function, or means something else by it")
            return
        for formal, argument in zip(FORMAL[name], call.arguments, strict=True):
            if argument.name is None:
                self.put(argument.at, f"{formal} := ")


def _parameters(part: Part, kind: tree.VarKind) -> dict[str, str]:
    blocks: list[tree.VarBlock] = part.element.blocks if isinstance(part.element, tree.Pou) else []
    return {one.name.upper(): one.name for block in blocks if block.kind is kind for one in block.variables}


def _settles(statements: list[tree.Statement], name: str) -> bool:
    """Whether every path through statements gives a value to a function's result."""
    for each in statements:
        if _sets(each, name):
            return True
        if any(isinstance(inner, tree.Return) for inner in walk.statements([each])):
            return False
    return False


def _sets(statement: tree.Statement, name: str) -> bool:
    if isinstance(statement, tree.Assign):
        return isinstance(statement.target, tree.Name) and statement.target.name.upper() == name
    inner = walk.bodies(statement)
    branched = getattr(statement, "otherwise", None) is not None
    return branched and all(_settles(each, name) for each in inner)
