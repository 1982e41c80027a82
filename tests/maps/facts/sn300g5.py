"""What the manual of the SHUEN SN300G5 says, typed from it by hand, misprints corrected; no map was read for it."""

PARAMETERS = """
A1-00 0100H 操作显示语言选择|参数设置水平|控制方式选择|初始化|口令1|口令2
B1-01 0180H 频率指令选择|运行指令选择|停止方式选择|禁止反转选择|E1-09未满动作选择|顺序输入的2种读法选择
B1-07 0186H 本地/远程切换运行
B2-01 0187H 零速水平(直流制动开始频率)|直流制动电流|启动时直流制动时间|停止时直流制动时间|直流制动P倍数|直流制动积分时间
B2-07 018DH 直流制动限幅
B3-01 018EH 启动时速度追寻选择|速度追寻动作电流|速度追寻减速时间|速度追寻中的V/F
B4-01 0192H Timer功能的ON侧延迟时间|Timer功能的OFF侧延迟时间
B5-01 0194H PID控制方式选择|比例系数P|积分时间(I)|积分(I)上限值|微分时间(D)|PID上限值|PID偏置调整|PID一次延时
B6-01 019CH 启动时的DWELL频率|启动时的DWELL时间|停止时的DWELL频率|停止时的DWELL时间
B7-01 01A0H 控制系数|控制延迟时间
B8-01 01A2H 节能系数|节能频率
B9-01 01A4H 零伺服系数|零伺服终结幅度
C1-01 0200H 加速时间1|减速时间1|加速时间2|减速时间2|加速时间3|减速时间3|加速时间4|减速时间4|紧急停止时间
C1-10 0209H 加减速时间的设定单位|加减速时间的切换频率
C2-01 020BH 加速开始时的S曲线时间|加速结束时的S曲线时间|减速开始时的S曲线时间|减速结束时的S曲线时间
C3-01 020FH 滑差补偿系数|滑差校正一次延时|滑差校正限幅|再生运行中的滑差校正选择
C3-05 0242H V/F特性滑差校正
C4-01 0213H 转矩补偿系数|转矩补偿时间参数
C5-01 0215H ASR比例系数1|ASR积分系数1|ASR比例系数2|ASR积分系数2|ASR限幅|ASR一次延时|ASR切换频率
C5-08 0241H ASR积分限幅
C6-01 021CH 调制频率上限幅|调制频率下限幅|调制频率比例系数
C7-01 021FH 防乱功能选择|防乱系数|防乱时间参数|防乱时限幅
C8-01 0223H 电流反馈系数|ACRq倍数|ACRq积分时间|ACRq限幅|ACRd倍数|ACRd积分时间|ACRd限幅|AFR系数|AFR时间参数|AFR限幅
C8-11 022DH 电压DROP补偿时间参数|AVR时间参数|PWM调制方式选择||ON延时|ON延时校正值|电流检测时延时|COS检测滤波1
C8-19 0235H COS检测滤波2|试验(模拟)方式|OBSERVER选择|Observer输出相位补偿系数|Observer输出相位补偿滤波
C8-24 023AH Observer输出电压补偿系数|Observer速度检测时积分时间|Observer系数|INV额定电流|DCCT系数|PWM2相/3相切换水平
C8-30 0240H 自调谐时载波频率
D1-01 0280H 频率指令1|频率指令2|频率指令3|频率指令4|频率指令5|频率指令6|频率指令7|频率指令8|点动频率指令
D2-01 0289H 频率指令上限幅|频率指令下限幅
D3-01 028BH 设定禁止频率1|设定禁止频率2|设定禁止频率3|设定禁止频率范围
D4-01 028FH 频率指令的保持功能选择|正，负速度限幅
D5-01 0291H 转矩控制选择|转矩指令滞后时间|速度限幅选择|速度限幅|速度限幅偏置|速度/转矩控制切换时间
E1-01 0300H 输入电压设定|电机选择|V/F曲线选择|最高输出频率|最高电压|最高电压频率|中间输出频率|中间输出频率电压
E1-09 0308H 最低输出频率|最低输出频率电压|中间输出频率2|中间输出频率电压2|基准电压
E2-01 030EH 电机额定电流|电机额定滑差|电机空载电流|电机极对数|电机线间阻抗|电机漏抗|电机铁芯饱和系数1|电机铁芯饱和系数2
E2-09 0316H 电机机械损耗
E3-01 0317H 2#电机控制方式选择
E4-01 0318H 2#电机最高输出频率|2#电机最高电压|2#电机最高电压频率|2#电机中间输出频率|2#电机中间输出频率电压
E4-06 031DH 2#电机最低输出频率|2#电机最低输出频率电压
E5-01 031FH 2#电机额定电流|2#电机额定滑差|2#电机空载电流|2#电机极对数|2#电机线间阻抗|2#电机漏抗
F1-01 0380H PG参数|PG开路检测时的动作选择|超速时的动作选择|速度偏差过大检测时的动作选择|PG转向|PG分辨率
F1-07 0386H 加减速中的积分控制选择|超速检测水平|超速检测滞后时间|速度偏差过大检测水平|速度偏差过大检测滞后时间
F1-12 038BH PG齿数1|PG齿数2
F1-14 0397H PGO检测时间
F2-01 038DH AI-14B的输入功能选择
F3-01 038EH 频率指令的设定选择
F4-01 038FH 通道1的输出项目选择|通道1的输出系数|通道2的输出项目选择|通道2的输出系数
F5-01 0393H 通道1的输出选择|通道2的输出选择
F6-01 0395H 输出方式选择
F7-01 0396H 输出脉冲数选择
H1-01 0400H 端子3的功能选择|端子4的功能选择|端子5的功能选择|端子6的功能选择|端子7的功能选择|端子8的功能选择
H2-01 0406H 端子9-10的功能选择|端子25的功能选择|端子26的功能选择
H3-01 0409H 端子13的信号水平选择|端子13的输入系数|端子13的输入偏置|端子16的信号水平选择|端子16的功能选择
H3-06 040EH 端子16的输入系数|端子16的输入偏置|端子14的信号水平选择|端子14的功能选择|端子14的输入系数
H3-11 0413H 端子14的输入偏置|模拟量输入滤波时间参数
H4-01 0415H 端子21的检测输出选择|端子21的输出系数|端子21的输出偏置|端子23的检测输出选择|端子23的输出系数
H4-06 041AH 端子23的输出偏置|模拟量输出信号水平选择
H5-01 041CH 站地址|通信速度选择|通信校验选择|通信故障检测时的动作选择|超时检测
L1-01 0480H 电机保护选择|电机保护时间
L2-01 0482H 瞬停发生时的动作选择|瞬停补偿时间|最小B-B时间|电压恢复时间|欠压检测水平|KEB减速比例
L3-01 0488H 加速中失速防止功能选择|加速中失速防止水平|加速中失速防止限幅|减速中失速防止功能选择
L3-05 048CH 运行中失速防止功能选择|运行中失速防止水平|失速防止功能的P比例|失速防止功能的积分时间
L4-01 0490H 频率检测水平|频率检测幅度|频率检测水平(+/-)|频率检测幅度(+/-)|频率指令丢失时的功能选择
L5-01 0495H 故障后再试次数|故障后再试中的接点动作选择|故障后再试间隔时间
L6-01 0498H 过转矩检测动作选择1|过转矩检测水平1|过转矩检测时间1|过转矩检测动作选择2|过转矩检测水平2|过转矩检测时间2
L7-01 049EH 正转运行中的转矩限幅|反转运行中的转矩限幅|正转再生中的转矩限幅|反转再生中的转矩限幅
L7-05 04A2H 转矩限幅比例|转矩限幅积分时间
L8-01 04A4H 内装制动电阻的保护|OH预警水平|OH预警后的动作选择|OH检测水平|输入欠相保护选择|输入欠相检测水平
L8-07 04AAH 输出欠相保护选择|输出欠相检测水平|负载侧短路保护选择|对地短路保护选择|INV过载保护选择|AVR功能选择
L8-13 04B0H 出厂时的试验方式|UV3检测
O1-01 0500H 在检测方式下显示项目选择|电源投入时检测项目选择|频率指令/检测设定/显示单位|与频率相关参数的设定单位
O1-05 0504H 参数号码的表示选择
O2-01 0505H LOCAL/REMOTE键的功能选择|STOP键的功能选择|用户定义的初始值的选择|INV容量选择|频率指令的设定方法选择
O2-06 050AH 操作器断线时动作选择|累计工作时间设定|累计工作时间选择|初始化方式
"""
"""Section (V): first id and address of a run, then its names; an empty name is C8-14. A2-01..A2-32 stand below."""

USER_PARAMETERS = (0x0106, 0x0125, "A2-01", "A2-32", "用户参数设定")

ORDER = """
0100H-0185H 0196H-01A3H 0186H-0195H 01A4H-01A5H 0200H-0212H 0242H 0213H-021BH 0241H 021CH-0222H 0229H-023FH
0223H-0228H 0240H 0280H-0296H 0300H-030CH 030EH-0324H 0380H-038CH 0397H 038DH-0396H 0400H-0420H 0480H-048FH
04A4H-04AEH 0490H-04A3H 04AFH-04B1H 0500H-050DH
"""
"""The order in which section (V) prints its rows; 0126H to 017FH and the like are not listed."""

MONITORS = """
U1-01 0020H 频率指令|输出频率|输出电流|控制方式|电机速度|输出电压指令|直流电压|输出功率|转矩指令|输入端子状态：
U1-11 002AH 控制回路输出端子状态|运行状态|累计工作时间|软件号(FLASH)|外部端子13输入电压|外部端子14输入电压
U1-17 0030H 外部端子16输入电压|电机2次电流|电机励磁电流|软起动后的输出频率|ASR输入|ASR输出|速度偏差量
U1-26 0039H 输出电压指令Vq|输出电压指令Vd|软件号(CPU)
U2-01 0080H 目前发生的故障|过去的故障|故障发生时的频率指令|故障发生时的输出频率|故障发生时的输出电流
U2-06 0085H 故障发生时的电机速度
U2-07 0086H 故障发生时的输出电压|故障发生时的直流电压|故障发生时的输出功率|故障发生时的转矩指令|故障发生时输入端子状态
U2-12 008BH 故障发生时的输出端子状态|故障发生时的运行状态|故障发生时的累积工作时间
U3-01 0090H 前1次发生的故障|前2次发生的故障|前3次发生的故障|前4次发生的故障|前1次故障发生时的累积工作时间
U3-06 0095H 前2次故障发生时的累积工作时间|前3次故障发生时的累积工作时间|前4次故障发生时的累积工作时间
"""
"""Sections (II) to (IV), written like PARAMETERS."""

COMMANDS = {
    0x0000: "运行指令地址",
    0x0001: "频率给定地址",
    0x0006: "PID目标值地址",
    0x0007: "模拟量输出1的设定(-11V/-726~+11V/+726，H4-01设为1F时有效)地址",
    0x0008: "模拟量输出2的设定(-11V/-726~+11V/+726，H4-04设为1F时有效)地址",
    0x0009: "接点输出设定地址",
    0x000F: "指令选择设定地址",
}
STATUS = {
    0x0010: "变频器状态地址",
    0x0011: "操作器状态地址",
    0x0012: "OPE序号地址",
    0x0014: "故障内容1地址",
    0x0015: "故障内容2地址",
    0x0016: "故障内容3地址",
    0x0017: "CPF的内容1地址",
    0x0018: "CPF的内容2地址",
    0x0019: "轻故障内容1地址",
    0x001A: "轻故障内容2地址",
}
UNUSED = {*range(0x0002, 0x0006), *range(0x000A, 0x000F), 0x0013}
ENTER = 0xFFFD

RUNNING = """
0 1:运行中
1 1:零速中
2 1:反转中
3 1:复位信号输入中
4 1:速度一致中
5 1:INV准备完了
6 1:轻故障
7 1:重故障
"""
INPUTS = """
0 1:控制回路端子1闭合
1 1:控制回路端子2闭合
2 1:控制回路端子3闭合
3 1:控制回路端子4闭合
4 1:控制回路端子5闭合
5 1:控制回路端子6闭合
6 1:控制回路端子7闭合
7 1:控制回路端子8闭合
"""
OUTPUTS = """
0 1:控制回路端子9-10闭合
1 1:控制回路端子25闭合
2 1:控制回路端子26闭合
3-6 -
7 1:故障接点端子18闭合
"""

BITS = {
    0x0000: """
0 1:正转运行
1 1:反转运行
2 1:使外部端子3#闭合
3 1:使外部端子4#闭合
4 1:使外部端子5#闭合
5 1:使外部端子6#闭合
6 1:使外部端子7#闭合
7 1:使外部端子8#闭合
8-F -
""",
    0x0009: """
0 1:接点输出(端子9,10)闭合
1 1:PHC1(端子25,27)闭合
2 1:PHC2(端子26,27)闭合
3-5 -
6 1:故障接点(端子18,20)由第7位决定
7 1:故障接点闭合
8-F -
""",
    0x000F: """
0 0:频率/监测单位为0.01Hz1:频率/监测单位由O1-03决定
1 0:数据总线传送来的PID目标值无效1:数据总线传送来的PID目标值有效
2-B -
C 1:同时传送数据的输入端子5有效
D 1:同时传送数据的输入端子6有效
E 1:同时传送数据的输入端子7有效
F 1:同时传送数据的输入端子8有效
""",
    0x0010: """
0 1:运行中
1 1:零速
2 1:反转中
3 1:复位信号输入中
4 1:速度一致中
5 1:变频器准备完了
6 1:轻故障
7 1:重故障
8-F -
""",
    0x0011: """
0 1:OPE发生中
1 1:ERR发生中
2 1:PRG状态
3-4 1CN状态
5-F -
""",
    0x0014: """
0 FU 保险丝熔断
1 UV1 主回路欠压
2 UV2 控制回路欠压
3 UV3 MC故障
4 SC 负载短路
5 GF 对地短路
6 OC 过流
7 OV 过压
8 OH 变频器过热
9 OH1 变频器过热
A OL1 电机过载
B OL2 变频器过载
C OL3 过转矩1
D OL4 过转矩2
E RR 制动晶体管故障
F RH 制动电阻过热
""",
    0x0015: """
0 EF3 外部故障3
1 EF4 外部故障4
2 EF5 外部故障5
3 EF6 外部故障6
4 EF7 外部故障7
5 EF8 外部故障8
6 FAN 冷却风扇故障
7 OS 超速
8 DEV 速度偏差过大
9 PGO PG断线
A PF 输入缺相
B LF 输出缺相
C -
D OPR 操作器拔出
E ERR EEPROM写入不良
F -
""",
    0x0016: """
0 CE MEMOBUS通信出错
1-3 -
4 CF 控制故障
5 SVE 零伺服故障
6-F -
""",
    0x0017: """
0 -
1 -
2 CPF02 CPF02发生中
3 CPF03 CPF03发生中
4 CPF04 CPF04发生中
5 CPF05 CPF05发生中
6 CPF06 CPF06发生中
7-F -
""",
    0x0018: """
0 CPF20 CPF20发生中
1 CPF21 CPF21发生中
2 CPF22 CPF22发生中
3 CPF23 CPF23发生中
4-F -
""",
    0x0019: """
0 UV 欠压检测中
1 OV 过压检测中
2 OH 变频器过热
3 OH2 INV过热警告
4 OL3 过转矩1检测中
5 OL4 过转矩2检测中
6 EF 2线输入故障
7 BB 外部BB封锁
8 EF3 外部故障3
9 EF4 外部故障4
A EF5 外部故障5
B EF6 外部故障6
C EF7 外部故障7
D EF8 外部故障8
E FAN 冷却风扇故障
F OS 超速
""",
    0x001A: """
0 DEV 速度偏差过大
1 PGO PG断线
2 OPR 操作器拔出
3 CE MODBUS通信故障
4 -
5 -
6 OL1 电机过载
7 OL2 变频器过载
8-F -
""",
    0x0029: """
0 bit0置1控制回路端子1闭合
1 bit1置1控制回路端子2闭合
2 bit2置1控制回路端子3闭合
3 bit3置1控制回路端子4闭合
4 bit4置1控制回路端子5闭合
5 bit5置1控制回路端子6闭合
6 bit6置1控制回路端子7闭合
7 bit7置1控制回路端子8闭合
""",
    0x002A: """
0 bit0置1控制回路端子9-10闭合
1 bit1置1控制回路端子25闭合
2 bit2置1控制回路端子26闭合
3-6 -
7 bit7置1故障接点端子18闭合
""",
    0x002B: RUNNING,
    0x008A: INPUTS,
    0x008B: OUTPUTS,
    0x008C: RUNNING,
}
"""Bits of each register: bit, id where there is one, Chinese; `-` is not used. What is not listed is not printed."""

FIELDS = {
    (0x000F, 0): {0: "频率/监测单位为0.01Hz", 1: "频率/监测单位由O1-03决定"},
    (0x000F, 1): {0: "数据总线传送来的PID目标值无效", 1: "数据总线传送来的PID目标值有效"},
    (0x0011, 3): {0: "00:JVOP-130", 1: "01:JVOP-132", 2: "10:JVOP-100", 3: "11:计算机"},
}

HERTZ = {0x0001, 0x0020, 0x0021, 0x0033, 0x0082, 0x0083}
"""Frequencies: 0.01 Hz while 000FH bit 0 is 0. Nothing else has a stated scale."""

FAULTS = """
01 FU 保险丝熔断
02 UV1 主回路欠压
03 UV2 控制电源欠压
04 UV3 MC故障
05 SC 负载短路
06 GF 对地短路
07 OC 过流
08 OV 过压
09 OH INV过热
0A OH1 INV过热
0B OL1 电机过载
0C OL2 INV过负载
0D OL3 过转矩1
0E OL4 过转矩2
0F RR 制动晶体管故障
10 RH 制动电阻过热
11 EF3 外部故障3
12 EF4 外部故障4
13 EF5 外部故障5
14 EF6 外部故障6
15 EF7 外部故障7
16 EF8 外部故障8
17 FAN 冷却风扇故障
18 OS 超速
19 DEV 速度偏差过大
1A PGO PG断线
1B PF 输入欠相
1C LF 输出欠相
1E OPR 操作器拔出
1F ERR EEPROM写入不良
21 CE MODBUS通信出错
25 CF 控制故障
26 SVE 零伺服故障
"""

CPF_FAULTS = """
33 CPF02 CPF02 发生中
34 CPF03 CPF03 发生中
35 CPF04 CPF04 发生中
36 CPF05 CPF05 发生中
37 CPF06 CPF06 发生中
41 CPF20 CPF20 发生中
42 CPF21 CPF21 发生中
43 CPF22 CPF22 发生中
44 CPF23 CPF23 发生中
"""
"""Bits of 0017H and 0018H, which the table of fault numbers does not list: counted on by 16 x word + bit + 1."""

PRINTED_CODES = {0x01: "01H01H", 0x0A: "OAH", 0x0B: "OBH", 0x0C: "OCH", 0x0D: "ODH", 0x0E: "OEF", 0x0F: "OFH"}

REACTIONS = {0: "stop", 1: "quick_stop", 2: "coast_stop", 3: "runs_on"}
"""H5-04: 减速停止, 紧急停止, 自由停止, 继续运转; H5-05 = 0 (无效) switches the detection off; the fault is CE."""

SHOWS = """
running | 0010H.0 = 1
zero_speed | 0010H.1 = 1
reverse | 0010H.2 = 1
at_speed | 0010H.4 = 1
ready | 0010H.5 = 1
warning | 0010H.6 = 1
fault | 0010H.7 = 1
output_frequency | 0021H
output_current | 0022H
dc_bus_voltage | 0026H
output_power | 0027H
fault code | 0014H-0018H
"""
"""What the pins show: 运行中, 零速, 反转中, 速度一致中, 准备完了, 轻故障, 重故障 of 0010H; U1-02, U1-03, U1-07; U1-08,
which prints 输出频率 a second time; the three words of 故障内容."""

FAULT_REGISTERS = {0x0080, 0x0081, 0x0090, 0x0091, 0x0092, 0x0093}

ERRORS = {
    0x01: ("非法命令", "函数功能号出错", ["从PLC来的函数功能号不是03H,08H,10H"]),
    0x02: (
        "非法数据地址",
        "寄存器地址出错",
        ["要存取的寄存器地址一个也未登记", "同时传送的开始地址不是0000H,0001H,0002H"],
    ),
    0x03: ("个数出错", "个数出错", ["读取或写入的数据个数不在1-16之间"]),
    0x21: (
        "非法数据,或超限数据",
        "数据设定出错",
        ["控制数据或参数写入时,超出上下限幅值", "参数写入时,参数设定不良"],
    ),
    0x22: (
        "写入方式出错",
        "写入方式出错",
        [
            "运行中PLC试图写入参数",
            "运行中PLC发出ENTER写入指令",
            '"CPF03"出现后,PLC试图写入A1-00~A1-05,E1-03,O2-04以外的参数',
            "试图写入读取专用数据",
        ],
    ),
    0x23: (
        "UV中写入",
        "UV中写入",
        ['产生"UV"故障时,PLC试图写入参数', '产生"UV"故障时,PLC试图输入ENTER指令'],
    ),
    0x24: ("在参数处理中写入", "在参数处理中写入", ["在数据处理过程中,PLC试图写入参数"]),
}

SETTINGS = {
    "B1-01": (0x0180, 0, 4, "1", ["键盘", "控制回路端子", "通讯", "保留"]),
    "B1-02": (0x0181, 0, 4, "1", ["键盘", "控制回路端子", "通讯", "保留"]),
    "B1-03": (0x0182, None, None, None, []),
    "O2-01": (0x0505, None, None, None, []),
    "B1-04": (0x0183, None, None, None, []),
    "L5-01": (0x0495, None, None, None, []),
    "E1-04": (0x0303, None, None, None, []),
    "D2-02": (0x028A, None, None, None, []),
    "C1-01": (0x0200, None, None, None, []),
    "C1-02": (0x0201, None, None, None, []),
    "H5-01": (0x041C, 0, 0x20, "1F", []),
    "H5-02": (0x041D, 0, 4, "3", ["1200BPS", "2400BPS", "4800BPS", "9600BPS"]),
    "H5-03": (0x041E, 0, 2, "1", ["无校验", "偶校验", "奇校验"]),
    "H5-04": (0x041F, 0, 3, "1", ["减速停止", "紧急停止", "自由停止", "继续运转"]),
    "H5-05": (0x0420, 0, 1, "1", ["无效", "有效"]),
}

BAUD = {0: 1200, 1: 2400, 2: 4800, 3: 9600}
PARITY = {0: "none", 1: "even", 2: "odd"}

FRAMES = {
    "read_dc_bus_request": ("01 03 00 26 00 02 25 C0", "request", 0x0026, (), 2),
    "read_dc_bus_reply": ("01 03 04 02 4D 00 00 6B 9C", "reply", None, (589, 0), 2),
    "write_run_request": ("01 10 00 00 00 01 02 00 01 67 90", "request", 0x0000, (1,), 1),
    "write_run_reply": ("01 10 00 00 00 01 01 C9", "reply", 0x0000, (), 1),
    "loopback_request": ("01 08 00 00 12 AB AD 14", "request", None, (), None),
    "loopback_reply": ("01 08 00 00 12 AB AD 14", "reply", None, (), None),
    "enter_request": ("01 10 FF FD 00 01 02 00 00 BC B2", "request", 0xFFFD, (0,), 1),
}
"""Bytes, direction, address, words carried, quantity. All seven printed CRCs are right."""

ERRATA = """
setting H5-01 | 1~247 | 20H
setting H5-01 | 1F | 1FH
setting H5-05 | 传 送 | 传送
setting B1-01 | 0~4 | 0 to 4
setting B1-02 | b1-02 | B1-02
setting H5-02 | 0~4 | 0 to 4
setting H5-03 | 0 | 1
silence | 新的总是 | 新的帧
silence | T1-T2-T3-T4 | 3.5
silence | 超过 1.5 个字节 | 3.5
function 10H | 写一个字 | 16 words
function 08H | 诊断功能 | 0000H
frame read_dc_bus_reply | 0004H | 0026H
frame write_run_request | 写数起始据地址 | 写数据起始地址
frame write_run_request | 通讯启动地址 | 运行指令地址
frame enter_request | 上位 BCH | low byte BCH
serial | LRC | CRC only
serial | RS232 | RS485
prose | data_length-> | data_length-->0
prose | 6 个以上 | all bytes
prose | 查表法 | bitwise
prose | 接受的数据 | 接收的数据
prose | 建立协议 | transaction
prose | CRC 域检测了整个帧 | up to the CRC
section status | 既可读出又可写入 | read only
register 0007H | -11V/726 | -726
register 0007H | H401 | H4-01
register 0008H | H401 | H4-04
register 000AH | 000EH 未使用 000EH | 000AH
bit 000FH.0 | 由 01-03 决定 | O1-01 to O1-05
bit 000FH.0 | 0.01HZ | 0.01 Hz
bit 0011H.3-4 | 1CN 状态 | bits 3 and 4
bit 0014H.F | 8-F | register above
bit 0015H.7 | 起速 | 超速
bit 0016H.0 | MEMOBUS | Modbus
bit 0016H.6-F | F 未使用 | 未使用
bit 0017H.7-F | 7 | 7-F
bit 0018H.4-F | 4 | 4-F
bit 001AH.8-F | 8 | 8-F
bit 001AH.0 | EV 速度偏差过大 | DEV
register 0017H | CPF 的内容地址 | 内容 1
register 0027H | U1-08 输出频率 | 输出功率
register 0039H | Vg | Vq
bit 002AH.7 | bit7 故障接点 | 置 1
bit 008CH.5 | 准备完 | 准备完了
section monitors_u2 | U2 -01 | U2-01
faults | 0090~93 | 0093H
fault 01H | 01H01H | 01H
fault 0AH | OAH | 0AH
fault 0BH | OBH | 0BH
fault 0CH | OCH | 0CH
fault 0DH | ODH | 0DH
fault 0EH | OEF | 0EH
fault 0FH | OFH | 0FH
fault 0BH | 电机过热 | 电机过载
fault 0FH | 制动单元故障 | transistor
fault 03H | 控制电源欠压 | circuit
fault 1BH | 欠相 | phase loss
register 0106H | 0106H 0125H | 0106H-0125H
register 0186H | B5-03 to B8-02 before B1-07 | printed order
register 0223H | C8-07 to C8-29 before C8-01 | printed order
register 0490H | L8-01 to L8-11 before L4-01 | printed order
register 0187H | 开始频率 | )
register 018BH | B5-05 | B2-05
register 0192H | Time 功能 | Timer
register 019CH | DOWEL | DWELL
register 01A0H | 控制系数 | control gain
register 01A5H | B9-01 | B9-02
register 0220H | 0210H C7-02 | 0220H
register 0242H | 0242H C3-05 | as printed
register 0241H | 0241H C5-08 | as printed
register 0397H | 0397H F1-14 | as printed
register 0214H | 转矩补偿参数 | 时间参数
register 0221H | 防乱时参数 | 时间参数
register 022EH | AVR 时参数 | 时间参数
register 0414H | 模拟量输入时滤波参数 | 时间参数
register 022FH | 变调 | 调制
register 0230H | C8-14 | without a name
register 0231H | QN | ON
register 023BH | 积分时 | 积分时间
register 023FH | PWM2 相 | PWM 2 相
register 0240H | 自谐调试 | 自调谐
register 0383H | 检测选择 | 动作选择
register 0384H | 0384 | 0384H
register 0395H | FR6-01 | F6-01
register 041FH | 鼓掌 | 故障
register 0495H | 鼓掌否 | 故障后
register 04ACH | 保护短护 | 短路保护
register 0500H | 01-01 | O1-01
register 0505H | 02-01 | O2-09
storage | 不是用 ENTER | 不需用 ENTER
errors | 故障地址 | function code
errors | 0 0 0 0 0 1 1 | 0000 0011
errors | 接收帧时发生错误 | no reply
error 01H | 01H,08H,10H | 03H
error 02H | 存储 | 存取
error 02H | 0002H-0005H 未使用 | as printed
error 03H | 操作失败 | 个数出错
error 21H | 只有上下限幅值 | 超出上下限幅值
error 22H | 数据帧错误 | 写入方式出错
error 22H | ENINT | ENTER
error 22H | A1-00-05 | A1-00 to A1-05
error 22H | 02-04 | O2-01 to O2-09
error 23H | 参数为只读 | UV 中写入
error 23H | ENINT | ENTER
error 24H | EEPROM 繁忙 | 在参数处理中写入
fault 21H | 2 秒前 | 2 s
setting H5-05 | H5-05 设置为 0 | switches the detection off
setting H5-04 | 1：紧急停止 2：自由停止 | as printed
setting H5-01 | H5-01~03在变频器投入时设定 | H5-01 to H5-03 are taken over at power-up
bit 0014H.9 | INV 过热 | the drive
bit 001AH.7 | INV 过负载 | the drive
fault 0AH | INV 过热 | the drive
register 023DH | INV 额定电流 | the drive
register 0185H | 2 种读法 | as printed
register 0222H | 防乱时限幅 | as printed
prose | 奇偶性不变 | each character
register 0216H | ASR 积分系数 1 | integral time
register 0481H | 电机保护时间 | overload
register 0495H | 再试次数 | auto-restart
"""
"""Misprints: what each is about, a piece of what is printed, a piece of what is used."""

PRINTED_IDS = {
    0x018B: "B5-05",
    0x01A5: "B9-01",
    0x0395: "FR6-01",
    **{0x0500 + n: f"01-0{n + 1}" for n in range(5)},
    **{0x0505 + n: f"02-0{n + 1}" for n in range(9)},
}
PRINTED_ADDRESSES = {0x000A: "000EH", 0x0106: "0106H 0125H", 0x0220: "0210H", 0x0384: "0384"}
PRINTED_BITS = {
    (0x0011, 3): "3 and 4",
    (0x0017, 7): "7",
    (0x0018, 4): "4",
    (0x001A, 0): "EV",
    (0x001A, 8): "8",
}
"""What is printed for a bit's id, or for its number."""

NOTICES = """
serial | 异步串行，半双工传输方式 | half duplex
setting H5-03 | H5-01~03在变频器投入时设定 | powered up
error 22H | 运行中 PLC 试图写入参数 | Causes of error 22H
error 23H | UV"故障时,PLC 试图写入参数 | Causes of error 23H
fault 21H | 在复位信号输入 2 秒前 | 2 seconds before the reset
"""
"""Notices: what each is about, a piece of the Chinese, a piece of the English."""

CORROBORATED = {
    0x0216: ("ASR integral time 1", "系数", "a1000_manual"),
    0x0218: ("ASR integral time 2", "系数", "a1000_manual"),
    0x0481: ("Motor overload protection time", "", "t1000v_manual"),
    0x0495: ("Number of auto-restart attempts after fault", "再试", "f7_manual"),
    0x0496: ("Contact operation selection during auto-restart after fault", "再试", "f7_manual"),
    0x0497: ("Auto-restart interval after fault", "再试", "f7_manual"),
}
"""English names that say another thing than the Chinese, or more; the term that they leave; who says so."""

LITERAL = {
    0x0080: "Present fault",
    0x0185: "Selection between two ways of reading the sequence inputs",
    0x01A0: "Control gain",
    0x01A1: "Control delay time",
    0x0312: "Motor line-to-line impedance",
    0x0313: "Motor leakage reactance",
    0x0323: "Motor 2 line-to-line impedance",
    0x0324: "Motor 2 leakage reactance",
}
"""Names for which no document was found that says more: they say what the Chinese says."""

ABSENT = """
setting H5-05 | silence | CE
register 050DH | O2-09 | run command
register 0022H | scale | current
register 0026H | scale | DC bus
register 0027H | scale | power
register 0024H | unit | motor speed
setting H5-02 | H5-02 = 4 | meaning
serial | stop bits | stop
serial | reply | how long
register 0000H | reset | fault
register 0000H | jog | stop
register 0230H | C8-14 | use
section monitors_u1 | 0037H | U1-24
register 0185H | B1-06 | reading
register 0312H | impedance | resistance
register 0313H | reactance | inductance
register 01A0H | B7-01 | control
register 0216H | C5-02 | times
register 041FH | H5-04 | power-up
fault 04H | UV3 | MC
bit 0010H.1 | zero speed | standstill
broadcast | broadcast | 0002H
storage | ENTER | answers
identity | identified | capacity
watchdog | silence | CE
watchdog | restart the CE timer | own address
commanded_by | LOCAL | bus
own_maximum | scale of E1-04 | 0303H
trip_output | coasting | ramp
register 0182H | B1-03 | stops
register 0000H | reset signal | 0010H bit 3
error 22H | refused while the drive runs | 22H
"""
"""What the manual does not say: what it is about, and two words that the entry must hold."""
