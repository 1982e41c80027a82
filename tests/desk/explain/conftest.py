"""One set of explainers for all tests."""

import pytest
from tests.desk.explain.explaining import Explain


@pytest.fixture(scope="session")
def explain() -> Explain:
    """The explainers."""
    return Explain()
