"""What the JSCC manual says, typed from it by hand, misprints corrected; no map was read for it."""

REGISTERS = {
    0x1000: ("对驱动器的命令", "w"),
    0x1001: ("频率指令给定", "w"),
    0x1002: ("PID目标值给定", "w"),
    0x2000: ("实时输出频率读取", "r"),
    0x2001: ("变频器当前状态读取", "r"),
    0x3000: ("故障类型读取", "r"),
}

VALUES = {
    0x1000: {0: "无功能", 1: "正转", 2: "反转", 3: "运转停止"},
    0x2001: {1: "正转运行中", 2: "反转运行中", 4: "停机中", 8: "故障"},
    0x3000: {
        0: "无异常",
        1: "EEPROM异常",
        2: "大幅度过电流",
        3: "过电流",
        4: "电流不平衡",
        5: "减速过电压",
        6: "输入缺相",
        7: "低电压",
        8: "过热",
        9: "通讯异常",
        10: "电机过载热保护",
        11: "AD2模拟量断线",
        12: "自学习失败",
    },
}

FAULTS = {code: text for code, text in VALUES[0x3000].items() if code}

COMMANDS = {"run_forward": 1, "run_reverse": 2, "stop": 3}

SHOWS = """
running | 2001H AND 1 = 1, 2001H AND 2 = 2
reverse | 2001H AND 2 = 2
fault | 2001H AND 8 = 8
output_frequency | 2000H
fault code | 3000H
"""
"""What the pins show: 01, 02, 08 of 2001H, which may be bits that combine; 实时输出频率; 故障类型."""

SETTINGS = {
    "F0.04": (
        "1",
        4,
        ["FWD、REV输入端口，上电不可直接运转", "FWD、REV输入端口，上电可直接运转", "变频器操作面板", "RS-485"],
    ),
    "F0.08": (
        "1",
        8,
        [
            "变频器操作面板按钮",
            "模拟量输入端口AD10~10V",
            "模拟量输入端口AD2",
            "AD1和AD2模拟量函数组合",
            "M1多功能输入端口0~1KHz高速脉冲",
            "菜单F7组PLC功能控制",
            "菜单F9组PID控制",
            "RS-485",
        ],
    ),
    "FA.00": ("1", None, []),
    "FA.01": ("3", None, ["4800bps", "9600bps", "19200bps", "38400bps", "57600bps"]),
    "FA.02": ("2", None, ["<8,N,1>", "<8,E,1>", "<8,O,1>", "<8,N,2>", "<8,E,2>", "<8,O,2>"]),
    "FA.03": ("2", None, ["ASCII模式", "RTU模式"]),
}
"""Factory setting, the value that the bus needs, and the texts of the values from 1 on."""

BAUD = {1: 4800, 2: 9600, 3: 19200, 4: 38400, 5: 57600}
FORMAT = {
    1: (8, "none", 1),
    2: (8, "even", 1),
    3: (8, "odd", 1),
    4: (8, "none", 2),
    5: (8, "even", 2),
    6: (8, "odd", 2),
}
MODE = {1: "ascii", 2: "rtu"}

ERRORS = [
    "不合法功能代码",
    "不合法数据地址",
    "不合法数据",
    "从机设备故障",
    "确认",
    "从机设备忙碌",
    "否定",
    "内存奇偶校验错误",
]
"""In the manual's order; its column of codes is empty."""

FRAMES = {
    "run_forward_rtu_request": ("01 06 10 00 00 01 4C CA", 0x1000, (1,)),
    "run_forward_rtu_reply": ("01 06 10 00 00 01 4C CA", 0x1000, (1,)),
    "run_forward_ascii_request": (":010610000001E8", 0x1000, (1,)),
    "run_forward_ascii_reply": (":010610000001E8", 0x1000, (1,)),
    "read_frequency_rtu_request": ("01 03 20 00 00 01 8F CA", 0x2000, ()),
    "read_frequency_rtu_reply": ("01 03 02 01 F4 B8 53", None, (500,)),
    "read_frequency_ascii_request": (":010320000001DB", 0x2000, ()),
    "read_frequency_ascii_reply": (":01030201F405", None, (500,)),
}
"""Bytes, or characters before CR LF; address; words carried. All eight printed checksums are right."""

TABLES = {
    "run_forward_rtu_request": ("D0", 8, "01 06 10 00 00 01 4C CA", None),
    "run_forward_rtu_reply": ("D10", 8, "01 06 10 00 00 01 4C CA", None),
    "run_forward_ascii_request": ("D0", 16, "3A30 3130 3631 3030 3030 3030 3145 380D 0A--", None),
    "run_forward_ascii_reply": ("D10", 16, "3A30 3130 3631 3030 3030 3030 3145 380D 0A--", None),
    "read_frequency_rtu_request": ("D0", 8, "01 03 20 00 00 01 8F CA", None),
    "read_frequency_rtu_reply": ("D10", 8, "01 03 02 01 F4 B8 53", None),
    "read_frequency_ascii_request": ("D0", 16, "3A30 3130 3332 3030 3030 3030 3144 420D 0A--", (2, "3631")),
    "read_frequency_ascii_reply": ("D10", 16, "3A30 3130 3330 3230 3146 3430 350D 0A--", (2, "3630")),
}
"""First register, width, contents, and the one register that is printed otherwise."""

ERRATA = """
serial | ' ' (3AH) | ':'
serial | 4bit 起始字符 | 8 data bits
serial | 命令码: 8bit 地址 | function code
serial | LRC 检验值: 8bit 地址 | LRC
serial | 检验值 | 校验值
serial | 停止位: 1bit | 2 stop bits
serial | 端子定义如下 | no terminals
limit ascii_data_bytes | n<=50 | 25 data bytes
area drive_parameters | F-18 | example
register 3000H | 07: 低电压 | values of 3000H
register 3000H | 09: 通讯异常 | values of 3000H
register 3000H | 10: 电机过载热保护 | decimal
frame read_frequency_ascii_request | 3 36h, 2 31h | 3 33h, 2 32h
frame read_frequency_ascii_request | 取寄存器起始地址 | 读取寄存器起始地址
frame read_frequency_ascii_request | D8 | D8 low
frame read_frequency_ascii_reply | 3 36h | 3 33h
frame read_frequency_ascii_reply | D21 | D12
frame read_frequency_rtu_request | PLC 接收数据寄存器值 | first table
frame run_forward_ascii_request | D2 功能码 | D1 low
errors | empty | no codes
errors | 不能执行功能代码 | 不能执行的功能代码
"""

NOTICES = """
serial | 41H | capital
setting F0.04 | 上电可直接运转 | direct start
"""

ABSENT = """
register 1001H | scale | 1001H
errors | error reply | wire
errors | numbers | codes
serial | turn-round | request
serial | lost | time
storage | EEPROM | write
register 2001H | combine | values
operation | fault is reset | bus
watchdog | communication is lost | frames
identity | recognised | register
commanded_by | bus is in command | keypad
own_maximum | maximum frequency | scale
trip_output | coasting | ramp
broadcast | broadcast | obeys
"""
