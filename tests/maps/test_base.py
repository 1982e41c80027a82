"""A map that says only what is different from a sister's: what it takes over, from where, and what is refused."""

from pathlib import Path

import pytest

from driveblocks.maps import catalog, trust
from driveblocks.maps.load import load, loads
from driveblocks.maps.model import Drive
from driveblocks.maps.problem import MapError

BASE = (Path(__file__).parents[2] / "generator/driveblocks/maps/skeleton.yaml").read_text(encoding="utf-8")
HEAD = """format: 2
base: acme
prefix: BEST
family: {en: Best 200}
manual: {language: en, title: {en: Best 200 manual}, publisher: {en: Best}}
"""


def write(folder: Path, more: str = "", base: str = BASE) -> Path:
    """A map with its base beside it."""
    (folder / "acme.yaml").write_text(base, encoding="utf-8")
    file = folder / "best.yaml"
    file.write_text(HEAD + more, encoding="utf-8")
    return file


def made(folder: Path, more: str = "") -> Drive:
    """That map, loaded."""
    return load(write(folder, more))


def wrong(file: Path) -> list[str]:
    """What is refused, without the name of the file."""
    with pytest.raises(MapError) as caught:
        load(file)
    return [str(each).removeprefix(f"{file}:") for each in caught.value.problems]


def test_what_is_not_said_is_the_sisters_and_no_longer_read(tmp_path: Path) -> None:
    best, acme = made(tmp_path), loads(BASE, "acme.yaml")
    assert [row.address for _, row in best.registers()] == [row.address for _, row in acme.registers()]
    assert {one.document for one in best.operation.commands} == {"acme"}
    sister = best.documents[0]
    assert (sister.id, sister.title, sister.trust) == ("acme", "Acme 100 communication manual", "sister")
    assert trust.rung(acme) == "read"
    parts = ("commands", "reference", "status", "measures", "serial", "faults")
    assert trust.rung(best) == ", ".join(f"{one} sister" for one in parts)
    assert best.frames[0].document == "acme"


def test_a_source_of_its_own_holds_for_what_is_taken_over_there(tmp_path: Path) -> None:
    best = made(
        tmp_path,
        """sections: [{id: commands, source: page 7}, {id: status, source: page 8}]
operation:
  commands: [{does: run_forward, source: page 7}, {does: run_reverse, source: page 7}, {does: stop, source: page 7}]
  reference: {source: page 7}
  standstill: {source: page 8}
  status: [{shows: running, source: page 8}]
faults: {source: page 9}
""",
    )
    assert trust.heard(best) == [
        f"{one}, sister (Acme 100 communication manual, Acme Drives): {names}"
        for one, names in (("reference", "scale"), ("measures", "output frequency"), ("serial", "mode"))
    ]
    assert [one.source for one in best.sections] == ["page 7", "page 8"]
    assert best.operation.commands[2].writes[0].value == 3
    assert [code.name for code in best.faults.codes] == ["Overcurrent"]


@pytest.mark.parametrize(("more", "rung"), [("", "sister"), ("documents: [{id: newer, trust: read}]", "read")])
def test_what_was_read_of_the_base_was_not_read_of_this_drive(tmp_path: Path, more: str, rung: str) -> None:
    newer = "documents: [{id: newer, title: Another edition, publisher: Acme, trust: read}]\nid_forms:"
    base = BASE.replace("id_forms:", newer, 1).replace(
        "source: table 2}]  # what", "source: table 2, document: newer}]  # what", 1
    )
    best = load(write(tmp_path, more, base))
    assert best.operation.status[0].document == "newer"
    assert {one.id: one.trust for one in best.documents} == {"newer": rung, "acme": "sister"}


def test_what_was_printed_in_the_base_goes_with_its_source(tmp_path: Path) -> None:
    source = "source: table 2, rung: derived, rule: by the table, printed: [bit 0]"
    base = BASE.replace("equals: 1}], source: table 2}", f"equals: 1}}], {source}}}")
    assert source in base
    (kept,) = load(write(tmp_path, "", base)).operation.status
    (own,) = load(write(tmp_path, "operation: {status: [{shows: running, source: page 8}]}\n", base)).operation.status
    assert (kept.document, kept.rung, kept.rule, kept.printed) == ("acme", "derived", "by the table", ("bit 0",))
    assert (own.document, own.rung, own.rule, own.printed) == (None, None, None, ())


def test_rows_of_one_name_are_one_and_new_ones_follow(tmp_path: Path) -> None:
    best = made(
        tmp_path,
        """frames: []
sections:
  - id: status
    registers: [{address: 2001H, scale: {factor: 0.1, source: page 8}}, {address: 2003H, name: Warning}]
faults: {codes: [{code: 02H, name: Overvoltage}]}
""",
    )
    rows = best.sections[1].registers
    assert [row.address.first for row in rows] == [0x2000, 0x2001, 0x2002, 0x2003]
    scale = rows[1].scale
    assert scale is not None
    assert (str(scale.factor), scale.document) == ("0.1", None)
    assert rows[1].name == "Output frequency"
    assert [(code.code, code.name) for code in best.faults.codes] == [(1, "Overcurrent"), (2, "Overvoltage")]


def test_what_is_left_out_is_gone(tmp_path: Path) -> None:
    best = made(
        tmp_path,
        """without: [faults > codes > 01H, operation > commands > run_reverse,
  sections > commands > registers > 1000H > values > 2]
frames: []
faults: {codes: [{code: 02H, name: Overvoltage}]}
""",
    )
    assert best.frames == ()
    assert [code.code for code in best.faults.codes] == [2]
    assert [one.value for one in best.sections[0].registers[0].values] == [1, 3]
    assert [one.does for one in best.operation.commands] == ["run_forward", "stop"]


@pytest.mark.parametrize(
    ("more", "told"),
    [
        ("without: [faults > codes > 01H > nothing]\n", "`faults > codes > 01H > nothing` is nothing"),
        ("without: [settings]\n", "1:1: `the map` has no `settings`"),
        ("settings: one\n", "6:11: `settings` is one value"),
        ("whatever: 1\n", "6:1: unknown key `whatever`"),
        ("sections: [{id: status, registers: [{address: 2001H, unit: foot}]}]\n", "6:60: `unit: foot` is not allowed"),
        # what is taken over is wrong where it was asked for
        ("without: [sections > status > registers > 2001H]\n", "2:7: "),
    ],
)
def test_mistakes_are_shown_in_this_file(tmp_path: Path, more: str, told: str) -> None:
    assert any(told in each for each in wrong(write(tmp_path, more)))


def test_a_base_that_is_not_there_or_not_good(tmp_path: Path) -> None:
    file = write(tmp_path)
    (tmp_path / "acme.yaml").unlink()
    assert wrong(file)[0].startswith("2:7: there is no map acme.yaml beside this one")
    bad = tmp_path / "acme.yaml"
    write(tmp_path, base=BASE.replace("format: 2", "format: 3"))
    assert wrong(file)[0].startswith(f"{bad}:3:9: ")
    write(tmp_path, base=HEAD)
    assert wrong(file)[0].startswith("2:7: acme.yaml has a base itself")
    with pytest.raises(MapError, match="there is no map acme"):
        loads(HEAD, "text")


def test_a_base_may_be_one_that_ships(tmp_path: Path) -> None:
    file = tmp_path / "best.yaml"
    file.write_text(HEAD.replace("acme", "rockwell_powerflex_4"), encoding="utf-8")
    best = load(file)
    assert (best.prefix, best.documents[-1].id) == ("BEST", "rockwell_powerflex_4")
    assert best.faults.codes == load(catalog.folder() / "rockwell_powerflex_4.yaml").faults.codes


def test_a_document_of_the_base_goes_with_the_last_that_names_it(tmp_path: Path) -> None:
    guide = "documents: [{id: guide, title: Guide, publisher: Acme}]\nabsent:"
    base = BASE.replace("absent:", guide).replace(
        "find_out: ask the maker}", "find_out: ask, corroborated: [{document: guide, page: page 2, reads: nothing}]}", 1
    )
    what = loads(BASE, "acme.yaml").absent[0].what
    for more, left in (("", ["guide", "acme"]), (f"absent: [{{what: {what}, corroborated: []}}]\n", ["acme"])):
        assert [one.id for one in load(write(tmp_path, more, base)).documents] == left
    assert "nothing refers to document `mine`" in "".join(
        wrong(write(tmp_path, "documents: [{id: mine, title: Mine, publisher: Best}]\n"))
    )


PATH = """operation:
  states: [{name: ready, register: 2000H, mask: 0006H, equals: 0002H, source: table 2},
    {name: waits, register: 2000H, mask: 0006H, equals: 0004H, source: table 2}]
"""
FULL = (
    BASE.replace("operation:\n", PATH, 1)
    .replace("{bit: 1-F, unused: true}", "{bit: 1, name: Ready}, {bit: 2, name: Waits}")
    .replace("value: 1, source: table 1}\n", "value: 1, source: table 1, first: [{register: 1000H, value: 3, until: "
      "ready}, {register: 1000H, value: 3, until: waits}]}\n", 1)
    .replace("notices: []", """notices:
  - {kind: hazard, text: {en: It starts by itself.}, source: page 3}
  - {kind: hazard, text: {en: It is hot.}, source: page 4}""")
    .replace("errata: []", """errata:
  - {about: [prose], where: page 3, printed: a, used: b, why: c, confidence: open, measured: false}
  - {about: [prose], where: page 4, printed: d, used: e, why: f, confidence: open, measured: false}""")
)  # fmt: skip


@pytest.mark.parametrize(
    ("more", "left"),
    [
        ("without: [operation > commands > run_forward > first > ready]\n", "ready waits | waits | hot starts | 3 4"),
        (
            "without: [operation > states > waits, operation > commands > run_forward > first > waits, "
            "notices > It is hot., errata > page 3]\n",
            "ready | ready | starts | 4",
        ),
        (
            "without: [notices > It is hot.]\nnotices: [{kind: hazard, text: {en: It hums.}, source: page 9}]\n",
            "ready waits | ready waits | hums starts | 3 4",
        ),
        ("errata: []\n", "ready waits | ready waits | hot starts |"),
    ],
)
def test_whatever_is_taken_over_can_be_left_out(tmp_path: Path, more: str, left: str) -> None:
    best = load(write(tmp_path, more, FULL))
    states = " ".join(one.name for one in best.operation.states)
    steps = " ".join(one.until or "" for one in best.operation.commands[0].first)
    notices = " ".join(
        sorted(one.text.en.rstrip(".").split()[-1 if "It starts" not in one.text.en else 1] for one in best.notices)
    )
    errata = " ".join(one.where.removeprefix("page ") for one in best.errata)
    assert f"{states} | {steps} | {notices} | {errata}".rstrip() == left


def test_a_code_is_one_however_it_is_spelled(tmp_path: Path) -> None:
    best = made(tmp_path, "faults: {codes: [{code: 1, name: Overload}]}\nerrors: {codes: [{code: 02H, name: Other}]}\n")
    assert [(code.code, code.name) for code in best.faults.codes] == [(1, "Overload")]
    assert [(code.code, code.name) for code in best.errors.codes] == [(2, "Other")]


def test_a_mistake_in_what_is_taken_over_names_both_files(tmp_path: Path) -> None:
    left_out = wrong(write(tmp_path, "without: [sections > status > registers > 2001H]\n"))
    assert any(each.startswith("2:7: taken over from acme.yaml:") for each in left_out)
    assert any("unless what `without` leaves out in line 6 is to stay" in each for each in left_out)
    taken = "sections: [{id: status, registers: [{address: 2003H, id: P1.07, name: Again}]}]\n"
    assert any("id `P1.07` is taken by line 36 of acme.yaml" in each for each in wrong(write(tmp_path, taken)))


def test_the_nameplates_of_a_sister_are_not_taken_over(tmp_path: Path) -> None:
    models = "models: [{plate: ACME-1*, printed: [ACME-15], source: page 4}]\nmanual:"
    base = BASE.replace("\nmanual:", f"\n{models}", 1)
    assert [one.plate for one in loads(base, "acme.yaml").models] == ["ACME-1*"]
    assert load(write(tmp_path, base=base)).models == ()
