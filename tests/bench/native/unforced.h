/* Writes to variables without the test whether a debugger holds them: for a runtime that forces nothing. */
#include "iec_std_lib.h"
#include "accessor.h"
#undef __SET_VAR
#define __SET_VAR(owner, name, place, change) owner name.value place = change
