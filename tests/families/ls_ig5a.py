"""What the SV-iG5A (pages 11-2, 11-3 and 11-6) and the SV-ACtionMaster (A, page 81) say, typed by hand."""

STATUS = 0x000E
FACES = {"stands": 0x0001, "ramps": 0x0002, "runs": 0x0042, "reverse": 0x0044, "fault": 0x0009, "warning": 0x0001}
"""A: bit 0 stop, 1 forward, 2 reverse, 3 fault (trip), 6 speed reached."""
FREQUENCY = 0x000A
COUNTS_PER_HZ = 100
FAULT = (0x000F, 0)
"""A: it shows bits, and none for trip 18."""
CODES = (1, 2, 3, 3, 20, 20, 6)
"""Page 11-3: 14H is write disable, read only, or not during running."""
PASSING = (3, 4, 3)
CONTROL = "sister"
PINS = {"ManualChecked"}
BRIEF = (
    "on S+, S+; - (D0, A of the standard) on S-, S-",
    "The map names no setting",
    "count on a motor that runs on",
    "a rising FaultReset",
    "8 codes",
    "2500 in 0005H",
)
ALIKE = {
    ("run_forward", "Forward"),
    ("run_reverse", "Reverse"),
    ("stop", "Stop"),
    ("quick_stop", "Emergency stop"),
    ("fault_reset", "Fault reset"),
}
PLUG = "S+ positive, S- negative"
"""Page 11-2: use S+, S- terminals on control terminal block."""
WIRED = True
KEYPAD = ""
ROWS = """
0000 | - | r | - | -
0001 | - | r | - | -
0002 | - | r | - | -
0003 | - | r | - | -
0004 | - | rw | - | -
0005 | - | rw | Hz | 0.01
0006 | - | rw | - | -
0007 | - | rw | s | 0.1
0008 | - | rw | s | 0.1
0009 | - | r | A | 0.1
000A | - | r | Hz | 0.01
000B | - | r | V | 1
000C | - | r | - | -
000E | - | r | - | -
000F | - | r | - | -
"""
"""Page 11-6 for 0000 and 0001; A for the others."""
COMMANDS = {
    "run_forward": "0006=0002",
    "run_reverse": "0006=0004",
    "stop": "0006=0001",
    "quick_stop": "0006=0010",
    "fault_reset": "0006=0008",
}
"""A, 0006: bit 0 stop, 1 forward, 2 reverse, 3 fault reset, 4 emergency stop."""
REFERENCE = "0005 frequency"
STANDSTILL = "000E&0007=0001 000A=0"
SHOWS = {"running": "000E.1=1 000E.2=1", "reverse": "000E.2=1", "at_speed": "000E.6=1", "fault": "000E.3=1"}
MEASURES = {
    "output_frequency": "000A",
    "output_current": "0009",
    "output_voltage": "000B",
    "dc_bus_voltage": "000C",
}
RATES = [1200, 2400, 4800, 9600, 19200]
UNIT = (1, 31, None)
"""Pages 11-1, at most 31 drives, and 11-6."""
FUNCTIONS = [3, 4, 6, 16]
REFUSALS = [1, 2, 3, 6, 20]
FAULTS = {
    1: "Overcurrent", 2: "Overvoltage", 3: "External trip", 4: "Emergency stop", 5: "Low voltage", 6: "Fuse open",
    7: "Ground fault", 8: "Overheat",
}  # fmt: skip
"""A, 000F: OC, OV, EXT, BX, LV, Fuse Open, GF, OH, bits 0 to 7."""
WATCHDOG = None
