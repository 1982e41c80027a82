/* The tables of a simulated drive; tables.py writes them. Spans, limits and patterns as in Python. */
typedef struct { int first, last; } VSpan;
typedef struct { int reg, low, high, sign; } VLimit;
typedef struct { int reg, mask, value; } VPattern;
typedef struct { int reg, mask, value, before, for_ms; } VNeed;
typedef struct { int effect, reg, mask, value, guard, into, exact, first_need, need_count; } VMove;
typedef struct { int reg, bits; } VNamed;
typedef struct { int key, state, words[4]; } VFace; /* words of `named`, in its order */
typedef struct { int reg, shows, milli, sign; } VGauge;
typedef struct { int number; } VNumber;
#define LIST(type, name) const type *name; int name##_count
typedef struct {
  LIST(VSpan, readable); LIST(VSpan, writable); LIST(VSpan, parameters); LIST(VLimit, limits); LIST(VMove, moves);
  LIST(VNeed, needs); LIST(VNamed, named); LIST(VFace, faces); LIST(VGauge, gauges); LIST(VPattern, verify);
  LIST(VNumber, subs); LIST(VNumber, broadcasts); LIST(VNamed, plate);
  const VHabits *habits; unsigned functions; int codes[7];
  int most_read, most_write, broadcast, error_function, error_address, error_add, reference, times, per, reference_signed,
    reverses, method, add, enter, enter_value, present, fault_first, fault_last, unit;
} VTable;
