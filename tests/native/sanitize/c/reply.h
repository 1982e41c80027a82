/* Replies: what comes in, and which of it may be believed, written a second time.
 * MODBUS Application Protocol V1.1b3, 6.3 to 6.12 and 7; how a drive refuses comes from its map. */
typedef struct {
    uint16_t add;      /* refusal: function code + add, one byte of reason; 0: no such form */
    uint16_t function; /* refusal: a reply of this function at `address`, a word of reason; 0: no such form */
    uint16_t address;
    int wide; /* a byte count of two bytes is tolerated */
} Dialect;

typedef enum { UNBELIEVED, BELIEVED, REFUSED } Judgement;

static unsigned pair(const uint8_t *bytes) { return (unsigned)bytes[0] << 8 | bytes[1]; }

/* A read: where its words stand, or 0. */
static unsigned words_at(const Dialect *dialect, const MB_REQUEST *asked, const uint8_t *body, unsigned length)
{
    unsigned size = 2u * asked->QUANTITY;
    if (dialect->wide && length == size + 4 && pair(body + 2) == size)
        return 4;
    return length == size + 3 && body[2] == size ? 3 : 0;
}

/* Whether a reply of the request's own function says what that function says of a request that was obeyed. */
static int granted(const Dialect *dialect, const MB_REQUEST *asked, const uint8_t *body, unsigned length)
{
    if (asked->FUNCTIONCODE == 3 || asked->FUNCTIONCODE == 4)
        return words_at(dialect, asked, body, length) != 0;
    if (length != 6)
        return 0;
    switch (asked->FUNCTIONCODE) {
    case 6:
        return pair(body + 2) == asked->ADDRESS && pair(body + 4) == asked->VALUE;
    case 8:
        return pair(body + 2) == asked->SUBFUNCTION && pair(body + 4) == asked->VALUE;
    case 16:
        return pair(body + 2) == asked->ADDRESS && pair(body + 4) == asked->QUANTITY;
    default:
        return 0;
    }
}

static Judgement judge(const Dialect *dialect, const MB_REQUEST *asked, const uint8_t *body, unsigned length,
                       unsigned *reason)
{
    if (asked->FUNCTIONCODE == 0 || asked->QUANTITY == 0 || asked->QUANTITY > 125 || asked->UNITADDRESS == 0)
        return UNBELIEVED;
    if (length < 3 || length > 254 || body[0] != asked->UNITADDRESS)
        return UNBELIEVED;
    int own = asked->FUNCTIONCODE == dialect->function && asked->ADDRESS == dialect->address;
    int reply = dialect->function && body[1] == dialect->function && length == 6;
    if (reply && pair(body + 2) == dialect->address && !own) {
        *reason = pair(body + 4);
        return REFUSED;
    }
    if (dialect->add && body[1] == (unsigned)asked->FUNCTIONCODE + dialect->add) {
        *reason = body[2];
        return length == 3 ? REFUSED : UNBELIEVED;
    }
    return body[1] == asked->FUNCTIONCODE && granted(dialect, asked, body, length) ? BELIEVED : UNBELIEVED;
}

static const char *check_reply(const Dialect *dialect, const MB_REQUEST *asked, const uint8_t *body, unsigned length,
                               const uint16_t *words, unsigned word_count, unsigned error, unsigned said)
{
    unsigned reason = 0;
    Judgement due = judge(dialect, asked, body, length, &reason);
    if ((error == 0) != (due == BELIEVED))
        return error ? "an answer is not believed" : "what is no answer is believed";
    if ((error == 40) != (due == REFUSED))
        return error == 40 ? "what is no refusal is taken for one" : "a refusal is not told";
    if (said != reason && (due == REFUSED || said != 0))
        return "the reason of a refusal is wrong";
    int reading = due == BELIEVED && (asked->FUNCTIONCODE == 3 || asked->FUNCTIONCODE == 4);
    if (word_count != (reading ? asked->QUANTITY : 0))
        return "the number of words is wrong";
    unsigned first = reading ? words_at(dialect, asked, body, length) : 0;
    for (unsigned at = 0; at < word_count; at++)
        if (words[at] != pair(body + first + 2 * at))
            return "a word is wrong";
    return NULL;
}

static void take_body(Frame *frame, unsigned number)
{
    frame->length = BODIES[number].length;
    memcpy(frame->bytes, BODY_BYTES + BODIES[number].at, frame->length);
}

/* A reply to a line, one in eight as it is: damaged before it gets its checksum, or after, or both. */
static void receive(Frame *frame, const Line *line, int framing)
{
    static Frame other;
    unsigned ways = one_in(8) ? 0 : 1 + below(3), sealed = one_in(2);
    take_body(frame, line->first + below(line->count));
    take_body(&other, below(COUNT(BODIES)));
    if (framing == 0) {
        while (ways--)
            damage(frame, &other, 0);
        return;
    }
    for (unsigned way = 0; way < ways && sealed; way++)
        damage(frame, &other, 0);
    (framing == 1 ? seal_rtu : seal_ascii)(frame);
    (framing == 1 ? seal_rtu : seal_ascii)(&other);
    for (unsigned way = 0; way < ways && (!sealed || one_in(32)); way++)
        damage(frame, &other, framing == 2);
}

/* An open request: that of a line, one in eight with a field changed. */
static void ask(MB_REQUEST *asked, const Line *line, const Telling *telling)
{
    *asked = line->asked;
    if (!one_in(8))
        return;
    uint16_t *fields[] = {&asked->UNITADDRESS, &asked->FUNCTIONCODE, &asked->ADDRESS,
                          &asked->QUANTITY,    &asked->SUBFUNCTION,  &asked->VALUE};
    *fields[below(COUNT(fields))] = some_word(telling);
}

static void receive_into(BYTE *table, UINT *told_length, const Line *line, int framing, unsigned room)
{
    static Frame frame;
    receive(&frame, line, framing);
    memcpy(table, frame.bytes, frame.length < room ? frame.length : room);
    *told_length = told(frame.length, framing == 0 ? 254 : room);
}

#define REPLY(NAME, DIALECT, FIRST, COUNT_OF)                                                                          \
    static void NAME##_fill(NAME *x)                                                                                   \
    {                                                                                                                  \
        const Line *line = LINES + FIRST + below(COUNT_OF);                                                            \
        ask(&x->REQUEST.value, line, &NAME##_telling);                                                                 \
        receive_into(x->ADU.value.table, &x->LENGTH.value, line, 0, 256);                                              \
        noise(x->WORDS.value.table, one_in(8) ? 250 : 8);                                                              \
    }                                                                                                                  \
    static const char *NAME##_right(const NAME *x, const NAME *was)                                                    \
    {                                                                                                                  \
        static const Dialect dialect = DIALECT;                                                                        \
        return check_reply(&dialect, &was->REQUEST.value, was->ADU.value.table, was->LENGTH.value,                     \
                           x->WORDS.value.table, x->WORDCOUNT.value, x->ERRORID.value, x->REASON.value);               \
    }
#define SET(...) {__VA_ARGS__}

static void MB_PARSEREPLY_fill(MB_PARSEREPLY *x)
{
    static const Dialect USUAL[] = {
        {128, 0, 0, 0}, {0, 6, 0x5001, 1}, {128, 0, 0, 1}, {128, 6, 0x5001, 0}, {0, 0, 0, 0},
    };
    const Line *line = LINES + below(COUNT(LINES));
    Dialect dialect = USUAL[below(COUNT(USUAL))];
    if (one_in(16))
        dialect.add = some_word(&MB_PARSEREPLY_telling);
    if (one_in(16))
        dialect.function = one_in(2) ? (uint16_t)below(20) : some_word(&MB_PARSEREPLY_telling);
    if (one_in(16))
        dialect.address = some_word(&MB_PARSEREPLY_telling);
    x->EXCEPTIONADD.value = dialect.add;
    x->ERRORFUNCTION.value = dialect.function;
    x->ERRORADDRESS.value = dialect.address;
    x->TWOBYTECOUNT.value = dialect.wide != 0;
    ask(&x->REQUEST.value, line, &MB_PARSEREPLY_telling);
    receive_into(x->ADU.value.table, &x->LENGTH.value, line, 0, 256);
    noise(x->WORDS.value.table, one_in(8) ? 250 : 8);
}

static const char *MB_PARSEREPLY_right(const MB_PARSEREPLY *x, const MB_PARSEREPLY *was)
{
    Dialect dialect = {was->EXCEPTIONADD.value, was->ERRORFUNCTION.value, was->ERRORADDRESS.value,
                       was->TWOBYTECOUNT.value};
    return check_reply(&dialect, &was->REQUEST.value, was->ADU.value.table, was->LENGTH.value, x->WORDS.value.table,
                       x->WORDCOUNT.value, x->ERRORID.value, x->REASON.value);
}
