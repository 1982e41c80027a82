"""One module per command of `driveblocks`; each holds the typer function and the tables that it prints."""
