/* Calls that are made to fail, to stop a run or to kill it, at the n-th time: of the program's own objects
 * (link-time wrapping, see Makefile) and of the whole process with its libraries (the symbols of the executable come
 * first). */
#ifndef CLEAVE_TESTS_FAULTS
#define CLEAVE_TESTS_FAULTS

enum fault_call {
    OWN_MALLOC,
    OWN_OPEN,
    OWN_READ,
    OWN_WRITE,
    OWN_FSYNC,
    OWN_CLOSE,
    OWN_RENAME,
    OWN_MKDIR,
    OWN_UNLINK,
    ALL_MALLOC,
    ALL_MMAP,
    ALL_OPEN,
    ALL_READ,
    ALL_WRITE,
    ALL_FSYNC,
    ALL_CLOSE,
    ALL_RENAME,
    ALL_MKDIR,
    ALL_UNLINK,
    AT_SAMPLE,
    AT_CONVERSION,
    AT_COUPLING,
    AT_EQUILIBRIUM, /* functions of the engine: before they do their work */
    FAULT_CALLS
};

/* DO_STOP: SIGINT, DO_KILL: SIGKILL, DO_BREAK: an invariant of the program is broken there */
enum fault_deed { DO_NOTHING, DO_FAIL, DO_STOP, DO_KILL, DO_BREAK };

struct fault_plan {
    enum fault_call call;
    enum fault_deed deed;
    long number; /* the first call is 1 */
    int cause;   /* errno of a call that fails */
    int log;     /* descriptor for lines of fsync, rename and mkdir; 0: none */
};

extern const char *const fault_name[FAULT_CALLS];

/* From now on calls are counted in count[FAULT_CALLS], which outlives the process (shared memory), and the plan
 * holds; files are no longer synced, but for the log, which is quick. */
void faults_arm(const struct fault_plan *plan, long *count);

/* Hash of a file's bytes; 0 where there is none. */
unsigned long fault_hash(const char *path);

int program_main(int argc, char **argv); /* main of the program */

#endif
