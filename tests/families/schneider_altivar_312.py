"""What documents say of Altivar 312, typed from them by hand; no map was read for it."""

STATUS = 0x0C86
FACES = {"stands": 0x4000, "ramps": 0x4010, "runs": 0x4010, "reverse": 0x4010, "fault": 0x4000, "warning": 0x4000}
"""Bit 4 motor running, bits D and E controlled via Modbus; its state word, 0C81H, is in test_shapes.py."""
FREQUENCY = 0x0C82
COUNTS_PER_HZ = 10
FAULT = (0x1BD1, 18)
CODES = (1, 2, 3, 3, 2, None, None)
"""M page 15."""
PASSING = (3, 4, 3)
PINS: set[str] = set()
BRIEF = (
    "pin 4, D1 Modbus signal; -",
    "LAC = L3, Fr1 = Mdb",
    "the motor coasts after 10.0 s",
    "a rising FaultReset",
    "31 codes",
    "250 in 2136H",
)
ALIKE = {
    ("coast_stop", "Enable operation"),
    ("coast_stop", "Fast stop"),
    ("coast_stop", "Fault reset"),
    ("coast_stop", "Injection stop"),
    ("coast_stop", "No quick stop"),
    ("coast_stop", "Reverse"),
    ("coast_stop", "Stop command"),
    ("coast_stop", "Switch on"),
    ("fault_reset", "Fault reset"),
    ("quick_stop", "Enable voltage"),
}
PLUG = "1 reserved, 2 reserved, 3 reserved, 4 positive, 5 negative, 6 unconnected, 7 supply, 8 common"
"""BBV52816, page 8, pin out of the ATV312 RJ45 connector; D1 and D0 after pages 10 and 19."""
WIRED = True
TERMINATION = ("120 ohm 0.25 W", "1 nF 10 V")
HELD = {"read_limits_request": {0x0C1E: 40, 0x0C1F: 600, 0x0C20: 500}}
KEYPAD = """
LAC | CtL- | L1 | L1 L2 L3 | -
Fr1 | CtL- | AI1 | AI1 AI2 AI3 AIV1 UPdt=inputs UPdH=dial LCC=remote Mdb=modbus 167=canopen | -
CHCF | CtL- | SIM | SIM=combined SEP=separate | -
rFC | CtL- | Fr1 | Fr1 | -
Stt | - | 0 | 0=ramp 1=fast 2=freewheel 3=dc | -
PST | - | 1 | 0=inactive 1=priority | -
Add | - | 1 | 1 to 247 | -
tbr | - | 19.2 | 4.8=4800 9.6=9600 19.2=19200 | -
tFO | - | 8E1 | 8O1 8E1 8N1 8N2 | -
ttO | - | 10.0 s | 0.1 to 30.0 s | 0.1 s
SLL | - | 1 | 0=ignored 1=freewheel 6=ramp 7=fast | -
FLO | - | nO | - | -
Cd1 | CtL- | tEr | - | -
tCC | I-O- | 2C | - | -
Atr | FLt- | nO | - | -
FCS | drC- | nO | - | -
bFr | drC- | 50 Hz | - | Hz
ACC | SEt- | 3 s | - | s
dEC | SEt- | 3 s | - | s
LSP | SEt- | 0.0 Hz | - | 0.1 Hz
HSP | SEt- | bFr | - | 0.1 Hz
"""
"""Altivar 312, a list after BBV46387; numbers of BBV51701, pages 27, 35 to 40, 53 and 55; tbr and ttO of the ATV12."""
PRINTED_WRONG = {"write_ramps_request": "CHECKSUM", "write_ramps_reply": "CHECKSUM"}
