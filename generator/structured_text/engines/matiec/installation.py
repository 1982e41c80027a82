"""Where matiec is on this machine: `iec2c` and the folder of its library.

Only MATIEC_HOME and PATH are searched: nothing is run that nobody has named.

Layouts known: a folder of its own (`iec2c` beside `lib/`); Beremiz (`matiec/` in its folder); OpenPLC Editor up to 3
(`matiec/`, and a copy in `editor/arduino/bin/`); OpenPLC Editor 4 (`resources/bin/`, `resources/sources/MatIEC/lib`);
OpenPLC Runtime 3 (`utils/matiec_src/`, and a copy in `webserver/`); a prefix (`bin/` and `share/matiec/lib`).
"""

import hashlib
import os
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from structured_text import files

NAMES = ("iec2c.exe", "iec2c") if sys.platform == "win32" else ("iec2c", "iec2c_mac")

# Below a folder that a user may point at, where iec2c can be.
_INSIDE = (
    ".", "matiec", "bin", "editor/arduino/bin", "resources/bin", "utils/matiec_src", "webserver",
    "Contents/Resources/bin", "MatIEC", "beremiz/matiec",
)  # fmt: skip
# Beside the folder of iec2c, where its library can be.
_LIBRARIES = (
    "lib", "../lib", "../sources/MatIEC/lib", "../../../matiec/lib", "../matiec/lib", "../share/matiec/lib",
    "../share/matiec", "../lib/matiec", "../lib/matiec/lib", ".",
)  # fmt: skip
_SYSTEM_LIBRARIES = ("/usr/local/share/matiec/lib", "/usr/share/matiec/lib", "/usr/lib/matiec", "/usr/share/matiec")


@dataclass(frozen=True)
class Installation:
    """One iec2c (as found, links unresolved), its library of ST declarations and its C headers."""

    iec2c: Path
    library: Path
    headers: Path

    @cached_property
    def digest(self) -> str:
        """SHA-256 over iec2c, the ST declarations and the C headers. Raises OSError if one is gone."""
        total = hashlib.sha256()
        parts = [self.iec2c, *sorted(self.library.glob("*.txt")), *sorted(self.headers.glob("*.h"))]
        for file in parts:
            total.update(f"{file.name}\n".encode() + hashlib.sha256(files.data(file)).digest())
        return total.hexdigest()


@dataclass(frozen=True)
class Useless:
    """An iec2c that cannot be used, or a folder of MATIEC_HOME that has none, and why."""

    iec2c: Path
    why: str


def find_installations(environment: Mapping[str, str] = os.environ) -> list[Installation]:
    """Every usable matiec, the one to prefer first: MATIEC_HOME, then PATH; no other folder."""
    return [each for each in look_everywhere(environment) if isinstance(each, Installation)]


def look_everywhere(environment: Mapping[str, str] = os.environ) -> list[Installation | Useless]:
    """Every iec2c of this machine, each file once, also those that lack their library and where none is."""
    found: dict[Path, Installation | Useless] = {}
    for home in _split(environment.get("MATIEC_HOME", "")):
        if not any(_in_folder(home)):
            found[home] = Useless(home, "MATIEC_HOME names it, and there is no iec2c in it")
    for binary in _binaries(environment):
        found.setdefault(binary.resolve(), _installation(binary))
    return list(found.values())


def _installation(binary: Path) -> Installation | Useless:
    library = _library(binary)
    if library is None:
        return Useless(binary, "its library folder (with ieclib.txt) is neither beside it nor in a place known")
    for headers in (library / "C", library):
        if (headers / "iec_std_lib.h").is_file():
            return Installation(binary.absolute(), library, headers)
    return Useless(binary, f"the C headers (iec_std_lib.h) are not in {library}")


def _library(binary: Path) -> Path | None:
    beside = [folder / name for folder in (binary.resolve().parent, binary.parent) for name in _LIBRARIES]
    for folder in [*beside, *map(Path, _SYSTEM_LIBRARIES)]:
        if (folder / "ieclib.txt").is_file():
            return folder.resolve()
    return None


def _binaries(environment: Mapping[str, str]) -> Iterator[Path]:
    for home in _split(environment.get("MATIEC_HOME", "")):
        yield from _in_folder(home)
    for folder in _split(environment.get("PATH", "")):
        yield from _executables(folder)


def _split(paths: str) -> list[Path]:
    return [Path(each).expanduser() for each in paths.split(os.pathsep) if each]


def _in_folder(home: Path) -> Iterator[Path]:
    if home.name in NAMES and home.is_file():
        yield home
    for inside in _INSIDE:
        yield from _executables(home / inside)


def _executables(folder: Path) -> Iterator[Path]:
    for name in NAMES:
        file = folder / name
        if file.is_file() and os.access(file, os.X_OK):
            yield file
