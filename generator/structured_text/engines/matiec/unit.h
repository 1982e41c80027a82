/* What the C of iec2c needs around it: a clock, and a way in to each block and function.
 * The unit that includes this has included iec_std_lib.h before; POUS.c follows after. */

TIME __CURRENT_TIME;
BOOL __DEBUG;

#ifdef DBK_COVERAGE
/* How often each statement ran, and, of those that are loops, how often it came to a first turn. */
uint64_t dbk_hits[DBK_COVERAGE];
uint64_t dbk_begun[DBK_COVERAGE];
static char dbk_fresh[DBK_COVERAGE];
#define DBK_STATEMENT(NUMBER, LINE) dbk_hits[NUMBER]++;
#define DBK_LOOP(NUMBER) dbk_fresh[NUMBER] = 1;
#define DBK_TURN(NUMBER) dbk_begun[NUMBER] += dbk_fresh[NUMBER], dbk_fresh[NUMBER] = 0;
#endif

static void dbk_set_clock(int64_t nanoseconds)
{
    __CURRENT_TIME.tv_sec = nanoseconds / 1000000000;
    __CURRENT_TIME.tv_nsec = nanoseconds % 1000000000;
}

/* What runs scans so that a trap ends the scan and not the process; without it they run as they are. */
typedef int64_t (*dbk_guard)(void (*)(int64_t), void (*)(void *), void *, int64_t, int64_t, int64_t);

static dbk_guard dbk_guarded;

void dbk_attach(dbk_guard guard)
{
    dbk_guarded = guard;
}

static int64_t dbk_run(void (*body)(void *), void *data, int64_t now, int64_t step, int64_t count)
{
    if (dbk_guarded)
        return dbk_guarded(dbk_set_clock, body, data, now, step, count);
    for (; count > 0; count--, now += step) {
        dbk_set_clock(now);
        body(data);
    }
    return 0;
}

/* A function block or program: `data` is zeroed memory of sizeof(NAME). */
#define DBK_BLOCK(NAME)                                                                                      \
    static void dbk_body_##NAME(void *data) { NAME##_body__((NAME *)data); }                                 \
    void dbk_init_##NAME(void *data) { NAME##_init__((NAME *)data, 0); }                                     \
    int64_t dbk_scan_##NAME(void *data, int64_t now) { return dbk_run(dbk_body_##NAME, data, now, 0, 1); } \
    int64_t dbk_many_##NAME(void *data, int64_t now, int64_t step, int64_t count)                            \
    {                                                                                                        \
        return dbk_run(dbk_body_##NAME, data, now, step, count);                                           \
    }

/* A function: `cells` are pointers to the result and to the arguments. */
#define DBK_FUNCTION(NAME, RESULT, ...)                                                                   \
    static void dbk_body_##NAME(void *data)                                                               \
    {                                                                                                     \
        void **cells = data;                                                                              \
        *(RESULT *)cells[0] = NAME(__VA_ARGS__);                                                          \
    }                                                                                                     \
    int64_t dbk_call_##NAME(void **cells) { return dbk_run(dbk_body_##NAME, cells, 0, 0, 1); }
