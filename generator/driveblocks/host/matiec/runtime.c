/* What the C of iec2c needs around it to run inside another process: a clock, a way in, and a way out of a trap.
 * The unit that includes this has included iec_std_lib.h before; POUS.c follows after. */

TIME __CURRENT_TIME;
BOOL __DEBUG;

static void dbk_set_clock(int64_t nanoseconds)
{
    __CURRENT_TIME.tv_sec = nanoseconds / 1000000000;
    __CURRENT_TIME.tv_nsec = nanoseconds % 1000000000;
}

/* A division by zero or a wild index must end the scan and not the process: the signal jumps back to the way in and
 * its number becomes the result. Elsewhere than in a scan the handler that was there before stays in charge. */
#if defined(_WIN32) || defined(__SANITIZE_ADDRESS__)

#define DBK_GUARDED(...) __VA_ARGS__ return 0;
void dbk_start(void) {}

#else
#include <setjmp.h>
#include <signal.h>

static sigjmp_buf dbk_way_out;
static volatile sig_atomic_t dbk_inside;
static const int dbk_signals[] = {SIGFPE, SIGSEGV, SIGBUS};
static struct sigaction dbk_before[3];

#define DBK_GUARDED(...)                            \
    int dbk_signal = sigsetjmp(dbk_way_out, 0);     \
    if (dbk_signal == 0) {                          \
        dbk_inside = 1;                             \
        __VA_ARGS__                                 \
        dbk_inside = 0;                             \
    }                                               \
    return dbk_signal;

static void dbk_pass_on(const struct sigaction *before, int number, siginfo_t *info, void *context)
{
    if (before->sa_flags & SA_SIGINFO) {
        before->sa_sigaction(number, info, context);
    } else if (before->sa_handler == SIG_DFL) {
        signal(number, SIG_DFL);
        raise(number);
    } else if (before->sa_handler != SIG_IGN) {
        before->sa_handler(number);
    }
}

static void dbk_on_signal(int number, siginfo_t *info, void *context)
{
    if (dbk_inside) {
        dbk_inside = 0;
        siglongjmp(dbk_way_out, number);
    }
    for (int i = 0; i < 3; i++)
        if (dbk_signals[i] == number)
            dbk_pass_on(&dbk_before[i], number, info, context);
}

void dbk_start(void)
{
    static int started;
    if (started++) /* the same file loaded again is the same library: it would take itself for what was before */
        return;
    struct sigaction action = {0};
    action.sa_sigaction = dbk_on_signal;
    action.sa_flags = SA_SIGINFO | SA_NODEFER | SA_ONSTACK;
    for (int i = 0; i < 3; i++)
        sigaction(dbk_signals[i], &action, &dbk_before[i]);
}
#endif

#ifdef DBK_COVERAGE
uint32_t dbk_hits[DBK_COVERAGE];
#endif

/* The way in to a function block or program: `data` is zeroed memory of sizeof(NAME). */
#define DBK_BLOCK(NAME)                                                                \
    void dbk_init_##NAME(void *data) { NAME##_init__((NAME *)data, 0); }               \
    int dbk_scan_##NAME(void *data, int64_t now)                                       \
    {                                                                                  \
        dbk_set_clock(now);                                                            \
        DBK_GUARDED(NAME##_body__((NAME *)data);)                                      \
    }                                                                                  \
    int dbk_many_##NAME(void *data, int64_t now, int64_t step, int64_t count)          \
    {                                                                                  \
        DBK_GUARDED(                                                                   \
            for (int64_t i = 0; i < count; i++) {                                      \
                dbk_set_clock(now + i * step);                                         \
                NAME##_body__((NAME *)data);                                           \
            })                                                                         \
    }

/* The way in to a whole CONFIGURATION, whose variables are static. */
#define DBK_CONFIGURATION                                                              \
    extern void config_init__(void);                                                   \
    extern void config_run__(unsigned long tick);                                      \
    extern unsigned long long common_ticktime__;                                       \
    extern unsigned long greatest_tick_count__;                                        \
    static unsigned long dbk_tick;                                                     \
    static int64_t dbk_now;                                                            \
    int64_t dbk_config_tick(void) { return (int64_t)common_ticktime__; }               \
    void dbk_config_init(void) { config_init__(); }                                    \
    int dbk_config_run(int64_t count)                                                  \
    {                                                                                  \
        DBK_GUARDED(                                                                   \
            for (int64_t i = 0; i < count; i++) {                                      \
                dbk_set_clock(dbk_now);                                                \
                config_run__(dbk_tick);                                                \
                dbk_now += (int64_t)common_ticktime__;                                 \
                dbk_tick++;                                                            \
                if (greatest_tick_count__)                                             \
                    dbk_tick %= greatest_tick_count__;                                 \
            })                                                                         \
    }
