"""What pages 74, 110 to 117 of the PI130's manual say, typed from them by hand; no map was read for it."""

STATUS = 0x3000
FACES = {"stands": 0x0003, "ramps": 0x0001, "runs": 0x0001, "reverse": 0x0002, "fault": 0x0004, "warning": 0x0003}
"""1 forward running, 2 reverse running, 3 standby, 4 fault."""
FREQUENCY = 0x1001
COUNTS_PER_HZ = 100
FAULT = (0x8000, 18)
CODES = (1, 2, 3, 3, 2, None, None)
PASSING = (3, 4, 1)
CONTROL = "in use"
PINS = {"FullScaleHz", "ManualChecked"}
BRIEF = (
    "not known",
    "F9.05 = 1",
    "(F9.04 0.0 s) the motor runs on",
    "a rising FaultReset",
    "19 codes",
    "5000 in 1000H",
)
ALIKE = {
    ("coast_stop", "Free stop"),
    ("fault_reset", "Fault reset"),
    ("jog_forward", "Forward jog"),
    ("jog_reverse", "Reverse jog"),
    ("jog_stop", "Jog stop"),
    ("run_forward", "Forward run"),
    ("run_reverse", "Reverse run"),
    ("stop", "Stop"),
}
KEYPAD = """
F0.08 | - | - | - | -
F9.01 | - | - | 10=7e2,_a 11=7o2,_a 12=8n1,_a 13=8e1,_a 14=8o1,_a 15=8n2,_a 16=8e2,_a 17=8o2,_a | -
F9.02 | - | 1 | 1 to 247 | -
F9.03 | - | 5 ms | 0 to 200 ms | 1 ms
F9.04 | - | 0.0 s | 0.0 to 100.0 s | 0.1 s
F9.05 | - | - | 0=not 1=standard | -
"""
"""Page 74, and page 112 for F9.05."""
ROWS = """
1000 | - | w | % | 0.01 signed
2000 | - | w | - | -
3000 | - | r | - | -
1001 | - | r | Hz | -
1003 | - | r | V | -
1004 | - | r | A | -
1005 | - | r | - | -
1006 | - | r | - | -
1007 | - | r | - | -
1008 | - | r | - | -
1009 | - | r | - | -
100A | - | r | - | -
100B | - | r | - | -
1010 | - | r | - | -
1011 | - | r | - | -
1012 | - | r | - | -
1015 | - | r | - | -
1016 | - | r | - | -
8000 | - | r | - | -
"""
"""Page 116: 10000 is 100.00 % of F0.08; no unit of a monitor is printed."""
COMMANDS = {
    "run_forward": "2000=0001",
    "run_reverse": "2000=0002",
    "jog_forward": "2000=0003",
    "jog_reverse": "2000=0004",
    "stop": "2000=0006",
    "coast_stop": "2000=0005",
    "fault_reset": "2000=0007",
    "jog_stop": "2000=0008",
}
"""Page 116: 5 is the free stop, 6 the stop."""
REFERENCE = "1000 percent_of_maximum"
STANDSTILL = "3000=3 1001=0"
SHOWS = {"running": "3000=1 3000=2", "reverse": "3000=2", "fault": "3000=4"}
MEASURES = {"output_frequency": "1001", "output_voltage": "1003", "output_current": "1004"}
NEEDED = {"F9.05": 1}
FUNCTIONS = [3, 6]
FAULTS = {
    1: "Inverter unit phase U",
    2: "Inverter unit phase V",
    3: "Inverter unit phase W",
    4: "Acceleration overcurrent",
    5: "Deceleration overcurrent",
    6: "Constant speed overcurrent",
    7: "Acceleration overvoltage",
    8: "Deceleration overvoltage",
    9: "Constant speed overvoltage",
    10: "Bus undervoltage",
    11: "Motor overload",
    12: "Inverter overload",
    17: "Inverter module overheating",
    18: "External fault",
    19: "Communication fault",
    20: "Current detection fault",
    21: "Motor auto-tuning fault",
    22: "EEPROM operation fault",
    23: "PID disconnection fault",
}
UNIT = (1, 247, 1)
WATCHDOG = ("F9.04", 100, 19)
