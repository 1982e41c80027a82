"""What pages of the ACS355 (313, 319; N: 326, 327 of another edition) and of sisters say, typed by hand."""

STATUS = 0x0003
FACES = {"stands": 0x1200, "ramps": 0x1204, "runs": 0x1304, "reverse": 0x1304, "fault": 0x0208, "warning": 0x1280}
"""Bit 2 operation enabled, 3 tripped, 7 alarm, 8 at setpoint, 9 remote, C external run enable; none of reverse."""
CHART = 0x0003
FREQUENCY = 0x0066
COUNTS_PER_HZ = 100
FAULT = (0x0190, 18)
CODES = (1, 2, 3, 3, 3, 3, None)
"""Page 327: value, read-only and running are all 03."""
PASSING = (3, 4, 3)
CONTROL = "sister"
PINS = {"FullScaleHz", "ManualChecked"}
BRIEF = (
    "not known",
    "9802 = 1, 1001 = 10, 1003 = 3",
    "count on a motor that runs on",
    "a rising FaultReset",
    "23 codes",
    "10000 in 40002",
)
ALIKE = {
    ("coast_stop", "INHIBIT OPERATION"),
    ("coast_stop", "OFF1 CONTROL"),
    ("coast_stop", "OFF2 CONTROL"),
    ("coast_stop", "OFF3 CONTROL"),
    ("coast_stop", "RAMP HOLD"),
    ("coast_stop", "RAMP IN ZERO"),
    ("coast_stop", "RAMP OUT ZERO"),
    ("coast_stop", "REMOTE CMD"),
    ("coast_stop", "RESET"),
    ("fault_reset", "RESET"),
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
"""ACS550-01, page 151; OM 1191, page 49; ACH550-UH, page 148."""
ROWS = """
0000 | - | rw | - | -
0001 | - | rw | - | signed
0002 | - | rw | - | signed
0003 | - | r | - | -
0004 | - | r | - | signed
0066 | 0103 | r | - | signed
0067 | 0104 | r | A | -
006A | 0107 | r | V | -
0190 | 0401 | r | - | -
0450 | 1105 | rw | Hz | -
"""
"""Page 313; N page 326: sent as xxxx - 1; a parameter is its group, and two digits."""
COMMANDS = dict.fromkeys(
    ("run_forward", "run_reverse"), "0000=0006 0000=0006 0000=0007 0000=000F 0000=002F 0000=006F"
) | {
    "stop": "0000=006E",
    "quick_stop": "0000=006B",
    "coast_stop": "0000=006D",
    "fault_reset": "0000=0006 0000=0086",
}
"""Page 319: the path x110, x111, bits 3, 5 and 6; 0 of bits 0, 2, 1 is OFF1, OFF3, OFF2; bit 7 resets."""
WAITS = ("ready_to_switch_on", 100, "ready_to_operate", "operation_enabled", None)
"""What ends each step: SW bits 0, 1, 2 of page 319; 100 ms of ACS550-02, page 246."""
REFERENCE = "0001 fraction_of_full_scale 20000"
"""FENA-11, page 92: REF1 20000 is REF1 MAX, 1105."""
STANDSTILL = "0003.2=0 0066=0"
SHOWS = {
    "running": "0003.2=1",
    "at_speed": "0003&0104=0104",
    "ready": "0003.C=1",
    "warning": "0003.7=1",
    "fault": "0003.3=1",
}
"""Page 319; bit 7 of the ACS320, page 350."""
MEASURES = {"output_frequency": "0066", "output_current": "0067", "dc_bus_voltage": "006A"}
NEEDED = {"9802": 1, "1001": 10, "1003": 3, "1102": 8, "1103": 8, "5305": 0}
"""ACS320, page 345; ACH550-UH, page 148; OM 1191, page 49."""
RATES = [1200, 2400, 4800, 9600, 19200, 38400, 57600]
FORMS = {0: "8N1", 1: "8N2", 2: "8E1", 3: "8O1"}
UNIT = (1, 247, 1)
"""ACS550-01, page 151."""
FUNCTIONS = [3, 6, 16, 23]
"""N page 326."""
REFUSALS = [1, 2, 3]
"""N page 327."""
FAULTS = {
    1: "OVERCURRENT", 2: "DC OVERVOLT", 3: "DEV OVERTEMP", 4: "SHORT CIRC", 6: "DC UNDERVOLT", 7: "AI 1 LOSS",
    8: "AI 2 LOSS", 9: "MOT OVERTEMP", 10: "PANEL LOSS", 11: "ID RUN FAIL", 12: "MOTOR STALL", 14: "EXT FAULT 1",
    15: "EXT FAULT 2", 16: "EARTH FAULT", 18: "THERM FAIL", 19: "OPEX LINK", 20: "OPEX PWR", 21: "CURR MEAS",
    22: "SUPPLY PHASE", 23: "ENCODER ERR", 24: "OVERSPEED", 26: "DRIVE ID", 28: "SERIAL 1 ERR",
}  # fmt: skip
"""ACS550-02, page 259, without what is reserved or obsolete; 28 of ACH550-UH, page 154."""
