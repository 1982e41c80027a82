/* The library as iec2c translated it, and what its C needs around it. A driver includes nothing else of it.
 *
 * An instance is zeroed memory (`static MB_CRC16 crc;`), initialised once: START(MB_CRC16, crc). A scan is
 * MB_CRC16_body__(&crc). Pins are `crc.LENGTH.value`; an in-out is held by value: `crc.ADU.value.table[0]`, and a
 * structure's field `reply.REQUEST.value.QUANTITY`. A function is JSCC_CANREAD(1, NULL, address, quantity). */
#include <inttypes.h>
#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "iec_std_lib.h"
#include "accessor.h"
#include "POUS.h"

TIME __CURRENT_TIME;
BOOL __DEBUG;

#include "driveblocks_pous.c"

#define START(TYPE, instance) (memset(&(instance), 0, sizeof(instance)), TYPE##_init__(&(instance), 0))
