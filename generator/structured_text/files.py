"""Sources as a user names them: files, and folders of them."""

import os
from collections.abc import Sequence
from pathlib import Path

from structured_text.visible import file_name

# A source of more is no source; the largest library in public use has a tenth of it.
MOST_BYTES = 8 << 20


def read(named: Sequence[Path]) -> tuple[list[tuple[str, str]], list[str]]:
    """The text of every file by its name, and what cannot be read, with the reason."""
    sources: list[tuple[str, str]] = []
    bad: list[str] = []
    for path in dict.fromkeys(file for each in named for file in _files(each, bad)):
        try:
            sources.append((file_name(path), _text(path)))
        except (OSError, ValueError) as error:
            bad.append(f"{file_name(path)}:1:1: {_reason(error)}")
    return sources, bad


def _files(path: Path, bad: list[str]) -> list[Path]:
    """A file, or the sources in a folder and below, hidden folders left out, in the order of their names."""
    if not os.path.isdir(path):  # noqa: PTH112 - Path.is_dir raises for a name that is too long
        return [path]
    found: list[Path] = []

    def told(error: OSError) -> None:
        bad.append(f"{file_name(error.filename)}:1:1: {_reason(error)}")

    for folder, inner, names in os.walk(path, onerror=told):
        inner[:] = sorted(each for each in inner if not each.startswith("."))
        found += [Path(folder, each) for each in names if each.lower().endswith(".st")]
    if not found:
        bad.append(f"{file_name(path)}:1:1: expected .st files in this folder, found none")
    pipes = [each for each in found if each.exists() and not each.is_file()]
    bad += [f"{file_name(each)}:1:1: expected a file, found a pipe or device" for each in sorted(pipes)]
    return sorted(each for each in found if each not in pipes)


def _text(path: Path) -> str:
    """The text of one file. Raises OSError, or ValueError saying why it is no source."""
    if path.exists() and not path.is_file():
        raise ValueError("expected a file, found a pipe or device")
    with path.open("rb") as stream:
        data = stream.read(MOST_BYTES + 1)
    if len(data) > MOST_BYTES:
        raise ValueError(f"expected at most {MOST_BYTES >> 20} MiB of text, found more")
    if b"\0" in data:
        raise ValueError("expected text, found a binary file")
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise ValueError(
            f"expected UTF-8, found the byte {data[error.start]:02X}H in line {line}: save it as UTF-8"
        ) from None


def _reason(error: Exception) -> str:
    """Why a file cannot be read, in words."""
    if isinstance(error, OSError):
        return f"cannot be read: {error.strerror or error}"
    return str(error)
