"""Calls (clauses 2.5.1, 2.5.2, 3.3.2.2): which function or block is meant."""

from __future__ import annotations

from driveblocks.st.check_standard import StandardChecker
from driveblocks.st.report import nearest
from driveblocks.st.standard import BLOCKS, FUNCTIONS, Conversion, conversion_of
from driveblocks.st.tree import Block, Call, Function, FunctionBlock, Name
from driveblocks.st.types import UNKNOWN, UNTYPED_INTEGER, VOID, Kind, Type

# What dialects take addresses and sizes with.
_ADDRESSES = frozenset(["ADR", "ADRINST", "BITADR", "REF", "SIZEOF", "INDEXOF"])


class CallChecker(StandardChecker):
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
