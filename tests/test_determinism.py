"""No test looks at a clock or draws at random: a busy machine gives the same verdicts as an idle one, in every run."""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

TESTS = Path(__file__).parent
FILES = [path for path in TESTS.rglob("*.py") if path.name.startswith("test_") or path.name == "conftest.py"]
SETTINGS = {"max_examples", "suppress_health_check"}
"""What a test may set for itself; a deadline, a database and chance are the profile's."""
NET = 600
"""Seconds of a limit that no machine reaches, for what would hang."""


def strays(text: str) -> Iterator[str]:
    """What makes a test depend on a clock or on chance, each as `line: code`."""
    for node in ast.walk(ast.parse(text)):
        if _strays(node):
            yield f"{node.lineno}: {ast.unparse(node)}"  # type: ignore[attr-defined]  # import and call have a line


def _strays(node: ast.AST) -> bool:
    if isinstance(node, ast.Import):
        return any(alias.name == "time" for alias in node.names)
    if isinstance(node, ast.ImportFrom):
        return node.module in ("time", "random")
    if not isinstance(node, ast.Call):
        return False
    called = ast.unparse(node.func)
    keywords = {each.arg: each.value for each in node.keywords}
    if called == "settings":
        return not SETTINGS.issuperset(keywords)
    if called == "subprocess.run" and isinstance(limit := keywords.get("timeout"), ast.Constant):
        return isinstance(limit.value, (int, float)) and limit.value < NET
    return (called == "random.Random" and not node.args) or (called.startswith("random.") and called[7:].islower())


@pytest.mark.parametrize("path", FILES, ids=lambda path: str(path.relative_to(TESTS)))
def test_no_test_depends_on_a_clock_or_on_chance(path: Path) -> None:
    assert list(strays(path.read_text(encoding="utf-8"))) == []


@pytest.mark.parametrize(
    "text",
    [
        "import time", "from time import monotonic", "from random import choice", "random.Random()",
        "random.choice([1])", "@settings(deadline=100)\ndef test(): pass", "settings(derandomize=False)",
        "subprocess.run([], timeout=60)",
    ],
)  # fmt: skip
def test_what_depends_on_them_is_found(text: str) -> None:
    assert list(strays(text))


def test_the_profile_is_without_clock_and_chance() -> None:
    used = settings()
    assert (used.deadline, used.derandomize, used.database) == (None, True, None)
    assert HealthCheck.too_slow in used.suppress_health_check
