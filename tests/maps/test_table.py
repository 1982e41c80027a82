"""Rows of a map from a spreadsheet: what is understood, what is reported, and that the rows are good in a map."""

from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from driveblocks.cli import app
from driveblocks.maps.form import SPACES
from driveblocks.maps.load import load
from driveblocks.maps.problem import Refused
from driveblocks.maps.table import MOST, Reading, TableError, read

SKELETON = Path(__file__).parents[2] / "generator/driveblocks/maps/skeleton.yaml"
HEAD = "No.;Register;Name;Unit;Scale;R/W\n"
HEX = Reading(addresses="hex")
NOTHING_SAID = Reading()
ASSUMED = (
    "no column names the table of Modbus: their section says it, by `space`; "
    "no column gives the type of a value: none has a sign, and one of one register has 16 bits"
)
UNDERSTOOD = {
    "P1;2000H;Speed;Hz;0.01;R/W":
        "{address: 2000H, id: P1, name: Speed, access: rw, unit: Hz, scale: {factor: 0.01, source: the table}}",
    "P2;0x2001;Torque;%;1/10;ro":
        '{address: 2001H, id: P2, name: Torque, access: r, unit: "%", scale: {factor: 0.1, source: the table}}',
    ";2;Motor speed;rpm;0,5 rpm;":
        "{address: 0002H, name: Motor speed, unit: r/min, scale: {factor: 0.5, source: the table}}",
    "P3;16#20;On: yes;-;-;W": '{address: 0020H, id: P3, name: "On: yes", access: w}',
    "P4;21;Öl;;;": '{address: 0021H, id: P4, wording: "Öl"}',
    ";23;Power;kW;x0.1;": "{address: 0023H, name: Power, unit: kW, scale: {factor: 0.1, source: the table}}",
    ";24;Torque;Nm;/100;": "{address: 0024H, name: Torque, unit: Nm, scale: {factor: 0.01, source: the table}}",
    ";25;Real power;0.1 kW;;": "{address: 0025H, name: Real power, unit: kW, scale: {factor: 0.1, source: the table}}",
    ";26;Rating;;0.1 kW;": "{address: 0026H, name: Rating, unit: kW, scale: {factor: 0.1, source: the table}}",
    ";27;Motors;;1;": "{address: 0027H, name: Motors}",
    'P5;22;"Two\nlines";;;': "{address: 0022H, id: P5, name: Two lines}",
}  # fmt: skip
REPORTED = {
    "P1;20G0;Speed;;;": "`20G0` is no hex address of one register",
    "P1;2000H-2003H;Speed;;;": "`2000H-2003H` is no hex address of one register",
    "P1;2000H;;;;": "the name is empty",
    "P1;2000H;-;;;": "the name is empty",
    "P1;2000H;Speed;H;;": "`H` is no unit of a map",
    "P1;2000H;Speed;lbft;;": "`lbft` is no unit of a map",
    "P1;2000H;Speed;Hz;often;": "`often` is no factor",
    "P1;2000H;Speed;Hz;0;": "`0` is no factor",
    "P1;2000H;Speed;Hz;1-10;": "`1-10` is no factor",
    "P1;2000H;Speed;Hz;10^-2;": "`10^-2` is no factor",
    "P1;2000H;Speed;Hz;1e-2;": "`1e-2` is no factor",
    "P1;2000H;Speed;Hz;1,000;": "`1,000` is no factor",
    "P1;2000H;Speed;Hz;0.01 kHz;": "`0.01 kHz` is no factor",
    "P1;2000H;Speed;Hz;/0.01;": "100 Hz per count is no factor of a drive",
    "P1;2000H;Speed;Hz;1/3;": "0.3333333333333333333333333333 has more than 9 decimals",
    f"P1;2000H;Speed;Hz;1/{'9' * 5000};": f"`1/{'9' * 58}...` is no factor",
    "P1;2000H;Speed;;0.01;": "a factor without a unit",
    "P1 to P3;2000H;Speed;;;": "`P1 to P3` is no id",
    "P1;2000H;Spe\x1bed;;;": "the name is no text",
    "P1;\x1b[2J;Speed;;;": r"`\u001b[2J` is no hex address of one register",
    "P1;2000H;Speed;Hz;1;maybe": "`maybe` is no access; write r, w or rw",
    "P1;2000H": "the name is empty",
    "P1;;;;;maybe": "`` is no hex address of one register; the name is empty; `maybe` is no access; write r, w or rw",
}


@pytest.mark.parametrize("line", UNDERSTOOD)
def test_a_line_is_a_row(line: str) -> None:
    made = read(HEAD + line, "t.csv", HEX)
    assert (made.rows, made.left) == ([UNDERSTOOD[line]], [])


@pytest.mark.parametrize("line", REPORTED)
def test_what_is_not_understood_is_reported_with_its_line(line: str) -> None:
    made = read(f"{HEAD}P0;1;Good;;;\n\n{line}\n", "t.csv", HEX)
    assert len(made.rows) == 1
    assert made.left == [f"t.csv:4:1: {REPORTED[line]}"]


@pytest.mark.parametrize(
    ("addresses", "form", "found"),
    [
        (("1AH", "0x1F"), None, "001AH"),
        (("0x10", "20h"), None, "0010H"),
        (("0x10", "2101H", "8450"), "decimal", "0010H"),
        (("10", "20"), "decimal", "000AH"),
        (("10", "20"), "hex", "0010H"),
        (("40017", "40002"), "4xxxx", "0010H"),
        (("400017", "465536"), "4xxxx", "0010H"),
        (("40017", "40002"), "decimal", "9C51H"),
    ],
)
def test_how_addresses_are_written(addresses: tuple[str, ...], form: str | None, found: str) -> None:
    text = "Register\tName\n" + "".join(f"{each}\tSpeed {at}\n" for at, each in enumerate(addresses))
    assert read(text, "t.csv", Reading(addresses=form)).rows[0].startswith(f"{{address: {found}, ")


def test_numbers_that_may_be_either_are_refused() -> None:
    with pytest.raises(
        TableError, match=r"^t\.csv:1:1: no address shows whether it is hexadecimal; say --addresses hex"
    ):
        read("Register,Name\n1000,Speed\n2000,Torque\n", "t.csv", NOTHING_SAID)


@pytest.mark.parametrize("plain", ["8450", "0010", "21"])
def test_plain_addresses_beside_hexadecimal_ones_are_asked_for(plain: str) -> None:
    text = f"Register,Name\n0x2101,Speed\n{plain},Torque\n210A,Power\n4{plain[:2]},Heat\n"
    said = "and `0x2101` of line 2 is hexadecimal; say --addresses hex or decimal"
    assert refused(text) == [
        f"t.csv:3:1: `{plain}` may be decimal, {said}",
        f"t.csv:5:1: `4{plain[:2]}` may be decimal, {said}",
    ]
    made = read(text, "t.csv", Reading(addresses="decimal"))
    assert made.rows[1] == f"{{address: {int(plain):04X}H, name: Torque}}"
    assert made.left == ["t.csv:4:1: `210A` is no decimal address of one register"]


FACTORS = "Address,Name,Unit,{},Sign\n0x01,Speed,Hz,100,\n0x02,Current,A,10,\n0x03,Voltage,V,1,\n"


def test_a_factor_that_may_be_meant_either_way_is_asked_for() -> None:
    text = FACTORS.format("Scaling factor")
    assert refused(text) == [
        "t.csv:2:1: `100` may be 100 Hz per count or 100 counts per Hz; say --factor multiply or divide",
        "t.csv:3:1: `10` may be 10 A per count or 10 counts per A; say --factor multiply or divide",
    ]
    for marked in ("x100", "100 Hz", "200/2"):
        assert "may be 100 Hz per count or" in refused(text.replace("100", marked))[0]
    made = read(text, "t.csv", Reading(way="divide"))
    assert [each.partition("factor: ")[2].partition(",")[0] for each in made.rows] == ["0.01", "0.1", "1"]
    made = read(text, "t.csv", Reading(way="multiply"))
    assert [each.partition("factor: ")[2].partition(",")[0] for each in made.rows] == ["1"]
    assert made.left == [
        "t.csv:2:1: 100 Hz per count is no factor of a drive",
        "t.csv:3:1: 10 A per count is no factor of a drive",
    ]


@pytest.mark.parametrize(
    ("head", "rows"), [("Divisor", 3), ("Division factor", 3), ("Multiplier", 1), ("Resolution", 1)]
)
def test_a_head_that_says_what_to_do_is_believed(head: str, rows: int) -> None:
    assert len(read(FACTORS.format(head), "t.csv", NOTHING_SAID).rows) == rows


TABLES = "Kind,Address,Name\nCoil,0,Run\n{},1,Ready\nHolding register,2,Speed\nInput,3,Current\nDiscrete input,1,Trip\n"


def test_a_column_names_the_table_of_modbus() -> None:
    made = read(TABLES.format("Nothing"), "t.csv", Reading({"table": "Kind"}, "decimal"))
    assert made.rows == [
        "{address: 0000H, space: coil, name: Run}",
        "{address: 0002H, name: Speed}",
        "{address: 0003H, space: input, name: Current}",
        "{address: 0001H, space: discrete, name: Trip}",
    ]
    assert made.left == ["t.csv:3:1: `Nothing` names no table of Modbus"]


@pytest.mark.parametrize("head", ["Kind", "Type"])
def test_several_tables_without_their_column_are_asked_for(head: str) -> None:
    lines = refused(TABLES.format("Coils").replace("Kind", head), Reading(addresses="decimal"))
    assert [each[:8] for each in lines][:3] == ["t.csv:2:", "t.csv:3:", "t.csv:4:"]
    assert all("names a table of Modbus; name its column by --column table=" in each for each in lines)


def test_a_heading_within_a_table_is_asked_for_and_can_be_denied() -> None:
    text = "Address,Name,Note\n0x00,Run,the coil of the brake\n# 03 - READ HOLDING REGISTERS\n0x02,Speed\n"
    assert [each.partition(";")[0] for each in refused(text)] == [
        "t.csv:3:1: `# 03 - READ HOLDING REGISTERS` names a table of Modbus"
    ]
    assert len(read(text, "t.csv", Reading({"table": ""})).rows) == 2


@pytest.mark.parametrize(
    ("said", "space"),
    [
        *[("01", "coil"), ("01/05/0F", "coil"), ("2", "discrete"), ("0x03", ""), ("3, 6, 16", ""), ("03/06/10", "")],
        *[("04H", "input"), ("3/4", None), ("8", None), ("MODBUS_INPUT_REGISTER", "input"), ("4x", "")],
        *[("read_holding_registers", ""), ("Input status", "discrete"), ("Coil or holding", None)],
    ],
)
def test_what_names_a_table(said: str, space: str | None) -> None:
    made = read(f'FC,Address,Name\n"{said}",0x01,Speed\n', "t.csv", NOTHING_SAID)
    if space is None:
        assert made.left == [f"t.csv:2:1: `{said}` names no table of Modbus"]
    else:
        assert made.rows == [f"{{address: 0001H, {f'space: {space}, ' if space else ''}name: Speed}}"]


def test_a_function_code_may_be_the_id_of_a_parameter() -> None:
    text = "Function code,Address,Name\n{},0x01,Speed\n"
    assert "`Function code`, with `03`, may be no id; say --column id=" in refused(text.format("03"))[0]
    assert read(text.format("P0-01"), "t.csv", NOTHING_SAID).rows == ["{address: 0001H, id: P0-01, name: Speed}"]
    assert read(text.format("04"), "t.csv", Reading({"table": "Function code"})).rows == [
        "{address: 0001H, space: input, name: Speed}"
    ]


def test_what_several_registers_share_is_no_id() -> None:
    text = "Display code,Address,Name\nicon,0x01,Speed\nicon,0x02,Heat\n-,0x03,Load\n-,0x04,Trip\n"
    assert refused(text) == [
        "t.csv:1:1: `Display code`, with `icon`, may be no id; "
        "say --column id=..., --column id= for none, or --column table=..."
    ]
    assert read(text, "t.csv", Reading({"id": ""})).rows[0] == "{address: 0001H, name: Speed}"


def test_numbers_of_registers_name_their_table() -> None:
    text = (
        "Register,Name,R/W\n40001,Speed,rw\n30001,Current,r\n10016,Trip,r\n00002,Run,rw\n30002,Heat,rw\n40000,None,r\n"
    )
    made = read(text, "t.csv", Reading(addresses="4xxxx"))
    assert [each.partition(", name")[0] for each in made.rows] == [
        "{address: 0000H",
        "{address: 0000H, space: input",
        "{address: 000FH, space: discrete",
        "{address: 0001H, space: coil",
    ]
    assert made.left == [
        "t.csv:6:1: `rw`: input is read only",
        "t.csv:7:1: `40000` is no 4xxxx address of one register",
    ]
    with pytest.raises(TableError, match="no address shows"):
        read(text, "t.csv", NOTHING_SAID)


def test_what_has_neither_16_nor_32_bits_is_left_out() -> None:
    lines = ("0x01,A,INT16,1", "0x02,B,uint16,1", "0x03,C,UINT64,4", "0x05,D,float,", "0x07,E,U16,2", "0x09,F,-,1")
    text = "\n".join(("Address,Name,Data type,Count", *lines))
    made = read(text, "t.csv", NOTHING_SAID)
    assert made.rows == ["{address: 0001H, name: A, signed: true}", "{address: 0002H, name: B}"]
    assert [each.partition(" of a")[0] for each in made.left] == [
        "t.csv:4:1: `UINT64` is no type",
        "t.csv:5:1: `float` is no type",
        "t.csv:6:1: address, type and size say different numbers of registers",
        "t.csv:7:1: `` is no type",
    ]


@pytest.mark.parametrize(
    ("text", "row"),
    [
        ("Register,Name\n40103-40104,Energy", "{address: 0066H-0067H, name: Energy, words: 2}"),
        ("Register,Name\n400103-400104,Energy", "{address: 0066H-0067H, name: Energy, words: 2}"),
        ("Register,Name,Type,Size\n300103 – 300104,A,u32,2", "{address: 0066H-0067H, space: input, name: A, words: 2}"),
        ("Register,Name,Type\n40103,A,INT32", "{address: 0066H-0067H, name: A, signed: true, words: 2}"),
        ("Register,Name,Size\n40103,Energy,2", "{address: 0066H-0067H, name: Energy, words: 2}"),
    ],
)
def test_a_value_of_32_bits_is_two_registers_whose_order_must_be_said(text: str, row: str) -> None:
    how = Reading(addresses="4xxxx")
    assert refused(text, how) == ["t.csv:2:1: which word of a value of 32 bits comes first; say --words high or low"]
    assert read(text, "t.csv", how._replace(order="high")).rows == [row]
    low = row.replace("words: 2", "words: 2, order: low_first")
    assert read(text, "t.csv", how._replace(order="low")).rows == [low]


@pytest.mark.parametrize(
    "said", ["40103-40105", "40104-40103", "40103-104", "40103-30104", "40103-40104-40105", "40103-", "465536-465537"]
)
def test_what_are_no_two_registers_is_left_out(said: str) -> None:
    made = read(f"Register,Name\n40001,Speed\n{said},Energy\n", "t.csv", Reading(addresses="4xxxx", order="high"))
    assert made.left == [f"t.csv:3:1: `{said}` is no 4xxxx address of one register"]


def test_a_value_of_32_bits_is_in_the_way_of_what_is_at_its_second_register() -> None:
    how = Reading(addresses="hex", order="high")
    made = read("Address,Name\n1,Speed\n2-3,Energy\n3,Heat\n", "t.csv", how)
    assert made.left == ["t.csv:3:1: line 4 has 0003H, too", "t.csv:4:1: line 3 has 0003H, too"]
    assert read("Address,Name,Type\nFFFF,Energy,u32\n", "t.csv", how).left == ["t.csv:2:1: no register follows FFFFH"]


def test_numbers_of_six_digits_need_no_option() -> None:
    text = "Register,Name\n400103,Speed\n300001,Heat\n"
    assert read(text, "t.csv", NOTHING_SAID).rows == [
        "{address: 0066H, name: Speed}",
        "{address: 0000H, space: input, name: Heat}",
    ]
    assert "no address shows" in refused(f"{text}40104,Torque\n")[0], "40104 may be a coil, 040104"


@pytest.mark.parametrize(
    ("said", "row"),
    [
        *[(said, "{address: 0026H, name: Speed}") for said in ("0x0026 (38)", "38 (0x0026)", "26H (38)", "0026H(38)")],
        *[(said, "{address: 0066H, name: Speed}") for said in ("0x66 (40103)", "400103 (66H)")],
        ("0x66 (30103)", "{address: 0066H, space: input, name: Speed}"),
        ("0x0026-0x0027 (38-39)", "{address: 0026H-0027H, name: Speed, words: 2}"),
    ],
)
def test_an_address_in_two_ways_is_one_where_both_agree(said: str, row: str) -> None:
    assert read(f"Address,Name\n{said},Speed\n", "t.csv", Reading(order="high")).rows == [row]


@pytest.mark.parametrize(
    "said", ["0x0026 (39)", "38 (39)", "38 (38)", "0x26 (26H)", "0x0026 (speed)", "0x0026-0x0027 (38)"]
)
def test_an_address_in_two_ways_that_do_not_agree_is_none(said: str) -> None:
    made = read(f"Address,Name\n0x01,Heat\n{said},Speed\n", "t.csv", NOTHING_SAID)
    assert made.left == [f"t.csv:3:1: `{said}` names two addresses, or none"]


def test_a_plain_range_beside_hexadecimal_addresses_is_asked_for() -> None:
    assert "`21-22` may be decimal, " in refused("Address,Name\n0x01,Heat\n21-22,Speed\n")[0]


@pytest.mark.parametrize(
    ("unit", "scale", "row"),
    [
        ("0.01 Hz", "", "unit: Hz, scale: {factor: 0.01, source: the table}"),
        ("0.01Hz", "0.01", "unit: Hz, scale: {factor: 0.01, source: the table}"),
        ("0.01 Hz", "0.01 Hz", "unit: Hz, scale: {factor: 0.01, source: the table}"),
        ("0.01 Hz", "0.1", None),
        ("Hz", "x0.01", "unit: Hz, scale: {factor: 0.01, source: the table}"),
        ("Hz", "/10", "unit: Hz, scale: {factor: 0.1, source: the table}"),
    ],
)
def test_a_unit_with_its_factor_agrees_with_the_factor_beside_it(unit: str, scale: str, row: str | None) -> None:
    made = read(f"Address,Name,Unit,Scale\n0x01,Speed,{unit},{scale}\n", "t.csv", NOTHING_SAID)
    assert made.rows == ([f"{{address: 0001H, name: Speed, {row}}}"] if row else [])
    assert made.left == ([] if row else [f"t.csv:2:1: `{unit}` and `{scale}` are two factors"])


def test_a_unit_in_the_name_is_asked_for() -> None:
    text = "Address,Name,Factor\n0x01,Output speed (rpm),0.1\n0x02,Gain [x],\n"
    asked = "`(rpm)` in the name may be the unit"
    assert refused(text) == [
        f"t.csv:2:1: {asked}; say --column unit=..., the head of the names, or --column unit= for none"
    ]
    made = read(text, "t.csv", Reading({"unit": "Name"}))
    assert made.rows[0].startswith("{address: 0001H, name: Output speed, unit: r/min, scale: {factor: 0.1,")
    assert made.rows[1] == '{address: 0002H, name: "Gain [x]"}'
    assert read(text, "t.csv", Reading({"unit": ""})).left == ["t.csv:2:1: a factor without a unit"]


def test_a_sign_that_only_a_range_shows_is_not_lost() -> None:
    text = "Address,Name,Min.,{}\n0x01,Heat,-20,{}\n"
    assert read(text.format("Type", "int16"), "t.csv", NOTHING_SAID).rows == [
        "{address: 0001H, name: Heat, signed: true}"
    ]
    assert read(text.format("Note", ""), "t.csv", NOTHING_SAID).left == [
        "t.csv:2:1: `-20` is negative, and no column says how a sign is sent"
    ]


def test_of_two_rows_with_one_address_neither_is_believed() -> None:
    made = read("Address,Name\n0x01,Speed\n0x02,Current\n1H,Torque\n", "t.csv", NOTHING_SAID)
    assert made.rows == ["{address: 0002H, name: Current}"]
    assert made.left == ["t.csv:2:1: line 4 has 0001H, too", "t.csv:4:1: line 2 has 0001H, too"]


def test_all_that_must_be_asked_is_asked_at_once_and_no_more_than_anybody_reads() -> None:
    lines = "".join(f"{at},Speed {at},Hz,100\n" for at in range(MOST))
    said = refused(f"Address,Name,Unit,Scale\n0x1F00,Coil,A,10\n{lines}")
    assert len(said) == MOST + 1
    assert said[-1] == f"and {MOST + 1} more like these"
    assert "t.csv:2:1: `10` may be 10 A per count" not in said[0]


def test_a_cell_too_long_for_a_table_is_no_crash() -> None:
    assert refused(f"Address,Name\n0x01,{'x' * 200_000}\n") == [
        "t.csv:2:1: cannot be read as a table: field larger than field limit (131072)"
    ]


def refused(text: str, how: Reading = NOTHING_SAID) -> list[str]:
    with pytest.raises(TableError) as caught:
        read(text, "t.csv", how)
    return str(caught.value).splitlines()


def test_columns_are_found_by_their_heads_or_named() -> None:
    text = "Bezeichnung|Adresse|Kanal\nDrehzahl|1AH|7\n"
    assert read(text, "t.csv", NOTHING_SAID).rows == ["{address: 001AH, name: Drehzahl}"]
    assert read(text, "t.csv", Reading({"id": "Kanal"})).rows == ['{address: 001AH, id: "7", name: Drehzahl}']
    for wrong, columns in (
        ("no column is called `Wert`", {"name": "Wert"}),
        ("no column is the name", {}),
        ("`Address` and `Register` may be the address", {}),
    ):
        head = "Address|Register|Bezeichnung" if "may be" in wrong else "Address|Kanal|Text"
        with pytest.raises(TableError, match=wrong):
            read(f"{head}\n1AH|2|x\n", "t.csv", Reading(columns))


def test_pasted_text_is_parted_by_blanks() -> None:
    assert read("Register   Name\n1AH   Output speed\n", "t", NOTHING_SAID).rows == [
        "{address: 001AH, name: Output speed}"
    ]


def test_all_rows_are_good_in_a_map(tmp_path: Path) -> None:
    made = read(HEAD + "\n".join(each for each in UNDERSTOOD if "Öl" not in each), "t.csv", HEX)
    text = SKELETON.read_text("utf-8")
    place = "      - {address: 2000H, name: Drive status,"
    assert place in text
    others = read("FC,Type,Address,Name\n04,int16,0x30,Heat\n01,bit,0x31,Run\n", "t.csv", NOTHING_SAID)
    rows = (
        "".join(f"      - {each}\n" for each in [*made.rows, *others.rows])
        .replace("2000H", "3000H")
        .replace("2001H", "3001H")
    )
    text = text.replace("id_forms: [A9.99]", "id_forms: [A9.99, A9]").replace(place, rows + place)
    (tmp_path / "acme.yaml").write_text(text, "utf-8")
    known = load(tmp_path / "acme.yaml")
    assert known.register_at(0x3000) is not None
    assert known.register_at(0x0022) is not None
    heat = known.register_at(SPACES["input"] + 0x30)
    assert (heat and heat.signed, known.register_at(SPACES["coil"] + 0x31) is None) == (True, False)


TEMPLATE = """{
  "device_type": "acme",
  "device": {
    "channels": [
      {"name": "Output frequency", "reg_type": "input", "address": 24, "scale": 0.01, "units": "Hz", "type": "value"},
      {"name": "Torque", "address": "0x2106", "format": "s16", "scale": 0.1, "units": "%", "readonly": true},
      {"name": "Energy (kWh)", "address": "16129", "format": "u32", "scale": 0.1, "word_order": "little_endian"},
      {"name": "Hours", "address": 600, "format": "s32", "units": "h", "readonly": true},
      {"name": "Run", "reg_type": "coil", "address": 2, "type": "switch"},
      {"name": "Bit", "address": "2100:0:1", "readonly": true},
      {"name": "Ratio", "address": 7, "format": "float"},
      {"name": "Heat", "address": 8, "units": "deg C", "scale": 1, "offset": -40},
      {"name": "Swapped", "address": 9, "byte_order": "little_endian"},
      {"name": "Speed", "reg_type": "holding_single", "address": 10, "write_address": 11}
    ]
  }
}
"""


def test_a_template_of_wb_mqtt_serial_is_a_table() -> None:
    asked = (
        "`(kWh)` in the name may be the unit; say --column unit=..., the head of the names, or --column unit= for none"
    )
    assert refused(TEMPLATE) == [f"t.csv:7:1: {asked}"]
    made = read(TEMPLATE, "t.json", Reading({"unit": "name"}))
    assert made.rows == [
        "{address: 0018H, space: input, name: Output frequency, access: r, unit: Hz, "
        "scale: {factor: 0.01, source: the table}}",
        '{address: 2106H, name: Torque, access: r, signed: true, unit: "%", scale: {factor: 0.1, source: the table}}',
        "{address: 3F01H-3F02H, name: Energy, access: rw, words: 2, order: low_first, unit: kWh, "
        "scale: {factor: 0.1, source: the table}}",
        "{address: 0258H-0259H, name: Hours, access: r, signed: true, words: 2, unit: h}",
        "{address: 0002H, space: coil, name: Run, access: rw}",
        "{address: 000AH, name: Speed, access: r}",
        "{address: 000BH, name: Speed, access: w}",
    ]
    assert made.left == [
        "t.json:10:1: `2100:0:1` is no decimal address of one register",
        "t.json:11:1: `float` is no type of a value of 16 or 32 bits",
        "t.json:12:1: `1 + -40` is no factor",
        "t.json:13:1: `u16 little_endian` is no type of a value of 16 or 32 bits",
    ]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('{"device": {\n "channels": [}}', "t.json:2:15: this is no JSON"),
        ('{"device": {"channels": [{{ in_num }}]}}', "t.json:1:27: this is no JSON"),
        ('{"device": {}}', "t.json:1:1: no channels"),
        ('{"device": {"channels": 5}}', "t.json:1:1: no channels"),
        ('{"device": "channels"}', "t.json:1:1: no channels"),
        ("{" * 5000, "t.json:1:2: this is no JSON"),
        ('{"a":' * 50000, "t.json:1:1: this is no JSON"),
    ],
)
def test_what_is_no_template_is_refused_with_its_place(text: str, said: str) -> None:
    with pytest.raises(Refused) as caught:
        read(text, "t.json", NOTHING_SAID)
    assert str(caught.value).startswith(said)


def test_channels_that_are_none_are_left_out() -> None:
    made = read('{"device": {"channels": [5, null, {"name": null}, []]}}', "t.json", NOTHING_SAID)
    assert made.rows == []
    assert len(made.left) == len(("5", "null", "no name", "[]"))


def run(*arguments: str, given: str = "") -> Result:
    return CliRunner().invoke(app, ["import-csv", *arguments], input=given)


def test_the_command(tmp_path: Path) -> None:
    good = run("-", given=HEAD + next(iter(UNDERSTOOD)))
    assert (good.exit_code, good.stderr) == (0, f"1 rows, 0 left out; {ASSUMED}\n")
    assert good.stdout == f"      - {UNDERSTOOD[next(iter(UNDERSTOOD))]}\n"
    some = run("-", given=f"{HEAD}P1;2000H;Speed;;;\nP2;20G0;Speed;;;")
    assert (some.exit_code, some.stderr.splitlines()[-1]) == (1, f"1 rows, 1 left out; {ASSUMED}")
    kept = tmp_path / "rows.yaml"
    assert run("-", "-o", str(kept), given=f"{HEAD}P1;2000H;Speed;;;").exit_code == 0
    assert kept.read_text("utf-8") == "      - {address: 2000H, id: P1, name: Speed}\n"
    again = run("-", "-o", str(kept), given=f"{HEAD}P1;2001H;Speed;;;")
    assert (again.exit_code, "is there already" in again.stderr) == (2, True)
    assert "2000H" in kept.read_text("utf-8")
    assert run("missing.csv").exit_code == 2
    assert run("-", "--column", "colour=Register", given=HEAD).exit_code == 2


def test_the_command_asks_by_its_options_and_writes_nothing_half(tmp_path: Path) -> None:
    given = "Register;Name;Unit;Factor\n0x2101;Speed;Hz;100\n8450;Current;A;10\n"
    kept = tmp_path / "rows.yaml"
    asked = run("-", "-o", str(kept), given=given)
    assert (asked.exit_code, kept.exists()) == (2, False)
    assert "--addresses hex or decimal" in asked.stderr
    assert "--factor multiply or divide" in asked.stderr
    told = run("-", "--addresses", "decimal", "--factor", "divide", given=given)
    assert told.exit_code == 0
    assert "address: 2102H, name: Current, unit: A, scale: {factor: 0.1," in told.stdout
    many = run("-", given="Register;Name\n0x01;Speed\n" + "nowhere;Current\n" * 1000)
    assert (many.exit_code, len(many.stderr.splitlines())) == (1, MOST + 2)
