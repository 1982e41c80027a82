"""What documents say of the FC 51, typed from them by hand; no map was read for it.

MG.02.A4.02 pages 28, 30 and 33; the Design Guide (D), page 81; sisters and programs in use by their names.
"""

STATUS = 0xC417
FACES = {"stands": 0x0202, "ramps": 0x0A02, "runs": 0x0B02, "reverse": 0x0B02, "fault": 0x0208, "warning": 0x0282}
"""Page 28: bit 1 unit ready, 3 tripped, 7 warning, 8 on reference, 9 auto mode, B running."""
CHART = 0
FREQUENCY = 0x3F01
COUNTS_PER_HZ = 10
FAULT = (0x4204, 2)
CODES = (1, 2, 3, 3, 2, None, None)
"""Those of the FC 111, page 118; what a value out of range gets is not said there."""
PASSING = (3, 2, 3)
CONTROL = "in use"
PINS = {"FullScaleHz", "ManualChecked"}
BRIEF = (
    "not known: the section on RS-485",
    "3-02 = 0, 8-30 = 2, 8-02 = 1",
    "As delivered (8-04 0 = Off) the motor runs on",
    "a rising FaultReset",
    "14 codes",
    "8192 in 50010",
)
ALIKE = {
    ("coast_stop", each)
    for each in (
        "Data valid",
        "Jog",
        "No DC brake",
        "No freeze output",
        "No quick stop",
        "Preset reference LSB",
        "Preset reference MSB",
        "Ramp 2",
        "Relay 1 on",
        "Reset",
        "Reversing",
        "Setup 2",
        "Start",
    )
} | {("fault_reset", "Reset"), ("quick_stop", "No coast stop")}
"""A word of one bit has bit 3 at 0 and coasts, or bit 4 at 0."""
HELD = {"read_request": {0x0D5C: 3}, "maximum_request": {0x0BD6: 50000}}
KEYPAD = """
8-30 | - | - | 2=modbus | -
8-31 | - | - | 1 to 247 | -
8-32 | - | - | 3=19200 | -
8-33 | - | - | 0=even 1=odd 2=no 3=no | -
8-01 | - | - | - | -
8-02 | - | - | 1=rs-485 | -
8-03 | - | - | - | 0.1 s
8-04 | - | 0 | 0=off 1=freeze 2=stop 3=jogging 4=maximum 5=trip | -
3-00 | - | - | 0=minimum 1=maximum | -
3-02 | - | - | - | -
3-03 | - | - | - | 0.001 Hz
4-12 | - | - | - | Hz
"""
"""Settings by a course and a project that run an FC 51, 8-03 and 8-04 of the HVAC Drive, 8-33 of the VLT 2800."""
ROWS = """
coil 0040 | - | rw | - | -
0006 | - | r | - | -
0008 | - | rw | - | -
001D | 0-03 | rw | - | -
03E7 | 1-00 | rw | - | -
0BD5 | - | r | Hz | 0.001 words 2
0D5B | - | rw | - | words 2
C34F | - | rw | - | -
C359 | - | rw | - | signed
C417 | - | r | - | -
C421 | - | r | - | signed
3EE3 | 16-10 | r | - | -
3EF7 | 16-12 | r | V | 1
3F01 | 16-13 | r | Hz | 0.1
3F0B | 16-14 | r | A | 0.01
3F15 | 16-15 | r | % | 0.1
3F33 | 16-18 | r | % | 1
3FAB | 16-30 | r | V | 1
3FD3 | 16-34 | r | °C | 1
3FDD | 16-35 | r | % | 1
4203 | 16-90 | r | - | -
4204 | - | r | - | -
4217 | - | r | - | words 2
422B | - | r | - | words 2
"""
"""The template: 16099, 16119, 16129, 16139, 16149, 16179, 16299, 16339, 16349, 16899, 16919, 16939."""
COMMANDS = {
    "run_forward": "C34F=047C",
    "run_reverse": "C34F=847C",
    "stop": "C34F=043C",
    "quick_stop": "C34F=042C",
    "coast_stop": "C34F=0434",
    "fault_reset": "C34F=043C C34F=04BC",
}
"""Page 28, coils 1 to 16: bits 2 to 5 and 10 are 1, 6 starts, 7 resets, 15 reverses; 1084 of the template."""
REFERENCE = "C359 fraction_of_full_scale 16384"
STANDSTILL = "C417.B=0 3F01=0"
SHOWS = {
    "running": "C417.B=1",
    "at_speed": "C417&0900=0900",
    "ready": "C417.1=1",
    "warning": "C417.7=1",
    "fault": "C417.3=1 C417.6=1",
}
MEASURES = {"output_frequency": "3F01", "output_current": "3F0B", "dc_bus_voltage": "3FAB"}
NEEDED = {"8-30": 2, "8-02": 1, "3-02": 0}
RATES: list[int] = []
FORMS = {0: "8E1", 1: "8O1", 2: "8N1", 3: "8N2"}
FUNCTIONS = [1, 3, 5, 6, 8, 11, 15, 16, 17]
"""D page 81, table 8.19."""
REFUSALS = [1, 2, 3, 4]
FAULTS = {
    17: "Brake check",
    18: "Power card over temperature",
    19: "Earth fault",
    20: "Control card over temperature",
    21: "Control word timeout",
    22: "Torque limit",
    23: "Over current",
    24: "Motor thermistor over temperature",
    25: "Motor ETR over temperature",
    26: "Inverter overloaded",
    27: "DC link under voltage",
    28: "DC link over voltage",
    29: "Short circuit",
    30: "Inrush fault",
}
"""Bits 0 to 13 of the alarm word, MCA 121, page 46: they are in the second of two registers, so they are 17 to 30."""
LIMITS = {"read_words": 2}
UNIT = (1, 247, None)
WATCHDOG = ("8-03", 100, 21)
