/* Reads expressions of scenes: sums of products of powers, functions, numbers with units, x, y, z, t and variables
 * of the scene. Units are derived while the text is read, so that a message about `x + t` names the position of the
 * fault. */
#include "scene_compile.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

enum { DEPTH_MOST = 24, NAME_MOST = 40 }; /* largest depth of brackets; room for a name [byte] */

/* Rules by which the unit of a function's value follows from its operands. PLAIN: operands and value have no unit.
 * KEEPS: unit of the operand. ROOT: square root of the operand's unit. FORGETS: no unit, whatever the unit of the
 * operand. SAME: the unit that all operands must have. ANGLE: no unit, from two operands of equal units. */
enum rule { PLAIN, KEEPS, ROOT, FORGETS, SAME, ANGLE };
/* A function of formulas: its name, operation, rule for units, and explanation for `cleave help expression`. */
struct function {
    const char *name;
    enum expression_op op;
    enum rule rule;
    const char *help;
};
/* All functions of formulas. */
static const struct function functions[] = {
    {"sin", EXPRESSION_SIN, PLAIN, ""},
    {"cos", EXPRESSION_COS, PLAIN, ""},
    {"tan", EXPRESSION_TAN, PLAIN, ""},
    {"asin", EXPRESSION_ASIN, PLAIN, ""},
    {"acos", EXPRESSION_ACOS, PLAIN, ""},
    {"atan", EXPRESSION_ATAN, PLAIN, ""},
    {"atan2", EXPRESSION_ATAN2, ANGLE, "atan2(y, x), angle of the point (x, y)"},
    {"sinh", EXPRESSION_SINH, PLAIN, ""},
    {"cosh", EXPRESSION_COSH, PLAIN, ""},
    {"tanh", EXPRESSION_TANH, PLAIN, ""},
    {"exp", EXPRESSION_EXP, PLAIN, ""},
    {"log", EXPRESSION_LOG, PLAIN, "natural"},
    {"sqrt", EXPRESSION_SQRT, ROOT, "of any quantity"},
    {"abs", EXPRESSION_ABS, KEEPS, "of any quantity"},
    {"floor", EXPRESSION_FLOOR, PLAIN, "largest whole number below"},
    {"min", EXPRESSION_MIN, SAME, "of two or more of one unit"},
    {"max", EXPRESSION_MAX, SAME, "of two or more of one unit"},
    {"sign", EXPRESSION_SIGN, FORGETS, "-1, 0 or 1, of any quantity"},
    {"step", EXPRESSION_STEP, FORGETS, "0 below 0, else 1, of any quantity: step(t - 2 us)"},
    {"ramp", EXPRESSION_RAMP, PLAIN, "0 below 0, 1 above 1, linear between: ramp(t/5us)"},
    {"pulse", EXPRESSION_PULSE, PLAIN, "sin^2(pi s) for 0 < s < 1, else 0: pulse(t/5us)"},
};

/* ---- text -------------------------------------------------------------------------------------------------------- */

/* Advances c->at, the position of the next character to compile, beyond blanks. */
static void skip(struct expression_compiler *c)
{
    while (*c->at == ' ' || *c->at == '\t' || *c->at == '\n') c->at++;
}

/* Appends the first `length` characters of `text` to c->kept, the text of the expression that scene.yaml contains.
 * Returns false, with a message in c, if c->kept becomes longer than EXPRESSION_TEXT characters. */
static bool keep(struct expression_compiler *c, const char *text, size_t length)
{
    if (c->used + length > EXPRESSION_TEXT)
        return compile_write_fault_and_return_false(c, "is longer than %d characters; shorten it", EXPRESSION_TEXT);
    memcpy(c->kept + c->used, text, length);
    c->used += length;
    c->kept[c->used] = '\0';
    return true;
}

/* Appends the part of the source text from c->copied, up to which it has been copied already, to `here` to c->kept, the
 * text of the expression in scene.yaml. Returns false, with a message in c, if c->kept becomes longer than
 * EXPRESSION_TEXT characters. */
static bool keep_to(struct expression_compiler *c, const char *here)
{
    const char *from = c->copied;
    c->copied = here;
    return keep(c, from, (size_t)(here - from));
}

/* Appends the value q of a variable, in brackets, to c->kept (the text for scene.yaml) in place of its name. word:
 * beginning of the name in the source text; the name ends at c->at. Returns false, with a message in c, if c->kept
 * becomes longer than EXPRESSION_TEXT characters. */
static bool keep_value(struct expression_compiler *c, const char *word, const struct quantity *q)
{
    char number[32], unit[200], text[240];
    unit_exponents_write_as_text(q->twice, unit, sizeof unit);
    snprintf(text, sizeof text, "(%s%s)", number_write_shortest_exact_decimal(number, q->value), unit);
    if (!keep_to(c, word)) return false;
    c->copied = c->at;
    return keep(c, text, strlen(text));
}

/* Returns the length of the name at the beginning of the text c: letters, digits and _, no digit first; 0 if there is
 * none. */
static size_t name_length(const char *c)
{
    size_t n = 0;
    while (isalpha((unsigned char)c[n]) || c[n] == '_' || (n > 0 && isdigit((unsigned char)c[n]))) n++;
    return n;
}

/* Writes to c->what the message that `expected`, such as a number, is missing at c->at, where the text ends or
 * continues with something else. Returns false. */
static bool missing(struct expression_compiler *c, const char *expected)
{
    if (*c->at == '\0')
        return compile_write_fault_and_return_false(c, "ends where %s is expected%s", expected,
                                                    c->depth > 0 ? " (in a list, put a formula with a comma in quotes)"
                                                                 : "");
    size_t length = name_length(c->at);
    if (length == 0) length = 1;
    while (((unsigned char)c->at[length] & 0xC0) == 0x80) length++;
    return compile_write_fault_and_return_false(c, "has %.*s at character %d, where %s is expected",
                                                (int)(length < 30 ? length : 30), c->at,
                                                expression_position_of_character(c, c->at), expected);
}

/* ---- grammar ----------------------------------------------------------------------------------------------------- */

/* Compiles a sum from the text of c, and returns false, with a message in c, if it is invalid. It is defined below, and
 * declared here because a factor may be a sum in brackets. */
static bool compile_sum(struct expression_compiler *c);

static bool deeper(struct expression_compiler *c, int levels)
{
    if (c->depth + levels <= DEPTH_MOST) return true;
    return compile_write_fault_and_return_false(c, "is nested deeper than %d levels; use fewer brackets", DEPTH_MOST);
}

static bool compile_brackets(struct expression_compiler *c)
{
    c->at++;
    c->depth++;
    if (!deeper(c, 0) || !compile_sum(c)) return false;
    if (*c->at != ')') return missing(c, "an operation or )");
    c->depth--;
    c->at++;
    return true;
}

static bool apply_function(struct expression_compiler *c, const struct function *f, const char *at)
{
    struct quantity unit = operand_stack_entry_from_top(c, 0)->q;
    const bool two = f->rule == SAME || f->rule == ANGLE;
    if (two && !compile_match_units_of_top_operands(c, f->name, at)) return false;
    if (two) unit = operand_stack_entry_from_top(c, 1)->q;
    if (f->rule == PLAIN && !quantity_is_dimensionless(&unit))
        return compile_write_fault_and_return_false(
            c, "applies %s to %s (character %d); give a plain number, such as (t/5us)", f->name,
            quantity_unit_name(&unit).text, expression_position_of_character(c, at));
    for (int k = 0; k < 3 && f->rule != KEEPS && f->rule != SAME; k++) {
        if (f->rule == ROOT && unit.twice[k] % 2 != 0)
            return compile_write_fault_and_return_false(
                c, "takes the square root of %s (character %d), whose unit has no square root; change the operand",
                quantity_unit_name(&unit).text, expression_position_of_character(c, at));
        unit.twice[k] = f->rule == ROOT ? unit.twice[k] / 2 : 0;
    }
    return compile_append_step_that_applies_operation(c, f->op, &unit);
}

/* Compiles a call of the function f with its operands in brackets; c->at must be at the opening bracket. min and max
 * take two operands or more. at: position of the function's name, for messages. Returns false, with a message in c, if
 * the call is invalid. */
static bool compile_call(struct expression_compiler *c, const struct function *f, const char *at)
{
    const bool two = f->rule == SAME || f->rule == ANGLE;
    int given = 0;
    c->depth++;
    do {
        c->at++;
        if (!deeper(c, 0) || !compile_sum(c)) return false;
        given++;
        if (two && given > 1 && !apply_function(c, f, at)) return false;
    } while (*c->at == ',' && two && (f->rule == SAME || given < 2));
    if (two && given < 2) return missing(c, "a comma and another operand");
    if (*c->at != ')') return missing(c, "an operation or )");
    c->at++;
    c->depth--;
    return two || apply_function(c, f, at);
}

static const struct function *function_named(const char *name)
{
    for (size_t k = 0; k < COUNT_OF(functions); k++)
        if (strcmp(functions[k].name, name) == 0) return &functions[k];
    return NULL;
}

/* Compiles the variable `name`: x, y, z or t. Returns false, with a message in c, if the key does not allow it or the
 * space has no such coordinate. */
static bool compile_coordinate(struct expression_compiler *c, char name)
{
    struct quantity q = {.twice = {2, 0, 0}};
    if (name == 't') q.twice[0] = 0, q.twice[2] = 2;
    if (!(c->of & (name == 't' ? EXPRESS_TIME : EXPRESS_SPACE)))
        return compile_write_fault_and_return_false(c, "contains %c, on which this key cannot depend; remove it", name);
    if (name != 't' && name - 'x' >= c->r->dim)
        return compile_write_fault_and_return_false(c, "contains %c, but space %s has no such coordinate; remove it",
                                                    name, space_names[c->r->scene->space]);
    return compile_append_step_that_pushes_operand(
        c, name == 't' ? EXPRESSION_T : (enum expression_op)(EXPRESSION_X + name - 'x'), &q);
}

static bool compile_variable(struct expression_compiler *c, const char *name, const char *at)
{
    const struct quantity *q = variable_get_value_by_name(c->r, name, c->what, c->room);
    if (!q) return false;
    return deeper(c, 2) && keep_value(c, at, q) && compile_append_step_that_pushes_operand(c, EXPRESSION_NUMBER, q);
}

bool text_is_formula_variable(const char *text) { return strlen(text) == 1 && strchr("xyzt", *text); }

static bool compile_name(struct expression_compiler *c)
{
    struct quantity q = {.value = 3.14159265358979323846, .bare = true};
    const char *at = c->at;
    const size_t length = name_length(at);
    char name[NAME_MOST + 1];
    if (length > NAME_MOST)
        return compile_write_fault_and_return_false(c, "has a name of more than %d letters; shorten it", NAME_MOST);
    snprintf(name, sizeof name, "%.*s", (int)length, at);
    c->at += length;
    skip(c);
    const struct function *f = function_named(name);
    if (*c->at == '(' && f) return compile_call(c, f, at);
    if (*c->at == '(')
        return compile_write_fault_and_return_false(
            c, "has an unknown function %s (character %d); see `cleave help expression`", name,
            expression_position_of_character(c, at));
    if (f) return missing(c, "( and an operand");
    if (text_is_formula_variable(name)) return compile_coordinate(c, *name);
    if (strcmp(name, "pi") == 0) return compile_append_step_that_pushes_operand(c, EXPRESSION_NUMBER, &q);
    c->at = at + length;
    return quantity_read_unit_symbol(&q, name) == length
               ? compile_append_step_that_pushes_operand(c, EXPRESSION_NUMBER, &q)
               : compile_variable(c, name, at);
}

/* Compiles the number at c->at with its unit. power: true for an exponent, where a number has no unit. Returns false,
 * with a message in c, if there is no number or its unit is unknown. */
static bool compile_number(struct expression_compiler *c, bool power)
{
    struct quantity q;
    const char *why = NULL;
    const size_t length = quantity_read_at_start_of_text(&q, c->at, !power, &why);
    if (length == 0)
        return compile_write_fault_and_return_false(c, "has no valid number at character %d: %s",
                                                    expression_position_of_character(c, c->at), why);
    c->at += length;
    const char *rest = c->at + strspn(c->at, " ");
    const int letters = (int)name_length(rest);
    if (letters == 0) return compile_append_step_that_pushes_operand(c, EXPRESSION_NUMBER, &q);
    return compile_write_fault_and_return_false(
        c, "has an unknown unit %.*s (character %d); write an operation, such as *, between a number and a name",
        letters < 30 ? letters : 30, rest, expression_position_of_character(c, rest));
}

/* Compiles the operand that begins at c->at: a number, a variable, a function call or an expression in brackets. power:
 * true in an exponent, where a number has no unit. Returns false, with a message in c->what, if none of these begins
 * there. */
static bool compile_primary(struct expression_compiler *c, bool power)
{
    struct quantity q;
    skip(c);
    if (*c->at == '(') return compile_brackets(c);
    if (name_length(c->at)) return compile_name(c);
    if (isdigit((unsigned char)*c->at) || *c->at == '.') return compile_number(c, power);
    const size_t unit = quantity_read_unit_symbol(&q, c->at); /* the sign micro is no ASCII letter */
    c->at += unit;
    return unit ? compile_append_step_that_pushes_operand(c, EXPRESSION_NUMBER, &q) : missing(c, "a number");
}

/* Compiles an operand and the exponent that follows it, if any. Powers are right-associative: a^b^c is a^(b^c). An
 * exponent may have a sign. power: true if the operand is itself an exponent. Returns false, with a message in c->what,
 * if the text is invalid. */
static bool compile_power(struct expression_compiler *c, bool power)
{
    if (!compile_primary(c, power)) return false;
    skip(c);
    if (*c->at != '^') return true;
    const char *at = c->at++;
    skip(c);
    const bool minus = *c->at == '-';
    if (minus) c->at++;
    c->depth++;
    if (!deeper(c, 0) || !compile_power(c, true)) return false;
    c->depth--;
    return (!minus || compile_append_negation(c)) && compile_append_power(c, at);
}

static bool compile_product(struct expression_compiler *c)
{
    skip(c);
    const bool minus = *c->at == '-';
    if (minus || *c->at == '+') c->at++;
    if (!compile_power(c, false)) return false;
    if (minus && !compile_append_negation(c)) return false;
    for (skip(c); *c->at == '*' || *c->at == '/'; skip(c)) {
        const char *at = c->at++;
        skip(c);
        const bool negative = *c->at == '-';
        if (negative) c->at++;
        if (!compile_power(c, false) || (negative && !compile_append_negation(c)) ||
            !compile_append_product_or_quotient(c, *at, at))
            return false;
    }
    return true;
}

static bool compile_sum(struct expression_compiler *c)
{
    if (!compile_product(c)) return false;
    for (skip(c); *c->at == '+' || *c->at == '-'; skip(c)) {
        const char *at = c->at++;
        if (!compile_product(c) || !compile_append_sum_or_difference(c, *at, at)) return false;
    }
    return true;
}

/* Compiles the whole text c->text into steps, and checks that nothing follows the expression. Afterwards c->operand[0]
 * has the unit of the result. Returns false, with a message in c, if the expression is invalid. */
static bool compile_text(struct expression_compiler *c)
{
    c->at = c->copied = c->text;
    if (strlen(c->text) > EXPRESSION_TEXT)
        return compile_write_fault_and_return_false(c, "is longer than %d characters; shorten it", EXPRESSION_TEXT);
    if (!compile_sum(c)) return false;
    return *c->at == '\0' ? keep_to(c, c->at) : missing(c, "an operation");
}

/* ---- for the reader ---------------------------------------------------------------------------------------------- */

/* Evaluates an expression without x, y, z and t, and stores its value and unit in *q. Returns false if it is invalid,
 * with the fault in message[capacity] as the rest of a sentence that begins with `text`. */
bool quantity_evaluate_expression_text(struct reader *r, const char *text, struct quantity *q, char *message,
                                       size_t capacity)
{
    struct expression_compiler c = {.r = r, .text = text, .what = message, .room = capacity};
    if (!compile_text(&c)) return false;
    *q = c.operand[0].q;
    return true;
}

/* Reads the value of YAML node n, of the form `1/3 mm`, as a constant expression e in the unit of key k (of input
 * files): 1/3 of a mm, as in keys without formulas. As a formula it would mean 1/(3 mm). Returns false if the text has
 * another form. */
static bool number_constant(const struct yaml_node *n, const struct key *k, struct expression *e)
{
    char what[256];
    real value;
    if (!number_parse_with_unit(&value, n->text, k->unit, false, what, sizeof what)) return false;
    expression_make_constant(e, value, n->text);
    return true;
}

status read_expression(struct reader *r, const struct key *k, const struct yaml_node *n, unsigned allowed_variables,
                       struct expression *expression)
{
    char what[256];
    struct expression_compiler c = {
        .r = r, .of = allowed_variables, .text = n->text, .what = what, .room = sizeof what};
    const struct unit_row *unit = &unit_rows[k->unit];
    if (n->kind != NODE_SCALAR)
        return fault_report_at_node(r, n, "%s is not an expression; give %s, such as %s",
                                    node_value_to_text_for_message(r, n), unit->name, unit->example);
    if (number_constant(n, k, expression)) return OK;
    if (!compile_text(&c)) return fault_report_at_node(r, n, "%s %s", node_value_to_text_for_message(r, n), what);
    const struct operand *result = &c.operand[0];
    if (!quantity_unit_is_of_kind_or_absent(&result->q, k->unit, what, sizeof what) ||
        (result->constant && !value_is_in_unit_bounds(result->q.value, k->unit, what, sizeof what)))
        return fault_report_at_node(r, n, "%s %s", node_value_to_text_for_message(r, n), what);
    expression_make(expression, c.step, c.steps, c.kept);
    return OK;
}

bool text_looks_like_expression(const struct reader *r, const char *text)
{
    const char *c = text + (*text == '-' || *text == '+');
    if (strpbrk(c, "()*+")) return true;
    return name_length(c) > 0 && (r->variables > 0 || strpbrk(c, "/^-"));
}

const char *reserved_expression_word_get_meaning(const char *word)
{
    struct quantity q;
    if (function_named(word)) return "the name of a function";
    if (text_is_formula_variable(word)) return *word == 't' ? "the time" : "a coordinate";
    if (strcmp(word, "pi") == 0 || strcmp(word, "inf") == 0) return "a number";
    const size_t length = strlen(word), digit = length > 1 && strchr("23", word[length - 1]) ? 1 : 0;
    return quantity_read_unit_symbol(&q, word) == length - digit ? "a unit" : NULL;
}

void scene_print_expression_syntax(FILE *out)
{
    fputs("Expressions: wherever a scene has a number, and as loads that vary in space and time.\n\n"
          "    variables: {a: 3 mm, n: 4, b: 2*a + 1 mm, E: 190 GPa, nu: 0.3}\n"
          "    particles: {spacing: a/n}\n"
          "    12 MPa * exp(-(t/3us)^2)        22 m/s * sin(2*pi*x/10 mm)        E/(2*(1 + nu))\n\n"
          "  + - * / ^ ( )    as usual: -2^2 is -4, 2^3^2 is 2^9\n"
          "  numbers          with a unit behind them, which belongs to the number: x/10 mm is x/(10 mm)\n"
          "  units            also alone: x/mm; `cleave help units` lists them\n"
          "  x y z t          coordinates of the undeformed body and the time, in keys that say so\n"
          "  pi, 30 deg       3.14159.., an angle\n"
          "  names            of `variables`, in any order: letters, digits and _, but no unit, function or\n"
          "                   coordinate\n\n"
          "Functions, of a plain number unless they say otherwise; angles are in radians:\n",
          out);
    fputs(" ", out);
    for (size_t k = 0; k < COUNT_OF(functions); k++)
        if (!*functions[k].help) fprintf(out, " %s", functions[k].name);
    fputs("\n", out);
    for (size_t k = 0; k < COUNT_OF(functions); k++)
        if (*functions[k].help) fprintf(out, "  %-8s %s\n", functions[k].name, functions[k].help);
    fputs("\nUnits are checked: lengths add to lengths, exp takes a plain number, the result has the unit of its key.\n"
          "Numbers without a unit are SI only if none in the expression has one; a 0 fits everything.\n",
          out);
}
