/* A temporary folder in which the tests of a program run. Pass folder_enter and folder_leave to
 * cmocka_run_group_tests. */
#ifndef CLEAVE_TESTS_FOLDER
#define CLEAVE_TESTS_FOLDER

#include <stdlib.h>
#include <unistd.h>

static char folder[] = "/tmp/cleave-test-XXXXXX";

/* Creates a temporary folder and makes it the working folder: the setup function of a group of tests. Returns 0 on
 * success. */
static inline int folder_enter(void **state)
{
    (void)state;
    return mkdtemp(folder) == NULL || chdir(folder) != 0;
}

/* Leaves the temporary folder and removes it with its scene.yaml, if any: the teardown function of a group of tests.
 * Returns 0 on success, not 0 if the tests have left other files in it. */
static inline int folder_leave(void **state)
{
    (void)state;
    unlink("scene.yaml");
    return chdir("/") || rmdir(folder);
}

#endif
