"""The one door for files: what is read and what is refused, what is written and what stays as it was."""

import ast
import os
import secrets
import stat
import sys
import threading
from collections.abc import Callable
from pathlib import Path

import pytest
from tests.rooms import MODULES

from structured_text import files
from structured_text.files import BadFile, data, head, opened, put, text

POSIX = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such pipes, modes and links")


def opens(node: ast.AST, reads: bool) -> bool:
    """Whether it reads or writes a file; `reads`: reading is allowed, as of package data."""
    barred = {"fdopen", "write_text", "write_bytes", "touch", *(() if reads else ("read_text", "read_bytes"))}
    match node:
        case ast.Call(func=ast.Name(id="open") | ast.Attribute(value=ast.Name(id="os" | "io"), attr="open")):
            return True
        case ast.Call(func=ast.Attribute(attr="open"), args=[_, *_]) | ast.Name(id="tempfile"):
            return True
        case ast.Attribute(value=ast.Name(id="shutil"), attr=name):
            return name not in {"which", "rmtree", "disk_usage"}
        case ast.ImportFrom(module=name):
            return name in {"tempfile", "shutil"}
    return isinstance(node, ast.Attribute) and node.attr in barred


def test_nothing_else_opens_a_file() -> None:
    found = []
    for module, path in MODULES.items():
        nodes = [*ast.walk(ast.parse(path.read_text("utf-8")))]
        packaged = any(getattr(node, "module", "") == "importlib.resources" for node in nodes)
        found += [f"{module}:{node.lineno}" for node in nodes if opens(node, packaged)]  # type: ignore[attr-defined]
    assert [each for each in found if not each.startswith("structured_text.files:")] == []
    assert found  # those of the door itself


# ------------------------------------------------------------ reading


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"a\r\nb\xff", "2:2: cannot be read: it is not UTF-8: byte FFH; save it as UTF-8"),
        ("Grün\n, \0".encode(), "2:3: cannot be read: it is no text: byte 00H; name a file of text"),
        ("a".encode("utf-16"), "1:1: cannot be read: it is not UTF-8: byte FFH; save it as UTF-8"),
        (b"12345678901", "1:1: cannot be read: it is larger than 0 KiB"),
    ],
)
def test_what_is_no_text_is_refused_with_its_place(tmp_path: Path, content: bytes, said: str) -> None:
    (tmp_path / "a.st").write_bytes(content)
    with pytest.raises(BadFile) as error:
        text(tmp_path / "a.st", 10)
    assert str(error.value) == f"{tmp_path / 'a.st'}:{said}"


def test_a_text_has_the_line_ends_of_unix_and_no_mark(tmp_path: Path) -> None:
    (tmp_path / "a").write_bytes("\ufeffa\r\nb".encode())
    assert (text(tmp_path / "a"), head(tmp_path / "a", 4)) == ("a\nb", b"\xef\xbb\xbfa")


OTHERS: dict[str, tuple[Callable[[Path], object], str]] = {
    "pipe": (os.mkfifo, "it is a pipe or device; name a file"),
    "folder": (Path.mkdir, "it is a folder; name a file"),
    "device": (lambda path: path.symlink_to("/dev/zero"), "it is a pipe or device; name a file"),
    "link": (lambda path: path.symlink_to("nowhere"), "No such file or directory"),
    "circle": (lambda path: path.symlink_to(path), "Too many levels of symbolic links"),
}


@POSIX
@pytest.mark.parametrize("kind", OTHERS)
def test_what_is_no_file_is_neither_waited_for_nor_read(tmp_path: Path, kind: str) -> None:
    make, said = OTHERS[kind]
    make(tmp_path / "a")
    for read in (text, data, lambda path: head(path, 10)):
        with pytest.raises(BadFile) as error:
            read(tmp_path / "a")
        assert str(error.value) == f"{tmp_path / 'a'}:1:1: cannot be read: {said}"


# ------------------------------------------------------------ writing


@POSIX
@pytest.mark.parametrize("there", [True, False])
def test_a_link_at_the_name_of_the_moment_is_not_followed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, there: bool
) -> None:
    """Nobody can guess that name; who could still overwrites nothing."""
    monkeypatch.setattr(secrets, "token_hex", lambda _: "guessed")
    path, victim = tmp_path / "a", tmp_path / "victim"
    if there:
        victim.write_text("mine")
    (tmp_path / ".a.guessed").symlink_to(victim)
    with pytest.raises(FileExistsError) as error:
        put(path, "text")
    assert (error.value.filename, path.exists(), victim.exists()) == (str(path), False, there)
    assert (tmp_path / ".a.guessed").is_symlink()


@POSIX
def test_what_is_replaced_gives_its_mode_and_a_link_stays_one(tmp_path: Path) -> None:
    path, link = tmp_path / "there" / "a", tmp_path / "a"
    path.parent.mkdir()
    path.write_text("old")
    path.chmod(0o640)
    link.symlink_to(path)
    put(link, "new")
    assert (link.is_symlink(), path.read_text(), stat.S_IMODE(path.stat().st_mode)) == (True, "new", 0o640)
    assert [*path.parent.iterdir()] == [path]


@POSIX
def test_through_a_link_to_nothing_nothing_is_made(tmp_path: Path) -> None:
    (tmp_path / "a").symlink_to(tmp_path / "b")
    for write in (put, lambda path, text: put(path, text, new=True), lambda path, _: opened(path)):
        with pytest.raises(OSError, match=r"No such file|exists"):
            write(tmp_path / "a", "text")
    assert not (tmp_path / "b").exists()


@pytest.mark.parametrize("old", ["old", None])
@pytest.mark.parametrize("new", [True, False])
def test_what_cannot_be_written_leaves_what_was_there(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, old: str | None, new: bool
) -> None:
    def full(file: files.Output, given: bytes) -> None:
        file.write(given[:1])
        raise OSError(28, "No space left on device")

    path = tmp_path / "a"
    if old:
        path.write_text(old)
    monkeypatch.setattr(files.Output, "add", full)
    with pytest.raises(OSError, match="exists" if old and new else "No space") as error:
        put(path, "text", new=new)
    assert error.value.filename == str(path)
    assert [each.read_text() for each in tmp_path.iterdir()] == ([old] if old else [])


@POSIX
def test_a_pipe_is_written_to_where_somebody_reads_it(tmp_path: Path) -> None:
    pipe, whole, got = tmp_path / "pipe", b"text" * 100_000, b""
    os.mkfifo(pipe)
    with pytest.raises(OSError, match="No such device"):
        put(pipe, whole)
    reader = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
    os.set_blocking(reader, True)
    writing = threading.Thread(target=put, args=(pipe, whole))
    writing.start()
    while len(got) < len(whole):
        got += os.read(reader, 1 << 16)  # nothing until the pipe is opened
    writing.join()
    os.close(reader)
    assert (got == whole, pipe.is_fifo()) == (True, True)
