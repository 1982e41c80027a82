"""Where a scan went wrong: from a Python exception in compiled ST to a ScanError with line and column."""

import ast
import copy
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import islice
from types import CodeType, FrameType, TracebackType

from structured_text.engines.engine import Message, ScanError

# What the global namespace of compiled ST is marked with, so that its frames are known in a traceback.
MARK = "__structured_text__"


class FaultError(Exception):
    """The run-time library found an error; its place is the ST expression that called it."""


# What compiled ST can raise; anything else is a bug of the engine and keeps its Python traceback.
FAULTS = (FaultError, IndexError, ZeroDivisionError, OverflowError)


@dataclass(slots=True)
class Access:
    """An array access of compiled ST: which bounds, whose, and the Python expression of the offset."""

    name: str
    low: int
    high: int
    offset: ast.expr


@dataclass(slots=True)
class Accesses:
    """Every array access by (path, line, column of the index), so that a message can say which bound was left."""

    table: dict[tuple[str, int, int], Access] = field(default_factory=dict)

    def text(self, path: str, line: int, column: int, frame: FrameType) -> str:
        """Say which index of which array was out of range, from the variables of the frame that failed."""
        access = self.table.get((path, line, column))
        if access is None:
            return "an array index is out of range"
        code = compile(ast.Expression(copy.deepcopy(access.offset)), path, "eval")
        index = eval(code, frame.f_globals, dict(frame.f_locals)) + access.low  # noqa: S307 - our own compiled code
        return f"index {index} of {access.name} is outside {access.low}..{access.high}"


def scan_error(error: BaseException, accesses: Accesses) -> ScanError:
    """Turn an exception of compiled ST into a ScanError at the innermost ST expression of its traceback."""
    found = _innermost(error.__traceback__)
    if found is None:
        if isinstance(error, FaultError):  # a standard block on its own, which is in no source
            return ScanError(Message("(standard block)", 0, 0, str(error)))
        raise error
    frame, line, column = found
    path = frame.f_code.co_filename
    if isinstance(error, IndexError):
        text = str(error) if isinstance(error, BoundsError) else accesses.text(path, line, column, frame)
    elif isinstance(error, ZeroDivisionError):
        text = "division by zero"
    else:
        text = str(error)
    return ScanError(Message(path, line, column, text))


class BoundsError(IndexError):
    """An index out of range whose message is already written."""


def below_bounds(offset: int, name: str, low: int, high: int) -> int:
    """Fail: an index below the first element, which Python would count from the end."""
    raise BoundsError(f"index {offset + low} of {name} is outside {low}..{high}")


def _innermost(traceback: TracebackType | None) -> tuple[FrameType, int, int] | None:
    """The deepest frame of compiled ST and its 1-based line and column."""
    found = None
    while traceback is not None:
        if MARK in traceback.tb_frame.f_globals:
            line, column = _position(traceback.tb_frame.f_code, traceback.tb_lasti)
            found = traceback.tb_frame, line or traceback.tb_lineno, column
        traceback = traceback.tb_next
    return found


def running(frame: FrameType | None) -> Iterator[tuple[CodeType, int, int]]:
    """The bodies of compiled ST that a thread is in, the innermost first, each with its 1-based line and column."""
    while frame is not None:
        if MARK in frame.f_globals:
            line, column = _position(frame.f_code, frame.f_lasti)
            yield frame.f_code, line or frame.f_lineno or 0, column
        frame = frame.f_back


def _position(code: CodeType, instruction: int) -> tuple[int, int]:
    """The line and column (1-based, 0 unknown) of a byte offset in a code object."""
    line, _, column, _ = next(islice(code.co_positions(), instruction // 2, None))
    return line or 0, 0 if column is None else column + 1
