"""What chapter 11 of the INVT CHF manual says, typed from it by hand, misprints corrected; no map was read for it."""

REGISTERS = {
    0x1000: ("通讯控制命令", "rw"),
    0x1001: ("变频器状态", "r"),
    0x2000: ("通讯设定值地址", "rw"),
    0x3000: ("运行频率", "r"),
    0x3001: ("设定频率", "r"),
    0x3002: ("母线电压", "r"),
    0x3003: ("输出电压", "r"),
    0x3004: ("输出电流", "r"),
    0x3005: ("运行转速", "r"),
    0x3006: ("输出功率", "r"),
    0x3007: ("输出转矩", "r"),
    0x3008: ("PID给定值", "r"),
    0x3009: ("PID反馈值", "r"),
    0x300A: ("端子输入标志状态", "r"),
    0x300B: ("端子输出标志状态", "r"),
    0x300C: ("模拟量AI1值", "r"),
    0x300D: ("模拟量AI2值", "r"),
    0x300E: ("保留", "r"),
    0x300F: ("保留", "r"),
    0x3010: ("高速脉冲频率(HDI)", "r"),
    0x3011: ("保留", "r"),
    0x3012: ("PLC及多段速当前段数", "r"),
    0x3013: ("长度值", "r"),
    0x3014: ("外部计数器输入值", "r"),
    0x5000: ("变频器故障地址", "r"),
    0x5001: ("ModBus通讯故障地址", "r"),
}

RESERVED = {0x300E, 0x300F, 0x3011}

ERRORS = {
    1: "密码错误",
    2: "命令码错误",
    3: "CRC校验错误",
    4: "非法地址",
    5: "非法数据",
    6: "参数更改无效",
    7: "系统被锁定",
    8: "变频器忙（EEPROM正在存储中）",
}

VALUES = {
    0x1000: {
        1: "正转运行",
        2: "反转运行",
        3: "正转点动",
        4: "反转点动",
        5: "停机",
        6: "自由停机(紧急停机)",
        7: "故障复位",
        8: "点动停止",
    },
    0x1001: {1: "正转运行中", 2: "反转运行中", 3: "变频器待机中", 4: "故障中"},
    0x5001: {0: "无故障", **ERRORS, 8: "变频器忙(EEPROM正在存储中)"},
}

COMMANDS = {
    "run_forward": 1,
    "run_reverse": 2,
    "jog_forward": 3,
    "jog_reverse": 4,
    "stop": 5,
    "coast_stop": 6,
    "fault_reset": 7,
    "jog_stop": 8,
}

SHOWS = """
running | 1001H = 1, 1001H = 2
reverse | 1001H = 2
fault | 1001H = 4
output_frequency | 3000H
dc_bus_voltage | 3002H
output_voltage | 3003H
output_current | 3004H
output_power | 3006H
fault code | 5000H
"""
"""What the pins show: the words of 1001H, 运行频率, 母线电压, 输出电压, 输出电流, 输出功率; the fault's number."""

FRAMES = {
    "read_rtu_request": ("01 03 00 04 00 02 85 CA", 1, 0x0004, ()),
    "read_rtu_reply": ("01 03 04 00 00 00 00 FA 33", 1, None, (0, 0)),
    "read_ascii_request": (":010300040002F6", 1, 0x0004, ()),
    "read_ascii_reply": (":01030400020000F6", 1, None, (2, 0)),
    "write_rtu_request": ("02 06 00 08 13 88 05 6D", 2, 0x0008, (5000,)),
    "write_rtu_reply": ("02 06 00 08 13 88 05 6D", 2, 0x0008, (5000,)),
    "write_ascii_request": (":02060008138855", 2, 0x0008, (5000,)),
    "write_ascii_reply": (":02060008138855", 2, 0x0008, (5000,)),
    "error_rtu_reply": ("01 06 50 01 00 05 09 09", 1, 0x5001, ()),
    "error_ascii_reply": (":010650010005A3", 1, 0x5001, ()),
}
"""Correct bytes, or characters before CR LF; unit; address; words carried."""

WRONG_CRC = ("read_rtu_reply", "01 03 04 00 00 00 00 43 07", "01 03 00 04 00 00 00 00")
"""The one frame with a wrong checksum: as printed, and the bytes that its CRC belongs to."""

ERRATA = """
frame read_rtu_reply | 43H 07H | FAH 33H
frame read_ascii_reply | 0002H in the ASCII | as printed
frame read_ascii_request | LRC CHK Lo ‘F’ | high digit is F
frame read_rtu_request | 0004 | 0004H
serial | ‘.’ (0x3A) | ':'
serial | 功能码: 8-bit 地址 | function code
serial | LRC CHK Lo above LRC CHK Hi | high digit first
serial | END Lo CR | CR first
serial | 7 或 8 个数据位 | RTU 8
serial | 字符和 | sum of the bytes
serial | RS232 | RS-485
serial | 检查码 | LRC
area function_codes | 功能码 | parameter
area function_codes | 00~01 | 80 to 81
silence | T1-T2-T3-T4 | 3.5
silence | 1.5 个字节 | 3.5
limit ascii_data_bytes | n<=16 | 16 data bytes
prose | 她 | 它
prose | International Interchange | Information Interchange
prose | 新的总是 | 新的帧
prose | 位元组 | 4 bits
prose | 6 个以上 | every byte
prose | 查表法 | bitwise
prose | 这种方程序 | 这种方法程序
prose | 的的 | 的校验码
prose | 接受的数据 | 接收的数据
prose | 奇偶性不变 | each character
register 1000H | 紧急停机 | coast stop
register 1001H | empty | four values
register 3014H | 3014H in the column | 3014H
error 3 | CRC 校验错误 | no PLC
error 3 | CRC 校验错误 | LRC in ASCII
errors | 国际标准 | not that of Modbus
"""

NOTICES = """
serial | 异步串行，半双工传输方式 | half duplex
serial | 大写字母 | capital
"""

ABSENT = """
serial | bit rate | codes
serial | turn-round | request
serial | lost | time
area function_codes | list of function codes | sequence numbers
register 2000H | negative | reference
setting P0.04 | P0.04 | maximum frequency
setting P0.04 | P0.07 | 0004H
register 3000H | scale | 3000H
register 3004H | scale | current
register 1001H | values | 1001H
faults | fault codes | causes
storage | EEPROM | writes
watchdog | communication is lost | frames
identity | recognised | register
commanded_by | bus is in command | keypad
own_maximum | register of P0.04 | scale
trip_output | coasting | ramp
"""
