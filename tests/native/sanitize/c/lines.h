/* Open requests and the bodies of replies that belong to them; the tables follow. */
typedef struct {
    MB_REQUEST asked;
    unsigned first, count; /* its replies among the bodies */
} Line;

typedef struct {
    unsigned at, length; /* in the bytes of all bodies */
} Body;
