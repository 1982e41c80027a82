"""The two lines of matiec are distinguished by what they do."""

from dataclasses import replace

import pytest

from structured_text.engines.discovery import Behaviour, observe
from structured_text.engines.matiec import MatiecEngine


@pytest.mark.parametrize(
    ("behaviour", "line", "pure"),
    [
        (Behaviour(0, f_trig_fires_at_once=True, empty_equals_x=False), "beremiz", True),
        (Behaviour(1, f_trig_fires_at_once=False, empty_equals_x=True), "openplc", True),
        (Behaviour(1, f_trig_fires_at_once=True, empty_equals_x=False), "beremiz", False),
        (Behaviour(0, f_trig_fires_at_once=False, empty_equals_x=True), "openplc", False),
        (Behaviour(1, f_trig_fires_at_once=True, empty_equals_x=True), "openplc", False),
    ],
)
def test_majority_decides(behaviour: Behaviour, line: str, pure: bool) -> None:
    assert (behaviour.line, behaviour.pure) == (line, pure)


def test_engine_is_named_by_what_it_does(matiec: MatiecEngine) -> None:
    behaviour = observe(replace(matiec, name="whatever"))
    assert matiec.name == f"matiec-{behaviour.line}"
