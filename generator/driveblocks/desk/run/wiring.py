"""Where a program reaches its serial port, its lines and its drives: found in the typed tree, not by names."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from driveblocks.render.library import LINE_SIZES
from structured_text.engines.embedded.certainty import present
from structured_text.engines.engine import BuildError, Message
from structured_text.language import tree
from structured_text.language.tree import (
    Binding,
    Block,
    Direction,
    Expression,
    FunctionBlock,
    Pou,
    Program,
    VarDecl,
    VarKind,
)
from structured_text.language.types import Elementary
from structured_text.language.walk import statements

LINES = {f"MB_LINE{slots}" for slots in LINE_SIZES}
BYTE_LINES = {f"MB_BYTELINE{slots}" for slots in LINE_SIZES}
UNPLACED = "?"
"""In a path: an instance that is not always the same one."""
DRIVE = "_DRIVE"
"""The end of the type of a drive block."""
HARD_STOP = "VFD_HARDSTOP"

_UNPLACED = "this may be one {} or another, so it could not be stopped at the end; call each by its name or a number"


@dataclass(frozen=True)
class DriveBlock:
    """A drive block: the path of its instance, and the prefix of its family."""

    path: str
    prefix: str


@dataclass(frozen=True)
class LineWiring:
    """Paths of what the scan loop reads and writes of one line; those that it writes are written by nothing else."""

    line: str
    """Instance of the line."""
    pins: dict[str, str | None]
    """Inputs of the line that the port fills: a variable, or the pin itself where the call omits it."""
    notes: tuple[Message, ...]
    port: str | None = None
    """The MB_Port, of a line without mailbox."""
    rx_count: str = ""
    rx_chars: str = ""
    tx_chars: str = ""
    drives: tuple[DriveBlock, ...] = ()


@dataclass(frozen=True)
class Wiring:
    """The lines of a program, in the order of its calls, and what belongs to none of them."""

    lines: tuple[LineWiring, ...]
    restart: tuple[str, ...] = ()
    drives: tuple[DriveBlock, ...] = ()
    """Of all lines."""
    inputs: tuple[str, ...] = ()
    """What a person at the keyboard may set: the program's inputs, what else feeds its drives and its lines, and the
    button that resets a VFD_HardStop."""


@dataclass(frozen=True)
class _Frame:
    """A POU as one of its instances: `prefix` comes before its variables."""

    pou: Pou
    prefix: str = ""
    bindings: dict[str, Expression | None] = field(default_factory=dict)
    outer: "_Frame | None" = None


@dataclass(frozen=True)
class _Call:
    frame: _Frame
    call: tree.Call
    block: Block
    path: str

    @property
    def bindings(self) -> dict[str, Binding]:
        return {each.parameter.name.upper(): each for each in self.call.bindings}


def find(program: Program, prefixes: set[str]) -> Wiring:
    """The wiring of a program; `prefixes` are those of the families known. Raises BuildError."""
    frame = _Frame(program)
    calls = list(_calls(frame))
    written = {path.upper() for path in _written(calls, frame)}
    lines = {each.path.upper(): each for each in calls if each.block.name.upper() in LINES | BYTE_LINES}
    drive_types = {f"{prefix}{DRIVE}" for prefix in prefixes}
    blocks = [each for each in calls if each.block.name.upper() in drive_types]
    if unplaced := [each for each in (*blocks, *lines.values()) if UNPLACED in each.path]:
        raise BuildError([_told(each, _UNPLACED.format(each.block.name)) for each in unplaced])
    if not lines:
        raise BuildError([_no_port(program)])
    wired = tuple(_port(each, blocks, written, alone=len(lines) == 1) for each in lines.values())
    _judge_ports(list(lines.values()), [each.port or each.rx_count for each in wired])
    contacts = [each for each in calls if each.block.name.upper() == HARD_STOP]
    restart = dict.fromkeys(filter(None, (_fed(each, "RESTART", written) for each in (*lines.values(), *contacts))))
    served = {each.upper() for one in wired for each in (one.rx_count, *filter(None, one.pins.values()))}
    inputs = [*_inputs(program), *(path for each in (*blocks, *lines.values()) for path in _feeding(each))]
    inputs += [path for each in contacts for path in _feeding(each, {"RESET"})]
    taken, inside = served | {*map(str.upper, restart)} | written, tuple(_inside(program, calls))
    free = {each.upper(): each for each in inputs if each.upper() not in taken and not each.upper().startswith(inside)}
    return Wiring(wired, tuple(restart), _drives(blocks), tuple(free.values()))


def _inside(program: Program, calls: list[_Call]) -> Iterator[str]:
    """How paths begin that blocks of the library write: their own variables, parts of what is bound to an in-out."""
    for call in calls:
        if isinstance(call.block.declaration, FunctionBlock) and call.block.declaration.unit is program.unit:
            continue
        in_outs = (each for each in call.bindings.values() if each.parameter.direction is Direction.IN_OUT)
        bound = (_path(each.value, call.frame) for each in in_outs)
        for path in filter(None, (call.path, *bound)):
            yield from (f"{path}.".upper(), f"{path}[".upper())


def _drives(blocks: Iterable[_Call]) -> tuple[DriveBlock, ...]:
    drives = {each.path.upper(): DriveBlock(each.path, each.block.name[: -len(DRIVE)].upper()) for each in blocks}
    return tuple(drives.values())


def _inputs(program: Program) -> list[str]:
    """The program's inputs of one value each."""
    found = [each for each in program.symbols.values() if each.kind is VarKind.INPUT]
    return [each.name for each in found if isinstance(each.type, Elementary)]


def _feeding(call: _Call, names: set[str] | None = None) -> Iterator[str]:
    """The variables that feed the inputs of a call, of one value each; all inputs, or those of these names."""
    for name, binding in call.bindings.items():
        source, parameter = _source(call, name), binding.parameter
        single = parameter.direction is Direction.INPUT and isinstance(parameter.type, Elementary)
        if isinstance(source, str) and single and (names is None or name in names):
            yield source


def _port(line: _Call, blocks: list[_Call], written: set[str], *, alone: bool) -> LineWiring:
    """One line with its port and its drives."""
    pins = {name: _pin(line, name, written) for name in ("ELAPSEDMS", "PORTLATEMS", "PORTERRORID")}
    drives = _drives(each for each in blocks if alone or _has_slot(line, each))
    notes = []
    if pins["ELAPSEDMS"] is None and not isinstance(_source(line, "ELAPSEDMS"), str):
        notes.append(
            _told(line, "ElapsedMs is no variable: a late scan is not seen; wire a UINT that is set from here")
        )
    if line.block.name.upper() in LINES:
        port = _needed(line, "PORT", set())
        pins |= {"PORTLATEMS": f"{port}.LateMs", "PORTERRORID": f"{port}.ErrorID"}
        return LineWiring(line.path, pins, tuple(notes), port, drives=drives)
    return LineWiring(
        line.path,
        pins,
        tuple(notes),
        rx_count=_needed(line, "RXCOUNT", written),
        rx_chars=_needed(line, "RXCHARS", set()),
        tx_chars=_needed(line, "TXCHARS", set()),
        drives=drives,
    )


def _has_slot(line: _Call, drive: _Call) -> bool:
    """Whether a drive block has one of the slots of a line."""
    slots, slot = _source(line, "SLOTS"), _source(drive, "SLOT")
    if not isinstance(slot, str):
        wrong = f"it cannot be seen on which line {drive.path} is; give Slot an element of Slots by its number"
        raise BuildError([_told(drive, wrong)])
    return isinstance(slots, str) and slot.upper().startswith(f"{slots.upper()}[")


def _judge_ports(lines: list[_Call], ports: list[str]) -> None:
    """Raises BuildError where two lines have one port."""
    for at, port in enumerate(ports):
        first = next(number for number, each in enumerate(ports) if each.upper() == port.upper())
        if first != at:
            wrong = f"{lines[first].path} and {lines[at].path} share {port}; give each line a port of its own"
            raise BuildError([_told(lines[at], wrong)])


def _no_port(program: Program) -> Message:
    unit = present(program.unit)
    wrong = f"{program.name} calls no line, so it has no port; call an MB_ByteLine8, as README.md of the blocks shows"
    return Message(unit.path, *unit.place(program.name_at), wrong)


def _told(call: _Call, text: str) -> Message:
    unit = present(call.frame.pou.unit)
    return Message(unit.path, *unit.place(call.call.at), text)


# ------------------------------------------------------------ calls


def _calls(frame: _Frame) -> Iterator[_Call]:
    """Every call of a block, those inside blocks of the user's, too, in the order of the source."""
    for statement in statements(frame.pou.body):
        if not isinstance(statement, tree.CallStatement) or not isinstance(statement.call.target, Block):
            continue
        call, block = statement.call, statement.call.target
        path = _path(call.callee, frame) or UNPLACED
        yield _Call(frame, call, block, path)
        inner = block.declaration
        if isinstance(inner, FunctionBlock) and inner.unit is frame.pou.unit:
            bound = {each.parameter.name.upper(): each.value for each in call.bindings}
            yield from _calls(_Frame(inner, f"{path}.", bound, frame))


def _path(expression: Expression | None, frame: _Frame) -> str | None:
    """The path of a variable from the program's instance; None for what is none, or not always the same."""
    if isinstance(expression, tree.Name):
        return _variable(expression, frame)
    if isinstance(expression, tree.Member):
        base = _path(expression.base, frame)
        return None if base is None else f"{base}.{expression.name}"
    if isinstance(expression, tree.Index):
        base = _path(expression.base, frame)
        places = [each.value for each in expression.indices if isinstance(each, tree.Literal)]
        whole = base is not None and len(places) == len(expression.indices)
        return f"{base}[{','.join(map(str, places))}]" if whole else None
    return None


def _variable(name: tree.Name, frame: _Frame) -> str | None:
    variable = name.symbol
    if not isinstance(variable, VarDecl) or variable.constant:
        return None
    if variable.kind is VarKind.EXTERNAL:
        return None if _hidden(variable.name, frame) else variable.name
    if frame.outer and variable.kind in (VarKind.INPUT, VarKind.IN_OUT):
        bound = frame.bindings.get(variable.name.upper())
        if bound is not None or variable.kind is VarKind.IN_OUT:
            return _path(bound, frame.outer)
    return frame.prefix + variable.name


def _hidden(name: str, frame: _Frame) -> bool:
    """Whether the program has a variable of its own with the name of a global."""
    while frame.outer is not None:
        frame = frame.outer
    own = frame.pou.symbols.get(name.upper())
    return isinstance(own, VarDecl) and own.kind is not VarKind.EXTERNAL


def _written(calls: list[_Call], frame: _Frame) -> Iterator[str]:
    """What the program itself writes, by assignments and by outputs of calls."""
    frames = {id(each.frame): each.frame for each in calls} | {id(frame): frame}
    for each in frames.values():
        for statement in statements(each.pou.body):
            if isinstance(statement, tree.Assign):
                yield from filter(None, [_path(statement.target, each)])
            elif isinstance(statement, tree.CallStatement):
                outputs = [one.value for one in statement.call.arguments if one.output]
                yield from filter(None, (_path(one, each) for one in outputs))


# ------------------------------------------------------------ pins


def _source(call: _Call, name: str) -> str | Expression | None:
    """What a pin is fed by: the path of a variable, another expression, or None where the call omits it."""
    binding = call.bindings.get(name)
    if binding is None or binding.value is None:
        return None
    return _path(binding.value, call.frame) or binding.value


def _fed(call: _Call, name: str, written: set[str]) -> str | None:
    """The variable that feeds a pin, if nothing in the program writes it."""
    source = _source(call, name)
    return source if isinstance(source, str) and source.upper() not in written else None


def _pin(call: _Call, name: str, written: set[str]) -> str | None:
    """Where to write for a pin: the variable that feeds it, or the pin itself where the call leaves it alone."""
    if _source(call, name) is None:
        return f"{call.path}.{name}" if name in call.block.parameters else None
    return _fed(call, name, written)


def _needed(call: _Call, name: str, written: set[str]) -> str:
    """The variable behind a pin without which there is no port. Raises BuildError."""
    formal = next(each.name for key, each in call.block.parameters.items() if key == name)
    source = _source(call, name)
    if not isinstance(source, str):
        raise BuildError([_told(call, f"{formal} of {call.path} has no variable of the program; give it one")])
    if source.upper() in written:
        wrong = f"the program writes {source}, which the port has to fill; give {formal} a variable that nothing writes"
        raise BuildError([_told(call, wrong)])
    return source
