"""Built libraries on disk, keyed by all that they were made of, shared by all processes of a user and by nobody else.

An entry is a folder that appears whole by a rename, with a seal that holds the digest of each of its files: what is
half-written, cut short by a full disk or touched by somebody is built again and never used. What is in it runs as the
user, so a folder that others own or may write to is refused.
"""

import contextlib
import hashlib
import json
import os
import shutil
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

from structured_text.engines.engine import EngineError

SEAL = "seal.json"
LIMIT_BYTES = 256 << 20
# A folder in the making that is older than this belongs to a process that was killed.
_ABANDONED_SECONDS = 24 * 3600.0


def cache_folder(environment: Mapping[str, str] = os.environ) -> Path:
    """DRIVEBLOCKS_CACHE, else `driveblocks` in the user's cache folder."""
    if own := environment.get("DRIVEBLOCKS_CACHE"):
        return Path(own).expanduser()
    if shared := environment.get("XDG_CACHE_HOME"):
        return Path(shared) / "driveblocks"
    if sys.platform == "win32":
        return Path(environment.get("LOCALAPPDATA") or Path.home()) / "driveblocks" / "cache"
    return Path.home() / ("Library/Caches" if sys.platform == "darwin" else ".cache") / "driveblocks"


class Cache:
    """Entries under `root`, at most `limit` bytes of them; the longest unused go first."""

    def __init__(self, root: Path, limit: int = LIMIT_BYTES) -> None:
        """Nothing is written before the first entry is made."""
        self.root = root
        self._limit = limit

    def entry(self, key: str, make: Callable[[Path], None]) -> Path:
        """Give the folder of `key`; if there is none, `make` fills one.

        Raises EngineError if the cache cannot be written, and what `make` raises; then nothing is kept.
        """
        final = self.root / "entries" / key[:2] / key
        try:
            self._folder()
            if self._is_good(final):
                return final
            with self._locked(key):
                if not self._is_good(final):
                    self._make(final, make)
        except OSError as error:
            raise self._complaint(error) from error
        self._trim(final)
        return final

    def check(self) -> str | None:
        """Say why the cache cannot be written; None if it can."""
        try:
            with tempfile.TemporaryFile(dir=self._folder()) as file:
                file.write(b"\0" * 4096)
        except OSError as error:
            return str(self._complaint(error))
        except EngineError as error:
            return str(error)
        return None

    def _folder(self, *names: str) -> Path:
        """The root, or a folder below it; made for the user alone. Raises EngineError where others own or may write it.

        A folder that was there keeps its mode: it may serve other purposes as well.
        """
        folder = self.root
        folder.parent.mkdir(parents=True, exist_ok=True)
        folder.mkdir(mode=0o700, exist_ok=True)
        if sys.platform != "win32":
            self._refuse_foreign(folder.stat())
        for name in names:
            folder /= name
            folder.mkdir(mode=0o700, exist_ok=True)
        return folder

    def _refuse_foreign(self, state: os.stat_result) -> None:
        """What somebody else can put into the cache would run as the user."""
        if state.st_uid != os.geteuid():
            wrong = f"belongs to another user (number {state.st_uid})"
        elif state.st_mode & 0o022:
            wrong = f"can be written by others (mode {state.st_mode & 0o777:o})"
        else:
            return
        raise EngineError(
            f"the build cache {self.root} {wrong}; make it yours (mode 700) or name another folder in DRIVEBLOCKS_CACHE"
        )

    def _complaint(self, error: OSError) -> EngineError:
        return EngineError(
            f"cannot write the build cache {self.root}: {error.strerror or error};"
            " make room or name a folder that can be written in DRIVEBLOCKS_CACHE"
        )

    def _make(self, final: Path, make: Callable[[Path], None]) -> None:
        shutil.rmtree(final, ignore_errors=True)
        self._folder("entries", final.parent.name)
        folder = Path(tempfile.mkdtemp(dir=self._folder("making")))
        try:
            make(folder)
            (folder / SEAL).write_text(json.dumps(_digests(folder)), encoding="utf-8")
            folder.rename(final)
        except OSError:
            if not self._is_good(final):  # else another process was quicker, and its entry is as good
                raise
        finally:
            shutil.rmtree(folder, ignore_errors=True)

    def _is_good(self, folder: Path) -> bool:
        """Whether an entry is there and is what it was when it was made; a good one counts as used now."""
        seal = folder / SEAL
        try:
            expected = json.loads(seal.read_text(encoding="utf-8"))
            good = bool(expected) and _digests(folder) == expected
            os.utime(seal)
        except (OSError, ValueError):
            return False
        return good

    @contextlib.contextmanager
    def _locked(self, key: str) -> Iterator[None]:
        """Keep other processes from building the same; without locks they would only waste work."""
        with (self._folder("locks") / key[:2]).open("wb") as file:
            with contextlib.suppress(OSError):
                _lock(file.fileno())
            yield

    def _trim(self, newest: Path) -> None:
        """Remove the longest unused entries beyond the limit, and what killed processes have left."""
        with contextlib.suppress(OSError):
            for folder in (self.root / "making").iterdir():
                if time.time() - folder.stat().st_mtime > _ABANDONED_SECONDS:
                    shutil.rmtree(folder, ignore_errors=True)
            entries = [(_used(folder), _size(folder), folder) for folder in (self.root / "entries").glob("*/*")]
            excess = sum(size for _, size, _ in entries) - self._limit
            for _, size, folder in sorted(entries):
                if excess <= 0 or folder == newest:
                    break
                shutil.rmtree(folder, ignore_errors=True)
                excess -= size


def _digests(folder: Path) -> dict[str, str]:
    files = (file for file in sorted(folder.iterdir()) if file.is_file() and file.name != SEAL)
    return {file.name: hashlib.sha256(file.read_bytes()).hexdigest() for file in files}


def _used(folder: Path) -> float:
    try:
        return (folder / SEAL).stat().st_mtime
    except OSError:
        return 0.0


def _size(folder: Path) -> int:
    total = 0
    with contextlib.suppress(OSError):
        total = sum(file.stat().st_size for file in folder.iterdir())
    return total


def _lock(descriptor: int) -> None:
    if sys.platform == "win32":
        import msvcrt

        msvcrt.locking(descriptor, msvcrt.LK_LOCK, 1)
    else:
        import fcntl

        fcntl.flock(descriptor, fcntl.LOCK_EX)
