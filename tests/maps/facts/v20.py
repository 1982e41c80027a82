"""What pages of the SINAMICS V20 (07/2012) and G120C (G) say, typed from them by hand; no map was read for it."""

WIRE = {
    "P0640": 9, "P1120": 10, "P1121": 11, "P2000": 15, "r0024": 23, "r0022": 24, "r0027": 25, "r0031": 26,
    "r0032": 27, "r0039": 28, "r0026": 29,
}  # fmt: skip
"""Columns inverter and read of the mapping table, page 112."""
SCALING = {
    "P0640": (10, "%"), "P1120": (100, "s"), "P1121": (100, "s"), "P2000": (100, "Hz"), "r0024": (100, "Hz"),
    "r0022": (1, "r/min"), "r0027": (100, "A"), "r0031": (100, "Nm"), "r0032": (100, "kW"),
    "r0039": (1, "kWh"), "r0026": (1, "V"),
}  # fmt: skip
"""Its scaling factor, by which a value is multiplied (page 115), and its unit."""
NEGATIVE = {"r0024", "r0022", "r0031"}
"""Ranges that begin below 0, page 112."""
SINGLE = {3: 3, 4: 11, 5: 0, 6: 7}
"""Registers of one bit of STW, page 112: STW:3, STW:11, STW:0, STW:7."""
WORDS = {
    "run_forward": (0x047E, 0x047F), "run_reverse": (0x0C7E, 0x0C7F), "stop": (0x047E,), "quick_stop": (0x047B,),
    "coast_stop": (0x047D,), "fault_reset": (0x047E, 0x04FE),
}  # fmt: skip
"""G pages 194, 195: ON is bit 0 rising, bits 1 to 6 and 10 are 1; 0 of bits 0, 1, 2 is OFF1, 2, 3; bit 7 rises."""
STATUS = {"running": 2, "fault": 3, "warning": 7}
"""G page 199, ZSW1."""
NEEDED = {"P0003": 3, "P0700": 5, "P2023": 2}
"""Page 111."""
RATES = {6: 9600, 7: 19200, 8: 38400, 12: 115200}
LIMITS = {"read_words": 125, "write_words": 123}
UNIT = (1, 247, 1)
REFUSALS = [1, 2, 3, 4]
"""All of page 111."""
TERMINALS = {"5": "0V", "6": "P+", "7": "N-"}
"""Page 25."""
WATCHDOG = ("P2014", 1, 72)
"""Pages 111 and 115: ms, F72; process data alone."""
