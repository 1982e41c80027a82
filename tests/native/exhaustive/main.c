/* `checksums SEED`, or a command of another part; the tables of scans and families stand before this text. */
static uint32_t pattern(const char *text)
{
    return strtoul(text, NULL, 16);
}

static int by_family(const Family *family, char **argument)
{
    if (strcmp(argument[1], "standstill") == 0)
        return family->standstill(argument[3], atoi(argument[4]));
    if (strcmp(argument[1], "patterns") == 0) {
        from = fopen(argument[3], "rb");
        to = fopen(argument[4], "wb");
        return family->patterns() | fclose(to);
    }
    uint32_t bits[PINS];
    for (int pin = 0; pin < PINS; pin++)
        bits[pin] = pattern(argument[4 + pin]);
    char **range = argument + 4 + PINS;
    return family->sweep(atoi(argument[3]), bits, pattern(range[0]), pattern(range[1]), pattern(range[2]));
}

int main(int count, char **argument)
{
    if (count == 3 && strcmp(argument[1], "checksums") == 0)
        return checksums(atoi(argument[2]));
    for (const Family *family = FAMILIES; count > 3 && family->name != NULL; family++)
        if (strcmp(family->name, argument[2]) == 0 && count == (strcmp(argument[1], "sweep") == 0 ? 7 + PINS : 5))
            return by_family(family, argument);
    for (const Permitting *one = PERMITTING; count == 4 && one->name != NULL; one++)
        if (strcmp(one->name, argument[2]) == 0 && strcmp(argument[1], "permission") == 0)
            return permissions(one, argument[3]);
    for (const Scanning *one = SCANNING; count == 5 && one->name != NULL; one++)
        if (strcmp(one->name, argument[2]) == 0 && strcmp(argument[1], "scan") == 0) {
            from = fopen(argument[3], "rb");
            to = fopen(argument[4], "wb");
            one->scan();
            return fclose(to) != 0;
        }
    fprintf(stderr, "unknown command\n");
    return 2;
}
