/* CRC-16 in C and by the blocks, frames of 8, 64 and 256 bytes. `independent`: call after call over the same bytes, which a
 * processor overlaps. `chained`: the first byte is the result before, so that each call waits for the one before it, as
 * a program waits for its checksum. Argument: rounds. */

static uint8_t frame[256];
static volatile uint16_t sink;
static uint16_t words[256];
static uint8_t high[256], low[256];

/* One table of 256 words. */
static __attribute__((noinline)) uint16_t table(const uint8_t *bytes, unsigned count)
{
    uint16_t crc = 0xFFFF;
    for (unsigned at = 0; at < count; at++)
        crc = (uint16_t)(crc >> 8) ^ words[(crc ^ bytes[at]) & 0xFF];
    return crc;
}

/* Two tables of 256 bytes, one for each half of the checksum. */
static __attribute__((noinline)) uint16_t two_tables(const uint8_t *bytes, unsigned count)
{
    uint8_t upper = 0xFF, lower = 0xFF;
    while (count-- > 0) {
        unsigned place = lower ^ *bytes++;
        lower = upper ^ low[place];
        upper = high[place];
    }
    return (uint16_t)(upper << 8 | lower);
}

/* Eight steps of the polynomial for each byte. */
static __attribute__((noinline)) uint16_t bitwise(const uint8_t *bytes, unsigned count)
{
    uint16_t crc = 0xFFFF;
    while (count-- > 0) {
        crc ^= *bytes++;
        for (int step = 0; step < 8; step++)
            crc = crc & 1 ? crc >> 1 ^ 0xA001 : crc >> 1;
    }
    return crc;
}

/* A FUNCTION over the whole frame, as iec2c translates it. */
static __attribute__((noinline)) uint16_t function(const uint8_t *bytes, unsigned count)
{
    return BN_CRCFUNCTION(1, NULL, count, (void *)bytes);
}

#define C_FORM(FORM, SIZE)                                                                  \
    static void FORM##_##SIZE(void) { sink = FORM(frame, SIZE); }                           \
    static void FORM##_##SIZE##_chained(void) { sink = FORM(frame, SIZE), frame[0] = sink; }
#define BLOCK(TYPE, FORM, SIZE)                                                                         \
    static TYPE FORM##_at_##SIZE;                                                                       \
    static void FORM##_##SIZE(void) { TYPE##_body__(&FORM##_at_##SIZE); }                               \
    static void FORM##_##SIZE##_chained(void)                                                           \
    {                                                                                                   \
        TYPE##_body__(&FORM##_at_##SIZE);                                                               \
        FORM##_at_##SIZE.ADU.value.table[0] = FORM##_at_##SIZE.CRC.value;                               \
    }
#define SIZES(WHAT) WHAT(8) WHAT(64) WHAT(256)
#define ALL(SIZE)                                                                                       \
    C_FORM(table, SIZE) C_FORM(two_tables, SIZE) C_FORM(bitwise, SIZE) C_FORM(function, SIZE)           \
    BLOCK(MB_CRC16, block, SIZE) BLOCK(MB_CRC16COMPACT, compact, SIZE) BLOCK(BN_CRCCALLER, called, SIZE)
SIZES(ALL)

#define ROW(FORM, SIZE) {#FORM " " #SIZE " independent", FORM##_##SIZE}, {#FORM " " #SIZE " chained", FORM##_##SIZE##_chained}
#define ROWS(SIZE)                                                                                      \
    ROW(table, SIZE), ROW(two_tables, SIZE), ROW(bitwise, SIZE), ROW(function, SIZE), ROW(block, SIZE), \
        ROW(compact, SIZE), ROW(called, SIZE),
static const Form forms[] = {SIZES(ROWS)};

static void fill(void)
{
    for (int at = 0; at < 256; at++) {
        uint16_t change = at;
        for (int step = 0; step < 8; step++)
            change = change & 1 ? change >> 1 ^ 0xA001 : change >> 1;
        words[at] = change, high[at] = change >> 8, low[at] = change;
        frame[at] = 37 * at + 11;
    }
}

/* Whether a block gives what the bits say. */
#define GOOD(TYPE, FORM, SIZE)                                                                          \
    (START(TYPE, FORM##_at_##SIZE), memcpy(FORM##_at_##SIZE.ADU.value.table, frame, 256),               \
     FORM##_at_##SIZE.LENGTH.value = SIZE, FORM##_##SIZE(), FORM##_at_##SIZE.CRC.value == bitwise(frame, SIZE))
#define AGREE(SIZE)                                                                                     \
    &&GOOD(MB_CRC16, block, SIZE) && GOOD(MB_CRC16COMPACT, compact, SIZE) && GOOD(BN_CRCCALLER, called, SIZE)   \
    && table(frame, SIZE) == bitwise(frame, SIZE) && two_tables(frame, SIZE) == bitwise(frame, SIZE)    \
    && function(frame, SIZE) == bitwise(frame, SIZE)

int main(int count, char **arguments)
{
    fill();
    if (!(count == 2 SIZES(AGREE))) {
        fputs("the forms differ\n", stderr);
        return 1;
    }
    measure(forms, sizeof forms / sizeof *forms, atoi(arguments[1]));
    return 0;
}
