"""What pages of the ACS355 (313, 319; N: 326, 327 of another edition) and of sisters say, typed by hand."""

REGISTERS = {40001: "rw", 40002: "rw", 40003: "rw", 40004: "r", 40005: "r"}
"""Page 313, by the manual's numbers; N page 326: sent as xxxx - 1."""
PARAMETERS = {"0103": 40103, "0104": 40104, "0107": 40107, "0401": 40401, "1105": 41105}
"""Page 313: group, and two digits of the parameter."""
WORDS = {
    "run_forward": (0x0006, 0x0006, 0x0007, 0x000F, 0x002F, 0x006F),
    "run_reverse": (0x0006, 0x0006, 0x0007, 0x000F, 0x002F, 0x006F),
    "stop": (0x006E,), "quick_stop": (0x006B,), "coast_stop": (0x006D,), "fault_reset": (0x0006, 0x0086),
}  # fmt: skip
"""Page 319: the path x110, x111, bits 3, 5 and 6; 0 of bits 0, 2, 1 is OFF1, OFF3, OFF2; bit 7 resets."""
WAITS = ("ready_to_switch_on", 100, "ready_to_operate", "operation_enabled", None)
"""What ends each step: SW bits 0, 1, 2 of page 319; 100 ms of ACS550-02, page 246."""
STATUS = {"running": 2, "fault": 3, "warning": 7, "ready": 12}
"""Page 319; bit 7 of the ACS320, page 350."""
FULL_SCALE = 20000
"""FENA-11, page 92: REF1 20000 is REF1 MAX, 1105."""
NEEDED = {"9802": 1, "1001": 10, "1003": 3, "1102": 8, "1103": 8, "5305": 0}
"""ACS320, page 345; ACH550-UH, page 148; OM 1191, page 49."""
RATES = [1200, 2400, 4800, 9600, 19200, 38400, 57600]
FORMS = {0: ("none", 1), 1: ("none", 2), 2: ("even", 1), 3: ("odd", 1)}
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
