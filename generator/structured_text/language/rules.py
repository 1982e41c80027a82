"""The names of everything that the front end can find, with stable codes. `docs/lint.md` explains each."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Rule:
    """A rule: stable `code`, kebab-case `name`, and one line on what it finds.

    `error`: the text means nothing in the second edition, and no engine runs it; otherwise it is legal somewhere,
    and refused, compiled to something else, or simply not canonical elsewhere.
    """

    code: str
    name: str
    summary: str
    error: bool = False


# 0xx: no Structured Text of the second edition. 1xx: text and names. 2xx: declarations and types.
# 3xx: legal, and compiled to something else somewhere. 4xx: what the canonical text does without.
# 5xx: no question of portability, found only where it is selected.
_ERRORS = """
001 syntax                 the text cannot be parsed
002 undeclared-name        a name that is declared nowhere in reach
003 unknown-type           a type that is declared nowhere
004 duplicate-name         one name declared twice
005 type-mismatch          a value of one type where another is wanted, with no conversion between them
006 call-arguments         arguments that do not fit the parameters
007 not-assignable         a write to what is no variable
008 literal-range          a literal beyond the range of its type
009 index-range            a constant index outside the bounds of its array
010 recursion              a function, block or type that needs itself
011 no-result              a function that never assigns its result
012 duplicate-label        one number in two labels of a CASE
013 misplaced-exit         EXIT or CONTINUE outside a loop
014 long-expression        a statement with more operators than several compilers survive
015 ambiguous-name         an enumerated value that two types have
016 return-value           RETURN with a value
017 dialect-assignment     S=, R= and REF=
018 unsupported            METHOD, PROPERTY, NAMESPACE, INTERFACE, CLASS, ACTION, SFC, EXTENDS
020 implicit-conversion    a number of one type where another is wanted, without a conversion
021 bit-string-arithmetic  + - * / on BYTE, WORD, DWORD
022 integer-for-real       5 where 5.0 is wanted
023 bit-access             w.3, w.%X3
024 case-selector          CASE on BYTE, WORD, DWORD
025 case-label             a constant, hexadecimal or typed literal as label of a CASE
026 constant-bound         a constant or expression as array bound or string length
027 initial-expression     a constant or expression as initial value
028 pointer                POINTER TO, REF_TO, REFERENCE TO, ^
029 conformant-array       ARRAY[*]
030 block-array            an array of function blocks
031 block-in-struct        a function block in a structure
032 block-in-out           a function block as VAR_IN_OUT
033 function-as-statement  a function call whose result is dropped
034 no-result-type         a FUNCTION without result type
035 write-to-output        a write to an output of an instance
036 top-level-global       VAR_GLOBAL outside a CONFIGURATION
037 global-variable        global variables, VAR_EXTERNAL
038 generic-conversion     TO_INT(x) instead of REAL_TO_INT(x)
039 string-index           s[0]
040 edge-input             R_EDGE and F_EDGE
041 direct-address         %IX0.0, AT
"""
_REMARKS = """
101 line-comment           // comments
102 block-comment          /* */ comments
103 nested-comment         (* in (* *) *)
104 pragma                 {...}
105 byte-order-mark        a byte order mark before the text
106 underscore-name        a__b and x_
107 non-ascii-name         letters beyond ASCII in a name
108 reserved-name          a name that some compiler keeps for itself
109 name-clash             a variable with the name of a type, block or function
110 missing-semicolon      END_IF or END_STRUCT without ;
111 empty-statement        a ; with nothing before it
112 empty-branch           a branch or loop without statements
113 empty-body             a function, block or program without statements
114 empty-var-block        VAR END_VAR with nothing inside
115 lower-case-literal     word#16#ab
116 untyped-bit-literal    16#FF or 5 where WORD#16#00FF is meant
117 based-integer          16#FF for an INT or UINT
118 bool-literal           0, 1 or BOOL#1 for FALSE and TRUE
119 time-literal           us and ns in a duration
120 real-literal           1E3 and REAL#5 without a decimal point
121 string-encoding        characters beyond ASCII in a string
122 string-escape          $0D before a digit or letter, $L
123 several-types          more than one type in a TYPE ... END_TYPE
124 declaration-order      a name that is used before its declaration
125 configuration-inside   a CONFIGURATION beside functions and blocks
126 typed-string           STRING#'a'
127 stray-sign             - -n, NOT NOT x, +n
128 empty-file             a file that declares nothing
129 hidden-value           a variable with the name of an enumerated value
130 target-name            a name that a target of --for keeps for itself
131 long-name              with --for, a name of more than 31 characters
201 anonymous-array        ARRAY written out for a parameter
202 array-parameter        an array as VAR_INPUT or VAR_OUTPUT
203 function-array-input   an array as VAR_INPUT of a FUNCTION
204 function-array-table   an array with initial values in a FUNCTION
205 function-in-out        a FUNCTION with VAR_IN_OUT
206 function-output        a FUNCTION with VAR_OUTPUT
207 function-no-input      a FUNCTION without VAR_INPUT
208 constant-before-var    VAR after VAR CONSTANT in a FUNCTION
209 temp-struct            VAR_TEMP of a structure or array
210 sized-string           STRING[n]
211 wide-string            WSTRING
212 struct-initial         initial values for a structure
213 instance-initial       initial values for a function block instance
214 repeat-initial         n(x) in an initial value
215 type-initial           initial values in a TYPE declaration
216 enum-number            numbers or a base type for an enumeration
217 enum-qualified         E#V and E.V
218 subrange               INT(0..9)
219 alias-type             another name for a type
220 grouped-fields         two names in one line of a structure
221 negated-output         NOT Q => x
222 var-qualifier          PERSISTENT, VAR_STAT, CONSTANT after VAR_INPUT
223 anonymous-type         a structure or enumeration written out for a variable
224 array-of-array         an array whose elements are arrays
225 program-task           a program without a task
226 program-connection     a program instance with connected variables
301 for-zero-trips         FOR
302 complement-compare     NOT of a bit string in a comparison or conversion
303 unmasked-shr           SHR without a mask
304 bit-string-order       < and > on bit strings
305 unstored-shift         SHL inside a comparison or conversion
306 intermediate-overflow  a sum, difference or product that can overflow its type before it is used
307 time-arithmetic        + - * / and comparisons of TIME
308 time-conversion        TIME_TO_DINT and its kind
309 real-to-int            a conversion from REAL whose range nobody checked
310 f-trig                 F_TRIG
311 empty-string           comparison with ''
312 in-out-alias           one variable bound twice in a call
313 short-circuit          AND and OR whose right side needs the left one
314 open-type              LEN, FIND, TRUNC or a function of literals where nothing gives its type
401 case-without-else      a CASE without ELSE
402 continue               CONTINUE
403 en-eno                 EN and ENO
404 private-access         reading an internal variable of an instance
405 string-function        LEN, CONCAT, MID ...
406 string-conversion      INT_TO_STRING and its kind
407 string-order           < and > on strings
408 bool-shift             SHL, SHR, ROL and ROR of a BOOL
409 negated-comparison     NOT over a bracketed comparison of REALs, or over several
"""
_HOUSE = """
501 taken-back             with --select: a value that a call has decided and used is assigned again
"""


def _read(text: str, error: bool) -> list[Rule]:
    rows = [line.split(None, 2) for line in text.strip().splitlines()]
    return [Rule("ST" + code, name, summary, error) for code, name, summary in rows]


# Every rule by name, in order of code.
RULES: dict[str, Rule] = {
    rule.name: rule for rule in _read(_ERRORS, True) + _read(_REMARKS, False) + _read(_HOUSE, False)
}
ON_REQUEST = frozenset(rule.name for rule in _read(_HOUSE, False))
CODES: dict[str, Rule] = {rule.code: rule for rule in RULES.values()}
