"""What happens to the text of a template."""

from driveblocks.render import environment


def test_a_block_declares_what_it_names() -> None:
    used, more, result = (
        "VAR\n  Used : UINT; (* Spare *)\n",
        "  Spare : UINT; (* Spare *)\n",
        "END_VAR\n\n  Used := 1;\n",
    )
    pins = "VAR_INPUT\n  Idle : BOOL; (* a pin stays *)\nEND_VAR\n"
    assert environment.needed(pins + used + more + result) == pins + used + result
    assert environment.needed(f"VAR CONSTANT\n{more}END_VAR\n{pins}") == pins
