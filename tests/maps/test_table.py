"""Rows of a map from a spreadsheet: what is understood, what is reported, and that the rows are good in a map."""

from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from driveblocks.cli import app
from driveblocks.maps.load import load
from driveblocks.maps.table import TableError, read

SKELETON = Path(__file__).parents[2] / "generator/driveblocks/maps/skeleton.yaml"
HEAD = "No.;Register;Name;Unit;Scale;R/W\n"
UNDERSTOOD = {
    "P1;2000H;Speed;Hz;0.01;R/W":
        "{address: 2000H, id: P1, name: Speed, access: rw, unit: Hz, scale: {factor: 0.01, source: the table}}",
    "P2;0x2001;Torque;%;1/10;ro":
        '{address: 2001H, id: P2, name: Torque, access: r, unit: "%", scale: {factor: 0.1, source: the table}}',
    ";2;Motor speed;rpm;0,5 rpm;":
        "{address: 0002H, name: Motor speed, unit: r/min, scale: {factor: 0.5, source: the table}}",
    "P3;16#20;On: yes;-;-;W": '{address: 0020H, id: P3, name: "On: yes", access: w}',
    "P4;21;Öl;;;": '{address: 0021H, id: P4, wording: "Öl"}',
    'P5;22;"Two\nlines";;;': "{address: 0022H, id: P5, name: Two lines}",
}  # fmt: skip
REPORTED = {
    "P1;20G0;Speed;;;": "`20G0` is no hex address of one register",
    "P1;2000H-2003H;Speed;;;": "`2000H-2003H` is no hex address of one register",
    "P1;2000H;;;;": "the name is empty",
    "P1;2000H;Speed;lbft;;": "`lbft` is no unit of a map",
    "P1;2000H;Speed;Hz;often;": "`often` is no factor",
    "P1;2000H;Speed;Hz;0;": "`0` is no factor",
    "P1;2000H;Speed;Hz;1;maybe": "`maybe` is no access; write r, w or rw",
    "P1;2000H": "the name is empty",
    "P1;;;;;maybe": "`` is no hex address of one register; the name is empty; `maybe` is no access; write r, w or rw",
}


@pytest.mark.parametrize("line", UNDERSTOOD)
def test_a_line_is_a_row(line: str) -> None:
    made = read(HEAD + line, "t.csv", {}, "hex")
    assert (made.rows, made.left) == ([UNDERSTOOD[line]], [])


@pytest.mark.parametrize("line", REPORTED)
def test_what_is_not_understood_is_reported_with_its_line(line: str) -> None:
    made = read(f"{HEAD}P0;1;Good;;;\n\n{line}\n", "t.csv", {}, "hex")
    assert len(made.rows) == 1
    assert made.left == [f"t.csv:4:1: {REPORTED[line]}"]


@pytest.mark.parametrize(
    ("addresses", "form", "found"),
    [
        (("10", "1F"), None, "0010H"),
        (("0010", "20h"), None, "0010H"),
        (("10", "20"), "decimal", "000AH"),
        (("10", "20"), "hex", "0010H"),
        (("40017", "40002"), None, "0010H"),
        (("40017", "40002"), "decimal", "9C51H"),
    ],
)
def test_how_addresses_are_written(addresses: tuple[str, str], form: str | None, found: str) -> None:
    text = "Register\tName\n" + "".join(f"{each}\tSpeed {at}\n" for at, each in enumerate(addresses))
    assert read(text, "t.csv", {}, form).rows[0].startswith(f"{{address: {found}, ")


def test_numbers_that_may_be_either_are_refused() -> None:
    with pytest.raises(
        TableError, match=r"^t\.csv:1:1: no address shows whether it is hexadecimal; say so by --addresses"
    ):
        read("Register,Name\n1000,Speed\n2000,Torque\n", "t.csv", {}, None)


def test_columns_are_found_by_their_heads_or_named() -> None:
    text = "Bezeichnung|Adresse|Kanal\nDrehzahl|1AH|7\n"
    assert read(text, "t.csv", {}, None).rows == ["{address: 001AH, name: Drehzahl}"]
    assert read(text, "t.csv", {"id": "Kanal"}, None).rows == ['{address: 001AH, id: "7", name: Drehzahl}']
    for wrong, columns in (
        ("no column is called `Wert`", {"name": "Wert"}),
        ("no column is the name", {}),
        ("`Address` and `Register` may be the address", {}),
    ):
        head = "Address|Register|Bezeichnung" if "may be" in wrong else "Address|Kanal|Text"
        with pytest.raises(TableError, match=wrong):
            read(f"{head}\n1AH|2|x\n", "t.csv", columns, None)


def test_pasted_text_is_parted_by_blanks() -> None:
    assert read("Register   Name\n1AH   Output speed\n", "t", {}, None).rows == ["{address: 001AH, name: Output speed}"]


def test_all_rows_are_good_in_a_map(tmp_path: Path) -> None:
    made = read(HEAD + "\n".join(each for each in UNDERSTOOD if "Öl" not in each), "t.csv", {}, "hex")
    text = SKELETON.read_text("utf-8")
    place = "      - {address: 2000H, name: Drive status,"
    assert place in text
    rows = "".join(f"      - {each}\n" for each in made.rows).replace("2000H", "3000H").replace("2001H", "3001H")
    text = text.replace("id_forms: [A9.99]", "id_forms: [A9.99, A9]").replace(place, rows + place)
    (tmp_path / "acme.yaml").write_text(text, "utf-8")
    known = load(tmp_path / "acme.yaml")
    assert known.register_at(0x3000) is not None
    assert known.register_at(0x0022) is not None


def run(*arguments: str, given: str = "") -> Result:
    return CliRunner().invoke(app, ["import-csv", *arguments], input=given)


def test_the_command(tmp_path: Path) -> None:
    good = run("-", given=HEAD + next(iter(UNDERSTOOD)))
    assert (good.exit_code, good.stderr) == (0, "1 rows, 0 left out\n")
    assert good.stdout == f"      - {UNDERSTOOD[next(iter(UNDERSTOOD))]}\n"
    some = run("-", given=f"{HEAD}P1;2000H;Speed;;;\nP1;20G0;Speed;;;")
    assert (some.exit_code, some.stderr.splitlines()[-1]) == (1, "1 rows, 1 left out")
    kept = tmp_path / "rows.yaml"
    assert run("-", "-o", str(kept), given=f"{HEAD}P1;2000H;Speed;;;").exit_code == 0
    assert kept.read_text("utf-8") == "      - {address: 2000H, id: P1, name: Speed}\n"
    again = run("-", "-o", str(kept), given=f"{HEAD}P1;2001H;Speed;;;")
    assert (again.exit_code, "is there already" in again.stderr) == (2, True)
    assert "2000H" in kept.read_text("utf-8")
    assert run("missing.csv").exit_code == 2
    assert run("-", "--column", "colour=Register", given=HEAD).exit_code == 2
