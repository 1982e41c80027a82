/* A simulated drive in C, from the tables of tables.py: the same model as driveblocks.simulator, reply for reply.

   vd_begin, vd_step, vd_reply and what happens to it (vd_trip, vd_power ...). Frequencies in thousandths of a hertz,
   reverse negative; times in milliseconds. The public fields are those of SimulatedDrive. */
#include <stdlib.h>
#include <string.h>

typedef struct {
  const VTable *t; int unit;
  long long now, heard_at, busy_until, next_at;
  int powered, fault, last_fault, cause, warning, inhibited, local, follows, keeps_running, load;
  int state, next, waits, after, stopping, quick, reverse, jog, own, own_milli, restart;
  long long output, shaft; int driven;
  long stores;
  unsigned short words[65536], stored[65536]; long long changed[65536];
} VDrive;

/* what a write touched: registers, their words before and since when */
typedef struct { int count, reg[128]; unsigned short word[128]; long long since[128]; } VBefore;

static int vd_inside(const VSpan *spans, int count, int address) {
  for (int i = 0; i < count; i++) if (address >= spans[i].first && address <= spans[i].last) return 1;
  return 0;
}
static int vd_readable(const VDrive *d, int address) { return vd_inside(d->t->readable, d->t->readable_count, address); }
static int vd_writable(const VDrive *d, int address) { return vd_inside(d->t->writable, d->t->writable_count, address); }
static int vd_home(const VDrive *d, int address) {
  int plain = address - d->t->add;
  return d->t->add && vd_inside(d->t->parameters, d->t->parameters_count, plain) ? plain : address;
}
static int vd_parameter(const VDrive *d, int address) {
  return vd_inside(d->t->parameters, d->t->parameters_count, vd_home(d, address));
}

/* ---- what is to be seen ---- */
static long long vd_referred(const VDrive *d) {
  int word = d->words[d->t->reference], number = d->t->reference_signed && word & 0x8000 ? word - 0x10000 : word;
  long long milli = (long long)abs(number) * d->t->times / d->t->per;
  int verified = 1;
  for (int i = 0; i < d->t->verify_count; i++) { const VPattern *p = &d->t->verify[i]; if ((d->words[p->reg] & p->mask) != p->value) verified = 0; }
  if (!verified) milli *= d->t->habits->misread;
  return number < 0 && d->t->reverses ? -milli : milli;
}
static long long vd_goal(const VDrive *d) {
  const VHabits *h = d->t->habits;
  long long most = 1000LL * h->maximum_hz, milli = d->jog ? 1000LL * h->jog_hz : d->own ? d->own_milli : vd_referred(d);
  if (d->stopping) return 0;
  milli = milli > most ? most : milli < -most ? -most : milli;
  return d->reverse ? -milli : milli;
}
static long long vd_shown(const VDrive *d) { return d->t->habits->coast_shows_zero ? d->output : d->shaft; }
static int vd_measure(const VDrive *d, const VGauge *g) {
  const VHabits *h = d->t->habits;
  long long shown = vd_shown(d), output = shown < 0 ? -shown : shown, share = output * 100 / (1000LL * h->maximum_hz), milli = 0;
  switch (g->shows) {
    case M_OUTPUT_FREQUENCY: milli = g->sign ? shown : output; break;
    case M_OUTPUT_CURRENT: milli = 10LL * h->amperes * d->load * d->driven; break;
    case M_OUTPUT_VOLTAGE: milli = 10 * h->motor_volts * share * d->driven; break;
    case M_DC_BUS_VOLTAGE: milli = 1000LL * h->bus_volts; break;
    case M_OUTPUT_POWER: milli = h->kilowatts * d->load * share * d->driven / 10; break;
    case M_OUTPUT_SPEED: milli = 60 * (g->sign ? shown : output) / h->pole_pairs; break;
    case M_OUTPUT_TORQUE: milli = 1000LL * d->load * d->driven; break;
    case M_RELATIVE_POWER: milli = 10LL * d->load * share * d->driven; break;
    case M_DRIVE_TEMPERATURE: milli = 1000LL * h->drive_degrees; break;
    case M_MOTOR_TEMPERATURE: milli = 1000LL * h->motor_degrees; break;
    case M_OPERATING_TIME: milli = 1000LL * h->hours; break;
    case M_ENERGY: milli = 1000LL * h->kilowatt_hours; break;
  }
  return (int)(milli / g->milli) & 0xFFFF;
}
static int vd_face(const VDrive *d, int place) {
  int running = d->driven && (d->t->habits->runs_while_stopping || !d->stopping);
  long long shown = vd_shown(d), goal = vd_goal(d);
  int key = (d->fault != 0) | running << 1 | (running && (shown < 0 || (shown == 0 && goal < 0))) << 2
    | (running && shown == goal && goal != 0) << 3 | (shown == 0) << 4 | (!d->fault && !d->inhibited) << 5 | d->warning << 6;
  for (int i = 0; i < d->t->faces_count; i++)
    if (d->t->faces[i].key == key && d->t->faces[i].state == d->state) return d->t->faces[i].words[place];
  abort();
}
static int vd_word(const VDrive *d, int address) {
  const VTable *t = d->t; int home = vd_home(d, address), code = d->fault ? d->fault : t->habits->keeps_fault_code ? d->last_fault : 0;
  for (int i = 0; i < t->gauges_count; i++) if (t->gauges[i].reg == address) return vd_measure(d, &t->gauges[i]);
  if (address == t->present) return code;
  if (home >= t->fault_first && home <= t->fault_last) {
    int place = code - 1 - 16 * (home - t->fault_first);
    return d->words[home] | (place >= 0 && place < 16 ? 1 << place : 0);
  }
  for (int i = 0; i < t->named_count; i++) if (t->named[i].reg == home) return (d->words[home] & ~t->named[i].bits) | vd_face(d, i);
  return d->words[home];
}

/* ---- what happens to it ---- */
static void vd_let_go(VDrive *d) {
  if (d->driven) d->state = d->fault ? -1 : d->after;
  d->output = 0; d->driven = d->stopping = d->quick = d->jog = 0;
}
static void vd_run(VDrive *d, int reverse, int jog, int own, int milli) {
  d->stopping = d->quick = 0; d->reverse = reverse; d->jog = jog; d->own = own; d->own_milli = milli;
  if (!d->driven) { d->output = d->shaft; d->driven = 1; }
  d->state = -1; d->waits = 0;
}
static void vd_stop(VDrive *d, int effect, int after) {
  if (effect == E_JOG_STOP && !d->jog) return;
  if (effect == E_STOP && d->jog && !d->t->habits->stop_ends_jog) return;
  d->after = after;
  if (effect == E_COAST_STOP) vd_let_go(d);
  else { d->stopping = 1; d->quick |= effect == E_QUICK_STOP; }
}
static void vd_settle(VDrive *d) { if (d->waits && d->now >= d->next_at) { d->state = d->next; d->waits = 0; } }
static int vd_fires(const VDrive *d, const VMove *m, const VBefore *b) {
  int touched = 0, edge = 0, own = -1;
  const VNeed *needs = d->t->needs + m->first_need;
  for (int n = 0; n < m->need_count; n++) edge |= needs[n].before;
  for (int i = 0; i < b->count; i++) {
    if (b->reg[i] == m->reg) { touched = 1; own = i; }
    for (int n = 0; n < m->need_count; n++) if (!edge && b->reg[i] == needs[n].reg) touched = 1;
  }
  if (!touched || (d->words[m->reg] & m->mask) != m->value) return 0;
  if (m->guard >= 0 && m->guard != d->state && !(m->effect > E_STATE && d->driven)) return 0;
  for (int n = 0; n < m->need_count; n++) {
    int word = needs[n].before ? b->word[own] : d->words[needs[n].reg];
    long long since = needs[n].before ? b->since[own] : d->changed[needs[n].reg];
    if ((word & needs[n].mask) != needs[n].value || d->now - since < needs[n].for_ms) return 0;
  }
  return 1;
}
static void vd_move(VDrive *d, const unsigned char *fired) {
  const VMove *best = 0;
  for (int i = 0; i < d->t->moves_count; i++) { const VMove *m = &d->t->moves[i];
    if (fired[i] && m->effect > E_STATE && (!best || m->exact > best->exact)) best = m; }
  if (best && !d->fault && !d->inhibited)
    vd_run(d, best->effect == E_RUN_REVERSE || best->effect == E_JOG_REVERSE, best->effect >= E_JOG_FORWARD, 0, 0);
}
static void vd_hold(VDrive *d) {
  unsigned char fired[64] = {0}; VBefore all; all.count = 0; int stops = 0;
  for (int pass = 0; pass < 2; pass++) for (int i = 0; i < d->t->moves_count; i++) {
    const VMove *m = &d->t->moves[i]; int edge = 0;
    for (int n = 0; n < m->need_count; n++) edge |= d->t->needs[m->first_need + n].before;
    if (m->guard >= 0 || edge) continue;
    if (pass == 0) all.reg[all.count++] = m->reg;
    else { fired[i] = vd_fires(d, m, &all); stops |= fired[i] && m->effect <= E_JOG_STOP; }
  }
  if (!stops) vd_move(d, fired);
}
static void vd_trip(VDrive *d, int code) {
  if (!d->powered || d->fault) return;
  d->fault = d->last_fault = code; d->cause = 1;
  vd_let_go(d); d->state = -1; d->waits = 0;
}
static void vd_clear_cause(VDrive *d) { d->cause = 0; }
static void vd_reset(VDrive *d) {
  if (!d->fault || d->cause || d->shaft || !d->powered) return;
  d->fault = 0;
  if (d->t->habits->resumes) vd_hold(d);
}
static void vd_keypad_run(VDrive *d, int own, int milli, int reverse) { if (d->powered && !d->fault && !d->inhibited) vd_run(d, reverse, 0, own, milli); }
static void vd_keypad_stop(VDrive *d) { if (d->driven) { d->jog = 0; vd_stop(d, E_STOP, -1); } }
static void vd_inhibit(VDrive *d, int on) { d->inhibited = on; if (on) vd_let_go(d); }
static void vd_set(VDrive *d, int address, int word) {
  d->words[vd_home(d, address)] = word;
  if (vd_parameter(d, address)) d->stored[vd_home(d, address)] = word;
}
static void vd_plate(VDrive *d) { for (int i = 0; i < d->t->plate_count; i++) d->words[d->t->plate[i].reg] = d->t->plate[i].bits; }
static void vd_power(VDrive *d, int on) {
  if (on == d->powered) return;
  d->powered = on;
  if (on) {
    d->heard_at = d->now;
    if (!d->cause) d->fault = 0;
    if (d->restart && !d->fault && !d->driven) { d->output = d->shaft; d->driven = 1; }
    return;
  }
  int keeps = d->t->habits->auto_restart;
  d->restart = keeps && d->driven && !d->stopping;
  for (int i = 0; i < 65536; i++) {
    int kept = keeps && i == d->t->reference;
    for (int m = 0; m < d->t->moves_count; m++) kept |= keeps && d->t->moves[m].reg == i;
    if (vd_inside(d->t->parameters, d->t->parameters_count, i) || !kept) d->words[i] = d->stored[i];
  }
  vd_plate(d);
  memset(d->changed, 0, sizeof d->changed);
  vd_let_go(d); d->busy_until = d->now; d->state = -1; d->waits = 0;
}
static long long vd_towards(long long now, long long goal, long long most) {
  if (now < goal) return now + most < goal ? now + most : goal;
  return now - most > goal ? now - most : goal;
}
static void vd_step(VDrive *d, int ms) {
  const VHabits *h = d->t->habits;
  d->now += ms;
  if (d->driven) d->output = d->shaft = vd_towards(d->output, vd_goal(d), (long long)(d->quick ? h->quick_ramp : h->ramp) * ms);
  else d->shaft = vd_towards(d->shaft, 0, (long long)h->coast_ramp * ms);
  if (d->stopping && d->output == 0) vd_let_go(d);
  vd_settle(d);
  if (h->watchdog_ms >= 0 && d->driven && d->now - d->heard_at > h->watchdog_ms) {
    if (h->watchdog == 0) { vd_trip(d, h->watchdog_code); d->cause = 0; }
    else vd_stop(d, h->watchdog == 2 ? E_COAST_STOP : E_STOP, -1);
  }
}

/* ---- requests ---- */
static void vd_written(VDrive *d, const VBefore *b) {
  unsigned char fired[64]; int stop = -1, led = -2, reset = 0, after = -1, known = 0;
  if (d->local || !d->follows) return;
  for (int i = 0; i < d->t->moves_count; i++) { const VMove *m = &d->t->moves[i];
    fired[i] = vd_fires(d, m, b);
    if (fired[i] && m->effect <= E_JOG_STOP && stop < 0) stop = m->effect;
    if (fired[i] && m->effect == E_STATE) led = m->into;
    if (fired[i] && m->effect == E_FAULT_RESET) reset = 1;
    for (int k = 0; k < b->count; k++) if (m->effect == E_STATE && b->reg[k] == m->reg && (d->words[m->reg] & m->mask) == m->value) { after = m->into; known = 1; }
  }
  if (stop >= 0 && !d->keeps_running) {
    if (d->driven) vd_stop(d, stop, after);
    else if (led == -2 && !known && !d->fault) { d->state = -1; d->waits = 0; }
  }
  if (reset) vd_reset(d);
  if (led != -2 && !d->fault && !d->driven) { d->next = led; d->next_at = d->now + d->t->habits->settle_ms; d->waits = 1; vd_settle(d); }
  if (stop < 0) vd_move(d, fired);
}
static void vd_store(VDrive *d, int address, int word, int *stored) {
  int home = vd_home(d, address);
  if (d->words[home] != word) d->changed[home] = d->now;
  d->words[home] = word;
  if (address == d->t->enter && word == d->t->enter_value) {
    for (int i = 0; i < 65536; i++) if (vd_inside(d->t->parameters, d->t->parameters_count, i)) d->stored[i] = d->words[i];
  } else if (d->t->method != S_ENTER_REGISTER && home == address && vd_parameter(d, address)) d->stored[home] = word;
  else return;
  d->stores++; *stored = 1;
}
/* why a write is refused, or -1 when it was done */
static int vd_write(VDrive *d, int first, const unsigned short *words, int count) {
  VBefore b; int parameters = d->t->habits->busy_refuses_all, stored = 0, any = 0;
  for (int i = 0; i < count; i++) if (!vd_writable(d, first + i)) return vd_readable(d, first + i) ? R_READ_ONLY : R_ADDRESS;
  for (int i = 0; i < d->t->limits_count; i++) { const VLimit *l = &d->t->limits[i];
    if (l->reg < first || l->reg >= first + count) continue;
    int word = words[l->reg - first];
    if (l->sign && word & 0x8000) word -= 0x10000;
    if (word < l->low || word > l->high) return R_VALUE; }
  for (int i = 0; i < count; i++) any |= vd_parameter(d, first + i);
  if ((any || parameters) && d->now < d->busy_until && d->t->codes[R_BUSY]) return R_BUSY;
  if (any && d->driven && d->t->codes[R_RUNNING]) return R_RUNNING;
  b.count = count;
  for (int i = 0; i < count; i++) { int home = vd_home(d, first + i); b.reg[i] = home; b.word[i] = d->words[home]; b.since[i] = d->changed[home]; }
  for (int i = 0; i < count; i++) vd_store(d, first + i, words[i], &stored);
  if (stored) d->busy_until = d->now + d->t->habits->store_ms;
  vd_written(d, &b);
  return -1;
}
/* the reply's data after unit and function; its length, or minus 1 and a reason */
static int vd_granted(VDrive *d, const unsigned char *ask, int everyone, unsigned char *data, int *reason) {
  const VTable *t = d->t; int function = ask[1], first = ask[2] << 8 | ask[3], number = ask[4] << 8 | ask[5], known = 0;
  unsigned short words[128];
  *reason = R_FUNCTION;
  if (function > 31 || !(t->functions >> function & 1)) return -1;
  if (function == 8) {
    for (int i = 0; i < t->subs_count; i++) known |= t->subs[i].number == first;
    if (!known) return -1;
    memcpy(data, ask + 2, 4); return 4;
  }
  if (function == 3 || function == 4) {
    *reason = R_QUANTITY;
    if (number < 1 || number > t->most_read) return -1;
    *reason = R_ADDRESS;
    for (int i = 0; i < number; i++) if (!vd_readable(d, first + i)) return -1;
    data[0] = 2 * number;
    for (int i = 0; i < number; i++) { int word = vd_word(d, first + i); data[1 + 2 * i] = word >> 8; data[2 + 2 * i] = word & 255; }
    return 1 + 2 * number;
  }
  if (function != 6 && function != 16) return -1;
  if (everyone && t->broadcasts_count) {
    for (int i = 0; i < t->broadcasts_count; i++) known |= t->broadcasts[i].number == first;
    *reason = R_ADDRESS;
    if (!known) return -1;
  }
  int count = function == 6 ? 1 : number;
  *reason = R_QUANTITY;
  if (function == 16 && (number < 1 || number > t->most_write || ask[6] != 2 * number)) return -1;
  for (int i = 0; i < count; i++) words[i] = function == 6 ? number : ask[7 + 2 * i] << 8 | ask[8 + 2 * i];
  *reason = vd_write(d, first, words, count);
  memcpy(data, ask + 2, 4);
  return *reason < 0 ? 4 : -1;
}
/* the reply without checksum; its length, or -1 for silence */
static int vd_reply(VDrive *d, const unsigned char *ask, int length, unsigned char *out) {
  const VTable *t = d->t; int reason, called, everyone;
  if (!d->powered || length < 2) return -1;
  called = ask[0] == d->unit; everyone = ask[0] == t->broadcast;
  int known = ask[1] < 32 && (t->functions >> ask[1] & 1);
  if (!(called || everyone)) return -1;
  if (known && (ask[1] == 16 ? length < 7 || length != 7 + ask[6] : length != 6)) return -1;
  out[0] = ask[0]; out[1] = ask[1];
  int made = vd_granted(d, ask, everyone, out + 2, &reason);
  if (!called) return -1;
  if (made >= 0) { d->heard_at = d->now; return made + 2; }
  int code = t->codes[reason];
  if (t->error_address < 0 || t->error_function < 0) { out[1] = ask[1] + t->error_add; out[2] = code; return 3; }
  d->words[t->error_address] = code;
  out[1] = t->error_function; out[2] = t->error_address >> 8; out[3] = t->error_address & 255; out[4] = code >> 8; out[5] = code & 255;
  return 6;
}
static void vd_begin(VDrive *d, const VTable *t) {
  memset(d, 0, sizeof *d);
  d->t = t; d->unit = t->unit; d->powered = d->follows = 1; d->load = 50; d->state = d->after = -1; vd_plate(d);
}
