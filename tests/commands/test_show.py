"""`driveblocks show`: pages that fit any width and lose nothing, the right page for every word, JSON for scripts."""

import json
import os
import re
import subprocess
import sys
from collections import Counter
from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import CliRunner, Result
from rich.cells import cell_len

from driveblocks import __version__
from driveblocks.cli import app
from driveblocks.commands.show import TOPICS
from driveblocks.maps import catalog
from driveblocks.maps.page import skeleton

EXAMPLE = str(Path(__file__).parents[1] / "maps" / "example.yaml")
MAPS = [EXAMPLE, *(str(path) for path in catalog.shipped())]


def show(*words: str, columns: int = 80) -> Result:
    """Run `driveblocks show` as if in a terminal of some width."""
    return CliRunner().invoke(app, ["show", *words], env={"COLUMNS": str(columns)})


def page(*words: str, columns: int = 80) -> str:
    """What `driveblocks show` prints about the example."""
    result = show(EXAMPLE, *words, columns=columns)
    assert result.exit_code == 0, result.output
    return result.stdout


def squeezed(text: str) -> str:
    """A text with every run of blanks and line ends as one blank, so that folding does not matter."""
    return " ".join(text.split())


def assert_fits(shown: Callable[[int], Result]) -> None:
    """What is shown at some width fits there, and folding loses no character."""
    pages = {columns: shown(columns) for columns in (80, 120, 1000)}
    for columns, result in pages.items():
        assert result.exit_code in (0, 1), result.output
        assert max(map(cell_len, result.stdout.splitlines())) <= columns
        assert "\x1b" not in result.stdout
        assert not re.search(r"[ \t]$", result.stdout, re.MULTILINE)
    wide, *folded = (Counter(re.sub(r"[\s─]", "", pages[columns].stdout)) for columns in (1000, 120, 80))
    assert folded == [wide, wide]


@pytest.mark.parametrize(
    ("own", "head"), [("", "name"), (", wording: Overcurent", "name as printed"), (", zh: 过流", "name 中文")]
)
def test_the_column_of_the_manuals_own_words_is_there_where_it_has_some(tmp_path: Path, own: str, head: str) -> None:
    path = tmp_path / "acme.yaml"
    text = skeleton().replace("name: Overcurrent", f"name: Overcurrent{own}")
    path.write_text(text, encoding="utf-8")
    shown = squeezed(show(str(path), "faults").stdout)
    assert f"code display {head} note" in shown
    assert f"Overcurrent {own.partition(': ')[2]}".strip() in shown


@pytest.mark.parametrize("topic", ["", *TOPICS])
@pytest.mark.parametrize("path", MAPS, ids=lambda path: Path(path).stem)
@pytest.mark.thorough
def test_a_page_fits_any_terminal_and_folding_loses_no_character(path: str, topic: str) -> None:
    assert_fits(lambda columns: show(path, *filter(None, [topic]), columns=columns))


@pytest.mark.parametrize("path", MAPS, ids=lambda path: Path(path).stem)
def test_no_column_is_squeezed_at_80_columns(path: str) -> None:
    """Every column of text keeps the 12 columns that layout.table promises, however long its neighbours are."""
    lines = show(path, "registers", columns=80).stdout.splitlines()
    for head in (line for line in lines if line.startswith("address ") and " name " in line):
        between = re.search(r"name +(中文 +)?(as printed|unit|see|$)", head)
        assert between is not None
        assert cell_len(between[0]) >= (24 if between[1] else 12)


@pytest.mark.parametrize("topic", ["faults", "errors", "errata", "absent", "settings", "notices"])
def test_a_topic_shows_every_text_that_its_json_holds(topic: str) -> None:
    shown = squeezed(page(topic, columns=1000))
    for entry in json.loads(page(topic, "--json"))[topic]:
        for key in ("id", "name", "text_zh", "where", "printed", "used", "why", "what", "matters", "find_out"):
            if isinstance(entry.get(key), str):
                assert entry[key] in shown


def test_the_overview_lists_the_line_the_commands_and_the_registers() -> None:
    shown = squeezed(page())
    for text in (
        "EX100 Example Drives 示例电气",
        "edition V1.0",
        "1 = 9600 bit/s",
        "16 words in one read",
        "10H Write several registers 写多个寄存器",
        "1: the PLC speaks RTU",
        "run forward 0000H 0 1, 2, 3",
        "17H Write and read 写后读寄存器; no block sends it",
        "section 9.5 says that the motor runs out while its output is blocked",
        "0010H bit 0 = 0 and 0020H = 0",
        "write 0 to FFFDH at most 100000 times",
        "cable cut the motor coasts; after 0202H x 100 ms; fed by any good write; the fault has to be reset",
        "trip the motor coasts or is decelerated, by the fault or a setting; EF1 ramps down, all others coast (section",
        "bus commands while 0011H = 1 (section 9.5 (II), 0011H)",
        "own maximum the manual does not say where to read it",
        "identity 0031H = 25601 (section 9.5 (III), 0031H)",
        "all 27 17 5 13",
        "8 errata, 3 absent",
        "0023H U1-04 r DC bus voltage 直流电压 0.1 V E",
        "0106H- A2-01.. rw User parameter 用户参数 0109H A2-04",
        "address = 0800H + sequence number",
    ):
        assert text in shown


@pytest.mark.parametrize("word", ["4096", "1000H", "0x1000", "1000"])
def test_an_address_may_be_decimal(word: str) -> None:
    result = show("chf", word)
    assert (result.exit_code, result.stdout.splitlines()[0]) == (0, "CHF  1000H")


def test_a_decimal_address_that_is_one_in_hexadecimal_too_is_named() -> None:
    shown = show("chf", "8192").stdout
    assert shown.startswith("CHF  8192H\n")
    assert "also: 2000H  register  Communication setting" in shown


@pytest.mark.parametrize(
    ("word", "text"),
    [
        ("0000H", "stop: clear bit 0, 1, 2 (the ramp bits are kept)"),
        ("0000H", "motor bit 0 `Run forward` at 0 stops the motor bit 0 `Run forward` at 1 starts the motor"),
        ("0000H", "bit 3 `Output blocked` at 1 lets the motor coast, whatever else is set"),
        ("0000H", "3 Output blocked 1: 封锁输出 the motor runs out"),
        ("0000H", "8-9 Ramp 加减速选择 =0 Ramp 1 加减速1"),
        ("0012H", "2 02H Wrong length 长度错误 counted since power on"),
        ("U1-01", "unit Hz; the manual gives no scale"),
        ("U1-01", "not said: scale of U1-01 and U1-02"),
        ("A2-03", "EX100 0108H A2-03"),
        ("A2-03", "one of 0106H-0109H A2-01..A2-04"),
        ("OS", "EX100 fault 11H (17) OS"),
        ("11H", "printed 起速"),
        ("17", "0015H.0 Overspeed 超速"),
        ("0001H", "also: 01H OC fault Overcurrent"),
        ("01H", "This is several things; all follow: 01H OC fault"),
        ("01H", "error 01H Illegal function 非法命令"),
        ("0023H", "DC bus voltage 直流电压"),
        ("u1-04", "printed 输出电压"),
        ("0x23", "one count is 0.1 V proved by the example frame read_voltage_reply"),
        ("0023", "erratum: section 9.5 (III), row U1-04"),
        ("083AH", "sequence number 58 of: Function code parameters 功能码参数"),
        ("H5-02", "2 19200 bit/s 19200BPS not on cables over 100 m"),
        ("08H", "0000H Return the request 返回询问数据"),
        ("run_request", "printed instead: D12=0D44"),
        ("monitors", "series U1-01..U1-04 from 0020H, apart from U1-03"),
        ("0003H", "name (not used)"),
        ("FFFDH", "prohibition: Do not use ENTER often 中文 请勿频繁使用存储命令"),
        ("0001H", "one count is 0.01 % only while 000FH bit 0 = 0"),
        ("registers", "0001H rw Frequency reference 频率给定 0.01 % * N"),
        ("frames", "WRONG; the printed one belongs to 01 06 00 01 13 80"),
        ("FRAMES", "fields unit 1, function 03H, words 1, byte count 2, values 5488, 0023H = 548.8 V"),
        ("errors", "function code + 80H, then one byte with the code"),
        ("errors", "error no code Memory busy 存储器忙"),
        ("faults", "code = 16 x (word - 0014H) + bit + 1"),
        ("serial", "silence 3.5 characters around a frame, 5 ms around a frame, at most 1.5 characters inside"),
        ("notices", "prohibition: Do not use ENTER often 中文 请勿频繁使用存储命令"),
    ],
)
def test_every_word_and_topic_has_its_page(word: str, text: str) -> None:
    assert text in squeezed(page(word))


def test_an_unknown_word_is_answered_with_what_is_near() -> None:
    result = show(EXAMPLE, "voltag")
    assert (result.exit_code, result.stdout) == (2, "")
    assert result.stderr.splitlines() == [
        "EX100 has no register, fault or topic `voltag`",
        "nearest are",
        "  0023H  U1-04  DC bus voltage  直流电压",
        "  02H  OV  fault  Overvoltage  过压",
        "  read_voltage_request  example frame",
        "  read_voltage_reply  example frame",
        "topics are registers, faults, errors, frames, errata, absent, serial, settings, notices",
    ]


def test_json_of_a_topic_holds_only_that() -> None:
    seen = json.loads(page("faults", "--json", columns=60))
    assert list(seen) == ["drive", "faults"]
    assert [fault["code"] for fault in seen["faults"]] == [1, 2, 17, 18]


def test_json_of_one_register_is_refused() -> None:
    result = show(EXAMPLE, "0023H", "--json")
    assert (result.exit_code, result.stdout) == (2, "")
    assert "prints a whole drive or a topic, not `0023H`" in result.stderr


def test_the_version_is_printed() -> None:
    result = CliRunner().invoke(app, ["--version"])
    assert (result.exit_code, result.stdout) == (0, f"driveblocks {__version__}\n")


def _run(*words: str, **environment: str) -> subprocess.CompletedProcess[bytes]:
    """A process of its own with hardly any environment."""
    command = [sys.executable, "-m", "driveblocks.cli", *words]
    return subprocess.run(command, capture_output=True, timeout=600, check=False, env=_environment(environment))


def _environment(more: dict[str, str]) -> dict[str, str]:
    kept = {
        key: os.environ[key]
        for key in ("PATH", "PYTHONPATH", "SYSTEMROOT", "COVERAGE_PROCESS_START")
        if key in os.environ
    }
    return {**kept, **more}


@pytest.mark.parametrize(
    "environment",
    [{"LC_ALL": "C", "PYTHONCOERCECLOCALE": "0", "PYTHONUTF8": "0"}, {"LC_ALL": "C", "PYTHONIOENCODING": "latin-1"}],
)
def test_chinese_comes_out_whole_under_a_c_locale(environment: dict[str, str]) -> None:
    shown = _run("show", EXAMPLE, "0023H", **environment)
    assert (shown.returncode, shown.stderr) == (0, b"")
    assert "直流电压" in shown.stdout.decode("utf-8")
    assert "直流电压" in _run("show", EXAMPLE, "--json", **environment).stdout.decode("utf-8")
    refused = _run("show", EXAMPLE, "voltag", **environment)
    assert "直流电压" in refused.stderr.decode("utf-8")


@pytest.mark.parametrize("words", [("show", EXAMPLE), ("check", EXAMPLE)])
def test_a_closed_pipe_is_no_error_to_tell(words: tuple[str, ...]) -> None:
    reader, writer = os.pipe()
    os.close(reader)
    command = [sys.executable, "-m", "driveblocks.cli", *words]
    try:
        ended = subprocess.run(command, stdout=writer, stderr=subprocess.PIPE, timeout=600, check=False)
    finally:
        os.close(writer)
    assert ended.stderr == b""


def test_help_needs_neither_rich_nor_yaml() -> None:
    code = (
        "import sys, driveblocks.cli as cli\n"
        "try:\n    cli.app(['--version'])\nexcept SystemExit:\n    pass\n"
        "print(sorted({'rich.table', 'yaml', 'jinja2', 'driveblocks.maps.load'} & set(sys.modules)))"
    )
    ended = subprocess.run([sys.executable, "-c", code], capture_output=True, timeout=600, check=True, text=True)
    assert ended.stdout.splitlines()[-1] == "[]"
