"""What is printed: nothing that steers a terminal or turns the direction of writing, in any command."""

import errno
import io
import json
import os
import re
import sys
import unicodedata
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NoReturn

import pytest
from rich.text import Text

from driveblocks import cli, console
from driveblocks.bench import runner
from driveblocks.bench.outcome import Run
from driveblocks.desk.run import probe
from driveblocks.maps.problem import Refused
from driveblocks.output import build
from driveblocks.prove import archive
from driveblocks.show.layout import card, heading, table
from structured_text.visible import file_name, visible

HOSTILE = "\x1b[31mred\x1b]0;t\x07\r\x08\x7f\x9b5m\u202eback\u2066\u200b\u2028\ufeff\U000e0041"
SEEN = r"\u001b[31mred\u001b]0;t\u0007\u000d\u0008\u007f\u009b5m\u202eback\u2066\u200b\u2028\ufeff\udb40\udc41"

DRAWN = re.compile(r"\r?\x1b\[(?!31m)[\d;?]*[a-zA-Z]")
"""What a bar is drawn with."""
Printed = Callable[..., str]


class Stream(io.TextIOWrapper):
    """A stream that says that it is a terminal, or not."""

    terminal = False

    def isatty(self) -> bool:
        """Whether colours go there."""
        return self.terminal


@pytest.fixture(params=[False, True], ids=["pipe", "terminal"])
def printed(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Printed:
    """What the command line prints on both streams, or what a function does."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(Stream, "terminal", request.param)
    monkeypatch.setenv("COLUMNS", "1000")
    monkeypatch.setenv("TERM", "xterm-256color")

    def run(*words: str, function: Callable[[], None] = cli.main) -> str:
        buffer = io.BytesIO()
        with monkeypatch.context() as patch:
            patch.setattr(sys, "argv", ["driveblocks", *words])
            for name in ("stdout", "stderr"):
                patch.setattr(sys, name, Stream(buffer, encoding="utf-8", write_through=True))
            if function is cli.main:
                with pytest.raises(SystemExit):
                    function()
            else:
                console.use_safe_utf8()
                function()
            return buffer.getvalue().decode("utf-8")

    return run


def test_everything_that_steers_or_turns_is_written_out() -> None:
    for code in range(sys.maxunicode + 1):
        sign = chr(code)
        steers = unicodedata.category(sign) in ("Cc", "Cs", "Zl", "Zp") and sign not in "\t\n"
        turns = unicodedata.bidirectional(sign) in ("LRE", "RLE", "LRO", "RLO", "PDF", "LRI", "RLI", "FSI", "PDI")
        if steers or turns:
            assert json.loads(f'"{visible(sign)}"') == sign
            assert visible(sign).isascii()


def test_what_people_write_stays() -> None:
    text = "Überstrom\t过流，85 °C \N{EM DASH} “x” é\n１２ ✓ 𝛼"
    assert visible(text) == text
    assert file_name("a\tb\n过流.yaml") == r"a\u0009b\u000a过流.yaml"


@pytest.mark.parametrize(
    "words",
    [
        [HOSTILE],
        ["show", HOSTILE],
        ["show", f"--{HOSTILE}"],
        ["show", "jscc", HOSTILE],
        ["show", f"{HOSTILE}.yaml"],
        ["check", f"{HOSTILE}.yaml", HOSTILE],
        ["build", f"{HOSTILE}.yaml"],
        ["build", "--lang", HOSTILE],
        ["test", f"{HOSTILE}.yaml"],
        ["test", "--engine", HOSTILE],
        ["counts", HOSTILE],
        ["lint", f"{HOSTILE}.st"],
        ["lint", "--select", HOSTILE, "x.st"],
        ["explain", "01 03", "--drive", HOSTILE],
    ],
    ids=lambda words: " ".join(words).replace(HOSTILE, "HOSTILE"),
)
def test_words_of_the_command_line(printed: Printed, words: list[str]) -> None:
    text = DRAWN.sub("", printed(*words))
    assert "[31mred" in text.casefold()
    assert all(sign.isprintable() or sign == "\n" for sign in text)


def test_what_is_in_a_frame(printed: Printed) -> None:
    text = printed("explain", ":0103200000\x1b[31m\x9b01DB")
    assert r"\u001b[31m\u009b" in text
    assert "\x1b[31m" not in text
    assert "\x9b" not in text


def test_tables_keep_their_columns_and_a_terminal_its_colours(printed: Printed) -> None:
    def show() -> None:
        made = table("name", "text")
        made.add_row(HOSTILE, HOSTILE)
        made.add_row("a", "b")
        console.write(heading("Title"), card(HOSTILE, ("label", Text(HOSTILE))), made, HOSTILE)

    text = printed(function=show)
    lines = text.splitlines()
    assert text.count(SEEN) == 3
    assert text.count(r"m\u202eback") == 5
    assert ("\x1b[1m" in text) is Stream.terminal
    assert "\x1b[31m" not in text
    row = next(line for line in lines if line.startswith("a "))
    assert row.index("b") == len(SEEN) + 2


def test_a_width_beyond_any_terminal_is_not_believed(printed: Printed, monkeypatch: pytest.MonkeyPatch) -> None:
    def show() -> None:
        monkeypatch.setenv("COLUMNS", "99999999")
        console.write(table("name", wide=("name",)))

    assert max(map(len, printed(function=show).splitlines())) <= console.WIDEST


def test_output_that_nobody_takes(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "argv", ["driveblocks", "doctor"])
    monkeypatch.setattr(sys, "stderr", sys.stderr)
    monkeypatch.setattr(sys, "stdout", None)
    with pytest.raises(SystemExit) as ended:
        cli.main()
    assert ended.value.code == 0


def test_output_onto_a_full_disk(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    class Full(io.StringIO):
        def write(self, _text: str, /) -> int:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(sys, "argv", ["driveblocks", "check", "jscc"])
    monkeypatch.setattr(sys, "stderr", sys.stderr)
    monkeypatch.setattr(sys, "stdout", Full())
    with pytest.raises(SystemExit) as ended:
        cli.main()
    assert ended.value.code == 2
    assert capsys.readouterr().err == f"standard output: {os.strerror(errno.ENOSPC)}\n"


@pytest.mark.parametrize(
    "words", [["schema"], ["schema", "--check"], ["lint"], ["show"], ["check"], ["counts"]], ids=" ".join
)
@pytest.mark.parametrize("name", ["x" * 300, "nowhere/x.st", __file__ + "/x"], ids=["long", "missing", "in a file"])
def test_names_of_what_is_not_there(printed: Printed, words: list[str], name: str) -> None:
    assert printed(*words, name).count("\n") <= 2


def test_a_terminal_shows_how_far_it_is_until_something_else_is_printed(printed: Printed) -> None:
    def work() -> None:
        for ticks in (False, True):
            bar = console.Bar(console.terminal("stderr"), ticks=ticks)
            bar.show(3, 7, f"RED {ticks}\x1b[31m")
            bar.close()
            console.write("printed")
            bar.show(5, 7, "going on")
            bar.close()
            bar.close()

    text = printed(function=work)
    seen = [f"RED {ticks}" in text and " 43 %" in text and " 71 %" in text for ticks in (False, True)]
    assert seen == [Stream.terminal] * 2
    assert text.count("\x1b[?25h") == text.count("\x1b[?25l") == (4 if Stream.terminal else 0), "the cursor is back"
    assert "\x1b[31m" not in text
    assert Stream.terminal or text == "printed\n" * 2


def test_how_long_it_takes_still_is_reckoned_from_the_share_that_is_done(printed: Printed) -> None:
    seconds = [0.0]

    def work() -> None:
        bar = console.Bar(console.terminal(), ticks=False, clock=lambda: seconds[0])
        for at, done, total, name in ((100, 0, 8, "one"), (106, 2, 8, "one"), (116, 0, 4, "two"), (119, 3, 4, "two")):
            seconds[0] = at
            bar.show(done, total, name)
        bar.close()

    text = printed(function=work)
    for words in ("0 s: one", "6 s, about 18 s left: one", "0 s: two", "3 s, about 1 s left: two"):
        assert (words in DRAWN.sub("", text)) is Stream.terminal


def test_a_bar_has_one_line_however_long_its_words_are(printed: Printed, monkeypatch: pytest.MonkeyPatch) -> None:
    def work() -> None:
        monkeypatch.setenv("COLUMNS", "80")
        bar = console.Bar(console.terminal(), ticks=False, clock=iter((0.0, 0.0, *[50.0] * 9)).__next__)
        for done in (0, 5):
            bar.show(done, 10, "power-up: nothing turns, every drive answers, a reset closes the contacts")
        bar.close()

    text = DRAWN.sub("", printed(function=work)).strip()
    assert "\n" not in text
    assert ("50 % 50 s, about 50 s left: power-up: nothing turns, …" in text) is Stream.terminal


@pytest.mark.parametrize(
    ("share", "seconds", "said"),
    [
        (0.0, 5.0, "5 s"),
        (0.04, 5.0, "5 s"),
        (0.5, 0.9, "1 s"),
        (0.5, 50.0, "50 s, about 50 s left"),
        (0.1, 99.0, "99 s, about 15 min left"),
        (1.0, 240.0, "4 min"),
    ],
)
def test_a_time_that_is_left_is_said_when_it_can_be_known(share: float, seconds: float, said: str) -> None:
    assert console.left(share, seconds) == said


def test_the_commands_that_take_long_say_on_a_terminal_how_far_they_are(
    printed: Printed, monkeypatch: pytest.MonkeyPatch
) -> None:
    def proofs(*_: object, **told: Callable[[int, int, str], None]) -> Iterator[NoReturn]:
        told["tell"](1, 2, "a block")
        yield from ()

    monkeypatch.setattr(archive, "run", proofs)
    text = printed("prove", "jscc")
    assert ("a block" in text and "50 %" in text) is Stream.terminal

    def run(*given: Any) -> Run:
        given[-1](3, 4, "a drive")
        return Run([], 0.0)

    monkeypatch.setattr(runner, "run", run)
    text = printed("test", "jscc")
    assert ("making the programs" in text and "a drive" in text and "75 %" in text) is Stream.terminal

    def made(*_: object, tell: Callable[[str], None]) -> dict[str, str]:
        tell(build.PAGES)
        return {}

    monkeypatch.setattr(build, "files", made)
    text = printed("build", "jscc", "--to", "siemens")
    assert all(words in text for words in ("0 %", "the maps", "50 %", "the pages")) is Stream.terminal

    def compiled(*given: Any) -> NoReturn:
        given[-1](0.5)
        raise Refused("no more")

    monkeypatch.setattr(probe, "compiled", compiled)
    Path("my.st").touch()
    text = printed("run", "my.st")
    assert all(words in text for words in ("the maps", "75 %", "compiling my.st")) is Stream.terminal
    assert DRAWN.sub("", text).splitlines()[-1] == "no more"
