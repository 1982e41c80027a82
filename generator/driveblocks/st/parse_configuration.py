"""CONFIGURATION, RESOURCE, TASK and program instances: tokens -> tree (annex B.1.7)."""

from __future__ import annotations

from driveblocks.st.cursor import SyntaxProblem
from driveblocks.st.lexer import END
from driveblocks.st.parse_declaration import VAR_KINDS, DeclarationParser
from driveblocks.st.tree import Argument, Configuration, Expression, ProgramInstance, Resource, Task


class ConfigurationParser(DeclarationParser):
    """Parses configurations."""

    __slots__ = ()

    def configuration(self) -> Configuration:
        """`CONFIGURATION ... END_CONFIGURATION`. Raises SyntaxProblem."""
        leading, at = self.leading(), self.ats[self.i]
        self.i += 1
        made = Configuration(at, 0, self.name("the name of the configuration"), [], [])
        made.leading = leading
        while self.kinds[self.i] not in ("END_CONFIGURATION", END):
            kind = self.kinds[self.i]
            if kind in VAR_KINDS:
                made.blocks.append(self.var_block())
            elif kind == "RESOURCE":
                made.resources.append(self.resource())
            elif kind in ("TASK", "PROGRAM"):
                self.bare_resource(made)
            else:
                self.fail("VAR_GLOBAL, RESOURCE, TASK, PROGRAM or END_CONFIGURATION")
        self.expect("END_CONFIGURATION")
        made.end = self.end_of_last()
        return made

    def bare_resource(self, made: Configuration) -> None:
        """A task or program without RESOURCE around it."""
        if not made.resources or made.resources[-1].name:
            made.resources.append(Resource(self.ats[self.i], "", "", [], [], []))
        self.resource_item(made.resources[-1])

    def resource(self) -> Resource:
        """`RESOURCE name ON processor ... END_RESOURCE`. Raises SyntaxProblem."""
        at = self.ats[self.i]
        self.i += 1
        name = self.name("the name of the resource")
        if not self.word("ON"):
            self.fail("ON")
        made = Resource(at, name, self.name("the name of the processor"), [], [], [])
        while self.kinds[self.i] not in ("END_RESOURCE", "END_CONFIGURATION", END):
            self.resource_item(made)
        self.expect("END_RESOURCE")
        self.accept(";")
        return made

    def resource_item(self, made: Resource) -> None:
        """Globals, a task or a program instance. Raises SyntaxProblem."""
        kind = self.kinds[self.i]
        if kind in VAR_KINDS:
            made.blocks.append(self.var_block())
        elif kind == "TASK":
            made.tasks.append(self.task())
        elif kind == "PROGRAM":
            made.programs.append(self.program_instance())
        else:
            self.fail("VAR_GLOBAL, TASK, PROGRAM or END_RESOURCE")

    def task(self) -> Task:
        """`TASK name(INTERVAL := T#10ms, PRIORITY := 1);` Raises SyntaxProblem."""
        at = self.ats[self.i]
        self.i += 1
        name = self.name("the name of the task")
        self.expect("(")
        given: dict[str, Expression | None] = {"SINGLE": None, "INTERVAL": None, "PRIORITY": None}
        for argument in self.arguments():
            self.task_setting(given, argument)
        self.expect(";")
        return Task(at, name, given["SINGLE"], given["INTERVAL"], given["PRIORITY"])

    def task_setting(self, given: dict[str, Expression | None], argument: Argument) -> None:
        """One setting of a task. Raises SyntaxProblem."""
        upper = (argument.name or "").upper()
        if upper not in given:
            self.i -= 1
            self.problem(self.i, f"expected SINGLE, INTERVAL or PRIORITY, found {argument.name or 'a bare value'}")
            raise SyntaxProblem
        given[upper] = argument.value

    def program_instance(self) -> ProgramInstance:
        """`PROGRAM name WITH task : TypeName(x := y);` Raises SyntaxProblem."""
        at = self.ats[self.i]
        self.i += 1
        retain = self.word("RETAIN")
        if not retain:
            self.word("NON_RETAIN")
        name = self.name("the name of the program instance")
        task = self.name("the name of a task") if self.accept("WITH") else None
        self.expect(":")
        type_name = self.name("the name of a program")
        connections = self.arguments() if self.accept("(") else []
        self.expect(";")
        return ProgramInstance(at, name, task, type_name, connections, retain)
