"""What pages of the GS4's manual (1st Ed, Rev A, 2017) say, typed from them by hand; no map was read for it."""

STATUS = 0x2101
FACES = {"stands": 0x0400, "ramps": 0x0401, "runs": 0x0401, "reverse": 0x0419, "fault": 0x0400, "warning": 0x0400}
"""Bits 0 and 1: stop is 0, a run 1 to 3, of which the simulator shows the least; 3 and 4: 3 reverse; A by the bus."""
FREQUENCY = 0x2103
COUNTS_PER_HZ = 100
FAULT = (0x2100, 18)
CODES = (1, 2, 3, 3, 2, None, None)
"""CP2000, page 12.1-09-12: 1 function, 2 address, 3 data, 4 fails, 10 time."""
PASSING = (3, 4, 3)
PINS: set[str] = set()
BRIEF = (
    "not known",
    "P4.00 = 1, P9.86 = 0, P9.03 = 1, P9.04 = 1",
    "(P9.04 0 = Disabled) the motor runs on",
    "a rising FaultReset",
    "49 codes",
    "2500 in 2001H",
)
ALIKE = {("fault_reset", "Reset"), ("run_forward", "Forward"), ("run_reverse", "Reverse"), ("stop", "Stop")}
HELD = {"read_ascii": {0x2102: 0x1770}}
KEYPAD = """
P3.00 | - | - | - | -
P4.00 | - | 0 | 0=keypad 1=rs485 2=analog 3=up 4=card | -
P9.00 | - | 1 | 1 to 254 | -
P9.01 | - | 1 | 0=4800 1=9600 2=19200 3=38400 4=57600 5=115200 | -
P9.02 | - | 12 | 1=7n2 2=7e1 3=7o1 4 5 6 7 8 9 10 11 12=8n1 13=8n2 14=8e1 15=8o1 16=8e2 17=8o2 | -
P9.03 | - | 3 | 0=continue 1=ramp 2=coast 3=continue | -
P9.04 | - | 0 | 0=disabled 1=enabled | -
P9.05 | - | 0.5 s | - | 0.1 s
P9.35 | - | 2.0 ms | - | 0.1 ms
P9.86 | - | 0 | 0=modbus 1=bacnet | -
P3.56 | - | 0 | 0=coast 1=1 2=2 3=3 4=4 5=system 6=automatic | -
P1.01 | - | 10.00 s | - | -
P1.02 | - | 10.00 s | - | -
"""
ROWS = """
2000 | - | w | - | -
2001 | - | w | Hz | 0.01
2002 | - | w | - | -
2100 | - | r | - | -
2101 | - | r | - | -
2102 | - | r | Hz | -
2103 | - | r | Hz | -
2104 | - | r | A | 0.1
2105 | - | r | V | 0.1
2106 | - | r | V | 0.1
2107 | - | r | - | -
2108 | - | r | - | -
2109 | - | r | - | -
210A | - | r | - | -
210B | - | r | % | -
210C | - | r | r/min | -
2118 | - | r | - | -
0101 | P1.01 | rw | s | -
0102 | P1.02 | rw | s | -
0300 | P3.00 | rw | - | -
0338 | P3.56 | rw | - | -
0400 | P4.00 | rw | - | -
0900 | P9.00 | rw | - | -
0901 | P9.01 | rw | - | -
0902 | P9.02 | rw | - | -
0903 | P9.03 | rw | - | -
0904 | P9.04 | rw | - | -
0905 | P9.05 | rw | s | -
0922 | P9.34 | r | - | -
0923 | P9.35 | rw | ms | -
0956 | P9.86 | rw | - | -
"""
"""Pages 4-9, 4-10, 4-24, 4-25, 4-40, 4-190, 5-6 and 5-7, and D-12 and D-14, which print most of them again."""
COMMANDS = {
    "run_forward": "2000=0012",
    "run_reverse": "2000=0022",
    "stop": "2000=0001",
    "fault_reset": "2002=0000 2002=0002",
}
"""Pages D-12 and B-14."""
REFERENCE = "2001 frequency"
STANDSTILL = "2101.1-0=0 2103=0"
SHOWS = {
    "running": "2101.1-0=3 2101.1-0=2 2101.1-0=1",
    "reverse": "2101.4-3=3",
    "warning": "2108!=0",
    "fault": "2100!=0",
}
MEASURES = {"output_frequency": "2103", "output_current": "2104", "dc_bus_voltage": "2105", "output_voltage": "2106"}
NEEDED = {"P4.00": 1, "P9.03": 1, "P9.04": 1, "P9.86": 0}
RATES = {0: 4800, 1: 9600, 2: 19200, 3: 38400, 4: 57600, 5: 115200}
FORMS = {
    1: "7N2", 2: "7E1", 3: "7O1", 4: "7E2", 5: "7O2", 6: "8N1", 7: "8N2", 8: "8E1", 9: "8O1", 10: "8E2", 11: "8O2",
    12: "8N1", 13: "8N2", 14: "8E1", 15: "8O1", 16: "8E2", 17: "8O2",
}  # fmt: skip
FUNCTIONS = [3, 6, 16]
REFUSALS = [1, 2, 3, 4, 10]
FAULTS = [
    1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 26, 27, 28, 30, 31,
    33, 34, 35, 36, 37, 38, 39, 40, 41, 48, 49, 50, 51, 52, 53, 54, 55, 56, 57, 58,
]  # fmt: skip
"""Page 5-6: 25, 29, 32 and 42 to 47 are reserved; the copy that was read ends at 58."""
LIMITS = {"read_words": 12}
"""Page 5-14: the maximum value of N is 12."""
UNIT = (1, 254, 1)
WATCHDOG = ("P9.05", 100, None)
"""Pages 4-182 and 5-2: 0.1 to 100.0 seconds."""
