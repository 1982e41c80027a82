/* Frames written a second time, from the standards alone: checksums bit by bit, both framings, damage.
 * MODBUS over Serial Line V1.02, 2.5.1 (RTU), 2.5.2 (ASCII), 6.2 (checksums). */
#define ROOM 1200

typedef struct {
    uint8_t bytes[ROOM];
    unsigned length;
} Frame;

static unsigned crc16(const uint8_t *bytes, unsigned length)
{
    static uint16_t step[256];
    static int ready;
    if (!ready) {
        for (unsigned value = 0; value < 256; value++) {
            unsigned rest = value;
            for (int bit = 0; bit < 8; bit++)
                rest = rest & 1 ? rest >> 1 ^ 0xA001u : rest >> 1;
            step[value] = (uint16_t)rest;
        }
        ready = 1;
    }
    unsigned crc = 0xFFFF;
    for (unsigned at = 0; at < length; at++)
        crc = crc >> 8 ^ step[(crc ^ bytes[at]) & 0xFF];
    return crc;
}

static unsigned lrc8(const uint8_t *bytes, unsigned length)
{
    unsigned sum = 0;
    for (unsigned at = 0; at < length; at++)
        sum += bytes[at];
    return (0u - sum) & 0xFF;
}

static void seal_rtu(Frame *frame)
{
    unsigned crc = crc16(frame->bytes, frame->length);
    frame->bytes[frame->length++] = (uint8_t)crc;
    frame->bytes[frame->length++] = (uint8_t)(crc >> 8);
}

static void seal_ascii(Frame *frame)
{
    static const char DIGITS[] = "0123456789ABCDEF";
    static Frame made;
    if (frame->length > 500)
        frame->length = 500;
    frame->bytes[frame->length] = (uint8_t)lrc8(frame->bytes, frame->length);
    made.length = 0;
    made.bytes[made.length++] = ':';
    for (unsigned at = 0; at <= frame->length; at++) {
        made.bytes[made.length++] = (uint8_t)DIGITS[frame->bytes[at] >> 4];
        made.bytes[made.length++] = (uint8_t)DIGITS[frame->bytes[at] & 15];
    }
    made.bytes[made.length++] = '\r';
    made.bytes[made.length++] = '\n';
    memcpy(frame->bytes, made.bytes, made.length);
    frame->length = made.length;
}

static int digit_value(uint8_t character)
{
    if (character >= '0' && character <= '9')
        return character - '0';
    return character >= 'A' && character <= 'F' ? character - 'A' + 10 : -1;
}

/* The bytes without LRC, or -1 if this is no frame that could be a reply. */
static int open_ascii(const uint8_t *text, unsigned length, uint8_t *bytes)
{
    if (length < 11 || length > 513 || length % 2 == 0 || text[0] != ':' || text[length - 2] != '\r' ||
        text[length - 1] != '\n')
        return -1;
    unsigned count = (length - 3) / 2;
    for (unsigned at = 0; at < count; at++) {
        int high = digit_value(text[1 + 2 * at]), low = digit_value(text[2 + 2 * at]);
        if (high < 0 || low < 0)
            return -1;
        bytes[at] = (uint8_t)(high << 4 | low);
    }
    return bytes[count - 1] == lrc8(bytes, count - 1) ? (int)count - 1 : -1;
}

static void splice(Frame *frame, const Frame *other)
{
    unsigned head = below(frame->length + 1), from = below(other->length + 1);
    memmove(frame->bytes + head, other->bytes + from, other->length - from);
    frame->length = head + other->length - from;
}

static void extend(Frame *frame, unsigned count)
{
    noise(frame->bytes + frame->length, count);
    frame->length += count;
}

static void insert(Frame *frame)
{
    unsigned at = below(frame->length + 1);
    memmove(frame->bytes + at + 1, frame->bytes + at, frame->length - at);
    frame->bytes[at] = (uint8_t)chance();
    frame->length++;
}

static void erase(Frame *frame)
{
    unsigned at = below(frame->length);
    memmove(frame->bytes + at, frame->bytes + at + 1, frame->length - at - 1);
    frame->length--;
}

/* A byte with a meaning: unit address, function code, byte count and the high byte of a count. */
static void mark(Frame *frame)
{
    static const uint8_t LIKELY[] = {0,    1,    2,    3,    4,    5,   6,   8,   0x10, 0x50, 0x7F,
                                     0x80, 0x83, 0x86, 0x90, 246, 248, 250, 252, 254,  255};
    unsigned at = below(frame->length < 5 ? frame->length : 5);
    if (one_in(2))
        frame->bytes[at] = LIKELY[below(COUNT(LIKELY))];
    else
        frame->bytes[at] = (uint8_t)(frame->bytes[at] + below(5) - 2);
}

/* Characters that ASCII frames are made of, and some beside them. */
static void letter(Frame *frame)
{
    static const char LETTERS[] = "0123456789ABCDEF0123456789ABCDEFabcdef:;\r\n/@G`g ";
    frame->bytes[below(frame->length)] = (uint8_t)LETTERS[below(sizeof LETTERS - 1)];
}

static void flip(Frame *frame)
{
    unsigned at = below(8 * frame->length);
    frame->bytes[at >> 3] ^= (uint8_t)(1u << (at & 7));
}

static void replace(Frame *frame) { frame->bytes[below(frame->length)] = (uint8_t)chance(); }

/* Pure noise, mostly short. */
static void forget(Frame *frame, unsigned most)
{
    frame->length = 0;
    extend(frame, one_in(8) ? below(most + 8) : below(24));
}

/* Up to the longest that can be, and beyond. */
static void stretch(Frame *frame, unsigned most)
{
    unsigned near = most - 5;
    extend(frame, (frame->length < near ? near - frame->length : 0) + below(10));
}

/* One change to a frame of at most ROOM / 2 bytes; so long is the other one at most, and what comes out. */
static void damage(Frame *frame, const Frame *other, int in_ascii)
{
    unsigned most = in_ascii ? 513 : 256, way = below(12);
    if (frame->length > ROOM / 2)
        frame->length = ROOM / 2;
    if (frame->length == 0 || way == 0)
        forget(frame, most);
    else if (way <= 2)
        flip(frame);
    else if (way == 3)
        replace(frame);
    else if (way == 4)
        frame->length = below(frame->length);
    else if (way == 5)
        extend(frame, 1 + below(8));
    else if (way == 6)
        insert(frame);
    else if (way == 7)
        erase(frame);
    else if (way == 8)
        splice(frame, one_in(8) ? frame : other);
    else if (way == 9 && one_in(4))
        stretch(frame, most);
    else
        (in_ascii ? letter : mark)(frame);
    if (frame->length > ROOM / 2)
        frame->length = ROOM / 2;
}

/* What a caller says of a length: mostly the truth. */
static uint16_t told(unsigned length, unsigned most)
{
    if (!one_in(32))
        return (uint16_t)length;
    switch (below(8)) {
    case 0:
        return 0;
    case 1:
        return (uint16_t)most;
    case 2:
        return (uint16_t)(most + 1);
    case 3:
        return 65535;
    case 4:
        return (uint16_t)(length + 1);
    case 5:
        return (uint16_t)(length - 1);
    case 6:
        return (uint16_t)below(most + 2);
    default:
        return (uint16_t)chance();
    }
}
