"""What documents say of JSCC series inverters, typed from them by hand; no map was read for it."""

STATUS = 0x2001
FACES = {"stands": 0x0004, "ramps": 0x0001, "runs": 0x0001, "reverse": 0x0002, "fault": 0x0008, "warning": 0x0004}
"""1 forward, 2 reverse, 4 stopped, 8 fault."""
FREQUENCY = 0x2000
COUNTS_PER_HZ = 10
FAULT = (0x3000, 18)
CODES = (1, 2, 3, 3, 2, None, 6)
PASSING = (3, 4, 3)
PINS = {"ReferenceScale"}
BRIEF = (
    "not known",
    "F0.04 = 4",
    "count on a motor that runs on",
    "no command for it over the bus",
    "12 codes",
    "not known for 1001H",
)
ALIKE = {("run_forward", "Run forward"), ("run_reverse", "Run reverse"), ("stop", "Stop")}
KEYPAD = """
F0.04 | F0, basic settings | 1 | 1=terminals 2=terminals 3=keypad 4=rs-485 | -
F0.08 | F0, basic settings | 1 | 1=keypad 2=ad1 3=ad2 4=combination 5=m1 6=plc 7=pid 8=rs-485 | -
FA.00 | FA, communication settings | 1 | 1 to 247 | -
FA.01 | FA, communication settings | 3 | 1=4800 2=9600 3=19200 4=38400 5=57600 | -
FA.02 | FA, communication settings | 2 | 1=no_parity,_1 2=even_parity,_1 3=odd_parity,_1 4=no_parity,_2\
 5=even_parity,_2 6=odd_parity,_2 | -
FA.03 | FA, communication settings | 2 | 1=ascii 2=rtu | -
"""
"""JSCC, section 2."""
