"""What the workbook of the ATV12's parameters, BBV51917 1.4IE05, says, typed from it by hand; no map was read."""

STATUS = 0x0C81
FACES = {"stands": 0x0000, "ramps": 0x0004, "runs": 0x0404, "reverse": 0x8404, "fault": 0x0008, "warning": 0x0000}
"""Sheet Registers, ETA: bit 2 operation enabled, 3 fault, 10 reference reached, 15 reverse rotation at output."""
CHART = 0x0073
"""Bits 0, 1, 4, 5 and 6 follow the state."""
FREQUENCY = 0x0C82
COUNTS_PER_HZ = 10
FAULT = (0x1BD1, 18)
CONTROL = "derived"
PINS = {"ManualChecked"}
BRIEF = (
    "pin 4, D1 Modbus signal; -",
    "Fr1 = Mdb, CHCF = SIM, Stt = rMP, PSt = YES, SLL = YES",
    "the motor coasts after 10.0 s",
    "a rising FaultReset",
    "36 codes",
    "250 in 2136H",
)
ALIKE = {
    ("coast_stop", "Enable operation"),
    ("coast_stop", "Fault reset"),
    ("coast_stop", "No quick stop"),
    ("coast_stop", "Reverse"),
    ("coast_stop", "Stop asked"),
    ("coast_stop", "Switch on"),
    ("fault_reset", "Fault reset"),
    ("quick_stop", "Enable voltage"),
}
PLUG = "1 reserved, 2 reserved, 3 reserved, 4 positive, 5 negative, 6 unconnected, 7 supply, 8 common"
"""The plug is that of the ATV312: BBV52816, page 8."""
WIRED = True
TERMINATION = ("120 ohm 0.25 W", "1 nF 10 V")
KEYPAD = """
FCS | COnF- | nO | nO rEC1 InI=factory InI1 | -
Fr1 | CtL- | - | AI1 LCC=remote Mdb=modbus AIU1=virtual | -
CHCF | CtL- | SIM | SIM=combined SEP=separate | -
Cd1 | CtL- | tEr | tEr=terminals LOC=local LCC=remote Mdb=modbus | -
Stt | Stt- | rMP | rMP=ramp FSt=fast nSt=freewheel | -
PSt | CtL- | YES | nO YES | -
rIn | CtL- | - | nO YES | -
Add | COM- | 0 | 0 to 247 | -
tbr | COM- | 19200 | 4800 9600 19200 38400 | -
tFO | COM- | 8E1 | 8O1 8E1 8n1 8n2 | -
ttO | COM- | 10.0 s | 0.1 to 30.0 s | 0.1 s
SLL | FLt- | YES | nO=ignored YES=freewheel LFF=fallback | -
FLO | CtL- | nO | nO | -
tCC | I_O- | 2C | 2C 3C | -
bFr | drC- | 50Hz | 50Hz 60Hz | -
ACC | rPt- | 3.0 s | 0.0 to 999.9 s | 0.1 s
dEC | rPt- | 3.0 s | 0.0 to 999.9 s | 0.1 s
tFr | drC- | - | 10.0 to 400.0 Hz | 0.1 Hz
LSP | SPL- | 0.0 Hz | 0.0 to 400.0 Hz | 0.1 Hz
HSP | SPL- | - | 0.0 to 400.0 Hz | 0.1 Hz
"""
"""Sheet Parameters, columns Display, Menu, Factory setting, Range and Units; sheet Enumerations."""
ROWS = """
2135 | CMD | rw | - | -
2136 | LFR | rw | Hz | 0.1 signed
2138 | CMI | rw | - | -
0C81 | ETA | r | - | -
0C82 | RFR | r | Hz | 0.1 signed
0C83 | FRH | r | Hz | 0.1 signed
0C84 | LCR | r | A | 0.1
0C86 | ETI | r | - | -
0C87 | ULN | r | V | 1
0C89 | THD | r | % | 1
0C8B | OPR | r | % | 1 signed
0CA8 | HMIS | r | - | -
1BD1 | LFT | r | - | -
1C20 | DP0 | r | - | -
1C21 | DP1 | r | - | -
1C22 | DP2 | r | - | -
1C23 | DP3 | r | - | -
1C24 | DP4 | r | - | -
259E | THR | r | % | 1
0BC3 | NCV | r | - | -
0CE6 | VDP | r | - | -
0C1E | SFR | rw | kHz | 0.1
0C1F | TFR | rw | Hz | 0.1
0C20 | HSP | rw | Hz | 0.1
0C21 | LSP | rw | Hz | 0.1
0C24 | RIN | rw | - | -
0BC7 | BFR | rw | - | -
1771 | ADD | rw | - | -
1773 | TBR | rw | - | -
1774 | TFO | rw | - | -
1775 | TTO | rw | s | 0.1
1B62 | SLL | rw | - | -
1F42 | FCS | rw | - | -
20D1 | CHCF | rw | - | -
20DD | FR1 | rw | - | -
20E7 | CD1 | rw | - | -
20EF | FLO | rw | - | -
2329 | ACC | rw | s | 0.1
232A | DEC | rw | s | 0.1
232B | BRA | rw | - | -
2B5D | TCC | rw | - | -
2BC1 | STT | rw | - | -
FA02 | PST | rw | - | -
"""
"""Sheet Parameters: logic address, access, units and type; R/WS, which needs a stopped motor, is rw here."""
COMMANDS = {
    "run_forward": "2135=0000 2135=0006 2135=0007 2135=000F",
    "run_reverse": "2135=0000 2135=0006 2135=0007 2135=080F",
    "stop": "2135=0007",
    "quick_stop": "2135=0002",
    "coast_stop": "2135=0000",
    "fault_reset": "2135=0000 2135=0080",
}
"""Sheet Registers, CMD: 1 of bits 0 and 3, 0 of bits 1 and 2, a rising bit 7, bit 11; 6, 7, 15 after BBV28590."""
REFERENCE = "2136 frequency"
STANDSTILL = "0C81.2=0 0C86.5=0 0C82=0"
SHOWS = {"running": "0C81.2=1", "reverse": "0C81.F=1", "at_speed": "0C81&0404=0404", "fault": "0C81.3=1"}
MEASURES = {"output_frequency": "0C82", "output_current": "0C84"}
NEEDED = {"FR1": 164, "CHCF": 1, "STT": 0, "PST": 1, "SLL": 1}
"""Sheet Enumerations: Mdb, SIM, rMP, YES, YES."""
RATES = {24: 4800, 28: 9600, 32: 19200, 36: 38400}
FORMS = {2: "8O1", 3: "8E1", 4: "8N1", 5: "8N2"}
UNIT = (1, 247, 0)
FUNCTIONS = [3, 6, 16, 43, 23]
"""Of a list after BBV28590, which has 17H and 2BH, too."""
LIMITS = {"read_words": 63, "write_words": 27}
"""The first of a list after BBV28590, the second of BBV52816, page 12."""
FAULTS = [
    3, 4, 5, 8, 9, 10, 16, 17, 18, 19, 20, 21, 22, 24, 25, 26, 27, 28, 29, 32,
    1, 23, 33, 42, 45, 51, 53, 54, 55, 56, 69, 77, 100, 101, 102, 106,
]  # fmt: skip
"""Sheet Enumerations, LFT, without 0 and 253; first those that are called the same in the Altivar 312."""
WATCHDOG = ("TTO", 100, 5)
"""0.1 s; LFT 5 is SLF1."""
