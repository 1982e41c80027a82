/* FAMILY_Reference against the rule in exact arithmetic.
 *
 * The count of a reference is asked * TIMES * scale / (BY * maximum), where the scale is there only HAS_SCALE and the
 * maximum only PERCENT. A double holds numerator and denominator exactly: 24 bits of a REAL, or 48 of two, and few more.
 * The word is the count rounded half up, at most HIGHEST. Single precision may round a count that is within 2^-21 of
 * itself beside a half to the other side; `beside` counts those. */
typedef struct {
    double above, below;
    int limited;
} NAME(Count);

static NAME(Count) NAME(count)(float asked, float most, float scale)
{
    NAME(Count) count = {.limited = asked > most};
    count.above = (double)(count.limited ? most : asked) * TIMES * (HAS_SCALE ? (double)scale : 1);
    count.below = (PERCENT ? (double)most : 1) * BY;
    return count;
}

/* The error that the pins must give; 0 without. */
static unsigned NAME(refusal)(float asked, float most, float scale)
{
    const float largest = 1.0e30f;
    if (!(asked >= -largest && asked <= largest))
        return NOT_A_NUMBER;
    if (!(most >= 0.1f && most <= 10000.0f))
        return NO_MAXIMUM;
    if (HAS_SCALE && !(scale > 0 && scale <= 1.0e6f))
        return NO_SCALE;
    NAME(Count) count = NAME(count)(asked, most, scale);
    return 2 * count.above < -count.below ? NEGATIVE : 0;
}

/* Half up: the word w for which (2 w - 1) below <= 2 above < (2 w + 1) below. */
static unsigned NAME(rounded)(const NAME(Count) *count)
{
    if (count->above >= HIGHEST * count->below)
        return HIGHEST;
    if (count->above <= 0)
        return 0;
    unsigned word = (unsigned)(count->above / count->below + 0.5);
    while ((2.0 * word + 1) * count->below <= 2 * count->above)
        word++;
    while (word > 0 && (2.0 * word - 1) * count->below > 2 * count->above)
        word--;
    return word;
}

/* The same as a question: whether a word is the one that the count is rounded to. */
static int NAME(is_rounded)(const NAME(Count) *count, unsigned word)
{
    if (count->above >= HIGHEST * count->below)
        return word == HIGHEST;
    return word <= HIGHEST && (2.0 * word - 1) * count->below <= 2 * count->above &&
           (2.0 * word + 1) * count->below > 2 * count->above;
}

static Encoded NAME(rule)(float asked, float most, float scale)
{
    Encoded wanted = {.error = NAME(refusal)(asked, most, scale), .address_is_right = 1};
    if (wanted.error)
        return wanted;
    NAME(Count) count = NAME(count)(asked, most, scale);
    wanted.value = NAME(rounded)(&count);
    wanted.limited = count.limited || count.above > HIGHEST * count.below;
    return wanted;
}

static NAME(REFERENCE) NAME(block);

static Encoded NAME(encode)(float asked, float most, float scale)
{
    NAME(block).SPEEDREFERENCEHZ.value = asked;
    NAME(block).MAXIMUMHZ.value = most;
#if HAS_SCALE
    NAME(block).REFERENCESCALE.value = scale;
#endif
    NAME(REFERENCE_body__)(&NAME(block));
    return (Encoded){NAME(block).ERRORID.value, NAME(block).VALUE.value, NAME(block).LIMITED.value,
                     NAME(block).ADDRESS.value == REGISTER};
}

/* Whether another word than the exact one is as good: the count is beside the half between them. */
static int NAME(beside)(unsigned found, unsigned wanted, float asked, float most, float scale)
{
    NAME(Count) count = NAME(count)(asked, most, scale);
    double half = (double)found + wanted;
    return (found == wanted + 1 || wanted == found + 1) &&
           fabs(2 * count.above - half * count.below) <= 2 * count.above * 0x1p-21;
}

/* Whether the count is so near the highest word that single precision cannot say if it is above. */
static int NAME(at_the_end)(float asked, float most, float scale)
{
    NAME(Count) count = NAME(count)(asked, most, scale);
    return fabs(count.above - HIGHEST * count.below) <= count.above * 0x1p-21;
}

/* Whether the count is so near half a count below zero that single precision cannot say if it is below. */
static int NAME(at_zero)(float asked, float most, float scale)
{
    NAME(Count) count = NAME(count)(asked, most, scale);
    return count.above < 0 && fabs(2 * count.above + count.below) <= count.below * 0x1p-21;
}

/* Whether the answer is what the rule says, or as good; `beside` counts the latter. */
static int NAME(is_right)(Swept *swept, const Encoded *found, float asked, float most, float scale)
{
    unsigned error = NAME(refusal)(asked, most, scale);
    if (error || found->error) {
        int either = (error ? error : found->error) == NEGATIVE && NAME(at_zero)(asked, most, scale);
        swept->beside += either && found->error != error;
        return (found->error == error || either) && found->value == 0 && !found->limited && found->address_is_right;
    }
    NAME(Count) count = NAME(count)(asked, most, scale);
    int limited = count.limited || count.above > HIGHEST * count.below;
    swept->words++;
    if (found->limited == limited && NAME(is_rounded)(&count, found->value))
        return found->address_is_right;
    swept->beside++;
    unsigned wanted = NAME(rounded)(&count);
    return found->address_is_right &&
           (found->value == wanted || NAME(beside)(found->value, wanted, asked, most, scale)) &&
           (found->limited == limited || NAME(at_the_end)(asked, most, scale));
}

static void NAME(judge)(Swept *swept, const Encoded *found, float asked, float most, float scale)
{
    swept->cases++;
    if (NAME(is_right)(swept, found, asked, most, scale) || swept->wrong++ >= 5)
        return;
    Encoded wanted = NAME(rule)(asked, most, scale);
    printf("difference %a of %a by %a: %u %u %u, not %u %u %u\n", asked, most, scale, found->error, found->value,
           found->limited, wanted.error, wanted.value, wanted.limited);
}

/* `sweep FAMILY PIN ASKED MOST SCALE FIRST LAST STEP`: PIN 0, 1 or 2 goes through the bit patterns FIRST to LAST, the
 * others keep theirs. Where the reference itself goes up, its word must not fall; `reached` counts the words. */
static int NAME(sweep)(int pin, uint32_t pins[3], uint32_t first, uint32_t last, uint32_t step)
{
    static uint8_t seen[65536];
    Swept swept = {0};
    unsigned before = 0, reached = 0;
    START_NAMED(NAME(REFERENCE), NAME(block));
    for (uint64_t pattern = first; pattern <= last; pattern += step) {
        pins[pin] = pattern;
        float asked = real(pins[0]), most = real(pins[1]), scale = real(pins[2]);
        Encoded found = NAME(encode)(asked, most, scale);
        NAME(judge)(&swept, &found, asked, most, scale);
        if (found.error)
            continue;
        reached += !seen[found.value];
        seen[found.value] = 1;
        swept.falling += pin == 0 && pattern < 0x80000000u && found.value < before;
        before = found.value;
    }
    printf("cases %" PRIu64 "\nwords %" PRIu64 "\nbeside %" PRIu64 "\nreached %u\nwrong %" PRIu64 "\n", swept.cases,
           swept.words, swept.beside, reached, swept.wrong + swept.falling);
    return swept.wrong + swept.falling != 0;
}

/* `patterns FAMILY IN OUT`: records of three patterns; what the block and what the rule answer, and the judgement. */
static int NAME(patterns)(void)
{
    Swept swept = {0};
    uint32_t pins[3];
    START_NAMED(NAME(REFERENCE), NAME(block));
    while (more()) {
        TAKE(pins);
        float asked = real(pins[0]), most = real(pins[1]), scale = real(pins[2]);
        Encoded found = NAME(encode)(asked, most, scale), wanted = NAME(rule)(asked, most, scale);
        NAME(judge)(&swept, &found, asked, most, scale);
        NAME(judge)(&swept, &wanted, asked, most, scale);
        GIVE(found);
        GIVE(wanted);
    }
    printf("cases %" PRIu64 "\nbeside %" PRIu64 "\nwrong %" PRIu64 "\n", swept.cases, swept.beside, swept.wrong);
    return swept.wrong != 0;
}
