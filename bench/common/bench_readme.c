/* `cleave bench NAME --readme`: writes the output of a bench between the two marks of its name in bench/README.md, with
 * command and date, so that the text always stems from the current bench. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "bench.h"
#include "base/memory_stream.h"
#include "output/output_files.h"

#define README "bench/README.md"

/* ---- files ------------------------------------------------------------------------------------------------------- */

/* Returns all bytes of an open file from its start, terminated by 0; NULL if it cannot be read. Release with free. */
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

/* Reads bench/README.md. REFUSED if it does not exist. */
static status readme_text(char **text)
{
    FILE *in = fopen(README, "r");
    if (!in) return status_set(REFUSED, README ": no such file; --readme is for the top of the source tree");
    *text = text_of(in);
    fclose(in);
    return *text ? OK : status_set(FAILED, README ": cannot be read");
}

/* ---- blocks ------------------------------------------------------------------------------------------------------ */

/* Finds the marks of a bench: *from is after the first mark, *to at the second. REFUSED if one is missing. */
static status block_find(const char *text, const char *name, const char **from, const char **to)
{
    char mark[2][80];
    snprintf(mark[0], sizeof mark[0], "<!-- cleave bench %s -->\n", name);
    snprintf(mark[1], sizeof mark[1], "<!-- end of %s -->\n", name);
    *from = strstr(text, mark[0]);
    if (*from) *from += strlen(mark[0]);
    *to = *from ? strstr(*from, mark[1]) : NULL;
    if (*to) return OK;
    return status_set(REFUSED, README ": the marks of bench %s are missing: %.*s and %.*s are expected", name,
                      (int)strlen(mark[0]) - 1, mark[0], (int)strlen(mark[1]) - 1, mark[1]);
}

static status readme_check(const char *name)
{
    const char *from, *to;
    char *text;
    TRY(readme_text(&text));
    const status s = block_find(text, name, &from, &to);
    free(text);
    return s;
}

/* Replaces the block of a bench by the printed text. The file is written under a temporary name and renamed. */
static status block_put(const char *name, bool quick, const char *printed)
{
    const char *from, *to;
    char *text, *whole = NULL, date[16];
    size_t length = 0;
    const time_t now = time(NULL);
    TRY(readme_text(&text));
    status s = block_find(text, name, &from, &to);
    FILE *out = s == OK ? memory_stream_open(&whole, &length) : NULL;
    if (s == OK && !out) s = status_set(FAILED, README ": out of memory");
    if (s == OK) {
        strftime(date, sizeof date, "%Y-%m-%d", localtime(&now));
        fwrite(text, 1, (size_t)(from - text), out);
        fprintf(out, "`cleave bench %s%s`, %s:\n\n```text\n%s```\n%s", name, quick ? " --quick" : "", date, printed,
                to);
        s = fclose(out) == 0 ? file_put(README, whole, length) : status_set(FAILED, README ": out of memory");
    }
    free(whole);
    free(text);
    return s;
}

/* ---- standard output --------------------------------------------------------------------------------------------- */

status bench_readme_begin(struct bench_readme *r, const char *name)
{
    TRY(readme_check(name));
    fprintf(stderr, "bench %s: its figures go to " README "\n", name);
    fflush(stdout);
    r->printed = tmpfile();
    r->output = dup(STDOUT_FILENO);
    if (r->printed && r->output >= 0 && dup2(fileno(r->printed), STDOUT_FILENO) >= 0) return OK;
    return status_set(FAILED, "no room for what bench %s prints (a temporary file)", name);
}

status bench_readme_end(struct bench_readme *r, const char *name, bool quick, status measured)
{
    fflush(stdout);
    dup2(r->output, STDOUT_FILENO);
    close(r->output);
    char *printed = text_of(r->printed);
    fclose(r->printed);
    if (printed) fputs(printed, stdout);
    if (measured == OK)
        measured = printed ? block_put(name, quick, printed) : status_set(FAILED, "nothing was printed");
    free(printed);
    return measured;
}
