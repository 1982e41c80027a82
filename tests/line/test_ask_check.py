"""MB_AskCheck shows a stop that two calls have written."""

from itertools import product

from tests.blocks.library import sources

from structured_text.engines.engine import Engine, Source

FIELDS = {
    "Number": "UINT",
    "Address": "WORD",
    "FunctionCode": "USINT",
    "Quantity": "USINT",
    "Unit": "USINT",
    "FamilyCode": "UINT",
    "Data": "WORD",
}
PROGRAM = f"""PROGRAM T_AskCheck
VAR
  {" ".join(f"{name} : {kind};" for name, kind in FIELDS.items())}
  Check : WORD;
END_VAR
  Check := MB_AskCheck({", ".join(f"{name} := {name}" for name in FIELDS)});
END_PROGRAM
"""
STOPS = (
    (0, 0, 0, 0, 0, 0, 0),
    (1, 0x2000, 6, 1, 1, 0x1234, 0x0001),
    (2, 0x2000, 6, 1, 2, 0x1234, 0x0005),
    (65535, 0xFFFF, 16, 4, 255, 65535, 0xFFFF),
)


def test_a_stop_that_is_half_another_does_not_fit(engine: Engine) -> None:
    wanted = [each for each in sources() if each.path.endswith("/MB_AskCheck.st")]
    program = engine.build([*wanted, Source("check.st", PROGRAM)]).instance("T_AskCheck")

    def check(values: tuple[int, ...]) -> int:
        for name, value in zip(FIELDS, values, strict=True):
            program[name] = value
        program.scan()
        found = program["Check"]
        assert isinstance(found, int)
        return found

    assert check(STOPS[0]) != 0
    for old, new in product(STOPS, repeat=2):
        mixed = set(product(*zip(old, new, strict=True)))
        fits = {values for values in mixed if check(values) == check(new)}
        assert fits == {new}
