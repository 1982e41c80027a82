"""What the name of a status, a measure or a reaction means: the field's terms, all in this one table."""

import re

Meaning = frozenset[str]

RUN, STOP, COAST, QUICK = "run", "stop", "coast", "quick"

_TERMS: dict[str, tuple[str, ...]] = {
    RUN: ("run", "start", "turn", "rotat", "move", "运行", "运转", "启动", "起动", "旋转"),
    STOP: ("stop", "halt", "off", "ramp down", "ramp to zero", "停", "急停"),
    COAST: ("coast", "free", "freewheel", "enable voltage", "voltage enable", "自由", "惯性"),
    QUICK: ("quick", "fast", "rapid", "emergency", "快速", "迅速", "紧急", "急停"),
}
_STANDING = ("stopped", "standby", "standstill", "待机", "停")
_MINOR = ("warning", "minor", "轻故障", "预警")
_SHOWN: dict[str, tuple[str, ...]] = {
    "running": (
        "running",
        "turning",
        "rotating",
        "moving",
        "operation enabled",
        "运行",
        "运转",
        "正转",
        "反转",
        "旋转",
    ),
    "reverse": ("reverse", "backward", "counterclockwise", "direction", "反转", "反向", "逆转", "方向"),
    "at_speed": ("at speed", "speed agree", "reached", "一致", "到达"),
    "zero_speed": ("zero speed", "零速", *_STANDING),
    "ready": ("ready", "准备", "就绪", *_STANDING),
    "warning": ("alarm", "报警", *_MINOR),
    "fault": ("fault", "trip", "alarm", "故障", "跳闸", "报警"),
    "output_frequency": ("frequency", "speed", "频率", "转速", "速度"),
    "output_current": ("current", "电流"),
    "output_voltage": ("output voltage", "motor voltage", "输出电压"),
    "dc_bus_voltage": ("dc ", "bus voltage", "dc-bus", "母线", "直流"),
    "output_power": ("power", "功率"),
    "output_speed": ("speed", "r/min", "rpm", "转速"),
    "output_torque": ("torque", "转矩", "力矩"),
    "motor_torque": ("torque", "转矩", "力矩"),
    "relative_power": ("power", "功率"),
    "drive_temperature": ("temperature", "heat sink", "heatsink", "温度"),
    "motor_temperature": ("temperature", "温度"),
    "operating_time": ("time", "hours", "时间"),
    "energy": ("energy", "kwh", "consumption", "电量", "能耗"),
    "limit": ("limit", "限"),
}
"""What manuals call that which a pin of the drive block shows."""
_WANTED = ("set ", "setting", "reference", "command", "target", "设定", "给定", "指令", "目标")
"""Words for a value that is asked for, and not measured."""
_NEGATIONS = re.compile(
    r"\b(no|not|never|without|don't)\b(?!\.)|(disabl|prohibit|inhibit|forbid|prevent|block|ignor|cancel|invalid)"
    r"|\benable voltage|\bvoltage enable"
    r"|\b(active|true|on) low\b|\blow[ -]active\b|\binverted\b|[不非未]|禁止|无效|取消|解除|低电平有效|低有效"
)
"""A name that holds one of these says the contrary of its terms: without voltage a motor coasts (CiA 402)."""


def _pattern() -> re.Pattern[str]:
    """One search for all terms, longest first; an English term begins a word, and may go on: stopped, jogging."""
    terms = sorted({term for some in _TERMS.values() for term in some}, key=len, reverse=True)
    return re.compile("|".join(_part(term) for term in terms))


def _part(term: str) -> str:
    whole = r"\b" if term == "off" else ""
    return rf"\b{term}{whole}" if term.isascii() else term


_FIND = _pattern()


def of(name: str, zh: str = "") -> Meaning:
    """The meanings whose terms a name holds, in English or in the manual's wording."""
    found = set(_FIND.findall(f"{name.lower()} {zh.lower()}"))
    return frozenset(meaning for meaning, terms in _TERMS.items() if found.intersection(terms))


def negated(name: str, zh: str = "") -> bool:
    """Whether a name says the contrary of its terms: `No coast stop`, `Reverse prohibited`."""
    return _NEGATIONS.search(f"{name.lower()} {zh.lower()}") is not None


def shown(name: str, zh: str, pins: tuple[str, ...]) -> frozenset[str]:
    """Those of some pins that something of a name can show; what is called a minor fault or a warning is no fault."""
    words = f"{name.lower()} {zh.lower()}"
    found = frozenset(pin for pin in pins if any(word in words for word in _SHOWN[pin]))
    return found - {"fault"} if any(word in words for word in _MINOR) else found


def wanted(name: str, zh: str = "") -> bool:
    """Whether a name calls a value that is asked for: it may be 0 while the motor turns."""
    words = f"{name.lower()} {zh.lower()}"
    return any(word in words for word in _WANTED)
