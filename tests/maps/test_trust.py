"""Trust: each fact has that of its document, and what moves the motor runs only when it was read or checked."""

from dataclasses import replace
from pathlib import Path

import pytest
from click.testing import CliRunner
from tests.shipped import drives

from driveblocks.cli import app
from driveblocks.docs.page import documents
from driveblocks.maps import trust
from driveblocks.maps.load import loads
from driveblocks.maps.model import Document, Drive
from driveblocks.maps.revision import checked, revision
from driveblocks.render.library import drive as library_of
from driveblocks.render.library import generic
from driveblocks.render.text import languages

LANGUAGES = languages(["en"], "utf-8")
EXAMPLE = Path(__file__).with_name("example.yaml").read_text(encoding="utf-8")
DOCUMENTS = {
    "guide": "  - {id: guide, title: Fieldbus guide of the EX200, publisher: Example Drives, trust: sister}\n",
    "driver": "  - {id: driver, title: Driver of a milling machine, publisher: Its user, trust: in_use}\n",
}
STANDSTILL, FAULTS, TABLE = "  standstill:\n", "\nfaults:\n", "  - id: status\n"
MIXED = {STANDSTILL: "    document: driver\n", FAULTS: "  document: guide\n"}
"""The faults are those of a sister model; the standstill is what the software of a machine goes by."""


def _text(added: dict[str, str]) -> str:
    """The example with lines after some of its own, and the documents that these name."""
    named = [line for name, line in DOCUMENTS.items() if any(name in text for text in added.values())]
    text = EXAMPLE.replace("\ndocuments:\n", "\ndocuments:\n" + "".join(named))
    for line, more in added.items():
        assert text.count(line) == 1
        text = text.replace(line, line + more)
    return text


def _drive(added: dict[str, str]) -> Drive:
    return loads(_text(added), "example.yaml")


def test_what_names_no_document_is_read_in_the_manual() -> None:
    drive = _drive({})
    assert trust.counted(drive) == {"commands": {"read": 6}, "status": {"read": 5}, "faults": {"read": 4}}
    assert (trust.second_hand(drive), trust.heard(drive), trust.rung(drive)) == (False, [], "read, read, read")


def test_facts_are_counted_by_their_documents() -> None:
    drive = _drive(MIXED)
    assert trust.counted(drive)["status"] == {"read": 4, "in_use": 1}
    assert trust.counted(drive)["faults"] == {"sister": 4}
    assert (trust.second_hand(drive), trust.rung(drive)) == (True, "read, in use, sister")
    assert trust.heard(drive)[0] == "status, in use (Driver of a milling machine, Its user): standstill"
    assert trust.heard(drive)[1] == "faults, sister (Fieldbus guide of the EX200, Example Drives): all 4"


def test_a_status_is_trusted_no_further_than_the_table_of_its_register() -> None:
    drive = _drive({TABLE: "    document: guide\n"})
    assert trust.counted(drive)["status"] == {"sister": 5}
    assert trust.second_hand(drive)


def test_faults_alone_ask_nobody_to_check_the_manual() -> None:
    drive = _drive({FAULTS: "  document: guide\n"})
    assert (trust.second_hand(drive), len(trust.heard(drive))) == (False, 1)


def test_a_map_that_others_wrote_down_is_transcribed() -> None:
    drive = _drive({})
    drive = replace(drive, manual=replace(drive.manual, second_hand=True))
    assert trust.rung(drive) == "transcribed, transcribed, transcribed"
    assert trust.heard(drive)[0].startswith("commands, transcribed (the manual as others wrote it down): run forward,")


def test_a_key_that_is_left_out_changes_no_number() -> None:
    """The numbers are printed on pages and typed into programs: they stay what they were without the key."""
    drive = _drive({})
    assert "document=None" in repr(drive)
    assert (revision(drive), checked(drive)) == (2985226014, 27535)
    assert checked(_drive(MIXED)) != 27535


def test_the_block_and_its_page_ask_for_the_check() -> None:
    drive = drives()["JSCC"]
    guide = Document(id="driver", title="Driver of a mill", publisher="Its user", trust="in_use")
    still = replace(drive.operation.standstill, document="driver")
    mixed = replace(drive, documents=(guide,), operation=replace(drive.operation, standstill=still))
    files = [*generic(LANGUAGES), *library_of("jscc", mixed, LANGUAGES)]
    block = next(file.text for file in files if file.name == "JSCC_Drive")
    page = documents(files, [mixed])["docs/JSCC_Drive.md"]
    assert f"ManualChecked <> {checked(mixed)}" in block
    assert f"**`ManualChecked := {checked(mixed)}`**" in page
    assert "\n- status, in use (Driver of a mill, Its user): standstill\n" in page


@pytest.mark.parametrize("command", ["list", "show"])
def test_commands_say_what_was_not_read(command: str, tmp_path: Path) -> None:
    path = tmp_path / "mixed.yaml"
    path.write_text(_text(MIXED), encoding="utf-8")
    shown = CliRunner().invoke(app, [command, str(path)], env={"COLUMNS": "200"})
    assert shown.exit_code == 0
    assert "status, in use (Driver of a milling machine, Its user): standstill" in shown.stdout
