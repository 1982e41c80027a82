"""What each tool says about a program: our checker, and matiec where it is found."""

from pathlib import Path

import yaml

from structured_text.engines.engine import BuildError, Engine, EngineError, Source
from structured_text.engines.matiec.errors import (
    BadCError,
    CompilerCrashError,
    CompilerTimeoutError,
    RefusedWithCrashError,
)
from structured_text.language.lint import lint_sources

FILE = Path(__file__).parent / "verdicts.yaml"
COLUMNS = ("checker", "matiec-beremiz", "matiec-openplc")
ACCEPT = "accept"

# Verdicts by program and column.
Verdicts = dict[str, dict[str, str]]


def checker_verdict(text: str) -> str:
    """`accept`, or the names of the rules that object, in alphabetical order with spaces between."""
    return " ".join(sorted({each.rule for each in lint_sources([("program.st", text)])})) or ACCEPT


def matiec_verdict(engine: Engine, text: str) -> str:
    """`ok`; `refused`; `crash`; `hang`; `badC` if its C does not compile; `failed` if it says nothing that is known."""
    try:
        engine.build([Source("program.st", text)])
    except (CompilerCrashError, RefusedWithCrashError):
        return "crash"
    except CompilerTimeoutError:
        return "hang"
    except BadCError:
        return "badC"
    except BuildError:
        return "refused"
    except EngineError:
        return "failed"
    return "ok"


def read_verdicts() -> Verdicts:
    """The recorded verdicts."""
    rows = yaml.safe_load(FILE.read_text(encoding="utf-8"))
    return {name: dict(zip(COLUMNS, row, strict=True)) for name, row in rows.items()}


def write_verdicts(verdicts: Verdicts) -> None:
    """Keep verdicts, one line per program."""
    head = f"# Recorded by tests/structured_text/engines/accept/record.py. Columns: {', '.join(COLUMNS)}.\n"
    rows = [f"{name}: [{', '.join(row[column] for column in COLUMNS)}]\n" for name, row in verdicts.items()]
    FILE.write_text(head + "".join(rows), encoding="utf-8")
