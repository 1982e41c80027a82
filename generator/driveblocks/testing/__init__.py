"""Tests made from maps: Structured Text programs with checks, and the runner that scans them on this computer.

What they expect comes from the map's vectors and from the reference model, never from what renders the blocks.
"""
