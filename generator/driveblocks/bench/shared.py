"""Programs for the blocks that every drive shares."""

from collections.abc import Iterator, Sequence

from driveblocks.bench import builder, checksum, framing, kit, packing, reply, text
from driveblocks.bench.script import Script
from driveblocks.reference.permission import MOST_READ
from driveblocks.reference.reply import Dialect, parse
from structured_text.language.writing import word

PROTOCOL = "MODBUS Application Protocol V1.1b3"


def scripts(languages: Sequence[text.Language]) -> Iterator[Script]:
    for subject in (checksum, framing, packing, builder):
        yield from subject.scripts()
    yield from _replies()
    yield from text.results(languages)
    yield from text.own(languages)


def _replies() -> Iterator[Script]:
    """The parser by itself: with the standard's refusals, then with a drive's that are write replies."""
    rest = "Adu := Adu, Request := Request, Words := Words);"
    standard = reply.Subject(f"Parse(Length := Length, {rest}", Dialect(), (5, 6))
    pins = "ExceptionAdd := 0, ErrorFunction := 6, ErrorAddress := WORD#16#5001, TwoByteCount := TRUE"
    other = reply.Subject(f"Parse(Length := Length, {pins}, {rest}", Dialect(None, 6, 0x5001, True), (8, 33))
    for kind, subject, functions in (("Standard", standard, (3, 4, 6, 8, 16)), ("Other", other, (3, 6))):
        for function in functions:
            title = f"replies to function {function:02X}H, {kind.lower()} form of refusal"
            program = kit.generic(f"{kind}{function:02X}H", title, f"{PROTOCOL}, 6.3 to 6.12 and 7.")
            kit.declare(program, "Adu", "Words", "Request", Parse="MB_ParseReply")
            reply.fill(program, subject, reply.asked(function))
            yield program
    yield _longest()


def _longest() -> Script:
    """As many registers as a frame can carry."""
    asked = reply.asked(3, quantity=MOST_READ)
    program = kit.generic("Longest", "a reply with as many registers as a frame carries", f"{PROTOCOL}, 6.3.")
    kit.declare(program, "Adu", "Words", "Request", Parse="MB_ParseReply")
    kit.declare_ramp(program)
    size = 3 + 2 * MOST_READ
    head = bytes([asked.unit, asked.function, 2 * MOST_READ])
    words = parse(Dialect(), asked, head + kit.sample(size)[3:]).words
    ends = (0, 1, 62, 123, 124)
    program.stage(
        f"{MOST_READ} registers",
        *kit.ramp("Adu", size),
        *kit.fill("Adu", head),
        *kit.open_request(asked),
        f"Parse(Length := {size}, Adu := Adu, Request := Request, Words := Words);",
        kit.has_result("Parse", "OK"),
        kit.is_number("Parse.WordCount", MOST_READ, "WordCount"),
        *(kit.is_word(f"Words[{index}]", word(words[index]), f"word {index}") for index in ends),
    )
    return program
