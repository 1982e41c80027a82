"""The `driveblocks` command: every sub-command is the `run` of one module of `driveblocks.commands`."""

import gc
import importlib
import pkgutil
import sys
from typing import Any

import click

from driveblocks import __version__, commands, console
from driveblocks.maps.problem import Refused
from structured_text.files import BadFile


class _Commands(click.Group):
    def invoke(self, ctx: click.Context) -> Any:
        """Run a command; whichever refuses its input, what is wrong is said, and the status is 2."""
        try:
            return super().invoke(ctx)
        except (Refused, BadFile) as error:
            commands.refuse(str(error))


# `color` keeps click from taking escape codes out of what does not go to a terminal: the streams write them out.
@click.group(
    cls=_Commands, context_settings={"help_option_names": ["-h", "--help"], "show_default": True, "color": True}
)
@click.version_option(__version__, message="driveblocks %(version)s", help="Print the version and exit.")
def app() -> None:
    """Structured Text function blocks for variable-frequency drives, from one YAML map per family."""


for _module in pkgutil.iter_modules(commands.__path__):
    # A command's module imports little; what it needs to run it imports when it runs.
    _command = importlib.import_module(f"{commands.__name__}.{_module.name}").run
    app.add_command(_command, _module.name.replace("_", "-"))


def main() -> None:
    """Run the command line; the exit status is 0 for good, 1 for a failed test, 2 for bad input, 130 for Ctrl-C."""
    gc.set_threshold(20_000)  # maps, trees and texts live to the end: looking for rings among them takes a tenth
    console.use_safe_utf8()
    try:
        status = app.main(standalone_mode=False)
        gc.freeze()  # nor among them at the end
        sys.exit(status)
    except click.Abort:
        sys.exit(130)
    except click.ClickException as error:
        error.show()
        sys.exit(error.exit_code)
    except OSError as error:  # a command reports on its files itself; what is left is a full disk under its output
        click.echo(f"{error.filename or 'standard output'}: {error.strerror or error}", err=True)
        console.give_up_output()
        sys.exit(2)


if __name__ == "__main__":
    main()
