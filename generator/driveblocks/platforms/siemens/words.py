"""What SCL calls the things of ST, as far as both mean the same; what is not in here is refused."""


def _words(text: str) -> dict[str, str]:
    """The words of a text by their upper-case form."""
    return {word.upper(): word for word in text.split()}


ELEMENTARY = _words("Bool Byte Word DWord SInt Int DInt USInt UInt UDInt Real LReal Time")
"""Elementary types that an S7-1200 has, too."""
SYSTEM = _words("PORT Send_P2P Receive_P2P Receive_Reset Modbus_Comm_Load Modbus_Master R_TRIG F_TRIG")
"""Types and blocks of the PLC itself: they are written without quotes. No version, so that TIA Portal takes its own."""
SYSTEM |= {"TON": "TON_TIME", "TOF": "TOF_TIME", "TP": "TP_TIME"}
STANDARD_ACCESS = frozenset({"MODBUS_MASTER"})
"""Instructions that work on memory of a block: it must not have optimized access."""
FORMAL = {
    "SHL": ("IN", "N"),
    "SHR": ("IN", "N"),
    "MIN": ("IN1", "IN2"),
    "MAX": ("IN1", "IN2"),
    "LIMIT": ("MN", "IN", "MX"),
}
"""Standard function -> its parameters, which SCL wants named."""
UNNAMED = frozenset({"ABS", "RUNTIME"})
"""Functions with one parameter, which has no name."""

_BITS = frozenset({"BYTE", "WORD", "DWORD"})
_INTEGERS = frozenset({"SINT", "INT", "DINT", "USINT", "UINT", "UDINT"})
_REALS = frozenset({"REAL", "LREAL"})
RESERVED = _words(
    """
    AND ANY ARRAY AT AUTHOR BEGIN BLOCK_DB BLOCK_FB BLOCK_FC BLOCK_SDB BOOL BY BYTE CASE CHAR CONST CONSTANT
    CONTINUE COUNTER DATA_BLOCK DATE DATE_AND_TIME DB_ANY DB_SPECIFIC DINT DIV DO DT DTL DWORD ELSE ELSIF EN ENO
    END_CASE END_CONST END_DATA_BLOCK END_FOR END_FUNCTION END_FUNCTION_BLOCK END_IF END_LABEL
    END_ORGANIZATION_BLOCK END_REGION END_REPEAT END_STRUCT END_TYPE END_VAR END_WHILE EXIT FALSE FAMILY FOR
    FUNCTION FUNCTION_BLOCK GOTO IF INT KNOW_HOW_PROTECT LABEL LDT LINT LREAL LTIME LTOD LWORD MOD NAME NIL
    NON_RETAIN NOT NULL OF OK OR ORGANIZATION_BLOCK POINTER PORT PROGRAM READ_ONLY REAL REF REF_TO REGION REPEAT
    RETAIN RETURN S5TIME SINT STRING STRUCT THEN THIS TIME TIMER TIME_OF_DAY TITLE TO TOD TRUE TYPE UDINT UINT ULINT
    UNLINKED UNTIL USINT VAR VARIANT VAR_IN_OUT VAR_INPUT VAR_OUTPUT VAR_TEMP VERSION VOID WCHAR WHILE WORD WSTRING
    XOR
    """
)
"""Names that get quotes: keywords, and types that are named without quotes."""


def quoted(name: str) -> str:
    """A name as SCL takes it: `Index`, but `"Port"`."""
    return f'"{name}"' if name.upper() in RESERVED else name


def converts(name: str) -> bool:
    """Whether SCL has a conversion that does the same: from bit strings to REAL it would copy the bits."""
    source, _, target = name.partition("_TO_")
    plain = _BITS | _INTEGERS
    if source in plain and target in plain:
        return source != target
    return (source in _INTEGERS and target in _REALS) or (source in _REALS and target in _INTEGERS)
