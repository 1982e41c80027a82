"""From checked sources to Python functions and classes: one function per POU, one class per block and structure."""

import ast
from collections.abc import Callable
from typing import Any

from structured_text.engines.embedded import operands, operators, standard_blocks
from structured_text.engines.embedded.calls import call_term, function_name
from structured_text.engines.embedded.certainty import present
from structured_text.engines.embedded.faults import Accesses
from structured_text.engines.embedded.invocation import body_name
from structured_text.engines.embedded.parts import body_of, stored
from structured_text.engines.embedded.ranges import Ranges
from structured_text.engines.embedded.reals import single
from structured_text.engines.embedded.runtime import namespace
from structured_text.engines.embedded.scope import GLOBALS, SELF, Scope, Terms, UnsupportedError
from structured_text.engines.embedded.shapes import Maker, Record, Shapes, is_scalar, record_class
from structured_text.engines.embedded.standard_blocks import Run
from structured_text.engines.embedded.statements import STATEMENTS, returned_value
from structured_text.engines.embedded.syntax import Pen
from structured_text.engines.embedded.terms import is_integral
from structured_text.engines.embedded.usage import loops, touched
from structured_text.engines.engine import Message
from structured_text.language import tree
from structured_text.language.tree import Block, Checked, EnumValue, VarKind
from structured_text.language.types import REAL, Kind, String, Type, plain

TERMS: Terms = {
    tree.Literal: operands.literal, tree.Name: operands.name, tree.Qualified: operands.enumerated,
    tree.Member: operands.member, tree.Index: operands.index, tree.Unary: operators.unary,
    tree.Binary: operators.binary, tree.Call: call_term,
}  # fmt: skip


Body = Callable[[Any], None]


class Compiler:
    """Compiles a whole build into one namespace; `messages` holds what it could not."""

    def __init__(
        self,
        checked: Checked,
        coverage: bool = False,
        strict: bool = True,
        told: Callable[[float], None] = lambda _: None,
    ) -> None:
        """Compile everything; with `coverage`, so that it counts what runs; `strict`, and `told`, as for the engine."""
        self.checked = checked
        self.coverage = coverage
        self.strict = strict
        self.shapes = Shapes()
        self.shapes.instances = self.instance
        self.shapes.evaluate = self.evaluate
        self.run = Run()
        self.objects = namespace(self.run)
        self.accesses = Accesses()
        self.messages: list[Message] = []
        self.classes: dict[Block, type[Record]] = standard_blocks.classes()
        self.looping: set[tree.Function | Block] = set()
        self._makers: dict[Block, list[tuple[str, Maker]]] = {}
        self._constants: dict[int, Any] = {}
        for name, body in standard_blocks.bodies(self.run).items():
            self.objects[f"body_{name}"] = body
        pous = [*checked.callees_first, *checked.programs.values()]
        for at, each in enumerate(pous):
            told(at / len(pous))
            self._attempt(each)

    # ------------------------------------------------------------ what others ask for

    def body(self, block: Block) -> Body:
        body: Body = self.objects[body_name(block)]
        return body

    def function(self, function: tree.Function) -> Callable[..., Any]:
        made: Callable[..., Any] = self.objects[function_name(function)]
        return made

    def instance(self, block: Block, context: Any) -> Any:
        """A fresh instance with initial values; `context` holds the globals that it sees."""
        made = self.classes[block]()
        for name, maker in self._instance_makers(block):
            setattr(made, name, maker(context))
        return made

    def evaluate(self, expression: tree.Expression, kind: Type) -> Any:
        """The value of a constant expression as a variable of a type takes it."""
        if isinstance(expression, tree.Literal) and isinstance(expression.value, int | bytes):
            return self._literal(expression, kind)
        if id(expression) not in self._constants:
            self._constants[id(expression)] = self._evaluated(expression, kind)
        return self._constants[id(expression)]

    # ------------------------------------------------------------ constants

    def _literal(self, literal: tree.Literal, kind: Type) -> Any:
        kind, value = plain(kind), literal.value
        if kind.kind is Kind.BOOL:
            return bool(value)
        if kind.kind is Kind.REAL:
            return single(float(value)) if kind is REAL else float(value)
        if isinstance(kind, String) and isinstance(value, bytes):
            return value[: kind.length]
        return value

    def _evaluated(self, expression: tree.Expression, kind: Type) -> Any:
        if isinstance(expression, tree.Name | tree.Qualified) and isinstance(expression.symbol, EnumValue):
            return expression.symbol.number
        scope = self._scope(None, Pen(tree.Unit("", "", [], [], [0], [])))
        node = stored(scope, expression, kind).node
        code = compile(ast.Expression(node), "<initial value>", "eval")
        return eval(code, self.objects, {})  # noqa: S307 - our own compiled code

    # ------------------------------------------------------------ POUs

    def _attempt(self, pou: tree.Pou) -> None:
        unit = present(pou.unit)
        try:
            if isinstance(pou, tree.Function):
                self._function(pou)
            elif isinstance(pou, tree.FunctionBlock | tree.Program):
                self._block(pou)
        except UnsupportedError as error:
            self.messages.append(Message(unit.path, *unit.place(error.at), str(error)))
        except RecursionError:
            text = f"{pou.name} is nested too deeply for the embedded engine: put the inner parts into a block"
            self.messages.append(Message(unit.path, *unit.place(pou.name_at), text))

    def _scope(self, pou: tree.Pou | None, pen: Pen) -> Scope:
        how = (self.coverage, self.strict, pen, self.shapes, self.accesses, Ranges(), self.objects)
        return Scope(pou, *how, TERMS, STATEMENTS)

    def _note_loops(self, pou: tree.Pou, key: tree.Function | Block) -> None:
        if loops(pou.body, self.looping):
            self.looping.add(key)

    def _define(self, pen: Pen, name: str, parameters: list[str], body: list[ast.stmt]) -> None:
        """Compile a Python function into the namespace; its file is the ST source."""
        module = ast.Module([pen.function(name, parameters, body)], [])
        exec(compile(module, pen.unit.path, "exec"), self.objects)  # noqa: S102 - our own compiled code

    def _function(self, function: tree.Function) -> None:
        self._note_loops(function, function)
        pen = Pen(present(function.unit))
        scope = self._scope(function, pen)
        written = touched(function.body)
        body: list[ast.stmt] = []
        for each in function.symbols.values():
            pen.move(each.at)
            body += self._prepared(scope, each, each in written)
        body += body_of(scope, function.body)
        pen.move(function.at)
        body.append(pen.leave(returned_value(scope)))
        inputs = (VarKind.INPUT, VarKind.IN_OUT)
        parameters = [each.name.upper() for each in function.symbols.values() if each.kind in inputs]
        self._define(pen, function_name(function), parameters, body)

    def _prepared(self, scope: Scope, variable: tree.VarDecl, written: bool) -> list[ast.stmt]:
        """Bring a variable of a function to its initial value; an array or structure that is written is copied."""
        pen, kind = scope.pen, variable.type
        mine = pen.name(variable.name.upper())
        if variable.kind is VarKind.IN_OUT or (
            variable.kind is VarKind.INPUT and not (written and not is_scalar(kind))
        ):
            return []
        if variable.kind is VarKind.INPUT:
            return [pen.assign(mine, pen.call(scope.object("cloned", self._cloner(kind)), mine))]
        if is_scalar(kind):
            value = self.shapes.scalar(kind, variable.start)
            if is_integral(kind):
                scope.ranges.set(variable, value, value)
            return [] if variable.constant else [pen.assign(mine, pen.constant(value))]
        maker = self.shapes.maker(kind, variable.start)
        if variable.constant:
            return [pen.assign(mine, pen.name(scope.object("constant", maker(None))))]
        return [pen.assign(mine, pen.call(scope.object("make", maker), pen.constant(None)))]

    def _cloner(self, kind: Type) -> Callable[[Any], Any]:
        maker, copier = self.shapes.maker(kind), self.shapes.copier(plain(kind))

        def clone(source: Any) -> Any:
            fresh = maker(None)
            copier(fresh, source)
            return fresh

        return clone

    # ------------------------------------------------------------ blocks

    def _block(self, pou: tree.FunctionBlock | tree.Program) -> None:
        block = present(pou.type)
        self._note_loops(pou, block)
        slots = [each.name.upper() for each in kept(pou)]
        self.classes[block] = record_class(pou.name, (*slots, GLOBALS))
        pen = Pen(present(pou.unit))
        scope = self._scope(pou, pen)
        body: list[ast.stmt] = []
        for each in pou.symbols.values():
            pen.move(each.at)
            if each.kind is VarKind.TEMP:
                body += self._prepared(scope, each, False)
        body += body_of(scope, pou.body)
        pen.move(pou.at)
        self._define(pen, body_name(block), [SELF], body)

    def _instance_makers(self, block: Block) -> list[tuple[str, Maker]]:
        """How to fill the slots of an instance."""
        if block not in self._makers:
            declaration = block.declaration
            if declaration is None:
                made = [(name, self.shapes.maker(each.type)) for name, each in block.parameters.items()]
                made += [(name, _always(value)) for name, value in standard_blocks.inner_slots(block).items()]
            else:
                made = [(each.name.upper(), self.shapes.maker(each.type, each.start)) for each in kept(declaration)]
                made.append((GLOBALS, lambda context: context))
            self._makers[block] = made
        return self._makers[block]


KEPT = frozenset(VarKind) - {VarKind.TEMP, VarKind.EXTERNAL}
"""What an instance keeps between its calls."""


def kept(pou: tree.Pou) -> list[tree.VarDecl]:
    """The variables that an instance keeps between its calls."""
    return [each for each in pou.symbols.values() if each.kind in KEPT]


def _always(value: Any) -> Maker:
    return lambda _: value
