/* Chance that costs a nanosecond and depends on the seed alone: xorshift64* (Marsaglia 2003, Vigna 2016). */
static uint64_t chance_state = 88172645463325252u;

static uint64_t chance(void)
{
    chance_state ^= chance_state >> 12;
    chance_state ^= chance_state << 25;
    chance_state ^= chance_state >> 27;
    return chance_state * 0x2545F4914F6CDD1Du;
}

/* 0 to bound - 1; the bias of a 32-bit product does not matter here. */
static unsigned below(unsigned bound) { return (unsigned)(((chance() >> 32) * bound) >> 32); }

static int one_in(unsigned bound) { return below(bound) == 0; }

static void noise(void *memory, size_t size)
{
    unsigned char *next = memory;
    for (; size >= 8; size -= 8, next += 8) {
        uint64_t value = chance();
        memcpy(next, &value, 8);
    }
    for (; size > 0; size--)
        *next++ = (unsigned char)(chance() >> 40);
}

/* Where integers go wrong: ends of types, of the arrays and of what a frame may carry. */
static const uint16_t EDGES[] = {0,     1,     2,     3,     4,     5,     6,     8,     10,    11,    16,   123,
                                 124,   125,   126,   127,   128,   129,   247,   248,   250,   251,   252,  253,
                                 254,   255,   256,   257,   258,   510,   511,   512,   513,   514,   515,  516,
                                 1024,  4096,  32766, 32767, 32768, 32769, 65407, 65408, 65533, 65534, 65535};
#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

typedef struct {
    const uint16_t *words;
    unsigned word_count;
    const float *reals;
    unsigned real_count;
} Telling; /* numbers of a block's own text, and their neighbours */

static uint16_t some_word(const Telling *telling)
{
    uint64_t way = chance();
    unsigned kind = (unsigned)(way & 7);
    if (kind < 3 && telling->word_count)
        return telling->words[below(telling->word_count)];
    if (kind < 5)
        return EDGES[below(COUNT(EDGES))];
    if (kind == 5)
        return (uint16_t)(1u << (way >> 60)) ^ (uint16_t)(way >> 8 & 1 ? 0xFFFF : 0);
    return (uint16_t)(way >> 32);
}

static uint16_t word_among(const Telling *telling, const uint16_t *likely, unsigned count)
{
    return one_in(8) ? some_word(telling) : likely[below(count)];
}

/* A REAL of every kind: not a number (quiet, signalling, negative), infinite, denormal, both zeros, limits and their
 * neighbours, any pattern of bits, and what a person would set. */
static float some_real(const Telling *telling)
{
    static const uint32_t PATTERNS[] = {
        0x7FC00000, 0xFFC00000, 0x7F800001, 0xFFBFFFFF, 0x7FFFFFFF, 0x7F800000, 0xFF800000, 0x00000000,
        0x80000000, 0x00000001, 0x80000001, 0x007FFFFF, 0x807FFFFF, 0x00800000, 0x7F7FFFFF, 0xFF7FFFFF,
        0x4EFFFFFF, 0x4F000000, 0x4F000001, 0xCF000000, 0xCF000001, 0x477FFF00, 0x47800000, 0x477FFF80,
        0x3F000000, 0x3EFFFFFF, 0x3F800000, 0x42480000,
    };
    union {
        uint32_t bits;
        float real;
    } made;
    switch (below(8)) {
    case 0:
    case 1:
        made.bits = PATTERNS[below(COUNT(PATTERNS))];
        return made.real;
    case 2:
        made.real = telling->real_count ? telling->reals[below(telling->real_count)] : 1.0f;
        made.bits += below(5) - 2u;
        return made.real;
    case 3:
        made.bits = (uint32_t)chance();
        return made.real;
    case 4:
        return (float)below(65537) / 100.0f;
    case 5:
        return (float)((double)chance() / 18446744073709551616.0 * 700.0);
    case 6:
        return ((float)below(65537) + 0.5f) / 100.0f;
    default:
        return (float)below(1001);
    }
}

/* Bits at random, now and then few or many of them. */
static uint64_t some_bits(void)
{
    uint64_t bits = chance();
    switch (below(4)) {
    case 0:
        return bits & chance() & chance();
    case 1:
        return bits | chance();
    default:
        return bits;
    }
}
