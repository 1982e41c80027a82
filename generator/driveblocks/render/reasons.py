"""Why a drive does not run, as a number: the pin `Reason` of every drive block."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Reason:
    """A reason with its name in templates, its texts, and what to do about it."""

    code: int
    name: str
    en: str
    zh: str
    remedy: str
    without: str = ""
    """What to do at a drive that takes no fault reset over the bus, where that is something else."""


REASONS = (
    Reason(0, "RUNS", "runs as asked", "按要求运行", "nothing"),
    Reason(1, "READY", "stopped; a rising run or jog pin starts it", "已停机，等待启动信号", "nothing"),
    Reason(2, "RAMPING", "on its way to the reference", "加减速中", "wait"),
    Reason(3, "STARTING", "the start is on its way to the drive", "正在启动", "wait"),
    Reason(4, "STOPPING", "waits until the drive proves standstill", "正在停机", "wait; see `StopOverdue`"),
    Reason(5, "RESETTING", "the fault reset is on its way", "正在复位故障", "wait"),
    Reason(6, "RELEASED", "the run or jog pin was released", "运行信号已撤除", "nothing; only `StopReason` shows it"),
    # the line
    Reason(10, "RESTARTED", "Restart is TRUE", "Restart为真",
        "wire `Restart` of the line to the first-scan bit, not to TRUE"),
    Reason(11, "NO_LINE", "no line block serves the slot", "槽位无总线服务",
        "call the line in every scan, with this `Slots`"),
    Reason(12, "NO_SUPPLY", "the drive has no supply", "变频器未上电", "clear `SupplyOff` when the supply is on"),
    Reason(13, "NO_REPLY", "no reply yet", "尚无应答",
        "cable, A/B, bit rate, format, unit address, the drive's settings"),
    Reason(14, "OFFLINE", "the drive has stopped answering", "变频器离线",
        "cable, supply; the counters of the slot say more"),
    Reason(15, "LINE", "the line reports an error", "总线故障", "see `LineErrorID` of the slot"),
    Reason(16, "FOREIGN", "another master is on the line", "总线上有其他主站", "find it, then acknowledge at the line"),
    Reason(17, "SHARED", "two drive blocks use this slot", "同一槽位被两个功能块使用", "give one of them another slot"),
    Reason(18, "LATE_SCAN", "a scan of the last 10 s took longer than MaxScanMs", "最近10秒内扫描周期超过MaxScanMs",
        "it bars no start, but the figures of the stop do not hold: "
        "raise `MaxScanMs` of the line, or shorten the task"),
    Reason(19, "HEARTBEAT", "the refresh is slower than the watchdog of the drive allows", "刷新慢于通讯超时",
        "fewer drives, a higher bit rate, or a longer watchdog"),
    # what the user asks
    Reason(20, "DISABLED", "Enable is FALSE", "未使能", "set `Enable`"),
    Reason(21, "STOP_PIN", "QuickStop or CoastStop is TRUE", "快速停机或自由停机信号有效", "release it"),
    Reason(22, "STOP_ALL", "all drives of the line are being stopped", "全部停机中", "release `StopAll` of the line"),
    Reason(23, "BOTH", "forward and reverse together", "同时给定正转和反转", "release one, then start again"),
    Reason(24, "HELD", "a run or jog pin has been TRUE since before", "运行信号一直保持",
        "release all run and jog pins, then set one"),
    Reason(25, "NOT_ABLE", "the drive has no such command", "变频器无此命令", "see `Diagnosis.Can...`"),
    Reason(26, "MONITOR", "reads only", "仅监视", "start, stop and reset at the drive, or release `MonitorOnly`"),
    Reason(27, "SPEED_ONLY", "the terminals of the drive start and stop it", "由端子控制启停",
        "start, stop and reset at the drive, or release `SpeedOnly`"),
    Reason(28, "STALE", "the status is older than StaleMs", "状态数据过期",
        "fewer drives, a higher bit rate, or a longer `Settings.StaleMs`"),
    Reason(29, "SLOW_LINE", "the status is older than half of StaleMs", "总线刷新过慢",
        "fewer drives, a higher bit rate, or a longer `Settings.StaleMs`, before it stops the motor"),
    # what is missing
    Reason(30, "MISSING", "a required setting is missing", "缺少必要参数",
        "`StopWithinMs` or `Address`, or a setting is 65535: see `ErrorID` and the page"),
    Reason(31, "UNCHECKED", "nobody has checked the map with the manual", "映射未与手册核对",
        "check it, then set `ManualChecked` to the number that the page prints"),
    Reason(32, "REFERENCE", "the reference is no number, negative, or without a scale or a limit", "给定值无效",
        "see `ErrorID`"),
    Reason(33, "SETTING", "a setting of the drive gives the reference another meaning", "变频器参数设置不符",
        "correct the setting that the page names"),
    Reason(34, "UNREAD", "the settings of the drive are not read yet", "参数尚未读取", "wait"),
    Reason(35, "WRITE_WAITS", "a parameter is being written", "正在写参数", "wait, then start again"),
    # the drive
    Reason(40, "FAULT", "fault: see FaultCode", "故障，见FaultCode",
        "remove the cause, then a rising `FaultReset`; with `SpeedOnly` or `MonitorOnly` reset at the drive",
        "remove the cause; the bus cannot reset it, and `FaultReset` is refused: what the manual says of it is listed "
        "under [gaps](#what-the-manual-does-not-say)"),
    Reason(41, "NOT_READY", "the drive is not ready", "变频器未就绪", "its own enable, its terminals, its keypad"),
    Reason(42, "NO_REFERENCE", "the drive did not acknowledge the reference", "给定值未确认",
        "the counters of the slot say why"),
    Reason(43, "NO_RUN", "the drive did not acknowledge the run command", "运行命令未确认",
        "the counters of the slot say why"),
    Reason(44, "REFUSED", "the drive refused the command", "变频器拒绝命令",
        "`RefusedAddress` and `RefusedReason` of the slot"),
    Reason(45, "NOT_FOLLOWED", "the drive acknowledged the command and does not run", "变频器未执行命令",
        "is it set to obey the bus?"),
    Reason(46, "BY_ITSELF", "the drive ran or stopped without a command of this block", "变频器自行启停",
        "keypad, terminals, STO, automatic restart"),
    Reason(47, "NOT_STOPPED", "a start came before StopConfirmed", "停机确认前给出启动信号",
        "release the run pin, wait for `StopConfirmed`, then start again"),
    Reason(48, "NO_RESET", "no reset was sent, or the drive did not take it", "复位未发出，或变频器未接受",
        "release the run pins, remove the cause, then a rising `FaultReset`; "
        "none is sent with `SpeedOnly` or `MonitorOnly`",
        "`FaultReset` was pressed: this drive takes none over the bus"),
    Reason(49, "READ_REFUSED", "the drive refuses to be read", "变频器拒绝读取",
        "`RefusedAddress` and `RefusedReason` of the slot: another model, or a register that it does not have"),
    Reason(50, "OTHER_DRIVE", "another kind of drive is at this address", "此地址上是另一种变频器",
        "see `Diagnosis.IdentityRead`: the right drive or the right block, then another `Address` or a restart"),
    Reason(51, "OTHER_MAXIMUM", "the maximum frequency of the drive itself is not FullScaleHz",
        "变频器最高频率与FullScaleHz不一致",
        "`Diagnosis.OwnMaximumHz`: set `FullScaleHz`, or the drive, to what is right for the motor"),
    Reason(52, "LATE_REPLIES", "replies come too late: raise PortLateMs, or look at the gateway",
        "应答过迟：增大PortLateMs或检查网关",
        "`Diagnosis.LongestReplyMs` is how long they took; `PortLateMs` has to cover what port, adapter and gateway "
        "add in both directions together, `Settings.TurnRoundMs`, where it is set, the drive's own time"),
    Reason(53, "OTHER_VERSION", "line and drive block are of different versions", "总线功能块与驱动功能块版本不同",
        "load all blocks of one version, and restart"),
    Reason(54, "LEARNING", "it is not known yet how fast the drive answers", "正在测定变频器应答时间",
        "wait until it has answered 20 times, or set `Settings.TurnRoundMs`"),
    Reason(55, "TOO_SLOW", "the line is too slow: ReadMs is above StaleMs", "总线过慢：ReadMs大于StaleMs",
        "`Diagnosis.ReadMs` and `Diagnosis.StaleMs` are the figures: fewer drives, a higher bit rate, a shorter "
        "`Settings.TurnRoundMs`, or a longer `Settings.StaleMs`"),
    Reason(56, "MAY_BE_LATE", "ready; if other drives fail, the status may become too old",
        "就绪；其他变频器故障时状态可能过期",
        "it bars no start; `Diagnosis.WorstReadMs` is above `Diagnosis.StaleMs`: fewer drives, a higher bit rate, "
        "`SupplyOff` where supplies fail together, or a longer `Settings.StaleMs`"),
    Reason(57, "MAY_STARVE", "ready; if other drives fail, the watchdog of the drive may trip",
        "就绪；其他变频器故障时通讯超时保护可能动作",
        "it bars no start; `WorstFeedMs` of the slot is above two thirds of `Settings.WatchdogMs`: fewer drives, a "
        "higher bit rate, or a longer watchdog"),
    Reason(58, "UNPROVED", "standstill is not proved: another master reads this drive",
        "停机未证实：另有主站读取此变频器",
        "nothing starts; switch that master off, or let it ask less often: between two of its requests there has to be "
        "time for one of ours"),
    Reason(59, "NO_FAULT", "there is no fault to reset", "无故障可复位",
        "nothing; it is shown while `FaultReset` is TRUE"),
    Reason(60, "FAULT_BACK", "the fault is there again after the reset", "复位后故障再次出现",
        "remove the cause, then a rising `FaultReset`"),
    Reason(61, "FORBIDDEN", "the drive shows what forbids a start: see its page", "变频器状态禁止启动，见说明页",
        "the page of the drive block says what and why; end it, then start again"),
)  # fmt: skip
_BY_NAME = {reason.name: reason for reason in REASONS}

STATES = (
    ("stopping", "正在停机"),
    ("stopped", "已停机"),
    ("reference sent", "已发送给定值"),
    ("command sent", "已发送运行命令"),
    ("running", "运行中"),
    ("reads only", "仅监视"),
    ("speed only", "仅给定速度"),
)
"""State of VFD_Control -> its name in English and in Chinese."""


def by_name(name: str) -> Reason:
    """The reason of this name. Raises KeyError."""
    return _BY_NAME[name]
