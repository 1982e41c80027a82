"""Type specifications and variable declarations: tokens -> tree (annex B.1.3, B.1.4)."""

from __future__ import annotations

from driveblocks.st.cursor import SyntaxProblem
from driveblocks.st.lexer import END
from driveblocks.st.parse_statement import StatementParser
from driveblocks.st.tree import (
    ArraySpec,
    EnumItem,
    EnumSpec,
    Expression,
    NamedSpec,
    PointerSpec,
    Range,
    Spec,
    StringSpec,
    StructSpec,
    SubrangeSpec,
    TypeDecl,
    VarBlock,
    VarDecl,
    VarKind,
)

VAR_KINDS = {kind.value: kind for kind in VarKind if kind.value.startswith("VAR")}
QUALIFIERS = frozenset(["CONSTANT", "RETAIN", "NON_RETAIN", "PERSISTENT", "PUBLIC", "PRIVATE", "PROTECTED", "INTERNAL"])
_POINTERS = {"POINTER": True, "REFERENCE": True, "REF_TO": False}
_SYNC = frozenset([";", "END_VAR", "END_STRUCT", "END_TYPE", "TYPE", "FUNCTION", "FUNCTION_BLOCK", "PROGRAM", END])
_SYNC |= {"END_FUNCTION", "END_FUNCTION_BLOCK", "END_PROGRAM", "CONFIGURATION", "END_CONFIGURATION"} | set(VAR_KINDS)


class DeclarationParser(StatementParser):
    """Parses declarations."""

    __slots__ = ()

    def var_block(self) -> VarBlock:
        """`VAR_INPUT ... END_VAR`. Never raises SyntaxProblem."""
        leading, at = self.leading(), self.ats[self.i]
        kind = VAR_KINDS[self.kinds[self.i]]
        self.i += 1
        words: list[str] = []
        while self.texts[self.i].upper() in QUALIFIERS and self.kinds[self.i + 1] not in (":", ","):
            words.append(self.texts[self.i].upper())
            self.i += 1
        block = VarBlock(at, 0, kind, tuple(words), [])
        block.leading = leading
        self.declarations(block.variables, kind, block.qualifiers, "END_VAR")
        block.end = self.end_of_last()
        if self.accept(";"):
            self.notes.append(("stray-semicolon", self.ats[self.i - 1]))
        return block

    def declarations(self, into: list[VarDecl], kind: VarKind, words: tuple[str, ...], close: str) -> None:
        """Declarations up to the closing word, and that word. Never raises SyntaxProblem."""
        while self.kinds[self.i] != close:
            start = self.i
            try:
                self.declaration(into, kind, words)
            except SyntaxProblem:
                self.depth = 0 if close == "END_VAR" else self.depth
                if not self.skip_declaration(start, close):
                    return
        self.i += 1

    def skip_declaration(self, start: int, close: str) -> bool:
        """Go on behind the next `;`; False if the block ends without its closing word."""
        if self.i == start and self.kinds[self.i] in _SYNC and self.kinds[self.i] != ";":
            self.problem(self.i, f"expected {close}, found {self.found(self.i)}")
            return False
        while self.kinds[self.i] not in _SYNC:
            self.i += 1
        self.accept(";")
        return True

    def declaration(self, into: list[VarDecl], kind: VarKind, words: tuple[str, ...]) -> None:
        """`a, b AT %IX0.0 : INT := 1;` Raises SyntaxProblem."""
        leading = self.leading() if self.i in self.before else ()
        first = len(into)
        names = [self.declared_name(kind)]
        while self.accept(","):
            names.append(self.declared_name(kind))
        self.expect(":")
        spec = self.spec()
        edge = self.edge()
        initial = self.initial_value()
        if self.kinds[self.i] != ";":
            self.fail("`;`" if initial is not None else "`;` or `:=`")
        self.i += 1
        end = self.end_of_last()
        trailing = self.trailing() if self.i in self.before else None
        constant, retain = "CONSTANT" in words, "RETAIN" in words
        for at, name, address in names:
            made = VarDecl(at, end, name, kind, spec, initial, address, constant, retain, edge, len(into) > first)
            made.trailing = trailing
            into.append(made)
        into[first].leading = leading

    def declared_name(self, kind: VarKind) -> tuple[int, str, str | None]:
        """Where, the name, and the address behind AT; a dotted path in VAR_CONFIG and VAR_ACCESS."""
        at = self.ats[self.i]
        if kind in (VarKind.CONFIG, VarKind.ACCESS) or self.kinds[self.i] == "direct":
            return at, self.path(), self.address()
        if self.kinds[self.i] == "AT":
            return at, "", self.address()
        return at, self.name("the name of a variable or END_VAR"), self.address()

    def path(self) -> str:
        """`resource.program.variable` or a direct address, as text."""
        parts = [self.texts[self.i]]
        if not self.accept("direct"):
            parts = [self.name("a path")]
        while self.accept("."):
            parts.append(self.name("a path"))
        return ".".join(parts)

    def address(self) -> str | None:
        """The address behind AT; None without AT."""
        if not self.accept("AT"):
            return None
        here = self.i
        if self.kinds[here] != "direct":
            self.fail("a direct address such as %IX0.0")
        self.i = here + 1
        return self.texts[here]

    def edge(self) -> str:
        """R_EDGE or F_EDGE."""
        return next((each for each in ("R_EDGE", "F_EDGE") if self.word(each)), "")

    def initial_value(self) -> Expression | None:
        """`:= value`, if there is one."""
        return self.initial() if self.accept(":=") else None

    def spec(self) -> Spec:
        """What stands behind the colon. Raises SyntaxProblem."""
        kind, at = self.kinds[self.i], self.ats[self.i]
        if kind == "ARRAY":
            return self.array_spec()
        if kind == "STRUCT":
            return self.struct_spec()
        if kind in ("STRING", "WSTRING"):
            return self.string_spec()
        if kind == "(":
            return self.enum_spec(None)
        name = self.name("a type")
        if name.upper() in _POINTERS and (self.kinds[self.i] == "TO" or not _POINTERS[name.upper()]):
            return self.pointer_spec(at, name.upper())
        while self.accept("."):
            name += "." + self.name("a type")
        return self.bracketed_spec(at, name) if self.kinds[self.i] == "(" else NamedSpec(at, name)

    def bracketed_spec(self, at: int, name: str) -> Spec:
        """`INT (0..9)` or `INT (A, B)`, behind the name."""
        if self.kinds[self.i + 1] == "name" and self.kinds[self.i + 2] in (",", ")", ":="):
            made = self.enum_spec(name)
            made.at = at
            return made
        self.i += 1
        here = self.ats[self.i]
        low = self.expression()
        self.expect("..")
        high = self.expression()
        self.expect(")")
        return SubrangeSpec(at, name, Range(here, low, high))

    def pointer_spec(self, at: int, word: str) -> Spec:
        """What a pointer points to."""
        self.accept("TO")
        self.deeper()
        target = self.spec()
        self.depth -= 1
        return PointerSpec(at, word, target)

    def string_spec(self) -> Spec:
        """`STRING`, `STRING[20]`, `STRING(20)`."""
        at, wide = self.ats[self.i], self.kinds[self.i] == "WSTRING"
        self.i += 1
        bracket = self.kinds[self.i]
        if bracket not in ("[", "("):
            return StringSpec(at, wide, None, "")
        self.i += 1
        length = self.expression()
        self.expect("]" if bracket == "[" else ")")
        return StringSpec(at, wide, length, bracket)

    def array_spec(self) -> Spec:
        """`ARRAY[0..9, 1..2] OF element`."""
        at = self.ats[self.i]
        self.i += 1
        self.expect("[")
        ranges = [self.range()]
        while self.accept(","):
            ranges.append(self.range())
        self.expect("]")
        self.expect("OF")
        self.deeper()
        element = self.spec()
        self.depth -= 1
        return ArraySpec(at, ranges, element)

    def range(self) -> Range | None:
        """`low..high`, or None for `*`."""
        if self.accept("*"):
            return None
        at = self.ats[self.i]
        low = self.expression()
        self.expect("..")
        return Range(at, low, self.expression())

    def struct_spec(self) -> Spec:
        """`STRUCT ... END_STRUCT`."""
        at = self.ats[self.i]
        self.i += 1
        self.deeper()
        made = StructSpec(at, [])
        self.declarations(made.fields, VarKind.FIELD, (), "END_STRUCT")
        self.depth -= 1
        return made

    def enum_spec(self, base: str | None) -> Spec:
        """`(A, B := 2)`."""
        at = self.ats[self.i]
        self.i += 1
        items: list[EnumItem] = []
        while True:
            leading, here = self.leading(), self.ats[self.i]
            item = EnumItem(here, self.name("the name of a value"), self.initial_value())
            item.leading = leading
            items.append(item)
            more = self.accept(",")
            item.trailing = self.trailing()
            if not more:
                break
        self.expect(")")
        return EnumSpec(at, items, base)

    def type_block(self, number: int) -> list[TypeDecl]:
        """`TYPE ... END_TYPE`. Never raises SyntaxProblem."""
        block_comments = self.leading()
        self.i += 1
        made: list[TypeDecl] = []
        while self.kinds[self.i] != "END_TYPE":
            start, depth = self.i, self.depth
            try:
                made.append(self.type_declaration(number))
            except SyntaxProblem:
                self.depth = depth
                if not self.skip_declaration(start, "END_TYPE"):
                    return made
                self.accept("END_STRUCT")
                self.accept(";")
        self.i += 1
        if made:
            made[0].leading = block_comments + made[0].leading
        return made

    def type_declaration(self, number: int) -> TypeDecl:
        """`Name : spec := initial;` Raises SyntaxProblem."""
        leading, at = self.leading(), self.ats[self.i]
        name = self.name("the name of a type or END_TYPE")
        self.expect(":")
        spec = self.spec()
        if isinstance(spec, NamedSpec) and self.kinds[self.i] == "(":
            self.fail("`;` or `:=`")
        initial = self.initial_value()
        terminated = self.accept(";")
        if not terminated and not (isinstance(spec, StructSpec) and self.kinds[self.i] in ("END_TYPE", "name")):
            self.fail("`;`" if initial is not None else "`;` or `:=`")
        made = TypeDecl(at, self.end_of_last(), name, spec, initial, number, terminated)
        made.leading, made.trailing = leading, self.trailing()
        return made
