"""Simulated drives on a line that any master may use: `driveblocks simulate`.

`scenario` reads what is to happen, `bus` is the line with what it loses, `link` a TCP port or a pseudo-terminal,
`neighbour` looks for real units on a real port, `trace` writes frames down, `stand` puts it all together.
"""
