/* Every address with every quantity from 0 to 130 and with 65535, against the longest run of permitted registers that
 * starts at each address: `permission NAME RUNS`. No register at all is not permitted either. */
typedef BOOL Permission(BOOL, BOOL *, WORD, UINT);
typedef struct {
    const char *name;
    Permission *asks;
} Permitting;

static int permissions(const Permitting *one, const char *path)
{
    static uint32_t runs[65536];
    uint64_t cases = 0, wrong = 0;
    from = fopen(path, "rb");
    TAKE(runs);
    for (uint32_t address = 0; address < 65536; address++)
        for (uint32_t step = 0; step <= 131; step++, cases++) {
            uint32_t quantity = step > 130 ? 65535 : step;
            int wanted = quantity >= 1 && quantity <= runs[address], found = one->asks(1, NULL, address, quantity);
            if (found != wanted && wrong++ < 5)
                printf("difference %s of %u from %04XH: %d, not %d\n", one->name, quantity, address, found, wanted);
        }
    printf("cases %" PRIu64 "\nwrong %" PRIu64 "\n", cases, wrong);
    return wrong != 0;
}
