"""`driveblocks test`: run the test programs that the maps make."""

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from driveblocks.commands import Maps, refuse

if TYPE_CHECKING:
    from driveblocks.host.discovery import Candidate
    from driveblocks.maps.collection import Source
    from driveblocks.testing.coverage import Coverage
    from driveblocks.testing.outcome import Result, Run

SHOWN, PER_PROGRAM = 20, 3
"""Failures that are printed, in all and of one program; all are in the XML, if one is asked for."""

EngineName = Annotated[str, typer.Option("--engine", metavar="embedded|matiec|all", help="Where to run the programs.")]
Junit = Annotated[Path | None, typer.Option("--junit", metavar="FILE", help="Write all results there as JUnit XML.")]
Seconds = Annotated[float, typer.Option("--time-limit", metavar="SECONDS", min=0.1, help="Time limit of one program.")]
Measure = Annotated[bool, typer.Option("--coverage", help="Say which lines and branches of the blocks have run.")]
Least = Annotated[
    float | None,
    typer.Option(
        "--require-coverage",
        metavar="PERCENT",
        min=0.0,
        max=100.0,
        help="Fail below so many percent of the lines or of the branches that can be reached; measures, too.",
    ),
]


def run(  # noqa: PLR0913, PLR0917 - one parameter per option of the command line
    maps: Maps = None,
    engine: EngineName = "embedded",
    junit: Junit = None,
    time_limit: Seconds = 120.0,
    coverage: Measure = False,
    require_coverage: Least = None,
) -> None:
    """Test the blocks of the drives on this computer.

    The blocks are built in memory. Test programs made from the maps check them against the manual's example frames and
    against a reference model. The exit status is 0 if all checks pass, 1 if any fails, and 2 if a map is bad or an
    engine cannot be used. With --coverage it is said what no program has reached: lines, and outcomes of decisions (IF,
    CASE, loops). That is a failure only below what --require-coverage asks for; what no input can reach is explained
    and left out of the percentage.

    Example: driveblocks test my_drive.yaml --engine all --require-coverage 100
    """
    from driveblocks.building.build import units
    from driveblocks.render.text import languages
    from driveblocks.testing import junit as xml
    from driveblocks.testing import runner
    from driveblocks.testing.coverage import Coverage, counting, result
    from driveblocks.testing.outcome import Run

    candidates, chosen = _engines(engine)
    sources = _read(maps)
    made = units(sources, languages(["en", "zh"], "utf-8"))
    engines = [each.engine for each in chosen if each.engine is not None]
    measured = [Coverage(each.name) for each in engines] if coverage or require_coverage is not None else []
    programs = runner.run(made, [counting(each) for each in engines] if measured else engines, time_limit, measured)
    done = Run([*programs.results, *(result(each, require_coverage or 0.0) for each in measured)], programs.seconds)
    try:
        if junit is not None:
            xml.write(done, junit)
    except OSError as error:
        refuse(f"{junit}: cannot be written: {error.strerror}")
    _print(programs, candidates, chosen)
    _unproved(sources)
    _cover(measured)
    _say(done, len(sources), junit)
    raise typer.Exit(0 if done.passed else 1)


def _read(maps: list[str] | None) -> "list[Source]":
    """Load the maps; all mistakes of all of them are told before it ends with status 2."""
    from driveblocks.maps import catalog, collection
    from driveblocks.maps.problem import MapError

    try:
        return collection.read(catalog.chosen(maps))
    except (MapError, catalog.UnknownDrive) as error:
        refuse(str(error))


def _engines(name: str) -> "tuple[list[Candidate], list[Candidate]]":
    """All engines that were looked for, and those that are asked for and work. Ends with status 2 without any."""
    from driveblocks.host.discovery import EMBEDDED, MATIEC_NAMES, survey

    groups = {"embedded": (EMBEDDED,), "matiec": MATIEC_NAMES, "all": (EMBEDDED, *MATIEC_NAMES)}
    groups |= {each: (each,) for each in MATIEC_NAMES}
    if name not in groups:
        refuse(f"there is no engine `{name}`; write one of {', '.join(groups)}")
    found = survey().candidates()
    asked = [each for each in found if each.name in groups[name]]
    if not any(each.engine for each in asked):
        refuse("\n".join(f"engine {each.name} cannot be used: {each.note}" for each in asked))
    return found, [each for each in asked if each.engine is not None]


def _print(run: "Run", candidates: "list[Candidate]", chosen: "list[Candidate]") -> None:
    from driveblocks import console
    from driveblocks.tables.layout import table

    for each in candidates:
        state = "runs" if each in chosen else "does not run" if each.engine is None else "was not asked for"
        typer.echo(f"engine {each.name}: {state}, {each.note}")
    names = [each.name for each in chosen]
    heads = [name.removeprefix("matiec-") for name in names]
    made = table("drive", "program", "checks", *heads, numbers=("checks", *heads))
    for unit, program, results in _rows(run):
        most = max(len(result.outcomes) for result in results)
        made.add_row(unit, program, str(most), *(_cell(name, results) for name in names))
    console.write(made)


def _unproved(sources: "list[Source]") -> None:
    """Name the drives whose tests no example frame of a manual backs."""
    from driveblocks.maps.view import UNPROVED

    for source in sources:
        if not source.drive.frames:
            typer.echo(f"{source.drive.prefix}: {UNPROVED}")


def _cover(measured: "list[Coverage]") -> None:
    """The files of which something was missed, what that was, and the figures of all."""
    for each in measured:
        for path in dict.fromkeys(miss.path for miss in each.misses):
            typer.echo(f"{path} on {each.engine}: {each.count(path)}")
            for miss in each.misses:
                if miss.path == path:
                    typer.echo(f"  {miss}")
        typer.echo(f"coverage on {each.engine}: {each.count()}")
        if each.uncounted:
            left = f"{len(each.uncounted)} files of line and drive blocks are not counted"
            typer.echo(f"{left}: they run in time, against drives, which the tests of DriveBlocks itself simulate")


def _rows(run: "Run") -> "Iterator[tuple[str, str, list[Result]]]":
    """Drive, program and its result on each engine, in the order of the first engine."""
    rows: dict[tuple[str, str], list[Result]] = {}
    for result in run.results:
        rows.setdefault((result.unit, result.program), []).append(result)
    for (unit, program), results in rows.items():
        yield unit, program, results


def _cell(name: str, results: "list[Result]") -> str:
    result = next((each for each in results if each.engine == name), None)
    if result is None:
        return "-"
    bad = len(result.bad)
    return f"{bad} failed" if bad else f"{result.seconds * 1000:.1f} ms"


def _say(run: "Run", drives: int, junit: Path | None) -> None:
    """The failures, then the sum of it all."""
    shown = 0
    for result in run.results:
        bad = result.bad
        for outcome in bad[: min(PER_PROGRAM, SHOWN - shown)]:
            place = f"{outcome.place}: " if outcome.path else ""
            typer.echo(f"{place}{result.unit}.{result.program} on {result.engine}")
            typer.echo(f"  {outcome.words}\n  {outcome.message}")
            shown += 1
    failed = sum(len(result.bad) for result in run.results)
    if failed > shown:
        typer.echo(f"and {failed - shown} more, " + (f"see {junit}" if junit else "which --junit FILE writes down"))
    engines = ", ".join(dict.fromkeys(result.engine for result in run.results))
    checks = f"{run.count()} checks of {drives} drive{'s' * (drives != 1)} on {engines}"
    verdict = "all passed" if run.passed else f"{failed} failed"
    written = f"; {junit}" if junit else ""
    typer.echo(f"{checks}: {verdict} in {run.seconds:.1f} s{written}")
