/* Real drive blocks on a virtual RS-485 line in virtual time, around the matiec build: a library that Python steps from
   one event of the wire to the next. Times in microseconds.

   Scans are made here: what has come is handed over, the blocks are called, then the line, then the port sends. Drives,
   a second master and the judge are in crowd.py, which is told of each request and says what is transmitted when.
   families.h is made from POUS.h: the drive blocks and lines that there are. */
#include "iec_std_lib.h"
#include "accessor.h"
#include <stdint.h>
#include <string.h>
TIME __CURRENT_TIME;
BOOL __DEBUG;
#include "POUS.h"
#include "POUS.c"
typedef long long us;
enum { MOST = 32, LINE_MOST = 40000, DRIVE_MOST = 20000, UNKNOWN = 65535 };

/* ---- the blocks: families, and lines of so many slots ---- */
typedef struct { void (*init)(void *); void (*call)(void *, MB_SLOT *); } Family;
#define FAMILY(F) \
  _Static_assert(sizeof(F##_DRIVE) <= DRIVE_MOST, #F); \
  static void F##_new(void *of) { memset(of, 0, sizeof(F##_DRIVE)); F##_DRIVE_init__(of, 0); } \
  static void F##_call(void *of, MB_SLOT *slot) { F##_DRIVE *one = of; one->SLOT.value = *slot; F##_DRIVE_body__(one); *slot = one->SLOT.value; }
#define LINE(N) \
  _Static_assert(sizeof(MB_LINE##N) <= LINE_MOST, #N); \
  static void line##N##_new(void *of) { memset(of, 0, sizeof(MB_LINE##N)); MB_LINE##N##_init__(of, 0); } \
  static void line##N##_call(void *of, MB_SLOT *slots, MB_PORT *port) { MB_LINE##N *one = of; \
    one->PORT.value = *port; memcpy(&one->SLOTS.value, slots, sizeof one->SLOTS.value); MB_LINE##N##_body__(one); \
    *port = one->PORT.value; memcpy(slots, &one->SLOTS.value, sizeof one->SLOTS.value); }
#include "families.h"
#undef FAMILY
#undef LINE
#define FAMILY(F) {F##_new, F##_call},
#define LINE(N)
static const Family FAMILIES[] = {
#include "families.h"
};
#undef FAMILY
#undef LINE
#define FAMILY(F)
#define LINE(N) {N, line##N##_new, line##N##_call},
static const struct { int slots; void (*init)(void *); void (*call)(void *, MB_SLOT *, MB_PORT *); } LINES[] = {
#include "families.h"
};

/* ---- what Python sees and sets ---- */
typedef struct { /* of one drive block; in crowd.py the same */
  int32_t family, slot, called, watched;   /* watched: its ages are judged */
  int32_t age, over, over_age, over_worst; /* the largest StatusAgeMs; calls with more than WorstReadMs, and the first */
  int32_t worst, ready, lost_starts, pins; /* the largest WorstReadMs; Ready after the last call; rising pins that started nothing */
  int32_t block_abi, line_abi;             /* what is found in Abi instead after its call, and after that of the line; 0: as it is */
  int32_t function, address, word, every;  /* of a block of another layout: what the line would take for a stop and a command */
  int32_t nth, scans;                      /* called in each so manieth scan, as from a slower task; 0: in all */
  us over_at, put_at, overdue_at, lost_at, unknown_at; /* put_at: the first call after pins were changed; -1: not called since */
} Block;
typedef struct { int32_t blocks, slots, rate, bits, keeps, scan, jitter, elapsed, unused; us now; } Hall;
typedef struct { us from, to; int32_t spoilt, number; } Sent;
Block block[MOST]; Hall hall; MB_SLOT slots[MOST]; MB_PORT port; unsigned char request[64]; int32_t request_count; us request_from, request_to; int32_t request_number;
static char line_memory[LINE_MOST] __attribute__((aligned(16)));
static char memory[MOST][DRIVE_MOST] __attribute__((aligned(16)));
void *crowd_line(void) { return line_memory; }
void *crowd_block(int at) { return memory[at]; }
long short_silences; int32_t slot_size = sizeof(MB_SLOT);
void crowd_keeps(int keeps) { port.KEEPSSILENCE = keeps; }
/* places of outputs that are looked at in each call, by family: written by Python from POUS.h */
typedef struct { int32_t ready, reason, age, run[4]; } Places;
Places places[MOST];

/* ---- chance ---- */
static uint64_t chance_state;
static long between(long low, long high) {
  chance_state ^= chance_state << 13; chance_state ^= chance_state >> 7; chance_state ^= chance_state << 17;
  return low + (long)(chance_state % (uint64_t)(high - low + 1));
}

/* ---- the wire: characters with the time of their end, and the last transmissions ---- */
typedef struct { us at; unsigned char value; } Char;
static Char wire[8192]; static unsigned wire_in, wire_out;
static Sent sent[64]; static int sent_count;
static us last_end;
static us characters(int count) { return (1000000LL * hall.bits * count + hall.rate - 1) / hall.rate; }
static us silence(void) { return hall.rate > 19200 ? 1750 : (3500000LL * hall.bits + hall.rate - 1) / hall.rate; }
static void put(us at, unsigned char value) {
  unsigned place = wire_in++ & 8191;
  while (place != (wire_out & 8191) && wire[(place - 1) & 8191].at > at) { wire[place] = wire[(place - 1) & 8191]; place = (place - 1) & 8191; }
  wire[place].at = at; wire[place].value = value;
}
static void spoil(us from, us to) {
  for (unsigned i = wire_out; i != wire_in; i++) { Char *one = &wire[i & 8191];
    if (one->at > from && one->at - characters(1) < to) one->value ^= 1 << between(0, 7); }
}
/* a transmission; what overlaps another is spoilt, both of them; its number */
static int transmission(us from, us to) {
  Sent *mine = &sent[sent_count & 63]; mine->from = from; mine->to = to; mine->spoilt = 0; mine->number = sent_count;
  for (int i = sent_count > 63 ? sent_count - 63 : 0; i < sent_count; i++) { Sent *other = &sent[i & 63];
    if (from < other->to && to > other->from) { mine->spoilt = other->spoilt = 1; spoil(from > other->from ? from : other->from, to < other->to ? to : other->to); } }
  return sent_count++;
}
int crowd_transmit(us from, const unsigned char *bytes, int count) {
  for (int i = 0; i < count; i++) put(from + characters(i + 1), bytes[i]);
  return transmission(from, from + characters(count));
}
int crowd_spoilt(int number) { return number < sent_count - 63 || sent[number & 63].spoilt; }

/* ---- the port ---- */
static int send(void) {
  if (port.TXNUMBER == port.TXTAKEN || port.TXCOUNT == 0) return 0;
  port.TXTAKEN = port.TXNUMBER;
  us start = hall.now, heard = last_end;
  for (unsigned i = wire_out; i != wire_in; i++) { us at = wire[i & 8191].at;
    if (at <= hall.now && at > heard) heard = at;
    if (hall.keeps && at > heard && at - characters(1) < start + silence() && at - characters(1) < heard + silence()) heard = at; }
  if (hall.keeps && start < heard + silence()) start = heard + silence();
  if (start < heard + silence()) short_silences++;
  request_from = start; request_to = start + characters(port.TXCOUNT); request_count = port.TXCOUNT;
  memcpy(request, port.TX.table, port.TXCOUNT);
  if (request_to > last_end) last_end = request_to;
  request_number = transmission(request_from, request_to);
  return 1;
}
static void receive(void) {
  while (wire_out != wire_in && wire[wire_out & 8191].at <= hall.now) {
    if (wire[wire_out & 8191].at > last_end) last_end = wire[wire_out & 8191].at;
    port.RX.table[port.RXIN] = wire[wire_out & 8191].value; port.RXIN = (port.RXIN + 1) % 256; wire_out++;
  }
}

/* ---- scans ---- */
static int line_at;
static struct { UINT fresh; int error, all, restarts; } was[MOST];
static int byte_of(int at, int place) { return memory[at][place]; }
static int word_of(int at, int place) { return *(uint16_t *)(memory[at] + place); }
static void other_layout(Block *one, MB_SLOT *slot) {
  one->every++;
  for (int box = 0; box < 2; box++) { MB_ASK *ask = &slot->ASK.table[box];
    ask->FUNCTIONCODE = one->function; ask->ADDRESS = one->address; ask->QUANTITY = 1; ask->WORDS.table[0] = one->word; ask->NUMBER = one->every / 50 + 1; }
  slot->STOPREGISTER = one->address; slot->STOPWORD = one->word; slot->HASSTOP = 1;
}
static void called(int at) {
  Block *one = &block[at]; MB_SLOT *slot = &slots[one->slot]; const Places *place = &places[one->family];
  int pins = 0, calm = was[at].fresh == slot->FRESH && was[at].error == slot->LINEERRORID && was[at].all == slot->STOPALL && was[at].restarts == slot->RESTARTS;
  for (int i = 0; i < 4; i++) pins |= byte_of(at, place->run[i]) << i;
  if (one->put_at < 0) one->put_at = hall.now;
  FAMILIES[one->family].call(memory[at], slot);
  int reason = word_of(at, place->reason), age = word_of(at, place->age);
  if (age < UNKNOWN) one->unknown_at = 0; /* else it has not been read since then */
  else { if (!one->unknown_at) one->unknown_at = hall.now; age = (hall.now - one->unknown_at) / 1000; }
  /* Ready, one run pin rises and nothing else is new: a start begins in this call */
  if (one->ready && calm && !one->pins && pins && !(pins & (pins - 1)) && reason != 0 && reason != 2 && reason != 3 && !one->lost_starts++) one->lost_at = hall.now;
  one->pins = pins; one->ready = byte_of(at, place->ready);
  was[at].fresh = slot->FRESH; was[at].error = slot->LINEERRORID; was[at].all = slot->STOPALL; was[at].restarts = slot->RESTARTS;
  if (one->block_abi) { slot->ABI = one->block_abi; other_layout(one, slot); }
  if (one->watched) {
    if (age > one->age) one->age = age;
    if (slot->WORSTREADMS > one->worst) one->worst = slot->WORSTREADMS;
    if (age > slot->WORSTREADMS && slot->WORSTREADMS && !one->over++) { one->over_at = hall.now; one->over_age = age; one->over_worst = slot->WORSTREADMS; }
  }
}
void crowd_begin(uint64_t seed, int wanted) {
  chance_state = 0x9E3779B97F4A7C15ULL * (seed + 1); between(0, 1);
  memset(&port, 0, sizeof port); memset(slots, 0, sizeof slots); memset(block, 0, sizeof block); memset(was, 0, sizeof was); memset(&hall, 0, sizeof hall);
  wire_in = wire_out = 0; sent_count = 0; last_end = -1000000; short_silences = 0;
  for (line_at = 0; LINES[line_at].slots != wanted; line_at++);
  LINES[line_at].init(line_memory);
}
void crowd_new(int at, int family, int slot) {
  block[at].family = family; block[at].slot = slot; block[at].called = 1; block[at].overdue_at = -1;
  FAMILIES[family].init(memory[at]);
}
/* scan until a request leaves (1), or the next scan would come after a time (0); elapsed is where Python has put it */
int crowd_run(us until, uint16_t *elapsed_ms) {
  for (;;) {
    us took = hall.elapsed;
    if (!took) took = hall.elapsed = hall.scan + (hall.jitter ? between(-hall.jitter, hall.jitter) : 0);
    if (hall.now + took > until) return 0;
    us before = hall.now; hall.now += took; hall.elapsed = 0;
    *elapsed_ms = hall.now / 1000 - before / 1000;
    receive();
    for (int i = 0; i < hall.blocks; i++) if (block[i].called && (!block[i].nth || ++block[i].scans % block[i].nth == 0)) called(i);
    LINES[line_at].call(line_memory, slots, &port);
    for (int i = 0; i < hall.blocks; i++) if (block[i].line_abi) slots[block[i].slot].ABI = block[i].line_abi;
    for (int i = 0; i < hall.blocks; i++) if (block[i].overdue_at < 0 && slots[block[i].slot].STOPOVERDUE) block[i].overdue_at = hall.now;
    if (send()) return 1;
  }
}
