/* Writes `cleave help --reference`, the page inputs/keys.md of the manual, from the table of keys. */
#include <string.h>

#include "scene_internal.h"

/* Writes `text` to `out` as a cell of a Markdown table, with escapes for the characters | * <, followed by the bar that
 * ends the cell. */
static void cell(FILE *out, const char *text)
{
    for (const char *c = text; *c; c++) {
        if (strchr("|*<", *c)) fputc('\\', out);
        fputc(*c, out);
    }
    fputs(" |", out);
}

static void table_head(FILE *out) { fputs("| key | value; default | meaning |\n|---|---|---|\n", out); }

static void row(FILE *out, const struct key *k)
{
    char facts[640];
    key_describe_type(k, facts, sizeof facts);
    fprintf(out, "| `%s` | ", k->path);
    cell(out, facts);
    fputc(' ', out);
    cell(out, k->help);
    fputc('\n', out);
}

/* Returns true if key k (of input files) is at the top of a scene, not below another key. *has_keys: receives true if
 * other keys are below k; these follow k in the table of keys. */
static bool is_top(const struct key *k, bool *has_keys)
{
    *has_keys = k + 1 < keys + keys_count && key_is_at_or_below_path(&k[1], k->path);
    return !strchr(k->path, '.');
}

void scene_print_key_reference_as_markdown(FILE *out)
{
    bool has_keys;
    fputs("# All keys of a scene\n\n"
          "This page is what `cleave help --reference` prints. `cleave help KEY` prints a key and what is below it, "
          "`cleave\n"
          "help units` the units, `cleave help expression` the formulas that a number may be.\n\n"
          "A value is a number in SI or with a unit (`0.5 mm`, `190 GPa`), a word, a list `[..]` or a mapping `{..}`. "
          "The\n"
          "second column has type, SI unit in brackets, range or words, and default. Items of lists have the keys "
          "below the\n"
          "list: `cracks.from` is `from` in each item of `cracks`.\n\n"
          "## Keys without keys of their own\n\n",
          out);
    table_head(out);
    for (const struct key *k = keys; k < keys + keys_count; k++)
        if (is_top(k, &has_keys) && !has_keys) row(out, k);
    for (const struct key *k = keys; k < keys + keys_count; k++) {
        const bool top = is_top(k, &has_keys);
        if (top && !has_keys) continue;
        if (top) fprintf(out, "\n## %s\n\n", k->path), table_head(out);
        row(out, k);
    }
}
