"""What the V1000's manuals say (page 367; P: 267 and 273 of its Programming Manual), typed by hand; no map was read.

All else is that of the A1000, which its map has as base.
"""

COUNTS_PER_HZ = 100
CONTROL = "derived"
PINS = {"ManualChecked"}
BRIEF = (
    "not known",
    "b1-01 = 2, b1-02 = 2",
    "what H5-04 says",
    "FaultReset",
    "22 codes",
    "2500 in 0002H",
)
KEYPAD = """
b1-01 | - | - | - | -
b1-02 | - | - | - | -
b1-03 | - | - | - | -
o1-03 | - | - | 0=0.01 | -
E1-04 | - | - | - | Hz
d2-02 | - | - | - | -
H5-01 | - | 1F | - | -
H5-02 | - | 3 | 0=1200 1=2400 2=4800 3=9600 | -
H5-03 | - | 0 | 0=none 1=even 2=odd | -
H5-04 | - | - | 0=ramp 3=continue | -
H5-05 | - | - | 0=disabled 1=enabled | -
H5-06 | - | - | - | -
H5-11 | - | 0 | - | -
H5-12 | - | - | 0=forward 1=direction | -
"""
ROWS = """
0001 | - | rw | - | -
0002 | - | rw | Hz | 0.01
0006 | - | rw | % | 0.01 signed
0007 | - | rw | - | -
000A | - | rw | Hz | 1
"""
"""Page 367; 0008H is reserved."""
COMMANDS = {
    "run_forward": "0001=0001",
    "run_reverse": "0001=0002",
    "stop": "0001=0000",
    "fault_reset": "0001=0000 0001=0008",
}
"""Page 367, H5-12 = 0: bit 0 forward run, 1 reverse run, 3 fault reset; 0 of both is stop."""
REFERENCE = "0002 frequency"
UNIT = (1, 32, 31)
"""v1000.json."""
PRINTED_WRONG = {"write_request": "CHECKSUM"}
