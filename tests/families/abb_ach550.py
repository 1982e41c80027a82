"""What pages of ACH550-UH (DriveIT), L: its later edition, E: the EFB manual, and of sisters say, typed by hand."""

STATUS = 0x012E
FACES = {"stands": 0x0012, "ramps": 0x000A, "runs": 0x008A, "reverse": 0x088A, "fault": 0x8010, "warning": 0x0012}
"""E page 22: bit 1 enabled, 3 running, 4 zero speed, 7 at setpoint, B reverse, F fault; the alarm is in 0304."""
CHART = 0x0000
CONTROL = "sister"
BRIEF = (
    "pin 29, B (Positive +); - (D0, A of the standard) on pin 30, A (Negative -)",
    "9802 = 1, 1001 = 10, 1003 = 3, 1102 = 8, 1103 = 8, 5305 = 0, 3018 = 1",
    "What 3018 says",
    "a rising FaultReset",
    "32 codes",
    "10000 in 40002",
)
PLUG = "28 shield, 29 positive, 30 negative, 31 common, 32 shield"
"""Page 155: X1, 28 Screen, 29 B (Positive +), 30 A (Negative -), 31 AGND, 32 Screen."""
TERMINATION = ("120 ohm", "both ends")
WIRED = True
KEYPAD = """
9802 | - | - | 1=standard | -
5302 | - | 1 | 0 to 65535 | -
5303 | - | 9.6 kbit/s | - | -
5304 | - | 0 | 0=8n1 1=8n2 2=8e1 3=8o1 | -
5305 | - | 0 | 0=abb 1=ach550 2=full | -
1001 | - | - | 10=comm | -
1003 | - | - | 3=request | -
1102 | - | - | 8=comm | -
1103 | - | - | 8=comm | -
1105 | - | 60.0 Hz | 0.0 to 500.0 Hz | 0.1 Hz
1604 | - | - | - | -
3018 | - | - | 0=not 1=fault 2=constant 3=last | -
3019 | - | - | - | -
1104 | - | 0.0 Hz | 0.0 to 500.0 Hz | 0.1 Hz
"""
"""Pages 128, 148, 65; ACS550-01, page 187."""
ROWS = """
0000 | - | rw | - | -
0001 | - | rw | - | signed
0002 | - | rw | - | signed
0003 | - | r | - | -
0004 | - | r | - | signed
0066 | 0103 | r | - | signed
0067 | 0104 | r | A | -
006A | 0107 | r | V | -
012E | 0303 | r | - | -
012F | 0304 | r | - | -
0190 | 0401 | r | - | -
044F | 1104 | rw | Hz | -
0450 | 1105 | rw | Hz | -
"""
"""Pages 148, 153, 157, 161; L page 1-198: 4 and the number of the parameter."""
COMMANDS = dict.fromkeys(
    ("run_forward", "run_reverse"), "0000=0006 0000=0006 0000=0007 0000=000F 0000=002F 0000=006F"
) | {
    "stop": "0000=006E",
    "quick_stop": "0000=006B",
    "coast_stop": "0000=006D",
    "fault_reset": "0000=0006 0000=0086",
}
"""Page 165 up to 000FH, ACS550-02 page 246 to the end; page 163: OFF1 ramps, OFF2 coasts, OFF3 within 2208."""
WAITS = ("ready_to_switch_on", 100, "ready_to_operate", "operation_enabled", None)
"""E page 31: bits 0, 1 and 2."""
REFERENCE = "0001 fraction_of_full_scale 20000"
"""Page 207: +20000 = (par. 1105)."""
STANDSTILL = "012E&0018=0010 0066=0"
SHOWS = {
    "running": "012E.3=1",
    "at_speed": "012E&0088=0088",
    "ready": "012E.1=1",
    "warning": "012F.0=1",
    "fault": "012E.F=1",
    "reverse": "012E.B=1",
    "zero_speed": "012E.4=1",
}
"""E page 22: bits of 0303, and bit 16, the first of 0304."""
MEASURES = {"output_frequency": "0066", "output_current": "0067", "dc_bus_voltage": "006A"}
NEEDED = {"9802": 1, "1001": 10, "1003": 3, "1102": 8, "1103": 8, "5305": 0, "3018": 1}
"""Pages 163 and 148; ACS550-01, page 187."""
RATES = [1200, 2400, 4800, 9600, 19200, 38400, 57600]
FORMS = {0: "8N1", 1: "8N2", 2: "8E1", 3: "8O1"}
"""Page 128."""
FUNCTIONS = [3, 6, 16, 23, 1, 2, 4, 5, 15]
"""Pages 158 and 162; L page 1-239. Those of the ACS355 come first."""
REFUSALS = [1, 2, 3]
"""Page 162."""
FAULTS = {
    1: "OVERCURRENT", 2: "DC OVERVOLT", 3: "DEV OVERTEMP", 4: "SHORT CIRC", 6: "DC UNDERVOLT", 7: "AI1 LOSS",
    8: "AI2 LOSS", 9: "MOT OVERTEMP", 10: "PANEL LOSS", 11: "ID RUN FAIL", 12: "MOTOR STALL", 14: "EXT FAULT 1",
    15: "EXT FAULT 2", 16: "EARTH FAULT", 18: "THERM FAIL", 19: "OPEX LINK", 20: "OPEX PWR", 21: "CURR MEAS",
    22: "SUPPLY PHASE", 24: "OVERSPEED", 26: "DRIVE ID", 28: "SERIAL 1 ERR", 5: "OVERLOAD", 17: "UNDERLOAD",
    27: "CONFIG FILE", 29: "EFB CON FILE", 30: "FORCE TRIP", 31: "EFB 1", 32: "EFB 2", 33: "EFB 3",
    34: "MOTOR PHASE", 35: "OUTP WIRING",
}  # fmt: skip
"""Carrier, pages 182 and 127; those of ACS550-02, page 259, that Carrier has otherwise: 5, 17, and 23 reserved."""
UNIT = (1, 247, 1)
WATCHDOG = None
"""No page has the count of 3019."""
