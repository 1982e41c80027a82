"""What documents say of CHF series inverters, typed from them by hand; no map was read for it."""

STATUS = 0x1001
FACES = {"stands": 0x0003, "ramps": 0x0001, "runs": 0x0001, "reverse": 0x0002, "fault": 0x0004, "warning": 0x0003}
"""1 forward, 2 reverse, 3 standby, 4 fault."""
FREQUENCY = 0x3000
COUNTS_PER_HZ = 100
FAULT = (0x5000, 18)
CODES = (2, 4, 5, 5, 4, None, 8)
PASSING = (3, 4, 1)
PINS = {"FullScaleHz"}
BRIEF = (
    "not known",
    "P0.04",
    "count on a motor that runs on",
    "a rising FaultReset",
    "no list",
    "5000 in 2000H, where P0.04 is 50 Hz",
)
ALIKE = {
    ("coast_stop", "Coast to stop (emergency stop)"),
    ("fault_reset", "Fault reset"),
    ("jog_forward", "Jog forward"),
    ("jog_reverse", "Jog reverse"),
    ("jog_stop", "Jog stop"),
    ("run_forward", "Run forward"),
    ("run_reverse", "Run reverse"),
    ("stop", "Stop"),
}
HELD = {"read_ascii_request": {4: 2}}
KEYPAD = """
P0.04 | - | - | - | -
"""
PRINTED_WRONG = {"read_rtu_reply": "CHECKSUM"}
