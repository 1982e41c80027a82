/* libFuzzer's way in, where it is linked, and without it a main function that reads inputs as lines of hexadecimal. */
typedef struct {
    const char *name;
    unsigned (*run)(Bytes *bytes);
} Target;
static const Target *chosen;

static void choose(const char *name)
{
    for (unsigned at = 0; at < COUNT(TARGETS); at++)
        if (name && !strcmp(TARGETS[at].name, name))
            chosen = TARGETS + at;
    if (!chosen) {
        fprintf(stderr, "no such target\n");
        exit(2);
    }
}

static unsigned run_bytes(const uint8_t *data, size_t size)
{
    Bytes bytes = {data, size};
    return chosen->run(&bytes);
}

#ifdef LIBFUZZER
int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    (void)argc, (void)argv;
    choose(getenv("DRIVEBLOCKS_TARGET"));
    return 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    run_bytes(data, size);
    return 0;
}
#else
/* TARGET; a line of the ErrorID for each line of hexadecimal digits, in memory of exactly its size. */
int main(int argc, char **argv)
{
    static char line[4096];
    choose(argc == 2 ? argv[1] : NULL);
    while (fgets(line, sizeof line, stdin)) {
        size_t size = strspn(line, "0123456789abcdef") / 2;
        uint8_t *data = malloc(size + 1);
        for (size_t at = 0; at < size; at++)
            sscanf(line + 2 * at, "%2hhx", data + at);
        uint8_t *exact = malloc(size);
        memcpy(exact, data, size);
        printf("%u\n", run_bytes(exact, size));
        fflush(stdout);
        free(exact);
        free(data);
    }
    return 0;
}
#endif
