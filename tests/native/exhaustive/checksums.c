/* CRC and LRC against their definitions, MODBUS over Serial Line V1.02, 6.2.2 and 6.2.1.
 *
 * The blocks start from FFFFH, so a state other than that is reached by bytes in front: the frames of two bytes reach
 * each of the 65536 states once, and those of three bytes are then all pairs of state and byte. */
typedef struct {
    uint64_t cases, wrong;
} Tally;

static MB_CRC16 crc_table;
static MB_CRC16COMPACT crc_compact;
static MB_LRC lrc;
static uint8_t bytes[256];

/* One byte into the CRC as 6.2.2 tells it: into the low byte, then eight times a bit to the right, with A001H where the
 * bit that falls out is 1. */
static uint16_t crc_step(uint16_t state, uint8_t byte)
{
    state ^= byte;
    for (int bit = 0; bit < 8; bit++)
        state = state & 1 ? state >> 1 ^ 0xA001 : state >> 1;
    return state;
}

static uint16_t crc_of(unsigned length)
{
    uint16_t state = 0xFFFF;
    for (unsigned at = 0; at < length; at++)
        state = crc_step(state, bytes[at]);
    return state;
}

/* The two's complement of the sum of the bytes. */
static uint8_t lrc_of(unsigned length)
{
    unsigned sum = 0;
    for (unsigned at = 0; at < length; at++)
        sum += bytes[at];
    return -sum & 0xFF;
}

static void judge(Tally *tally, const char *what, unsigned input, unsigned found, unsigned wanted)
{
    tally->cases++;
    if (found != wanted && tally->wrong++ < 5)
        printf("difference %s %06X: %04X, not %04X\n", what, input, found, wanted);
}

static void load(unsigned frame, unsigned length)
{
    for (unsigned at = 0; at < length; at++)
        bytes[at] = frame >> 8 * (length - 1 - at);
    memcpy(crc_table.ADU.value.table, bytes, length);
    memcpy(crc_compact.ADU.value.table, bytes, length);
    memcpy(lrc.ADU.value.table, bytes, length);
}

static void states_and_bytes(Tally *tally)
{
    static uint8_t reached[65536];
    unsigned states = 0;
    crc_table.LENGTH.value = crc_compact.LENGTH.value = 3;
    for (unsigned front = 0; front < 65536; front++) {
        load(front << 8, 3);
        uint16_t state = crc_of(2);
        states += !reached[state];
        reached[state] = 1;
        for (unsigned byte = 0; byte < 256; byte++) {
            uint16_t wanted = crc_step(state, byte);
            crc_table.ADU.value.table[2] = crc_compact.ADU.value.table[2] = byte;
            MB_CRC16_body__(&crc_table);
            MB_CRC16COMPACT_body__(&crc_compact);
            judge(tally, "MB_Crc16 of the bytes", front << 8 | byte, crc_table.CRC.value, wanted);
            judge(tally, "MB_Crc16Compact of the bytes", front << 8 | byte, crc_compact.CRC.value, wanted);
        }
    }
    judge(tally, "states that two bytes reach", 65536, states, 65536);
}

static void table_entries(Tally *tally)
{
    for (unsigned byte = 0; byte < 256; byte++)
        judge(tally, "entry of the table", byte, crc_table.TABLE.value.table[byte], crc_step(0, byte));
}

/* A sum modulo 256 is reached by one byte, so frames of two bytes are all pairs of sum and byte. */
static void sums_and_bytes(Tally *tally)
{
    lrc.LENGTH.value = 2;
    for (unsigned frame = 0; frame < 65536; frame++) {
        load(frame, 2);
        MB_LRC_body__(&lrc);
        judge(tally, "MB_Lrc of the bytes", frame, lrc.LRC.value, lrc_of(2));
    }
}

/* More than 256 counts as 256. */
static void lengths(Tally *tally, unsigned seed)
{
    for (unsigned at = 0; at < 256; at++)
        bytes[at] = crc_table.ADU.value.table[at] = crc_compact.ADU.value.table[at] = lrc.ADU.value.table[at] =
            (seed = seed * 1103515245 + 12345) >> 16;
    for (unsigned length = 0; length < 65536; length++) {
        unsigned counts = length < 256 ? length : 256;
        crc_table.LENGTH.value = crc_compact.LENGTH.value = lrc.LENGTH.value = length;
        MB_CRC16_body__(&crc_table);
        MB_CRC16COMPACT_body__(&crc_compact);
        MB_LRC_body__(&lrc);
        judge(tally, "MB_Crc16 of the length", length, crc_table.CRC.value, crc_of(counts));
        judge(tally, "MB_Crc16Compact of the length", length, crc_compact.CRC.value, crc_of(counts));
        judge(tally, "MB_Lrc of the length", length, lrc.LRC.value, lrc_of(counts));
    }
}

static int checksums(unsigned seed)
{
    Tally tally = {0};
    START(MB_CRC16, crc_table);
    START(MB_CRC16COMPACT, crc_compact);
    START(MB_LRC, lrc);
    table_entries(&tally);
    states_and_bytes(&tally);
    sums_and_bytes(&tally);
    lengths(&tally, seed);
    printf("cases %" PRIu64 "\nwrong %" PRIu64 "\n", tally.cases, tally.wrong);
    return tally.wrong != 0;
}
