/* Records through blocks: `scan NAME IN OUT`. A record is the pins that a scan is given, an answer those that it gives,
 * both in the machine's own form without gaps. The functions that make the scans follow this text; each is one
 * instance that lives through all records, as in a PLC. */
typedef struct {
    const char *name;
    void (*scan)(void);
} Scanning;

static FILE *from, *to;

static void take(void *place, size_t size)
{
    if (fread(place, 1, size, from) != size) {
        fprintf(stderr, "a record is cut short\n");
        exit(2);
    }
}

static void give(const void *place, size_t size)
{
    if (fwrite(place, 1, size, to) != size) {
        fprintf(stderr, "cannot write an answer\n");
        exit(2);
    }
}

static int more(void)
{
    int next = getc(from);
    return next != EOF && ungetc(next, from) != EOF;
}

#define TAKE(place) take(&(place), sizeof(place))
#define GIVE(place) give(&(place), sizeof(place))
