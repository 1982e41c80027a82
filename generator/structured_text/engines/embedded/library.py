"""What a build gives: instances, function calls, configurations, and the lines that were run."""

import copy
from collections.abc import Callable, Iterator, Mapping
from functools import partial
from itertools import repeat
from types import FrameType
from typing import Any

from structured_text.engines.coverage import Branches, Lines
from structured_text.engines.embedded.calls import function_name, returned
from structured_text.engines.embedded.compiler import Compiler
from structured_text.engines.embedded.faults import FAULTS, running, scan_error
from structured_text.engines.embedded.invocation import body_name
from structured_text.engines.embedded.paths import Paths
from structured_text.engines.embedded.shapes import record_class
from structured_text.engines.embedded.values import read, written
from structured_text.engines.engine import Message, Value
from structured_text.language import tree
from structured_text.language.standard import BLOCKS
from structured_text.language.tree import Block, Direction, Parameter, VarKind
from structured_text.language.types import Kind


def global_variables(compiler: Compiler) -> list[tuple[str, tree.VarDecl]]:
    """Every global of the sources with the name of the resource that holds it (empty: the configuration)."""
    found: list[tuple[str, tree.VarDecl]] = []
    for unit in compiler.checked.units:
        for each in unit.elements:
            if isinstance(each, tree.VarBlock):
                found += [("", variable) for variable in each.variables]
    for configuration in compiler.checked.configurations.values():
        found += globals_in(configuration)
    return found


def globals_in(configuration: tree.Configuration) -> Iterator[tuple[str, tree.VarDecl]]:
    """The globals of one configuration with the name of the resource that holds them (empty: itself)."""
    owners = [("", configuration.blocks)] + [(each.name, each.blocks) for each in configuration.resources]
    for owner, blocks in owners:
        for block in blocks:
            if block.kind is VarKind.GLOBAL:
                yield from ((owner, variable) for variable in block.variables)


def globals_of(compiler: Compiler) -> Any:
    """A fresh set of all globals with their initial values; instances refer to it."""
    variables = [each for _, each in global_variables(compiler)]
    slots = [compiler.shapes.global_slot(each) for each in variables]
    made = record_class("Globals", tuple(slots))()
    for slot, each in zip(slots, variables, strict=True):
        setattr(made, slot, compiler.shapes.maker(each.type, each.start)(made))
    return made


def globals_block(compiler: Compiler) -> tuple[Block, dict[str, str]]:
    """All globals as variables of one block, whoever owns them, and the slot behind each name."""
    block, slots = Block("", Kind.BLOCK), dict[str, str]()
    for _, each in global_variables(compiler):
        slot = slots.setdefault(each.name.upper(), compiler.shapes.global_slot(each))
        block.parameters.setdefault(each.name.upper(), Parameter(slot, each.type, Direction.INPUT))
    return block, slots


class GlobalsView:
    """Globals under their own names, for paths."""

    __slots__ = ("names", "target")

    def __init__(self, target: Any, names: dict[str, str]) -> None:
        object.__setattr__(self, "target", target)
        object.__setattr__(self, "names", names)

    def __getattr__(self, name: str) -> Any:
        return getattr(self.target, self.names[name])

    def __setattr__(self, name: str, value: Any) -> None:
        setattr(self.target, self.names[name], value)


class EmbeddedInstance:
    """An instance of a function block or program; `scan` is made for it alone, to cost one call."""

    __slots__ = ("_globals", "_paths", "_root", "_scanner", "scan")

    scan: Callable[..., None]

    def __init__(
        self, paths: Paths, root: Any, scanner: Callable[[Any], Callable[..., None]], shared: tuple[Paths, Any] | None
    ) -> None:
        """Take the inner instance, what makes the function that runs it, and the globals, if there are any."""
        self._paths = paths
        self._root = root
        self._globals = shared
        self._scanner = scanner
        self.scan = scanner(root)

    def __deepcopy__(self, memo: dict[int, Any]) -> "EmbeddedInstance":
        """Another one in the same state; globals stay those of this one."""
        return EmbeddedInstance(self._paths, copy.deepcopy(self._root, memo), self._scanner, self._globals)

    def __getitem__(self, path: str) -> Value:
        try:
            return self._paths.read(self._root, path)
        except KeyError:
            if self._globals is None:
                raise
            paths, root = self._globals
            return paths.read(root, path)

    def __setitem__(self, path: str, value: Value) -> None:
        try:
            self._paths.write(self._root, path, value)
        except KeyError:
            if self._globals is None:
                raise
            paths, root = self._globals
            paths.write(root, path, value)

    def state(self) -> dict[str, Value]:
        """Every scalar, path in upper case -> value, in the order of declaration."""
        return self._paths.state(self._root)


class EmbeddedLibrary:
    def __init__(self, compiler: Compiler, loop_limit: int) -> None:
        """Take what the compiler has made; a scan may take `loop_limit` turns of loops."""
        self.compiler = compiler
        self.loop_limit = loop_limit
        self._paths: dict[Block, Paths] = {}
        self._globals = globals_block(compiler)

    def blocks(self) -> Iterator[str]:
        """The function blocks and programs in source order, spelled as declared."""
        for unit in self.compiler.checked.units:
            for each in unit.elements:
                if isinstance(each, tree.FunctionBlock | tree.Program):
                    yield each.name

    def instance(self, type_name: str) -> EmbeddedInstance:
        """Make an instance of a block or program of the sources, or of a standard block. KeyError."""
        block = self._block(type_name.upper())
        made = globals_of(self.compiler)
        root = self.compiler.instance(block, made)
        known, slots = self._globals
        shared = (self.paths(known), GlobalsView(made, slots)) if slots else None
        return EmbeddedInstance(self.paths(block), root, partial(self._scanner, block), shared)

    def paths(self, block: Block) -> Paths:
        """The paths of a block's variables, made at the first call."""
        if block not in self._paths:
            self._paths[block] = Paths(block)
        return self._paths[block]

    def call(self, function: str, arguments: Mapping[str, Value]) -> Value:
        """Call a function by its formal parameters; one that is left out has its default. KeyError, ScanError.

        Arrays and structures that are bound to in-outs are copies: the caller's list stays as it was.
        """
        found = self.compiler.checked.functions.get(function.upper())
        if found is None:
            raise KeyError(f"there is no function {function}")
        given = {name.upper(): value for name, value in arguments.items()}
        if unknown := [each for each in given if each not in found.parameters]:
            raise KeyError(f"{function} has no parameter {', '.join(unknown)}")
        inner = [
            self._argument(each, given)
            for name, each in found.parameters.items()
            if each.direction is not Direction.OUTPUT
        ]
        run = self.compiler.run
        run.budget = repeat(None, self.loop_limit)
        try:
            result = self.compiler.function(found)(*inner)
        except FAULTS as error:
            raise scan_error(error, self.compiler.accesses) from error
        return read(found.type, result[0] if returned(found) else result)

    def running(self, frame: FrameType | None) -> list[Message]:
        """Where a thread is in compiled ST, the innermost place first; each text is the name of a block or function.

        `frame` is the thread's, of `sys._current_frames()`; the thread may go on meanwhile.
        """
        checked = self.compiler.checked
        names = {function_name(each): each.name for each in checked.functions.values()}
        pous: list[tree.FunctionBlock | tree.Program] = [*checked.blocks.values(), *checked.programs.values()]
        names |= {body_name(each.type): each.name for each in pous if each.type is not None}
        return [
            Message(code.co_filename, line, column, names.get(code.co_name, code.co_name))
            for code, line, column in running(frame)
        ]

    def coverage(self) -> Lines:
        """How often each line with a statement has run: path -> line -> hits. Empty unless built for coverage."""
        return self._counters("hits_")

    def branches(self) -> Branches:
        """How often each outcome of each decision came about: path -> outcome -> hits. Empty unless for coverage."""
        return self._counters("outcomes_")

    def _counters(self, prefix: str) -> dict[str, dict[Any, int]]:
        objects = self.compiler.objects
        found = {name: places for name, places in objects.items() if name.startswith(prefix)}
        counts = objects.get("counts", [])
        return {
            name.removeprefix(prefix): {what: counts[at] for what, at in sorted(places.items())}
            for name, places in found.items()
        }

    # ------------------------------------------------------------ in detail

    def _block(self, name: str) -> Block:
        pou = self.compiler.checked.blocks.get(name) or self.compiler.checked.programs.get(name)
        block = pou.type if pou else BLOCKS.get(name)
        if block is None:
            raise KeyError(f"there is no function block or program {name}")
        return block

    def _argument(self, parameter: Any, given: dict[str, Value]) -> Any:
        value = self.compiler.shapes.maker(parameter.type, parameter.default)(None)
        name = parameter.name.upper()
        return written(parameter.type, value, given[name]) if name in given else value

    def _scanner(self, block: Block, root: Any) -> Callable[..., None]:
        """The `scan` of an instance: clock, budget, body, and the way from an exception to a ScanError."""
        run, body, accesses = self.compiler.run, self.compiler.body(block), self.compiler.accesses
        limit = self.loop_limit if block in self.compiler.looping else 0

        def scan(now_ns: int | None = None) -> None:
            """Run the body once with the clock at `now_ns` nanoseconds (None: as it is). Raises ScanError."""
            if now_ns is not None:
                run.now = now_ns
            if limit:
                run.budget = repeat(None, limit)
            try:
                body(root)
            except FAULTS as error:
                raise scan_error(error, accesses) from error

        return scan
