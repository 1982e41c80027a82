/* FAMILY_Reference against the rule in exact arithmetic.
 *
 * The count of a reference is asked * TIMES * scale / (BY * whole), where the scale is there only HAS_SCALE and the
 * whole, which is FullScaleHz, only PERCENT. A double holds numerator and denominator exactly: 24 bits of a REAL, or 48 of two, and few more.
 * The word is the count rounded half up, at most HIGHEST. Single precision may round a count that is within 2^-21 of
 * itself beside a half to the other side; `beside` counts those. */
typedef struct {
    double above, below;
    int limited;
} NAME(Count);

static NAME(Count) NAME(count)(const Pins *pins)
{
    const float limit = pins->whole > 0 && pins->whole < pins->most ? pins->whole : pins->most;
    NAME(Count) count = {.limited = pins->asked > limit};
    count.above = (double)(count.limited ? limit : pins->asked) * TIMES * (HAS_SCALE ? (double)pins->scale : 1);
    count.below = (PERCENT ? (double)pins->whole : 1) * BY;
    return count;
}

/* The error that the pins must give; 0 without. */
static unsigned NAME(refusal)(const Pins *pins)
{
    const float largest = 1.0e30f;
    if (!(pins->asked >= -largest && pins->asked <= largest))
        return NOT_A_NUMBER;
    if (!(pins->most >= 0.1f && pins->most <= 10000.0f))
        return NO_MAXIMUM;
    if (!(pins->whole >= 0.1f && pins->whole <= 10000.0f) && (PERCENT || pins->whole != 0))
        return NO_FULL_SCALE;
    if (HAS_SCALE && !(pins->scale > 0 && pins->scale <= 1.0e6f))
        return NO_SCALE;
    NAME(Count) count = NAME(count)(pins);
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

static Encoded NAME(rule)(const Pins *pins)
{
    Encoded wanted = {.error = NAME(refusal)(pins), .address_is_right = 1};
    if (wanted.error)
        return wanted;
    NAME(Count) count = NAME(count)(pins);
    wanted.value = NAME(rounded)(&count);
    wanted.limited = count.limited || count.above > HIGHEST * count.below;
    return wanted;
}

static NAME(REFERENCE) NAME(block);

static Encoded NAME(encode)(const Pins *pins)
{
    NAME(block).SPEEDREFERENCEHZ.value = pins->asked;
    NAME(block).MAXIMUMHZ.value = pins->most;
    NAME(block).FULLSCALEHZ.value = pins->whole;
#if HAS_SCALE
    NAME(block).REFERENCESCALE.value = pins->scale;
#endif
    NAME(REFERENCE_body__)(&NAME(block));
    return (Encoded){NAME(block).ERRORID.value, NAME(block).VALUE.value, NAME(block).LIMITED.value,
                     NAME(block).ADDRESS.value == REGISTER};
}

/* Whether another word than the exact one is as good: the count is beside the half between them. */
static int NAME(beside)(unsigned found, unsigned wanted, const Pins *pins)
{
    NAME(Count) count = NAME(count)(pins);
    double half = (double)found + wanted;
    return (found == wanted + 1 || wanted == found + 1) &&
           fabs(2 * count.above - half * count.below) <= 2 * count.above * 0x1p-21;
}

/* Whether the count is so near the highest word that single precision cannot say if it is above. */
static int NAME(at_the_end)(const Pins *pins)
{
    NAME(Count) count = NAME(count)(pins);
    return fabs(count.above - HIGHEST * count.below) <= count.above * 0x1p-21;
}

/* Whether the count is so near half a count below zero that single precision cannot say if it is below. */
static int NAME(at_zero)(const Pins *pins)
{
    NAME(Count) count = NAME(count)(pins);
    return count.above < 0 && fabs(2 * count.above + count.below) <= count.below * 0x1p-21;
}

/* Whether the answer is what the rule says, or as good; `beside` counts the latter. */
static int NAME(is_right)(Swept *swept, const Encoded *found, const Pins *pins)
{
    unsigned error = NAME(refusal)(pins);
    if (error || found->error) {
        int either = (error ? error : found->error) == NEGATIVE && NAME(at_zero)(pins);
        swept->beside += either && found->error != error;
        return (found->error == error || either) && found->value == 0 && !found->limited && found->address_is_right;
    }
    NAME(Count) count = NAME(count)(pins);
    int limited = count.limited || count.above > HIGHEST * count.below;
    swept->words++;
    if (found->limited == limited && NAME(is_rounded)(&count, found->value))
        return found->address_is_right;
    swept->beside++;
    unsigned wanted = NAME(rounded)(&count);
    return found->address_is_right &&
           (found->value == wanted || NAME(beside)(found->value, wanted, pins)) &&
           (found->limited == limited || NAME(at_the_end)(pins));
}

static void NAME(judge)(Swept *swept, const Encoded *found, const Pins *pins)
{
    swept->cases++;
    if (NAME(is_right)(swept, found, pins) || swept->wrong++ >= 5)
        return;
    Encoded wanted = NAME(rule)(pins);
    printf("difference %a below %a of %a by %a: %u %u %u, not %u %u %u\n", pins->asked, pins->most, pins->whole,
           pins->scale, found->error, found->value, found->limited, wanted.error, wanted.value, wanted.limited);
}

/* `sweep FAMILY PIN ASKED MOST WHOLE SCALE FIRST LAST STEP`: PIN 0 to 3 goes through the bit patterns FIRST to LAST,
 * the others keep theirs. Where the reference itself goes up, its word must not fall; `reached` counts the words. */
static int NAME(sweep)(int pin, uint32_t bits[PINS], uint32_t first, uint32_t last, uint32_t step)
{
    static uint8_t seen[65536];
    Swept swept = {0};
    unsigned before = 0, reached = 0;
    START_NAMED(NAME(REFERENCE), NAME(block));
    for (uint64_t pattern = first; pattern <= last; pattern += step) {
        bits[pin] = pattern;
        const Pins pins = pins_of(bits);
        Encoded found = NAME(encode)(&pins);
        NAME(judge)(&swept, &found, &pins);
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

/* `patterns FAMILY IN OUT`: records of four patterns; what the block and what the rule answer, and the judgement. */
static int NAME(patterns)(void)
{
    Swept swept = {0};
    uint32_t bits[PINS];
    START_NAMED(NAME(REFERENCE), NAME(block));
    while (more()) {
        TAKE(bits);
        const Pins pins = pins_of(bits);
        Encoded found = NAME(encode)(&pins), wanted = NAME(rule)(&pins);
        NAME(judge)(&swept, &found, &pins);
        NAME(judge)(&swept, &wanted, &pins);
        GIVE(found);
        GIVE(wanted);
    }
    printf("cases %" PRIu64 "\nbeside %" PRIu64 "\nwrong %" PRIu64 "\n", swept.cases, swept.beside, swept.wrong);
    return swept.wrong != 0;
}
