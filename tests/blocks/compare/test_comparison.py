"""Every block and function of the library gives the same state after every scan, on every engine.

The short form of `python -m tests.blocks.compare.long`.
"""

from itertools import islice

import pytest
from tests.blocks.compare.comparison import Libraries, beside, build, compare, subjects
from tests.blocks.compare.pou import shipped
from tests.blocks.compare.stimulus import enough, stimuli
from tests.blocks.compare.subject import EmbeddedSubject
from tests.blocks.library import alone

from structured_text.engines.embedded import EmbeddedEngine
from structured_text.engines.engine import Engine

SEED = 7
FOLDERS = sorted({each.path.partition("/")[0] for each in alone()} - {"types"})

ONE_WORD = [f"rockwell_powerflex_{name}/PF{name.upper()}" for name in ("4", "400", "40p", "4m", "525")]
UNREACHED = {
    ("invt_chf/CHF_Reference.st", "IF Count > 10000.0 THEN"),
    ("invt_chf/CHF_Reference.st", "Count := 10000.0; (* the range of the register ends here *)"),
    ("invt_chf/CHF_Reference.st", "Limited := TRUE;"),
    *((f"{file}_Request.st", "ELSIF Behind > 65536 THEN") for file in ONE_WORD),
    *((f"{file}_Request.st", "ErrorID := 4; (* the registers run past FFFFH *)") for file in ONE_WORD),
    ("modbus/MB_BuildWriteMultiple.st", "WHILE Index < Quantity DO"),
    ("modbus/MB_AsciiEncode.st", "WHILE Index < Length DO"),
    ("modbus/MB_AsciiDecode.st", "WHILE (Position < Behind) AND (ErrorID = 0) DO"),
    ("modbus/MB_ParseReply.st", "WHILE (Index < Request.Quantity) AND (Index < 125) DO"),
}
"""CHF_Reference guards a quotient that the clamp before it keeps at 1.0 or less; requests to a PowerFlex take one
register, which cannot lie past FFFFH; the lengths and quantities that bound these loops are checked before, so that
none ends without a turn."""


_BESIDE: dict[str, Libraries] = {}


@pytest.mark.parametrize("folder", FOLDERS)
def test_matiec_gives_the_same_state_after_every_scan(folder: str, matiec: Engine) -> None:
    """Every variable of the instance and of all inside it."""
    if matiec.name not in _BESIDE:
        _BESIDE[matiec.name] = build(beside(matiec))
    _assert_compared(_BESIDE[matiec.name], folder)


def _assert_compared(libraries: Libraries, folder: str) -> None:
    pous = [pou for pou in shipped().pous.values() if pou.folder == folder]
    found = [compare(pou, subjects(libraries, pou), enough(pou), SEED) for pou in pous]
    assert [str(each) for each in found if each is not None] == []


@pytest.mark.thorough
def test_the_inputs_reach_every_line_and_outcome() -> None:
    """What never ran was never compared; what cannot run is explained above."""
    library = EmbeddedEngine(coverage=True).build(shipped().sources)
    for pou in shipped().pous.values():
        run = EmbeddedSubject(library, pou, "embedded")
        for inputs in islice(stimuli(pou, SEED), enough(pou)):
            run.step(inputs)
    lines = {(path, line) for path, hits in library.coverage().items() for line in hits if not hits[line]}
    branches = library.branches().items()
    lines |= {(path, outcome.line) for path, hits in branches for outcome in hits if not hits[outcome]}
    texts = {source.path: source.text.splitlines() for source in shipped().sources}
    assert {(path, texts[path][line - 1].strip()) for path, line in lines} == UNREACHED
