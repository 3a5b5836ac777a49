/* Reads the function of time of a boundary condition, also from a CSV file. */
#include "scene_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "base/memory.h"
#include "csv.h"

/* Reads the table n of pairs [time, factor] with ascending times into f->t [s], f->value [1]; f->n receives their
 * number. Returns REFUSED, with a message, for another form or order. */
static status read_table(struct reader *r, const struct yaml_node *n, struct time_function *f)
{
    const struct key *k = key_find("boundary.time", "table");
    struct key time = *k, factor = *k;
    time.range.given = factor.range.given = false;
    factor.unit = UNIT_NONE;
    TRY(check_node_is_list_of_valid_length(r, k, n));
    f->kind = TIME_TABLE;
    f->t = NEW("time table", n->n, real);
    f->value = NEW("time table", n->n, real);
    for (const struct yaml_node *row = n->first; row; row = row->next) {
        if (row->kind != NODE_LIST || row->n != 2)
            return fault_report_at_node(r, row, "%s is not a pair of time and factor; give one such as [5 us, 1]",
                                        node_value_to_text_for_message(r, row));
        TRY(read_number(r, &time, row->first, &f->t[f->n]));
        TRY(read_number(r, &factor, row->last, &f->value[f->n]));
        if (f->n > 0 && !(f->t[f->n] > f->t[f->n - 1]))
            return fault_report_at_node(r, row->first,
                                        "time %s is not later than the previous one; give times in ascending order",
                                        node_value_to_text_for_message(r, row->first));
        f->n++;
    }
    return OK;
}

/* ---- a CSV file -------------------------------------------------------------------------------------------------- */

enum { TIMES_MAX = 1000000, UNIT_LONGEST_NAME = 40 }; /* largest number of lines of a table; room for a unit [byte] */

/* Columns of time and values of a function in a CSV file, while it is read. */
struct time_columns {
    struct csv_file in;
    int time, value, all; /* indices from 0, -1: not found; number of all columns */
    char time_unit[UNIT_LONGEST_NAME], value_unit[UNIT_LONGEST_NAME]; /* "": none */
    enum unit unit;                                                   /* kind of unit of the values */
    const char *second;                                               /* name of another column of values; NULL: none */
};

/* Returns the kind of unit of the value of the boundary condition b. A file column that gives the variation of the
 * value in time may have a unit of this kind. */
static enum unit unit_of_boundary(const struct boundary *b)
{
    switch (b->kind) {
    case BOUNDARY_TRACTION:
    case BOUNDARY_PRESSURE:
        return UNIT_PRESSURE;
    case BOUNDARY_BODY_FORCE:
        return UNIT_BODY_FORCE;
    default:
        return b->rotates ? UNIT_RATE : b->displaces ? UNIT_LENGTH : UNIT_SPEED;
    }
}

/* Examines the name of column k in the header of a CSV file of a function of time. Stores k in c if the column is the
 * time, or the column of values called `wanted` (if that is "", the first column beside the time). name: name with
 * unit, modified. Returns REFUSED, with a message, if the unit does not fit, or if the time is given twice. */
static status column_take(struct time_columns *c, int k, char *name, const char *wanted)
{
    char what[160];
    real one;
    char *unit = csv_cut_unit_off_column_name(name), number[UNIT_LONGEST_NAME + 2];
    const bool time = strcasecmp(name, "time") == 0 || strcasecmp(name, "t") == 0;
    if (!time && *wanted && strcmp(name, wanted) != 0) return OK;
    if (strlen(unit) >= UNIT_LONGEST_NAME)
        return csv_report_fault(&c->in, name, "the unit in the header is too long; write a shorter one");
    if (time && c->time >= 0)
        return csv_report_fault(&c->in, name, "column %.40s is given twice; rename or remove one", name);
    if (!time && c->value >= 0) {
        c->second = name;
        return OK;
    }
    snprintf(number, sizeof number, "1 %s", unit);
    if (!number_parse_with_unit(&one, number, time ? UNIT_TIME : *unit ? c->unit : UNIT_NONE, false, what, sizeof what))
        return csv_report_fault(&c->in, unit, "column %.40s: [%s] %s", name, unit, what);
    snprintf(time ? c->time_unit : c->value_unit, UNIT_LONGEST_NAME, "%s", unit);
    *(time ? &c->time : &c->value) = k;
    return OK;
}

/* Finds the columns of time and value in the CSV file c from its header, the first line that is no comment. wanted:
 * name of the column of values; "": the only one beside the time. Returns REFUSED, with a message, if a column is
 * missing or ambiguous. */
static status time_columns_find(struct time_columns *c, const char *wanted)
{
    bool more;
    int k = 0;
    char *rest = c->in.text;
    c->time = c->value = -1;
    TRY(csv_read_data_line(&c->in, &more));
    if (!more)
        return status_set(REFUSED, "%s: the file is empty; begin with a header such as time [us], value", c->in.path);
    csv_detect_separator(&c->in);
    for (char *name; (name = csv_split_off_next_field(&c->in, &rest)) != NULL; k++)
        TRY(column_take(c, k, name, wanted));
    c->all = k;
    if (c->time < 0)
        return csv_report_fault(&c->in, c->in.text,
                                "no column is named time; begin with a header such as time [us], value");
    if (c->second)
        return csv_report_fault(&c->in, c->second,
                                "column %.40s is a second column of values; add column: NAME to choose one", c->second);
    if (c->value >= 0) return OK;
    if (*wanted)
        return csv_report_fault(&c->in, c->in.text, "the file has no column named %.40s; check the spelling", wanted);
    return csv_report_fault(&c->in, c->in.text,
                            "there is only one column; give time and value, separated by a comma, semicolon or tab");
}

static status time_number(const struct time_columns *c, const char *field, const char *unit_text, enum unit unit,
                          real *value)
{
    char text[100], what[160];
    if (strlen(field) > 50)
        return csv_report_fault(&c->in, field, "'%.20s..' is not a number; correct this line", field);
    snprintf(text, sizeof text, *unit_text ? "%s %s" : "%s", field, unit_text);
    if (number_parse_with_unit(value, text, unit, false, what, sizeof what)) return OK;
    return csv_report_fault(&c->in, field, "'%s' %s", field, what);
}

/* Reads the text `line` of a CSV file into entry f->n of the times f->t and the values f->value, without changing f->n.
 * c: columns of the file. Returns REFUSED, with a message, for a wrong number of values, for a text that is no number,
 * and for a time not later than the previous one. */
static status time_entry(const struct time_columns *c, char *line, struct time_function *f)
{
    int k = 0, found = 0;
    char *rest = line, *time = line;
    for (char *field; (field = csv_split_off_next_field(&c->in, &rest)) != NULL; k++) {
        if (k == c->all)
            return csv_report_fault(&c->in, field,
                                    "this line has more values than the %d columns of the header; write numbers with a "
                                    "decimal point, not a comma",
                                    c->all);
        if (k != c->time && k != c->value) continue;
        found++;
        if (k == c->time) {
            time = field;
            TRY(time_number(c, field, c->time_unit, UNIT_TIME, &f->t[f->n]));
        } else {
            TRY(time_number(c, field, c->value_unit, *c->value_unit ? c->unit : UNIT_NONE, &f->value[f->n]));
        }
    }
    if (found < 2)
        return csv_report_fault(&c->in, line,
                                "this line has %d values, but column %d is needed; add the missing values", k,
                                1 + (c->time > c->value ? c->time : c->value));
    if (f->n > 0 && !(f->t[f->n] > f->t[f->n - 1]))
        return csv_report_fault(&c->in, time,
                                "time %s is not later than the previous one; give times in ascending order", time);
    return OK;
}

static status time_entries(struct time_columns *c, struct time_function *f, const char *wanted)
{
    TRY(time_columns_find(c, wanted));
    for (bool more;; f->n++) {
        TRY(csv_read_data_line(&c->in, &more));
        if (!more) break;
        if (f->n == TIMES_MAX)
            return csv_report_fault(&c->in, c->in.text, "the file has more than %d times; remove some", TIMES_MAX);
        GROW("time table", f->t, f->n + 1);
        GROW("time table", f->value, f->n + 1);
        TRY(time_entry(c, c->in.text, f));
    }
    return f->n > 0 ? OK
                    : status_set(REFUSED, "%s: no line below the header has a time and a value; add some", c->in.path);
}

/* Reads the factor of time of the boundary condition b from the CSV file that `file: name` gives, with `column: name`
 * for the values. map: YAML node of `time`. Opens no file if r->files is false. Returns REFUSED, with a message, for
 * invalid keys or files. */
static status read_time_file(struct reader *r, const struct yaml_node *map, struct boundary *b)
{
    struct time_columns c = {.unit = unit_of_boundary(b)};
    const struct yaml_node *n = yaml_node_find(map, "file");
    const struct yaml_node *column = yaml_node_find(map, "column");
    if (!n) return fault_report_at_node(r, column, "has no effect without the key file; add file: NAME.csv");
    if (column && (column->kind != NODE_SCALAR || !*column->text || strlen(column->text) >= sizeof b->time_column))
        return fault_report_at_node(r, column,
                                    "%s is not the name of a column; give a name from the header of the file",
                                    node_value_to_text_for_message(r, column));
    if (column) snprintf(b->time_column, sizeof b->time_column, "%s", column->text);
    b->time.kind = TIME_TABLE;
    TRY(read_input_file_path(r, n, "a CSV file of time and value", &b->time_file, &b->time_contents));
    if (!r->files) return OK;
    TRY(csv_open(&c.in, b->time_file, "write one time and its value on each line"));
    status s = time_entries(&c, &b->time, b->time_column);
    csv_close(&c.in);
    b->time_unit = *c.value_unit != '\0';
    return s;
}

/* ---- functions of time ------------------------------------------------------------------------------------------- */

/* Reads the factor of time of the boundary condition `boundary`. function_node: YAML node of `time`; NULL or
 * `constant`: the factor is 1. Returns REFUSED, with a message, for an unknown form or invalid values. */
status read_time_function(struct reader *r, const struct yaml_node *function_node, struct boundary *boundary)
{
    static const char *const groups[] = {"boundary.time.step", "boundary.time.pulse", "boundary.time.ramp"};
    const char *forms = "constant, step, pulse, ramp, table or file";
    struct time_function *f = &boundary->time;
    if (!function_node || (function_node->kind == NODE_SCALAR && strcmp(function_node->text, "constant") == 0))
        return OK;
    if (function_node->kind != NODE_MAP)
        return fault_report_at_node(r, function_node, "%s is not a function of time; give %s",
                                    node_value_to_text_for_message(r, function_node), forms);
    TRY(check_mapping_keys_known_and_unique(r, function_node, "boundary.time"));
    if (yaml_node_find(function_node, "file") || yaml_node_find(function_node, "column")) {
        for (const struct yaml_node *other = function_node->first; other; other = other->next)
            if (word_index_in_list("file|column", other->key) < 0)
                return fault_report_at_node(r, other, "is given together with file; remove one of %s", forms);
        return read_time_file(r, function_node, boundary);
    }
    if (function_node->n != 1)
        return fault_report_at_node(r, function_node, "has %d keys; give one: %s", function_node->n, forms);
    const struct yaml_node *form = function_node->first;
    int kind = word_index_in_list("step|pulse|ramp", form->key);
    if (kind < 0) return read_table(r, form, f);
    f->kind = kind == 0 ? TIME_STEP : kind == 1 ? TIME_PULSE : TIME_RAMP;
    TRY(read_keys_of_group(r, form, form, groups[kind], f));
    return f->from < f->until
               ? OK
               : fault_report_at_node(r, form, "from is not earlier than until; exchange or correct the two times");
}
