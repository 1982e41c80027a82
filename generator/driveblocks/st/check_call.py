"""Calls (clauses 2.5.1, 2.5.2, 3.3.2.2): which function or block, and which argument goes to which parameter."""

from __future__ import annotations

from driveblocks.st.check_expression import ExpressionChecker, conversion_to_bits
from driveblocks.st.report import nearest
from driveblocks.st.standard import BLOCKS, FUNCTIONS, Conversion, Group, Signature, conversion_of
from driveblocks.st.tree import Argument, Binding, Call, Expression, Function, FunctionBlock, Name
from driveblocks.st.types import (
    ANY,
    BOOL,
    DINT,
    REAL,
    UNKNOWN,
    UNTYPED_INTEGER,
    UNTYPED_REAL,
    VOID,
    Block,
    Builtin,
    Direction,
    Kind,
    Parameter,
    Type,
    conversion,
    plain,
    same,
    untyped,
)

# What dialects take addresses and sizes with.
_ADDRESSES = frozenset(["ADR", "ADRINST", "BITADR", "REF", "SIZEOF", "INDEXOF"])


class CallChecker(ExpressionChecker):
    """Resolves calls. `called` collects the functions that the POU at hand calls."""

    called: set[str]

    def call(self, value: Call, statement: bool = False) -> Type:
        """The type of a call; VOID for a block, which only a statement may invoke."""
        callee = value.callee
        name = callee.name.upper() if isinstance(callee, Name) else ""
        symbol = self.symbols.get(name)
        if not name or (symbol is not None and symbol.type.kind is Kind.BLOCK):
            return self.invoke(value, statement)
        found = self.library.find(name)
        if isinstance(found, Function):
            return self.function(value, found)
        if name in FUNCTIONS:
            return self.standard(value, name, FUNCTIONS[name])
        converted = conversion_of(name) or (Conversion("TRUNC", None, UNTYPED_INTEGER) if name == "TRUNC" else None)
        if converted is not None:
            return self.conversion(value, name, converted)
        return self.unknown_callee(value, name)

    def unknown_callee(self, value: Call, name: str) -> Type:
        """Tell of a name that cannot be called."""
        for each in value.arguments:
            self.infer_argument(each)
        found = self.library.find(name)
        symbol = self.symbols.get(name)
        shown = value.callee.name if isinstance(value.callee, Name) else name
        if symbol is not None:
            if symbol.type is not UNKNOWN:
                text = f"expected a function or block instance, found the variable {shown}"
                self.report.add(value.at, "type-mismatch", text)
        elif name in _ADDRESSES:
            text = f"{name} is not in the second edition: pass a VAR_IN_OUT, and sizes as inputs"
            self.report.add(value.at, "pointer", text)
        elif isinstance(found, FunctionBlock) or name in BLOCKS:
            text = f"expected an instance, found the block type {shown}: declare a variable of it and call that"
            self.report.add(value.at, "undeclared-name", text)
        else:
            functions = [named.name for named, _ in self.library.names.values() if isinstance(named, Function)]
            hint = nearest(shown, [*functions, *FUNCTIONS, *(each.name for each in self.symbols.values())])
            self.report.add(value.at, "undeclared-name", f"expected a function or instance, found {shown}{hint}")
        return UNKNOWN

    def infer_argument(self, argument: Argument) -> None:
        """Check the value of an argument that has no parameter to go to."""
        if argument.value is not None:
            self.infer(argument.value)
            self.settle(argument.value, UNKNOWN)

    def invoke(self, value: Call, statement: bool) -> Type:
        """A block instance."""
        have = self.infer(value.callee)
        if not isinstance(have, Block):
            for each in value.arguments:
                self.infer_argument(each)
            if have is not UNKNOWN:
                self.report.add(value.at, "type-mismatch", f"expected a function or block instance, found {have}")
            return UNKNOWN
        value.target = have
        self.bind(value, list(have.parameters.values()), have.name)
        if not statement:
            self.report.add(value.at, "type-mismatch", "expected a value, found the invocation of a block")
            return UNKNOWN
        return VOID

    def function(self, value: Call, found: Function) -> Type:
        """A function in ST."""
        value.target = found
        self.called.add(found.name.upper())
        self.bind(value, list(found.parameters.values()), found.name)
        return found.type

    def bind(self, value: Call, parameters: list[Parameter], name: str) -> None:
        """Give every parameter its argument, by name or by place."""
        given = self.sort_arguments(value, parameters, name)
        block = isinstance(value.target, Block)
        for parameter in parameters:
            argument = given.get(parameter.name.upper())
            made = Binding(parameter, argument.value if argument else None, bool(argument and argument.negated))
            value.bindings.append(made)
            if argument is not None and argument.value is not None:
                self.check_binding(argument, parameter)
            elif parameter.direction is Direction.IN_OUT:
                self.report.add(
                    value.at, "call-arguments", f"expected an argument for the in-out {parameter.name} of {name}"
                )
            elif not block and parameter.direction is Direction.INPUT and self.positional(value):
                text = f"expected an argument for {parameter.name} of {name}: give all, or name each"
                self.report.add(value.at, "call-arguments", text)

    @staticmethod
    def positional(value: Call) -> bool:
        """Whether a call gives its arguments by place."""
        return bool(value.arguments) and value.arguments[0].name is None

    def sort_arguments(self, value: Call, parameters: list[Parameter], name: str) -> dict[str, Argument]:
        """Arguments by the upper-case name of their parameter; what has no place is told."""
        given: dict[str, Argument] = {}
        places = parameters if self.positional(value) else []
        for number, argument in enumerate(value.arguments):
            if argument.name is None and number < len(places):
                given[places[number].name.upper()] = argument
            elif argument.name is None:
                self.unplaced(argument, len(places), name)
            elif not self.implicit(value, argument):
                self.named(given, argument, parameters, name)
        return given

    def unplaced(self, argument: Argument, places: int, name: str) -> None:
        """Tell of an argument by place that has none."""
        self.infer_argument(argument)
        what = f"expected at most {places} arguments for {name}, found more" if places else None
        self.report.add(
            argument.at, "call-arguments", what or f"expected `name := value` for {name}, found a bare value"
        )

    def named(self, given: dict[str, Argument], argument: Argument, parameters: list[Parameter], name: str) -> None:
        """Place an argument by its name."""
        upper = (argument.name or "").upper()
        known = {each.name.upper() for each in parameters}
        if upper not in known:
            self.infer_argument(argument)
            hint = nearest(upper, [each.name for each in parameters])
            self.report.add(
                argument.at, "call-arguments", f"expected a parameter of {name}, found {argument.name}{hint}"
            )
        elif upper in given:
            self.infer_argument(argument)
            self.report.add(argument.at, "call-arguments", f"expected {argument.name} of {name} once, found it twice")
        else:
            given[upper] = argument

    def implicit(self, value: Call, argument: Argument) -> bool:
        """Take EN and ENO, which every function and block has."""
        upper = (argument.name or "").upper()
        if upper == "EN" and not argument.output and argument.value is not None:
            self.wanted(argument.value, BOOL)
            value.en = argument.value
            return True
        if upper == "ENO" and argument.output and argument.value is not None:
            self.wanted(argument.value, BOOL)
            self.assignable(argument.value, "to receive ENO")
            value.eno = argument.value
            return True
        return False

    def check_binding(self, argument: Argument, parameter: Parameter) -> None:
        """Type and direction of one argument."""
        value = argument.value
        if value is None:
            return
        self.infer(value)
        output = parameter.direction is Direction.OUTPUT
        if argument.name is not None and argument.output != output:
            sign = "=>" if output else ":="
            text = f"expected {sign} for the {parameter.direction.value} {parameter.name}"
            self.report.add(argument.at, "call-arguments", text)
        if parameter.direction is not Direction.INPUT:
            self.by_reference(argument, parameter)
        elif argument.negated:
            self.report.add(argument.at, "call-arguments", "expected NOT before an output only")
        self.fits(value, parameter.type)

    def by_reference(self, argument: Argument, parameter: Parameter) -> None:
        """An output or in-out takes a variable of exactly its type."""
        value = argument.value
        if value is None or untyped(value.type):
            what = f"for {parameter.name}"
            self.report.add(argument.at, "not-assignable", f"expected a variable {what}, found a value")
            return
        if parameter.type.kind is not Kind.BLOCK:
            self.assignable(value, f"for {parameter.name}")
        if isinstance(parameter.type, type(value.type)) and plain(value.type) is not value.type:
            self.report.add(value.at, "type-mismatch", f"expected {parameter.type}, found the subrange {value.type}")

    def standard(self, value: Call, name: str, signature: Signature) -> Type:
        """An overloaded standard function."""
        formals = self.formals(value, signature)
        parameters = [Parameter(each, UNKNOWN) for each, _ in formals]
        given = self.sort_arguments(value, parameters, name)
        for each in given.values():
            if each.value is not None:
                self.infer(each.value)
        shared = self.shared_type(given, formals, signature.group, name)
        if untyped(shared) and signature.result is BOOL:
            shared = REAL if shared is UNTYPED_REAL else DINT
        result = shared if signature.result == "T" else signature.result
        made: list[Parameter] = []
        for parameter, (_, wanted) in zip(parameters, formals, strict=True):
            argument = given.get(parameter.name)
            if argument is None or argument.value is None:
                self.report.add(value.at, "call-arguments", f"expected an argument for {parameter.name} of {name}")
            else:
                self.standard_argument(argument, wanted, shared, name)
            parameter.type = self.parameter_type(argument, wanted, shared)
            made.append(parameter)
            value.bindings.append(Binding(parameter, argument.value if argument else None))
        value.target = Builtin(name, name, tuple(made), result if isinstance(result, Type) else UNKNOWN)
        return value.target.result

    @staticmethod
    def parameter_type(argument: Argument | None, wanted: Type | Group | str, shared: Type) -> Type:
        """What a formal parameter is in this very call."""
        if isinstance(wanted, Type):
            return wanted
        if wanted == "T":
            return shared
        return plain(argument.value.type) if argument and argument.value else UNKNOWN

    def formals(self, value: Call, signature: Signature) -> list[tuple[str, Type | Group | str]]:
        """The formal parameters, with as many of the repeated ones as the call has arguments."""
        formals = list(signature.formals)
        extra = sum(1 for each in value.arguments if (each.name or "").upper() not in ("EN", "ENO")) - len(formals)
        if signature.extensible:
            last, wanted = formals[-1]
            first = int(last.removeprefix("IN"))
            formals += [(f"IN{first + number}", wanted) for number in range(1, extra + 1)]
        return formals

    def shared_type(
        self, given: dict[str, Argument], formals: list[tuple[str, Type | Group | str]], group: Group, name: str
    ) -> Type:
        """The type that all "T" arguments have; untyped if all are numbers without prefix."""
        values = [given[each].value for each, wanted in formals if wanted == "T" and each in given]
        types = [each.type for each in values if each is not None]
        typed = [each for each in types if not untyped(each)]
        if UNKNOWN in typed or not types:
            return UNKNOWN
        if not typed:
            return self.untyped_shared(values, group, name)
        shared = plain(typed[0])
        if shared.kind not in group and group != ANY:
            at = next(each.at for each in values if each is not None)
            self.report.add(at, *self.wrong_group(shared, group, name))
            return UNKNOWN
        return shared

    def untyped_shared(self, values: list[Expression | None], group: Group, name: str) -> Type:
        """What numbers without prefix share; told if the function is not for numbers."""
        given = [each for each in values if each is not None]
        if group & {Kind.INTEGER, Kind.REAL, Kind.BITS}:
            return UNTYPED_REAL if any(each.type is UNTYPED_REAL for each in given) else UNTYPED_INTEGER
        self.report.add(given[0].at, "type-mismatch", f"expected another type for {name}, found {given[0].type}")
        for each in given:
            self.settle(each, self.default(each))
        return UNKNOWN

    @staticmethod
    def wrong_group(shared: Type, group: Group, name: str) -> tuple[str, str]:
        """Rule and text for an argument that an overloaded function does not take."""
        if shared.kind is Kind.BITS and Kind.INTEGER in group:
            text = f"expected a number for {name}, found {shared}: convert it to an integer first"
            return "bit-string-arithmetic", text
        if shared.kind is Kind.INTEGER and Kind.BITS in group:
            text = f"expected a bit string for {name}, found {shared}: write {conversion_to_bits(shared)}(...)"
            return "implicit-conversion", text
        if shared.kind is Kind.INTEGER and Kind.REAL in group:
            text = f"expected REAL or LREAL for {name}, found {shared}: write {conversion(shared, REAL)}(...)"
            return "implicit-conversion", text
        shown = "a bit string" if Kind.BITS in group and Kind.INTEGER not in group else "another type"
        return "type-mismatch", f"expected {shown} for {name}, found {shared}"

    def standard_argument(self, argument: Argument, wanted: Type | Group | str, shared: Type, name: str) -> None:
        """Type of one argument of a standard function."""
        value = argument.value
        if value is None:
            return
        if argument.output:
            self.report.add(argument.at, "call-arguments", f"expected := for an input of {name}, found =>")
        if isinstance(wanted, Type):
            self.fits(value, wanted)
        elif wanted == "T":
            if not untyped(shared):
                self.shared_argument(argument, shared)
        elif isinstance(wanted, frozenset):
            self.settle(value, self.default(value))
            if value.type.kind not in wanted and value.type is not UNKNOWN:
                rule = "implicit-conversion" if value.type.kind is Kind.BITS else "type-mismatch"
                self.report.add(value.at, rule, f"expected an integer for {argument.name or name}, found {value.type}")

    def shared_argument(self, argument: Argument, shared: Type) -> None:
        """An argument that has the type of its fellows."""
        value = argument.value
        if value is None:
            return
        if untyped(value.type):
            self.settle(value, shared)
        elif shared is not UNKNOWN and not same(shared, value.type):
            self.mismatch(value, shared)

    def conversion(self, value: Call, name: str, found: Conversion) -> Type:
        """`X_TO_Y(x)` and its kind."""
        parameter = Parameter("IN", found.source or UNKNOWN)
        given = self.sort_arguments(value, [parameter], name)
        argument = given.get("IN")
        source = argument.value if argument else None
        if source is None:
            self.report.add(value.at, "call-arguments", f"expected an argument for IN of {name}")
        else:
            self.infer(source)
            if found.source is not None:
                self.fits(source, found.source)
            else:
                self.settle(source, self.default(source))
                parameter.type = source.type
        if name.startswith("TO_"):
            text = f"{name} is of the third edition: name the source too, as in {parameter.type.name}_{name}"
            self.report.add(value.at, "generic-conversion", text)
        if name == "TRUNC" and parameter.type.kind is not Kind.REAL and parameter.type is not UNKNOWN:
            self.report.add(value.at, "type-mismatch", f"expected REAL or LREAL for TRUNC, found {parameter.type}")
        value.bindings.append(Binding(parameter, source))
        value.target = Builtin(name, found.family, (parameter,), found.result)
        return found.result
