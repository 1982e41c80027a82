"""What pages of the A1000 (559, 561; N: 494 of SIEP C710616 27C) and of sisters say, typed by hand; no map was read."""

STATUS = 0x004B
FACES = {"stands": 0x8022, "ramps": 0x8021, "runs": 0x8031, "reverse": 0x8035, "fault": 0x8082, "warning": 0x8062}
"""N: bit 0 run, 1 zero speed, 2 reverse run, 4 speed agree, 5 ready, 6 alarm, 7 fault, F command by the bus."""
FREQUENCY = 0x0041
COUNTS_PER_HZ = 100
FAULT = (0x0080, 18)
CODES = (1, 2, 3, 0x21, 0x22, 0x22, 0x24)
"""J1000, page 231: 22H is read-only, and not during run; 24H is writing during parameter processing."""
PASSING = (3, 4, 3)
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
ALIKE = {
    ("fault_reset", "Fault reset"),
    ("run_forward", "Forward run command"),
    ("run_reverse", "Reverse run command"),
    ("stop", "External fault"),
    ("stop", "Fault reset"),
}
"""A word with bit 2 or 3 alone has no run command, so that it stops, too."""
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
"""Page 559; SN300G5, table of communication parameters, and section (V); notes of ga800.mbmap.json."""
ROWS = """
0001 | - | rw | - | -
0002 | - | rw | Hz | 0.01
0006 | - | rw | % | 0.01 signed
0007 | - | rw | - | -
0008 | - | rw | - | -
002A | - | r | - | -
002C | - | r | - | -
0031 | - | r | V | 1
0034 | - | r | - | -
0035 | - | r | - | -
003E | - | r | r/min | 1
003F | - | r | % | 0.01
0041 | U1-02 | r | Hz | 0.01
0042 | U1-03 | r | A | -
004B | U1-12 | r | - | -
007F | - | r | - | -
0080 | U2-01 | r | - | -
0900 | - | w | - | -
0910 | - | w | - | -
"""
"""Pages 559 and 561; N; GA800, page 282: Enter, which can only be written; GA700, page 1146: 1770H is 60.00 Hz."""
COMMANDS = {
    "run_forward": "0001=0001",
    "run_reverse": "0001=0002",
    "stop": "0001=0000",
    "fault_reset": "0001=0000 0001=0008",
}
"""Page 559, H5-12 = 0: bit 0 forward run, 1 reverse run, 3 fault reset; 0 of both is stop."""
REFERENCE = "0002 frequency"
STANDSTILL = "004B.0=0 004B.1=1 003E=0 003F=0"
SHOWS = {
    "running": "004B.0=1",
    "zero_speed": "004B.1=1",
    "reverse": "004B.2=1",
    "at_speed": "004B.4=1",
    "ready": "004B.5=1",
    "warning": "004B.6=1",
    "fault": "004B.7=1",
}
MEASURES = {"output_frequency": "0041", "output_speed": "003E", "output_current": "0042", "dc_bus_voltage": "0031"}
NEEDED = {"b1-01": 2, "b1-02": 2, "o1-03": 0, "H5-04": 0, "H5-05": 1, "H5-12": 0}
RATES = {0: 1200, 1: 2400, 2: 4800, 3: 9600}
FORMS = {0: "8N1", 1: "8E1", 2: "8O1"}
UNIT = (1, 247, 31)
"""a1000.json goes to 255, which is beyond Modbus; 1FH as delivered."""
FUNCTIONS = [3, 8, 16]
"""J1000, page 231: others than 03H, 08H and 10H are refused."""
REFUSALS = {
    0x01: "Function code error",
    0x02: "Register number error",
    0x03: "Word quantity error",
    0x21: "Data setting error",
    0x22: "Write mode error",
    0x23: "DC bus undervoltage write error",
    0x24: "Write during parameter processing",
}
"""J1000, page 231."""
FAULTS = {
    0x02: "DC bus undervoltage", 0x03: "Control power supply undervoltage", 0x05: "Output short circuit",
    0x06: "Ground fault", 0x07: "Overcurrent", 0x08: "Overvoltage", 0x09: "Heatsink overheat",
    0x0A: "Heatsink overheat 1", 0x0B: "Motor overload", 0x0C: "Drive overload", 0x0D: "Overtorque 1",
    0x0E: "Overtorque 2", 0x0F: "Braking transistor fault", 0x10: "Braking resistor overheat",
    0x11: "External fault 3", 0x12: "External fault 4", 0x13: "External fault 5", 0x14: "External fault 6",
    0x15: "External fault 7", 0x16: "External fault 8", 0x18: "Overspeed",
    0x21: "MEMOBUS/Modbus communication error",
}  # fmt: skip
"""SN300G5, table of fault numbers, in the words of the A1000 where page 561 has one."""
LIMITS = {"read_words": 16, "write_words": 16}
WATCHDOG = None
PRINTED_WRONG = {"write_request": "CHECKSUM"}
