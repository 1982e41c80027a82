"""What manuals of the Goodrive20 (pages 105 to 117), Goodrive20-EU (E), Goodrive10 (T) and Goodrive200L (L) say.

Typed from them by hand; no map was read for it. What is not here is as in the Goodrive200A.
"""

from tests.families.invt_gd200a import KEYPAD, PLUG, TERMINATION

__all__ = ["KEYPAD", "PLUG", "TERMINATION"]
CONTROL = "transcribed"
BRIEF = (
    "485+, A (+)",
    "P00.01 = 2",
    "(P14.04 0.0 s) the motor runs on",
    "a rising FaultReset",
    "31 codes",
    "2500 in 2001H",
)
ROWS = """
2000 | - | rw | - | -
2001 | - | rw | Hz | 0.01
2002 | - | rw | % | 0.1
2003 | - | rw | % | 0.1
2100 | - | r | - | -
2101 | - | r | - | -
2102 | - | r | - | -
3000 | - | r | Hz | 0.01
3001 | - | r | Hz | 0.01
3002 | - | r | V | 1
3003 | - | r | V | 1
3004 | - | r | A | 0.1
3005 | - | r | r/min | 1
3006 | - | r | % | 0.1 signed
3008 | - | r | % | 0.1 signed
3009 | - | r | % | 0.1 signed
300C | - | r | V | 0.01
300D | - | r | V | 0.01
3010 | - | r | kHz | 0.01
0003 | P00.03 | rw | Hz | 0.01
"""
"""Page 117: 0 to Fmax in 0.01 Hz, 1000 is 100.0 %. L153: 0.00 Hz to P00.03, 1200 V, 5000.0 A. E136: 100 Hz is 2710H."""
COMMANDS = {
    "run_forward": "2000=0001",
    "run_reverse": "2000=0002",
    "jog_forward": "2000=0003",
    "jog_reverse": "2000=0004",
    "stop": "2000=0005",
    "coast_stop": "2000=0006",
    "fault_reset": "2000=0007",
    "jog_stop": "2000=0008",
}
"""Page 117."""
REFERENCE = "2001 frequency"
STANDSTILL = "2100=3 3000=0"
"""Page 115: the data content is 0003H, the inverter stops."""
SHOWS = {"running": "2100=1 2100=2", "reverse": "2100=2", "warning": "2101.4=1", "fault": "2100=4"}
"""T87; L153: bit 4 overload pre-alarm."""
FUNCTIONS = [3, 6, 8, 16]
LIMITS = {"read_words": 16, "write_words": 16}
REFUSALS = [1, 2, 3, 4, 5, 6, 7, 8, 9]
"""E133, 1 to 8; page 130 of the UL edition has 9."""
HELD = {"read_rtu_request": {4: 5000}, "read_ascii_request": {4: 5000}}
PRINTED_WRONG = {"write_words_rtu_request": "CHECKSUM", "write_words_rtu_reply": "CHECKSUM"}
