"""Compilers that hang, crash, lie, vanish or print rubbish: always a clear error, and never an entry in the cache."""

import errno
import os
import shutil
import subprocess
import sys
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import pytest

from structured_text.engines.engine import BuildError, EngineError, Message, Source
from structured_text.engines.matiec import (
    BadCError,
    CompilerCrashError,
    CompilerTimeoutError,
    MatiecEngine,
    RefusedWithCrashError,
    process,
)
from structured_text.engines.matiec.cache import Cache
from structured_text.engines.matiec.process import OUTPUT_LIMIT

Fake = Callable[..., MatiecEngine]

GOOD_C = 'echo "#endif //__POUS_H" > POUS.h; echo > POUS.c'
SOURCES = (Source("first.st", "(* one *)\n(* two *)"), Source("second.st", "(* three *)\n"))
BLOCK = Source(
    "block.st",
    "FUNCTION_BLOCK Block\n  VAR_OUTPUT\n    X : INT;\n  END_VAR\n  X := X + 1;\nEND_FUNCTION_BLOCK\n",
)


def fails(engine: MatiecEngine, kind: type[EngineError], sources: Sequence[Source] = SOURCES) -> str:
    """Build, which must fail with `kind` and leave no file; give the text of the error."""
    with pytest.raises(EngineError) as caught:
        engine.build(sources)
    assert type(caught.value) is kind
    assert not list(engine.cache.root.glob("entries/*/*"))
    assert not list(engine.cache.root.glob("making/*"))
    return str(caught.value)


@pytest.mark.parametrize(
    ("iec2c", "compiler", "kind", "said"),
    [
        ("kill -SEGV $$", "", CompilerCrashError, "crashed (SIGSEGV)"),
        ("exit 139", "", CompilerCrashError, "crashed (SIGSEGV)"),
        (
            "echo 'source.st:3-2..3-5: error: odd' >&2; kill -SEGV $$",
            "",
            RefusedWithCrashError,
            "second.st:1:2: odd\nsecond.st:1:2: iec2c crashed (SIGSEGV) after this",
        ),
        ("echo 'Internal compiler error in file x.cc'; exit 1", "", CompilerCrashError, "gave up: Internal compiler"),
        ("echo 'source.st:1-4..1-9: error: one'; exit 0", "", BuildError, "first.st:1:4: one"),
        ("printf '\\377\\376\\n'; exit 3", "", EngineError, "status 3: \ufffd\ufffd"),
        ("printf 'a\\033[31m\\001\\rb\\n'; exit 3", "", EngineError, "status 3: a?[31m??b"),
        ("exit 3", "", EngineError, "status 3 and no message"),
        ("echo hello", "", EngineError, "wrote no POUS.c: hello"),
        ("while true; do echo xxxxxxxxxxxxxxxxxxxxxxxx; done", "", EngineError, f"more than {OUTPUT_LIMIT} bytes"),
        ("echo > POUS.c; echo '#ifndef __POUS_H' > POUS.h", "", EngineError, "cut short"),
        ("echo > POUS.c", "", EngineError, "wrote no POUS.h"),
        ('rm -- "$0"; exit 1', "", EngineError, "and no message"),
        (GOOD_C, "echo no licence; exit 1", EngineError, "status 1: no licence"),
        (GOOD_C, "kill -SEGV $$", CompilerCrashError, "crashed (SIGSEGV)"),
        (GOOD_C, "exit 0", EngineError, "wrote no library"),
    ],
)
def test_tools_that_fail(fake: Fake, iec2c: str, compiler: str, kind: type[EngineError], said: str) -> None:
    assert said in fails(fake(iec2c, compiler or "exit 1"), kind)


def test_iec2c_that_hangs(fake: Fake) -> None:
    fails(fake("exec sleep 600", seconds=0.1), CompilerTimeoutError)


@pytest.mark.parametrize(
    ("script", "seconds", "kind"),
    [("sleep 600 & sleep 600", 0.1, CompilerTimeoutError), ("sleep 600 & exit 1", 600.0, EngineError)],
)
def test_iec2c_whose_child_keeps_the_output_open(
    fake: Fake, monkeypatch: pytest.MonkeyPatch, script: str, seconds: float, kind: type[EngineError]
) -> None:
    """The child is ended as well, so that nobody waits for the end of the output."""
    readers: list[process._Reader] = []

    class Reader(process._Reader):
        def __init__(self, child: subprocess.Popen[bytes]) -> None:
            super().__init__(child)
            readers.append(self)

    monkeypatch.setattr(process, "_Reader", Reader)
    fails(fake(script, seconds=seconds), kind)
    for reader in readers:
        reader.join(300.0)  # at once, if nobody holds the other end
    assert [reader.is_alive() for reader in readers] == [False]


def test_messages_lead_to_our_files_and_each_is_said_once(fake: Fake) -> None:
    engine = fake(
        "echo 'source.st:1-4..1-9: error: one'; echo 'source.st:2-1..source.st:3-9: error: two';"
        "echo 'source.st:2-1..source.st:3-9: error: two'; echo './source.st:3: error: three';"
        "echo '/lib/x.txt:7-1..7-2: error: four'; echo '5 error(s) found. Bailing out!'; exit 1"
    )
    with pytest.raises(BuildError) as caught:
        engine.build(SOURCES)
    assert caught.value.messages == (
        Message("first.st", 1, 4, "one"),
        Message("first.st", 2, 1, "two"),
        Message("second.st", 1, 0, "three"),
        Message("/lib/x.txt", 7, 1, "four"),
    )


def test_iec2c_that_vanishes(fake: Fake) -> None:
    engine = fake(GOOD_C)
    iec2c = engine.installation.iec2c
    assert engine.installation.digest  # looked at when it was found
    iec2c.unlink()
    assert f"cannot run {iec2c}" in fails(engine, EngineError)
    unseen = replace(engine, installation=replace(engine.installation))
    assert "no longer there" in fails(unseen, EngineError)


def slow_to_compile(fake: Fake) -> MatiecEngine:
    """An engine whose C compiler hangs; its iec2c has all the time that it needs."""
    engine = fake(GOOD_C, "exec sleep 600")
    return replace(engine, compiler=replace(engine.compiler, seconds=0.1))


def test_c_compiler_that_hangs(fake: Fake) -> None:
    fails(slow_to_compile(fake), CompilerTimeoutError)


def test_messages_of_the_c_compiler(fake: Fake) -> None:
    engine = fake(
        GOOD_C + "; printf 'a\\n#line 3 \"source.st\"\\nb;\\nc;' > POUS.c",
        "echo 'x/driveblocks_pous.c: In function X:'; echo 'x/driveblocks_pous.c:4:17: error: bad cast';"
        "echo 'driveblocks_pous.c:4:17: note: here'; echo 'driveblocks_pous.c:1:17: error: above';"
        "echo 'POUS.h:5:1: fatal error: no'; echo 'POUS.h:1:1: warning: odd'; echo 'ld: undefined reference to `f';"
        "exit 1",
    )
    with pytest.raises(BadCError) as caught:
        engine.build(SOURCES)
    assert caught.value.messages == (
        Message("second.st", 1, 0, "in the C made from this line: bad cast"),
        Message("driveblocks_pous.c", 1, 17, "above"),
        Message("POUS.h", 5, 1, "no"),
        Message("linker", 0, 0, "ld: undefined reference to `f"),
    )


def test_unwritable_cache(matiec: MatiecEngine, tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    engine = replace(matiec, cache=Cache(tmp_path / "file" / "cache"))
    with pytest.raises(EngineError, match=r"cannot write the build cache .*DRIVEBLOCKS_CACHE"):
        engine.build([BLOCK])


def test_full_disk_while_the_entry_is_sealed(fresh: MatiecEngine, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(Path, "rename", full)
    assert "No space left on device" in fails(fresh, EngineError, [BLOCK])
    monkeypatch.undo()
    assert fresh.build([BLOCK]).instance("Block")["X"] == 0


def test_full_disk_while_the_compilers_write(fresh: MatiecEngine, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(shutil, "disk_usage", lambda _: shutil._ntuple_diskusage(1, 1, 0))
    broken = replace(fresh, installation=fresh.installation, compiler=replace(fresh.compiler, command=("false",)))
    assert "is full" in fails(broken, EngineError, [BLOCK])


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no limit on the size of files")
def test_files_that_cannot_grow(fresh: MatiecEngine) -> None:
    import resource

    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (100, before[1]))
    try:
        with pytest.raises(EngineError):
            fresh.build([BLOCK])
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    block = fresh.build([BLOCK]).instance("Block")
    block.scan(0)
    assert block["X"] == 1
