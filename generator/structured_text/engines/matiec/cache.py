"""Built libraries on disk, keyed by all that they were made of, shared by all processes of a user and by nobody else.

An entry is a folder that appears whole by a rename, with a seal that holds the digest of each of its files: what is
half-written, cut short by a full disk or touched by somebody is built again and never used. What is in it runs as the
user, so no step of the way to it may be another user's, or one that others may write to.
"""

import contextlib
import errno
import hashlib
import json
import os
import secrets
import shutil
import stat
import sys
import time
from collections.abc import Callable, Mapping
from pathlib import Path

from structured_text.engines.engine import EngineError
from structured_text.files import Output, beside, data, lock, opened, put

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
            self._folder("entries", key[:2])
            if self._is_good(final):
                return final
            with self._locked(key):
                if not self._is_good(final):
                    self._make(final, make)
        except OSError as error:
            raise self._complaint(error) from error
        self._trim(final)
        return final

    def found(self, key: str) -> Path | None:
        """Give the folder of `key`, if there is a good one."""
        final = self.root / "entries" / key[:2] / key
        return final if self._is_good(final) else None

    def check(self) -> str | None:
        """Say why the cache cannot be written; None if it can."""
        try:
            with beside(self._folder() / "check") as (file, _):
                file.add(b"\0" * 4096)
        except OSError as error:
            return str(self._complaint(error))
        return None

    def _folder(self, *names: str) -> Path:
        """The root, or a folder below it; made for the user alone. Raises OSError where a step is not.

        A folder that was there keeps its mode: it may serve other purposes as well. The root may be a link.
        """
        folder, lexical = self.root, self.root.absolute()
        for step in (*reversed(lexical.parents), lexical):
            step.mkdir(mode=0o700, exist_ok=True)
        real = Path(os.path.realpath(lexical))
        for step in {lexical, *lexical.parents, real, *real.parents}:
            _refuse_foreign(step, above=step != real)
        for name in names:
            folder /= name
            folder.mkdir(mode=0o700, exist_ok=True)
            _refuse_foreign(folder)
        return folder

    def _complaint(self, error: OSError) -> EngineError:
        return EngineError(
            f"cannot write the build cache {self.root}: {error.strerror or error}; make it yours (mode 700)"
            " or name another folder, with room, in DRIVEBLOCKS_CACHE"
        )

    def _make(self, final: Path, make: Callable[[Path], None]) -> None:
        with contextlib.suppress(OSError):
            final.unlink()  # a link in its place
        shutil.rmtree(final, ignore_errors=True)
        folder = self._folder("making") / secrets.token_hex(8)
        folder.mkdir(mode=0o700)
        try:
            make(folder)
            put(folder / SEAL, json.dumps(_digests(folder)), new=True, sync=False)
            for file in folder.iterdir():
                file.chmod(file.stat().st_mode & 0o700)  # a program stays one
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
            for each in (folder, *folder.iterdir()):
                _refuse_foreign(each)
            expected = json.loads(data(seal))
            good = bool(expected) and _digests(folder) == expected
            os.utime(seal)
        except (OSError, ValueError):
            return False
        return good

    def _locked(self, key: str) -> Output:
        """What keeps other processes from building the same; without locks they would only waste work."""
        file = opened(self._folder("locks") / key[:2])
        with contextlib.suppress(OSError):
            lock(file, waits=True)
        return file

    def _trim(self, newest: Path) -> None:
        """Remove the longest unused entries beyond the limit, and what killed processes have left."""
        with contextlib.suppress(OSError):
            for folder in (self.root / "making").iterdir():
                if time.time() - folder.stat().st_mtime > _ABANDONED_SECONDS:
                    shutil.rmtree(folder, ignore_errors=True)
            entries = [(*_use(folder), folder) for folder in (self.root / "entries").glob("*/*")]
            excess = sum(size for _, size, _ in entries) - self._limit
            for _, size, folder in sorted(entries):
                if excess <= 0 or folder == newest:
                    break
                shutil.rmtree(folder, ignore_errors=True)
                excess -= size


def _refuse_foreign(path: Path, *, above: bool = False) -> None:
    """Raises OSError for what may be somebody else's; `above` the cache, root may own it, and groups are trusted."""
    state, wrong = path.lstat(), ""
    link, mode = stat.S_ISLNK(state.st_mode), stat.S_IMODE(state.st_mode)
    if link and not above:
        wrong = "is a link"
    elif sys.platform != "win32" and state.st_uid != os.geteuid() and not (above and state.st_uid == 0):
        wrong = f"belongs to another user (number {state.st_uid})"
    elif sys.platform != "win32" and not link and mode & (0o002 if above else 0o022) and not (above and mode & 0o1000):
        wrong = f"can be written by others (mode {mode & 0o777:o})"
    if wrong:
        raise PermissionError(errno.EACCES, f"{path} {wrong}")


def _digests(folder: Path) -> dict[str, str]:
    files = (file for file in sorted(folder.iterdir()) if file.is_file() and file.name != SEAL)
    return {file.name: hashlib.sha256(data(file)).hexdigest() for file in files}


def _use(folder: Path) -> tuple[float, int]:
    """When an entry was used last, and its size; never and nothing for one that is not whole."""
    with contextlib.suppress(OSError):
        return (folder / SEAL).stat().st_mtime, sum(file.stat().st_size for file in folder.iterdir())
    return 0.0, 0
