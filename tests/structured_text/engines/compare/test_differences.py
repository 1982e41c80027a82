"""The list of differences says what is so: on the embedded engine, on matiec, and in the linter."""

import pytest
from tests.structured_text.engines.compare.lockstep import first_unlike
from tests.structured_text.engines.compare.witness import BAD_C, ERROR, Witness, build_together, load_witnesses

from structured_text.engines.embedded import EmbeddedEngine
from structured_text.engines.engine import Engine
from structured_text.language.lint import lint_sources

WITNESSES = load_witnesses()


@pytest.fixture(params=WITNESSES, name="witness")
def _witness(request: pytest.FixtureRequest) -> Witness:
    return WITNESSES[request.param]


def test_matiec_gives_what_is_listed(matiec: Engine) -> None:
    """A matiec that does something else is no longer what the library was fitted to."""
    line = matiec.name.partition("-")[2]
    library = build_together(matiec, line)
    apart = [each for each in WITNESSES.values() if each.expected[line] == BAD_C]
    found = {each.name: each.value(matiec) if each in apart else each.run(library) for each in WITNESSES.values()}
    listed = {name: each.expected[line] for name, each in WITNESSES.items()}
    assert first_unlike(found, listed) is None, (found, listed)


def test_the_embedded_engine_stops_where_it_is_listed(witness: Witness) -> None:
    """A difference that goes unnoticed is listed as such, with the reason why that does no harm."""
    assert (witness.value(EmbeddedEngine()) == ERROR) == witness.fails


def test_the_linter_names_the_rule(witness: Witness) -> None:
    """What keeps the library out of it."""
    found = {each.rule for each in lint_sources([("witness.st", witness.text)])}
    assert found == set(witness.rules)
