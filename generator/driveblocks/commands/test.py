"""`driveblocks test`: run the test programs that the maps make."""

import os
import sys
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from textwrap import indent
from typing import TYPE_CHECKING

import click

from driveblocks import console
from driveblocks.commands import FILE, JUNIT, MAPS, refuse, sources, write
from structured_text import files

if TYPE_CHECKING:
    from driveblocks.bench.coverage import Coverage
    from driveblocks.bench.outcome import Result, Run
    from driveblocks.maps.collection import Source
    from driveblocks.render.text import Language
    from structured_text.engines.discovery import Candidate

SHOWN, PER_PROGRAM = 20, 3
"""Failures that are printed, in all and of one program; all are in the XML, if one is asked for."""


@click.command()
@MAPS
@click.option("--engine", metavar="embedded|matiec|all", default="embedded", help="Where to run the programs.")
@JUNIT
@click.option(
    "--time-limit", type=click.FloatRange(min=0.1), metavar="SECONDS", default=120.0, help="Time limit of one program."
)
@click.option(
    "--jobs",
    type=click.IntRange(1, 16),
    metavar="N",
    help="Processes of the embedded engine, else one per processor, 4 at most.",
)
@click.option("--picture", type=FILE, metavar="FOLDER", help="Draw each scene that failed there, as a timing diagram.")
@click.option("--keep", type=FILE, metavar="FOLDER", help="Write the test programs there, for a controller to run.")
@click.option("--coverage", is_flag=True, help="List the lines and branches of the blocks that no program has run.")
@click.option(
    "--require-coverage",
    type=click.FloatRange(0.0, 100.0),
    metavar="PERCENT",
    help="Fail if fewer of the reachable lines or branches have run; implies --coverage.",
)
def run(  # noqa: PLR0913, PLR0917 - one parameter per option of the command line
    maps: tuple[str, ...],
    engine: str,
    junit: Path | None,
    time_limit: float,
    jobs: int | None,
    picture: Path | None,
    keep: Path | None,
    coverage: bool,
    require_coverage: float | None,
) -> None:
    """Test the blocks of the drives on this computer.

    The blocks are built in memory. Test programs made from the maps check them against the manual's example frames and
    against a reference model, and play scenes: a drive block on its line, with a drive that the program simulates. Of a
    scene that fails, pins and frames before the failure are printed; --picture draws them. --keep writes the programs
    into a new folder. The exit status is 0 if all checks pass, 1 if any fails, and 2 if a map is bad or an engine
    cannot be used.

    --coverage counts lines, and outcomes of decisions (IF, CASE, loops). What no input can reach is explained, and not
    in the percentage. Too little is a failure only with --require-coverage.

    Of a plant, the very program that `driveblocks project` writes runs at simulated drives of its addresses, in virtual
    time: starts, stops, trips, cut cables, lost supplies, a restart of the PLC, a panel; each scene is a case.

    Examples: driveblocks test my_drive.yaml --engine all --require-coverage 85,
    driveblocks test plant.yaml --junit plant.xml
    """
    from driveblocks.plant.word import is_plant

    if any(is_plant(Path(each)) for each in maps):
        if len(maps) > 1 or engine != "embedded" or picture or keep or coverage or require_coverage is not None:
            refuse("a plant is tested alone, on the embedded engine; of the options, --junit and --jobs are for it")
        sys.exit(_plant(Path(maps[0]), junit, jobs or min(4, os.cpu_count() or 1)))
    from driveblocks.bench import junit as xml
    from driveblocks.bench import runner
    from driveblocks.bench.coverage import Coverage, counting, result
    from driveblocks.bench.outcome import Run
    from driveblocks.output.units import units
    from driveblocks.render.text import languages

    candidates, chosen = _engines(engine)
    read = sources(maps)
    making = click.get_current_context().obj or units  # other programs, as a test may want them
    both = languages(["en", "zh"], "utf-8")
    if keep is not None:
        _keep(keep, read, both)
    engines = [each.engine for each in chosen if each.engine is not None]
    measured = [Coverage(each.name) for each in engines] if coverage or require_coverage is not None else []
    some = [counting(each) for each in engines] if measured else engines
    with closing(console.Bar(console.terminal("stderr"), ticks=False)) as bar:  # it forks
        made = making(read, both, bar.show)
        programs = runner.run(made, some, time_limit, measured, jobs or min(4, os.cpu_count() or 1), bar.show)
    done = Run([*programs.results, *(result(each, require_coverage or 0.0) for each in measured)], programs.seconds)
    if junit is not None:
        write(junit, xml.text(done))
    if picture is not None:
        _draw(done, picture)
    _print(programs, candidates, chosen)
    _unproved(read)
    _premises(read)
    _cover(measured)
    _say(done, len(read), junit)
    sys.exit(0 if done.passed else 1)


def _plant(path: Path, junit: Path | None, jobs: int) -> int:
    """Test a plant; the exit status."""
    from driveblocks.bench import junit as xml
    from driveblocks.plant import program, testing
    from driveblocks.plant.check import judged

    found = judged(path)
    with closing(console.Bar(console.terminal("stderr"), ticks=False)) as bar:  # it forks
        bar.show(0, 1, "compiling the program")
        trial = testing.Trial(found.plant, program.text(found.plant), found.figures)
        done = testing.run(trial, jobs, bar.show)
    if junit is not None:
        write(junit, xml.text(done))
    (result,) = done.results
    for each in result.bad[:SHOWN]:
        said = f"expected: {each.expected}\nactual: {each.actual}" if each.expected else each.message
        click.echo(f"{each.words}: {each.status}\n{indent(said, '  ')}")
    verdict = "all passed" if done.passed else f"{len(result.bad)} failed"
    written = f"; {junit}" if junit else ""
    click.echo(f"{len(result.outcomes)} scenes of {found.plant.plant}: {verdict} in {done.seconds:.1f} s{written}")
    return 0 if done.passed else 1


def _keep(folder: Path, read: "list[Source]", both: "list[Language]") -> None:
    """Write the programs into a new folder. Ends with status 2 where something is there, or it cannot be written."""
    from driveblocks.bench.suite import programs

    try:
        folder.mkdir(parents=True, exist_ok=True)
        if any(folder.iterdir()):
            refuse(f"{folder}: is not empty; name a new folder")
        for name, text in programs(read, both).items():
            path = folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            files.put(path, text, new=True, sync=False)
    except OSError as error:
        refuse(f"{error.filename or folder}: cannot be written: {error.strerror}")


def _engines(name: str) -> "tuple[list[Candidate], list[Candidate]]":
    """All engines that were looked for, and those that are asked for and work. Ends with status 2 without any."""
    from structured_text.engines.discovery import EMBEDDED, MATIEC_NAMES, survey

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
    from driveblocks.show.layout import table

    for each in candidates:
        state = "runs" if each in chosen else "does not run" if each.engine is None else "was not asked for"
        click.echo(f"engine {each.name}: {state}, {each.note}")
    names = [each.name for each in chosen]
    heads = [name.removeprefix("matiec-") for name in names]
    made = table("drive", "tested", *heads, wide=("tested",), numbers=heads)
    for unit, group, results in _rows(run):
        made.add_row(unit, f"{group}: {_amount(results)}", *(_cell(name, results) for name in names))
    console.write(made)


def _amount(results: "list[Result]") -> str:
    """`41 scenes, 6,204 checks`, on one engine."""
    own = [result for result in results if result.engine == results[0].engine]
    scenes = sum(len(result.scenes) for result in own)
    checks = f"{sum(len(result.outcomes) for result in own):,} checks"
    return f"{scenes} scenes, {checks}" if scenes else checks


def _unproved(sources: "list[Source]") -> None:
    """Name the drives whose tests no example frame of a manual backs."""
    from driveblocks.maps.view import UNPROVED

    for source in sources:
        if not source.drive.frames:
            click.echo(f"{source.drive.prefix}: {UNPROVED}")


def _premises(sources: "list[Source]") -> None:
    """Name what scenes suppose of a drive and a map says otherwise: they fail for that reason."""
    from driveblocks.bench.scenes.drive import premises

    for source in sources:
        for told in premises(source.drive):
            click.echo(
                f"{source.drive.prefix}: scenes do not hold: {told}; correct the conditions of `status` or `states`"
            )


def _draw(run: "Run", folder: Path) -> None:
    """A picture per program and engine whose scene failed. Ends with status 2 where one cannot be written."""
    from driveblocks.bench import record
    from driveblocks.desk.words import spare

    results = {folder / f"{result.program}-{result.engine}.svg": result for result in run.results if result.record}
    for path, result in results.items():
        try:
            spare(path, record.PICTURE, "no `driveblocks test`")
            folder.mkdir(parents=True, exist_ok=True)
        except FileExistsError as error:
            refuse(f"{error.filename}: {error.strerror}")
        except OSError as error:
            refuse(f"{error.filename}: cannot be written: {error.strerror}")
        failed = next(outcome for outcome in result.bad if outcome.scene)
        drawn = record.picture(f"{result.program} on {result.engine}: {failed.words}", result.record)
        write(path, drawn)


def _cover(measured: "list[Coverage]") -> None:
    """The files of which something was missed, what that was, and the figures of all."""
    for each in measured:
        for path in dict.fromkeys(miss.path for miss in each.misses):
            click.echo(f"{path} on {each.engine}: {each.count(path)}")
            for miss in each.misses:
                if miss.path == path:
                    click.echo(f"  {miss}")
        click.echo(f"coverage on {each.engine}: {each.count()}")
        for path in sorted(each.twins):
            click.echo(f"{path} has the statements of the block for 8 drives, as which it is counted")


def _rows(run: "Run") -> "Iterator[tuple[str, str, list[Result]]]":
    """Drive, what is tested, and its results on all engines, in the order of the first engine."""
    rows: dict[tuple[str, str], list[Result]] = {}
    for result in run.results:
        rows.setdefault((result.unit, result.group), []).append(result)
    for (unit, group), results in rows.items():
        yield unit, group, results


def _cell(name: str, results: "list[Result]") -> str:
    own = [each for each in results if each.engine == name]
    if not own:
        return "-"
    bad = sum(len(each.bad) for each in own)
    return f"{bad} failed" if bad else f"{sum(each.seconds for each in own) * 1000:.1f} ms"


def _say(run: "Run", drives: int, junit: Path | None) -> None:
    """The failures, each first scene that failed with its pins and frames, then the sum of it all."""
    from driveblocks.bench import record

    shown = 0
    for result in run.results:
        bad = result.bad
        for outcome in bad[: min(PER_PROGRAM, SHOWN - shown)]:
            place = f"{outcome.place}: " if outcome.path else ""
            click.echo(f"{place}{result.unit}.{result.program} on {result.engine}")
            click.echo(f"  {outcome.words}\n  {outcome.message}")
            shown += 1
        if bad and result.record and shown <= SHOWN:
            click.echo(indent(record.table(result.record), "  "))
    failed = sum(len(result.bad) for result in run.results)
    if failed > shown:
        click.echo(f"and {failed - shown} more, " + (f"see {junit}" if junit else "which --junit FILE writes down"))
    engines = ", ".join(dict.fromkeys(result.engine for result in run.results))
    checks = f"{run.count()} checks of {drives} drive{'s' * (drives != 1)} on {engines}"
    verdict = "all passed" if run.passed else f"{failed} failed"
    written = f"; {junit}" if junit else ""
    click.echo(f"{checks}: {verdict} in {run.seconds:.1f} s{written}")
