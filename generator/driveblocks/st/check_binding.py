"""Which argument goes to which parameter (clauses 2.5.1.3, 3.3.2.2)."""

from __future__ import annotations

from driveblocks.st.check_expression import ExpressionChecker
from driveblocks.st.report import nearest
from driveblocks.st.tree import Argument, Binding, Block, Call, Direction, Parameter
from driveblocks.st.types import BOOL, UNKNOWN, Kind, plain, untyped


class BindingChecker(ExpressionChecker):
    """Gives every parameter its argument, by name or by place."""

    def infer_argument(self, argument: Argument) -> None:
        """Check the value of an argument that has no parameter to go to."""
        if argument.value is not None:
            self.infer(argument.value)
            self.settle(argument.value, UNKNOWN)

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
