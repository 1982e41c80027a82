"""What documents say of PowerFlex 523 and 525, typed from them by hand; no map was read for it."""

FACES = {"stands": 0x0401, "ramps": 0x040B, "runs": 0x050B, "reverse": 0x0503, "fault": 0x0480, "warning": 0x0401}
"""Bit 6 is not used."""
COUNTS_PER_HZ = 100
BRIEF = (
    "not known",
    "P046 = 3, P047 = 3",
    "(C125 0 = Fault) the drive trips after 5.0 s",
    "a rising FaultReset",
    "47 codes",
    "2500 in 2001H",
)
TERMINATION = ("120 ohm", "AK-U0-RJ45-TB2P")
KEYPAD = """
P041 | - | 10.00 s | 0.00 to 600.00 s | 0.01 s
P042 | - | 10.00 s | 0.00 to 600.00 s | 0.01 s
P043 | - | 0.00 Hz | 0.00 to 500.00 Hz | 0.01 Hz
P044 | - | 60.00 Hz | 0.00 to 500.00 Hz | 0.01 Hz
P045 | - | 0 | 0=ramp,_cf 1=coast,_cf 2=dc_brake,_cf 3=auto,_cf 4=ramp 5=coast 6=dc_brake 7=auto 8=em_brake,_cf\
 9=em_brake 10=point_stop,_cf 11=point_stop | -
P046 | - | 1 | 1=keypad 2=digital 3=serial/dsi 4=network 5=ethernet/ip | -
P047 | - | 1 | 1=potentiometer 2=keypad 3=serial/dsi 4=network 5=10_v 6=20_ma 7=preset 8=multiply 9=mop 10=pulse\
 11=pid1 12=pid2 13=step_logic 14=encoder 15=ethernet/ip 16=positioning | -
A541 | - | 0 | - | -
A543 | - | 0 | - | -
A544 | - | 0 | - | -
C121 | - | 0 | 0=save 1=ram | -
C122 | - | 0 | 0=velocity 1=position | -
C123 | - | 3 | 0=1200 1=2400 2=4800 3=9600 4=19200 5=38400 | -
C124 | - | 100 | 1 to 247 | -
C125 | - | 0 | 0=fault 1=coast 2=stop 3=continue | -
C126 | - | 5.0 s | 0.1 to 60.0 s | 0.1 s
C127 | - | 0 | 0=8-n-1 1=8-e-1 2=8-o-1 3=8-n-2 4=8-e-2 5=8-o-2 | -
"""
"""PowerFlex 525, lists after 520-UM001O, pages 65, 66, 102 and 103, and 520-UM001L; and a backup program."""
