"""What documents say of 3G3MX2 and Hitachi WJ200, typed from them by hand; no map was read for it."""

STATUS = 0x2000E
FACES = {"stands": 0x0000, "ramps": 0x0001, "runs": 0x0001, "reverse": 0x0001, "fault": 0x0000, "warning": 0x0000}
"""Coil 000FH: in operation."""
FREQUENCY = 0x1001
COUNTS_PER_HZ = 100
FAULT = (0x0011, 18)
CODES = (1, 2, 3, 3, 2, None, None)
"""I585 page 6-18; of 21H to 23H the simulated drive knows nothing."""
PASSING = (3, 4, 3)
CONTROL = "derived"
PINS = {"ManualChecked"}
BRIEF = (
    "on SP; - (D0, A of the standard) on SN",
    "A001 = 03, A002 = 03",
    "C076",
    "a rising FaultReset",
    "51 codes",
    "2500 in 0001H",
)
ALIKE = {
    ("fault_reset", "Stop"),
    ("fault_reset", "Trip reset"),
    ("run_forward", "Run"),
    ("run_reverse", "Run"),
    ("stop", "Stop"),
}
PLUG = "SP positive, SN negative"
"""Starkest's library, Hitachi WJ200: SP (+), SN (-)."""
TERMINATION = ("200 ohm", "DIP switch")
HELD = {"read_trip_request": {0x12: 4, 0x14: 1234, 0x15: 300, 0x16: 2840}}
KEYPAD = """
A001 | - | - | - | -
A002 | - | - | 03=modbus | -
C071 | - | 05 | 03=2400 04=4800 05=9600 06=19200 07=38400 08=57600 09=76800 10=115200 | -
C072 | - | 1 | 1 to 247 | -
C074 | - | 00 | 00=no 01=even 02=odd | -
C075 | - | - | 01=1 02=2 | -
C076 | - | - | 00=trip 01=trip 02=ignore 03=free-run 04=decelerate | -
C077 | - | - | 0.00 to 99.99 s | 0.01 s
C078 | - | - | 0 to 1000 ms | 1 ms
C102 | - | 00 | 00=signal 03=trip | -
b001 | - | - | 00=no | -
b031 | - | - | - | -
b035 | - | - | - | -
b037 | - | - | - | -
b091 | - | - | - | -
A004 | - | - | - | Hz
A061 | - | - | - | Hz
A062 | - | - | - | Hz
F002 | - | - | - | s
F003 | - | - | - | s
"""
"""MX2: its own pages 5-100, 6-1, 6-31; WJ-C1, page 11-1-1; SJ700, pages 4-113, 4-129, B-52; names of pymx2."""
