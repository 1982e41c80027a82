"""`driveblocks line`: tables that fit, JSON, a picture, mistakes all at once, and the exit status."""

import json
from pathlib import Path
from xml.etree import ElementTree

import pytest
from click.testing import CliRunner, Result
from rich.cells import cell_len

from driveblocks.cli import app
from driveblocks.desk.site import kept
from driveblocks.desk.site.found import Found, Way
from driveblocks.maps import rivals

EXAMPLE = str(Path(__file__).parents[2] / "examples" / "three_makes.st")


def line(*words: str, columns: int = 80) -> Result:
    """Run `driveblocks line` as if in a terminal of some width."""
    return CliRunner().invoke(app, ["line", *words], env={"COLUMNS": str(columns)})


@pytest.mark.parametrize("columns", [80, 120])
def test_tables_fit_and_name_what_does_not_hold(columns: int) -> None:
    names = "chf@1", "sn300g5@2", "jscc", "--device", "2", "--watchdog", "12s", "--stop-within"
    good, bad = (line(*names, within, columns=columns) for within in ("500ms", "150ms"))
    assert (good.exit_code, bad.exit_code) == (0, 1)
    assert max(map(cell_len, good.stdout.splitlines())) <= columns
    rows = [row.split() for row in good.stdout.splitlines()]
    assert [row[:2] for row in rows if row[:1] in (["1"], ["2"], ["3"], ["4"])] == [
        ["1", "CHF_1"], ["2", "SN300G5_2"], ["3", "JSCC_3"], ["4", "device"],
    ]  # fmt: skip
    assert [row[-1] for row in rows if row[:1] in (["4800"], ["9600"])] == ["stops", "yes"]
    said = " ".join(good.stdout.split()), " ".join(bad.stdout.split())
    both = (
        "all stops are sent within {} ms, every status stays within its StaleMs "
        "and every watchdog is fed in two thirds of its time"
    )
    assert f"The smallest rate at which {both.format(500)}: 9600 bit/s." in said[0]
    assert f"There is no rate at which {both.format(150)}." in said[1]


def test_the_shipped_example_has_the_figures_of_its_own_line(tmp_path: Path) -> None:
    picture = tmp_path / "round.svg"
    got = line(EXAMPLE, "--json", "--picture", str(picture))
    assert got.exit_code == 0
    told = json.loads(got.stdout)
    (own,) = [each for each in told["rates"] if each["rate"] == told["rate"]]
    assert [(each["unit"], each["name"], each["drive"]) for each in own["units"]] == [
        (1, "Pump1", "SN300G5"), (2, "Pump2", "JSCC"), (3, "Fan", "CHF"),
    ]  # fmt: skip
    assert (told["bits"], told["max_scan"], told["smallest_rate"]) == (11, 20, 4800)
    # what the same program shows in its first scan, with 500 ms of turn-round for each drive
    assert (own["all_stops_before_replies"], own["broken"]) == (1754, [])
    drawn = ElementTree.fromstring(picture.read_text(encoding="utf-8"))  # noqa: S314  (what the command has written)
    texts = [each.text for each in drawn.iter("{http://www.w3.org/2000/svg}text")]
    assert {"Pump1 (1)", "Pump2 (2)", "Fan (3)", "0 ms", f"{own['round']} ms"} <= {*texts}
    bars = [each for each in drawn.iter("{http://www.w3.org/2000/svg}rect") if each.get("class") in ("mark", "rail")]
    ends = [float(each.get("x", "0")) + float(each.get("width", "0")) for each in bars[-2:]]
    assert len(bars) == 2 + 3 * 2
    assert ends[0] < ends[1] <= 970
    assert line(EXAMPLE, "--picture", str(picture)).exit_code == 0


SLOW = ("--scan", "40ms", "--rate", "19200")


@pytest.mark.parametrize(
    ("drives", "said"),
    [
        (9, "would be {read} ms old, its StaleMs is 5000: it bars starts (Reason 55). What helps: fewer drives,"),
        (
            7,
            "may be {worst_read} ms old when other drives fail, its StaleMs is 5000: that stops the motor. What helps:",
        ),
    ],
)
def test_a_line_that_is_too_slow_for_its_drives_says_so_with_both_figures(drives: int, said: str) -> None:
    got = line(*["pf525"] * drives, *SLOW, columns=100)
    told = json.loads(line(*["pf525"] * drives, *SLOW, "--json").stdout)
    (own,) = [each for each in told["rates"] if each["rate"] == told["rate"]]
    assert (got.exit_code, own["broken"], told["smallest_rate"]) == (1, ["status"], None)
    text = " ".join(got.stdout.split())
    names = ", ".join(f"PF525_{unit} ({unit})" for unit in range(1, drives + 1))
    assert f"The status of {names} {said.format(**own['units'][0])}" in text
    assert text.endswith("There is no rate at which every status stays within its StaleMs.")
    assert text.count("What helps") == 1


def test_what_feeds_a_watchdog_may_wait_for_two_thirds_of_its_time() -> None:
    words = "chf", "chf", "chf", "--rate", "19200", "--watchdog"
    fed = [json.loads(line(*words, time, "--json").stdout)["rates"][4]["units"][0] for time in ("2s", "6s")]
    assert [each["watchdog_margin"] for each in fed] == [2 * ms // 3 - fed[0]["worst_feed"] for ms in (2000, 6000)]
    bad, good = (line(*words, time, columns=100) for time in ("2s", "6s"))
    assert (bad.exit_code, good.exit_code) == (1, 0)
    said = f"may wait {fed[0]['worst_feed']} ms, more than two thirds of 2000 ms: it may trip. What helps:"
    assert f"What feeds the watchdog of CHF_1 (1), CHF_2 (2), CHF_3 (3) {said}" in " ".join(bad.stdout.split())


def test_families_whose_stop_would_move_the_other_are_named() -> None:
    got = line("pf525@1", "gd200a@2", "mx2@3", columns=100)
    said = " ".join(got.stdout.split())
    assert "A stop of PF525 at a GD200A may start the motor; its block sees that by 007CH, its own unit" in said
    assert "A stop of GD200A at a PF525 may start the motor; its block sees that by 0E00H, its own unit" in said
    assert said.count("A stop of") == 2
    assert got.exit_code == 0
    told = json.loads(line("jscc", "chf", "--json").stdout)["mistaken"]
    assert [(each["block"], each["drive"], each["means"]) for each in told] == [("JSCC", "CHF", "motion")]


def test_families_that_nothing_tells_apart_do_not_hold(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(rivals, "told_apart", lambda _, __: "")
    got = line("jscc@1", "chf@2", columns=100)
    assert got.exit_code == 1
    assert "nothing tells the two apart: check the addresses" in " ".join(got.stdout.split())
    assert line("chf@1", "mx2@2").exit_code == 0


@pytest.mark.parametrize(
    ("words", "wrote"),
    [
        ("line mine.st --picture mine.st", "`driveblocks line --picture`"),
        ("site --html site.yaml", "`driveblocks site --html`"),
        ("test jscc --junit mine.xml", "`driveblocks test` or `prove`"),
        ("prove jscc --junit mine.st", "`driveblocks test` or `prove`"),
    ],
)
def test_a_file_that_no_such_command_has_written_is_refused_before_any_work(
    words: str, wrote: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    kept.write(
        Path("site.yaml"), kept.About("Pump", "jscc", "12345678", "2026-11-23 10:30", ""), Found(Way(9600), 1, "fits")
    )
    Path("mine.st").write_bytes(Path(EXAMPLE).read_bytes())
    Path("mine.xml").write_text('<?xml version="1.0"?>\n<testsuites name="theirs"/>\n', encoding="utf-8")
    before = {path: path.read_bytes() for path in Path().iterdir()}
    got = CliRunner().invoke(app, words.split())
    why = f"there is a file that no {wrote} has written; name a new one, or move it away"
    assert (got.exit_code, got.output) == (2, f"{words.rsplit(maxsplit=1)[-1]}: {why}\n")
    assert {path: path.read_bytes() for path in Path().iterdir()} == before


def test_a_rate_and_a_scan_beside_a_program_try_another_line() -> None:
    slow, quick = (json.loads(line(EXAMPLE, "--json", "--rate", rate).stdout) for rate in ("4800", "9600"))
    assert (slow["rate"], quick["rate"]) == (4800, 9600)
    assert slow["rates"] == quick["rates"]
    short = json.loads(line(EXAMPLE, "--json", "--scan", "5ms").stdout)
    assert short["rates"][0]["round"] < slow["rates"][0]["round"]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ((), ["name a drive or a program; for example: driveblocks line chf@1 jscc@2"]),
        (("--device", "1"), ["there is no drive on the line; name one, such as chf@1"]),
        (
            ("chf@300", "--rate", "5", "--format", "9X1", "--scan", "0s", "--device", "17", "--reply", "soon"),
            [
                "--scan 0s is out of range; write 0.001s to 1s",
                "--reply: `soon` is no time; write 10ms, 2.5s or 1min",
                "--rate 5 is out of range; write 300 to 1000000 bit/s",
                "--format 9X1 is no format; write one of 8N1, 8E1, 8O1, 8N2, 7E1, 7O1, 7N2",
                "--device 17 is out of range; write 1 to 16 registers",
                "chf@300: units are 1 to 247, one drive each; write chf@1",
            ],
        ),
        (("chf", "--scan", "30ms", "--max-scan", "20ms"), ["--max-scan 20ms is shorter than --scan 30ms"]),
        (("chf",) * 33, ["33 units; a line has 1 to 32"]),
        (("chf", "--program", "X"), ["--program is for a file with several PROGRAMs"]),
        (
            (EXAMPLE, "chf", "--device", "1", "--watchdog", "1s"),
            [
                "name one program, or drives",
                "--device is for named drives; a program says so itself",
                "--watchdog is for named drives; a program says so itself",
            ],
        ),
        (("absent.st",), ["absent.st:1:1: cannot be read: No such file or directory"]),
        (
            ("sn300g5@3", "--rate", "115200", "--ascii", "--format", "7O1"),
            ["SN300G5_3 has no 115200 bit/s; its manual names 1200, 2400, 4800, 9600", "SN300G5_3 speaks no ASCII"],
        ),
    ],
)
def test_all_mistakes_are_reported_at_once(words: tuple[str, ...], said: list[str]) -> None:
    got = line(*words)
    assert (got.exit_code, got.stderr.splitlines(), got.stdout) == (2, said, "")


def test_seven_data_bits_are_for_ascii() -> None:
    got = line("jscc", "--format", "7E1")
    assert (got.exit_code, got.stderr) == (2, "7 data bits are for ASCII; add --ascii\n")
    assert line("jscc", "--format", "7E1", "--ascii").exit_code == 0
