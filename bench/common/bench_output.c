/* Tables of results as CSV and JSON, and their picture. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "bench.h"
#include "plot/gnuplot.h"
#include "output/picture_file.h"
#include "base/memory.h"
#include "base/memory_stream.h"
#include "output/output_files.h"
#include "simd/simd.h"

/* ---- tables ------------------------------------------------------------------------------------------------------ */

/* Initialises t as an empty table of results. name: "" for the main table of a bench; header: names of its columns,
 * separated by commas. Both are kept by reference. */
void bench_table_make(struct bench_table *t, const char *name, const char *header)
{
    *t = (struct bench_table){.name = name, .header = header, .columns = 1};
    for (const char *c = header; *c; c++) t->columns += *c == ',';
}

static struct bench_cell *add_cell(struct bench_table *t)
{
    GROW("bench.cell", t->cell, t->cells + 1);
    return &t->cell[t->cells++];
}

void bench_table_append_text(struct bench_table *t, const char *text)
{
    struct bench_cell *c = add_cell(t);
    snprintf(c->text, sizeof c->text, "%s", text);
}

void bench_table_append_number(struct bench_table *t, double number)
{
    *add_cell(t) = (struct bench_cell){.number = number};
}

void bench_table_free(struct bench_table *t)
{
    memory_free(t->cell);
    *t = (struct bench_table){0};
}

/* ---- files ------------------------------------------------------------------------------------------------------- */

/* Writes a text as a cell of a CSV table, with ; in place of commas and quotes. */
static void output_put_text(FILE *to, const char *text)
{
    for (; *text; text++) fputc(*text == ',' || *text == '"' ? ';' : *text, to);
}

static void put_csv(FILE *to, const struct bench_table *t)
{
    fprintf(to, "%s\n", t->header);
    for (int64_t k = 0; k < t->cells; k++) {
        const struct bench_cell *c = &t->cell[k];
        if (c->text[0])
            output_put_text(to, c->text);
        else if (isfinite(c->number))
            fprintf(to, "%.9g", c->number);
        fputc((k + 1) % t->columns ? ',' : '\n', to);
    }
}

/* Copies the name of column k from the header of table t into name[size]. */
static void output_column_name(const struct bench_table *t, int64_t k, char *name, size_t size)
{
    const char *from = t->header;
    while (k-- > 0) from = strchr(from, ',') + 1;
    snprintf(name, size, "%.*s", (int)strcspn(from, ","), from);
}

static void put_rows(FILE *to, const struct bench_table *t)
{
    char name[NAME_MAX_LENGTH];
    for (int64_t k = 0; k < t->cells; k++) {
        const struct bench_cell *c = &t->cell[k];
        output_column_name(t, k % t->columns, name, sizeof name);
        if (k % t->columns == 0)
            fprintf(to, "%s\n    {", k ? "}," : "");
        else
            fputs(", ", to);
        if (c->text[0]) {
            fprintf(to, "\"%s\": \"", name);
            output_put_text(to, c->text);
            fputc('"', to);
        } else if (isfinite(c->number))
            fprintf(to, "\"%s\": %.9g", name, c->number);
        else
            fprintf(to, "\"%s\": null", name);
    }
    fputs(t->cells ? "}\n  " : "", to);
}

static void put_json(FILE *to, const char *name, const struct bench_table *table, int tables)
{
    struct machine m = machine_properties();
    fprintf(to, "{\n  \"name\": \"%s\",\n  \"version\": \"%s\",\n  \"machine\": \"%s\",\n  \"cores\": %d", name,
            CLEAVE_VERSION, m.model, m.cores);
    for (int k = 0; k < tables; k++) {
        fprintf(to, ",\n  \"%s\": [", table[k].name[0] ? table[k].name : "rows");
        put_rows(to, &table[k]);
        fputc(']', to);
    }
    fputs("\n}\n", to);
}

/* Checks that neither results nor results/bench is a symbolic link, through which files would be written elsewhere.
 * Returns REFUSED if one is. */
static status bench_folder_guard(void)
{
    static const char *const folder[] = {"results", BENCH_FOLDER};
    for (size_t k = 0; k < COUNT_OF(folder); k++)
        if (path_is_link(folder[k]))
            return status_set(REFUSED, "%s is a symbolic link, and tables would be written elsewhere; remove it",
                              folder[k]);
    return OK;
}

status bench_create_results_folder(void)
{
    TRY(bench_folder_guard());
    if (mkdir("results", 0777) != 0 && errno != EEXIST) return file_report_write_failure("results", errno);
    if (mkdir(BENCH_FOLDER, 0777) != 0 && errno != EEXIST) return file_report_write_failure(BENCH_FOLDER, errno);
    return OK;
}

/* Composes in text[room] the bytes with which the file NAME.json of a bench begins and by which it is recognised. name:
 * NAME. */
static void json_begin(char *text, size_t room, const char *name)
{
    snprintf(text, room, "{\n  \"name\": \"%s\",\n  \"version\"", name);
}

status bench_check_files_may_be_replaced(const char *bench_name)
{
    static const char *const ending[] = {"csv", "png", "svg"};
    char path[256], begin[128], *text;
    size_t length;
    TRY(bench_folder_guard());
    snprintf(path, sizeof path, BENCH_FOLDER "/%s.json", bench_name);
    bool ours = true;
    if (path_exists(path)) {
        json_begin(begin, sizeof begin, bench_name);
        ours = file_read_whole(path, &text, &length) == OK;
        if (ours) ours = strncmp(text, begin, strlen(begin)) == 0, memory_free(text);
    } else
        for (size_t k = 0; k < COUNT_OF(ending) && ours; k++) {
            snprintf(path, sizeof path, BENCH_FOLDER "/%s.%s", bench_name, ending[k]);
            ours = !path_exists(path) || picture_file_is_from_cleave(path);
        }
    return ours ? OK : status_set(REFUSED, "%s exists and was not written by cleave bench; move or remove it", path);
}

/* Writes tables to the file `path`. json: NULL to write table[0] as CSV; else the name of the bench, to write all of
 * table[tables] as JSON. Returns FAILED if the file cannot be written. */
static status write_file(const char *path, const char *json, const struct bench_table *table, int tables)
{
    char *text = NULL;
    size_t length = 0;
    FILE *to = memory_stream_open(&text, &length);
    if (!to) return status_set(FAILED, "cannot write %s: out of memory", path);
    if (json)
        put_json(to, json, table, tables);
    else
        put_csv(to, table);
    bool whole = fclose(to) == 0;
    status s =
        whole ? file_write_whole(path, text, length) : status_set(FAILED, "cannot write %s: out of memory", path);
    if (s == OK && !json) s = bench_results_copy_table(strrchr(path, '/') + 1, text);
    free(text);
    return s;
}

status bench_prepare_result_files(const char *bench_name)
{
    char path[256];
    TRY(bench_create_results_folder());
    TRY(bench_check_files_may_be_replaced(bench_name));
    snprintf(path, sizeof path, BENCH_FOLDER "/%s.json", bench_name);
    return path_exists(path) ? OK : write_file(path, bench_name, NULL, 0);
}

status bench_write_result_tables(const char *bench_name, const struct bench_table *table, int table_count)
{
    char path[256];
    TRY(bench_prepare_result_files(bench_name));
    for (int k = 0; k < table_count; k++) {
        snprintf(path, sizeof path, BENCH_FOLDER "/%s%s%s.csv", bench_name, table[k].name[0] ? "_" : "", table[k].name);
        TRY(write_file(path, NULL, &table[k], 1));
    }
    snprintf(path, sizeof path, BENCH_FOLDER "/%s.json", bench_name);
    return write_file(path, bench_name, table, table_count);
}

/* ---- pictures ---------------------------------------------------------------------------------------------------- */

/* Draws the pictures results/bench/NAME.png and NAME.svg. bench_name: NAME; width, height: size [pixel]. draw(to,
 * context) must send the commands of the picture to gnuplot. Returns FAILED if gnuplot fails. */
status bench_draw(const char *bench_name, int width, int height, void (*draw)(FILE *to, const void *context),
                  const void *context)
{
    static const struct {
        enum picture_format format;
        const char *ending;
    } formats[] = {{PICTURE_PNG, "png"}, {PICTURE_SVG, "svg"}};
    TRY(bench_create_results_folder());
    for (size_t k = 0; k < COUNT_OF(formats); k++) {
        char path[256];
        struct gnuplot g;
        snprintf(path, sizeof path, BENCH_FOLDER "/%s.%s", bench_name, formats[k].ending);
        TRY(gnuplot_open(&g, path, formats[k].format, width, height));
        draw(g.to, context);
        TRY(gnuplot_close(&g));
    }
    char table[256];
    snprintf(table, sizeof table, BENCH_FOLDER "/%s.csv", bench_name);
    printf("  written to " BENCH_FOLDER "/%s%s.png, .svg\n\n", bench_name, path_is_file(table) ? ".csv, .json, " : "");
    return OK;
}

void bench_print_machine(int thread_count)
{
    struct machine m = machine_properties();
    printf("  %s, %d cores, %lld kB L2, %lld MB L3; cleave %s, kernels %s, %d thread%s unless said otherwise\n",
           m.model, m.cores, (long long)(m.cache[2] / 1024), (long long)(m.cache[3] / 1048576), CLEAVE_VERSION,
           simd_current_kernels()->name, thread_count, thread_count > 1 ? "s" : "");
}
