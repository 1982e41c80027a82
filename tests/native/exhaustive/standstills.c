/* FAMILY: pairs of words against a truth table for each word, since all conditions hold for a pair if each word's own
 * do: `standstill FAMILY TABLES WHOLE`. WHOLE 1: all pairs, 2^32. WHOLE 0: all pairs of which one is below 8, one bit or
 * FFFFH. */
static int NAME(standstill)(const char *path, int whole)
{
    static NAME(STANDSTILL) proof;
    static uint8_t first[65536], second[65536];
    uint64_t cases = 0, wrong = 0;
    from = fopen(path, "rb");
    TAKE(first);
    TAKE(second);
    START_NAMED(NAME(STANDSTILL), proof);
    for (unsigned one = 0; one < 65536; one++)
        for (unsigned other = 0; other < 65536; other = whole || is_edge(one) ? other + 1 : next_edge(other)) {
            proof.FIRST_WORD.value = one;
            proof.SECOND_WORD.value = other;
            NAME(STANDSTILL_body__)(&proof);
            cases++;
            if (proof.STANDSTILLPROVEN.value != (first[one] && second[other]) && wrong++ < 5)
                printf("difference %04XH %04XH: %d\n", one, other, proof.STANDSTILLPROVEN.value);
        }
    printf("cases %" PRIu64 "\nwrong %" PRIu64 "\n", cases, wrong);
    return wrong != 0;
}
