"""DriveBlocks: IEC 61131-3 function blocks for variable-frequency drives, generated from one YAML map per family."""

from importlib.metadata import PackageNotFoundError, version

try:
    __version__ = version("driveblocks")
except PackageNotFoundError:
    __version__ = "0+unknown"
