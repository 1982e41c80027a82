/* LX_Port on a system that answers as it is reported: the functions that the block calls stand here, for the whole program.
 *
 * Commands, one per line: "now MS"; "next CALL RESULT" queues what a call gives, an error number below 0, else the most
 * that it takes or gives; "always CALL RESULT" from now on; "granted RATE"; "handle N"; "receive", "send N" call LX_Port,
 * and "scan" the program of softplc.st with its line;
 * "will PLACE COUNT MS" is what the line gives next, COUNT bytes of PLACE + 1; "process N" is who asks, as after a fork;
 * "thread N" has N calls that receive made by a thread that ends;
 * "torn N" forks N programs whose will changes in each call and which a signal ends, and prints what they have sent; "again" starts the PLC anew without ending its process, "unload" is
 * what dlclose calls. Each but "again" prints a line with what the block shows, what has gone out in it, and what it has called. A call that nothing was said of works, and nothing is to be read. */
#include <errno.h>
#include <pthread.h>
#include <signal.h>
#include <sys/time.h>
#include <sys/wait.h>

#include "iec_std_lib.h"
#include "accessor.h"
#include "POUS.h"
TIME __CURRENT_TIME;
BOOL __DEBUG;
#include "POUS.c"

enum { OPEN, CLOSE, READ, WRITE, SET, MODEM, EXCLUSIVE, LOCK, QUEUE, FLUSH, CALLS };
static const char *const NAMES[CALLS] = {"open", "close", "read", "write", "set", "modem", "exclusive", "lock", "queue", "flush"};
enum { MOST = 256, FIRST = 3, NOTHING = -1000 };

extern void *__dso_handle __attribute__((visibility("hidden")));
void __cxa_finalize(void *);
int fork(void);
void _exit(int);

static LX_PORT port;
static DESK desk;
static long told[CALLS][MOST], always[CALLS];
static int count[CALLS], used[CALLS], opened, next_handle = FIRST, process = 1, timed;
static long long now_ms;
static uint32_t settings[11], granted;
static char did[4096], wire[4096];

static void note(const char *format, long value) {
  snprintf(did + strlen(did), sizeof(did) - strlen(did), format, value);
}

/* What is reported of a call, or what it gives otherwise; below 0 it has failed, and errno says why. */
static long answer(int call, long otherwise) {
  long result = used[call] < count[call] ? told[call][used[call]++] : always[call] != NOTHING ? always[call] : otherwise;
  if (result >= 0) return result;
  errno = (int)-result;
  return -1;
}

static int works(int handle) {
  if (handle == opened) return 1;
  errno = EBADF;
  return 0;
}

int open(const char *name, int how, ...) {
  (void)name, (void)how;
  note(",open", 0);
  if (answer(OPEN, 0) < 0) return -1;
  return opened = next_handle++;
}

int close(int handle) {
  note(",close", 0);
  if (!works(handle)) return -1;
  opened = 0;
  return 0;
}

long read(int handle, void *to, size_t most) {
  note(",read", 0);
  if (!works(handle)) return -1;
  const long gives = answer(READ, -EAGAIN);
  for (long at = 0; at < gives && at < (long)most; at++) ((unsigned char *)to)[at] = (unsigned char)(at + 1);
  return gives;
}

long write(int handle, const void *from, size_t most) {
  if (timed) note(",write%ld", (long)now_ms);
  else note(",write", 0);
  if (!works(handle)) return -1;
  long takes = answer(WRITE, (long)most);
  if (takes > (long)most) takes = (long)most;
  for (long at = 0; at < takes; at++)
    snprintf(wire + strlen(wire), sizeof(wire) - strlen(wire), "%02x", ((const unsigned char *)from)[at]);
  return takes;
}

int ioctl(int handle, unsigned long request, ...) {
  va_list rest;
  va_start(rest, request);
  void *const with = va_arg(rest, void *);
  va_end(rest);
  if (!works(handle)) return -1;
  switch (request) {
    case 0x402C542BUL: /* TCSETS2 */
      memcpy(settings, with, sizeof(settings));
      return (int)answer(SET, 0);
    case 0x802C542AUL: /* TCGETS2 */
      if (granted) settings[9] = settings[10] = granted;
      memcpy(with, settings, sizeof(settings));
      return 0;
    case 0x5415: /* TIOCMGET */
      return (int)answer(MODEM, 0);
    case 0x540C: /* TIOCEXCL */
      note(",exclusive", 0);
      return (int)answer(EXCLUSIVE, 0);
    case 0x5411: /* TIOCOUTQ */
      *(int *)with = (int)answer(QUEUE, 0);
      return 0;
    case 0x540B: /* TCFLSH */
      note(",flush%ld", (long)with);
      return (int)answer(FLUSH, 0);
    default:
      errno = ENOTTY;
      return -1;
  }
}

int flock(int handle, int how) {
  note(",lock%ld", how);
  return works(handle) ? (int)answer(LOCK, 0) : -1;
}

int clock_gettime(clockid_t which, struct timespec *to) {
  (void)which;
  to->tv_sec = now_ms / 1000;
  to->tv_nsec = now_ms % 1000 * 1000000;
  return 0;
}

int poll(void *files, unsigned long number, int ms) {
  (void)files, (void)number;
  now_ms += ms;
  return 0;
}

int getpid(void) { return process; }

static void *calls(void *number) {
  for (long each = 0; each < (long)number; each++) LX_PORT_body__(&port);
  return 0;
}

static void ended(int signal) {
  (void)signal;
  *wire = 0;
  __cxa_finalize(&__dso_handle);
  puts(wire);
  fflush(stdout);
  _exit(0);
}

/* The signal comes at any instruction of a call: also while a will is being written. */
static void torn(long programs) {
  fflush(stdout);
  for (long each = 0; each < programs; each++) {
    if (fork()) {
      wait(0);
      continue;
    }
    const struct itimerval soon = {{0, 0}, {0, 300 + each % 97}};
    signal(SIGALRM, ended);
    port.TXCOUNT.value = 0;
    port.WILLCOUNT.value = 40;
    LX_PORT_body__(&port);
    setitimer(ITIMER_REAL, &soon, 0);
    for (int turn = 0;; turn++) {
      memset(port.WILL.value.table, turn % 251 + 1, 40);
      LX_PORT_body__(&port);
      *did = 0;
    }
  }
}

static void show(int error, int heard, int elapsed) {
  printf("%d %d %d %s %s\n", error, heard, elapsed, *wire ? wire : "-", *did ? did + 1 : "-");
  *did = *wire = 0;
}

static void call(int to_send) {
  port.TXCOUNT.value = (UINT)to_send;
  LX_PORT_body__(&port);
  show(port.ERRORID.value, port.RXCOUNT.value, port.ELAPSEDMS.value);
}

int main(void) {
  char word[16], name[16];
  long value;
  LX_PORT_init__(&port, 0);
  DESK_init__(&desk, 0);
  for (int each = 0; each < CALLS; each++) always[each] = NOTHING;
  for (int each = 0; each < 40; each++) port.TX.value.table[each] = (BYTE)(each + 1);
  while (scanf("%15s", word) == 1) {
    if (!strcmp(word, "receive")) call(0);
    else if (!strcmp(word, "again")) LX_PORT_init__(&port, 0);
    else if (!strcmp(word, "unload")) {
      timed = 1;
      __cxa_finalize(&__dso_handle);
      timed = 0;
      show(0, 0, 0);
    } else if (!strcmp(word, "scan")) {
      DESK_body__(&desk);
      show(desk.BUS.PORTERRORID.value, desk.BUS.PORT.RXCOUNT.value, desk.BUS.ELAPSEDMS.value);
    } else if (!strcmp(word, "next") || !strcmp(word, "always")) {
      if (scanf("%15s %ld", name, &value) != 2) return 2;
      int which = 0;
      while (which < CALLS && strcmp(name, NAMES[which])) which++;
      if (which == CALLS || count[which] == MOST) return 3;
      if (*word == 'n') told[which][count[which]++] = value;
      else always[which] = value;
    } else {
      if (scanf("%ld", &value) != 1) return 2;
      if (!strcmp(word, "now")) now_ms = value;
      else if (!strcmp(word, "torn")) torn(value);
      else if (!strcmp(word, "process")) process = (int)value;
      else if (!strcmp(word, "will")) {
        int length, wait;
        if (scanf("%d %d", &length, &wait) != 2) return 2;
        port.WILLSLOT.value = (USINT)value;
        port.WILLCOUNT.value = (USINT)length;
        port.WILLMS.value = (UINT)wait;
        memset(port.WILL.value.table, (int)value + 1, 40);
      } else if (!strcmp(word, "thread")) {
        pthread_t one;
        port.TXCOUNT.value = 0;
        timed = 1;
        pthread_create(&one, 0, calls, (void *)value);
        pthread_join(one, 0);
        timed = 0;
        show(port.ERRORID.value, 0, 0);
      }
      else if (!strcmp(word, "granted")) granted = (uint32_t)value;
      else if (!strcmp(word, "handle")) port.HANDLE.value = (DINT)value;
      else if (!strcmp(word, "rate")) port.BITRATE.value = (UDINT)value;
      else if (!strcmp(word, "send")) call((int)value);
      else return 4;
    }
  }
  return 0;
}
