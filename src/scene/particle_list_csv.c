/* Reads particle lists from CSV files, in the forms that other programs write. Every message names line and column. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/memory.h"
#include "csv.h"
#include "particle_list_parts.h"

enum { FIELDS_MAX = 256 }; /* largest number of fields of a line */

/* A particle list in CSV format while it is read. */
struct csv {
    struct csv_file in;
    int fields, column[FIELDS_MAX]; /* enum list_column of each field of a line */
    real factor[FIELDS_MAX];        /* factor from the unit of the field to SI */
    int first[FIELDS_MAX];          /* index of the first item in the file: 1 for blocks, else 0 */
    bool whole;   /* so far the volumes of a list without names are written as whole numbers, as blocks are */
    bool pending; /* the current line is the first entry, since the column names are in another line */
    int64_t room; /* number of particles for which the arrays have memory */
};

/* Returns k (0 to DIM_MAX - 1) if `name` is `vector:k` or `vector_k`, the two forms in which ParaView writes component
 * k of a vector; -1 for other names. Capitals count as small letters. */
static int component_named(const char *name, const char *vector)
{
    const size_t length = strlen(vector);
    if (strncasecmp(name, vector, length) != 0 || strlen(name) != length + 2) return -1;
    if (name[length] != ':' && name[length] != '_') return -1;
    return name[length + 1] >= '0' && name[length + 1] < '0' + DIM_MAX ? name[length + 1] - '0' : -1;
}

/* Returns true if `name` is a column name of mesh blocks in Peridigm and PeriLab, which number blocks from 1. A block
 * is read as a material, not as a body, because bonds join blocks but not bodies. */
static bool names_block(const char *name)
{
    return strcasecmp(name, "block_id") == 0 || strcasecmp(name, "block") == 0;
}

/* Returns the list column (COLUMN_*) that a column name of the file means, or COLUMN_NONE if there is none or it has
 * no use in `dim` dimensions. */
static int column_named(const char *name, int dim)
{
    const int place = component_named(name, "points"), velocity = component_named(name, "velocity");
    int found = names_block(name) ? COLUMN_MATERIAL
                : place >= 0      ? COLUMN_X + place
                : velocity >= 0   ? COLUMN_VX + velocity
                                  : COLUMN_NONE;
    for (int k = 0; k < COLUMNS; k++)
        if (strcasecmp(name, list_quantity[k].name) == 0) found = k;
    return found == COLUMN_NONE || particle_list_column_exceeds_dimension(found, dim) ? COLUMN_NONE : found;
}

/* Decides by its unit whether a column called `weight` is a mass or a volume. Sets *column to COLUMN_MASS or
 * COLUMN_VOLUME. name, unit: the two parts of the column name in the current line of c. Returns REFUSED, with a
 * message, for another unit or none. */
static status weight_column(struct csv *c, const char *name, const char *unit, int *column)
{
    char what[160];
    real one;
    *column = unit_find_factor_to_si(&one, unit, UNIT_MASS, what, sizeof what) ? COLUMN_MASS : COLUMN_VOLUME;
    if (*unit && unit_find_factor_to_si(&one, unit, list_quantity[*column].unit, what, sizeof what)) return OK;
    return csv_report_fault(&c->in, name,
                            "the column weight may be a mass or a volume; give its unit, such as weight [kg]");
}

/* Appends a column to c->column. name: its name with unit, such as `x [mm]`, which is modified; has[COLUMNS]: true for
 * the list columns that were named before, updated. A column with an unknown name is noted in l->head and ignored.
 * Returns REFUSED, with a message, if a column is named twice or its unit is of another quantity. */
static status csv_column(struct csv *c, char *name, struct particle_list *l, bool *has)
{
    char what[160];
    const char *unit = csv_cut_unit_off_column_name(name);
    int k = column_named(name, l->dim);
    if (c->fields == FIELDS_MAX) return csv_report_fault(&c->in, name, "more than %d columns", FIELDS_MAX);
    if (strpbrk(name, "\"'"))
        return csv_report_fault(&c->in, name, "unknown column '%.40s'; write names without quotes or in double quotes",
                                name);
    if (strcasecmp(name, "weight") == 0) TRY(weight_column(c, name, unit, &k));
    if (k == COLUMN_NONE)
        particle_list_head_append_to_message(&l->head, ", ",
                                             *name ? name : "a column has no name; give every column a name");
    else if (has[k])
        return csv_report_fault(&c->in, name, "two columns are named %s; rename or remove one", list_quantity[k].name);
    else if (!unit_find_factor_to_si(&c->factor[c->fields], unit, list_quantity[k].unit, what, sizeof what))
        return csv_report_fault(&c->in, unit, "%s: [%.40s] %s", list_quantity[k].name, unit, what);
    else
        has[k] = true;
    if (k != COLUMN_NONE && !*unit) c->factor[c->fields] = particle_list_default_factor_to_si(l, k);
    if (k == COLUMN_MATERIAL && names_block(name)) l->head.block = true, c->first[c->fields] = 1;
    c->column[c->fields++] = k;
    return OK;
}

/* Finds the separator of the header in c->in.text: comma, semicolon or tab, or a blank if the header contains none of
 * them. For a blank, removes the blanks before and inside units in brackets: `x [mm] y [mm]` becomes `x[mm] y[mm]`. */
static void header_separate(struct csv *c)
{
    char *text = c->in.text, *to = text;
    csv_detect_separator(&c->in);
    if (strchr(text, c->in.separator) || !strpbrk(text + strspn(text, " "), " ")) return;
    c->in.separator = ' ';
    bool inside = false;
    for (const char *from = text; *from; from++) {
        const char *next = from + strspn(from, " ");
        inside = strchr("[(", *from) || (inside && !strchr("])", *from));
        if (*from != ' ' || !(inside || strchr("[(", *next))) *to++ = *from;
    }
    *to = '\0';
}

/* Reads the column names from the current line of c, and notes in l->head which columns the list has. Returns REFUSED,
 * with a message, if a coordinate is missing, if a column is named twice or if both mass and density are given. */
static status header_read(struct csv *c, struct particle_list *l)
{
    bool has[COLUMNS] = {false};
    const char *const names = l->dim == 1 ? "x,volume" : l->dim == 2 ? "x,y,volume" : "x,y,z,volume";
    header_separate(c);
    char *rest = c->in.text;
    for (char *name; (name = csv_split_off_next_field(&c->in, &rest)) != NULL;) TRY(csv_column(c, name, l, has));
    for (int k = 0; k < l->dim; k++)
        if (!has[k] && l->form.columns)
            return status_set(REFUSED,
                              "%s: columns: [%s] does not name %s; name every column of the file, such as [%s]",
                              c->in.path, l->form.columns, list_quantity[k].name, names);
        else if (!has[k])
            return csv_report_fault(&c->in, c->in.text, "column %s is missing; name it in the first line, such as %s%s",
                                    list_quantity[k].name, names,
                                    strncmp(c->in.text, "ITEM:", 5) == 0
                                        ? "; this is a dump of LAMMPS: remove its lines up to ITEM: ATOMS, and these "
                                          "two words from that line"
                                        : "");
    if (has[COLUMN_MASS] && has[COLUMN_DENSITY])
        return csv_report_fault(
            &c->in, c->in.text,
            "mass and density are both given, but each determines the other; remove one of the two columns");
    particle_list_head_store_missing_columns(&l->head, has);
    return OK;
}

/* Overwrites the words that precede the column names in the header line `text` with blanks: # of a comment (Peridigm)
 * and `header:` (PeriLab). */
static void header_bare(char *text)
{
    static const char word[] = "header:";
    for (; *text == '#' || *text == ' ' || *text == '\t'; text++) *text = ' ';
    if (strncasecmp(text, word, sizeof word - 1) != 0) return;
    memset(text, ' ', sizeof word - 1);
    for (text += sizeof word - 1; *text == '\t' || *text == ' '; text++) *text = ' ';
}

/* Returns true if the line `text` has neither commas nor semicolons, so that tabs or blanks separate its fields. */
static bool line_of_blanks(const char *text) { return !strpbrk(text, ",;"); }

static void tabs_to_blanks(char *text)
{
    for (; *text; text++)
        if (*text == '\t') *text = ' ';
}

/* Returns the number of names in the header line `names`. dim: coordinates per position; *all: receives true if all
 * `dim` coordinates are among the names. */
static int header_count(const char *names, int dim, bool *all)
{
    struct csv trial = {0};
    bool has[COLUMNS + 2] = {false};
    int n = 0;
    strcpy(trial.in.text, names);
    header_separate(&trial);
    char *rest = trial.in.text;
    for (char *name; (name = csv_split_off_next_field(&trial.in, &rest)) != NULL; n++) {
        csv_cut_unit_off_column_name(name);
        has[column_named(name, dim)] = true;
    }
    *all = true;
    for (int k = 0; k < dim; k++) *all = *all && has[k];
    return n;
}

/* Returns true if a comment line of a CSV file is a header: it names all `dim` coordinates, separated by tabs or by
 * blanks. */
static bool comment_names(const char *comment, int dim)
{
    char blank[CSV_LINE_LENGTH];
    bool by_tabs, by_blanks;
    strcpy(blank, comment);
    if (line_of_blanks(comment)) tabs_to_blanks(blank);
    header_count(comment, dim, &by_tabs);
    header_count(blank, dim, &by_blanks);
    return by_tabs || by_blanks;
}

/* Replaces the tabs in the header line `names` by blanks if both tabs and blanks separate its names. This is so if the
 * header then has as many names as the first entry has values. Otherwise each tab ends a name, which may be empty, and
 * the header remains unchanged. entry: line of the first entry; dim: coordinates per position. */
static void header_unify(char *names, const char *entry, int dim)
{
    char blank[CSV_LINE_LENGTH], values[CSV_LINE_LENGTH], *rest = values;
    const struct csv_file by_blanks = {.separator = ' '};
    bool all;
    int n = 0;
    if (!strchr(names, '\t') || !line_of_blanks(names)) return;
    strcpy(blank, names);
    strcpy(values, entry);
    tabs_to_blanks(blank);
    while (csv_split_off_next_field(&by_blanks, &rest)) n++;
    if (header_count(blank, dim, &all) == n && all) strcpy(names, blank);
}

/* Returns true if the first field of the line `text` is a number. */
static bool line_of_numbers(const char *text)
{
    char *end;
    strtod(text, &end);
    return end != text && strchr(" \t,;\r\n", *end);
}

/* Returns true if the line `text` consists of five numbers separated by blanks, an entry of a Peridigm text mesh
 * without column names. */
static bool line_of_mesh(const char *text)
{
    int n = 0;
    for (char *end; line_of_numbers(text); n++, text = end) strtod(text, &end);
    return n == 5 && text[strspn(text, " \t\r\n")] == '\0';
}

/* Reads the column names of the list l from the text `names`, which is line number `line` of the file. The current line
 * of c is the first entry of the list; it remains the current line, so that it can be read next. Returns REFUSED, with
 * a message, for invalid names. */
static status header_elsewhere(struct csv *c, struct particle_list *l, const char *names, int64_t line)
{
    char entry[CSV_LINE_LENGTH];
    const int64_t entry_line = c->in.line;
    strcpy(entry, c->in.text);
    strcpy(c->in.text, names);
    header_unify(c->in.text, entry, l->dim);
    c->in.line = line;
    TRY(header_read(c, l));
    strcpy(c->in.text, entry);
    c->in.line = entry_line;
    c->pending = true;
    return OK;
}

/* Reads the column names of the list l from the current line of c, which contains tabs. Reads the next line, the first
 * entry, too, since its number of values shows whether blanks separate names as well. Returns REFUSED, with a message,
 * for invalid names. */
static status header_of_tabs(struct csv *c, struct particle_list *l)
{
    char names[CSV_LINE_LENGTH];
    const int64_t line = c->in.line;
    bool more;
    strcpy(names, c->in.text);
    TRY(csv_read_data_line(&c->in, &more));
    if (more) return header_elsewhere(c, l, names, line);
    strcpy(c->in.text, names);
    return header_read(c, l);
}

/* Reads the column names of the CSV file c, for the list l. They are in the first line that is not a comment or, if
 * this line has numbers, in the first comment before it that names all coordinates. Without names, a line of five
 * numbers is read as a Peridigm text mesh. Returns REFUSED, with a message, for an empty file, and if there are neither
 * names nor such a line. */
static status csv_header(struct csv *c, struct particle_list *l)
{
    static const char mesh[] = "x y z block_id volume";
    char names[CSV_LINE_LENGTH] = "";
    int64_t line = 0;
    bool more, comment = true;
    while (comment) {
        TRY(csv_read_line(&c->in, &more, &comment));
        if (!more)
            return status_set(REFUSED,
                              "%s: the file is empty; begin with a line that names the columns, such as x,y,z,volume",
                              c->in.path);
        if (!comment || *names) continue;
        header_bare(c->in.text);
        if (comment_names(c->in.text, l->dim)) strcpy(names, c->in.text), line = c->in.line;
    }
    if (*names && line_of_numbers(c->in.text)) return header_elsewhere(c, l, names, line);
    if (line_of_mesh(c->in.text)) {
        l->head.unnamed = c->whole = true;
        return header_elsewhere(c, l, mesh, c->in.line);
    }
    if (line_of_numbers(c->in.text))
        return csv_report_fault(
            &c->in, c->in.text,
            "this line has numbers, but no line before it names the columns; add such a line, such as x,y,volume");
    header_bare(c->in.text);
    return strchr(c->in.text, '\t') && line_of_blanks(c->in.text) ? header_of_tabs(c, l) : header_read(c, l);
}

/* Reads the column names that the input file (scene) gives, l->form.columns, in place of those of the file c. The
 * first line that is not a comment is the first entry; it shows whether commas, tabs or blanks separate fields.
 * Returns REFUSED, with a message, for an empty file or invalid names. */
static status csv_header_given(struct csv *c, struct particle_list *l)
{
    char entry[CSV_LINE_LENGTH];
    bool more;
    TRY(csv_read_data_line(&c->in, &more));
    if (!more) return status_set(REFUSED, "%s: the file is empty; give one line for each particle", c->in.path);
    strcpy(entry, c->in.text);
    snprintf(c->in.text, sizeof c->in.text, "%s", l->form.columns);
    TRY(header_read(c, l));
    strcpy(c->in.text, entry);
    header_separate(c);
    c->pending = true;
    return OK;
}

/* Provides memory in the arrays of the list l for one more entry, doubling their length c->room if it is used up.
 * Returns REFUSED, with a message, if the memory does not allow it. */
static status csv_grow(struct csv *c, struct particle_list *l)
{
    if (l->n < c->room) return OK;
    int64_t room = c->room > 0 ? 2 * c->room : 1024;
    TRY(particle_list_check_memory(c->in.path, room / 2));
    for (int k = 0; k < c->fields; k++) {
        if (c->column[k] == COLUMN_NONE) continue;
        real **array = particle_list_address_of_column_array(l, c->column[k]);
        GROW("list.column", *array, room);
        if (c->column[k] == COLUMN_MATERIAL) GROW("list.at", l->material_at, room);
    }
    GROW("list.line", l->line, room);
    c->room = room;
    return OK;
}

/* Stores the material name `field` in l->name unless it is there, and sets *value to -1 minus its index, so that
 * negative values distinguish names from material numbers. c: file, for messages. Returns REFUSED, with a message, for
 * more than NAMES_MAX names, or a name of NAME_MAX_LENGTH characters or more. */
static status csv_name(const struct csv *c, struct particle_list *l, const char *field, real *value)
{
    int k = 0;
    if (!l->name) l->name = memory_new("list.name", NAMES_MAX, sizeof *l->name);
    if (strlen(field) >= NAME_MAX_LENGTH)
        return csv_report_fault(&c->in, field, "the name of a material is too long; shorten it");
    while (k < l->names && strcmp(l->name[k], field) != 0) k++;
    if (k == NAMES_MAX)
        return csv_report_fault(&c->in, field, "the column material has more than %d names; use fewer materials",
                                NAMES_MAX);
    if (k == l->names) strcpy(l->name[l->names++], field);
    *value = -1 - k;
    return OK;
}

/* Reads the text `field`, field number k of the current line of c, converts its value to SI units and stores it as
 * entry l->n of the list column to which this field belongs. Returns REFUSED, with a message, if the text is no valid
 * value. */
static status csv_value(struct csv *c, struct particle_list *l, int k, const char *field)
{
    const int column = c->column[k];
    const char *name = c->first[k] ? "block_id" : list_quantity[column].name;
    char *end;
    real value = strtod(field, &end), *to = *particle_list_address_of_column_array(l, column) + l->n;
    if (column == COLUMN_MATERIAL) l->material_at[l->n] = (int16_t)(field - c->in.text + 1);
    if (column == COLUMN_MATERIAL && l->head.unnamed && field[strspn(field, "0123456789")])
        return csv_report_fault(
            &c->in, field,
            "%.40s: without names the fourth column is block_id, a whole number; if it is the volume, give the list as "
            "{file: .., columns: [x, y, z, volume, block]}, else with [x, y, z, block, volume]",
            field);
    if (column == COLUMN_VOLUME) c->whole = c->whole && !field[strspn(field, "0123456789")];
    if (column == COLUMN_MATERIAL && end == field && *field) return csv_name(c, l, field, to);
    if (end == field || *end != '\0' || strpbrk(field, "xX"))
        return csv_report_fault(&c->in, field, "%s: '%.40s' is not a number; correct it%s", name, field,
                                strchr(field, ',') ? " (the decimal sign is a point, not a comma)" : "");
    value = value * c->factor[k] - c->first[k];
    const char *fault = particle_list_reason_value_is_invalid(column, value);
    if (fault != NULL)
        return csv_report_fault(&c->in, field, "%s: %.40s %s", name, field,
                                c->first[k] ? "must be a whole number from 1 to 256; correct it" : fault);
    *to = value;
    return OK;
}

/* Appends one particle to the list l from the current line of c. Returns REFUSED, with a message, for too few or too
 * many values, or an invalid one. */
static status csv_entry(struct csv *c, struct particle_list *l)
{
    char *rest = c->in.text;
    for (int k = 0; k < c->fields; k++) {
        const char *field = csv_split_off_next_field(&c->in, &rest);
        if (field == NULL)
            return csv_report_fault(&c->in, c->in.text, "this line has %d values, but the %s %d columns", k,
                                    l->form.columns ? "scene names" : "header names", c->fields);
        if (c->column[k] != COLUMN_NONE) TRY(csv_value(c, l, k, field));
    }
    if (rest != NULL)
        return csv_report_fault(
            &c->in, rest,
            "this line has more values than the %d columns of the %s; write numbers with a decimal point, not a comma",
            c->fields, l->form.columns ? "scene" : "header");
    l->line[l->n++] = c->in.line;
    return OK;
}

/* Returns REFUSED, with a message, if the list l of the file c has no column names and the numbers in its fourth and in
 * its fifth column are all whole: it is then unknown which column is the block (the material) and which the volume. */
static status unnamed_check(const struct csv *c, const struct particle_list *l)
{
    if (!l->head.unnamed || !c->whole || l->n == 0) return OK;
    return status_set(REFUSED,
                      "%s:%lld:1: columns 4 and 5 are both whole numbers, so either may be the block or the volume; "
                      "say which: {file: .., columns: [x, y, z, block, volume]} or [x, y, z, volume, block]",
                      c->in.path, (long long)l->line[0]);
}

static status csv_entries(struct csv *c, struct particle_list *l, bool head)
{
    TRY(l->form.columns ? csv_header_given(c, l) : csv_header(c, l));
    if (head) return OK;
    for (bool more = true;; c->pending = false) {
        if (!c->pending) TRY(csv_read_data_line(&c->in, &more));
        if (!more) return unnamed_check(c, l);
        if (l->n >= PARTICLES_MAX)
            return status_set(REFUSED, "%s: the list has more than %d particles; use fewer", c->in.path, PARTICLES_MAX);
        TRY(csv_grow(c, l));
        TRY(csv_entry(c, l));
    }
}

status particle_list_read_csv(struct particle_list *l, const char *path, bool only_header)
{
    struct csv c = {0};
    TRY(csv_open(&c.in, path, "write one particle on each line"));
    status s = csv_entries(&c, l, only_header);
    csv_close(&c.in);
    return s;
}
