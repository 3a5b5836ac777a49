/* Room `base` (a room is a folder of include/ and src/): number types, status codes, memory, threads,
 * archives, warnings. It contains no mechanics and uses no other room; every room may call it.
 *
 * This header: number types, status codes, and the conventions of all files.
 *
 * Units: SI everywhere inside the program (m, kg, s, Pa, J); values of the input file are converted when it
 * is read.
 *
 * Components: a vector field is stored as one array per component, `real *x[DIM_MAX]`; only the first `dim`
 * arrays are allocated and used. Symmetric tensors store dim (dim + 1) / 2 components in the order
 *     1D: xx      2D: xx yy xy      3D: xx yy zz xy yz zx
 * with tensor (not engineering) shear components for strains. */
#ifndef CLEAVE_BASE
#define CLEAVE_BASE

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "arrays.h"

typedef double real;

/* Defines sizes of arrays. DIM_MAX: largest number of coordinates; SYM_MAX: largest number of components of a symmetric
 * tensor; NAME_MAX_LENGTH, LONG_NAME_LENGTH: capacity of a name and of a long name, with the terminating 0 [byte]. */
enum { DIM_MAX = 3, SYM_MAX = 6, NAME_MAX_LENGTH = 64, LONG_NAME_LENGTH = 256 };

/* Define compiler attributes of functions, ALWAYS_INLINE and NEVER_INLINE, and COUNT_OF(a), the number of elements of
 * the array a (not a pointer). */
#define ALWAYS_INLINE inline __attribute__((always_inline))
#define NEVER_INLINE __attribute__((noinline)) /* for large functions called from several places: compiled once */
#define COUNT_OF(a) (sizeof(a) / sizeof((a)[0]))

/* Composes a vector of n entries from entries of the vectors a and b, chosen by the n indices that follow: 0 .. n-1 for
 * entries of a, n .. 2n-1 for entries of b. MASK: the integer vector type of n entries. */
#ifdef __clang__
#define VECTOR_PICK(MASK, a, b, ...) __builtin_shufflevector(a, b, __VA_ARGS__)
#else
#define VECTOR_PICK(MASK, a, b, ...) __builtin_shuffle(a, b, (MASK){__VA_ARGS__})
#endif

/* Returns the number of components of a symmetric tensor in dim dimensions: 1, 3 or 6. */
static inline int symmetric_tensor_component_count(int dim) { return dim * (dim + 1) / 2; }

/* Computes *row and *column (0 .. 2) of component number `component` (from 0) of a symmetric tensor in dim dimensions.
 * Order of the components: xx, yy, zz, xy, yz, zx in 3D; xx, yy, xy in 2D; xx in 1D. */
static inline void symmetric_tensor_component_axes(int dim, int component, int *row, int *column)
{
    *row = component < dim ? component : component == dim ? 0 : component == dim + 1 ? 1 : 2;
    *column = component < dim ? component : (*row + 1) % DIM_MAX;
}

/* Returns the hash of a sequence of words: `hash` is the hash of the words before, `word` the last word. Uses one step
 * of Splitmix64 (Steele, Lea, Flood 2014). */
static inline uint64_t hash_add_word(uint64_t hash, uint64_t word)
{
    hash += (word + 1) * UINT64_C(0x9e3779b97f4a7c15);
    hash = (hash ^ hash >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    hash = (hash ^ hash >> 27) * UINT64_C(0x94d049bb133111eb);
    return hash ^ hash >> 31;
}

/* Result of a function that can fail: FAILED by the computation, a file or memory, REFUSED because the input (scene,
 * file, command line) is not valid, INTERRUPTED by a signal. The values are the exit statuses of the program. */
typedef enum { OK = 0, FAILED = 1, REFUSED = 2, INTERRUPTED = 130 } status;

/* Composes the message of a failure (one line) from `format` as printf does, stores the message for status_message, and
 * returns `s`. Called once, where the fault is found; functions above it in the call chain only return the status
 * (macro TRY). Each thread has its own message. */
status status_set(status s, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Appends a line, composed from `format` as by printf, to the message set by status_set, for a further fault of the
 * same kind. */
void status_message_append_line(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Returns the message of the last failure in this thread, "" if there was none. The text changes with the next
 * failure. */
const char *status_message(void);

/* Capacity [byte], with the terminating 0, of the text `file:line:column: key: ` at the beginning of a message about an
 * input file. The text is empty if the position in the file is unknown. */
enum { PLACE_LENGTH = 512 };

/* Prepends `location`, a position in the input file such as `file:line:column: key: `, to the message set by
 * status_set. Does nothing if s is not REFUSED, if the message has a position already, or if `location` is empty.
 * Returns s. */
status status_message_prepend_location(const char *location, status s);

/* Ends the program by invariant_report_violation_and_abort if `condition` is false. For conditions that hold in every
 * run of a correct program; unlike assert of C it is part of every build. A function whose failure an input file,
 * another file or the system can cause returns a status instead. */
#define INVARIANT(condition)                                                                                           \
    ((condition) ? (void)0 : invariant_report_violation_and_abort(#condition, __FILE__, __LINE__, __func__))

/* Ends the program because `condition`, which must always hold, does not hold in `function` of the source file `file`
 * at `line`. Prints one line on standard error with the version, the source location, the text of the condition, and
 * what to report; calls the function set by invariant_set_cleanup_callback; exits with status 1. Any thread may call
 * it; of several threads only the first one reports. Builds with sanitizers abort instead of exiting, so that fuzzers
 * can distinguish such an end from a refusal. */
_Noreturn void invariant_report_violation_and_abort(const char *condition, const char *file, int line,
                                                    const char *function);

/* Sets the function that invariant_report_violation_and_abort calls before the program ends, in the thread that has
 * found the fault. cleanup: removes half-written files; NULL: no function. */
void invariant_set_cleanup_callback(void (*cleanup)(void));

/* Replaces every control character of `text`, a text from outside (names of files and columns, input files), by `?` in
 * place, so that a terminal does not act on it. */
void text_replace_control_characters(char *text);

/* Replaces every control character among the `length` bytes of `text` by `?`, zero bytes included;
 * text_replace_control_characters does so up to the first zero byte. */
void bytes_replace_control_characters(char *text, size_t length);

/* A name for printing, without control characters, cut if it is very long: `printable_name(folder).text`, valid until
 * the end of the statement. */
struct printable_name {
    char text[512];
};

/* Returns a copy of `name` for messages, cut to at most 511 bytes, with `?` in place of control characters. */
struct printable_name printable_name(const char *name);

/* Compares the numbers *a and *b (of type double) for array_sort in ascending order. Returns -1 if *a < *b, 1 if *a >
 * *b, else 0. */
int compare_doubles(const void *a, const void *b);

/* Sorts the `count` numbers in `value`, at least one, in place, and returns their median; for even `count` the upper of
 * the two middle ones. */
double median_by_sorting(double *value, int64_t count);

/* Returns from the calling function with the status of `call` if it is not OK. */
#define TRY(call)                                                                                                      \
    do {                                                                                                               \
        status try_status_ = (call);                                                                                   \
        if (try_status_ != OK) return try_status_;                                                                     \
    } while (0)

/* Runs LOOP, a for loop of independent iterations, on all threads if MANY is true, else in the calling thread alone:
 * starting a team of threads takes 0.3 to 0.5 us (measured). */
#define TEAM_LOOP(MANY, LOOP)                                                                                          \
    do {                                                                                                               \
        if (MANY) {                                                                                                    \
            _Pragma("omp parallel for schedule(static)") LOOP                                                          \
        } else                                                                                                         \
            LOOP                                                                                                       \
    } while (0)

/* Returns the smaller of a and b. */
static inline real real_min(real a, real b) { return a < b ? a : b; }

/* Returns the larger of a and b. */
static inline real real_max(real a, real b) { return a > b ? a : b; }

/* Returns true if a and b are equal to the last bit: 0 and -0 differ. */
static inline bool reals_are_bitwise_equal(real a, real b) { return memcmp(&a, &b, sizeof a) == 0; }

/* Returns a^2. */
static inline real square(real a) { return a * a; }

/* Returns the scalar product of the vectors a and b of dim components. */
static inline real dot(const real *a, const real *b, int dim)
{
    real sum = 0;
    for (int d = 0; d < dim; d++) sum += a[d] * b[d];
    return sum;
}

/* Computes the vector product a x b of vectors with three components. `product` must be neither a nor b. */
static inline void vector_product(const real *a, const real *b, real *product)
{
    for (int d = 0; d < 3; d++) product[d] = a[(d + 1) % 3] * b[(d + 2) % 3] - a[(d + 2) % 3] * b[(d + 1) % 3];
}

/* Returns name and version of the compiler of this program. */
const char *compiler_name(void);

#endif
