"""What a name means for the motion: the field's terms for running, stopping and resetting, all in this one table."""

import re

Meaning = frozenset[str]

FORWARD, REVERSE, RUN, JOG = "forward", "reverse", "run", "jog"
STOP, COAST, QUICK, RESET = "stop", "coast", "quick", "reset"

_TERMS: dict[str, tuple[str, ...]] = {
    FORWARD: ("forward", "fwd", "clockwise", "cw", "正转", "正向", "正传", "顺时针", "前进"),
    REVERSE: (
        *("reverse", "reversing", "reversal", "rev", "backward", "counterclockwise", "counter-clockwise"),
        *("anticlockwise", "anti-clockwise", "ccw", "反转", "反向", "反传", "逆转", "逆时针", "后退"),
    ),
    RUN: ("run", "start", "turn", "rotat", "move", "运行", "运转", "启动", "起动", "旋转"),
    JOG: ("jog", "inch", "creep", "crawl", "点动", "寸动"),
    STOP: ("stop", "halt", "off", "ramp down", "ramp to zero", "停", "急停"),
    COAST: ("coast", "free", "freewheel", "自由", "惯性"),
    QUICK: ("quick", "fast", "rapid", "emergency", "快速", "迅速", "紧急", "急停"),
    RESET: ("reset", "clear", "acknowledge", "ack", "复位", "清除", "消除"),
}
_NEGATIONS = re.compile(
    r"\b(no|not|never|without|don't)\b(?!\.)|(disabl|prohibit|inhibit|forbid|prevent|block|ignor|cancel|invalid)"
    r"|\b(active|true|on) low\b|\blow[ -]active\b|\binverted\b|[不非未]|禁止|无效|取消|解除|低电平有效|低有效"
)
"""A name that holds one of these says the contrary of its terms."""


def _pattern() -> re.Pattern[str]:
    """One search for all terms, longest first; an English term begins a word, and may go on: stopped, jogging."""
    terms = sorted({term for some in _TERMS.values() for term in some}, key=len, reverse=True)
    return re.compile("|".join(_part(term) for term in terms))


def _part(term: str) -> str:
    whole = r"\b" if term in ("cw", "ccw", "rev", "ack", "off", "inch") else ""
    return rf"\b{term}{whole}" if term.isascii() else term


_FIND = _pattern()


def of(name: str, zh: str = "") -> Meaning:
    """The meanings whose terms a name holds, in English or in the manual's wording."""
    found = set(_FIND.findall(f"{name.lower()} {zh.lower()}"))
    return frozenset(meaning for meaning, terms in _TERMS.items() if found.intersection(terms))


def negated(name: str, zh: str = "") -> bool:
    """Whether a name says the contrary of its terms: `No coast stop`, `Reverse prohibited`."""
    return _NEGATIONS.search(f"{name.lower()} {zh.lower()}") is not None
