"""`driveblocks prove`: the shipped families, a planted mistake with its call, and what the command says of both."""

from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest
import yaml
from click.testing import CliRunner
from lxml import etree
from tests import shipped
from tests.commands.test_page_commands import commands
from tests.prove import agreement
from tests.shapes import signs, texts, values

from driveblocks.bench.outcome import Result
from driveblocks.cli import app
from driveblocks.maps import catalog, collection
from driveblocks.maps.form import Span
from driveblocks.maps.page import skeleton
from driveblocks.prove import archive, prover, report, rules
from driveblocks.prove.facts import facts
from driveblocks.prove.prover import Proved
from driveblocks.prove.question import Verdict
from structured_text.engines.embedded.engine import EmbeddedEngine
from structured_text.engines.matiec.cache import Cache

FAMILIES = tuple(path.stem for path in catalog.shipped())
PAGE = Path(__file__).parents[2] / "docs" / "prove.md"


def planted(old: str, new: str, block: str = "VFD_HardStop", of: str = "VFD_HardStop", rule: str = "") -> Proved:
    """What becomes of a shared block if it, or a part of it, is changed; of its rules those that begin so."""
    texts = [
        each if Path(each.path).stem != block else type(each)(each.path, each.text.replace(old, new, 1))
        for each in agreement.sources()[prover.GENERIC]
    ]
    subject = next(each for each in rules.shared() if each.block == of)
    some = tuple(each for each in subject.rules if each.say.startswith(rule))
    return next(prover.proved(texts, {prover.GENERIC: [replace(subject, rules=some)]}))


@cache
def everything() -> list[Proved]:
    """All proofs of what ships."""
    made = dict(prover.texts(shipped.sources()))
    every = {each.path: each for some in made.values() for each in some}
    subjects = {each.path.stem: rules.family(facts(each.drive)) for each in shipped.sources()}
    return list(prover.proved(list(every.values()), {prover.GENERIC: rules.shared()} | subjects))


def proofs() -> Iterator[tuple[str, prover.Proof]]:
    for proved in everything():
        for each in proved.proofs:
            yield f"{proved.model.pou.name}: {each.answer.question.words}: {report.told(each)}", each


@pytest.mark.parametrize(
    "source",
    [  # by default the family with the most: a path of states
        pytest.param(each, id=each.path.stem, marks=() if each.drive.prefix == "ATV312" else pytest.mark.thorough)
        for each in shipped.sources()
    ],
)
def test_the_rules_hold_in_every_call_of_a_family(source: collection.Source) -> None:
    stem = source.path.stem
    texts_of = dict(prover.texts([source]))[stem]
    for proved in prover.proved(texts_of, {stem: rules.family(facts(source.drive))}):
        assert not [report.told(each) for each in proved.proofs if not each.good]


@pytest.mark.thorough
def test_the_rules_hold_in_every_call_of_every_family() -> None:
    assert {each.unit for each in everything()} == {prover.GENERIC, *FAMILIES}
    assert not [words for words, each in proofs() if not each.good]


@pytest.mark.thorough
def test_premises_are_reached_on_the_engine() -> None:
    calls = [each for _, each in proofs() if each.call is not None]
    free = [each for each in calls if not each.replayed]
    assert len(calls) > 150
    assert len(free) < 0.05 * len(calls)


@pytest.mark.parametrize("family", [prover.GENERIC, *(each.path.stem for each in shipped.sources())])
@pytest.mark.thorough
def test_the_terms_say_what_the_engine_does(family: str) -> None:
    library = EmbeddedEngine().build(agreement.wrapped(agreement.sources()[family], agreement.subjects(family)))
    for model in agreement.subjects(family):
        score = agreement.compared(model, library, 20)
        assert score.wrong == ()
        assert score.compared
        assert score.free < 0.05 * score.compared


def test_a_planted_mistake_comes_with_its_call() -> None:
    proved = planted("Overdue OR Restart", "Restart")
    bad = [each for each in proved.proofs if not each.good]
    assert {each.answer.verdict for each in bad} == {Verdict.BROKEN}
    assert all(each.replayed for each in bad)
    first = next(each for each in bad if each.answer.question.words.startswith("the contact is open"))
    assert report.told(first) == "call by call: counterexample, replayed on the embedded engine"
    table = "\n".join(report.table(proved, first))
    assert "Overdue (input)          TRUE" in table
    written = report.result(proved)
    assert not written.passed
    assert any("Overdue (input)" in each.message for each in written.bad)


def test_the_command_says_so_by_its_status(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(
        archive, "run", lambda *_, **__: iter([(report.result(planted("Overdue OR Restart", "Restart")), False)])
    )
    xml = tmp_path / "proofs.xml"
    done = CliRunner().invoke(app, ["prove", "jscc", "--junit", str(xml), "--rules"])
    assert done.exit_code == 1
    assert "NOT PROVED: the contact is open while a stop is overdue" in done.output
    assert "proved: such an edge closes it (A16)" in done.output
    root = etree.parse(xml).getroot()
    assert int(root.attrib["failures"]) > 0
    monkeypatch.setattr(archive, "run", lambda *_, **__: iter([(report.result(planted("nothing", "")), True)]))
    assert CliRunner().invoke(app, ["prove", "jscc", "--junit", str(xml)]).exit_code == 0  # the file is its own


@pytest.mark.thorough
def test_the_commands_on_the_pages_run_and_say_that_all_is_proved(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each with the proofs of the family that it names, which are the same in every run."""
    pages = [PAGE.parents[1] / "README.md", PAGE, *PAGE.parents[1].glob("blocks/docs/*.md")]
    lines = {text for page in pages for text in commands(page) if text.startswith("driveblocks prove")}
    assert {"driveblocks prove", "driveblocks prove chf", "driveblocks prove jscc --rules"} < lines
    (tmp_path / "my_drive.yaml").write_text(skeleton(), "utf-8")
    monkeypatch.chdir(tmp_path)
    known = [report.result(each) for each in everything()]
    monkeypatch.setattr(
        archive, "run", lambda sources, **_: of([prover.GENERIC, *(each.path.stem for each in sources)], known)
    )
    for line in sorted(lines):
        done = CliRunner().invoke(app, line.split()[1:])
        assert (done.exit_code, "questions: all proved" in done.output) == (0, True), f"{line}: {done.output}"
    assert (tmp_path / "proofs.xml").is_file()


def of(units: list[str], known: list[Result]) -> Iterator[tuple[Result, bool]]:
    """The proofs of some families."""
    return ((each, False) for each in known if each.unit in units)


def test_what_every_drive_shares_is_proved_once_for_the_same_text(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shared = [each for each in rules.shared() if each.block in ("MB_Plus", "MB_Overdue")]
    monkeypatch.setattr(rules, "shared", lambda: shared)
    told: list[tuple[float, float, str]] = []
    first, again = (list(archive.run([], Cache(tmp_path), lambda *each: told.append(each))) for _ in range(2))
    assert {each for each in told if each[2] == prover.READING} == {(0, 1, prover.READING)}
    told = [each for each in told if each[2] != prover.READING]
    asked = sum(len(each.outcomes) for each, _ in first)
    assert {text for _, _, text in told} == {f"{each.block} ({prover.GENERIC})" for each in shared}
    assert [done for done, _, _ in told] == sorted(done for done, _, _ in told)
    assert [told[at][:2] for at in (0, -1)] == [(0, asked), (asked, asked)]
    assert [kept for _, kept in first] == [False, False]
    assert again == [(each, True) for each, _ in first]
    monkeypatch.setattr(archive, "resources", lambda _: tmp_path)
    assert not any(kept for _, kept in archive.run([], Cache(tmp_path)))


def test_what_is_not_proved_is_not_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    broken = planted("Overdue OR Restart", "Restart")
    monkeypatch.setattr(prover, "proved", lambda *_: iter([broken]))
    assert [kept for _ in range(2) for _, kept in archive.run([], Cache(tmp_path))] == [False] * 4


def test_without_the_solver_it_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("driveblocks.commands.prove.find_spec", lambda _: None)
    done = CliRunner().invoke(app, ["prove", "jscc"])
    assert done.exit_code == 2
    assert "driveblocks[prove]" in done.output


@pytest.mark.thorough
def test_a_mistake_in_a_part_breaks_a_rule_of_the_whole() -> None:
    proved = planted("Seen.FaultCode <> Code", "Seen.FaultCode = Code", "VFD_FaultReset", "VFD_Control")
    bad = [each for each in proved.proofs if not each.good]
    assert any(each.answer.question.words.startswith("a fault reset is sent only while the same fault") for each in bad)
    assert all(each.replayed for each in bad)


FAULTS = [
    pytest.param(block, each, id=each["say"])
    for block, those in yaml.safe_load(Path(__file__).with_name("faults.yaml").read_text("utf-8")).items()
    for each in those
]


@pytest.mark.parametrize(("block", "fault"), FAULTS)
@pytest.mark.thorough
def test_a_mistake_in_a_block_breaks_its_rule(block: str, fault: dict[str, str]) -> None:
    proved = planted(fault["text"], fault["becomes"], block, block, fault["breaks"])
    assert any(each.answer.question.words.startswith(fault["breaks"]) for each in proved.proofs if not each.good)


@pytest.mark.thorough
def test_a_start_that_is_forbidden_breaks_its_rule() -> None:
    proved = planted("SettingsGood AND NOT Forbidden", "SettingsGood", "VFD_Start", "VFD_Control", "a start needs")
    assert not all(each.good for each in proved.proofs)


def test_the_line_calls_who_is_next_in_the_order_that_its_proof_takes_for_granted() -> None:
    text = (PAGE.parents[1] / "blocks" / "iec61131" / "line" / "MB_Line8.st").read_text("utf-8")
    called = [each.split()[0].strip(",);") for each in text.split("Next(Event := ")[1:]]
    order = [each for number, each in enumerate(called) if each != called[number - 1]]
    assert order == ["NEXT_ANEW", "NEXT_BEGINS", "NEXT_OFFER", "NEXT_DECIDES", "NEXT_SENT"]


MAPS = [
    pytest.param(name, marks=() if name in ("pulse", "signed") else pytest.mark.long)
    for name in (*texts(), "signed", "new", "no_bit", "sign", "forbidden")
]


@pytest.mark.parametrize("name", MAPS)
@pytest.mark.thorough
def test_a_map_of_ones_own_is_proved(name: str, tmp_path: Path) -> None:
    """Paths, pulses, several registers, active-low bits, signs, thresholds, forbidden starts; and what `new` writes."""
    path = tmp_path / f"{name}.yaml"
    path.write_text((texts() | values() | signs()).get(name) or skeleton(), "utf-8")
    (source,) = collection.read(catalog.chosen([str(path)]))
    made = dict(prover.texts([source]))[name]
    found = prover.proved(made, {name: rules.family(facts(source.drive))})
    assert not [report.told(each) for proved in found for each in proved.proofs if not each.good]


def test_the_page_names_every_rule_of_the_design() -> None:
    page = (PAGE.parent / "measured" / "prove.md").read_text("utf-8")
    named = [*range(9), *(f"A{number}" for number in range(1, 24)), *(f"B{number}" for number in range(1, 17))]
    assert not [each for each in named if f"| {each} |" not in page]


@pytest.mark.thorough
def test_a_reset_with_the_run_bit_breaks_its_rule() -> None:
    """000AH at a PowerFlex 4, which `check` refuses, too."""
    (source,) = collection.read(catalog.chosen(["rockwell_powerflex_4"]))
    commands_ = source.drive.operation.commands
    bits = {"set": (Span(1, 1), Span(3, 3)), "clear": (Span(0, 0), Span(2, 2), Span(4, 5))}
    reset = tuple(replace(one, **bits) if one.does == "fault_reset" else one for one in commands_)  # type: ignore[arg-type]  # spans
    drive = replace(source.drive, operation=replace(source.drive.operation, commands=reset))
    made = dict(prover.texts([replace(source, drive=drive)]))[source.path.stem]
    begins = "nothing in the word of a stop, nor of a fault reset"
    every = [
        replace(each, rules=tuple(rule for rule in each.rules if rule.say.startswith(begins)))
        for each in rules.family(facts(drive))
    ]
    broken = [proof for proved in prover.proved(made, {source.path.stem: every}) for proof in proved.proofs]
    assert {
        each.answer.question.words for each in broken if not each.good and each.answer.question.words.startswith(begins)
    }
