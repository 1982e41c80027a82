"""The command as a whole: its list of commands; Ctrl-C ends it without a word."""

import builtins
import re
import runpy
import sys
from typing import Any, NoReturn

import pytest
from click.testing import CliRunner

from driveblocks.cli import app, main
from driveblocks.maps import catalog


def test_the_list_of_commands_says_what_each_does_in_a_line() -> None:
    shown = CliRunner().invoke(app, ["--help"], terminal_width=80).stdout
    assert len(re.findall(r"^  [a-z][a-z-]* +[A-Z].*\.$", shown, re.MULTILINE)) == len(app.commands)
    assert "...\n" not in shown.partition("Commands:")[2]


def interrupted(*_arguments: object) -> NoReturn:
    raise KeyboardInterrupt


def test_ctrl_c_ends_a_command_quietly(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr(catalog, "shipped", interrupted)
    monkeypatch.setattr(sys, "argv", ["driveblocks", "check"])
    for name in ("stdout", "stderr"):
        monkeypatch.setattr(sys, name, getattr(sys, name))
    with pytest.raises(SystemExit) as end:
        main()
    assert end.value.code == 130
    assert "".join(capsys.readouterr()) == "\n"  # after the ^C that a terminal shows


def test_ctrl_c_ends_quietly_what_is_still_loading(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    real = builtins.__import__

    def loading(name: str, *arguments: Any, **options: Any) -> object:
        return interrupted() if arguments[2:3] == (("cli",),) else real(name, *arguments, **options)

    monkeypatch.setattr(builtins, "__import__", loading)
    with pytest.raises(SystemExit) as end:
        runpy.run_module("driveblocks", run_name="__main__")
    assert end.value.code == 130
    assert not capsys.readouterr().err


def test_a_process_that_one_file_has_started_for_itself_does_its_share_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "frozen", True, raising=False)
    monkeypatch.setattr("multiprocessing.freeze_support", lambda: sys.exit(7))
    with pytest.raises(SystemExit) as end:
        runpy.run_module("driveblocks", run_name="__main__")
    assert end.value.code == 7
