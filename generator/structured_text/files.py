"""The one door for files: a reader of every input, a writer of every output, and the sources that a user names."""

import errno
import os
import secrets
import stat
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from io import FileIO
from pathlib import Path

from structured_text.visible import file_name

MOST_TEXT = 8 << 20
"""A text of more is no source and no table; the largest library in public use has a tenth of it."""
MOST_BYTES = 256 << 20
_BINARY, _AT_ONCE = getattr(os, "O_BINARY", 0), getattr(os, "O_NONBLOCK", 0)
_NO_LINK = os.O_CREAT | getattr(os, "O_NOFOLLOW", 0)  # Windows has none


class BadFile(OSError):  # noqa: N818  (bad input is no error of the program)
    """A file that is no input: why, what would be right if that can be said, and a place, 1-based line and column."""

    def __init__(self, path: Path, why: str, right: str = "", at: tuple[int, int] = (1, 1)) -> None:
        """Keep all of it."""
        super().__init__(errno.EINVAL, why, str(path))
        self.why, self.right, self.at = why, right, at

    def __str__(self) -> str:
        """Print as `file:line:column: cannot be read: why; what would be right`."""
        line, column = self.at
        right = f"; {self.right}" if self.right else ""
        return f"{file_name(self.filename)}:{line}:{column}: cannot be read: {self.why}{right}"


def text(path: Path, most: int = MOST_TEXT) -> str:
    """The text of a file in UTF-8, without a byte order mark, lines ending as in UNIX. Raises BadFile."""
    found = data(path, most).removeprefix(b"\xef\xbb\xbf").replace(b"\r\n", b"\n")
    try:
        whole = found.decode()
    except UnicodeDecodeError as error:
        at = place(found[: error.start].decode())
        raise BadFile(path, f"it is not UTF-8: byte {found[error.start]:02X}H", "save it as UTF-8", at) from None
    if "\0" in whole:
        raise BadFile(path, "it is no text: byte 00H", "name a file of text", place(whole[: whole.index("\0")]))
    return whole


def place(before: str) -> tuple[int, int]:
    """Line and column, 1-based, of what follows a text."""
    return before.count("\n") + 1, len(before) - before.rfind("\n")


def data(path: Path, most: int = MOST_BYTES) -> bytes:
    """All bytes of a regular file. Raises BadFile, also for more than `most`."""
    found = head(path, most + 1)
    if len(found) > most:
        size = f"{most >> 20} MiB" if most >> 20 else f"{most >> 10} KiB"
        raise BadFile(path, f"it is larger than {size}")
    return found


def head(path: Path, count: int) -> bytes:
    """The first bytes of a regular file; of anything else nothing is read. Raises BadFile."""
    try:
        _refuse_other(path, path.stat())
        # otherwise a pipe that took the file's place meanwhile would wait for a writer
        with os.fdopen(os.open(path, os.O_RDONLY | _AT_ONCE | _BINARY), "rb") as file:
            _refuse_other(path, os.fstat(file.fileno()))
            return file.read(count)
    except OSError as error:
        raise error if isinstance(error, BadFile) else BadFile(path, error.strerror or str(error)) from None
    except ValueError:  # a path with a NUL in it
        raise BadFile(path, "it has no possible name") from None


def _refuse_other(path: Path, state: os.stat_result) -> None:
    if not stat.S_ISREG(state.st_mode):
        raise BadFile(path, f"it is a {'folder' if stat.S_ISDIR(state.st_mode) else 'pipe or device'}", "name a file")


class Output(FileIO):
    """A file to write to, without a buffer."""

    def add(self, data: bytes) -> None:
        """All of it. Raises OSError."""
        while data:
            data = data[self.write(data) :]


def opened(path: Path, *, new: bool = False, waits: bool = True, mode: int = 0o666) -> Output:
    """A file to be written bit by bit, made if it is not there; `new`: it must not be there. Raises OSError.

    What is there is kept. A link is followed to what is there; nothing is made through it. `waits`: for the reader of a
    pipe.
    """
    made = _NO_LINK if new or not path.is_symlink() else 0
    made |= (os.O_EXCL if new else 0) | (0 if waits else _AT_ONCE)
    file = Output(os.open(path, os.O_WRONLY | _BINARY | made, mode), "wb")
    if not waits and _AT_ONCE:
        os.set_blocking(file.fileno(), True)
    return file


def lock(file: Output, *, waits: bool) -> None:
    """Hold a file until it is closed; the system frees what a process held that dies. Raises OSError."""
    if sys.platform == "win32":
        import msvcrt

        msvcrt.locking(file.fileno(), msvcrt.LK_LOCK if waits else msvcrt.LK_NBLCK, 1)
    else:
        import fcntl

        fcntl.flock(file, fcntl.LOCK_EX | (0 if waits else fcntl.LOCK_NB))


def put(path: Path, content: str | bytes, *, new: bool = False, sync: bool = True, mode: int = 0o666) -> None:
    """Write a file whole, or leave what is there as it was. Raises OSError that names the file.

    `new`: nothing may have its name. What it replaces gives it its mode, a link stays one, and a device, or a pipe with
    a reader, is written to. `sync`: on the disk itself when it counts; `mode`: of a new file.
    """
    given = content.encode() if isinstance(content, str) else content
    try:
        if new:
            _made(path, given, sync, mode)
        elif os.path.lexists(path) and not stat.S_ISREG(path.stat().st_mode):
            with opened(path, waits=False) as file:
                file.add(given)
        else:
            with beside(path, mode) as (file, part):
                file.add(given)
                if sync:
                    os.fsync(file.fileno())
                file.close()
                part.replace(os.path.realpath(path))
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(path)) from None


def _made(path: Path, given: bytes, sync: bool, mode: int) -> None:
    file = opened(path, new=True, mode=mode)
    try:
        with file:
            file.add(given)
            if sync:
                os.fsync(file.fileno())
    except BaseException:
        path.unlink()
        raise


@contextmanager
def beside(path: Path, mode: int = 0o666) -> Iterator[tuple[Output, Path]]:
    """What is to replace a file, with its mode, under a name that cannot be guessed; removed if it is left there.

    Raises OSError, also for a link to nothing and for a file that may not be written.
    """
    there = path.stat() if os.path.lexists(path) else None
    if there and not os.access(path, os.W_OK):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
    part = Path(os.path.realpath(path)).with_name(f".{path.name[:40]}.{secrets.token_hex(8)}")
    file = opened(part, new=True, mode=0o600 if there else mode)
    try:
        with file:
            if there and hasattr(os, "fchmod"):  # Windows has none
                with suppress(OSError):
                    os.fchown(file.fileno(), there.st_uid, there.st_gid)
                os.fchmod(file.fileno(), stat.S_IMODE(there.st_mode))
            yield file, part
    finally:
        part.unlink(missing_ok=True)


def sources(named: Sequence[Path]) -> tuple[list[tuple[str, str]], list[str]]:
    """The text of every source by its name, and what cannot be read, with the reason."""
    found: list[tuple[str, str]] = []
    bad: list[str] = []
    for path in dict.fromkeys(file for each in named for file in _files(each, bad)):
        try:
            found.append((file_name(path), text(path)))
        except BadFile as error:
            bad.append(str(error))
    return found, bad


def _files(path: Path, bad: list[str]) -> list[Path]:
    """A file, or the sources in a folder and below, hidden folders left out, in the order of their names."""
    if not os.path.isdir(path):  # noqa: PTH112 - Path.is_dir raises for a name that is too long
        return [path]
    found: list[Path] = []

    def told(error: OSError) -> None:
        bad.append(str(BadFile(Path(error.filename), error.strerror or str(error))))

    for folder, inner, names in os.walk(path, onerror=told):
        inner[:] = sorted(each for each in inner if not each.startswith("."))
        found += [Path(folder, each) for each in names if each.lower().endswith(".st")]
    if not found:
        bad.append(f"{file_name(path)}:1:1: expected .st files in this folder, found none")
    return sorted(found)
