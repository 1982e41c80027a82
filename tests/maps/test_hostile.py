"""Files made to hurt end in a clear message, within a second and little memory, with libyaml and without."""

import json
import os
import re
import socket
import stat
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from tests.maps.hostile_files import CONTENTS

from driveblocks.maps import load, source
from driveblocks.maps.problem import MapError

PROBE = Path(__file__).parent / "hostile_probe.py"
SECONDS = 1.0
PARTS = 6
"""Groups of files that share one start of the interpreter."""


def refused(path: Path) -> str:
    """The first message for a file that must be refused, within a second of processor time."""
    start = time.process_time()
    with pytest.raises(MapError) as caught:
        load.load(path)
    assert time.process_time() - start < SECONDS
    return str(caught.value.problems[0])


@pytest.mark.parametrize("parser", ["c", "python"])
@pytest.mark.parametrize("part", range(PARTS))
def test_hostile_files_are_refused_at_little_cost(part: int, parser: str, tmp_path: Path) -> None:
    names = list(CONTENTS)[part::PARTS]
    paths = [tmp_path / name for name in names]
    for path in paths:
        path.write_bytes(CONTENTS[path.name])
    command = [sys.executable, str(PROBE), parser, *map(str, paths)]
    run = subprocess.run(command, check=True, capture_output=True, text=True, timeout=120)
    costs = [json.loads(line) for line in run.stdout.splitlines()]
    assert [cost["name"] for cost in costs] == names
    assert {cost["name"]: cost["trace"] for cost in costs if cost["trace"]} == {}
    assert {cost["name"]: cost["seconds"] for cost in costs if cost["seconds"] > SECONDS} == {}
    assert [cost["name"] for cost in costs if not _clear(tmp_path / cost["name"], cost["messages"])] == []
    assert not (Path.cwd() / "hacked").exists()


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


def test_a_file_that_grows_while_it_is_read(tmp_path: Path) -> None:
    path = tmp_path / "log.yaml"
    path.write_bytes(b"# a log\n" * 60_000)
    stop = threading.Event()
    writer = threading.Thread(target=_grow(path, stop))
    writer.start()
    try:
        time.sleep(0.05)
        message = refused(path)
    finally:
        stop.set()
        writer.join()
    assert "is larger than" in message or "is empty" in message


def _grow(path: Path, stop: threading.Event) -> Callable[[], None]:
    def grow() -> None:
        with path.open("ab") as file:
            for _ in range(2000):
                if stop.wait(0.0002):
                    return
                file.write(b"# another line\n" * 100)
                file.flush()

    return grow
