/* Plays a script to the drives of vdrives.h: an event per line, with the number of a drive; prints what each leads to. */
#include <stdio.h>
#include "vdrives.h"
#include "vdrive.c"
#define COUNT (sizeof DRIVES / sizeof *DRIVES)
static VDrive drive[COUNT];

int main(void) {
  char what[32], hex[600]; int number, a, b; unsigned char ask[300], out[300];
  for (unsigned i = 0; i < COUNT; i++) vd_begin(&drive[i], DRIVES[i]);
  while (scanf("%31s %d %d %d %599s", what, &number, &a, &b, hex) == 5) {
    VDrive *d = &drive[number];
    if (!strcmp(what, "ask")) {
      int length = 0, made;
      for (char *at = hex; at[0] && at[1] && at[0] != '-'; at += 2) { unsigned byte; sscanf(at, "%2x", &byte); ask[length++] = byte; }
      made = vd_reply(d, ask, length, out);
      for (int i = 0; i < made; i++) printf("%02x", out[i]);
    }
    else if (!strcmp(what, "step")) vd_step(d, a);
    else if (!strcmp(what, "trip")) vd_trip(d, a);
    else if (!strcmp(what, "clear_cause")) vd_clear_cause(d);
    else if (!strcmp(what, "reset")) vd_reset(d);
    else if (!strcmp(what, "power")) vd_power(d, a);
    else if (!strcmp(what, "keypad_run")) vd_keypad_run(d, a >= 0, 1000 * a, b);
    else if (!strcmp(what, "keypad_stop")) vd_keypad_stop(d);
    else if (!strcmp(what, "inhibit")) vd_inhibit(d, a);
    else if (!strcmp(what, "set")) vd_set(d, a, b);
    else if (!strcmp(what, "local")) d->local = a;
    else if (!strcmp(what, "follows")) d->follows = a;
    else if (!strcmp(what, "keeps_running")) d->keeps_running = a;
    else if (!strcmp(what, "warning")) d->warning = a;
    else if (!strcmp(what, "load")) d->load = a;
    else return 1;
    printf(" %lld %lld %d %d %ld\n", d->output, d->shaft, d->fault, d->state, d->stores);
  }
  return 0;
}
