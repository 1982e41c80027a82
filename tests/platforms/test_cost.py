"""What an extra costs, as the pages say it: data summed a second time from the texts, code measured by matiec."""

import re
import subprocess
from pathlib import Path

import pytest
from tests.blocks.test_overview import size_of
from tests.blocks.toolchains import COMPILER, FOUND, UNIT, run, translate
from tests.platforms.stock import canon, made, volumes

from driveblocks.platforms import EXPORTS
from driveblocks.platforms.cost import CODE_KIB, CPU_KB, FAMILY_KIB
from driveblocks.platforms.openplc.writer import write

BLOCKS = Path(__file__).parents[2] / "blocks"
PAGE = BLOCKS.parent / "docs/memory.md"
SECTION = re.compile(r"^(VAR\w*)[^\n]*\n(.*?)^END_VAR", re.MULTILINE | re.DOTALL)
VARIABLE = re.compile(r"^  (\w+) : (?:ARRAY\[0\.\.(\d+)\] OF )?(\w+)", re.MULTILINE)
ROW = re.compile(r"^\| .* \| (?:`(\w+)` ([\d,]+)|-) \| (\d+|-) \|$", re.MULTILINE)
NEEDS = {"Meter": ("Parameters",)}


def kept(name: str) -> int:
    """Bytes of an instance without its in-outs, and without those of the blocks in it."""
    if not (name in canon() and "\nFUNCTION_BLOCK " in canon()[name].text):
        return size_of(name)
    return sum(count * kept(kind) for section, count, kind in variables(name) if section != "VAR_IN_OUT")


def variables(name: str) -> list[tuple[str, int, str]]:
    """Of each variable of a block: its section, how many elements of what type."""
    text = re.sub(r"\(\*.*?\*\)", "", canon()[name].text, flags=re.DOTALL)
    return [
        (section, int(last or 0) + 1, kind)
        for section, inner in SECTION.findall(text)
        for _, last, kind in VARIABLE.findall(inner)
    ]


def data(name: str) -> int:
    """With what its own in-outs refer to."""
    return kept(name) + sum(
        count * size_of(kind) for section, count, kind in variables(name) if section == "VAR_IN_OUT"
    )


@pytest.mark.parametrize("platform", EXPORTS)
def test_each_platform_says_what_an_extra_costs(platform: str) -> None:
    rows = ROW.findall((BLOCKS / platform / "README.md").read_text("utf-8"))
    files = volumes(made(), [(one.folder, one.name, one.text) for one in canon().values()])
    shared = [texts for name, texts in files.items() if name.startswith("shared/")]
    assert [int(code) for *_, code in rows if code != "-"] == list(CODE_KIB.values())
    for (block, size, _), texts in zip(rows, shared, strict=False):
        blocks = re.findall(r"^FUNCTION_BLOCK (\w+)", "".join(texts), re.MULTILINE)
        sizes = {each: data(each) for each in blocks}
        assert (int(size.replace(",", "")), sizes[block]) == (max(sizes.values()),) * 2 if blocks else not block


def test_the_families_say_how_many_bytes_one_drive_takes() -> None:
    page = (BLOCKS / "docs/Families.md").read_text("utf-8")
    for drive in made().drives.values():
        assert re.search(rf"^\| `{drive.prefix}` \|.* \| {data(f'{drive.prefix}_Drive'):,} \|$", page, re.MULTILINE)


@pytest.mark.parametrize(("slots", "drives"), [(2, 1), (8, 4), (8, 8)])
def test_the_page_of_memory_says_how_many_bytes_a_line_takes(slots: int, drives: int) -> None:
    row = next(row for row in PAGE.read_text("utf-8").splitlines() if row.startswith("| data where in-outs"))
    said = int(row.split(" | ")[{1: 1, 4: 2, 8: 3}[drives]].strip(" |").replace(",", ""))
    buffers = size_of("MB_Adu") + size_of("MB_LineFrame") + slots * size_of("MB_Slot")
    assert said == pytest.approx(kept(f"MB_ByteLine{slots}") + buffers + drives * kept("PF4_Drive"), rel=0.05)


def test_the_page_of_memory_says_what_each_controller_has() -> None:
    names, sizes = re.findall(r"^\| (?:`cpu`|work memory, kB) \| (.*) \|$", PAGE.read_text("utf-8"), re.MULTILINE)
    assert {name: int(size) for name, size in zip(names.split(" | "), sizes.split(" | "), strict=True)} == CPU_KB


def code(names: list[str], folder: Path) -> int:
    """Bytes of machine code and constants of some files by matiec."""
    texts = write(made())
    translate(FOUND[0], [texts[f"{name}.st"] for name in names], folder)
    (folder / "unit.c").write_text(UNIT, encoding="utf-8")
    headers = ["-isystem", str(FOUND[0].library / "C"), "-I", "."]
    run([str(COMPILER), "-c", "-Os", "-w", *headers, "unit.c"], folder)
    said = subprocess.run(["size", "unit.o"], cwd=folder, capture_output=True, text=True, check=True).stdout
    return sum(map(int, said.splitlines()[1].split()[:2]))


@pytest.mark.thorough
@pytest.mark.skipif(not FOUND or COMPILER is None, reason="needs matiec and a C compiler")
def test_the_code_is_as_large_as_the_pages_say(tmp_path: Path) -> None:
    base = "shared/DriveBlocks"
    least = code([base], tmp_path)
    found = {"": least}
    for extra in [each for each in CODE_KIB if each]:
        before = [base, *(f"{base}_{each}" for each in NEEDS.get(extra, ()))]
        found[extra] = code([*before, f"{base}_{extra}"], tmp_path) - code(before, tmp_path)
    families = [code([base, f"families/{one.prefix}"], tmp_path) - least for one in made().drives.values()]
    ends = zip(FAMILY_KIB, (min(families), max(families)), strict=True)
    for kib, size in [*((CODE_KIB[each], size) for each, size in found.items()), *ends]:
        assert abs(kib - size / 1024) <= max(1, 0.1 * kib), (found, families)
