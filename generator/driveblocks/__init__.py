"""DriveBlocks: IEC 61131-3 function blocks for variable-frequency drives, made from one YAML map per family."""

__version__ = "0.1.0"
