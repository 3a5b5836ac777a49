/* Fuzzer: changes inputs at random, also by inserting words of a dictionary; inputs that reach new branches are kept
 * and changed further. The sources under test are compiled with sanitizers and call __sanitizer_cov_trace_pc() in each
 * branch (Makefile).
 *
 *     fuzz TARGET SECONDS SEED DICTIONARY FILE...
 *
 * With 0 seconds each file is used once, unchanged. The current input is in the file TARGET.input, also after the
 * process has ended. */
#include "fuzz.h"

#include <fcntl.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

#include "output/output.h"
#include "base/team.h"

enum { POOL = 20000, WORDS = 5000, INPUT_MOST = 1 << 18, BRANCHES = 1 << 18, PATIENCE = 20 };

struct input {
    uint8_t *bytes;
    size_t n;
};

static const struct {
    const char *name;
    void (*run)(const uint8_t *, size_t);
    size_t most;
} targets[] = {
    {"scene", fuzz_scene, 6000}, {"override", fuzz_override, 400},
    {"list", fuzz_list, 3000},   {"checkpoint", fuzz_checkpoint, INPUT_MOST},
    {"valid", fuzz_valid, 120},  {"exodus", fuzz_exodus, 8000},
};

static struct input pool[POOL];
static int pooled;
static char *word[WORDS];
static int words;
static unsigned char branch[BRANCHES]; /* branches reached so far */
static int branches;
static bool running, found; /* inside a target; a new branch was reached */
static uint64_t state;

void __sanitizer_cov_trace_pc(void);
void __sanitizer_cov_trace_pc(void)
{
    static uintptr_t last;
    const uintptr_t at = (uintptr_t)__builtin_return_address(0),
                    edge = (at ^ last << 1) * UINT64_C(0x9E3779B97F4A7C15) >> 46;
    last = at;
    if (running && !branch[edge]) branch[edge] = 1, found = true, branches++;
}

void fuzz_fail(const char *why, const char *what)
{
    fprintf(stderr, "fuzz: %s: %s\n", why, what);
    abort();
}

static void leave(void)
{
    if (running) fuzz_fail("the program ends in the midst of a target", "");
}

/* Returns a pseudo-random number below `below`: xorshift (Marsaglia 2003) with multiplication. */
static uint64_t draw(uint64_t below)
{
    state ^= state >> 12, state ^= state << 25, state ^= state >> 27;
    return below ? (state * UINT64_C(0x2545F4914F6CDD1D) >> 32) % below : 0;
}

/* ---- inputs ------------------------------------------------------------------------------------------------------ */

/* Adds a copy of the input bytes[n] to the pool of inputs. It replaces a random one if the pool is full. */
static void pool_add(const uint8_t *bytes, size_t n)
{
    const int at = pooled < POOL ? pooled++ : (int)draw(POOL);
    free(pool[at].bytes);
    pool[at].bytes = malloc(n + 1), pool[at].n = n;
    if (!pool[at].bytes) fuzz_fail("no memory", "");
    memcpy(pool[at].bytes, bytes, n);
}

static void pool_file(const char *path)
{
    static uint8_t bytes[INPUT_MOST];
    FILE *f = fopen(path, "rb");
    if (!f) fuzz_fail("cannot read", path);
    pool_add(bytes, fread(bytes, 1, sizeof bytes, f));
    fclose(f);
}

static void read_words(const char *path)
{
    char line[128];
    FILE *f = fopen(path, "r");
    while (f && words < WORDS && fgets(line, sizeof line, f)) {
        line[strcspn(line, "\n")] = '\0';
        if (line[0]) word[words++] = strdup(line);
    }
    if (f) fclose(f);
}

/* ---- changes ----------------------------------------------------------------------------------------------------- */

/* Inserts a gap of `gap` bytes at the index `at` of bytes[*n], or removes -gap bytes if gap is negative, and updates
 * *n. Returns false and changes nothing if the result would exceed `most` bytes or there are too few to remove. */
static bool shift(uint8_t *bytes, size_t *n, size_t at, long gap, size_t most)
{
    if (gap > 0 && *n + (size_t)gap > most) return false;
    if (gap < 0 && at + (size_t)-gap > *n) return false;
    const size_t from = gap < 0 ? at + (size_t)-gap : at;
    memmove(bytes + from + (gap < 0 ? gap : gap), bytes + from, *n - from);
    *n = (size_t)((long)*n + gap);
    return true;
}

static void put(uint8_t *bytes, size_t *n, size_t at, const void *piece, size_t length, bool insert, size_t most)
{
    if (insert && !shift(bytes, n, at, (long)length, most)) return;
    if (at + length > *n) length = *n - at;
    memmove(bytes + at, piece, length);
}

/* Overwrites a part of bytes[n] near the index `at` by a random one of the numbers at the limits of integers and
 * reals. */
static void put_number(uint8_t *bytes, size_t n, size_t at)
{
    static const int64_t number[] = {
        0, -1, 1, INT32_MAX, INT32_MIN, INT64_MAX, INT64_MIN, 0x7ff0000000000000, 0x7ff8000000000000, 1 << 20};
    const size_t size = (size_t)1 << draw(4), place = at / size * size;
    if (place + size <= n) memcpy(bytes + place, &number[draw(sizeof number / sizeof *number)], size);
}

static void change(uint8_t *bytes, size_t *n, size_t most)
{
    const size_t at = (size_t)draw(*n + 1);
    const struct input *other = &pool[draw((uint64_t)pooled)];
    switch (draw(9)) {
    case 0:
        if (at < *n) bytes[at] ^= (uint8_t)(1u << draw(8));
        break;
    case 1:
        if (at < *n) bytes[at] = (uint8_t)draw(256);
        break;
    case 2:
        shift(bytes, n, at, -1 - (long)draw(40), most);
        break;
    case 3:
    case 4:
        if (words > 0) {
            const char *w = word[draw((uint64_t)words)];
            put(bytes, n, at, w, strlen(w), draw(2), most);
        }
        break;
    case 5:
        put_number(bytes, *n, at);
        break;
    case 6: {
        uint8_t piece[64];
        const size_t length = 1 + (size_t)draw(sizeof piece), from = (size_t)draw(*n);
        if (from + length > *n) break;
        memcpy(piece, bytes + from, length);
        put(bytes, n, at, piece, length, draw(2), most);
        break;
    }
    default: {
        const size_t from = (size_t)draw(other->n), length = (size_t)draw(other->n - from + 1) % 200;
        put(bytes, n, at, other->bytes + from, length, draw(2), most);
    }
    }
}

/* ---- the loop ---------------------------------------------------------------------------------------------------- */

/* Creates the file TARGET.input of INPUT_MOST bytes for `target` and returns it mapped in memory, so that it is
 * complete after a crash. */
static uint8_t *make_room(const char *target)
{
    char path[64];
    snprintf(path, sizeof path, "%s.input", target);
    const int fd = open(path, O_RDWR | O_CREAT | O_TRUNC, 0666);
    uint8_t *room = fd < 0 || ftruncate(fd, INPUT_MOST) != 0
                        ? MAP_FAILED
                        : mmap(NULL, INPUT_MOST, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
    if (room == MAP_FAILED) fuzz_fail("cannot write", path);
    return room;
}

static void run_one(int target, const uint8_t *bytes, size_t n)
{
    uint8_t *copy = malloc(n + 1); /* of this exact size, so that reads beyond its end are detected */
    if (!copy) fuzz_fail("no memory", "");
    memcpy(copy, bytes, n);
    alarm(PATIENCE);
    running = true, found = false;
    targets[target].run(copy, n);
    running = false;
    free(copy);
}

int main(int argc, char **argv)
{
    int target = -1;
    for (int k = 0; k < (int)(sizeof targets / sizeof *targets); k++)
        if (argc > 4 && strcmp(argv[1], targets[k].name) == 0) target = k;
    if (target < 0) return fputs("usage: fuzz TARGET SECONDS SEED DICTIONARY FILE...\n", stderr), 2;
    const size_t most = targets[target].most;
    const time_t end = time(NULL) + atol(argv[2]);
    state = strtoull(argv[3], NULL, 10) * 2 + 1;
    output_install_signal_handling_for_file_writes();
    threads_set_count_and_bind_to_cores(1);
    atexit(leave);
    read_words(argv[4]);
    for (int k = 5; k < argc; k++) pool_file(argv[k]);
    if (strcmp(argv[1], "checkpoint") == 0) {
        size_t n = 0;
        uint8_t *seed = fuzz_checkpoint_seed(&n);
        if (!seed || n > most) fuzz_fail("no checkpoint to begin with", "");
        pool_add(seed, n);
        free(seed);
    }
    for (int number = 0; strcmp(argv[1], "exodus") == 0; number++) {
        size_t n = 0;
        uint8_t *seed = fuzz_exodus_seed(number, &n);
        if (!seed) break;
        pool_add(seed, n);
        free(seed);
    }
    if (pooled == 0) pool_add((const uint8_t *)"0", 1);
    uint8_t *room = make_room(argv[1]);
    for (int k = 0; k < pooled; k++) {
        memcpy(room, pool[k].bytes, pool[k].n);
        run_one(target, room, pool[k].n);
    }
    long runs = pooled;
    for (; time(NULL) < end; runs++) {
        const struct input *from =
            &pool[draw(2) ? (uint64_t)pooled - 1 - draw((uint64_t)(pooled + 3) / 4) : draw((uint64_t)pooled)];
        size_t n = from->n < most ? from->n : most;
        memcpy(room, from->bytes, n);
        for (uint64_t changes = 1 + draw(2) * draw(6); changes > 0; changes--) change(room, &n, most);
        memset(room + n, 0, n + 256 < INPUT_MOST ? 256 : INPUT_MOST - n);
        run_one(target, room, n);
        if (found) pool_add(room, n);
    }
    printf("%s, seed %s: %ld runs, %d branches, %d inputs kept\n", argv[1], argv[3], runs, branches, pooled);
    return 0;
}
