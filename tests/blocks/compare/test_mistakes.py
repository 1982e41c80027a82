"""The comparison itself: it finds a block with one constant changed, tells it, and no variable escapes it."""

import functools

import pytest
from tests.blocks.compare.comparison import Libraries, build, compare, subjects
from tests.blocks.compare.pou import AROUND, Text, read, shipped
from tests.blocks.compare.subject import Subject

from structured_text.engines.embedded import EmbeddedEngine
from structured_text.engines.engine import Engine, Source, Value

SCANS = 1000
SEED = 7

# One constant in a block of each kind; none of these blocks uses another of them.
MISTAKES = [
    ("MB_HexDigit", "modbus/MB_HexDigit.st", "Digit + 55", "Digit + 87"),
    ("MB_Crc16Compact", "modbus/MB_Crc16Compact.st", "WORD#16#C001", "WORD#16#C003"),
    ("MB_Crc16", "modbus/MB_Crc16.st", "WORD#16#C0C1", "WORD#16#C0C0"),
    ("MB_AsciiDecode", "modbus/MB_AsciiDecode.st", "CharCount < 11", "CharCount < 9"),
    ("MB_ParseReply", "modbus/MB_ParseReply.st", "DataBytes + 4", "DataBytes + 5"),
    ("MB_BuildRead", "modbus/MB_BuildRead.st", "Last > 65536", "Last > 65535"),
    ("MB_PackChars16", "modbus/MB_PackChars16.st", "Last := 513", "Last := 512"),
    ("CHF_FaultTextEn", "invt_chf/CHF_FaultTextEn.st", "'unknown code'", "'unknown kode'"),
    ("CHF_Reference", "invt_chf/CHF_Reference.st", "Count + 0.5", "Count + 0.25"),
    ("JSCC_Command", "jscc/JSCC_Command.st", "WORD#16#0002", "WORD#16#0001"),
    ("SN300G5_CanRead", "shuen_sn300g5/SN300G5_CanRead.st", "WORD#16#003B", "WORD#16#003C"),
    ("SN300G5_FaultNumber", "shuen_sn300g5/SN300G5_FaultNumber.st", "WORD#16#6FFF", "WORD#16#7FFF"),
    ("SN300G5_Standstill", "shuen_sn300g5/SN300G5_Standstill.st", "WORD#16#0000", "WORD#16#0001"),
]


def _edited(mistakes: list[tuple[str, str, str]]) -> Text:
    """The library with a text in each of some files replaced by another."""
    texts = {source.path: source.text for source in shipped().sources if source.path != AROUND}
    for path, right, wrong in mistakes:
        assert right in texts[path], path
        texts[path] = texts[path].replace(right, wrong, 1)
    return read([Source(path, text) for path, text in texts.items()])


@functools.cache
def _libraries() -> Libraries:
    wrong = _edited([(path, right, wrong) for _, path, right, wrong in MISTAKES])
    return {**build({"right": EmbeddedEngine()}), **build({"wrong": EmbeddedEngine()}, wrong)}


@pytest.mark.parametrize("name", [name for name, *_ in MISTAKES])
@pytest.mark.thorough
def test_a_block_with_one_constant_changed_is_found(name: str) -> None:
    """The inputs bring a block of every kind to where a small mistake shows."""
    pou = shipped().pous[name]
    difference = compare(pou, subjects(_libraries(), pou), SCANS, SEED)
    assert difference is not None


def test_a_difference_from_matiec_is_found(matiec: Engine) -> None:
    """The embedded engine is given the block that is wrong."""
    libraries = {**build({"right": matiec}), "wrong": _libraries()["wrong"]}
    pou = shipped().pous["MB_HexDigit"]
    difference = compare(pou, subjects(libraries, pou), SCANS, SEED)
    assert difference is not None
    assert difference.path == "RESULT"
    assert difference.values["right"] in range(ord("A"), ord("G"))


def test_an_error_of_one_engine_is_a_difference() -> None:
    """An index out of bounds ends a scan on the embedded engine; it is reported with its place."""
    wrong = _edited([("modbus/MB_BuildRead.st", "Adu[0]", "Adu[Quantity + 200]")])
    libraries = {**build({"right": EmbeddedEngine()}), **build({"wrong": EmbeddedEngine()}, wrong)}
    pou = shipped().pous["MB_BuildRead"]
    difference = compare(pou, subjects(libraries, pou), SCANS, SEED)
    assert difference is not None
    assert difference.path == "(error)"
    assert difference.values["right"] == "no error"
    assert "outside 0..255" in str(difference.values["wrong"])


@pytest.mark.parametrize("name", ["MB_AsciiDecode", "MB_ResultTextZh", "CHF_Reference", "JSCC_Request", "CHF_Command"])
@pytest.mark.thorough
def test_no_variable_escapes_the_image(name: str, engine: Engine) -> None:
    """Each scalar and each end of each array, changed alone, makes another image."""
    pou = shipped().pous[name]
    run = _only(subjects(build({engine.name: engine}), pou))
    for leaf in pou.leaves:
        constant = leaf.path.endswith(".TABLE") or leaf.path in ("LARGEST", "LEAST", "MOST")
        if constant or (leaf.handed_on and not run.follows_c):
            continue
        places = [f"{leaf.path}[0]", f"{leaf.path}[{len(_array(run, leaf.path)) - 1}]"]
        for path in places if leaf.group == "array" else [leaf.path]:
            before = repr(run.image())
            run.instance[path] = _other(run.instance[path])
            assert repr(run.image()) != before, path


def _array(run: Subject, path: str) -> list[Value]:
    value = run.instance[path]
    return value if isinstance(value, list) else []


def _only(found: list[Subject]) -> Subject:
    (run,) = found
    return run


def _other(value: Value) -> Value:
    if isinstance(value, bool):
        return not value
    if isinstance(value, bytes):
        return value + b"x"
    assert isinstance(value, int | float)
    return value + 1 if value < 100 else value - 1


def test_a_wrong_digest_follows_from_the_text_alone() -> None:
    """A changed constant in a block that is called changes the digest of the caller; a changed comment does not."""
    pous = shipped().pous
    wrong = _edited([("modbus/MB_Crc16.st", "WORD#16#C0C1", "WORD#16#C0C0")]).pous
    same = _edited([("modbus/MB_Crc16.st", "(* ", "(* indeed ")]).pous
    changed = {name for name in pous if pous[name].digest != wrong[name].digest}
    assert changed == {"MB_Crc16", "MB_RtuSeal", "MB_RtuOpen"}
    assert {name: pou.digest for name, pou in pous.items()} == {name: pou.digest for name, pou in same.items()}
