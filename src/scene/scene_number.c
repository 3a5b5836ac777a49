/* Reads numbers of a scene: plain ones, expressions, and the variables in expressions. */
#include "scene_internal.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

enum { CHAIN_MOST = 32, NAME_LONGEST = 40 }; /* largest number of variables in a chain; longest name [byte] */

/* A variable of a scene. */
struct variable {
    const struct yaml_node *n;           /* node whose key is the name of the variable */
    struct quantity q;                   /* value, if `state` is KNOWN */
    enum { WAITING, OPEN, KNOWN } state; /* not evaluated; being evaluated; evaluated */
};

/* ---- variables --------------------------------------------------------------------------------------------------- */

/* Evaluates the variable v of the scene, after the variables on which it depends, and stores its value in v->q. Returns
 * false on failure, with the fault in message[capacity], as the rest of a sentence that begins with the text of the
 * variable. */
static bool evaluate(struct reader *r, struct variable *v, char *message, size_t capacity)
{
    bool fine = true;
    if (v->state == KNOWN) return true;
    if (v->state == OPEN || r->variables_open == CHAIN_MOST) {
        snprintf(message, capacity,
                 v->state == OPEN
                     ? "depends on itself, directly or through other variables; change one of them"
                     : "depends on other variables through a chain of more than %d variables; shorten the chain",
                 CHAIN_MOST);
        return false;
    }
    v->state = OPEN;
    r->variables_open++;
    if (!quantity_parse(&v->q, v->n->text))
        fine = quantity_evaluate_expression_text(r, v->n->text, &v->q, message, capacity);
    r->variables_open--;
    v->state = KNOWN;
    if (!fine || value_is_in_unit_bounds(v->q.value, UNIT_NONE, message, capacity)) return fine;
    message[strcspn(message, ";")] = '\0'; /* a variable has no key, and so no expected unit to name */
    return false;
}

static struct variable *variable_nearest(struct reader *r, const char *name)
{
    struct variable *nearest = r->variable;
    for (struct variable *v = r->variable; v < r->variable + r->variables; v++) {
        if (strcmp(v->n->key, name) == 0) return v;
        const bool own = v->state == OPEN;
        if (!own && (nearest->state == OPEN || edit_distance(v->n->key, name) < edit_distance(nearest->n->key, name)))
            nearest = v;
    }
    return nearest;
}

const struct quantity *variable_get_value_by_name(struct reader *r, const char *name, char *message, size_t capacity)
{
    char why[200];
    if (r->variables == 0) {
        snprintf(message, capacity,
                 "has an unknown name %.40s, and the scene has no variables; define it by the key variables", name);
        return NULL;
    }
    struct variable *v = variable_nearest(r, name);
    if (strcmp(v->n->key, name) != 0) {
        snprintf(message, capacity, "has an unknown name %.40s; did you mean the variable %.40s?", name, v->n->key);
        return NULL;
    }
    if (evaluate(r, v, why, sizeof why)) return &v->q;
    const bool further = strncmp(why, "needs ", 6) == 0; /* the last variable of a chain is the one with the fault */
    snprintf(message, capacity, "%s%.40s%s%s", further ? "" : "needs ", further ? "" : name, further ? "" : ", which ",
             why);
    return NULL;
}

static bool is_letter(char c) { return isalnum((unsigned char)c) || c == '_'; }

/* Returns REFUSED, with a message, if the key of YAML node n cannot name a variable: it is not made of letters, digits
 * and _ with a letter first, is longer than NAME_LONGEST, or has a meaning in expressions. */
static status check_variable_name(struct reader *r, const struct yaml_node *n)
{
    size_t length = 0;
    while (is_letter(n->key[length])) length++;
    if (length == 0 || length > NAME_LONGEST || n->key[length] || isdigit((unsigned char)*n->key))
        return fault_report_at_node(
            r, n, "cannot be the name of a variable; use up to %d letters, digits and _, and begin with a letter",
            NAME_LONGEST);
    const char *meaning = reserved_expression_word_get_meaning(n->key);
    return meaning ? fault_report_at_node(r, n, "means %s in expressions; choose another name, such as %.20s1", meaning,
                                          n->key)
                   : OK;
}

/* Returns true if `text` contains `name` as a whole word, not only as a part of a longer word. */
static bool has_word(const char *text, const char *name)
{
    const size_t length = strlen(name);
    for (const char *at = text; (at = strstr(at, name)); at++) {
        const bool begins = at == text || !is_letter(at[-1]);
        if (begins && !is_letter(at[length])) return true;
    }
    return false;
}

/* Returns true if a value in the tree below n, other than that of the node `variable` itself, contains the name of the
 * variable. */
static bool is_used(const struct yaml_node *n, const struct yaml_node *variable)
{
    if (n->kind == NODE_SCALAR) return n != variable && has_word(n->text, variable->key);
    for (const struct yaml_node *c = n->first; c; c = c->next)
        if (is_used(c, variable)) return true;
    return false;
}

/* Returns REFUSED, with a message, if an override sets a variable that no value of the scene contains: a misspelt name
 * would have no effect. root: YAML tree of the input file (scene). */
static status check_overrides(struct reader *r, const struct yaml_node *root)
{
    for (const struct variable *v = r->variable; v < r->variable + r->variables; v++) {
        if (v->n->origin < 0 || is_used(root, v->n)) continue;
        const struct variable *nearest = NULL;
        for (const struct variable *other = r->variable; other < r->variable + r->variables; other++)
            if (other->n->origin < 0 &&
                (!nearest || edit_distance(other->n->key, v->n->key) < edit_distance(nearest->n->key, v->n->key)))
                nearest = other;
        return fault_report_at_node(r, v->n, "no value of the scene uses this variable; %s%s%s",
                                    nearest ? "did you mean " : "see `cleave help variables`",
                                    nearest ? nearest->n->key : "", nearest ? "?" : "");
    }
    return OK;
}

status read_and_evaluate_variables(struct reader *r, const struct yaml_node *root)
{
    const struct key *k = key_find("", "variables");
    const struct yaml_node *map = yaml_node_find(root, k->path);
    char what[256];
    r->variables = 0;
    if (!map || (map->kind == NODE_SCALAR && *map->text == '\0')) return OK;
    TRY(check_node_kind(r, map, NODE_MAP, "give a mapping such as {a: 3 mm, b: 2*a}"));
    if (map->n > k->range.most)
        return fault_report_at_node(r, map, "has %d variables; give at most %g", map->n, k->range.most);
    r->variable = arena_allocate_zeroed(r, (size_t)(map->n + 1) * sizeof *r->variable);
    for (const struct yaml_node *n = map->first; n; n = n->next) {
        TRY(check_variable_name(r, n));
        TRY(check_node_kind(r, n, NODE_SCALAR, "give a number or an expression"));
        TRY(check_key_given_once(r, map, n));
        r->variable[r->variables++] = (struct variable){.n = n};
    }
    for (struct variable *v = r->variable; v < r->variable + r->variables; v++)
        if (!evaluate(r, v, what, sizeof what))
            return fault_report_at_node(r, v->n, "%s %s", node_value_to_text_for_message(r, v->n), what);
    return check_overrides(r, root);
}

/* ---- numbers ----------------------------------------------------------------------------------------------------- */

/* Reads a number, or an expression of variables, from `text` into *value [SI]. kind_of_unit: expected kind of unit;
 * allow_infinity: true if inf is allowed. Returns false if the text is invalid, with the fault in message[capacity] as
 * the rest of a sentence that begins with `text`. */
bool number_evaluate_text(struct reader *r, real *value, const char *text, enum unit kind_of_unit, bool allow_infinity,
                          char *message, size_t capacity)
{
    char other[256];
    struct quantity q;
    if (number_parse_with_unit(value, text, kind_of_unit, allow_infinity, message, capacity)) return true;
    const bool known = quantity_evaluate_expression_text(r, text, &q, other, sizeof other);
    if (known && kind_of_unit == UNIT_ANGLE && q.bare) { /* a bare 30 could be degrees */
        snprintf(message, capacity, "has no unit; give %s, such as %s", unit_rows[kind_of_unit].name,
                 unit_rows[kind_of_unit].example);
        return false;
    }
    if (known && quantity_unit_is_of_kind_or_absent(&q, kind_of_unit, other, sizeof other) &&
        value_is_in_unit_bounds(q.value, kind_of_unit, other, sizeof other)) {
        *value = q.value;
        return true;
    }
    if (text_looks_like_expression(r, text)) snprintf(message, capacity, "%s", other);
    return false;
}

void message_suggest_length_as_number_of_spacings(struct reader *r, const struct key *k, const char *text,
                                                  char *message, size_t capacity)
{
    char other[256];
    real length;
    if (k->unit != UNIT_NONE || !k->help || !strstr(k->help, "in spacings")) return;
    if (!number_evaluate_text(r, &length, text, UNIT_LENGTH, false, other, sizeof other)) return;
    if (!(r->scene->spacing > 0)) {
        snprintf(message, capacity, "is a length; give a plain number, the length in spacings");
        return;
    }
    snprintf(message, capacity, "is a length; give it in spacings, here %s: %.4g%s", key_get_last_name_of_path(k),
             length / r->scene->spacing, strcmp(key_get_last_name_of_path(k), "horizon") ? "" : " (3.015 is usual)");
}
