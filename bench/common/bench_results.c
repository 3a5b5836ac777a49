/* `cleave bench NAME --readme`: writes what a bench prints to bench/results/NAME.txt and its tables to
 * bench/results/TABLE.csv. Lines that begin with # tell command, date, commit, processor and compiler. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "bench.h"
#include "base/memory_stream.h"
#include "output/output_files.h"
#include "simd/simd.h"

#define RESULTS "bench/results"

/* Largest number of lines of a table that is stored in bench/results. */
enum { LINES_MAX = 250 };

/* ---- head -------------------------------------------------------------------------------------------------------- */

/* Stores the commit of the working folder, according to git, in name[size], followed by `-dirty` if files differ from
 * the commit; "unknown" if git is not available. */
static void commit_name(char *name, size_t size)
{
    FILE *git = popen("git describe --always --dirty --abbrev=10 --exclude='*' 2>/dev/null", "r");
    if (!git || !fgets(name, (int)size, git)) snprintf(name, size, "unknown");
    if (git) pclose(git);
    name[strcspn(name, "\n")] = '\0';
}

/* Composes head[size], the lines that precede the results of the bench `name`: command, date, commit, processor,
 * compiler and kernels. quick: true if the bench runs with --quick. */
static void results_head(char *head, size_t size, const char *name, bool quick)
{
    const struct machine m = machine_properties();
    const time_t now = time(NULL);
    char date[16], commit[64];
    int model = (int)strlen(m.model);
    while (model > 0 && m.model[model - 1] == ' ') model--;
    strftime(date, sizeof date, "%Y-%m-%d", localtime(&now));
    commit_name(commit, sizeof commit);
    snprintf(head, size,
             "# command: cleave bench %s%s\n# date: %s\n# commit: %s\n# processor: %.*s, %d cores\n"
             "# compiler: %s; kernels %s\n",
             name, quick ? " --quick" : "", date, commit, model, m.model, m.cores, compiler_name(),
             simd_current_kernels()->name);
}

/* ---- files ------------------------------------------------------------------------------------------------------- */

/* Returns all bytes of an open file from its start as a text. Returns NULL if the file cannot be read. Release it with
 * free. */
static char *text_of(FILE *from)
{
    if (fseek(from, 0, SEEK_END) != 0) return NULL;
    const long length = ftell(from);
    char *text = length < 0 ? NULL : malloc((size_t)length + 1);
    rewind(from);
    if (!text) return NULL;
    text[fread(text, 1, (size_t)length, from)] = '\0';
    return text;
}

/* Writes `head` and `text` as the file bench/results/FILE. It is written under a temporary name and then renamed, so
 * that it is never incomplete. file: FILE. Returns FAILED if it cannot be written. */
static status results_put(const char *file, const char *head, const char *text)
{
    char path[256], *whole = NULL;
    size_t length = 0;
    snprintf(path, sizeof path, RESULTS "/%s", file);
    FILE *to = memory_stream_open(&whole, &length);
    if (!to) return status_set(FAILED, "cannot write %s: out of memory", path);
    fprintf(to, "%s%s", head, text);
    const status s = fclose(to) == 0 ? file_write_whole(path, whole, length)
                                     : status_set(FAILED, "cannot write %s: out of memory", path);
    free(whole);
    return s;
}

/* Writes the output `printed` of a bench, preceded by the lines r->head, to bench/results/NAME.txt. name: NAME; an
 * equals sign becomes an underscore. Returns FAILED if the file cannot be written. */
static status printed_put(const struct bench_results *r, const char *name, const char *printed)
{
    char file[64], *equals;
    snprintf(file, sizeof file, "%s.txt", name);
    equals = strchr(file, '=');
    if (equals) *equals = '_';
    return results_put(file, r->head, printed);
}

/* ---- tables ------------------------------------------------------------------------------------------------------ */

/* The lines that precede tables stored in bench/results; "" while tables are not stored. */
static char table_head[1024];

status bench_results_copy_table(const char *file_name, const char *text)
{
    int lines = 0;
    if (!table_head[0]) return OK;
    for (const char *c = text; *c; c++) lines += *c == '\n';
    return lines > LINES_MAX ? OK : results_put(file_name, table_head, text);
}

/* ---- standard output --------------------------------------------------------------------------------------------- */

/* Begins to collect what the bench `bench_name` prints and the tables that it writes. quick: the bench runs with
 * --quick. Returns REFUSED outside a source tree, FAILED if no temporary file can be created. *r: state of the
 * collection. */
status bench_results_begin(struct bench_results *r, const char *bench_name, bool quick)
{
    if (!path_exists("bench"))
        return status_set(REFUSED, "bench: no such folder; --readme is for the top of the source tree");
    if (mkdir(RESULTS, 0777) != 0 && errno != EEXIST) return file_report_write_failure(RESULTS, errno);
    fprintf(stderr, "bench %s: its figures go to " RESULTS "\n", bench_name);
    results_head(r->head, sizeof r->head, bench_name, quick);
    snprintf(table_head, sizeof table_head, "%s", r->head);
    fflush(stdout);
    r->printed = tmpfile();
    r->output = dup(STDOUT_FILENO);
    if (r->printed && r->output >= 0 && dup2(fileno(r->printed), STDOUT_FILENO) >= 0) return OK;
    return status_set(FAILED, "cannot write a temporary file for the output of bench %s", bench_name);
}

status bench_results_end(struct bench_results *r, const char *bench_name, status bench_status)
{
    fflush(stdout);
    dup2(r->output, STDOUT_FILENO);
    close(r->output);
    table_head[0] = '\0';
    char *printed = text_of(r->printed);
    fclose(r->printed);
    if (printed) fputs(printed, stdout);
    if (bench_status == OK)
        bench_status = printed ? printed_put(r, bench_name, printed) : status_set(FAILED, "nothing was printed");
    free(printed);
    return bench_status;
}
