"""Simulated drives on a line that any master may use: `driveblocks simulate`.

`link` is a TCP port or a pseudo-terminal, `neighbour` looks for real units on a real port, `setup` puts it all
together; the line itself and what happens on it are `desk/bus.py` and `desk/scenario.py`.
"""
