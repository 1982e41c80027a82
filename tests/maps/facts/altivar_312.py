"""What the manuals of the Altivar 312 say (BBV51701; M: BBV52816), typed from them by hand; no map was read for it."""

WORDS = {
    "run_forward": (0x0000, 0x0006, 0x0007, 0x000F), "run_reverse": (0x0000, 0x0006, 0x0007, 0x080F), "stop": (0x0007,),
    "quick_stop": (0x0002,), "coast_stop": (0x0000,), "fault_reset": (0x0000, 0x0080),
}  # fmt: skip
"""Typical values of CMD on page 12, in the order of the chart on page 10."""
STATES = {
    "switch_on_disabled": (0x004F, 0x0040),
    "ready_to_switch_on": (0x006F, 0x0021),
    "switched_on": (0x006F, 0x0023),
}
"""ETA masked, page 13; quick stop does not count in the first, for which 0040 and 0060 are printed."""
REGISTERS = {
    "CMD": 8501, "LFR": 8502, "CMI": 8504, "ETA": 3201, "RFR": 3202, "FRH": 3203, "LCR": 3204, "OTR": 3205, "ETI": 3206,
    "ULN": 3207, "LFT": 7121, "HSP": 3104, "LSP": 3105, "TFR": 3103, "SFR": 3102, "ADD": 6001, "TBR": 6003, "TFO": 6004,
    "TTO": 6005, "SLL": 7010, "LAC": 3006, "FR1": 8413, "CHCF": 8401, "RFC": 8411, "STT": 11201, "PST": 64002,
}  # fmt: skip
TENTHS = ("LFR", "RFR", "FRH", "LCR", "ULN", "HSP", "LSP", "TFR", "SFR", "TTO")
NEEDED = {"LAC": 2, "FR1": 164, "CHCF": 1, "RFC": 96, "STT": 0, "PST": 1}
RATES = {24: 4800, 28: 9600, 32: 19200}
FORMATS = {2: "8O1", 3: "8E1", 4: "8N1", 5: "8N2"}
SILENT = {0: "runs_on", 1: "coast_stop", 6: "stop", 7: "quick_stop"}
FAULTS = "3 4 5 6 7 8 9 10 13 16 17 18 19 20 21 22 23 24 25 26 27 28 29 30 31 32 33 34 35 36 55"
"""LFt, page 24."""
LIMITS = {"read_words": 29, "write_words": 27}
"""M page 12."""
