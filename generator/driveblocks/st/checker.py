"""Typed trees: names, types and calls of several files resolved together."""

from __future__ import annotations

from collections.abc import Sequence
from operator import is_not

from driveblocks.st.check_declaration import DeclarationChecker
from driveblocks.st.collector import paused
from driveblocks.st.library import Library
from driveblocks.st.problems import CheckError, Problem
from driveblocks.st.report import Report
from driveblocks.st.tree import (
    Analysis,
    Array,
    Block,
    Checked,
    Configuration,
    Expression,
    Function,
    FunctionBlock,
    Name,
    Pou,
    Program,
    ProgramInstance,
    Resource,
    Task,
    TypeDecl,
    Unit,
    Unsupported,
    VarBlock,
    VarDecl,
    VarKind,
)
from driveblocks.st.types import BOOL, INT, TIME, VOID, Type

# Blocks in blocks in blocks: more levels are an accident.
DEEPEST_BLOCKS = 40


def check(units: Sequence[Unit]) -> Checked:
    """Resolve and type files as one text in the given order. Raises CheckError with everything that is wrong.

    Raises ValueError as `analyse` does.
    """
    checked, problems = analyse(units)
    if problems:
        raise CheckError(problems)
    return checked


def analyse(units: Sequence[Unit]) -> tuple[Checked, list[Problem]]:
    """As `check`, but give what could be typed together with the problems, for those who go on nevertheless.

    The trees are completed in place, once: asked again for the same files, it gives what it gave. Raises ValueError for
    a file that was analysed with others before, since its tree refers to those.
    """
    found = _analysed(units)
    if found is None:
        report = Report()
        checker = _Checker(Library(list(units), report), report)
        with paused():
            checked = checker.run()
        found = Analysis(checked, report.problems())
        for unit in units:
            unit.analysis = found
    return found.checked, list(found.problems)


def _analysed(units: Sequence[Unit]) -> Analysis | None:
    """What was made of these very files, in this order, before. Raises ValueError as `analyse` does."""
    for unit in units:
        known = unit.analysis.checked.units if unit.analysis is not None else units
        if len(known) != len(units) or any(map(is_not, known, units)):
            raise ValueError(f"{unit.path} was analysed with other files already: parse it again")
    return units[0].analysis if units else None


class _Checker(DeclarationChecker):
    """Goes over all files: types, heads, bodies, order, configurations."""

    def run(self) -> Checked:
        """Check everything."""
        checked = Checked(units=self.library.units)
        self.sort_elements(checked)
        for pou in self.pous(checked):
            self.report.unit = pou.unit
            self.declare_pou(pou)
        self.globals()
        self.types(checked)
        for pou in self.pous(checked):
            self.body(pou)
        self.order(checked)
        for configuration in checked.configurations.values():
            self.report.unit = configuration.unit
            self.configuration(configuration)
        return checked

    def sort_elements(self, checked: Checked) -> None:
        """Fill the tables; resolve the types; tell of what is unsupported."""
        for unit in self.library.units:
            self.report.unit = unit
            for element in unit.elements:
                if isinstance(element, Unsupported):
                    self.unsupported(element)
                elif isinstance(element, TypeDecl):
                    self.declare_type(element)
                    checked.types.setdefault(element.name.upper(), element.type)
                elif isinstance(element, Function):
                    checked.functions.setdefault(element.name.upper(), element)
                elif isinstance(element, FunctionBlock):
                    checked.blocks.setdefault(element.name.upper(), element)
                elif isinstance(element, Program):
                    checked.programs.setdefault(element.name.upper(), element)
                elif isinstance(element, Configuration):
                    checked.configurations.setdefault(element.name.upper(), element)

    def unsupported(self, element: Unsupported) -> None:
        """Tell of METHOD, NAMESPACE and the like."""
        text = f"{element.word} {element.name} is not in the Structured Text of the second edition: {_INSTEAD}"
        self.report.add(element.at, "unsupported", text)

    def pous(self, checked: Checked) -> list[Pou]:
        """Every POU."""
        return [*checked.functions.values(), *checked.blocks.values(), *checked.programs.values()]

    def types(self, checked: Checked) -> None:
        """Check the initial values of the declared types."""
        for unit in self.library.units:
            self.report.unit = unit
            for element in unit.elements:
                if isinstance(element, TypeDecl) and element.name.upper() in checked.types:
                    self.check_type(element)

    def globals(self) -> None:
        """Resolve the types of global variables."""
        for unit in self.library.units:
            self.report.unit = unit
            for element in unit.elements:
                if isinstance(element, VarBlock):
                    text = "VAR_GLOBAL outside a CONFIGURATION is refused by matiec: put it into one, or use parameters"
                    self.report.add(element.at, "top-level-global", text)
                    self.global_block(element, {})
                elif isinstance(element, Configuration):
                    for block in element.blocks:
                        self.global_block(block, element.symbols)
                    for resource in element.resources:
                        for block in resource.blocks:
                            self.global_block(block, element.symbols)

    def global_block(self, block: VarBlock, symbols: dict[str, VarDecl]) -> None:
        """The variables of one VAR_GLOBAL."""
        for variable in block.variables:
            variable.type = variable.spec.type if variable.grouped else self.resolver.spec(variable.spec)
            first = symbols.setdefault(variable.name.upper(), variable) if block.kind is VarKind.GLOBAL else variable
            if first is not variable:
                self.report.add(variable.at, "duplicate-name", f"{variable.name} is declared already")
            if variable.initial is not None and not variable.grouped:
                self.symbols = {}
                self.initial(variable.initial, variable.type)
            self.no_block_inside(variable.at, variable.type)

    def body(self, pou: Pou) -> None:
        """Variables and statements of one POU."""
        self.report.unit = pou.unit
        self.called: set[str] = set()
        self.written: set[str] = set()
        self.loops = 0
        self.check_variables(pou)
        for extra in pou.extras:
            self.unsupported(extra)
        if isinstance(pou, FunctionBlock) and pou.heritage:
            self.report.add(pou.name_at, "unsupported", f"{pou.heritage} is not in the second edition: {_INSTEAD}")
        self.symbols = pou.symbols
        self.statements(pou.body)
        self.calls[id(pou)] = self.called
        if isinstance(pou, Function) and pou.name.upper() not in self.written and pou.type is not VOID:
            text = f"expected an assignment to {pou.name} somewhere in FUNCTION {pou.name}: it gives the result"
            self.report.add(pou.name_at, "no-result", text)

    def assignable(self, value: Expression, what: str) -> None:
        """As for every checker; remembers what is written to."""
        super().assignable(value, what)
        root = self.instance_of(value)
        if root is not None:
            self.written.add(root.name.upper())

    @property
    def calls(self) -> dict[int, set[str]]:
        """The functions that each POU calls, by identity."""
        return self.__dict__.setdefault("_calls", {})  # type: ignore[no-any-return]

    def order(self, checked: Checked) -> None:
        """Sort functions and blocks so that callees come first; tell of those that contain themselves."""
        waiting: dict[str, set[str]] = {}
        pous: dict[str, Function | FunctionBlock] = {**checked.functions, **checked.blocks}
        for key, pou in pous.items():
            waiting[key] = {each for each in self.needs(pou) if each in pous}
        users: dict[str, list[str]] = {key: [] for key in pous}
        for key, needed in waiting.items():
            for each in needed:
                users[each].append(key)
        ready = [key for key, needed in waiting.items() if not needed]
        level = dict.fromkeys(ready, 1)
        for key in ready:
            checked.callees_first.append(pous[key])
            for user in users[key]:
                waiting[user].discard(key)
                level[user] = max(level.get(user, 1), level[key] + 1)
                if not waiting[user]:
                    ready.append(user)
        self.tell_cycles(pous, set(pous) - set(ready), level)

    def tell_cycles(self, pous: dict[str, Function | FunctionBlock], cyclic: set[str], level: dict[str, int]) -> None:
        """Tell of POUs that call or contain themselves, and of towers of blocks."""
        for key, pou in pous.items():
            self.report.unit = pou.unit
            if key in cyclic:
                text = f"{pou.name} calls or contains itself, directly or through another: ST has no recursion"
                self.report.add(pou.name_at, "recursion", text)
            elif level.get(key, 1) > DEEPEST_BLOCKS:
                text = f"expected at most {DEEPEST_BLOCKS} levels of calls below {pou.name}"
                self.report.add(pou.name_at, "recursion", text)

    def needs(self, pou: Pou) -> list[str]:
        """The functions and blocks that a POU calls or contains, by upper-case name, each once."""
        found = dict.fromkeys(sorted(self.calls.get(id(pou), ())))
        for variable in pou.symbols.values():
            made: Type = variable.type
            while isinstance(made, Array):
                made = made.element
            if isinstance(made, Block) and made.declaration is not None:
                found[made.name.upper()] = None
        return list(found)

    def configuration(self, configuration: Configuration) -> None:
        """Tasks and program instances."""
        self.symbols = configuration.symbols
        for resource in configuration.resources:
            tasks = self.tasks(resource)
            names: set[str] = set()
            for instance in resource.programs:
                if instance.name.upper() in names:
                    self.report.add(instance.at, "duplicate-name", f"{instance.name} is declared already")
                names.add(instance.name.upper())
                self.program_instance(instance, tasks)

    def tasks(self, resource: Resource) -> dict[str, Task]:
        """The tasks of a resource by upper-case name."""
        made: dict[str, Task] = {}
        for task in resource.tasks:
            if made.setdefault(task.name.upper(), task) is not task:
                self.report.add(task.at, "duplicate-name", f"the task {task.name} is declared already")
            for value, wanted in ((task.single, BOOL), (task.interval, TIME), (task.priority, INT)):
                if value is not None:
                    self.wanted(value, wanted)
            if task.single is None and task.interval is None:
                self.report.add(task.at, "call-arguments", f"expected SINGLE or INTERVAL for the task {task.name}")
        return made

    def program_instance(self, instance: ProgramInstance, tasks: dict[str, Task]) -> None:
        """One program instance and what its variables are connected to."""
        found = self.library.find(instance.type_name)
        if not isinstance(found, Program):
            text = f"expected the name of a program, found {instance.type_name}"
            self.report.add(instance.at, "undeclared-name", text)
            return
        instance.target = found
        if instance.task is not None:
            instance.task_target = tasks.get(instance.task.upper())
            if instance.task_target is None:
                text = f"expected the name of a task of this resource, found {instance.task}"
                self.report.add(instance.at, "undeclared-name", text)
        parameters = found.type.parameters if found.type else {}
        for argument in instance.connections:
            parameter = parameters.get((argument.name or "").upper())
            if parameter is None or argument.value is None:
                shown = argument.name or "a bare value"
                text = f"expected an input or output of {found.name}, found {shown}"
                self.report.add(argument.at, "call-arguments", text)
            elif isinstance(argument.value, Name) or not argument.output:
                self.check_binding(argument, parameter)


_INSTEAD = "use a function block with an input that selects what to do"
