/* Runs one block or function on as many inputs as asked for; the first that is wrong ends the program with its input in
 * hexadecimal: the state before the scan, bytes in the order of the array, numbers as such. */
#ifndef SECONDS_WITHOUT_END
#define SECONDS_WITHOUT_END 30 /* of the processor, for this many inputs: */
#endif
#ifndef INPUTS_BETWEEN_ALARMS
#define INPUTS_BETWEEN_ALARMS 4096
#endif

static const char *running = "";
static uint64_t input_number, run_seed;
static void (*show)(void);
static uint64_t results[64];

const char *__asan_default_options(void) { return "detect_leaks=0"; }
extern void __sanitizer_set_death_callback(void (*callback)(void)) __attribute__((weak));

static void tell(const char *what)
{
    printf("FOUND %s, seed %" PRIu64 ", input %" PRIu64 ": %s\n", running, run_seed, input_number, what);
    if (show)
        show();
    fflush(stdout);
}

/* Both are called, by what stops the program: the first by gcc's UBSan, which does not call the second. */
void __ubsan_on_report(void)
{
    if (show)
        tell("the sanitizer stops it");
    show = NULL;
}
static void died(void) { __ubsan_on_report(); }

static void endless(int signal_number)
{
    (void)signal_number;
    tell("a scan does not end");
    _exit(1);
}

static void complain(const char *what)
{
    tell(what);
    exit(1);
}

static void show_bytes(const char *name, const void *memory, size_t size)
{
    const unsigned char *bytes = memory;
    printf("  %s = ", name);
    for (size_t at = 0; at < size; at++)
        printf("%02X", bytes[at]);
    printf("\n");
}

static void show_words(const char *name, const uint16_t *words, size_t count)
{
    printf("  %s = ", name);
    for (size_t at = 0; at < count; at++)
        printf("%04X ", words[at]);
    printf("\n");
}

static void show_number(const char *name, uint64_t value) { printf("  %s = %" PRIX64 "\n", name, value); }

static void show_real(const char *name, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, 4);
    printf("  %s = %08" PRIX32 " (%.9g)\n", name, bits, (double)value);
}

static int known_result(unsigned error)
{
    for (unsigned at = 0; at < COUNT(KNOWN_RESULTS); at++)
        if (KNOWN_RESULTS[at] == error)
            return 1;
    return 0;
}

static void begin(uint64_t number)
{
    input_number = number;
    if (number % INPUTS_BETWEEN_ALARMS == 0)
        setitimer(ITIMER_VIRTUAL, &(struct itimerval){{0, 0}, {SECONDS_WITHOUT_END, 0}}, NULL);
}

/* A used instance, now and then begun anew; a fresh one beside it now and then, which must answer the same. */
#define DRIVE_BLOCK(NAME)                                                                                              \
    static NAME NAME##_used, NAME##_was, NAME##_fresh;                                                                 \
    static void NAME##_show(void) { NAME##_pins(&NAME##_was); }                                                        \
    static void NAME##_run(uint64_t count)                                                                             \
    {                                                                                                                  \
        const char *wrong;                                                                                             \
        show = NAME##_show;                                                                                            \
        START(NAME, NAME##_used);                                                                                      \
        for (uint64_t number = 0; number < count; number++) {                                                          \
            begin(number);                                                                                             \
            if (one_in(256))                                                                                           \
                START(NAME, NAME##_used);                                                                              \
            NAME##_fill(&NAME##_used);                                                                                 \
            NAME##_was = NAME##_used;                                                                                  \
            NAME##_body__(&NAME##_used);                                                                               \
            if ((wrong = NAME##_general(&NAME##_used, &NAME##_was)) ||                                                 \
                (wrong = NAME##_right(&NAME##_used, &NAME##_was)))                                                     \
                complain(wrong);                                                                                       \
            if (number % 16 == 0) {                                                                                    \
                START(NAME, NAME##_fresh);                                                                             \
                NAME##_give(&NAME##_fresh, &NAME##_was);                                                               \
                NAME##_body__(&NAME##_fresh);                                                                          \
                if ((wrong = NAME##_same(&NAME##_used, &NAME##_fresh)))                                                \
                    complain(wrong);                                                                                   \
            }                                                                                                          \
        }                                                                                                              \
    }

#define DRIVE_FUNCTION(NAME)                                                                                           \
    static void NAME##_run(uint64_t count)                                                                             \
    {                                                                                                                  \
        const char *wrong;                                                                                             \
        show = NAME##_show;                                                                                            \
        for (uint64_t number = 0; number < count; number++) {                                                          \
            begin(number);                                                                                             \
            if ((wrong = NAME##_once()))                                                                               \
                complain(wrong);                                                                                       \
        }                                                                                                              \
    }

typedef struct {
    const char *name;
    void (*run)(uint64_t count);
} Entry;

static void run_one(const Entry *entry, uint64_t seed, uint64_t count)
{
    running = entry->name;
    run_seed = seed;
    chance_state = (seed + 1) * 0x9E3779B97F4A7C15u | 1;
    memset(results, 0, sizeof results);
    entry->run(count);
    printf("%s", entry->name);
    for (unsigned code = 0; code < COUNT(results); code++)
        if (results[code])
            printf(" %u:%" PRIu64, code, results[code]);
    printf("\n");
}

/* NAME SEED COUNT; the name * means every block and function. A line on each: how often it gave which ErrorID. */
static int run_entries(const Entry *entries, unsigned count, int argc, char **argv)
{
    int found = 0;
    if (argc != 4)
        return 2;
    if (__sanitizer_set_death_callback)
        __sanitizer_set_death_callback(died);
    signal(SIGVTALRM, endless);
    for (unsigned at = 0; at < count; at++) {
        if (strcmp(entries[at].name, argv[1]) && strcmp("*", argv[1]))
            continue;
        run_one(entries + at, strtoull(argv[2], NULL, 10), strtoull(argv[3], NULL, 10));
        found = 1;
    }
    return found ? 0 : 2;
}
