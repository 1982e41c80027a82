"""What pages 299, 307 and 309 of the ACS310 and of sisters say, typed from them by hand; no map was read for it."""

STATUS = 0x012E
FACES = {"stands": 0x0012, "ramps": 0x000A, "runs": 0x008A, "reverse": 0x088A, "fault": 0x8010, "warning": 0x0012}
"""Page 309: bit 1 enabled, 3 running, 4 zero speed, 7 at setpoint, B reverse, F fault; the alarm is in 0304."""
CHART = 0x0000
CONTROL = "sister"
BRIEF = (
    "not known",
    "9802 = 1, 1001 = 10, 1003 = 3, 1102 = 8, 1103 = 8, 5305 = 1",
    "count on a motor that runs on",
    "a rising FaultReset",
    "23 codes",
    "10000 in 40002",
)
ALIKE = {
    ("fault_reset", "RESET"),
    ("run_forward", "START"),
    ("stop", "RAMP IN 0"),
    ("stop", "RAMP OUT 0"),
    ("stop", "RUN DISABLE"),
    ("stop", "STOP"),
    ("stop", "STPMODE R"),
}
KEYPAD = """
9802 | - | - | 1=standard | -
5302 | - | 1 | 0 to 247 | -
5303 | - | 9.6 kbit/s | - | -
5304 | - | - | 0=8n1 1=8n2 2=8e1 3=8o1 | -
5305 | - | 0 | 0=lim 1=dcu 2=full | -
1001 | - | - | 10=comm | -
1003 | - | - | 3=request | -
1102 | - | - | 8=comm | -
1103 | - | - | 8=comm | -
1105 | - | - | - | -
1604 | - | - | - | -
3018 | - | - | - | -
3019 | - | - | - | -
"""
"""ACS550-01, page 151; ACS550-02, page 223; ACH550-UH, page 148."""
ROWS = """
001E | - | rw | - | -
0001 | - | rw | - | signed
0002 | - | rw | - | signed
0066 | 0103 | r | - | signed
0067 | 0104 | r | A | -
006A | 0107 | r | V | -
012E | 0303 | r | - | -
012F | 0304 | r | - | -
0190 | 0401 | r | - | -
0450 | 1105 | rw | Hz | -
"""
"""Page 299: 40101 to 49999 are parameters 0101 to 9999; ACS355, page 313: 40002 and 40031."""
COMMANDS = {
    "run_forward": "001E=0002",
    "run_reverse": "001E=0006",
    "stop": "001E=0081",
    "fault_reset": "001E=0081 001E=0091",
}
"""Page 307: bit 0 STOP, 1 START, 2 REVERSE, 4 RESET, 7 STPMODE_R: by the ramp."""
REFERENCE = "0001 fraction_of_full_scale 20000"
"""FENA-11, page 92."""
STANDSTILL = "012E&0018=0010 0066=0"
SHOWS = {
    "running": "012E.3=1",
    "reverse": "012E.B=1",
    "at_speed": "012E&0088=0088",
    "zero_speed": "012E.4=1",
    "ready": "012E.1=1",
    "warning": "012F.0=1",
    "fault": "012E.F=1",
}
"""Page 309; ACS550-01, page 70: the alarm."""
MEASURES = {"output_frequency": "0066", "output_current": "0067", "dc_bus_voltage": "006A"}
NEEDED = {"9802": 1, "1001": 10, "1003": 3, "1102": 8, "1103": 8, "5305": 1}
RATES = [1200, 2400, 4800, 9600, 19200, 38400, 57600]
FORMS = {0: "8N1", 1: "8N2", 2: "8E1", 3: "8O1"}
UNIT = (1, 247, 1)
