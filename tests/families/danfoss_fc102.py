"""What documents say of the FC 102, typed from them by hand; no map was read for it.

The Design Guide, pages 141 and 144, and the guides MG.11.B2.02, B4.22 and C6.22 (H); the rest is in the FC 51's module.
"""

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
        "Relay 2 on",
        "Reset",
        "Reversing",
        "Set-up LSB",
        "Set-up MSB",
        "Start",
    )
} | {("fault_reset", "Reset"), ("quick_stop", "No coast stop")}
BRIEF = (
    "not known: the section on RS-485 of the design guide",
    "3-02 = 0, 8-30 = 2, 8-02 = 1",
    "As delivered (8-04 0 = Off) the motor runs on",
    "a rising FaultReset",
    "14 codes",
    "8192 in 50010",
)
KEYPAD = """
8-30 | - | - | 2=modbus | -
8-31 | - | - | 1 to 247 | -
8-32 | - | - | 3=19200 | -
8-33 | - | - | 0=even 1=odd 2=no 3=no | -
8-02 | - | - | 1=rs-485 | -
8-03 | - | 60.0 s | 1.0 to 18000.0 s | 0.1 s
8-04 | - | 0 | 0=off 1=freeze 2=stop 3=jogging 4=maximum 5=trip 7=1 8=2 9=3 10=4 | -
3-00 | - | - | 0=minimum 1=maximum | -
3-02 | - | - | - | -
3-03 | - | - | - | 0.001 Hz
4-12 | - | - | - | 0.1 Hz
"""
"""H C6.22 page 3-92, H B2.02 page 132, section 7.7."""
ROWS = """
coil 0040 | - | rw | - | -
0006 | - | r | - | -
0008 | - | rw | - | -
0419 | - | rw | - | words 2
0BD5 | - | r | Hz | 0.001 words 2
C34F | - | rw | - | -
C359 | - | rw | - | signed
C417 | - | r | - | -
C421 | - | r | - | signed
3F01 | 16-13 | r | Hz | 0.1
3F0B | - | r | A | 0.01 words 2
3FAB | 16-30 | r | V | 1
4203 | 16-90 | r | - | -
4204 | - | r | - | -
"""
COMMANDS = {
    "run_forward": "C34F=047C",
    "run_reverse": "C34F=847C",
    "stop": "C34F=043C",
    "quick_stop": "C34F=042C",
    "coast_stop": "C34F=0434",
    "fault_reset": "C34F=043C C34F=04BC",
}
"""Page 141, table 8.15: coils 3 to 6 no brake, coast, quick stop, freeze; 7 start, 8 reset, 11 valid, 16 reversing."""
REFERENCE = "C359 fraction_of_full_scale 16384"
STANDSTILL = "C417.B=0 3F01=0"
"""H B2.02 page 150: bit 11 is 1 with a start signal or an output frequency above 0 Hz."""
SHOWS = {
    "running": "C417.B=1",
    "at_speed": "C417&0900=0900",
    "ready": "C417.1=1",
    "warning": "C417.7=1",
    "fault": "C417.3=1 C417.6=1",
}
"""H B2.02 page 149: 03 trip, 06 triplock, 07 warning, 08 speed = reference, 11 in operation."""
MEASURES = {"output_frequency": "3F01", "output_current": "3F0B", "dc_bus_voltage": "3FAB"}
NEEDED = {"8-30": 2, "8-02": 1, "3-02": 0}
FUNCTIONS = [1, 3, 5, 6, 8, 11, 15, 16, 17]
"""H B4.22 pages 151 and 152."""
UNIT = (1, 247, None)
WATCHDOG = ("8-03", 100, 21)
HELD = {"maximum_request": {0x0BD6: 50000}}
CONTROL = "in use"
