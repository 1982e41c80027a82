"""What is left out of the coverage exists, and is left out."""

import sys
from pathlib import Path

import pytest
from tests.counting import NOT_COUNTED, uncounted


@pytest.mark.parametrize("name", NOT_COUNTED)
def test_every_name_begins_that_of_a_test(name: str) -> None:
    path, _, function = name.partition("::")
    found = Path(__file__).parent / path
    assert found.is_dir() if path.endswith("/") else f"def {function}" in found.read_text("utf-8")


def test_the_trace_function_is_set_again() -> None:
    before = sys.gettrace()
    with uncounted():
        assert sys.gettrace() is None
    assert sys.gettrace() is before
