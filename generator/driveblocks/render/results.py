"""Result codes of the blocks: one number for each way in which a request or a reply can be wrong."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Result:
    """A result code (ErrorID) with its name in templates and its texts."""

    code: int
    name: str
    en: str
    zh: str


RESULTS = (
    Result(0, "OK", "no error", "无错误"),
    # building a request
    Result(1, "UNIT", "unit address out of range", "从机地址超出范围"),
    Result(2, "FUNCTION", "the drive does not know this function", "变频器不支持此功能码"),
    Result(3, "QUANTITY", "number of registers out of range", "寄存器个数超出范围"),
    Result(4, "WRAP", "the registers run past FFFFH", "寄存器地址超过FFFFH"),
    Result(5, "NOT_READABLE", "an address may not be read", "地址不可读"),
    Result(6, "NOT_WRITABLE", "an address may not be written", "地址不可写"),
    Result(7, "NO_BROADCAST", "this request cannot be broadcast", "此请求不可广播"),
    Result(8, "LENGTH", "frame length out of range", "帧长度超出范围"),
    Result(9, "ASCII_LIMIT", "too long for an ASCII frame of this drive", "超过ASCII帧长度"),
    Result(10, "SUB_FUNCTION", "the drive does not know this sub-function", "变频器不支持此子功能码"),
    Result(11, "MODE", "the drive does not speak this mode", "变频器不支持此通讯模式"),
    # commands and references
    Result(12, "NOT_A_NUMBER", "the reference is no number", "给定值不是数"),
    Result(13, "NEGATIVE", "the reference is negative", "给定值为负"),
    Result(14, "BOTH_DIRECTIONS", "forward and reverse together", "同时给定正转和反转"),
    Result(15, "NO_SCALE", "the scale of the reference is not set", "未设定给定值比例"),
    Result(16, "NOT_ABLE", "the drive has no such command", "变频器无此命令"),
    Result(17, "NO_MAXIMUM", "the maximum frequency is not set, or makes no sense", "未设定最高频率或其值不合理"),
    Result(18, "HELD", "a run or jog pin has been TRUE since the reset; release it first",
        "复位后运行或点动信号未释放"),
    Result(19, "NO_FULL_SCALE", "the frequency that is 100 % is not set, or makes no sense",
        "未设定100%对应的频率或其值不合理"),
    # receiving a frame
    Result(20, "SILENCE", "no reply", "无应答"),
    Result(21, "SHORT", "reply too short", "应答太短"),
    Result(22, "LONG", "reply too long", "应答太长"),
    Result(23, "CHECKSUM", "wrong checksum", "校验错误"),
    Result(24, "NO_START", "no start character", "无起始符"),
    Result(25, "NO_END", "no end characters", "无结束符"),
    Result(26, "ODD_DIGITS", "odd number of characters", "字符个数为奇数"),
    Result(27, "NOT_HEX", "a character is no hexadecimal digit", "字符不是十六进制数"),
    # comparing it with the request
    Result(30, "NO_REQUEST", "there is no open request", "无等待应答的请求"),
    Result(31, "BROADCAST", "a broadcast is not answered", "广播无应答"),
    Result(32, "OTHER_UNIT", "reply of another unit", "其他从机的应答"),
    Result(33, "OTHER_FUNCTION", "reply to another function", "其他功能码的应答"),
    Result(34, "BYTE_COUNT", "byte count does not fit the request", "字节个数不符"),
    Result(35, "OTHER_ADDRESS", "reply for another address", "地址不符"),
    Result(36, "OTHER_VALUE", "reply with another value", "数据不符"),
    Result(37, "OTHER_QUANTITY", "reply for another number of registers", "寄存器个数不符"),
    Result(38, "OTHER_SUB_FUNCTION", "reply to another sub-function", "子功能码不符"),
    Result(40, "REFUSED", "refused by the drive", "变频器拒绝"),
    # the line
    Result(50, "RESTARTED", "given up by a restart", "因重新启动而放弃"),
    Result(51, "OFFLINE", "the drive does not answer", "变频器离线"),
    Result(52, "TAKEN_BACK", "taken back by a stop", "被停机命令取消"),
    Result(53, "STOP_ALL", "all drives are being stopped", "全部停机中"),
    Result(54, "FOREIGN", "another master is on the line", "总线上有其他主站"),
    Result(55, "DOUBLED", "two slots have one unit address", "从机地址重复"),
    Result(56, "SHARED", "two drive blocks, or two lines, use one slot", "同一槽位被两个功能块或两条总线使用"),
    Result(57, "PORT", "the serial port does not work", "串口故障"),
    Result(58, "TIME_STANDS", "ElapsedMs stays 0", "ElapsedMs一直为0"),
    Result(59, "UNATTENDED", "the drive block is no longer called", "驱动功能块未被调用"),
    Result(60, "REQUEST", "the line cannot send such a request", "无法发送此请求"),
    Result(61, "OVERDUE", "a stop is overdue", "停机超时"),
    # parameters
    Result(62, "OWNED", "only the drive block writes this register", "此寄存器只由驱动功能块写入"),
    Result(63, "LINE_SETTING", "the connection rests on this setting", "通讯所依赖的参数, 不可写入"),
    Result(64, "STORE_REGISTER", "only VFD_Store writes this register", "此寄存器只由VFD_Store写入"),
    Result(65, "UNKNOWN_ADDRESS", "not listed, and AllowUnknown is FALSE", "地址未列出, 且AllowUnknown为FALSE"),
    Result(66, "NOT_STOPPED", "only while the motor is known to be at standstill", "仅在确认停机后可写入"),
    Result(67, "RANGE", "value out of range", "数值超出范围"),
    Result(68, "NOT_SENT", "was not sent in time", "未能及时发送"),
    Result(69, "NO_LINE", "the line is not called", "总线功能块未被调用"),
    Result(70, "LOST", "the block was not called while it was busy", "功能块在忙时未被调用"),
    Result(71, "TOO_SOON", "too soon after the last store", "距上次保存时间太短"),
    # settings
    Result(72, "BAD_SETTING", "a setting is 65535, which switches off nothing there", "设定值65535在此处无效"),
    # the drive itself
    Result(73, "OTHER_DRIVE", "another kind of drive is at this address", "此地址上是另一种变频器"),
    Result(74, "BUSY", "the drive is busy", "变频器忙"),
    Result(75, "ABI", "drive block and line are of different versions", "驱动功能块与总线功能块版本不同"),
)  # fmt: skip
_BY_NAME = {result.name: result for result in RESULTS}


def by_name(name: str) -> Result:
    """The result of this name. Raises KeyError."""
    return _BY_NAME[name]


def code(name: str) -> int:
    """The number of a result by its name. Raises KeyError."""
    return _BY_NAME[name].code


def fail(name: str, variable: str = "ErrorID") -> str:
    """The statement that reports a result, with its text beside the number. Raises KeyError."""
    result = _BY_NAME[name]
    return f"{variable} := {result.code};" + (f" (* {result.en} *)" if result.code else "")
