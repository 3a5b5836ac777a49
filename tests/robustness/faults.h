/* Makes the n-th call of one kind fail, or stops or kills the process at this call. OWN_*: calls of the program's own
 * objects (link-time wrapping, see Makefile); ALL_*: calls of the whole process with its libraries, since symbols of
 * the executable take precedence; AT_*: calls of functions of the engine. */
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
    AT_EQUILIBRIUM, /* AT_*: functions of the engine, before they do their work */
    FAULT_CALLS
};

/* What happens at the call. DO_FAIL: it fails; DO_STOP: the process receives SIGINT; DO_KILL: SIGKILL; DO_BREAK: an
 * invariant is violated. */
enum fault_deed { DO_NOTHING, DO_FAIL, DO_STOP, DO_KILL, DO_BREAK };

/* The one call that is disturbed, and how. */
struct fault_plan {
    enum fault_call call;
    enum fault_deed deed;
    long number; /* index of the call, from 1 */
    int cause;   /* errno of a failing call */
    int log;     /* descriptor for lines about fsync, rename and mkdir; 0: none */
};

extern const char *const fault_name[FAULT_CALLS];

/* Starts to count calls and to disturb the call of the plan, which is copied. count[FAULT_CALLS]: number of calls of
 * each kind (enum fault_call), in shared memory that outlives the process. From then on fsync has no effect on files
 * other than the log, to save time. */
void faults_arm(const struct fault_plan *plan, long *count);

/* Returns a hash of the bytes of the file `path`; 0 if there is no such file. */
unsigned long fault_hash(const char *path);

int program_main(int argc, char **argv); /* main of the program */

#endif
