"""What a build gives: instances and function calls."""

import ctypes
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

from structured_text.engines.coverage import Branches, Lines
from structured_text.engines.engine import EngineError, Message, ScanError, Value
from structured_text.engines.matiec.binary import Built, cause
from structured_text.engines.matiec.counters import COUNTS, Counters
from structured_text.engines.matiec.declarations import Unit, integer
from structured_text.engines.matiec.layout import Memory, RecordNode, Snapshot
from structured_text.engines.matiec.paths import Paths
from structured_text.engines.matiec.plan import Signature


@dataclass
class BlockType:
    """What all instances of a block share."""

    name: str
    node: RecordNode
    path: str
    line: int
    init: Callable[..., int]
    scan: Callable[..., int]
    many: Callable[..., int]

    @cached_property
    def paths(self) -> Paths:
        return Paths(self.node)

    @cached_property
    def snapshot(self) -> Snapshot:
        return Snapshot(self.node)

    def trap(self, number: int) -> ScanError:
        """Say which signal ended a scan; C does not give the line."""
        return ScanError(Message(self.path, self.line, 0, f"{self.name}: the scan was stopped by {cause(number)}"))


@dataclass
class Clock:
    """Where the time of a library is; the C has it in a variable that all loads of the same file share."""

    now: int = 0


class MatiecInstance:
    """An instance in zeroed memory of its own, on the clock of its library."""

    def __init__(self, block: BlockType, clock: Clock) -> None:
        self._block = block
        self._memory: Memory = ctypes.create_string_buffer(block.node.size)
        self._address = ctypes.c_void_p(ctypes.addressof(self._memory))
        self._scan = block.scan
        self._clock = clock
        block.init(self._address)

    def __getitem__(self, path: str) -> Value:
        _refuse_empty(path)
        return self._block.paths.read(self._memory, path)

    def __setitem__(self, path: str, value: Value) -> None:
        _refuse_empty(path)
        self._block.paths.write(self._memory, path, value)

    def scan(self, now_ns: int | None = None) -> None:
        if now_ns is None:
            now_ns = self._clock.now
        else:
            self._clock.now = now_ns
        trap = self._scan(self._address, now_ns)
        if trap:
            raise self._block.trap(trap)

    def scan_many(self, count: int, now_ns: int | None = None, step_ns: int = 0) -> None:
        """Run the body `count` times in one call, the clock `step_ns` later each time. Raises ScanError."""
        start = self._clock.now if now_ns is None else now_ns
        trap = self._block.many(self._address, start, step_ns, count)
        self._clock.now = start + max(count - 1, 0) * step_ns
        if trap:
            raise self._block.trap(trap)

    def state(self) -> dict[str, Value]:
        return self._block.snapshot.read(self._memory)


def _refuse_empty(path: str) -> None:
    if not path:
        raise KeyError("an empty path names no variable")


class MatiecLibrary:
    """Compiled sources. `warnings`: what both compilers said; `folder`: the C, as long as the cache has it."""

    def __init__(self, built: Built) -> None:
        self.warnings = built.warnings
        self.folder = built.folder
        self.built = built
        self._binary = built.binary
        self._types: dict[str, BlockType] = {}
        self._clock = Clock()
        size = len(built.counters.lines) if built.counters else 0
        self._before = {table: built.binary.counts(table, size) if size else [] for table in COUNTS}
        self.counting = [built.binary]

    def blocks(self) -> Iterator[str]:
        """The function blocks and programs, spelled as declared."""
        for unit in self.built.declared.units.values():
            if unit.kind in ("FUNCTION_BLOCK", "PROGRAM"):
                yield unit.name

    def instance(self, type_name: str) -> MatiecInstance:
        return MatiecInstance(self._type(type_name.upper()), self._clock)

    def _type(self, name: str) -> BlockType:
        if name not in self._types:
            node = self.built.plan.blocks.get(name)
            if node is None:
                raise KeyError(f"there is no function block or program {name}")
            self._types[name] = self._bind(name, node)
        return self._types[name]

    def _bind(self, name: str, node: RecordNode) -> BlockType:
        unit = self.built.declared.units.get(name)
        pointer, number = ctypes.c_void_p, ctypes.c_int64
        return BlockType(
            unit.name if unit else name,
            node,
            *self.built.place(name),
            self._binary.function(f"dbk_init_{name}", pointer),
            self._binary.function(f"dbk_scan_{name}", pointer, number),
            self._binary.function(f"dbk_many_{name}", pointer, number, number, number),
        )

    def call(self, function: str, arguments: Mapping[str, Value]) -> Value:
        """Call a function by its formal parameters; one that is left out has its default."""
        name = function.upper()
        signature = self.built.plan.functions.get(name)
        if signature is None:
            raise KeyError(f"there is no function {function}")
        given = {each.upper(): value for each, value in arguments.items()}
        if unknown := [each for each in given if each not in signature.parameters]:
            raise KeyError(f"{function} has no parameter {', '.join(unknown)}")
        memories = self._arguments(name, signature, given)
        result: Memory = ctypes.create_string_buffer(signature.result.size)
        cells = (ctypes.c_void_p * (len(memories) + 1))(*map(ctypes.addressof, (result, *memories)))
        trap = self._binary.function(f"dbk_call_{name}", ctypes.c_void_p)(ctypes.addressof(cells))
        if trap:
            path, line = self.built.place(name)
            raise ScanError(Message(path, line, 0, f"{function}: the call was stopped by {cause(trap)}"))
        return signature.result.read(result, 0)

    def _arguments(self, name: str, signature: Signature, given: Mapping[str, Value]) -> list[Memory]:
        unit = self.built.declared.units.get(name) or Unit("FUNCTION", name)
        memories: list[Memory] = []
        for each, node in signature.parameters.items():
            memory: Memory = ctypes.create_string_buffer(node.size)
            variable = unit.variables.get(each)
            if each in given:
                node.write(memory, 0, given[each])
            elif variable is not None and (initial := self.built.declared.initial(variable)) is not None:
                node.write(memory, 0, constant(initial))
            memories.append(memory)
        return memories

    def coverage(self) -> Lines:
        """How often each line with a statement has run: path -> line -> hits. Empty unless built for coverage."""
        counters = self.built.counters
        return {} if counters is None else counters.hits(self._counts(counters, "dbk_hits"))

    def branches(self) -> Branches:
        """How often each outcome of each decision came about: path -> outcome -> hits. Empty unless for coverage.

        Raises EngineError where the statements of the C are not those of the ST.
        """
        counters = self.built.counters
        if counters is None:
            return {}
        hits, begun = (self._counts(counters, table) for table in COUNTS)
        return counters.branches(hits, begun)

    def _counts(self, counters: Counters, table: str) -> list[int]:
        """Counts since this library was built: the C has one set for all that load the same file."""
        tables = [each.counts(table, len(counters.lines)) for each in self.counting]
        return [sum(counts) - before for before, *counts in zip(self._before[table], *tables, strict=True)]


_MS = 1_000_000
_NANOSECONDS = {"d": 86_400_000 * _MS, "h": 3_600_000 * _MS, "m": 60_000 * _MS, "s": 1_000 * _MS, "ms": _MS}
_DURATION = re.compile(r"(-?)((?:\d[\d_]*(?:\.\d+)?(?:ms|[dhms])_?)+)", re.IGNORECASE)
_PART = re.compile(r"([\d_]+(?:\.\d+)?)(ms|[dhms])", re.IGNORECASE)
_STRING_ESCAPES = {"$$": b"$", "$'": b"'", "$L": b"\n", "$N": b"\n", "$P": b"\f", "$R": b"\r", "$T": b"\t"}
_ESCAPE = re.compile(r"\$[0-9A-F]{2}|\$.|[^$]", re.IGNORECASE)


def constant(text: str) -> Value:
    """Read `TRUE`, `BYTE#16#FF`, `-5`, `1.5E3`, `T#1s500ms` or `'abc$0D'`. Raises EngineError for anything else."""
    plain = text.strip()
    if plain.upper().removeprefix("BOOL#") in ("TRUE", "FALSE"):
        return plain.upper().endswith("TRUE")
    if plain.startswith("'"):
        return b"".join(_character(each) for each in _ESCAPE.findall(plain[1:-1]))
    prefix, _, rest = plain.rpartition("#")
    try:
        if prefix.upper() in ("T", "TIME"):
            return _duration(rest)
        if "16#" not in plain and ("." in rest or "E" in rest.upper()):
            return float(rest.replace("_", ""))
        return integer(plain)
    except ValueError as error:
        raise EngineError(f"{text} as the default of a parameter cannot be read here; give the argument") from error


def _character(text: str) -> bytes:
    if len(text) == 3:
        return bytes([int(text[1:], 16)])
    return _STRING_ESCAPES.get(text.upper(), text.encode("latin-1", "replace"))


def _duration(text: str) -> int:
    match = _DURATION.fullmatch(text)
    if match is None:
        raise ValueError(text)
    parts = _PART.findall(match[2])
    total = sum(round(float(number.replace("_", "")) * _NANOSECONDS[unit.lower()]) for number, unit in parts)
    return -total if match[1] else total
