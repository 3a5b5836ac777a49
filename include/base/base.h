/* Room `base`: numbers, status, memory, threads, archives, warnings. It knows nothing of solids, and everybody may call
 * it.
 *
 * Number types, status, and the conventions every file shares.
 *
 * Units: SI everywhere inside the program (m, kg, s, Pa, J); units of the scene are converted when it is read.
 * Components: arrays of components are `real *x[DIM_MAX]`; only the first `dim` are allocated and used.
 * Symmetric tensors keep dim (dim + 1) / 2 components in the order
 *     1D: xx      2D: xx yy xy      3D: xx yy zz xy yz zx
 * with tensor (not engineering) shear where a strain is meant. */
#ifndef CLEAVE_BASE
#define CLEAVE_BASE

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "arrays.h"

typedef double real;

enum { DIM_MAX = 3, SYM_MAX = 6, NAME_MAX_LENGTH = 64 };

#define ALWAYS_INLINE inline __attribute__((always_inline))
#define NEVER_INLINE __attribute__((noinline)) /* large and called from several places: compiled once */
#define COUNT_OF(a) (sizeof(a) / sizeof((a)[0]))

/* Shuffle of the entries of vectors a and b of n entries; indices from n on refer to b. MASK: the integer vector type
 * of n entries. */
#ifdef __clang__
#define VECTOR_PICK(MASK, a, b, ...) __builtin_shufflevector(a, b, __VA_ARGS__)
#else
#define VECTOR_PICK(MASK, a, b, ...) __builtin_shuffle(a, b, (MASK){__VA_ARGS__})
#endif

static inline int symmetric_count(int dim) { return dim * (dim + 1) / 2; }
/* Row and column of symmetric component s. */
static inline void symmetric_axes(int dim, int s, int *row, int *column)
{
    *row = s < dim ? s : s == dim ? 0 : s == dim + 1 ? 1 : 2;
    *column = s < dim ? s : (*row + 1) % DIM_MAX;
}

/* What a function that can fail returns; the values are the exit statuses of the program. */
typedef enum { OK = 0, FAILED = 1, REFUSED = 2, INTERRUPTED = 130 } status;

/* Composes the one line that a person will read, keeps it for `status_message`, and returns `s`.
 * Called once, where the fault is seen; callers above only TRY(). The message is the program's one
 * hidden variable, as errno is the C library's. */
status status_set(status s, const char *format, ...) __attribute__((format(printf, 2, 3)));
const char *status_message(void);
/* Where a scene asks for something, as a message begins: `file:line:column: key: `. "": unknown. */
enum { PLACE_LENGTH = 512 };
/* Puts `place` in front of the message of a refusal that has none yet; returns `s`. */
status status_at(const char *place, status s);

/* Ends the program by invariant_broken if `condition` is false. For what holds in every run of a program without
 * faults; unlike assert of C it is in every build. What a scene, a file or the system can cause is a status instead. */
#define INVARIANT(condition) ((condition) ? (void)0 : invariant_broken(#condition, __FILE__, __LINE__, __func__))

/* Ends the program: prints one line on standard error with the version, the source location and the text of the
 * condition, and what to report; calls the function that invariant_clean_up has set; exit status 1. Any thread may call
 * it; of several threads the first one reports. Builds under sanitizers abort instead of exiting: fuzzers tell
 * such an end from a refusal. */
_Noreturn void invariant_broken(const char *condition, const char *file, int line, const char *function);

/* Sets the function that invariant_broken calls before the program ends, in the thread that has found the fault: it
 * removes half-written files. NULL: none is called. */
void invariant_clean_up(void (*remove)(void));

/* Makes text from outside (names of files, columns, scenes) harmless to a terminal: `?` in place of every control
 * character. */
void text_harmless(char *text);
/* The same for `length` bytes, which may have zeros among them. */
void bytes_harmless(char *text, size_t length);
/* A name to print, harmless, and cut if it is very long: `shown_name(folder).text`, good until the end of the
 * statement. */
struct shown_name {
    char text[512];
};
struct shown_name shown_name(const char *name);

/* Sorts n > 0 numbers; the middle one, of an even number the upper. */
double median_of(double *value, int64_t n);

/* Hands a fault to the caller as it came. */
#define TRY(call)                                                                                                      \
    do {                                                                                                               \
        status try_status_ = (call);                                                                                   \
        if (try_status_ != OK) return try_status_;                                                                     \
    } while (0)

/* A loop of independent rounds by the team, or by the calling thread alone where they are so few that calling a
 * team, even of one, takes longer (0.3 to 0.5 us). */
#define TEAM_LOOP(MANY, LOOP)                                                                                          \
    do {                                                                                                               \
        if (MANY) {                                                                                                    \
            _Pragma("omp parallel for schedule(static)") LOOP                                                          \
        } else                                                                                                         \
            LOOP                                                                                                       \
    } while (0)

static inline real real_min(real a, real b) { return a < b ? a : b; }
static inline real real_max(real a, real b) { return a > b ? a : b; }
/* To the last bit: 0 and -0 differ. */
static inline bool bits_equal(real a, real b) { return memcmp(&a, &b, sizeof a) == 0; }
static inline real square(real a) { return a * a; }
static inline real dot(const real *a, const real *b, int dim)
{
    real sum = 0;
    for (int d = 0; d < dim; d++) sum += a[d] * b[d];
    return sum;
}
/* to = a x b, of three components each; `to` is neither of them. */
static inline void vector_product(const real *a, const real *b, real *to)
{
    for (int d = 0; d < 3; d++) to[d] = a[(d + 1) % 3] * b[(d + 2) % 3] - a[(d + 2) % 3] * b[(d + 1) % 3];
}

#endif
