/* Time of short pieces of work, side by side: every form runs in every round, for some tens of microseconds, so that
 * whatever slows the machine slows all of them alike. The least over many rounds is what the work takes when nothing
 * else runs. The clock is the wall's: that of the processor's time jumps back where a hypervisor accounts for stolen
 * time. Prints one line for each form: name, least and median nanoseconds per call. */
#include <time.h>

typedef struct {
    const char *name;
    void (*work)(void);
} Form;

enum { ROUND_NS = 40000, MOST_ROUNDS = 4096 };

static double clock_ns(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return 1e9 * now.tv_sec + now.tv_nsec;
}

static double round_ns(void (*volatile work)(void), long calls)
{
    double start = clock_ns();
    for (long call = 0; call < calls; call++)
        work();
    return clock_ns() - start;
}

/* Calls that fill a round. */
static long calls_of(void (*work)(void))
{
    long calls = 1;
    while (round_ns(work, calls) < ROUND_NS)
        calls *= 2;
    return calls;
}

static int by_size(const void *one, const void *other)
{
    double a = *(const double *)one, b = *(const double *)other;
    return (a > b) - (a < b);
}

static void measure(const Form *forms, int count, int rounds)
{
    long *calls = calloc(count, sizeof *calls);
    double(*times)[MOST_ROUNDS] = calloc(count, sizeof *times);
    if (!calls || !times || rounds > MOST_ROUNDS)
        abort();
    for (int form = 0; form < count; form++)
        calls[form] = calls_of(forms[form].work);
    for (int round = 0; round < rounds; round++)
        for (int form = 0; form < count; form++)
            times[form][round] = round_ns(forms[form].work, calls[form]) / calls[form];
    for (int form = 0; form < count; form++) {
        qsort(times[form], rounds, sizeof **times, by_size);
        printf("%s\t%.3f\t%.3f\n", forms[form].name, times[form][0], times[form][rounds / 2]);
    }
    free(times);
    free(calls);
}
