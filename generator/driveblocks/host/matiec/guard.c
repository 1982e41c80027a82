/* The way into the C of iec2c from another process, and the way out when it traps.
 *
 * A unit of its own: <signal.h> defines names in capitals, and so are all names of ST. */

#include <stdint.h>

extern void dbk_set_clock(int64_t nanoseconds);

static void dbk_repeat(void (*body)(void *), void *data, int64_t now, int64_t step, int64_t count)
{
    for (; count > 0; count--, now += step) {
        dbk_set_clock(now);
        body(data);
    }
}

#if defined(_WIN32) || defined(__SANITIZE_ADDRESS__)

void dbk_start(void) {}

int64_t dbk_guard(void (*body)(void *), void *data, int64_t now, int64_t step, int64_t count)
{
    dbk_repeat(body, data, now, step, count);
    return 0;
}

#else

#include <setjmp.h>
#include <signal.h>

static sigjmp_buf way_out;
static volatile sig_atomic_t inside;
static const int signals[] = {SIGFPE, SIGSEGV, SIGBUS};
static struct sigaction before[3];

/* A division by zero or a wild index must end the scan and not the process: the signal jumps back to the way in, and
 * its number becomes the result. */
int64_t dbk_guard(void (*body)(void *), void *data, int64_t now, int64_t step, int64_t count)
{
    int trap = sigsetjmp(way_out, 0);
    if (trap == 0) {
        inside = 1;
        dbk_repeat(body, data, now, step, count);
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
        signal(number, SIG_DFL);
        raise(number);
    } else if (old->sa_handler != SIG_IGN) {
        old->sa_handler(number);
    }
}

static void on_signal(int number, siginfo_t *info, void *context)
{
    if (inside) {
        inside = 0;
        siglongjmp(way_out, number);
    }
    for (int i = 0; i < 3; i++)
        if (signals[i] == number)
            pass_on(&before[i], number, info, context);
}

void dbk_start(void)
{
    static int started;
    if (started++) /* the same file loaded again is the same library: it would take itself for what was before */
        return;
    struct sigaction action = {0};
    action.sa_sigaction = on_signal;
    action.sa_flags = SA_SIGINFO | SA_NODEFER | SA_ONSTACK;
    for (int i = 0; i < 3; i++)
        sigaction(signals[i], &action, &before[i]);
}

#endif
