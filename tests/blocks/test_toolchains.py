"""The library through iec2c of each line, and its C without a warning; the short form of the run over all programs."""

from pathlib import Path

import pytest
from tests.blocks.library import BLOCKS
from tests.blocks.toolchains import COMPILER, FOUND, compile_c, texts, translate

from structured_text.engines.matiec.installation import Installation

TOOLS = pytest.mark.parametrize(
    "tool",
    FOUND or [pytest.param(None, marks=pytest.mark.skip(reason="iec2c was not found"))],
    ids=lambda tool: tool.iec2c.parent.name if tool else "none",
)


@TOOLS
def test_library_compiles_without_a_warning(tool: Installation, tmp_path: Path) -> None:
    translate(tool, texts(BLOCKS), tmp_path)
    if COMPILER is None:
        pytest.skip("there is no C compiler")
    compile_c(tool, tmp_path)
