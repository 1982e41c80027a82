/* Requests: if there is a frame, its bytes are those of the standard, and what is noted is what was asked.
 * MODBUS Application Protocol V1.1b3, 6.3, 6.4, 6.6, 6.8 and 6.12. */
typedef struct {
    unsigned function, unit, address, quantity, value, sub_function;
} Wanted;

static const char *check_request(const Wanted *wanted, const WORD *words, unsigned error, unsigned length,
                                 const BYTE *adu, const MB_REQUEST *noted)
{
    if (error && length)
        return "a length in spite of an error";
    if (error)
        return noted->FUNCTIONCODE ? "an open request in spite of an error" : NULL;
    unsigned counted = wanted->function == 3 || wanted->function == 4 || wanted->function == 16;
    unsigned quantity = counted ? wanted->quantity : 1, echo = wanted->function == 8;
    unsigned head = echo ? wanted->sub_function : wanted->address, tail = counted ? quantity : wanted->value;
    if (quantity < 1 || quantity > (wanted->function == 16 ? 123 : 125) || wanted->unit > 247)
        return "a request that cannot be";
    if (!echo && wanted->address + quantity > 65536)
        return "registers past FFFFH";
    if (wanted->unit == 0 && (wanted->function == 3 || wanted->function == 4 || echo))
        return "a broadcast that asks for an answer";
    if (length != (wanted->function == 16 ? 7 + 2 * quantity : 6))
        return "the length is wrong";
    if (adu[0] != wanted->unit || adu[1] != wanted->function || pair(adu + 2) != head || pair(adu + 4) != tail)
        return "the frame is wrong";
    if (wanted->function == 16 && adu[6] != 2 * quantity)
        return "the byte count is wrong";
    for (unsigned at = 0; wanted->function == 16 && at < quantity; at++)
        if (pair(adu + 7 + 2 * at) != words[at])
            return "a word of the frame is wrong";
    if (noted->UNITADDRESS != wanted->unit || noted->FUNCTIONCODE != wanted->function || noted->QUANTITY != quantity)
        return "the open request is wrong";
    if (noted->ADDRESS != (echo ? 0 : wanted->address) || noted->SUBFUNCTION != (echo ? wanted->sub_function : 0))
        return "the open request is wrong";
    return noted->VALUE == (counted ? 0 : wanted->value) ? NULL : "the open request is wrong";
}

#define REQUEST_BLOCK(NAME)                                                                                            \
    static const char *NAME##_right(const NAME *x, const NAME *was)                                                    \
    {                                                                                                                  \
        Wanted wanted = {was->FUNCTIONCODE.value, was->UNITADDRESS.value, was->ADDRESS.value,                          \
                         was->QUANTITY.value,     was->VALUE.value,       was->SUBFUNCTION.value};                     \
        return check_request(&wanted, was->WORDS.value.table, x->ERRORID.value, x->LENGTH.value, x->ADU.value.table,   \
                             &x->REQUEST.value);                                                                       \
    }

static const char *MB_BUILDREAD_right(const MB_BUILDREAD *x, const MB_BUILDREAD *was)
{
    Wanted wanted = {was->FUNCTIONCODE.value, was->UNITADDRESS.value, was->ADDRESS.value, was->QUANTITY.value, 0, 0};
    if (x->ERRORID.value == 0 && was->QUANTITY.value > was->MAXWORDS.value)
        return "more than MaxWords";
    return check_request(&wanted, NULL, x->ERRORID.value, x->LENGTH.value, x->ADU.value.table, &x->REQUEST.value);
}

static const char *MB_BUILDWRITEMULTIPLE_right(const MB_BUILDWRITEMULTIPLE *x, const MB_BUILDWRITEMULTIPLE *was)
{
    Wanted wanted = {16, was->UNITADDRESS.value, was->ADDRESS.value, was->QUANTITY.value, 0, 0};
    if (x->ERRORID.value == 0 && was->QUANTITY.value > was->MAXWORDS.value)
        return "more than MaxWords";
    return check_request(&wanted, was->WORDS.value.table, x->ERRORID.value, x->LENGTH.value, x->ADU.value.table,
                         &x->REQUEST.value);
}

static const char *MB_BUILDWRITESINGLE_right(const MB_BUILDWRITESINGLE *x, const MB_BUILDWRITESINGLE *was)
{
    Wanted wanted = {6, was->UNITADDRESS.value, was->ADDRESS.value, 1, was->VALUE.value, 0};
    return check_request(&wanted, NULL, x->ERRORID.value, x->LENGTH.value, x->ADU.value.table, &x->REQUEST.value);
}

static const char *MB_BUILDDIAGNOSTICS_right(const MB_BUILDDIAGNOSTICS *x, const MB_BUILDDIAGNOSTICS *was)
{
    Wanted wanted = {8, was->UNITADDRESS.value, 0, 1, was->VALUE.value, was->SUBFUNCTION.value};
    return check_request(&wanted, NULL, x->ERRORID.value, x->LENGTH.value, x->ADU.value.table, &x->REQUEST.value);
}

static UINT MB_HEXVALUE_call(BYTE character) { return MB_HEXVALUE(1, NULL, character); }

static const char *MB_HEXVALUE_right(BYTE character, UINT result)
{
    int due = digit_value(character);
    return (due < 0 ? result > 15 : result == due) ? NULL : "the digit's value is wrong";
}

static const char *MB_HEXDIGIT_right(UINT number, BYTE result)
{
    return digit_value(result) == number % 16 && MB_HEXVALUE_call(result) == number % 16 ? NULL : "the digit is wrong";
}

/* References: what is no number, infinite or negative is refused, and everything without a maximum or with a full scale that
 * makes no sense; 0.0 and -0.0 are a standstill, and what is below them gives no other word. */
static const char *check_reference(float hertz, float maximum, float full, unsigned value, unsigned limited,
                                   unsigned error)
{
    if (error && (value || limited))
        return "a value in spite of an error";
    if (!isfinite(hertz) && error != 12)
        return "what is no number is taken";
    if (isfinite(hertz) && !(maximum >= 0.1f && maximum <= 10000.0f) && error != 17 && error != 12)
        return "there is no maximum";
    if (!(full >= 0.1f && full <= 10000.0f) && full != 0.0f && error != 19 && error != 17 && error != 12)
        return "there is no full scale";
    if (isfinite(hertz) && hertz < 0.0f && value)
        return "a negative reference is taken";
    if (hertz >= 0.0f && hertz <= 1.0e30f && (error == 12 || error == 13))
        return "a number is refused";
    return hertz == 0.0f && value ? "0 Hz is not 0" : NULL;
}

#define REFERENCE_BLOCK(NAME)                                                                                          \
    static const char *NAME##_right(const NAME *x, const NAME *was)                                                    \
    {                                                                                                                  \
        return check_reference(was->SPEEDREFERENCEHZ.value, was->MAXIMUMHZ.value, was->FULLSCALEHZ.value,              \
                               x->VALUE.value, x->LIMITED.value, x->ERRORID.value);                                    \
    }

/* Commands: a stop wins over every motion; forward and reverse together are a stop and an error, and a run that is not
 * possible is as well; a reset is no stop, and an error where the drive has none. */
typedef struct {
    int enable, stop, quick, coast, forward, reverse, reset;
} Pressed;

static const char *check_command(const Pressed *pressed, unsigned stopping, unsigned resetting, unsigned error)
{
    int asked = !pressed->enable || pressed->stop || pressed->quick || pressed->coast;
    if (stopping && resetting)
        return "a stop and a reset at once";
    if (error && !stopping && !resetting && !(error == 16 && pressed->reset))
        return "an error without a stop";
    if (asked && ((!stopping && !resetting) || (error && !(error == 16 && pressed->reset))))
        return "a stop does not win";
    if (!asked && !resetting && pressed->forward && pressed->reverse && (!stopping || error != 14))
        return "both directions are no stop";
    return NULL;
}

#define COMMAND_BLOCK(NAME)                                                                                            \
    static const char *NAME##_right(const NAME *x, const NAME *was)                                                    \
    {                                                                                                                  \
        Pressed pressed = {was->ENABLE.value,    was->STOP.value,                                                      \
                           was->QUICKSTOP.value, was->COASTSTOP.value,                                                 \
                           was->RUNFORWARD.value || was->JOGFORWARD.value,                                             \
                           was->RUNREVERSE.value || was->JOGREVERSE.value,                                             \
                           was->FAULTRESET.value};                                                                     \
        return check_command(&pressed, x->STOPPING.value, x->RESETTING.value, x->ERRORID.value);                       \
    }
