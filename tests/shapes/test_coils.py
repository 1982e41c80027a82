"""A drive that coils command: its reference and output frequency are pairs, its current is an input register."""

from dataclasses import replace
from decimal import Decimal
from functools import cache
from pathlib import Path

import pytest
from tests.maps import bad

from driveblocks.bench import runner, vector
from driveblocks.bench.simulator.answer import answer
from driveblocks.bench.simulator.machine import Machine
from driveblocks.bench.unit import Unit
from driveblocks.maps.collection import Source
from driveblocks.maps.form import SPACES, address_text, span_text
from driveblocks.maps.load import loads
from driveblocks.maps.model import Drive
from driveblocks.maps.plan import dialect
from driveblocks.maps.problem import MapError
from driveblocks.meaning.polls import polls
from driveblocks.output.units import units
from driveblocks.reference import reply
from driveblocks.render.text import languages
from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.engine import Engine
from structured_text.language.lint import lint_sources

MAP = (bad.FOLDER / "coils.yaml").read_text(encoding="utf-8")
LOW_FIRST = MAP.replace("words: 2,", "words: 2, order: low_first,")


@cache
def drive(text: str = MAP) -> Drive:
    """The made-up map, or another in its form."""
    return loads(text, "coils.yaml")


@cache
def unit(text: str = MAP) -> Unit:
    """Its blocks and programs."""
    made = units([Source(Path("coils.yaml"), drive(text))], languages(["en"], "utf-8"))
    return next(each for each in made if each.suite.name == "coils")


# ---------------------------------------------------------------- addresses, words and reads


def test_an_address_knows_its_table() -> None:
    run, reference = drive().register_at(SPACES["coil"]), drive().register_at(0)
    assert run is not None
    assert reference is not None
    assert (run.name, reference.name) == ("Run command", "Frequency command")
    assert [span_text(row.address) for row in (run, reference)] == ["coil 0000H", "0000H-0001H"]
    assert address_text(SPACES["input"] + 0x1000) == "input 1000H"


def test_an_example_frame_of_an_input_register_is_no_request_of_the_block() -> None:
    frames = """frames:
  - {id: asked, direction: request, mode: rtu, source: section 2, printed: 01 04 10 00 00 01 35 0A, checksum: right,
     correct: 01 04 10 00 00 01 35 0A, means: {says: reads 1000H, unit: 1, function: 04H, address: 1000H, words: 1}}
  - {id: told, direction: reply, mode: rtu, source: section 2, printed: 01 04 02 01 F4 B9 27, checksum: right,
     correct: 01 04 02 01 F4 B9 27, answers: asked, means: {says: it is 50 A, unit: 1, function: 04H, words: 1,
     byte_count: 2, values: [500], quantities: [{register: input 1000H, value: 50, unit: A}]}}"""
    programs = {each.name: each.text for each in unit(MAP.replace("frames: []", frames)).suite.programs}
    assert "Request.FunctionCode := 4;" in programs["COI_TestFrames"]
    assert "OutputCurrentA(Raw := Words[0])" in programs["COI_TestFrames"]


def test_a_refusal_names_its_register_by_what_is_sent() -> None:
    form = "form: {kind: write_reply, function: 06H, address: input 1000H, source: section 3}"
    made = drive(MAP.replace("errors: {", f"errors: {{{form}, "))
    assert dialect(made).address == reply.dialect(made).address == 0x1000


def test_a_fault_is_shown_by_its_bits_alone() -> None:
    word = "name: Present fault"
    status = "    - {shows: fault, any: [{register: coil 0017H, equals: 1}], source: table 1}\n"
    text = MAP.replace(word, f"{word}, bits: [{{bit: 0, id: OC, name: Overcurrent}}]").replace(status, "")
    relation = "bits: {first: 0011H, last: 0011H, source: table 3}"
    made = unit(text.replace("present: 0011H", relation))
    (block,) = (each.text for each in made.blocks if each.path.endswith("COI_Drive.st"))
    assert "Fault := CommOk AND (Reads.FaultAgeMs < NEVER_MS) AND (Code <> 0);" in block


def test_an_erratum_names_a_misprinted_bit_of_an_input_register() -> None:
    bit = "bits: [{bit: 3, name: Warm, printed: {bit: B}}]}"
    row = "      - {address: 1002H, name: State, " + bit
    about = "about: [input 1002H.3], where: t, printed: b, used: a, why: w, confidence: open, measured: false"
    text = MAP.replace("\nstorage:", f"\n{row}\nstorage:")
    with pytest.raises(MapError, match=r"`about: \[input 1002H\.3\]`"):
        loads(text, "x.yaml")
    assert loads(text.replace("errata: []", f"errata: [{{{about}}}]"), "x.yaml").errata[0].about == ("input 1002H.3",)


def test_a_condition_on_a_pair_is_one_on_each_of_its_words() -> None:
    proof = [(address_text(each.register), each.equals) for each in drive().operation.standstill.all]
    assert proof == [("coil 000EH", 0), ("1000H", 0), ("1001H", 0)]
    text = MAP.replace("{register: 1000H, equals: 0}]}", "{register: 1000H, equals: 0}]}\n  commanded_by: {all: "
                       "[{register: 1000H, equals: 305419896}], source: table 2}", 1)  # fmt: skip
    found = loads(text, "x.yaml").operation.commanded_by
    assert found is not None
    assert [each.equals for each in found.all] == [0x1234, 0x5678]


def test_pairs_and_coils_are_read_together() -> None:
    reads = [(read.function, address_text(read.address), read.words) for read in polls(drive())]
    assert reads == [(1, "coil 000EH", 10), (3, "1000H", 2), (3, "0011H", 1), (4, "input 1000H", 1)]
    assert [read.characters() for read in polls(drive())] == [15, 17, 15, 15]


def test_no_read_ends_inside_a_pair() -> None:
    """Also where words before and after a pair do not fit into one read with it."""
    row = "      - {address: 0011H, access: r, name: Present fault}\n"
    rows = "".join(
        f"      - {{address: {at:04X}H, access: r, name: Value {at}, unit: A, scale: {{factor: 0.1, source: t}}}}\n"
        for at in range(0x0FF2, 0x1000)
    )
    text = MAP.replace(row, row + rows).replace("value: 16", "value: 15")
    made = drive(text)
    spoilt = replace(made.operation.measures[1], register=0x0FF2)
    other = replace(made, operation=replace(made.operation, measures=(made.operation.measures[0], spoilt)))
    for read in polls(other):
        assert (read.address <= 0x1000 < read.address + read.words) == (
            read.address <= 0x1001 < read.address + read.words
        )


PAIR = """frames:
  - {id: asked, direction: request, mode: rtu, source: section 2, printed: 01 03 10 00 00 02 C0 CB, checksum: right,
     correct: 01 03 10 00 00 02 C0 CB, means: {says: reads 1000H, unit: 1, function: 03H, address: 1000H, words: 2}}
  - {id: told, direction: reply, mode: rtu, source: section 2, printed: 01 03 04 00 01 00 00 AB F3, checksum: right,
     correct: 01 03 04 00 01 00 00 AB F3, answers: asked, means: {says: it is fast, unit: 1, function: 03H, words: 2,
     byte_count: 4, values: [1, 0], quantities: [{register: 1000H, value: 655.36, unit: Hz}]}}"""
"""65536 x 0.01 Hz."""


def test_an_example_frame_proves_the_scale_of_a_pair() -> None:
    made = loads(MAP.replace("frames: []", PAIR), "x.yaml")
    assert made.frames[1].means.quantities[0].value == Decimal("655.36")
    with pytest.raises(MapError, match="but 65536 x "):
        loads(MAP.replace("frames: []", PAIR.replace("655.36", "655.35")), "x.yaml")


@pytest.mark.parametrize("low_first", [False, True], ids=["high first", "low first"])
def test_an_example_frame_of_a_pair_is_asked_for_by_both_words(low_first: bool) -> None:
    turned = PAIR.replace("00 01 00 00 AB F3", "00 00 00 01 3B F3").replace("[1, 0]", "[0, 1]")
    text = (LOW_FIRST if low_first else MAP).replace("frames: []", turned if low_first else PAIR)
    frames = next(vector.scripts(drive(text), "coils"))
    pins = "High := Words[1], Low := Words[0]" if low_first else "High := Words[0], Low := Words[1]"
    assert f"COI_OutputFrequencyHz({pins})" in "".join(each.text for each in frames.programs())


# ---------------------------------------------------------------- blocks and programs


@pytest.mark.parametrize("text", [MAP, LOW_FIRST], ids=["high first", "low first"])
@pytest.mark.thorough
def test_its_blocks_are_clean_and_its_programs_pass(engine: Engine, text: str) -> None:
    blocks = {each.path: each for each in unit(text).blocks}
    if isinstance(engine, EmbeddedEngine):
        assert [str(problem) for problem in lint_sources([(each.path, each.text) for each in blocks.values()])] == []
    assert runner.run([unit(text)], [engine]).passed


# ---------------------------------------------------------------- the simulator


def asked(machine: Machine, body: str) -> str:
    """The reply to a request, both without unit address and checksum."""
    found = answer(machine, bytes([machine.unit]) + bytes.fromhex(body))
    return found[1:].hex(" ").upper() if found else ""


def test_the_simulator_knows_tables_and_pairs() -> None:
    machine = Machine(drive(), 1)
    assert asked(machine, "05 00 00 12 34") == "85 03", "neither set nor cleared"
    assert asked(machine, "05 00 0E FF 00") == "85 02", "read only"
    assert asked(machine, "10 00 00 00 02 04 00 00 13 88") == "10 00 00 00 02"
    assert asked(machine, "10 00 00 00 02 04 00 01 00 00") == "90 03", "beyond its range"
    assert asked(machine, "05 00 01 FF 00") == "05 00 01 FF 00"
    assert asked(machine, "05 00 00 FF 00") == "05 00 00 FF 00"
    machine.step(60_000)
    assert asked(machine, "03 10 00 00 02") == "03 04 00 00 13 88"
    assert asked(machine, "01 00 0E 00 0A") == "01 02 03 00", "it runs, in reverse"
    assert asked(machine, "01 00 0E 00 02") == "01 01 03"
    assert asked(machine, "04 10 00 00 01") != asked(machine, "03 10 00 00 01").replace("03 02", "04 02")
    assert asked(machine, "02 00 0E 00 01") == "82 01", "it has no discrete inputs"
    assert asked(machine, "05 00 00 00 00") == "05 00 00 00 00"
    machine.step(60_000)
    assert machine.hertz == 0
