/* Reads the cost-accuracy table from text. */
#include "cost_accuracy.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "output/output_files.h"

static const char built_in[] =
#include "cost_accuracy_text.h" /* made from src/auto/cost_accuracy.csv by the Makefile: one string per line */
    ;

/* ---- lines ------------------------------------------------------------------------------------------------------- */

/* Takes the next column, up to a comma or the end of the line; false: too long or empty. */
static bool take_word(const char **at, char *word, size_t room)
{
    const size_t length = strcspn(*at, ",\n");
    if (length == 0 || length >= room) return false;
    memcpy(word, *at, length);
    word[length] = '\0';
    *at += length + ((*at)[length] == ',');
    return true;
}

static bool take_number(const char **at, real *value)
{
    char word[TABLE_WORD], *end;
    if (!take_word(at, word, sizeof word)) return false;
    *value = strtod(word, &end);
    return *end == '\0' && isfinite(*value) && *value >= 0;
}

static bool read_line(const char *line, struct cost_point *p)
{
    *p = (struct cost_point){0};
    return take_word(&line, p->problem, sizeof p->problem) && take_word(&line, p->at, sizeof p->at) &&
           take_word(&line, p->method, sizeof p->method) && take_number(&line, &p->resolution) &&
           take_number(&line, &p->horizon) && take_number(&line, &p->step) && take_number(&line, &p->error) &&
           take_number(&line, &p->seconds) && take_number(&line, &p->particles) && take_number(&line, &p->steps) &&
           take_word(&line, p->keys, sizeof p->keys) && *line == '\n' && p->resolution > 0 && p->step > 0 &&
           p->error > 0 && p->seconds > 0 && p->particles > 0;
}

status cost_accuracy_read_text(struct cost_accuracy *c, const char *text, const char *name)
{
    const size_t header = strlen(TABLE_HEADER);
    int lines = 0, room = 0;
    *c = (struct cost_accuracy){0};
    if (strncmp(text, TABLE_HEADER "\n", header + 1) != 0)
        return status_set(REFUSED,
                          "%s:1:1: no cost-accuracy table; a file as `cleave bench accuracy` writes it "
                          "(results/bench/cost_accuracy.csv) "
                          "is expected",
                          name);
    for (const char *at = text; (at = strchr(at, '\n')); at++) room++;
    c->point = NEW("auto.table", room, struct cost_point);
    for (const char *line = text + header + 1; *line; line = strchr(line, '\n') + 1, lines++) {
        if (read_line(line, &c->point[c->n])) {
            c->n++;
            continue;
        }
        cost_accuracy_free(c);
        return status_set(REFUSED, "%s:%d:1: no point of a cost-accuracy table; %s is expected", name, lines + 2,
                          TABLE_HEADER);
    }
    return OK;
}

status cost_accuracy_read(struct cost_accuracy *c, const char *path)
{
    char *text;
    size_t length;
    *c = (struct cost_accuracy){0};
    if (!path) return cost_accuracy_read_text(c, built_in, "src/auto/cost_accuracy.csv");
    if (!path_is_file(path))
        return status_set(REFUSED, "%s: no such file; a table as `cleave bench accuracy` writes it is expected", path);
    TRY(file_get(path, &text, &length));
    status s =
        strlen(text) == length && (length == 0 || text[length - 1] == '\n')
            ? cost_accuracy_read_text(c, text, path)
            : status_set(REFUSED, "%s: broken off; a table as `cleave bench accuracy` writes it is expected", path);
    memory_free(text);
    return s;
}

void cost_accuracy_free(struct cost_accuracy *c)
{
    memory_free(c->point);
    *c = (struct cost_accuracy){0};
}

/* ---- keys -------------------------------------------------------------------------------------------------------- */

bool cost_accuracy_key(const struct cost_point *p, const char *key, char *text, size_t room)
{
    const size_t length = strlen(key);
    for (const char *at = p->keys; *at; at += strcspn(at, ";"), at += *at == ';') {
        if (strncmp(at, key, length) != 0 || at[length] != '=') continue;
        snprintf(text, room, "%.*s", (int)strcspn(at + length + 1, ";"), at + length + 1);
        return true;
    }
    return false;
}

bool cost_point_has(const struct cost_point *p, const char *key, const char *value)
{
    char text[TABLE_WORD];
    return cost_accuracy_key(p, key, text, sizeof text) && strcmp(text, value) == 0;
}
