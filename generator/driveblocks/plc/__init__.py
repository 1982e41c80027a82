"""A soft PLC: a program in ST with the library, scanned in real time, its serial port a real or a simulated line.

The way of a program: `source` compiles it with the blocks that it names, `wiring` finds its port, lines and drives in
the typed tree, `controller` scans it, `mailbox` carries its bytes to a `port`, past a `guard` where the port is real,
and `ending` stops every drive when the run ends, however it ends.
"""
