/* Makes the n-th call of a kind fail, or stops or kills the run at it: calls of the program's own objects (link-time
 * wrapping, see Makefile) and of the whole process with its libraries (symbols of the executable take precedence). */
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

/* Action at the call. DO_STOP: SIGINT; DO_KILL: SIGKILL; DO_BREAK: an internal invariant fails. */
enum fault_deed { DO_NOTHING, DO_FAIL, DO_STOP, DO_KILL, DO_BREAK };

/* Which call of a system or engine function by the tested run is disturbed, and how. */
struct fault_plan {
    enum fault_call call;
    enum fault_deed deed;
    long number; /* index of the call, from 1 */
    int cause;   /* errno of a failing call */
    int log;     /* descriptor for lines about fsync, rename and mkdir; 0: none */
};

extern const char *const fault_name[FAULT_CALLS];

/* Starts to count the calls of each kind (enum fault_call) in count[FAULT_CALLS], shared memory that outlives the
 * process, and to disturb the call that the plan names. To save time, files are no longer synced from then on, except
 * the log. */
void faults_arm(const struct fault_plan *plan, long *count);

/* Returns a hash of the bytes of the file `path`; 0 if there is no such file. */
unsigned long fault_hash(const char *path);

int program_main(int argc, char **argv); /* main of the program */

#endif
