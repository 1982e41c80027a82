"""A soft PLC: a program in ST with the library, scanned in real time, its serial port a real or a simulated line.

The way of a program: `source` compiles it with the blocks that it names, `wiring` finds its port, lines and drives in
the typed tree, `controller` scans it, `mailbox` carries its bytes to a `port`, past a `guard` where the port is real. A
`watchdog` sees whether a scan ends; at the end of a run a `gate` takes the port from the program, `stopper` stops every
drive, and `departure` bounds what is left to do. What is kept of a run, a `recorder` writes beside the scans.
"""
