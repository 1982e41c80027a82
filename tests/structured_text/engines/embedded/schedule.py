"""A CONFIGURATION with its resources, tasks and programs on virtual time (IEC 61131-3 clause 2.7)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import repeat
from math import gcd
from typing import Any

from structured_text.engines.embedded import EmbeddedLibrary
from structured_text.engines.embedded.certainty import present
from structured_text.engines.embedded.faults import FAULTS, scan_error
from structured_text.engines.embedded.global_variables import GlobalsView, globals_in, globals_of
from structured_text.engines.engine import Value
from structured_text.language import tree
from structured_text.language.tree import Block, Direction, Parameter
from structured_text.language.types import INT, TIME, Kind

LAST = 65536
"""The priority of a program without a task."""


@dataclass(slots=True)
class _Program:
    """A program instance: due every `ticks` ticks (0: in each), by the priority of its task."""

    ticks: int
    priority: int
    root: Any
    body: Callable[[Any], None]


class EmbeddedConfiguration:
    """A running configuration. In one tick the programs that are due run by the priority of their task (0 first),
    then in the order of declaration.
    """

    def __init__(self, library: EmbeddedLibrary, configuration: tree.Configuration) -> None:
        """Make the globals and the programs."""
        self._compiler = library.compiler
        self._configuration = configuration
        self._paths_of = library.paths
        self._limit = library.loop_limit
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
        for each in self._programs:
            if each.ticks == 0 or self._tick % each.ticks == 0:
                each.body(each.root)

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
        programs = [self._program(resource, each) for each in resource.programs]
        return sorted(programs, key=lambda each: each.priority)

    def _program(self, resource: tree.Resource, program: tree.ProgramInstance) -> _Program:
        block = present(present(program.target).type)
        root = self._compiler.instance(block, self._globals)
        name = f"{resource.name}.{program.name}" if resource.name else program.name
        self._roots[name.upper()] = block, root
        ticks, priority = 0, LAST
        if (task := program.task_target) is not None:
            ticks = self._duration(task) // self._interval if self._interval else 0
            priority = 0 if task.priority is None else self._compiler.evaluate(task.priority, INT)
        return _Program(ticks, priority, root, self._compiler.body(block))

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


def start(library: EmbeddedLibrary, name: str | None = None) -> EmbeddedConfiguration:
    """Start the CONFIGURATION of that name, or the only one. KeyError."""
    known = library.compiler.checked.configurations
    if name is None and len(known) != 1:
        raise KeyError(f"there are {len(known)} configurations: say which")
    found = next(iter(known.values())) if name is None else known.get(name.upper())
    if found is None:
        raise KeyError(f"there is no configuration {name}")
    return EmbeddedConfiguration(library, found)
