"""A CONFIGURATION with its resources, tasks and programs on virtual time (IEC 61131-3 clause 2.7)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from itertools import repeat
from math import gcd
from typing import Any

from structured_text.engines.embedded import EmbeddedLibrary
from structured_text.engines.embedded.certainty import known, present
from structured_text.engines.embedded.faults import FAULTS, scan_error
from structured_text.engines.embedded.global_variables import GlobalsView, globals_in, globals_of
from structured_text.engines.engine import Value
from structured_text.language import tree
from structured_text.language.tree import Block, Direction, Parameter, VarKind
from structured_text.language.types import BOOL, INT, TIME, Kind


@dataclass(slots=True)
class _Task:
    """When programs are due: every `ticks` ticks (0: not by time), or on a rising edge of `single`."""

    ticks: int
    single: Callable[[], bool] | None
    priority: int
    memory: bool = False

    def is_due(self, tick: int) -> bool:
        """Whether to run in this tick. A task with SINGLE is looked at once per tick."""
        if self.single is not None:
            before, self.memory = self.memory, bool(self.single())
            return self.memory and not before
        return self.ticks == 0 or tick % self.ticks == 0


@dataclass(slots=True)
class _Program:
    """A program instance: what hands it its inputs, its body, what takes its outputs."""

    task: _Task | None
    root: Any
    before: list[Callable[[], None]] = field(default_factory=list)
    body: Callable[[Any], None] = lambda _: None
    after: list[Callable[[], None]] = field(default_factory=list)

    def run(self) -> None:
        """One scan of this program."""
        for each in self.before:
            each()
        self.body(self.root)
        for each in self.after:
            each()


class EmbeddedConfiguration:
    """A running configuration. In one tick the programs that are due run by the priority of their task (0 first),
    then in the order of declaration; without `by_priority` in the order of declaration alone, as on matiec.
    """

    def __init__(self, library: EmbeddedLibrary, configuration: tree.Configuration, by_priority: bool = True) -> None:
        """Make the globals and the programs."""
        self._compiler = library.compiler
        self._configuration = configuration
        self._paths_of = library.paths
        self._limit = library.loop_limit
        self._by_priority = by_priority
        self._globals = globals_of(library.compiler)
        self._roots: dict[str, tuple[Block, Any]] = {}
        self._tick = 0
        self._interval = self._common_interval()
        self._enter_globals()
        self._programs = [each for resource in configuration.resources for each in self._resource(resource)]

    @property
    def tick_ns(self) -> int:
        """The greatest common divisor of the intervals of all tasks, in nanoseconds."""
        return self._interval

    def run(self, ticks: int = 1) -> None:
        """Run this many ticks. ScanError."""
        run = self._compiler.run
        for _ in range(ticks):
            run.now = self._tick * self._interval
            run.budget = repeat(None, self._limit)
            try:
                self._run_tick()
            except FAULTS as error:
                raise scan_error(error, self._compiler.accesses) from error
            self._tick += 1

    def __getitem__(self, path: str) -> Value:
        """Read `Resource.Program.Variable` or a global. KeyError."""
        block, root, rest = self._split(path)
        return self._paths_of(block).read(root, rest)

    def __setitem__(self, path: str, value: Value) -> None:
        """Write `Resource.Program.Variable` or a global. KeyError, ValueError."""
        block, root, rest = self._split(path)
        self._paths_of(block).write(root, rest, value)

    def state(self) -> dict[str, Value]:
        """Every scalar: globals, then programs."""
        found: dict[str, Value] = {}
        for name, (block, root) in self._roots.items():
            for path, value in self._paths_of(block).state(root).items():
                found[f"{name}.{path}" if name else path] = value
        return found

    # ------------------------------------------------------------ in detail

    def _run_tick(self) -> None:
        due = {id(each.task): each.task is None or each.task.is_due(self._tick) for each in self._first_of_tasks()}
        for each in self._programs:
            if due[id(each.task)]:
                each.run()

    def _first_of_tasks(self) -> Iterator[_Program]:
        """One program of each task, so that every task is asked once."""
        seen: set[int] = set()
        for each in self._programs:
            if id(each.task) not in seen:
                seen.add(id(each.task))
                yield each

    def _common_interval(self) -> int:
        tasks = [each for resource in self._configuration.resources for each in resource.tasks]
        return gcd(*(self._duration(each) for each in tasks))

    def _duration(self, task: tree.Task) -> int:
        """The interval in nanoseconds; 0 if there is none."""
        return 0 if task.interval is None else int(self._compiler.evaluate(task.interval, TIME))

    def _enter_globals(self) -> None:
        """Make globals readable by path: those of the configuration by name, those of a resource after its name."""
        owners: dict[str, Block] = {}
        for owner, variable in globals_in(self._configuration):
            block = owners.setdefault(owner.upper(), Block(owner, Kind.BLOCK))
            slot = self._compiler.shapes.global_slot(variable)
            block.parameters[variable.name.upper()] = Parameter(slot, variable.type, Direction.INPUT)
        for owner, block in owners.items():
            self._roots[owner] = (
                block,
                GlobalsView(self._globals, {name: each.name for name, each in block.parameters.items()}),
            )

    def _resource(self, resource: tree.Resource) -> list[_Program]:
        tasks = {id(each): self._task(each) for each in resource.tasks}
        programs = [self._program(resource, each, tasks) for each in resource.programs]
        if self._by_priority:
            last = max((each.priority for each in tasks.values()), default=0) + 1
            programs.sort(key=lambda each: each.task.priority if each.task else last)
        return programs

    def _task(self, task: tree.Task) -> _Task:
        priority = 0 if task.priority is None else self._compiler.evaluate(task.priority, INT)
        ticks = self._duration(task) // self._interval if self._interval else 0
        single = None if task.single is None else self._reader(task.single)
        return _Task(ticks, single, priority)

    def _program(self, resource: tree.Resource, program: tree.ProgramInstance, tasks: dict[int, _Task]) -> _Program:
        block = present(present(program.target).type)
        root = self._compiler.instance(block, self._globals)
        name = f"{resource.name}.{program.name}" if resource.name else program.name
        self._roots[name.upper()] = block, root
        task = None if program.task_target is None else tasks[id(program.task_target)]
        made = _Program(task, root, body=self._compiler.body(block))
        for each in program.connections:
            self._connect(each, block, root, made)
        return made

    def _connect(self, argument: tree.Argument, block: Block, root: Any, program: _Program) -> None:
        """`input := global` or `output => global` of a program instance."""
        if argument.value is None or argument.name is None:
            return
        name = argument.name.upper()
        if argument.output:
            write = self._writer(argument.value)
            program.after.append(lambda: write(getattr(root, name)))
        else:
            read = self._reader(argument.value, block.parameters[name].type)
            program.before.append(lambda: setattr(root, name, read()))

    def _reader(self, source: tree.Expression, kind: Any = None) -> Callable[[], Any]:
        variable = source.symbol if isinstance(source, tree.Name) else None
        if isinstance(variable, tree.VarDecl) and variable.kind is VarKind.GLOBAL:
            slot = self._compiler.shapes.global_slot(variable)
            return lambda: getattr(self._globals, slot)
        value = self._compiler.evaluate(source, kind or BOOL)
        return lambda: value

    def _writer(self, target: tree.Expression) -> Callable[[Any], None]:
        variable = known(known(target, tree.Name).symbol, tree.VarDecl)
        slot = self._compiler.shapes.global_slot(variable)
        return lambda value: setattr(self._globals, slot, value)

    def _split(self, path: str) -> tuple[Block, Any, str]:
        """The root that a path starts with, and the rest of the path. KeyError."""
        upper = path.upper()
        for name, (block, root) in self._roots.items():
            if name and upper.startswith(f"{name}."):
                rest = path[len(name) + 1 :]
                if rest.split(".")[0].split("[")[0].upper() in _names(block):
                    return block, root, rest
        if "" in self._roots:
            return *self._roots[""], path
        raise KeyError(path)


def _names(block: Block) -> set[str]:
    if block.declaration is None:
        return set(block.parameters)
    return set(block.declaration.symbols)


def start(library: EmbeddedLibrary, name: str | None = None, by_priority: bool = True) -> EmbeddedConfiguration:
    """Start the CONFIGURATION of that name, or the only one. KeyError."""
    known = library.compiler.checked.configurations
    if name is None and len(known) != 1:
        raise KeyError(f"there are {len(known)} configurations: say which")
    found = next(iter(known.values())) if name is None else known.get(name.upper())
    if found is None:
        raise KeyError(f"there is no configuration {name}")
    return EmbeddedConfiguration(library, found, by_priority)
