/* Runs scans, and ends those that trap or never end: one library for the whole process, since it takes signals.
 *
 * It is not part of the blocks' own libraries: many of them may be loaded, and <signal.h> defines names in capitals,
 * as all names of ST are in C. */

#include <pthread.h>
#include <setjmp.h>
#include <signal.h>
#include <stdint.h>
#include <sys/time.h>

#define SIGNALS 4

typedef void (*clock_setter)(int64_t nanoseconds);
typedef void (*scan_body)(void *data);

static volatile unsigned scans;
static sigjmp_buf way_out;
static volatile sig_atomic_t inside;
static pthread_t owner;
static int64_t limit;
static const int signals[SIGNALS] = {SIGFPE, SIGSEGV, SIGBUS, SIGVTALRM};
static struct sigaction before[SIGNALS];

static void repeat(clock_setter set, scan_body body, void *data, int64_t now, int64_t step, int64_t count)
{
    for (; count > 0; count--, now += step) {
        set(now);
        scans++;
        body(data);
    }
}

/* A division by zero, a wild index or a loop without end must end the scan and not the process: the signal jumps back
 * to the way in, and its number becomes the result. */
int64_t dbk_guard(clock_setter set, scan_body body, void *data, int64_t now, int64_t step, int64_t count)
{
    int trap = sigsetjmp(way_out, 0);
    if (trap == 0) {
        owner = pthread_self();
        inside = 1;
        repeat(set, body, data, now, step, count);
        inside = 0;
    }
    return trap;
}

/* Elsewhere than in a scan the handler that was there before stays in charge. */
static void pass_on(const struct sigaction *old, int number, siginfo_t *info, void *context)
{
    if (old->sa_flags & SA_SIGINFO) {
        old->sa_sigaction(number, info, context);
    } else if (old->sa_handler == SIG_DFL) {
        if (number == SIGVTALRM) /* our own timer */
            return;
        signal(number, SIG_DFL);
        raise(number);
    } else if (old->sa_handler != SIG_IGN) {
        old->sa_handler(number);
    }
}

/* At each tick: whether one and the same scan has gone on for too many of them. */
static int is_endless(void)
{
    static unsigned last;
    static int64_t ticks;
    ticks = scans == last ? ticks + 1 : 0;
    last = scans;
    return ticks >= limit;
}

static void on_signal(int number, siginfo_t *info, void *context)
{
    if (inside && !pthread_equal(owner, pthread_self()) && number == SIGVTALRM) {
        pthread_kill(owner, number); /* a timer may wake any thread */
        return;
    }
    if (inside && pthread_equal(owner, pthread_self()) && (number != SIGVTALRM || is_endless())) {
        inside = 0;
        siglongjmp(way_out, number);
    }
    for (int i = 0; i < SIGNALS; i++)
        if (signals[i] == number)
            pass_on(&before[i], number, info, context);
}

/* Take the signals (once); a scan may take `ticks` quarters of a second of processor time. */
void dbk_start(int64_t ticks)
{
    static int started;
    limit = ticks;
    if (started++)
        return;
    struct sigaction action = {0};
    action.sa_sigaction = on_signal;
    action.sa_flags = SA_SIGINFO | SA_NODEFER | SA_ONSTACK | SA_RESTART;
    for (int i = 0; i < SIGNALS; i++)
        sigaction(signals[i], &action, &before[i]);
    struct itimerval tick = {{0, 250000}, {0, 250000}};
    setitimer(ITIMER_VIRTUAL, &tick, 0);
}
