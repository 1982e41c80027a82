/* What the parts that are compiled once for each family share: NAME(NOUN) is FAMILY_NOUN. */
#define GLUE(left, right) left##_##right
#define GLUE_VALUES(left, right) GLUE(left, right)
#define NAME(noun) GLUE_VALUES(FAMILY, noun)
#define START_NAMED(TYPE, instance) START(TYPE, instance)

/* 0 to 8, each power of two, FFFFH. */
static int is_edge(unsigned word)
{
    return word < 8 || (word & (word - 1)) == 0 || word == 0xFFFF;
}

/* The next of these words; 65536 after the last. */
static unsigned next_edge(unsigned word)
{
    return word < 8 || word == 0xFFFF ? word + 1 : word == 0x8000 ? 0xFFFF : 2 * word;
}

static float real(uint32_t pattern)
{
    float value;
    memcpy(&value, &pattern, sizeof(value));
    return value;
}

enum { PINS = 4 };

/* What a reference block is given: SpeedReferenceHz, MaximumHz, FullScaleHz, ReferenceScale. */
typedef struct {
    float asked, most, whole, scale;
} Pins;

static Pins pins_of(const uint32_t bits[PINS])
{
    return (Pins){real(bits[0]), real(bits[1]), real(bits[2]), real(bits[3])};
}

/* What a reference block answers. */
typedef struct {
    uint16_t error, value;
    uint8_t limited, address_is_right;
} Encoded;

typedef struct {
    uint64_t cases, words, beside, falling, wrong;
} Swept;

typedef struct {
    const char *name;
    int (*standstill)(const char *, int);
    int (*sweep)(int, uint32_t[PINS], uint32_t, uint32_t, uint32_t);
    int (*patterns)(void);
} Family;
