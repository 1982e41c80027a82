/* A soft PLC: the program every 10 ms. A line on standard input sets an input, "start 1"; every 100 ms one goes out with
 * what is to be seen, and another at once when Running, Fault, StopConfirmed or CommOk change. The end of the input ends
 * it; with a second word, "thread", it runs in a thread of its own, and the process stays for ten seconds. */
#define _GNU_SOURCE
#include <poll.h>
#include <pthread.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include "iec_std_lib.h"
#include "accessor.h"
#include "POUS.h"
TIME __CURRENT_TIME;
BOOL __DEBUG;
#include "POUS.c"

static DESK desk;

static int64_t now_us(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (int64_t)now.tv_sec * 1000000 + now.tv_nsec / 1000;
}

static int take(void) {
  static char line[64];
  static size_t length;
  struct pollfd one = {0, POLLIN, 0};
  while (poll(&one, 1, 0) > 0) {
    if (read(0, line + length, 1) != 1) return 0;
    if (line[length++] != '\n' && length < sizeof(line) - 1) continue;
    int on = line[length - 2] == '1';
    line[length] = 0;
    length = 0;
    if (!strncmp(line, "start", 5)) desk.START.value = on;
    if (!strncmp(line, "reset", 5)) desk.RESET.value = on;
    if (!strncmp(line, "stopall", 7)) desk.STOPALL.value = on;
  }
  return 1;
}

static void tell(int64_t ms) {
  struct rusage used;
  getrusage(RUSAGE_SELF, &used);
  printf("ms=%lld comm=%d running=%d fault=%d confirmed=%d overdue=%d hertz=%.2f valid=%d reason=%d error=%d port=%d "
         "requests=%lu good=%lu timeouts=%d bad=%d retries=%d late=%d refusals=%d worststop=%d longest=%d latescans=%d "
         "cycle=%d worstcycle=%d memory=%ld\n",
         (long long)ms, desk.MOTOR.COMMOK.value, desk.MOTOR.RUNNING.value, desk.MOTOR.FAULT.value,
         desk.MOTOR.STOPCONFIRMED.value, desk.BUS.STOPOVERDUE.value, desk.MOTOR.OUTPUTFREQUENCYHZ.value,
         desk.MOTOR.DIAGNOSIS.value.OUTPUTFREQUENCYVALID, desk.MOTOR.REASON.value, desk.BUS.ERRORID.value,
         desk.BUS.PORTERRORID.value, (unsigned long)desk.BUS.REQUESTS.value, (unsigned long)desk.BUS.GOOD.value,
         desk.BUS.TIMEOUTS.value, desk.BUS.BAD.value, desk.BUS.RETRIES.value, desk.BUS.LATEREPLIES.value,
         desk.BUS.REFUSALS.value, desk.BUS.WORSTSTOPMS.value, desk.BUS.LONGESTSCANMS.value, desk.BUS.LATESCANS.value,
         desk.BUS.CYCLEMS.value, desk.BUS.WORSTCYCLEMS.value, used.ru_maxrss);
  fflush(stdout);
}

static void *scans(void *nothing) {
  const int64_t begun = now_us();
  int64_t due = begun, told = 0;
  int before = -1;
  while (take()) {
    DESK_body__(&desk);
    const int seen = desk.MOTOR.COMMOK.value | desk.MOTOR.RUNNING.value << 1 | desk.MOTOR.FAULT.value << 2 |
                     desk.MOTOR.STOPCONFIRMED.value << 3;
    if (seen != before || now_us() - told >= 100000) {
      before = seen;
      told = now_us();
      tell((told - begun) / 1000);
    }
    due += 10000;
    if (due < now_us()) due = now_us();
    while (now_us() < due) usleep((useconds_t)(due - now_us()));
  }
  return nothing;
}

int main(int count, char **words) {
  if (count < 2) return 2;
  DESK_init__(&desk, 0);
  desk.DEVICE.value.len = strlen(words[1]);
  memcpy(desk.DEVICE.value.body, words[1], strlen(words[1]));
  if (count == 2) return scans(0) != 0;
  pthread_t one;
  pthread_create(&one, 0, scans, 0);
  pthread_join(one, 0);
  sleep(10);
  _exit(0);
}
