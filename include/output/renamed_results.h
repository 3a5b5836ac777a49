/* Names of columns of history.csv and of results of summary.json that have changed; old names work for one version. */
#ifndef CLEAVE_RENAMED_RESULTS
#define CLEAVE_RENAMED_RESULTS

/* Returns the present name of the column of history.csv or value of summary.json that an earlier version called
 * `former_name`, or NULL if `former_name` is no earlier name. Results within an object have dotted names:
 * conversion.returned. */
const char *renamed_result_find_current_name(const char *former_name);

/* Returns the other of the two names of a renamed column of history.csv or result of summary.json: the present name of
 * an earlier one, the earlier name of a present one; NULL if `name` is neither. Files of either version can thus be
 * read by both names. */
const char *renamed_result_swap_former_and_current_name(const char *name);

#endif
