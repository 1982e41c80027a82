/* What libFuzzer, or a plain main function, gives bytes to. Each target says what the last block answered, an ErrorID;
 * what a block must not do ends the program, so that libFuzzer keeps the input. */
typedef struct {
    const uint8_t *next;
    size_t left;
} Bytes;

static unsigned octet(Bytes *bytes)
{
    if (bytes->left == 0)
        return 0;
    bytes->left--;
    return *bytes->next++;
}

static UINT two_octets(Bytes *bytes)
{
    unsigned high = octet(bytes);
    return (UINT)(high << 8 | octet(bytes));
}

/* What is left, as a frame of at most ROOM / 2 bytes. */
static void rest(Bytes *bytes, Frame *frame)
{
    frame->length = bytes->left < ROOM / 2 ? (unsigned)bytes->left : ROOM / 2;
    memcpy(frame->bytes, bytes->next, frame->length);
    bytes->left = 0;
}

static void fail(const char *block, const char *wrong)
{
    printf("WRONG %s: %s\n", block, wrong);
    fflush(stdout);
    abort();
}

#define SCAN(NAME, instance)                                                                                           \
    do {                                                                                                               \
        const char *wrong;                                                                                             \
        NAME##_was = (instance);                                                                                       \
        NAME##_body__(&(instance));                                                                                    \
        if ((wrong = NAME##_general(&(instance), &NAME##_was)) ||                                                      \
            (wrong = NAME##_right(&(instance), &NAME##_was)))                                                          \
            fail(#NAME, wrong);                                                                                        \
    } while (0)

static unsigned open_frame(const Frame *frame, BYTE *body, UINT *length)
{
    static MB_RTUOPEN open;
    START(MB_RTUOPEN, open);
    memcpy(open.ADU.value.table, frame->bytes, frame->length < 256 ? frame->length : 256);
    open.ADULENGTH.value = (UINT)frame->length;
    SCAN(MB_RTUOPEN, open);
    memcpy(body, open.ADU.value.table, 256);
    *length = open.LENGTH.value;
    return open.ERRORID.value;
}

static unsigned decode_frame(const Frame *frame, BYTE *body, UINT *length)
{
    static MB_ASCIIDECODE decode;
    START(MB_ASCIIDECODE, decode);
    memcpy(decode.CHARS.value.table, frame->bytes, frame->length < 513 ? frame->length : 513);
    decode.CHARCOUNT.value = (UINT)frame->length;
    SCAN(MB_ASCIIDECODE, decode);
    memcpy(body, decode.ADU.value.table, 256);
    *length = decode.LENGTH.value;
    return decode.ERRORID.value;
}

/* Twelve bytes: the fields of an open request in their order. */
static void asked(Bytes *bytes, MB_REQUEST *request)
{
    request->UNITADDRESS = two_octets(bytes);
    request->FUNCTIONCODE = two_octets(bytes);
    request->ADDRESS = two_octets(bytes);
    request->QUANTITY = two_octets(bytes);
    request->SUBFUNCTION = two_octets(bytes);
    request->VALUE = two_octets(bytes);
}

static unsigned target_rtu_open(Bytes *bytes)
{
    static Frame frame;
    static BYTE body[256];
    UINT length;
    rest(bytes, &frame);
    return open_frame(&frame, body, &length);
}

static unsigned target_ascii_decode(Bytes *bytes)
{
    static Frame frame;
    static BYTE body[256];
    UINT length;
    rest(bytes, &frame);
    return decode_frame(&frame, body, &length);
}

/* Seven bytes of settings, the open request, the length that is reported if the first bit says so, the body. */
static unsigned target_parse_reply(Bytes *bytes)
{
    static MB_PARSEREPLY parse;
    static Frame frame;
    unsigned flags = octet(bytes);
    START(MB_PARSEREPLY, parse);
    parse.TWOBYTECOUNT.value = flags & 1;
    parse.EXCEPTIONADD.value = two_octets(bytes);
    parse.ERRORFUNCTION.value = two_octets(bytes);
    parse.ERRORADDRESS.value = two_octets(bytes);
    asked(bytes, &parse.REQUEST.value);
    UINT length = flags & 2 ? two_octets(bytes) : 0;
    rest(bytes, &frame);
    memcpy(parse.ADU.value.table, frame.bytes, frame.length < 256 ? frame.length : 256);
    parse.LENGTH.value = flags & 2 ? length : (UINT)frame.length;
    SCAN(MB_PARSEREPLY, parse);
    return parse.ERRORID.value;
}

/* A byte of flags (1: ASCII; 2: the checksum, or the whole ASCII frame, is made here), the open request, what comes. */
#define REPLY_TARGET(NAME)                                                                                             \
    static unsigned target_##NAME(Bytes *bytes)                                                                        \
    {                                                                                                                  \
        static NAME reply;                                                                                             \
        static Frame frame;                                                                                            \
        unsigned flags = octet(bytes), error;                                                                          \
        START(NAME, reply);                                                                                            \
        asked(bytes, &reply.REQUEST.value);                                                                            \
        rest(bytes, &frame);                                                                                           \
        if (flags & 2)                                                                                                 \
            (flags & 1 ? seal_ascii : seal_rtu)(&frame);                                                               \
        error = (flags & 1 ? decode_frame : open_frame)(&frame, reply.ADU.value.table, &reply.LENGTH.value);           \
        if (error)                                                                                                     \
            return error;                                                                                              \
        SCAN(NAME, reply);                                                                                             \
        return reply.ERRORID.value;                                                                                    \
    }

/* A request that was built goes out in both framings and comes back; the echo of a write is an answer to it. */
static void send_and_receive(const BYTE *adu, UINT length)
{
    static MB_RTUSEAL seal;
    static MB_ASCIIENCODE encode;
    static Frame frame;
    static BYTE body[256];
    UINT came;
    START(MB_RTUSEAL, seal);
    START(MB_ASCIIENCODE, encode);
    memcpy(seal.ADU.value.table, adu, 256);
    memcpy(encode.ADU.value.table, adu, 256);
    seal.LENGTH.value = encode.LENGTH.value = length;
    SCAN(MB_RTUSEAL, seal);
    SCAN(MB_ASCIIENCODE, encode);
    memcpy(frame.bytes, seal.ADU.value.table, frame.length = seal.ADULENGTH.value);
    if (open_frame(&frame, body, &came) || came != length || memcmp(body, adu, length))
        fail("MB_RtuOpen", "a request does not come back");
    memcpy(frame.bytes, encode.CHARS.value.table, frame.length = encode.CHARCOUNT.value);
    if (decode_frame(&frame, body, &came) || came != length || memcmp(body, adu, length))
        fail("MB_AsciiDecode", "a request does not come back");
}

/* A byte of flags (1: ASCII), six pins of two bytes, words to write. */
#define REQUEST_TARGET(NAME, REPLY_NAME)                                                                               \
    static unsigned target_##NAME(Bytes *bytes)                                                                        \
    {                                                                                                                  \
        static NAME build;                                                                                             \
        static REPLY_NAME reply;                                                                                       \
        START(NAME, build);                                                                                            \
        build.ASCII.value = octet(bytes) & 1;                                                                          \
        build.UNITADDRESS.value = two_octets(bytes);                                                                   \
        build.FUNCTIONCODE.value = two_octets(bytes);                                                                  \
        build.ADDRESS.value = two_octets(bytes);                                                                       \
        build.QUANTITY.value = two_octets(bytes);                                                                      \
        build.SUBFUNCTION.value = two_octets(bytes);                                                                   \
        build.VALUE.value = two_octets(bytes);                                                                         \
        for (unsigned at = 0; at < 125 && bytes->left; at++)                                                           \
            build.WORDS.value.table[at] = two_octets(bytes);                                                           \
        SCAN(NAME, build);                                                                                             \
        if (build.ERRORID.value)                                                                                       \
            return build.ERRORID.value;                                                                                \
        send_and_receive(build.ADU.value.table, build.LENGTH.value);                                                   \
        if (build.UNITADDRESS.value == 0 || (build.FUNCTIONCODE.value != 6 && build.FUNCTIONCODE.value != 8))          \
            return 0;                                                                                                  \
        START(REPLY_NAME, reply);                                                                                      \
        reply.REQUEST.value = build.REQUEST.value;                                                                     \
        reply.ADU.value = build.ADU.value;                                                                             \
        reply.LENGTH.value = build.LENGTH.value;                                                                       \
        SCAN(REPLY_NAME, reply);                                                                                       \
        if (reply.ERRORID.value)                                                                                       \
            fail(#REPLY_NAME, "the echo of a request is not believed");                                                \
        return 0;                                                                                                      \
    }
