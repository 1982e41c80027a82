"""What pages of the MS300's manual (appendix A) and of its sisters' say, typed from them by hand."""

CONTROL = "sister"
PINS = {"ManualChecked"}
BRIEF = (
    "not known",
    "00-20 = 1, 00-21 = 2, 00-22 = 0",
    "count on a motor that runs on",
    "a rising FaultReset",
    "49 codes",
    "2500 in 2001H",
)
HELD = {"read_request": {0x2102: 0x1770}}
ALIKE = {("fault_reset", "Reset")}
"""Commands of 2000H are whole words: bits 13 and 14 give the drive to somebody else, and none may stay as it is."""
KEYPAD = """
00-20 | - | 0 | 0=keypad 1=rs-485 2=analog 3=up 4=pulse 6=canopen 7=dial 8=card | -
00-21 | - | 0 | 0=keypad 1=terminals 2=rs-485 3=canopen 5=card | -
00-22 | - | 0 | 0=ramp 1=coast | -
01-00 | - | - | - | 0.01 Hz
01-11 | - | 0.00 Hz | - | -
01-12 | - | 10.00 s | - | -
01-13 | - | 10.00 s | - | -
09-00 | - | - | 1 to 254 | -
09-01 | - | 9600 | - | -
09-02 | - | - | - | -
09-03 | - | - | - | -
09-04 | - | 1 | 1=7n2 2=7e1 3=7o1 4 5 6 7 8 9 10 11 12=8n1 13=8n2 14=8e1 15=8o1 16=8e2 17=8o2 | -
"""
ROWS = """
2000 | - | w | - | -
2001 | - | w | Hz | 0.01
2002 | - | w | - | -
2100 | - | r | - | -
2101 | - | r | - | -
2102 | - | r | Hz | 0.01
2103 | - | r | Hz | 0.01
2104 | - | r | A | 0.01
2105 | - | r | V | 0.1
2106 | - | r | V | 0.1
2109 | - | r | - | -
210A | - | r | - | -
210B | - | r | % | -
210C | - | r | r/min | -
211F | - | r | - | -
0014 | 00-20 | rw | - | -
0015 | 00-21 | rw | - | -
0016 | 00-22 | rw | - | -
0100 | 01-00 | rw | Hz | 0.01
010B | 01-11 | rw | Hz | -
010C | 01-12 | rw | s | -
010D | 01-13 | rw | s | -
0900 | 09-00 | rw | - | -
0901 | 09-01 | rw | - | -
0902 | 09-02 | rw | - | -
0903 | 09-03 | rw | - | -
0904 | 09-04 | rw | - | -
"""
"""Pages 788 to 790 and A-12."""
COMMANDS = {
    "run_forward": "2000=0012",
    "run_reverse": "2000=0022",
    "stop": "2000=0001",
    "fault_reset": "2002=0000 2002=0002",
}
"""CP2000, page 12.1-09-8; 2002H by page 789."""
REFERENCE = "2001 frequency"
STANDSTILL = "2101.1-0=0 2103=0"
SHOWS = {
    "running": "2101.1-0=3 2101.1-0=2 2101.1-0=1",
    "reverse": "2101.4-3=3",
    "warning": "2100.F-8!=0",
    "fault": "2100.7-0!=0",
}
MEASURES = {"output_frequency": "2103", "output_current": "2104", "dc_bus_voltage": "2105", "output_voltage": "2106"}
NEEDED = {"00-20": 1, "00-21": 2, "00-22": 0}
RATES = [9600]
REFUSALS = [1, 2, 3, 4]
LIMITS = {"read_words": 7, "write_words": 20}
UNIT = (1, 254, None)
