"""The command line for plain files: `lint`, `run`, `test`. Status 0: good, 1: findings or failures, 2: bad input."""

import argparse
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

from structured_text import files
from structured_text.engines.coverage import Branches, Lines
from structured_text.engines.discovery import EMBEDDED, MATIEC_NAMES, survey
from structured_text.engines.embedded import EmbeddedEngine, EmbeddedLibrary
from structured_text.engines.engine import Engine, EngineError, Instance, Source, Value
from structured_text.findings import print_problems, print_rules
from structured_text.language.lint import Selection, UnknownRuleError, lint_sources
from structured_text.language.parser import ParseError, parse
from structured_text.language.tree import Program, VarKind

MS = 1_000_000
"""Nanoseconds."""


class BadInputError(Exception):
    """What cannot be worked on, in words."""


def main(words: Sequence[str]) -> int:
    """Do what a command line says; its exit status."""
    options = _parser().parse_args(words)
    try:
        return {"lint": _lint, "run": _run, "test": _test}[options.command](options)
    except (BadInputError, EngineError) as error:
        print(error, file=sys.stderr)
        return 2


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m structured_text", description="Lint, run and test Structured Text."
    )
    commands = parser.add_subparsers(dest="command", required=True)
    lint = commands.add_parser("lint", help="report what is not portable: file:line:column, code, rule, reason")
    lint.add_argument("--select", action="append", metavar="RULE", help="report only this rule, by name or code")
    lint.add_argument("--ignore", action="append", metavar="RULE", help="do not report this rule")
    lint.add_argument("--list", action="store_true", help="list the rules and stop")
    lint.add_argument("--format", choices=("text", "json"), default="text")
    run = commands.add_parser("run", help="run a program and print variables whenever they change")
    run.add_argument("--program", metavar="NAME", help="which, if there are several")
    run.add_argument("--scans", type=int, default=100, metavar="N")
    run.add_argument("--every", type=int, default=10, metavar="MS", help="time from scan to scan")
    run.add_argument("--set", action="append", default=[], metavar="NAME=VALUE", help="before the first scan")
    run.add_argument("--show", action="append", metavar="NAME", help="all outputs, unless named")
    test = commands.add_parser("test", help="run every program that has outputs Done and Failures until it is done")
    test.add_argument("--scans", type=int, default=100_000, metavar="N", help="a program that takes more has failed")
    test.add_argument("--every", type=int, default=10, metavar="MS", help="time from scan to scan")
    test.add_argument("--coverage", action="store_true", help="list statements and outcomes that were not reached")
    for each in (run, test):
        each.add_argument("--engine", choices=(EMBEDDED, *MATIEC_NAMES), default=EMBEDDED)
    for each in (lint, run, test):
        each.add_argument("files", nargs="*", type=Path, metavar="FILE", help="sources, or folders of .st files")
    return parser


def _sources(options: argparse.Namespace) -> list[Source]:
    """The sources that a command line names. Raises BadInputError with every file that cannot be read."""
    read, bad = files.sources(options.files)
    if bad:
        raise BadInputError("\n".join(bad))
    if not read:
        raise BadInputError("name at least one file")
    return [Source(*each) for each in read]


def _lint(options: argparse.Namespace) -> int:
    if options.list:
        print_rules(options.format)
        return 0
    try:
        selection = Selection.of(options.select or [], options.ignore or [])
    except UnknownRuleError as error:
        raise BadInputError(str(error)) from None
    sources = _sources(options)
    problems = lint_sources([(each.path, each.text) for each in sources], selection)
    print_problems(problems, options.format)
    if any(each.rule in ("syntax", "long-expression") for each in problems):
        return 2
    return 1 if problems else 0


def _engine(options: argparse.Namespace, *, coverage: bool = False) -> Engine:
    if options.engine == EMBEDDED:
        return EmbeddedEngine(coverage=coverage)
    found = next(each for each in survey().candidates() if each.name == options.engine)
    if found.engine is None:
        raise BadInputError(f"{found.name} does not run here: {found.note}")
    return found.engine


def _programs(sources: Sequence[Source]) -> Iterator[Program]:
    """Every program. Raises BadInputError with every syntax error."""
    bad: list[str] = []
    for source in sources:
        try:
            yield from (each for each in parse(source.text, source.path).elements if isinstance(each, Program))
        except ParseError as error:
            bad += [f"{each.path}:{each.line}:{each.column}: {each.text}" for each in error.problems]
    if bad:
        raise BadInputError("\n".join(bad))


def _outputs(program: Program) -> list[str]:
    return [each.name for block in program.blocks for each in block.variables if each.kind is VarKind.OUTPUT]


def _run(options: argparse.Namespace) -> int:
    sources = _sources(options)
    programs = list(_programs(sources))
    found = [each for each in programs if options.program in (None, each.name)]
    if len(found) != 1:
        raise BadInputError(
            f"name one program by --program: {', '.join(each.name for each in programs) or 'there is none'}"
        )
    instance = _engine(options).build(sources).instance(found[0].name)
    for each in options.set:
        _give(instance, each)
    shown = options.show or _outputs(found[0])
    last: list[Value] | None = None
    for scan in range(options.scans):
        instance.scan(scan * options.every * MS)
        values = [_read(instance, name) for name in shown]
        if values != last:
            words = "  ".join(f"{name}={_shown(value)}" for name, value in zip(shown, values, strict=True))
            print(f"{scan * options.every:>8} ms  {words}")
            last = values
    return 0


def _give(instance: Instance, words: str) -> None:
    """Give a variable its value, written as in ST without a type: TRUE, 5, 2.5 or 'text'."""
    name, sign, text = words.partition("=")
    value: Value
    try:
        if text.upper() in ("TRUE", "FALSE"):
            value = text.upper() == "TRUE"
        elif text.startswith("'"):
            value = text.strip("'").encode()
        else:
            value = float(text) if "." in text else int(text)
        instance[name] = value
    except (KeyError, ValueError, TypeError) as error:
        reason = "there is no such variable" if isinstance(error, KeyError) else str(error)
        raise BadInputError(f"--set {words}: {reason if sign else 'write NAME=VALUE'}") from None


def _read(instance: Instance, name: str) -> Value:
    try:
        return instance[name]
    except KeyError:
        raise BadInputError(f"--show {name}: there is no such variable") from None


def _shown(value: Value) -> str:
    if isinstance(value, bool):
        return str(value).upper()
    if isinstance(value, bytes):
        return "'" + value.decode("utf-8", "replace") + "'"
    return f"{value:g}" if isinstance(value, float) else str(value)


def _test(options: argparse.Namespace) -> int:
    sources = _sources(options)
    wanted = {"DONE", "FAILURES"}
    tests = [each for each in _programs(sources) if wanted <= {name.upper() for name in _outputs(each)}]
    if not tests:
        raise BadInputError("no PROGRAM has outputs Done : BOOL and Failures, so nothing can be tested")
    library = _engine(options, coverage=options.coverage).build(sources)
    failed = [program.name for program in tests if not _passes(library.instance(program.name), program.name, options)]
    print(f"{len(tests)} tested, {len(failed)} failed")
    if options.coverage and isinstance(library, EmbeddedLibrary):
        _print_missed(library.coverage(), library.branches())
    return 1 if failed else 0


def _passes(instance: Instance, name: str, options: argparse.Namespace) -> bool:
    """Scan until a program is done; whether nothing has failed."""
    trouble = f"not Done after {options.scans} scans"
    for scan in range(options.scans):
        try:
            instance.scan(scan * options.every * MS)
        except EngineError as error:
            trouble = str(error)
            break
        if instance["Done"] is True:
            failures = _shown(instance["Failures"])
            trouble = "" if failures == "0" else f"{failures} failures"
            break
    print(f"{'FAILED' if trouble else 'passed'}  {name}{': ' if trouble else ''}{trouble}")
    return not trouble


def _print_missed(lines: Lines, branches: Branches) -> None:
    """Print what no program has reached, by place, and the sums."""
    missed = [(path, line, 1, "line") for path, table in lines.items() for line, count in table.items() if not count]
    missed += [(path, *outcome) for path, table in branches.items() for outcome, count in table.items() if not count]
    for path, line, column, text in sorted(missed):
        print(f"{path}:{line}:{column}: not reached: {text}")
    for words, tables in (("lines", lines), ("outcomes of decisions", branches)):
        counts = [count for table in tables.values() for count in table.values()]
        print(f"{sum(map(bool, counts))} of {len(counts)} {words} reached")
