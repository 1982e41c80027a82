/* A virtual RS-485 line in virtual time around the matiec build of MB_Line8 or MB_Line32. Times in microseconds.

   vline run KEY=VALUE ...       one line for `ms` milliseconds; prints what was measured, KEY VALUE per line
   vline random FIRST COUNT KIND so many random lines of a kind (timing, stops, task, late, broken, faults); prints the sums and each failure's seed
   vline cost KEY=VALUE ...      nanoseconds per call of the line, by what the call had to do

   SLOT_COUNT is 8 or 32. The drives come from drives.h, which is written from the same table as the virtual line in Python. */
#include "iec_std_lib.h"
#include "accessor.h"
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
TIME __CURRENT_TIME;
BOOL __DEBUG;
#include "POUS.h"
#include "POUS.c"
#include "drives.h"
#define JOIN2(a, b) a##b
#define JOIN(a, b) JOIN2(a, b)
typedef JOIN(MB_LINE, SLOT_COUNT) Line;
typedef long long us;

/* ---- what a run is made of ---- */
typedef struct {
  int drives, rate, bits, ascii, keeps, silence_ms, tx_late, rx_late, whole, task, words, scan, jitter, max_scan, behind, kind;
  int turn_low, turn_high, turn_ms, longest_ms; /* true turn-round, and what the slot promises */
  int loss, garble, late, duplicate, truncate, scramble, stall; /* per 100,000 replies or scans */
  int dead, revive_ms, dip_ms, echo, foreign_ms, unattended, command_ms, reset, param_ms, stop_every, all_every, lone, poll_ms;
  int ms, drain;
} Config;
static Config c;
#define KEY(name) {#name, &c.name}
static struct { const char *name; int *value; } KEYS[] = {
  KEY(drives), KEY(rate), KEY(bits), KEY(ascii), KEY(keeps), KEY(silence_ms), KEY(tx_late), KEY(rx_late), KEY(whole), KEY(task), KEY(words), KEY(scan),
  KEY(jitter), KEY(max_scan), KEY(behind), KEY(kind), KEY(turn_low), KEY(turn_high), KEY(turn_ms), KEY(longest_ms), KEY(loss),
  KEY(garble), KEY(late), KEY(duplicate), KEY(truncate), KEY(scramble), KEY(stall), KEY(dead), KEY(revive_ms), KEY(dip_ms), KEY(echo),
  KEY(foreign_ms), KEY(unattended), KEY(command_ms), KEY(reset), KEY(param_ms), KEY(stop_every), KEY(all_every), KEY(lone), KEY(poll_ms),
  KEY(ms), KEY(drain)};

/* ---- chance: xorshift, so that a seed is a run ---- */
static uint64_t chance_state;
static uint64_t chance(void) {
  chance_state ^= chance_state << 13; chance_state ^= chance_state >> 7; chance_state ^= chance_state << 17;
  return chance_state;
}
static long between(long low, long high) { return low + (long)(chance() % (uint64_t)(high - low + 1)); }
static int happens(int per_100000) { return per_100000 > 0 && between(1, 100000) <= per_100000; }

/* ---- the line under test, its mailbox and slots ---- */
static Line line; static MB_PORT port; static MB_SLOT slots[SLOT_COUNT];
static us now, started, char_us_x1000;
static us characters(int count) { return (char_us_x1000 * count + 999) / 1000; }
static us silence(void) { return c.rate > 19200 ? 1750 : (char_us_x1000 * 35 + 9999) / 10000; }

/* what a drive asks for, which may be more than a port keeps */
static us needed(void) { us own = c.silence_ms * 1000LL; return own > silence() ? own : silence(); }

/* ---- the wire: characters with the time of their end ---- */
typedef struct { us at; unsigned char value; } Char;
static Char wire[8192]; static int wire_in, wire_out;
static us last_end;                /* of the last character that the port has heard or sent */
static us reply_from, reply_to;    /* the last transmission of a drive or a foreign master */
static void put(us at, unsigned char value) {
  int place = wire_in++ & 8191; /* late replies may overtake */
  while (place != (wire_out & 8191) && wire[(place - 1) & 8191].at > at) { wire[place] = wire[(place - 1) & 8191]; place = (place - 1) & 8191; }
  wire[place].at = at; wire[place].value = value;
}
static void spoil(us from, us to) {
  for (int i = wire_out; i != wire_in; i++) { Char *one = &wire[i & 8191];
    if (one->at > from && one->at - characters(1) < to) one->value ^= 1 << between(0, 7); }
}

/* ---- what is measured ---- */
typedef struct {
  long scans, requests, short_silences, false_timeouts, wrong_readings, false_acks, stops, late_stops, lost_stops, lone_stops,
    late_lone_stops, broken_stops, unasked, parameters, readings, scrambled, overdue, foreign, timeouts, timeouts_after_lone_echo;
  us refresh_sum, refresh_worst, stop_worst, command_sum, command_worst; long refreshes, commands; double ratio, lone_ratio;
} Found;
static Found f;

/* ---- the drives ---- */
typedef struct {
  int alive, reply_good; us dies, revives; unsigned truth, written; long stops_heard, stops_seen; us stop_pin, last_fresh, next_command, command_pin, next_param; unsigned last_reset;
  int stop_open, alone, moved, unattended; unsigned fresh, freshest, timeouts, last_command; long stops_at_pin; unsigned command_number;
} Drive;
static Drive drive[SLOT_COUNT];
/* what breaks a promise, or damages the line, and by how much that can delay a stop which waits before `until` */
static struct { us until, cost; } troubles[256]; static unsigned char trouble_count;
static void trouble(us until, us cost) { troubles[trouble_count].until = until; troubles[trouble_count++].cost = cost; }
static us delay_since(us pin) { us sum = 0; for (int i = 0; i < 256; i++) if (troubles[i].until > pin) sum += troubles[i].cost; return sum; }
enum { PARAMETER_AT = 0x0F00 }; /* where parameters are; nothing of a drive's motion */
static us open_end; static int open_drive, open_good, open_stop, any_broken;
static const Kind *kind;

static unsigned short crc16(const unsigned char *bytes, int count) {
  unsigned short value = 0xFFFF;
  for (int i = 0; i < count; i++) { value ^= bytes[i]; for (int bit = 0; bit < 8; bit++) value = value & 1 ? (value >> 1) ^ 0xA001 : value >> 1; }
  return value;
}
static int digit(int character) { return character <= '9' ? character - '0' : character - 'A' + 10; }
static void fatal(const char *what) { printf("fatal: %s\n", what); exit(3); }

/* request characters to bytes without checksum; a wrong checksum of the line's own ends the program */
static int opened(const unsigned char *text, int count, unsigned char *bytes) {
  if (!c.ascii) { if (crc16(text, count)) fatal("the line has sent a wrong CRC"); memcpy(bytes, text, count); return count - 2; }
  int made = 0; unsigned char sum = 0;
  if (text[0] != ':' || text[count - 2] != 13 || text[count - 1] != 10) fatal("the line has sent a wrong ASCII frame");
  for (int i = 1; i < count - 2; i += 2) { bytes[made] = digit(text[i]) * 16 + digit(text[i + 1]); sum += bytes[made++]; }
  if (sum) fatal("the line has sent a wrong LRC");
  return made - 1;
}
static int sealed(unsigned char *bytes, int count, unsigned char *text) {
  if (!c.ascii) { unsigned short crc = crc16(bytes, count); memcpy(text, bytes, count); text[count] = crc & 255; text[count + 1] = crc >> 8; return count + 2; }
  unsigned char sum = 0; int made = 0;
  for (int i = 0; i < count; i++) sum += bytes[i];
  bytes[count++] = -sum; text[made++] = ':';
  for (int i = 0; i < count; i++) { text[made++] = "0123456789ABCDEF"[bytes[i] >> 4]; text[made++] = "0123456789ABCDEF"[bytes[i] & 15]; }
  text[made++] = 13; text[made++] = 10;
  return made;
}
/* bytes are sent at a time; what overlaps another transmission is spoilt */
static int transmit(unsigned char *bytes, int count, us start, int faults) {
  unsigned char text[170]; int good = 1, length = sealed(bytes, count, text);
  if (faults && happens(c.garble)) { text[between(0, length - 1)] ^= 1 << between(0, 7); good = 0; }
  if (faults && happens(c.scramble) && length > 11) { /* all after the head at random: a CRC lets one in 65,536 pass, an LRC one in 256 */
    for (int i = c.ascii ? 7 : 3; i < length - 2 * c.ascii; i++) text[i] = c.ascii ? "0123456789ABCDEF"[chance() & 15] : chance();
    good = 0; f.scrambled++; }
  if (faults && happens(c.truncate)) { length = between(0, length - 1); good = 0; }
  us end = start + characters(length);
  int collides = start < reply_to && end > reply_from;
  for (int i = 0; i < length; i++) put(start + characters(i + 1), text[i]);
  if (collides) { spoil(start > reply_from ? start : reply_from, end < reply_to ? end : reply_to); good = 0; }
  reply_from = start; reply_to = end;
  return good;
}
/* the last transmission was none of those that a stop may have to wait for: it keeps the wire, then silence, then a scan */
static void occupied(void) { trouble(reply_to + silence() + c.max_scan * 1000LL, reply_to - reply_from + silence() + c.max_scan * 1000LL); }
/* what a drive does with a request that has come whole at `end` */
static void hear(const unsigned char *text, int count, us end) {
  unsigned char bytes[64], reply[80]; int length = 6;
  opened(text, count, bytes);
  open_drive = -1; open_good = 0; open_end = end; open_stop = 0;
  for (int i = 0; i < c.drives; i++) if (slots[i].UNITADDRESS == bytes[0]) open_drive = i;
  if (open_drive < 0) fatal("the line has asked a unit that is not there");
  Drive *one = &drive[open_drive];
  int address = bytes[2] << 8 | bytes[3];
  open_stop = address == kind->stop_address && bytes[1] == kind->stop_function;
  if (open_stop && one->stop_open == 1) { /* the first frame since the pin */
    us took = end - characters(count) - one->stop_pin; double share = took / (slots[open_drive].WORSTSTOPMS * 1000.0);
    us excess = delay_since(one->stop_pin); one->stop_open = 2; f.stops++;
    if (took > f.stop_worst) f.stop_worst = took;
    if (share > f.ratio) f.ratio = share;
    if (share > 1) { if (took <= slots[open_drive].WORSTSTOPMS * 1000LL + excess) f.broken_stops++; else f.late_stops++; }
    if (one->alone) { double own = took / (slots[open_drive].STOPALONEMS * 1000.0); f.lone_stops++;
      if (own > f.lone_ratio) f.lone_ratio = own;
      if (took > slots[open_drive].STOPALONEMS * 1000LL + excess) f.late_lone_stops++; }
  }
  /* a parameter leaves only while its drive block lets it pass, a fault reset once per Number */
  if (address == PARAMETER_AT) { f.parameters++; if (slots[open_drive].PARAMETERCLEARED != slots[open_drive].ASK.table[2].NUMBER) f.unasked++; }
  else if (!open_stop && bytes[1] > 4 && slots[open_drive].RESETASKED) {
    if (one->last_reset == slots[open_drive].ASK.table[1].NUMBER) f.unasked++;
    one->last_reset = slots[open_drive].ASK.table[1].NUMBER; }
  if (!one->alive) return;
  if (open_stop) { one->stops_heard++; one->moved = 0; }
  else if (bytes[1] > 4 && address != PARAMETER_AT) one->moved = 1;
  memcpy(reply, bytes, 6);
  if (bytes[1] <= 2) { /* coils: the lowest bits of the count */
    int data = (bytes[5] + 7) / 8; one->truth = (one->truth + 1) & ((1 << bytes[5]) - 1);
    reply[2] = data; length = 3 + data; reply[3] = one->truth & 255; reply[4] = one->truth >> 8;
    if (data == 1) reply[4] = 0;
  } else if (bytes[1] <= 4) {
    int words = bytes[5]; one->truth = (one->truth + 1) & 0xFFFF;
    reply[2] = 2 * words; length = 3 + 2 * words;
    for (int i = 0; i < words; i++) { reply[3 + 2 * i] = one->truth >> 8; reply[4 + 2 * i] = one->truth & 255; }
  } else if (!open_stop && address != PARAMETER_AT) one->written = bytes[1] <= 6 ? bytes[4] << 8 | bytes[5] : bytes[7] << 8 | bytes[8];
  if (happens(c.loss)) return;
  us start = end + between(c.turn_low, c.turn_high); int in_time = start - end <= c.turn_ms * 1000LL;
  if (happens(c.late)) { start = end + between(c.turn_ms * 1000L, c.longest_ms * 1000L); in_time = 0; }
  if (!in_time) any_broken = 1;
  int twice = happens(c.duplicate);
  open_good = transmit(reply, length, start, 1) && in_time;
  if (!in_time) occupied();
  if (twice) { us again = reply_to + silence(); transmit(reply, length, again, 0); occupied(); }
}

/* ---- the adapter ---- */
static unsigned short seen; static int waiting, tx_scans;
static void send(void) {
  if (port.TXNUMBER == port.TXTAKEN || port.TXCOUNT == 0) { waiting = 0; return; }
  if (!waiting) { waiting = 1; tx_scans = c.tx_late; }
  if (tx_scans-- > 0) return;
  waiting = 0; port.TXTAKEN = port.TXNUMBER; f.requests++;
  us start = now, heard = last_end;
  for (int i = wire_out; i != wire_in; i++) { us at = wire[i & 8191].at;
    if (at <= now && at > heard) heard = at;
    if (c.keeps && at - characters(1) < start + silence() && at > heard && at - characters(1) < heard + silence()) heard = at; }
  if (c.keeps && start < heard + silence()) start = heard + silence();
  if (start < heard + needed()) f.short_silences++;
  us end = start + characters(port.TXCOUNT);
  int collides = start < reply_to && end > reply_from;
  if (collides) spoil(start, end);
  if (c.echo) { for (int i = 0; i < port.TXCOUNT; i++) put(start + characters(i + 1), port.TX.table[i]); if (collides) spoil(start, end); }
  if (end > last_end) last_end = end;
  if (!collides) hear(port.TX.table, port.TXCOUNT, end);
  else { open_good = 0; Drive *one; unsigned char bytes[64]; opened(port.TX.table, port.TXCOUNT, bytes); /* it has left, though nobody understands it */
    for (int i = 0; i < c.drives; i++) if (slots[i].UNITADDRESS == bytes[0]) { one = &drive[i];
      if (one->stop_open == 1 && (bytes[2] << 8 | bytes[3]) == kind->stop_address && bytes[1] == kind->stop_function) { one->stop_open = 2; f.stops++; } } }
}
static void receive(void) {
  us until = now - (us)c.rx_late * c.scan;
  while (wire_out != wire_in && wire[wire_out & 8191].at <= until) {
    if (c.whole) { /* messages only: what is followed by silence */
      us at = wire[wire_out & 8191].at;
      for (int i = wire_out + 1; i != wire_in && wire[i & 8191].at - at <= silence(); i++) at = wire[i & 8191].at;
      if (at + silence() > until) break;
    }
    if (wire[wire_out & 8191].at > last_end) last_end = wire[wire_out & 8191].at;
    port.RX.table[port.RXIN] = wire[wire_out & 8191].value; port.RXIN = (port.RXIN + 1) % 256; wire_out++;
  }
}

/* an adapter in a task of its own, whose calls come in another rhythm than those of the line */
static us next_tick;
static void adapter_task(us end) {
  while (next_tick <= end) { now = next_tick; receive(); send(); next_tick += c.task - between(0, c.task / 2); }
  now = end;
}

/* ---- drive blocks: the least that a drive block does with its slot ---- */
static void ask(MB_ASK *box, int function, int address, int quantity, unsigned value) {
  box->FUNCTIONCODE = function; box->ADDRESS = address; box->QUANTITY = quantity; box->WORDS.table[0] = value;
}
static WORD check(const MB_ASK *box) { return MB_ASKCHECK(1, 0, box->NUMBER, box->ADDRESS, box->FUNCTIONCODE, box->QUANTITY, box->UNIT, box->FAMILYCODE, box->WORDS.table[0]); }
static void post(MB_ASK *box) { box->NUMBER = box->NUMBER % 65535 + 1; box->CHECK = check(box); }
static int waits(int i, int box) { return slots[i].ASK.table[box].NUMBER != slots[i].ANSWER.table[box].NUMBER; }
static void drive_block(int i, us warm) {
  MB_SLOT *slot = &slots[i]; Drive *one = &drive[i];
  slot->ALIVE++; slot->ABI = ABI_WORD;
  if (slot->FRESH != one->fresh) {
    if (one->last_fresh > 0 && now > warm) { us took = now - one->last_fresh; f.refresh_sum += took; f.refreshes++; if (took > f.refresh_worst) f.refresh_worst = took; }
    one->last_fresh = now; one->fresh = slot->FRESH;
  }
  if (one->stop_open == 2 && !waits(i, 0)) { one->stop_open = 0;
    /* without late replies it must have been heard; with them an earlier stop's may pass for it, if nothing moved since */
    if (one->stops_heard == one->stops_at_pin && (one->moved || !any_broken)) f.false_acks++; }
  if (one->command_pin && !waits(i, 1)) {
    if (slot->ANSWER.table[1].ERRORID == 0) { us took = now - one->command_pin; f.command_sum += took; f.commands++; if (took > f.command_worst) f.command_worst = took;
      if (one->written != one->last_command) f.false_acks++; }
    one->command_pin = 0;
  }
  if (c.command_ms && now >= one->next_command && !waits(i, 1) && one->stop_open == 0) {
    one->next_command = now + c.command_ms * 1000LL; one->last_command = chance() & 0xFFFF; one->command_pin = now;
    if (c.reset) slot->RESETASKED = happens(50000);
    ask(&slot->ASK.table[1], kind->write_function, kind->write_address, 1, one->last_command); post(&slot->ASK.table[1]);
  }
  if (c.param_ms && now >= one->next_param) { /* asked, let through, or taken back */
    static const int FUNCTIONS[] = {3, 6, 16}; MB_ASK *box = &slot->ASK.table[2];
    one->next_param = now + between(1, c.param_ms) * 1000LL;
    if (!waits(i, 2)) { int function = FUNCTIONS[between(0, 2)]; ask(box, function, PARAMETER_AT, function == 6 ? 1 : between(1, 4), 7); post(box); slot->PARAMETERCLEARED = 0; }
    else slot->PARAMETERCLEARED = slot->PARAMETERCLEARED ? 0 : box->NUMBER;
  }
  int others = 0;
  for (int k = 0; k < c.drives; k++) others += k != i && drive[k].stop_open == 1;
  int all = c.all_every && f.scans % c.all_every == 0;
  int pin = all || (c.stop_every && between(1, c.stop_every) == 1 && !(c.lone && others));
  if (pin && one->stop_open == 0 && !waits(i, 0)) {
    post(&slot->ASK.table[0]); one->command_pin = 0; /* the line takes the command back */
    one->stop_open = 1; one->stop_pin = now; one->stops_at_pin = one->stops_heard; one->alone = !others;
    for (int k = 0; k < c.drives; k++) if (k != i && drive[k].stop_open == 1) drive[k].alone = 0;
  }
}

static void begin(void) {
  memset(&line, 0, sizeof line); memset(&port, 0, sizeof port); memset(slots, 0, sizeof slots); memset(drive, 0, sizeof drive); memset(&f, 0, sizeof f);
  memset(troubles, 0, sizeof troubles);
  JOIN(JOIN(MB_LINE, SLOT_COUNT), _init__)(&line, 0);
  now = 0; started = 0; wire_in = wire_out = 0; last_end = reply_from = reply_to = -1000000; waiting = 0; any_broken = c.turn_high > c.turn_ms * 1000;
  open_drive = -1;
  kind = &KINDS[c.kind];
  char_us_x1000 = (1000000000LL * c.bits + c.rate - 1) / c.rate;
  line.BITRATE.value = c.rate; line.CHARACTERBITS.value = c.bits; line.ASCII.value = c.ascii; line.MAXSCANMS.value = c.max_scan;
  port.KEEPSSILENCE = c.keeps;
  /* an adapter in a task of its own keeps a request back for one of its periods, and a reply for another */
  port.LATEMS = (c.tx_late + c.rx_late) * c.max_scan + (c.whole ? (silence() + 999) / 1000 : 0) + (c.task ? 2 * ((c.task + 999) / 1000) : 0);
  next_tick = 0;
  for (int i = 0; i < c.drives; i++) {
    MB_SLOT *slot = &slots[i];
    slot->ABI = ABI_WORD; slot->UNITADDRESS = i + 1; slot->FAMILYCODE = c.kind + 1; slot->TURNROUNDMS = c.turn_ms; slot->LONGESTMS = c.drain ? c.turn_ms : c.longest_ms;
    slot->EXCEPTIONADD = kind->exception_add; slot->ERRORFUNCTION = kind->error_function; slot->ERRORADDRESS = kind->error_address;
    /* of coils a reply tells its bytes alone: another number of them */
    slot->OTHERQUANTITY = kind->read_function > 2 ? c.words + 1 : c.words > 8 ? c.words - 8 : c.words + 8; slot->POLLEVERYMS = c.poll_ms; slot->SILENCEMS = c.silence_ms;
    ask(&slot->ASK.table[0], kind->stop_function, kind->stop_address, kind->stop_words, kind->stop_word);
    slot->STOPREGISTER = kind->stop_address; slot->STOPWORD = kind->stop_word; slot->HASSTOP = 1;
    ask(&slot->ASK.table[3], kind->read_function, kind->read_address, c.words, 0); slot->ASK.table[3].NUMBER = 1;
    for (int box = 0; box < 4; box++) { slot->ASK.table[box].UNIT = i + 1; slot->ASK.table[box].FAMILYCODE = c.kind + 1; }
    slot->ASK.table[0].CHECK = check(&slot->ASK.table[0]);
    drive[i].alive = 1; drive[i].last_reset = -1; drive[i].next_command = between(0, 1000) * 1000;
  }
  for (int i = 0; i < c.dead; i++) drive[c.drives - 1 - i].alive = 0;
}
static void faults(void) {
  for (int i = 0; i < c.drives; i++) {
    if (c.revive_ms && between(1, (us)c.revive_ms * 1000 / c.scan + 1) == 1) drive[i].alive = !drive[i].alive;
    if (c.dip_ms && drive[i].alive && between(1, 2000) == 1) { drive[i].alive = 0; drive[i].revives = now + c.dip_ms * 1000LL; }
    if (drive[i].revives && now >= drive[i].revives) { drive[i].alive = 1; drive[i].revives = 0; }
  }
  if (c.foreign_ms && between(1, (us)c.foreign_ms * 1000 / c.scan + 1) == 1) {
    unsigned char asked[8] = {between(1, 40), 3, 0x20, 0, 0, 4}, told[16] = {asked[0], 3, 8, 1, 2, 3, 4, 5, 6, 7, 8};
    transmit(asked, 6, now + between(0, c.scan), 0); occupied(); transmit(told, 11, reply_to + 5000, 0); occupied(); any_broken = 1;
  }
}
static int elapsed;
static void call(void) {
  line.ELAPSEDMS.value = elapsed; line.PORT.value = port; memcpy(&line.SLOTS.value, slots, sizeof slots);
  JOIN(JOIN(MB_LINE, SLOT_COUNT), _body__)(&line);
  port = line.PORT.value; memcpy(slots, &line.SLOTS.value, sizeof slots);
}
/* a stop of the line's own is a stop, too: no other that waits meanwhile is alone */
static void own_stops(void) {
  for (int i = 0; i < c.drives; i++) {
    if (line.TRACK.value.table[i].STOP.FORCED == 1 || slots[i].UNATTENDED > drive[i].unattended) for (int k = 0; k < c.drives; k++) if (k != i) drive[k].alone = 0;
    drive[i].unattended = slots[i].UNATTENDED; }
}
static void scan(us warm) {
  us took = c.scan + (c.jitter ? between(-c.jitter, c.jitter) : 0), before = now;
  if (happens(c.stall)) { took = between(50000, 250000); any_broken = 1; trouble(now + took, took + c.max_scan * 1000LL); }
  if (c.task) adapter_task(now + took); else now += took;
  elapsed = now / 1000 - before / 1000;
  faults(); if (!c.task) receive(); f.scans++;
  if (!c.behind) for (int i = 0; i < c.drives; i++) if (!(c.unattended && i == 0 && now > 3000000)) drive_block(i, warm);
  own_stops(); call(); own_stops();
  if (c.behind) for (int i = 0; i < c.drives; i++) drive_block(i, warm);
  for (int i = 0; i < c.drives; i++) {
    if (slots[i].FRESH != drive[i].freshest) { drive[i].freshest = slots[i].FRESH; f.readings++;
      if (slots[i].POLLWORDS.table[0] != drive[i].truth) f.wrong_readings++; }
    if (slots[i].TIMEOUTS != drive[i].timeouts) { drive[i].timeouts = slots[i].TIMEOUTS; f.timeouts++;
      if (open_good && open_drive == i && !(line.ECHO.value == 0 && open_stop)) f.false_timeouts++; }
    f.overdue += slots[i].STOPOVERDUE;
  }
  if (!c.task) send();
}
static void finish(void) {
  for (int i = 0; i < c.drives; i++)
    if (drive[i].stop_open == 1 && now - drive[i].stop_pin > 3 * slots[i].WORSTSTOPMS * 1000LL) f.lost_stops++;
  f.foreign = line.FOREIGNFRAMES.value;
}
static void defaults(void) {
  memset(&c, 0, sizeof c);
  c.drives = 7; c.rate = 19200; c.bits = 10; c.keeps = 1; c.words = 6; c.scan = 10000; c.jitter = 1000; c.max_scan = 12;
  c.turn_low = c.turn_high = 5000; c.turn_ms = 5; c.longest_ms = 30; c.ms = 60000;
}
static void told(const char *name, double value) { printf("%s %.10g\n", name, value); }
static void report(void) {
  told("scans", f.scans); told("requests", f.requests); told("short_silences", f.short_silences); told("false_timeouts", f.false_timeouts);
  told("scrambled", f.scrambled); told("timeouts", f.timeouts); told("readings", f.readings); told("wrong_readings", f.wrong_readings); told("false_acks", f.false_acks);
  told("parameters", f.parameters); told("unasked", f.unasked); told("stops", f.stops); told("late_stops", f.late_stops); told("lost_stops", f.lost_stops); told("broken_stops", f.broken_stops);
  told("lone_stops", f.lone_stops); told("late_lone_stops", f.late_lone_stops); told("ratio", f.ratio); told("lone_ratio", f.lone_ratio);
  told("stop_worst_ms", f.stop_worst / 1000.0); told("refresh_ms", f.refreshes ? f.refresh_sum / 1000.0 / f.refreshes : 0);
  told("refresh_worst_ms", f.refresh_worst / 1000.0); told("commands", f.commands);
  told("command_ms", f.commands ? f.command_sum / 1000.0 / f.commands : 0); told("command_worst_ms", f.command_worst / 1000.0);
  told("foreign", f.foreign); told("worst_stop_ms", line.WORSTSTOPMS.value); told("stop_alone_ms", line.STOPALONEMS.value);
  told("cycle_ms", line.CYCLEMS.value); told("load", line.LOADPERCENT.value); told("virtual_hours", now / 3.6e9);
}

/* ---- random lines ---- */
static void draw(uint64_t seed, const char *what) {
  static const int RATES[] = {4800, 9600, 19200, 38400, 57600, 115200};
  chance_state = 0x9E3779B97F4A7C15ULL * (seed + 1); chance();
  defaults();
  c.drives = between(1, SLOT_COUNT); c.rate = RATES[between(0, 5)]; c.bits = between(10, 11); c.keeps = between(0, 1);
  c.ascii = between(0, 4) == 0; c.kind = between(0, KIND_COUNT - 1); c.words = between(1, 15);
  c.scan = between(1, 50) * 1000; c.jitter = c.scan / 2 * between(0, 1); c.max_scan = (c.scan + c.jitter) / 1000 + 1;
  c.tx_late = between(0, 2) == 0 ? between(0, 3) : 0; c.rx_late = between(0, 2) == 0 ? between(0, 3) : 0; c.whole = between(0, 3) == 0;
  c.turn_ms = between(1, 40); c.turn_low = 0; c.turn_high = c.turn_ms * 1000; c.longest_ms = c.turn_ms;
  c.echo = between(0, 4) == 0; c.command_ms = between(0, 2) * between(1, 500);
  c.silence_ms = between(0, 4) == 0 ? between(5, 30) : 0; c.param_ms = between(0, 1) * between(1, 500); c.reset = between(0, 1);
  if (!strcmp(what, "timing")) { c.stall = between(0, 1) && !c.tx_late && !c.rx_late && !c.whole ? 1000 : 0; return; }
  if (!strcmp(what, "task")) { c.task = between(1, 60) * 1000; c.tx_late = c.rx_late = 0; }
  c.longest_ms = between(1, 4) * c.turn_ms;
  c.loss = between(0, 2) == 0 ? between(0, 50000) : 0; c.garble = between(0, 2) == 0 ? between(0, 30000) : 0;
  c.dead = between(0, 3) == 0 ? between(0, c.drives) : 0; c.stop_every = between(20, 300); c.lone = between(0, 1);
  c.all_every = between(0, 3) == 0 ? between(50, 200) : 0;
  if (!strcmp(what, "late")) { c.longest_ms = between(1, 5) * c.turn_ms; c.late = between(0, 5000); c.revive_ms = between(0, 1) * between(500, 5000); }
  if (!strcmp(what, "broken")) c.turn_high = 3 * c.turn_ms * 1000;
  if (!strcmp(what, "faults")) {
    c.turn_high = between(1, 3) * c.turn_ms * 1000; c.longest_ms = 3 * c.turn_ms; c.late = between(0, 3000); c.duplicate = between(0, 3000);
    c.truncate = between(0, 10000); c.stall = between(0, 2) == 0 ? 500 : 0; c.revive_ms = between(0, 1) * between(500, 5000);
    c.dip_ms = between(0, 1) * between(50, 500); c.foreign_ms = between(0, 3) == 0 ? between(200, 2000) : 0; c.unattended = between(0, 3) == 0;
  }
}
static int run_random(uint64_t first, long count, const char *what, int scans) {
  Found sum; memset(&sum, 0, sizeof sum); long failures = 0; double hours = 0;
  for (long k = 0; k < count; k++) {
    draw(first + k, what); begin();
    for (int i = 0; i < scans; i++) scan(0);
    finish(); hours += now / 3.6e9;
    int late = !strcmp(what, "late"), strict = !late && strcmp(what, "faults") && strcmp(what, "broken");
    int bad = f.lost_stops || f.false_acks || f.unasked || (late && f.wrong_readings) || f.late_stops || f.late_lone_stops || (strict && (f.short_silences || f.false_timeouts || f.wrong_readings));
    if (bad && failures++ < 10)
      printf("failure seed %llu kind %s: lost %ld false_acks %ld short %ld false_timeouts %ld wrong %ld late %ld lone %ld unasked %ld\n", (unsigned long long)(first + k), what,
        f.lost_stops, f.false_acks, f.short_silences, f.false_timeouts, f.wrong_readings, f.late_stops, f.late_lone_stops, f.unasked);
    sum.unasked += f.unasked; sum.parameters += f.parameters; sum.scans += f.scans; sum.requests += f.requests; sum.short_silences += f.short_silences; sum.false_timeouts += f.false_timeouts; sum.timeouts += f.timeouts;
    sum.readings += f.readings; sum.wrong_readings += f.wrong_readings; sum.false_acks += f.false_acks; sum.stops += f.stops; sum.late_stops += f.late_stops;
    sum.lost_stops += f.lost_stops; sum.lone_stops += f.lone_stops; sum.late_lone_stops += f.late_lone_stops; sum.broken_stops += f.broken_stops; sum.commands += f.commands;
    if (f.ratio > sum.ratio) sum.ratio = f.ratio;
    if (f.lone_ratio > sum.lone_ratio) sum.lone_ratio = f.lone_ratio;
  }
  f = sum; now = (us)(hours * 3.6e9); report(); told("failures", failures);
  return failures > 0;
}
/* the checksum of 256 bytes by a table: beside it the times of one machine can be set beside those of others */
static double crc_ns(void) {
  static unsigned short table[256]; static unsigned char bytes[256]; static volatile unsigned short value; struct timespec from, to;
  if (!table[1]) for (int i = 0; i < 256; i++) { unsigned short one = i; for (int bit = 0; bit < 8; bit++) one = one & 1 ? (one >> 1) ^ 0xA001 : one >> 1; table[i] = one; }
  bytes[chance() & 255]++;
  clock_gettime(CLOCK_MONOTONIC, &from);
  unsigned short crc = 0xFFFF;
  for (int i = 0; i < 256; i++) crc = (crc >> 8) ^ table[(crc ^ bytes[i]) & 255];
  value = crc;
  clock_gettime(CLOCK_MONOTONIC, &to);
  return (to.tv_sec - from.tv_sec) * 1e9 + (to.tv_nsec - from.tv_nsec);
}
/* means of 50 batches, the lowest of each kind: what other programs on this machine disturb least */
static int run_cost(void) {
  struct timespec from, to; double sums[4] = {0}, least[4] = {0}; long counts[4] = {0};
  begin();
  for (int i = 0; i < 200000; i++) {
    us before = now; now += c.scan; elapsed = now / 1000 - before / 1000; receive();
    for (int k = 0; k < c.drives; k++) { slots[k].ALIVE++; slots[k].ABI = ABI_WORD; }
    unsigned number = port.TXNUMBER; int open = line.EXCHANGE.PHASE.value > 0;
    clock_gettime(CLOCK_MONOTONIC, &from); call(); clock_gettime(CLOCK_MONOTONIC, &to);
    int what = port.TXNUMBER != number && open ? 2 : line.EXCHANGE.PHASE.value > 0 ? 1 : 0;
    double took = (to.tv_sec - from.tv_sec) * 1e9 + (to.tv_nsec - from.tv_nsec);
    if (took < 20000) { sums[what] += took; counts[what]++; }
    if (i % 10 == 0 && (took = crc_ns()) < 20000) { sums[3] += took; counts[3]++; }
    send();
    if (i % 4000 == 3999) for (int k = 0; k < 4; k++) { if (counts[k] > 20 && (least[k] == 0 || sums[k] / counts[k] < least[k])) least[k] = sums[k] / counts[k];
      sums[k] = counts[k] = 0; }
  }
  told("idle_ns", least[0]); told("waiting_ns", least[1]); told("transaction_ns", least[2]); told("crc_ns", least[3]);
  told("slot_bytes", sizeof(MB_SLOT)); told("line_bytes", sizeof(Line)); told("port_bytes", sizeof(MB_PORT));
  return 0;
}
int main(int count, char **words) {
  chance_state = 88172645463325252ULL;
  if (count >= 5 && !strcmp(words[1], "random")) return run_random(strtoull(words[2], 0, 10), atol(words[3]), words[4], count > 5 ? atoi(words[5]) : 400);
  defaults();
  for (int i = 2; i < count; i++) { char *mark = strchr(words[i], '='); int found = 0;
    for (unsigned k = 0; mark && k < sizeof KEYS / sizeof *KEYS; k++)
      if (strlen(KEYS[k].name) == (size_t)(mark - words[i]) && !strncmp(words[i], KEYS[k].name, mark - words[i])) { *KEYS[k].value = atoi(mark + 1); found = 1; }
    if (!found) { fprintf(stderr, "unknown: %s\n", words[i]); return 2; } }
  if (count >= 2 && !strcmp(words[1], "cost")) return run_cost();
  begin();
  while (now < c.ms * 1000LL) scan(3000000);
  finish(); report();
  return 0;
}
