"""A toolchain for IEC 61131-3 Structured Text: front end, linter, engines that run it, and what a run has covered.

It knows no drive and imports nothing of `driveblocks`. `python -m structured_text` works on plain files: see README.md.
"""
