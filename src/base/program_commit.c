/* Stores the commit of the source tree from which the program was built. */
#include "base/program_commit.h"

/* Commit of the source text from which the program was built; "": unknown. */
static const char *commit = "";

void program_commit_set(const char *commit_id) { commit = commit_id; }
const char *program_commit(void) { return commit; }
