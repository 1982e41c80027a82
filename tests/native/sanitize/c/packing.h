/* Characters to registers and back: the tables of a PLC's serial instructions, and that both ways undo each other. */
static UINT pack_count(unsigned most)
{
    static const uint16_t NEAR_ENDS[] = {0, 1, 2, 254, 255, 256, 257, 511, 512, 513, 514, 1024, 65534, 65535};
    return one_in(4) ? NEAR_ENDS[below(COUNT(NEAR_ENDS))] : (UINT)below(one_in(4) ? most + 1 : 32);
}

/* Character `at` of registers that hold one or two each. */
static unsigned packed(const WORD *registers, unsigned at, unsigned each)
{
    return each == 1 ? registers[at] & 0xFFu : (at % 2 ? registers[at / 2] & 0xFFu : (unsigned)registers[at / 2] >> 8);
}

#define PACK(BOX, MOST, BITS, EACH)                                                                                    \
    static void MB_PACK##BOX##BITS##_fill(MB_PACK##BOX##BITS *x)                                                       \
    {                                                                                                                  \
        x->CHARCOUNT.value = pack_count(MOST);                                                                         \
        noise(x->BOX.value.table, x->CHARCOUNT.value < MOST ? x->CHARCOUNT.value : MOST);                              \
        noise(x->REGISTERS.value.table, 16);                                                                           \
    }                                                                                                                  \
    static const char *MB_PACK##BOX##BITS##_right(const MB_PACK##BOX##BITS *x, const MB_PACK##BOX##BITS *was)          \
    {                                                                                                                  \
        unsigned count = was->CHARCOUNT.value < MOST ? was->CHARCOUNT.value : MOST, used = (count + EACH - 1) / EACH;  \
        if (x->REGISTERCOUNT.value != used)                                                                            \
            return "the number of registers is wrong";                                                                 \
        for (unsigned at = 0; at < count; at++)                                                                        \
            if (packed(x->REGISTERS.value.table, at, EACH) != was->BOX.value.table[at])                                \
                return "a register is wrong";                                                                          \
        if (EACH == 2 && count % 2 && (x->REGISTERS.value.table[used - 1] & 0xFF))                                     \
            return "the low byte of the last register is not empty";                                                   \
        return memcmp(x->REGISTERS.value.table + used, was->REGISTERS.value.table + used, 2 * (513 - used))            \
                   ? "registers after are changed"                                                                    \
                   : NULL;                                                                                             \
    }                                                                                                                  \
    static void MB_UNPACK##BOX##BITS##_fill(MB_UNPACK##BOX##BITS *x)                                                   \
    {                                                                                                                  \
        x->CHARCOUNT.value = pack_count(MOST);                                                                         \
        unsigned count = x->CHARCOUNT.value < MOST ? x->CHARCOUNT.value : MOST;                                        \
        noise(x->REGISTERS.value.table, 2 * ((count + EACH - 1) / EACH));                                              \
        noise(x->BOX.value.table, 16);                                                                                 \
    }                                                                                                                  \
    static const char *MB_UNPACK##BOX##BITS##_right(const MB_UNPACK##BOX##BITS *x, const MB_UNPACK##BOX##BITS *was)    \
    {                                                                                                                  \
        static MB_PACK##BOX##BITS back;                                                                                \
        unsigned count = was->CHARCOUNT.value < MOST ? was->CHARCOUNT.value : MOST;                                    \
        if (x->UNPACKED.value != count)                                                                                \
            return "the number of characters is wrong";                                                                \
        for (unsigned at = 0; at < count; at++)                                                                        \
            if (x->BOX.value.table[at] != packed(was->REGISTERS.value.table, at, EACH))                                \
                return "a character is wrong";                                                                         \
        if (memcmp(x->BOX.value.table + count, was->BOX.value.table + count, MOST - count))                            \
            return "characters after are changed";                                                                    \
        if (!one_in(16))                                                                                               \
            return NULL;                                                                                               \
        START(MB_PACK##BOX##BITS, back);                                                                               \
        memcpy(back.BOX.value.table, x->BOX.value.table, MOST);                                                        \
        back.CHARCOUNT.value = x->UNPACKED.value;                                                                      \
        MB_PACK##BOX##BITS##_body__(&back);                                                                            \
        for (unsigned at = 0; at < count; at++)                                                                        \
            if (packed(back.REGISTERS.value.table, at, EACH) != packed(was->REGISTERS.value.table, at, EACH))          \
                return "it does not pack to the same registers";                                                       \
        return NULL;                                                                                                   \
    }
PACK(ADU, 256, 8, 1)
PACK(ADU, 256, 16, 2)
PACK(CHARS, 513, 8, 1)
PACK(CHARS, 513, 16, 2)
