"""Files that were made to hurt a loader: each a name and what is in it. All are refused, quickly and in few words."""

from functools import cache
from pathlib import Path

from driveblocks.maps.source import MAX_BYTES

EXAMPLE = (Path(__file__).parent / "example.yaml").read_text(encoding="utf-8")
FULL = MAX_BYTES - 64
"""Almost as large as a map may be, so that the parser gets to see it."""


def _filled(text: str, size: int) -> str:
    return text * (size // len(text))


def _bomb(width: int) -> str:
    """Every level holds the one before it `width` times: nine levels of nine are 387 million values."""
    levels = ["a0: &a0 [" + ", ".join("x" * width) + "]"]
    levels += [f"a{n}: &a{n} [" + ", ".join([f"*a{n - 1}"] * width) + "]" for n in range(1, 10)]
    return "\n".join(levels)


def _stairs(steps: int) -> str:
    return "".join(" " * step + "a:\n" for step in range(steps))


def _instead(old: str, new: str) -> str:
    """The example with one part of it blown up."""
    assert EXAMPLE.count(old) == 1, old
    return EXAMPLE.replace(old, new)


def _rows(row: str, count: int) -> str:
    first = "      - {address: 0011H, name: Control source"
    return _instead(first, "".join(row.format(n) + "\n" for n in range(count)) + first)


@cache
def texts(share: int = 1) -> dict[str, str]:
    """The files of characters; of whatever is repeated in them, so small a part."""
    full = FULL // share
    return {
        "bomb_of_aliases": _bomb(9),
        "bomb_of_merge_keys": "a: &a {b: 1}\n" + "".join(f"c{n}: {{<<: *a}}\n" for n in range(20_000 // share)),
        "alias_of_itself": "a: &a [*a]",
        "brackets": "[" * full,
        "braces_with_keys": _filled("{a: ", full),
        "dashes": _filled("- ", full),
        "question_marks": _filled("? ", full),
        "list_of_many": "[" + _filled("a,", full),
        "stairs": _stairs(1000 // share),
        "keys": "".join(f"k{n:06}: 1\n" for n in range(200_000 // share)),
        "keys_almost_known": "".join(f"prefi{n:05}: T1\n" for n in range(30_000 // share)),
        "keys_twice": _filled("prefix: T1\n", full),
        "key_of_half_a_megabyte": "k" * full + ": 1",
        "anchors": "".join(f"k{n}: &a{n} 1\n" for n in range(30_000 // share)),
        "tags": _filled("- !!python/name:os.system x\n", full),
        "tag_that_runs_a_command": "!!python/object/apply:os.system [touch hacked]",
        "directives": _filled("%YAML 1.1\n", full),
        "directive_of_many_digits": "%YAML 1." + "1" * (100_000 // share) + "\n---\na: 1\n",
        "documents": _filled("---\n", full),
        "escape_beyond_unicode": 'a: "\\UFFFFFFFF"',
        "escape_of_half_a_pair": 'a: "\\uD800"',
        "escape_of_nothing": 'prefix: "\\0"',
        "one_digit_repeated": "prefix: " + "1" * full,
        "digits_and_underscores": "prefix: " + _filled("1_", full),
        "digits_and_colons": "prefix: " + _filled("1:", full),
        "word": "prefix: " + "T" * full,
        "quoted_text": 'prefix: "' + "T" * full + '"',
        "quote_never_closed": 'prefix: "' + "T" * full,
        "text_in_a_block": "prefix: |\n" + _filled("  line\n", full),
        "line": "# " + "x" * full,
        "lines": "\n" * full,
        "comments": _filled("#\n", full),
        "tabs": "\t" * full,
        "empty": "",
        "stars": "*" * full,
        "colons": ":" * full,
        "nulls": "\0" * full,
        "invisible": "\u200b" * (full // 3),
        "rows_over_everything": _rows("      - {{address: 0000H-FFFFH, name: All, zh: 全部}}", 6000 // share),
        "rows_twice": _rows("      - {{address: 0010H, name: All, zh: 全部}}", 6000 // share),
        "rows_backwards": _rows("      - {{address: FFFFH-0000H, name: All, zh: 全部}}", 6000 // share),
        "ids_of_a_long_range": _rows(
            "      - {{address: {:04X}H, id: A1-01..A1-99999999999999999999, name: All, zh: 全}}", 5000 // share
        ),
        "ids_of_many_digits": _rows(
            "      - {{address: {:04X}H, id: 111111111111111111111111, name: All, zh: 全}}", 5000 // share
        ),
        "series_over_everything": _instead(
            "      - {ids: U1-01..U1-04, base: 0020H, apart: [U1-03]}\n",
            _filled("      - {ids: U1-01..U1-04, base: 0021H}\n", 300_000 // share),
        ),
        "areas_over_everything": _instead(
            "areas:\n",
            "areas:\n"
            + "".join(
                f"  - {{id: a{n}, name: All, zh: 全, addresses: 0000H-FFFFH, numbered_by: parameter_number, access: r, "
                "source: s, examples: []}\n"
                for n in range(3000 // share)
            ),
        ),
        "values_twice": _instead(
            "          {value: 0, name: Keypad, zh: 键盘},\n",
            _filled("          {value: 5, name: X, zh: X},\n", 400_000 // share),
        ),
        "values_of_a_setting": _instead(
            "      - {value: 0, name: 4800 bit/s, zh: 4800BPS}\n",
            "".join(f"      - {{value: {n}, name: A{n}, zh: B}}\n" for n in range(9000 // share)),
        ),
        "codes_of_the_line": _instead(
            "      - {code: 0, baud: 4800}\n",
            "".join(f"      - {{code: {n}, baud: 4800}}\n" for n in range(9000 // share)),
        ),
        "fault_registers_without_end": _instead(
            "  registers: [0030H]", "  registers: [" + "0000H-FFFFH, " * (9000 // share) + "0030H]"
        ),
        "fault_words_without_end": _instead("{first: 0014H, last: 0015H", "{first: 0000H, last: FFFFH"),
        "references": _instead(
            "about: [register 0020H, register 0021H]", f"about: [{'register 0020H, ' * (20_000 // share)}prose]"
        ),
        "references_to_ranges": _instead(
            "about: [register 0020H, register 0021H]",
            "about: [" + "".join(f"register 0000H-{n:04X}H, " for n in range(9000 // share)) + "nothing]",
        ),
        "words_of_a_frame": _instead("values: [1, 5000]", f"values: [{'1, ' * (40_000 // share)}1]"),
        "bytes_of_a_frame": _instead(
            "    printed: 01 08 00 00 12 AB AD 14\n", "    printed: " + "01 " * (1200 // share) + "14\n"
        ),
        "read_of_every_word": _instead(
            "    printed: 01 08 00 00 12 AB AD 14\n    checksum: right\n    correct: 01 08 00 00 12 AB AD 14",
            "    printed: 01 03 00 00 FF FF 04 7A\n    checksum: right\n    correct: 01 03 00 00 FF FF 04 7A",
        ),
        "conditions": _instead(
            "      - {register: 0020H, equals: 0}\n",
            _filled("      - {register: FFFFH, equals: 0}\n", 300_000 // share),
        ),
    }


BINARIES: dict[str, bytes] = {
    "program": b"\x7fELF\x02\x01\x01" + bytes(range(256)) * 400,
    "picture": b"\x89PNG\r\n\x1a\n" + bytes(1000),
    "utf_16": EXAMPLE.encode("utf-16"),
    "utf_16_big_without_mark": EXAMPLE.encode("utf-16-be"),
    "utf_32": EXAMPLE.encode("utf-32"),
    "gb18030": EXAMPLE.encode("gb18030"),
    "latin_1": "prefix: naïve\n".encode("latin-1"),
    "byte_order_mark_and_rubbish": b"\xef\xbb\xbfprefix: T1\n\xff",
    "two_byte_order_marks": b"\xef\xbb\xbf\xef\xbb\xbf" + EXAMPLE.encode(),
    "surrogate_in_utf_8": b"prefix: \xed\xa0\x80\n",
    "overlong_slash": b"prefix: \xc0\xaf\n",
    "cut_in_a_character": EXAMPLE.encode()[: EXAMPLE.encode().index("示".encode()) + 2],
    "null_byte": b"prefix: T1\0\n",
    "larger_than_allowed": b"# " + b"x" * MAX_BYTES,
    "fifty_megabytes": b"#" * 50_000_000,
}


def contents(share: int) -> dict[str, bytes]:
    """Every file by its name; of whatever is repeated in characters, so small a part."""
    return {**{name: text.encode() for name, text in texts(share).items()}, **BINARIES}
