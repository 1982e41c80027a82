"""What pages 22 and 23 of the VM600's manual say, typed from them by hand; no map was read for it."""

STATUS = 0x3000
FACES = {"stands": 0x0003, "ramps": 0x0001, "runs": 0x0001, "reverse": 0x0002, "fault": 0x0003, "warning": 0x0003}
"""1 FWD running, 2 REV running, 3 stopped; a fault is in 8000H alone, and a warning nowhere."""
FREQUENCY = 0x1001
COUNTS_PER_HZ = 100
FAULT = (0x8000, 18)
CODES = (2, 4, 3, 3, 4, None, 8)
"""8001H: 2 command code, 4 invalid address, 8 being saved; none is of a value beyond its range."""
PASSING = (3, 4, 1)
PINS = {"FullScaleHz", "ManualChecked"}
BRIEF = (
    "not known",
    "to choose: F0.05",
    "count on a motor that runs on",
    "a rising FaultReset",
    "13 codes",
    "5000 in 1000H",
)
ALIKE = {
    ("coast_stop", "Free stop"),
    ("fault_reset", "Fault reset"),
    ("run_forward", "Forward running"),
    ("run_reverse", "Reverse running"),
    ("stop", "Deceleration stop"),
}
KEYPAD = """
F0.05 | - | - | - | -
F0.06 | - | - | - | -
F0.10 | - | - | - | -
"""
ROWS = """
1000 | - | rw | % | 0.01 signed
2000 | - | w | - | -
3000 | - | r | - | -
1001 | - | r | Hz | 0.01
1002 | - | r | Hz | 0.01
1003 | - | r | V | 0.1
1004 | - | r | V | 0.1
1005 | - | r | A | 0.01
1006 | - | r | - | -
1007 | - | r | - | -
1009 | - | r | V | 0.1
100A | - | r | V | 0.1
100B | - | r | - | -
100E | - | r | - | -
8000 | - | r | - | -
8001 | - | r | - | -
F006 | F0.06 | rw | - | -
F00A | F0.10 | rw | - | -
"""
"""Sheet 5-1-1: decimal places of each; 101A between 1009 and 100B is 100A. 5.2: F006, and F010 at F00A."""
COMMANDS = {
    "run_forward": "2000=0001",
    "run_reverse": "2000=0002",
    "stop": "2000=0006",
    "coast_stop": "2000=0005",
    "fault_reset": "2000=0007",
}
"""2000H: 0001 forward running, 0002 reverse running, 0005 free stop, 0006 deceleration stop, 0007 fault reset."""
REFERENCE = "1000 percent_of_maximum"
STANDSTILL = "3000=3 1001=0"
SHOWS = {"running": "3000=1 3000=2", "reverse": "3000=2", "fault": "8000>0"}
MEASURES = {"output_frequency": "1001", "output_current": "1005", "output_voltage": "1004", "dc_bus_voltage": "1003"}
FUNCTIONS = [3, 6]
REFUSALS = {
    1: "Password error",
    2: "Illegal function code",
    3: "CRC error",
    4: "Invalid address",
    5: "Invalid parameter",
    6: "Parameter not adjusted",
    7: "System locked",
    8: "Busy saving parameters",
}
FAULTS = {
    2: "Overcurrent while accelerating",
    3: "Overcurrent while decelerating",
    4: "Overcurrent at constant speed",
    5: "Overvoltage while accelerating",
    6: "Overvoltage while decelerating",
    7: "Overvoltage at constant speed",
    9: "Low voltage",
    10: "Drive overload",
    11: "Motor overload",
    14: "IGBT overheated",
    15: "External fault",
    18: "Current detection fault",
    21: "Parameters not written or read",
}
LIMITS = {"read_words": 12}
UNIT = (1, 247, None)
WATCHDOG = None
