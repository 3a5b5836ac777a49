/* The commit of the source tree, for `cleave --version`, summaries and pages. Only the program's main file contains it,
 * so that a new commit does not relink the tests. */
#ifndef CLEAVE_PROGRAM_COMMIT
#define CLEAVE_PROGRAM_COMMIT

/* Sets the commit of the source tree, which program_commit returns. commit_id: commit hash, kept by reference. */
void program_commit_set(const char *commit_id);

/* Returns the commit of the source tree, "" if it is unknown. */
const char *program_commit(void);

#endif
