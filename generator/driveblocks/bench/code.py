"""The numbers of the result codes, as published: what an ErrorID must be for each name of the reference model."""

from driveblocks.render.results import RESULTS

NUMBERS = {
    "OK": 0, "UNIT": 1, "FUNCTION": 2, "QUANTITY": 3, "WRAP": 4, "NOT_READABLE": 5, "NOT_WRITABLE": 6,
    "NO_BROADCAST": 7, "LENGTH": 8, "ASCII_LIMIT": 9, "SUB_FUNCTION": 10, "MODE": 11, "NOT_A_NUMBER": 12,
    "NEGATIVE": 13, "BOTH_DIRECTIONS": 14, "NO_SCALE": 15, "NOT_ABLE": 16, "NO_MAXIMUM": 17, "HELD": 18,
    "NO_FULL_SCALE": 19,
    "SILENCE": 20, "SHORT": 21, "LONG": 22, "CHECKSUM": 23, "NO_START": 24, "NO_END": 25, "ODD_DIGITS": 26,
    "NOT_HEX": 27, "NO_REQUEST": 30, "BROADCAST": 31,
    "OTHER_UNIT": 32, "OTHER_FUNCTION": 33, "BYTE_COUNT": 34, "OTHER_ADDRESS": 35, "OTHER_VALUE": 36,
    "OTHER_QUANTITY": 37, "OTHER_SUB_FUNCTION": 38, "REFUSED": 40,
    "RESTARTED": 50, "OFFLINE": 51, "TAKEN_BACK": 52, "STOP_ALL": 53, "FOREIGN": 54, "DOUBLED": 55, "SHARED": 56,
    "PORT": 57, "TIME_STANDS": 58, "UNATTENDED": 59, "REQUEST": 60, "OVERDUE": 61,
    "OWNED": 62, "LINE_SETTING": 63, "STORE_REGISTER": 64, "UNKNOWN_ADDRESS": 65, "NOT_STOPPED": 66, "RANGE": 67,
    "NOT_SENT": 68, "NO_LINE": 69, "LOST": 70, "TOO_SOON": 71, "BAD_SETTING": 72, "OTHER_DRIVE": 73, "BUSY": 74,
}  # fmt: skip

WORDS = {each.name: each.en for each in RESULTS} | {"OK": "taken"}
"""What a result means, in the comments of the test programs."""
