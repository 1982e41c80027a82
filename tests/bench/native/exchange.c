/* A read of ten registers of unit 1: request built, reply believed or not; RTU and ASCII. By hand in C with the checks
 * that the blocks make, and by the blocks. Arguments: rounds, words of the reply. */

enum { WORDS = 10 };

typedef struct {
    unsigned unit, function, address, quantity;
} Open;

static uint16_t change[256];
static const char DIGITS[] = "0123456789ABCDEF";

static uint16_t crc_of(const uint8_t *bytes, unsigned count)
{
    uint16_t crc = 0xFFFF;
    for (unsigned at = 0; at < count; at++)
        crc = (uint16_t)(crc >> 8) ^ change[(crc ^ bytes[at]) & 0xFF];
    return crc;
}

static uint8_t lrc_of(const uint8_t *bytes, unsigned count)
{
    unsigned sum = 0;
    for (unsigned at = 0; at < count; at++)
        sum += bytes[at];
    return -sum;
}

/* Body of the request; bytes, or 0 if it cannot be made. */
static unsigned ask(const Open *open, uint8_t *adu)
{
    if (open->unit < 1 || open->unit > 247 || (open->function != 3 && open->function != 4) || open->quantity < 1
        || open->quantity > 125 || open->address + open->quantity > 0x10000)
        return 0;
    adu[0] = open->unit, adu[1] = open->function;
    adu[2] = open->address >> 8, adu[3] = open->address;
    adu[4] = open->quantity >> 8, adu[5] = open->quantity;
    return 6;
}

static unsigned seal(uint8_t *adu, unsigned count)
{
    uint16_t crc = crc_of(adu, count);
    adu[count] = crc, adu[count + 1] = crc >> 8;
    return count + 2;
}

static unsigned encode(const uint8_t *adu, unsigned count, uint8_t *chars)
{
    uint8_t *next = chars, sum = lrc_of(adu, count);
    *next++ = ':';
    for (unsigned at = 0; at <= count; at++) {
        uint8_t byte = at < count ? adu[at] : sum;
        *next++ = DIGITS[byte >> 4], *next++ = DIGITS[byte & 15];
    }
    *next++ = '\r', *next++ = '\n';
    return next - chars;
}

/* Bytes without checksum, or 0 if this is no frame. */
static unsigned opened(const uint8_t *adu, unsigned count)
{
    if (count < 5 || count > 256 || (adu[count - 1] << 8 | adu[count - 2]) != crc_of(adu, count - 2))
        return 0;
    return count - 2;
}

static int digit(uint8_t one)
{
    return one >= '0' && one <= '9' ? one - '0' : one >= 'A' && one <= 'F' ? one - 'A' + 10 : -1;
}

static unsigned decode(const uint8_t *chars, unsigned count, uint8_t *adu)
{
    if (count < 9 || count > 513 || count % 2 == 0 || chars[0] != ':' || chars[count - 2] != '\r'
        || chars[count - 1] != '\n')
        return 0;
    unsigned length = (count - 3) / 2;
    for (unsigned at = 0; at < length; at++) {
        int upper = digit(chars[1 + 2 * at]), lower = digit(chars[2 + 2 * at]);
        if (upper < 0 || lower < 0)
            return 0;
        adu[at] = upper << 4 | lower;
    }
    return lrc_of(adu, length) == 0 ? length - 1 : 0;
}

/* Registers of the reply, or 0 if it does not answer the request. */
static unsigned believed(const Open *open, const uint8_t *adu, unsigned length, uint16_t *words)
{
    if (length < 3 || length > 254 || adu[0] != open->unit || adu[1] != open->function
        || adu[2] != 2 * open->quantity || length != 3 + 2 * open->quantity)
        return 0;
    for (unsigned at = 0; at < open->quantity; at++)
        words[at] = adu[3 + 2 * at] << 8 | adu[4 + 2 * at];
    return open->quantity;
}

static const volatile unsigned asked[4] = {1, 3, 0, WORDS};
static uint8_t adu[256], chars[513], rtu_reply[256], ascii_reply[513], body[256];
static uint16_t words[125], right[WORDS];
static unsigned built, found, rtu_length, ascii_length;

static Open open_request(void)
{
    return (Open){asked[0], asked[1], asked[2], asked[3]};
}

static __attribute__((noinline)) void ask_rtu(void)
{
    Open open = open_request();
    unsigned length = ask(&open, adu);
    built = length ? seal(adu, length) : 0;
}

static __attribute__((noinline)) void ask_ascii(void)
{
    Open open = open_request();
    unsigned length = ask(&open, adu);
    built = length ? encode(adu, length, chars) : 0;
}

static __attribute__((noinline)) void read_rtu(void)
{
    Open open = open_request();
    found = believed(&open, rtu_reply, opened(rtu_reply, rtu_length), words);
}

static __attribute__((noinline)) void read_ascii(void)
{
    Open open = open_request();
    found = believed(&open, body, decode(ascii_reply, ascii_length, body), words);
}

#define CHAIN(TYPE, FORM) static TYPE FORM##_block; static void FORM##_run(void) { TYPE##_body__(&FORM##_block); }
CHAIN(BN_DRIVEASKRTU, drive_ask_rtu) CHAIN(BN_DRIVEASKASCII, drive_ask_ascii)
CHAIN(BN_DRIVEREADRTU, drive_read_rtu) CHAIN(BN_DRIVEREADASCII, drive_read_ascii)
CHAIN(BN_ANYASKRTU, any_ask_rtu) CHAIN(BN_ANYASKASCII, any_ask_ascii)
CHAIN(BN_ANYREADRTU, any_read_rtu) CHAIN(BN_ANYREADASCII, any_read_ascii)

static const Form forms[] = {
    {"c ask rtu", ask_rtu}, {"c ask ascii", ask_ascii}, {"c read rtu", read_rtu}, {"c read ascii", read_ascii},
    {"drive ask rtu", drive_ask_rtu_run}, {"drive ask ascii", drive_ask_ascii_run},
    {"drive read rtu", drive_read_rtu_run}, {"drive read ascii", drive_read_ascii_run},
    {"any ask rtu", any_ask_rtu_run}, {"any ask ascii", any_ask_ascii_run},
    {"any read rtu", any_read_rtu_run}, {"any read ascii", any_read_ascii_run},
};

static void prepare(char **numbers)
{
    for (int at = 0; at < 256; at++) {
        change[at] = at;
        for (int step = 0; step < 8; step++)
            change[at] = change[at] & 1 ? change[at] >> 1 ^ 0xA001 : change[at] >> 1;
    }
    rtu_reply[0] = 1, rtu_reply[1] = 3, rtu_reply[2] = 2 * WORDS;
    for (int at = 0; at < WORDS; at++) {
        right[at] = atoi(numbers[at]);
        rtu_reply[3 + 2 * at] = right[at] >> 8, rtu_reply[4 + 2 * at] = right[at];
    }
    ascii_length = encode(rtu_reply, 3 + 2 * WORDS, ascii_reply);
    rtu_length = seal(rtu_reply, 3 + 2 * WORDS);
}

static void show(const char *name, const uint8_t *bytes, unsigned count)
{
    printf("# %s ", name);
    for (unsigned at = 0; at < count; at++)
        printf("%02x", bytes[at]);
    putchar('\n');
}

/* Start a block that asks, run it, and show what it would send. */
#define ASKS(TYPE, FORM, BOX)                                                                        \
    (START(TYPE, FORM##_block), FORM##_run(),                                                        \
     show(#FORM, FORM##_block.BOX.value.table, FORM##_block.COUNT.value))
/* Start a block that reads, give it the reply, run it; whether it has the right words. */
#define READS(TYPE, FORM, BOX, REPLY, LENGTH)                                                        \
    (START(TYPE, FORM##_block), FORM##_block.COUNT.value = LENGTH,                                   \
     memcpy(FORM##_block.BOX.value.table, REPLY, LENGTH), FORM##_run(),                              \
     FORM##_block.ERRORID.value == 0 && FORM##_block.WORDCOUNT.value == WORDS                        \
         && memcmp(FORM##_block.WORDS.value.table, right, sizeof right) == 0)

static int good_c(void)
{
    ask_rtu(), show("c_ask_rtu", adu, built);
    ask_ascii(), show("c_ask_ascii", chars, built);
    read_rtu();
    int good = found == WORDS && memcmp(words, right, sizeof right) == 0;
    memset(words, 0, sizeof words), read_ascii();
    return good && found == WORDS && memcmp(words, right, sizeof right) == 0;
}

static int good_blocks(void)
{
    ASKS(BN_DRIVEASKRTU, drive_ask_rtu, ADU), ASKS(BN_DRIVEASKASCII, drive_ask_ascii, CHARS);
    ASKS(BN_ANYASKRTU, any_ask_rtu, ADU), ASKS(BN_ANYASKASCII, any_ask_ascii, CHARS);
    return READS(BN_DRIVEREADRTU, drive_read_rtu, ADU, rtu_reply, rtu_length)
        && READS(BN_DRIVEREADASCII, drive_read_ascii, CHARS, ascii_reply, ascii_length)
        && READS(BN_ANYREADRTU, any_read_rtu, ADU, rtu_reply, rtu_length)
        && READS(BN_ANYREADASCII, any_read_ascii, CHARS, ascii_reply, ascii_length);
}

int main(int count, char **arguments)
{
    if (count != 2 + WORDS)
        return 2;
    prepare(arguments + 2);
    if (!good_c() || !good_blocks()) {
        fputs("a reply is not believed\n", stderr);
        return 1;
    }
    measure(forms, sizeof forms / sizeof *forms, atoi(arguments[1]));
    return 0;
}
