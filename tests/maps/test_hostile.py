"""Files made to hurt end in a clear message, with little memory and work that grows no faster than the file."""

import json
import os
import re
import socket
import stat
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from tests.maps.hostile_files import contents, texts
from tests.steps import grows_evenly

from driveblocks.maps import load, source
from driveblocks.maps.problem import MapError

PROBE = Path(__file__).parent / "hostile_probe.py"
PARTS = 4
"""Groups of files that share one start of the interpreter."""
MOST_BYTES = 100 << 20
"""Memory that a loader may take for files of full size; for a part of them it is as small a part."""
SMALLEST = 128
"""The growth of work is seen on files of so small a part of their size, and on twice and four times of that."""


def refused(path: Path) -> str:
    """The first message for a file that must be refused."""
    with pytest.raises(MapError) as caught:
        load.load(path)
    return str(caught.value.problems[0])


@pytest.mark.parametrize("share", [4, pytest.param(1, marks=pytest.mark.long)])
@pytest.mark.parametrize("part", range(PARTS))
@pytest.mark.thorough
def test_hostile_files_are_refused_in_little_memory(part: int, share: int, tmp_path: Path) -> None:
    files = dict(list(contents(share).items())[part::PARTS])
    for name, data in files.items():
        (tmp_path / name).write_bytes(data)
    command = [sys.executable, str(PROBE), str(MOST_BYTES // share), *(str(tmp_path / name) for name in files)]
    run = subprocess.run(command, check=True, capture_output=True, text=True, timeout=1200)
    found = [json.loads(line) for line in run.stdout.splitlines()]
    assert [each["name"] for each in found] == list(files)
    assert {each["name"]: each["trace"] for each in found if each["trace"]} == {}
    assert [each["name"] for each in found if not _clear(tmp_path / each["name"], each["messages"])] == []
    assert not (Path.cwd() / "hacked").exists()


@pytest.mark.parametrize("name", texts())
@pytest.mark.thorough
def test_twice_the_file_is_about_twice_the_work(name: str, tmp_path: Path) -> None:
    path = tmp_path / "map.yaml"

    def work(size: int) -> Callable[[], object]:
        path.write_text(texts(SMALLEST // size)[name], encoding="utf-8")
        return lambda: refused(path)

    assert grows_evenly(work)


def _clear(path: Path, messages: list[str]) -> bool:
    """Whether there are messages that say where, what and what instead, none of them endless."""
    form = re.compile(re.escape(str(path)) + r":[0-9]+:[0-9]+: .+; .+", re.DOTALL)
    return bool(messages) and all(form.fullmatch(message) and len(message) < 2000 for message in messages)


def piped(folder: Path) -> Path:
    """A named pipe that nobody writes to."""
    os.mkfifo(folder / "pipe.yaml")
    return folder / "pipe.yaml"


def linked(folder: Path, name: str) -> Path:
    """A link to a file that is not there, or to itself."""
    (folder / "link.yaml").symlink_to(folder / name)
    return folder / "link.yaml"


def below(folder: Path) -> Path:
    """A file below a file."""
    (folder / "file").write_text("")
    return folder / "file" / "map.yaml"


NO_MAPS: dict[str, tuple[Callable[[Path], Path], str]] = {
    "a directory": (lambda folder: folder, "it is a folder; name a file"),
    "a named pipe": (piped, "it is a pipe or device"),
    "a device": (lambda _: Path("/dev/zero"), "it is a pipe or device"),
    "no file": (lambda folder: folder / "none.yaml", "cannot be read: No such file or directory"),
    "an impossible name": (lambda _: Path("a\0b.yaml"), "has no possible name"),
    "a name that is too long": (lambda folder: folder / ("x" * 5000), "cannot be read: File name too long"),
    "a link to nothing": (lambda folder: linked(folder, "none.yaml"), "cannot be read: No such file or directory"),
    "a link to itself": (lambda folder: linked(folder, "link.yaml"), "cannot be read: "),
    "a file below a file": (below, "cannot be read: Not a directory"),
}


@pytest.mark.parametrize("name", NO_MAPS)
def test_what_is_no_file_is_named(name: str, tmp_path: Path) -> None:
    make, said = NO_MAPS[name]
    assert said in refused(make(tmp_path))


def test_a_pipe_that_takes_the_place_of_a_file_does_not_wait(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    regular = Path(__file__).stat()
    path = piped(tmp_path)
    monkeypatch.setattr(Path, "stat", lambda *_, **__: regular)
    assert "it is a pipe or device" in refused(path)


def test_a_socket(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)  # a socket's whole path has room for a hundred characters only
    with socket.socket(socket.AF_UNIX) as server:
        server.bind("socket.yaml")
        assert "it is a pipe or device" in refused(Path("socket.yaml"))


def test_a_block_device(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    state = os.stat_result((stat.S_IFBLK | 0o600, *tmp_path.stat()[1:]))
    monkeypatch.setattr(Path, "stat", lambda *_, **__: state)
    assert "it is a pipe or device" in refused(tmp_path / "disk.yaml")


@pytest.mark.parametrize("where", ["stat", "open", "read"])
def test_every_step_of_reading_may_be_denied(where: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "map.yaml"
    path.write_text("format: 2\n")

    def denied(*_: object, **__: object) -> None:
        raise PermissionError(13, "Permission denied")

    owner: object = {"stat": Path, "open": os, "read": os}[where]
    monkeypatch.setattr(owner, {"read": "fdopen"}.get(where, where), denied, raising=False)
    assert "cannot be read: Permission denied" in refused(path)


def test_no_file_is_left_open(tmp_path: Path) -> None:
    handles = Path("/proc/self/fd")
    if not handles.exists():
        pytest.skip("the system does not list open files")
    piped(tmp_path)
    (tmp_path / "large.yaml").write_bytes(b"#" * (source.MAX_BYTES + 1))
    before = len(list(handles.iterdir()))
    for _ in range(20):
        for path in (tmp_path, tmp_path / "pipe.yaml", tmp_path / "large.yaml"):
            refused(path)
    assert len(list(handles.iterdir())) <= before + 2


def test_a_file_that_grows_while_it_is_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """No more of it is read than a map may have, though its size was good when it was opened."""
    path = tmp_path / "log.yaml"
    path.write_bytes(b"# a log\n")
    look = os.fstat

    def grown(handle: int) -> os.stat_result:
        state = look(handle)
        path.write_bytes(b"# a log\n" * 100_000)
        return state

    monkeypatch.setattr(os, "fstat", grown)
    assert "is larger than" in refused(path)
