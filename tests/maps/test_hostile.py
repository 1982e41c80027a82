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


def test_a_directory(tmp_path: Path) -> None:
    assert "is a directory; name a map file" in refused(tmp_path)


def test_a_named_pipe_does_not_wait_for_a_writer(tmp_path: Path) -> None:
    path = tmp_path / "pipe.yaml"
    os.mkfifo(path)
    assert "is a named pipe" in refused(path)


def test_a_pipe_that_takes_the_place_of_a_file_does_not_wait(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "pipe.yaml"
    os.mkfifo(path)
    regular = Path(__file__).stat()
    monkeypatch.setattr(Path, "stat", lambda *_, **__: regular)
    assert "is a named pipe" in refused(path)


def test_a_socket(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)  # a socket's whole path has room for a hundred characters only
    with socket.socket(socket.AF_UNIX) as server:
        server.bind("socket.yaml")
        assert "is a socket" in refused(Path("socket.yaml"))


@pytest.mark.parametrize("device", ["/dev/zero", "/dev/null", "/dev/full"])
def test_a_device(device: str) -> None:
    if not Path(device).exists():
        pytest.skip(f"no {device} here")
    assert "is a device" in refused(Path(device))


def test_a_block_device(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    state = os.stat_result((stat.S_IFBLK | 0o600, *tmp_path.stat()[1:]))
    monkeypatch.setattr(Path, "stat", lambda *_, **__: state)
    assert "is a device" in refused(tmp_path / "disk.yaml")


def test_no_file(tmp_path: Path) -> None:
    assert "cannot be read: No such file or directory" in refused(tmp_path / "none.yaml")


def test_a_name_that_cannot_be() -> None:
    assert "has no possible name" in refused(Path("a\0b.yaml"))


def test_a_name_that_is_too_long(tmp_path: Path) -> None:
    assert "cannot be read: File name too long" in refused(tmp_path / ("x" * 5000))


def test_a_link_to_nothing(tmp_path: Path) -> None:
    path = tmp_path / "link.yaml"
    path.symlink_to(tmp_path / "none.yaml")
    assert "cannot be read: No such file or directory" in refused(path)


def test_a_link_to_itself(tmp_path: Path) -> None:
    path = tmp_path / "link.yaml"
    path.symlink_to(path)
    assert "cannot be read: " in refused(path)


def test_a_file_below_a_file(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    assert "cannot be read: Not a directory" in refused(tmp_path / "file" / "map.yaml")


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root may read everything")
def test_a_file_without_permission(tmp_path: Path) -> None:
    path = tmp_path / "map.yaml"
    path.write_text("format: 1\n")
    path.chmod(0)
    assert "cannot be read: Permission denied" in refused(path)


@pytest.mark.parametrize("where", ["stat", "open", "read"])
def test_every_step_of_reading_may_be_denied(where: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "map.yaml"
    path.write_text("format: 1\n")

    def denied(*_: object, **__: object) -> None:
        raise PermissionError(13, "Permission denied")

    owner: object = {"stat": Path, "open": os, "read": source}[where]
    monkeypatch.setattr(owner, {"read": "open"}.get(where, where), denied, raising=False)
    assert "cannot be read: Permission denied" in refused(path)


def test_no_file_is_left_open(tmp_path: Path) -> None:
    handles = Path("/proc/self/fd")
    if not handles.exists():
        pytest.skip("the system does not list open files")
    os.mkfifo(tmp_path / "pipe.yaml")
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
