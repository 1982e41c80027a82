"""Every word that an ST name must not be: keywords, standard functions and blocks, and what single compilers refuse."""


def _words(text: str) -> frozenset[str]:
    """The words of a text."""
    return frozenset(text.split())


# Words that shape the grammar: the parser sees them as tokens of their own, never as names.
KEYWORDS = _words(
    """
    IF THEN ELSIF ELSE END_IF CASE OF END_CASE FOR TO BY DO END_FOR WHILE END_WHILE REPEAT UNTIL END_REPEAT
    EXIT RETURN AND OR XOR NOT MOD TRUE FALSE
    FUNCTION END_FUNCTION FUNCTION_BLOCK END_FUNCTION_BLOCK PROGRAM END_PROGRAM
    TYPE END_TYPE STRUCT END_STRUCT ARRAY STRING WSTRING AT
    VAR VAR_INPUT VAR_OUTPUT VAR_IN_OUT VAR_TEMP VAR_EXTERNAL VAR_GLOBAL VAR_ACCESS VAR_CONFIG VAR_STAT VAR_INST
    END_VAR
    CONFIGURATION END_CONFIGURATION RESOURCE END_RESOURCE TASK WITH
    METHOD END_METHOD PROPERTY END_PROPERTY ACTION END_ACTION ACTIONS END_ACTIONS
    NAMESPACE END_NAMESPACE INTERFACE END_INTERFACE CLASS END_CLASS
    TRANSITION END_TRANSITION STEP INITIAL_STEP END_STEP
    """
)

# Keywords that no position of the grammar can take for a name. The others serve as names where no doubt is possible,
# so that the linter can say more than the parser could.
HARD_KEYWORDS = _words(
    """
    IF THEN ELSIF ELSE END_IF CASE OF END_CASE FOR TO BY DO END_FOR WHILE END_WHILE REPEAT UNTIL END_REPEAT
    EXIT RETURN AND OR XOR NOT MOD TRUE FALSE
    FUNCTION END_FUNCTION FUNCTION_BLOCK END_FUNCTION_BLOCK END_PROGRAM END_TYPE STRUCT END_STRUCT ARRAY
    VAR VAR_INPUT VAR_OUTPUT VAR_IN_OUT VAR_TEMP VAR_EXTERNAL VAR_GLOBAL VAR_ACCESS VAR_CONFIG END_VAR
    END_CONFIGURATION END_RESOURCE END_METHOD END_PROPERTY END_ACTION END_ACTIONS
    END_NAMESPACE END_INTERFACE END_CLASS END_TRANSITION END_STEP
    """
)

# The elementary types of table 10 with their long and short names.
ELEMENTARY_NAMES = _words(
    """
    BOOL BYTE WORD DWORD LWORD SINT INT DINT LINT USINT UINT UDINT ULINT REAL LREAL
    TIME DATE TIME_OF_DAY TOD DATE_AND_TIME DT STRING WSTRING
    """
)

# Keywords of the second edition that no position of this grammar needs, and of the third edition; as a name each of
# them stops at least one compiler. The qualifiers of actions (N, P, L, D, S, R ...) and of tasks are good names.
OTHER_KEYWORDS = _words(
    """
    ANY ANY_BIT ANY_DATE ANY_DERIVED ANY_ELEMENTARY ANY_INT ANY_MAGNITUDE ANY_NUM ANY_REAL ANY_STRING
    CONSTANT CONTINUE EN ENO F_EDGE FROM NON_RETAIN NULL ON R_EDGE READ_ONLY READ_WRITE RETAIN T
    VOID REF_TO POINTER REFERENCE THIS SUPER EXTENDS IMPLEMENTS
    LTIME LDATE LTOD LDT CHAR WCHAR
    """
)

# Names of standard functions and blocks beside those that are typed here. ROUND is a function of STruC++, which takes
# the call of a block of that name for a call of this function.
STANDARD_NAMES = _words(
    """
    TRUNC ROUND ADD_TIME SUB_TIME CONCAT_DATE_TOD DERIVATIVE HYSTERESIS INTEGRAL PID RAMP
    """
)

# What the C headers that matiec includes define without an underscore in front, and names it puts into every structure.
C_MACROS = _words(
    """
    BIG_ENDIAN BUFSIZ BYTE_ORDER CHAR_BIT DECIMAL_DIG EN_ENO EN_ENO_PARAMS EOF EPOCH_YEAR EXIT_FAILURE EXIT_SUCCESS
    FD_SETSIZE FILENAME_MAX FOPEN_MAX HUGE_VAL HUGE_VALF HUGE_VALL INFINITY LITTLE_ENDIAN NAN NULL
    CLOCKS_PER_SEC HOST_NAME_MAX LINE_MAX LOGIN_NAME_MAX MATH_ERREXCEPT MATH_ERRNO MAX_CANON MAX_INPUT MB_CUR_MAX
    MB_LEN_MAX NAME_MAX NFDBITS PATH_MAX PDP_ENDIAN PIPE_BUF RAND_MAX SECONDS_PER_DAY SECONDS_PER_HOUR
    SECONDS_PER_MINUTE STR_MAX_LEN TIMER_ABSTIME TIME_UTC TMP_MAX
    """
)

# Parameters and variables of the standard functions and blocks in matiec's library: a type, function, block or program
# of the same name makes that library unreadable for it.
LIBRARY_VARIABLES = _words(
    """
    AUTO BUSY CD CDT CD_T CLAIM CLK CU CURRENT_TIME CU_T CV CYCLE DTERM EPS ERROR ET G IN IN0 IN1 IN2 ITERM K KP L LD M
    MN MX N OFFSET P PDT PREV_IN PT PV Q Q1 QD QU Q_INTERNAL R R1 RELEASE RUN S S1 SP START_TIME STATE T TD TR X0 X1 X2
    X3 XI XIN XIN1 XIN2 XOUT
    """
)

LONGEST = 31
"""Characters of a name that is safe on every target: systems differ widely, and the shortest limits are the oldest."""

# Operators of Instruction List, and names that both CODESYS and TwinCAT keep (lists of keywords in the CODESYS and
# Beckhoff manuals; compiler message C0543).
_CODESYS = _words(
    """
    ABSTRACT ADR ANDN ANY_CHAR ANY_CHARS ANY_DURATION ANY_SIGNED ANY_UNSIGNED ATAN2 BIT BITADR CAL CALC CALCN CHAR_TO
    FINAL INDEXOF INI INTERNAL JMP JMPC JMPCN LD LDN ORN OVERRIDE PARAMS PERSISTENT PRIVATE PROTECTED PUBLIC PVOID
    QUERYINTERFACE R RET RETC RETCN S SIZEOF ST STN TO_CHAR TO_WCHAR UNION USING UXINT WCHAR_TO XADD XINT XORN XWORD
    """
)

# Reserved words of S7-SCL and types of TIA Portal that no other list has, as commonly known; no list was at hand.
_SIEMENS = _words(
    """
    ANY_TYPE AUTHOR BEGIN BLOCK_DB BLOCK_FB BLOCK_FC BLOCK_SDB BLOCK_SFB BLOCK_SFC CONST COUNTER DATA_BLOCK DB_ANY DTL
    END_CONST END_DATA_BLOCK END_LABEL END_ORGANIZATION_BLOCK END_REGION FAMILY GOTO KNOW_HOW_PROTECT LABEL NAME NIL OK
    ORGANIZATION_BLOCK REGION S5TIME TIMER TITLE VARIANT VERSION
    """
)

TARGET_WORDS = {
    "openplc": _words("CONFIG0 RES0"),  # configuration and resource, by which the runtime names its C files
    "beremiz": _words(""),
    "codesys": _CODESYS,
    "twincat": _CODESYS,
    "siemens": _SIEMENS,
}
"""Target -> what it keeps beside the words above."""
