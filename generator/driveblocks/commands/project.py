"""`driveblocks project`: a plant file -> its program, its tags, its library, in one folder."""

import sys
from pathlib import Path

import click

from driveblocks.commands import FILE, refuse


@click.command()
@click.argument("plant", type=FILE, metavar="PLANT.yaml")
@click.option(
    "--to", "target", metavar="PLATFORM", required=True, help="For codesys, twincat, siemens, openplc, beremiz or text."
)
@click.option("-o", "--output", type=FILE, metavar="FOLDER", required=True, help="Folder to write to.")
def run(plant: Path, target: str, output: Path) -> None:
    """Write the program of a plant with all that it needs.

    Run it again whenever the plant file has changed. What you have written between the marks `your own` stays. A file
    that you have changed elsewhere is left as it is, the difference is shown, and the exit status is 1; all others are
    written, or none.

    Example: driveblocks project plant.yaml --to codesys -o my_plant
    """
    from driveblocks.maps.problem import Refused
    from driveblocks.output import transaction
    from driveblocks.plant import folder, forms, project, tags
    from driveblocks.plant.check import good
    from driveblocks.platforms.problem import ExportError
    from driveblocks.render.text import languages

    if target not in forms.TARGETS:
        raise click.BadParameter(f"`{target}` is none; write {', '.join(forms.TARGETS)}", param_hint="--to")
    try:
        read = good(plant)
        texts = languages(forms.codes(read), "utf-8")
        made = forms.files(read, target, texts) | {"tags.csv": tags.table(read, *texts[1:])} | folder.files(read)
        with transaction.locked(output):
            if transaction.recover(output):
                click.echo(f"{output}: took back a run that was interrupted", err=True)
            plan = project.plan(output, plant.name, target, made)
            project.write(output, plan)
    except (ExportError, Refused) as error:
        refuse(str(error))
    except OSError as error:
        refuse(f"{error.filename or output}: {error.strerror}")
    changed = len(plan.states.keys() - {".driveblocks.json"})
    click.echo(f"{output}: {len(plan.texts) - 1} files for {read.plant}, {changed} changed")
    for difference in plan.changes.values():
        click.echo(difference)
    for name, why in plan.left.items():
        click.echo(f"{output / name}: {why}")
    sys.exit(1 if plan.left else 0)
