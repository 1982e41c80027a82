"""What documents say of SN300G5 series drives, typed from them by hand; no map was read for it."""

STATUS = 0x0010
FACES = {"stands": 0x0022, "ramps": 0x0021, "runs": 0x0031, "reverse": 0x0035, "fault": 0x0082, "warning": 0x0062}
"""Bit 0 running, 1 zero speed, 2 reverse, 4 speed agree, 5 ready, 6 minor fault, 7 major fault."""
FREQUENCY = 0x0021
COUNTS_PER_HZ = 100
FAULT = (0x0015, 2)
CODES = (1, 2, 3, 33, 34, 34, 36)
PASSING = (3, 4, 3)
PINS: set[str] = set()
BRIEF = (
    "not known",
    "b1-01 = 2, b1-02 = 2",
    "(H5-04 1 = Emergency stop) the motor stops quickly",
    "no command",
    "42 codes",
    "2500 in 0001H",
)
ALIKE = {
    ("run_forward", "Run forward"),
    ("run_reverse", "Run reverse"),
    ("stop", "External terminal 3 closed"),
    ("stop", "External terminal 4 closed"),
    ("stop", "External terminal 5 closed"),
    ("stop", "External terminal 6 closed"),
    ("stop", "External terminal 7 closed"),
    ("stop", "External terminal 8 closed"),
}
KEYPAD = """
b1-01 | - | 1 | 0=keypad 1=terminals 2=communication 3=reserved | -
b1-02 | - | 1 | 0=keypad 1=terminals 2=communication 3=reserved | -
b1-03 | - | - | - | -
O2-01 | - | - | - | -
b1-04 | - | - | - | -
L5-01 | - | - | - | -
E1-04 | - | - | - | Hz
D2-02 | - | - | - | -
C1-01 | - | - | - | s
C1-02 | - | - | - | s
H5-01 | - | 1F | 0 to 20 | -
H5-02 | - | 3 | 0=1200 1=2400 2=4800 3=9600 | -
H5-03 | - | 1 | 0=no 1=even 2=odd | -
H5-04 | - | 1 | 0=deceleration 1=emergency 2=coast 3=continue | -
H5-05 | - | 1 | 0=disabled 1=enabled | -
"""
"""SN300G5, table of communication parameters, and section (V)."""
