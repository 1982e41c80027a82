"""What pages of the SINAMICS V20 (07/2012) and G120C (G) say, typed from them by hand; no map was read for it."""

STATUS = 0x006D
FACES = {"stands": 0x0200, "ramps": 0x0204, "runs": 0x0304, "reverse": 0x0304, "fault": 0x0208, "warning": 0x0280}
"""Bit 2 operation enabled, 3 fault, 7 alarm, 8 deviation in tolerance, 9 master control requested; E is not used."""
CHART = 0x0001
FREQUENCY = 0x0017
COUNTS_PER_HZ = 100
FAULT = (0x0036, 18)
CODES = (1, 2, 3, 3, 4, None, None)
"""A5E03728167 page 111."""
PASSING = (3, 4, 3)
CONTROL = "in use"
PINS = {"FullScaleHz", "ManualChecked"}
BRIEF = (
    "pin 6, P+; - (D0, A of the standard) on pin 7, N-",
    "P0700 = 5, P1000 = 5, P2023 = 2",
    "with 0 the motor runs on, otherwise the drive trips",
    "a rising FaultReset",
    "13 codes",
    "8192 in 40101",
)
ALIKE = {("coast_stop", "Control via PLC")}
PLUG = "5 common, 6 positive, 7 negative"
"""A5E03728167, page 25: 5 0V, overall reference potential for RS485; 6 P+, RS485 P+; 7 N-, RS485 N-."""
WIRED = True
HELD = {"maximum_request": {15: 5000}}
KEYPAD = """
P0010 | - | 0 | - | -
P0970 | - | - | 1=user 21=factory | -
P0003 | - | 1 | - | -
P0700 | - | 1 | 1=panel 2=terminals 5=rs485 | -
P1000 | - | 1 | 1=potentiometer 5=rs485 | -
P2000 | - | - | - | 0.01 Hz
P2010 | - | 8 (07/2012) or 6 (09/2014) | 6=9600 7=19200 8=38400 12=115200 | -
P2014 | - | 0 (07/2012) or 2000 (09/2014) | - | 1 ms
P2021 | - | 1 | 1 to 247 | -
P2022 | - | 1000 | 0 to 10000 | -
P2023 | - | 1 | 1=uss 2=modbus | -
P2034 | - | 2 | 0=none 1=odd 2=even | -
P2035 | - | 1 | 1=one 2=two | -
P1080 | - | 0.00 | - | Hz
P1082 | - | 50.00 | - | Hz
P1120 | - | 10.00 s | - | 0.01 s
P1121 | - | 10.00 s | - | 0.01 s
"""
ROWS = """
0003 | - | rw | - | -
0004 | - | rw | - | -
0005 | - | rw | - | -
0006 | - | rw | - | -
0009 | P0640 | rw | % | 0.1
000A | P1120 | rw | s | 0.01
000B | P1121 | rw | s | 0.01
000F | P2000 | rw | Hz | 0.01
0017 | r0024 | r | Hz | 0.01 signed
0018 | r0022 | r | r/min | 1 signed
0019 | r0027 | r | A | 0.01
001A | r0031 | r | Nm | 0.01 signed
001B | r0032 | r | kW | 0.01
001C | r0039 | r | kWh | 1
001D | r0026 | r | V | 1
0063 | - | rw | - | -
0064 | - | rw | - | signed
006D | - | r | - | -
006E | - | r | - | signed
"""
"""Mapping table, page 112: scaling factor, by which a value is multiplied (page 115), and ranges that begin below 0."""
COMMANDS = {
    "run_forward": "0063=047E 0063=047F",
    "run_reverse": "0063=0C7E 0063=0C7F",
    "stop": "0063=047E",
    "quick_stop": "0063=047B",
    "coast_stop": "0063=047D",
    "fault_reset": "0063=047E 0063=04FE",
}
"""G pages 194, 195: ON is bit 0 rising, bits 1 to 6 and 10 are 1; 0 of bits 0, 1, 2 is OFF1, 2, 3; bit 7 rises."""
REFERENCE = "0064 fraction_of_full_scale 16384"
SHOWS = {
    "running": "006D.2=1",
    "reverse": "0017<0",
    "at_speed": "006D&0104=0104",
    "warning": "006D.7=1",
    "fault": "006D.3=1",
}
"""G page 199, ZSW1; 40024 has a sign by page 112, while bit 14 of ZSW1 says nothing at 0."""
STANDSTILL = "006D.2=0 0017=0"
NEEDED = {"P0003": 3, "P0700": 5, "P1000": 5, "P2023": 2}
"""Page 111."""
RATES = {6: 9600, 7: 19200, 8: 38400, 12: 115200}
LIMITS = {"read_words": 125, "write_words": 123}
UNIT = (1, 247, 1)
REFUSALS = [1, 2, 3, 4]
"""All of page 111."""
WATCHDOG = ("P2014", 1, 72)
"""Pages 111 and 115: ms, F72; process data alone."""
