/* Both framings: what is opened is what a second reading of the standard opens, and seals again to the same bytes. */
static void MB_RTUOPEN_fill(MB_RTUOPEN *x)
{
    receive_into(x->ADU.value.table, &x->ADULENGTH.value, LINES + below(COUNT(LINES)), 1, 256);
}

static const char *MB_RTUOPEN_right(const MB_RTUOPEN *x, const MB_RTUOPEN *was)
{
    static MB_RTUSEAL seal;
    const BYTE *adu = was->ADU.value.table;
    unsigned length = was->ADULENGTH.value;
    int good = length >= 5 && length <= 256 &&
               crc16(adu, length - 2) == (adu[length - 2] | (unsigned)adu[length - 1] << 8);
    if (good != (x->ERRORID.value == 0))
        return good ? "a frame is refused" : "what is no frame is opened";
    if (!good)
        return NULL;
    if (x->LENGTH.value != length - 2)
        return "the length is wrong";
    START(MB_RTUSEAL, seal);
    memcpy(seal.ADU.value.table, adu, length - 2);
    seal.LENGTH.value = x->LENGTH.value;
    MB_RTUSEAL_body__(&seal);
    int same = seal.ADULENGTH.value == length && !memcmp(seal.ADU.value.table, adu, length);
    return same ? NULL : "it does not seal to the same bytes";
}

static void MB_ASCIIDECODE_fill(MB_ASCIIDECODE *x)
{
    receive_into(x->CHARS.value.table, &x->CHARCOUNT.value, LINES + below(COUNT(LINES)), 2, 513);
    noise(x->ADU.value.table, one_in(8) ? 256 : 8);
}

static const char *MB_ASCIIDECODE_right(const MB_ASCIIDECODE *x, const MB_ASCIIDECODE *was)
{
    static MB_ASCIIENCODE encode;
    static uint8_t bytes[256];
    const BYTE *text = was->CHARS.value.table;
    unsigned count = was->CHARCOUNT.value;
    int length = open_ascii(text, count, bytes);
    if ((length >= 0) != (x->ERRORID.value == 0))
        return length >= 0 ? "a frame is refused" : "what is no frame is decoded";
    if (length < 0)
        return NULL;
    if (x->LENGTH.value != length || memcmp(x->ADU.value.table, bytes, (size_t)length))
        return "the bytes are wrong";
    START(MB_ASCIIENCODE, encode);
    memcpy(encode.ADU.value.table, x->ADU.value.table, 256);
    encode.LENGTH.value = x->LENGTH.value;
    MB_ASCIIENCODE_body__(&encode);
    int same = encode.CHARCOUNT.value == count && !memcmp(encode.CHARS.value.table, text, count);
    return same ? NULL : "it does not encode to the same characters";
}

/* A body to send: one that was received, or noise of any length. */
static UINT send_from(BYTE *table)
{
    static Frame frame;
    if (one_in(4)) {
        frame.length = below(256);
        noise(frame.bytes, frame.length);
    } else {
        receive(&frame, LINES + below(COUNT(LINES)), 0);
    }
    memcpy(table, frame.bytes, frame.length < 256 ? frame.length : 256);
    return told(frame.length, 254);
}

static void MB_RTUSEAL_fill(MB_RTUSEAL *x) { x->LENGTH.value = send_from(x->ADU.value.table); }

static const char *MB_RTUSEAL_right(const MB_RTUSEAL *x, const MB_RTUSEAL *was)
{
    static Frame due;
    due.length = was->LENGTH.value;
    if ((due.length >= 2 && due.length <= 254) != (x->ERRORID.value == 0))
        return "the length is judged wrongly";
    if (x->ERRORID.value)
        return memcmp(x->ADU.value.table, was->ADU.value.table, 256) ? "a refused frame is changed" : NULL;
    memcpy(due.bytes, was->ADU.value.table, due.length);
    seal_rtu(&due);
    if (x->ADULENGTH.value != due.length || memcmp(x->ADU.value.table, due.bytes, due.length))
        return "the frame is wrong";
    int kept = !memcmp(x->ADU.value.table + due.length, was->ADU.value.table + due.length, 256 - due.length);
    return kept ? NULL : "bytes after the frame are changed";
}

static void MB_ASCIIENCODE_fill(MB_ASCIIENCODE *x)
{
    x->LENGTH.value = send_from(x->ADU.value.table);
    noise(x->CHARS.value.table, one_in(8) ? 513 : 8);
}

static const char *MB_ASCIIENCODE_right(const MB_ASCIIENCODE *x, const MB_ASCIIENCODE *was)
{
    static Frame due;
    due.length = was->LENGTH.value;
    if ((due.length >= 2 && due.length <= 254) != (x->ERRORID.value == 0))
        return "the length is judged wrongly";
    if (x->ERRORID.value)
        return memcmp(x->CHARS.value.table, was->CHARS.value.table, 513) ? "a refused frame is written" : NULL;
    memcpy(due.bytes, was->ADU.value.table, due.length);
    seal_ascii(&due);
    int same = x->CHARCOUNT.value == due.length && !memcmp(x->CHARS.value.table, due.bytes, due.length);
    return same ? NULL : "the characters are wrong";
}

#define CHECKSUM(NAME, PIN, OWN)                                                                                       \
    static void NAME##_fill(NAME *x) { x->LENGTH.value = send_from(x->ADU.value.table); }                              \
    static const char *NAME##_right(const NAME *x, const NAME *was)                                                    \
    {                                                                                                                  \
        unsigned length = was->LENGTH.value < 256 ? was->LENGTH.value : 256;                                           \
        return x->PIN.value == OWN(was->ADU.value.table, length) ? NULL : "the checksum is wrong";                     \
    }
CHECKSUM(MB_CRC16, CRC, crc16)
CHECKSUM(MB_CRC16COMPACT, CRC, crc16)
CHECKSUM(MB_LRC, LRC, lrc8)
