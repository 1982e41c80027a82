"""What the manuals of MX2 and WJ200 say, typed by hand: coils from Omron's list for who replaces a 3G3JX, page 23.

That list prints the coil's number and what is sent side by side; registers are those of pages 283, 284 and 287 of I570.
"""

COILS = {
    0x01: 0x00, 0x02: 0x01, 0x03: 0x02, 0x04: 0x03, 0x07: 0x06, 0x0F: 0x0E, 0x10: 0x0F, 0x11: 0x10, 0x13: 0x12,
    0x14: 0x13, 0x15: 0x14, 0x16: 0x15, 0x17: 0x16, 0x18: 0x17, 0x49: 0x48, 0x4A: 0x49, 0x4B: 0x4A, 0x4C: 0x4B,
    0x4D: 0x4C, 0x4E: 0x4D,
}  # fmt: skip
PAIRS = (0x0001, 0x0014, 0x0018, 0x001A, 0x1001, 0x100B, 0x1015, 0x1017)
"""Numbers of the first of two registers, the high word."""
HUNDREDTHS = (0x0001, 0x0014, 0x0016, 0x1001, 0x1003, 0x100B)
STATUS_A = {0, 2, 3, 4, 5, 6, 7, 8, 9}
STATUS_B = {0, 1, 2}
STATUS_C = set(range(1, 11))
ERRORS = (0x01, 0x02, 0x03, 0x21, 0x22, 0x23, 0x31)
"""I585 page 6-18, I570 page 353."""
TRIPS = (*range(1, 16), 21, 22, 25, 30, *range(35, 39), 40, 41, 43, 44, 45, *range(50, 70), 80, 81, 83)
"""E01 and so on, as pymx2 has them."""
SILENT = {0: "trips", 1: "stop", 2: "runs_on", 3: "coast_stop", 4: "stop"}
"""C076 of SJ700, page 4-129."""
RATES = {3: 2400, 4: 4800, 5: 9600, 6: 19200, 7: 38400, 8: 57600, 9: 76800, 10: 115200}
"""C071 of WJ-C1, page 11-1-1."""
