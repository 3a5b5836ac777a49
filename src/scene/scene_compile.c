/* Adds steps to an expression that is compiled, and derives the units of the operands. Constants are folded. */
#include "scene_compile.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { POWER_MOST = 18 }; /* twice the largest power of a unit */

/* ---- complaints -------------------------------------------------------------------------------------------------- */

/* Returns the number, from 1, of the UTF-8 character at `character`, a pointer into c->text, for messages. */
int expression_position_of_character(const struct expression_compiler *c, const char *character)
{
    int characters = 1;
    for (const char *at = c->text; at < character; at++) characters += ((unsigned char)*at & 0xC0) != 0x80;
    return characters;
}

bool compile_write_fault_and_return_false(struct expression_compiler *c, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(c->what, c->room, format, arguments);
    va_end(arguments);
    return false;
}

struct unit_name_text quantity_unit_name(const struct quantity *q)
{
    struct unit_name_text n;
    unit_exponents_describe_kind_of_unit(q->twice, n.text, sizeof n.text);
    return n;
}

static bool same_unit(const struct quantity *a, const struct quantity *b)
{
    return memcmp(a->twice, b->twice, sizeof a->twice) == 0;
}

bool quantity_is_dimensionless(const struct quantity *q) { return same_unit(q, &(struct quantity){0}); }

/* ---- steps ------------------------------------------------------------------------------------------------------- */

/* Appends a step to the compiled expression c: the operation `op`, with the number `value` if it pushes a number.
 * Returns false, with a message in c->what, if the expression has EXPRESSION_STEPS steps already. */
static bool add_step(struct expression_compiler *c, enum expression_op op, real value)
{
    if (c->steps == EXPRESSION_STEPS)
        return compile_write_fault_and_return_false(c, "has more than %d numbers and operations; shorten it",
                                                    EXPRESSION_STEPS);
    c->step[c->steps++] = (struct expression_step){op, value};
    return true;
}

bool compile_append_step_that_pushes_operand(struct expression_compiler *c, enum expression_op operation,
                                             const struct quantity *q)
{
    if (c->operands == EXPRESSION_STACK)
        return compile_write_fault_and_return_false(
            c, "has more than %d unfinished operations; use fewer nested brackets", EXPRESSION_STACK);
    c->operand[c->operands++] = (struct operand){*q, operation == EXPRESSION_NUMBER};
    return add_step(c, operation, q->value);
}

struct operand *operand_stack_entry_from_top(struct expression_compiler *c, int entries_below_top)
{
    return &c->operand[c->operands - 1 - entries_below_top];
}

/* Applies the operation `operation` to the topmost operand, or to two of them for a binary operation: replaces these
 * operands by the result and appends a step to the expression. result_unit: unit of the result, which the caller
 * derives. If the operands are constant, evaluates the operation now and appends its value as a number instead. Returns
 * false, with a message in c, if the value is not finite or the expression is too long. */
bool compile_append_step_that_applies_operation(struct expression_compiler *c, enum expression_op operation,
                                                const struct quantity *result_unit)
{
    const bool two = expression_op_is_binary(operation);
    struct operand *a = operand_stack_entry_from_top(c, two), *b = operand_stack_entry_from_top(c, 0);
    const bool constant = a->constant && b->constant, bare = a->q.bare && b->q.bare;
    a->q.value = expression_op_apply(operation, a->q.value, b->q.value);
    memcpy(a->q.twice, result_unit->twice, sizeof a->q.twice);
    a->q.bare = bare;
    c->operands -= two;
    a->constant = constant;
    if (!constant) return add_step(c, operation, 0);
    c->steps -= two ? 2 : 1;
    if (!isfinite(a->q.value))
        return compile_write_fault_and_return_false(
            c, "has a part that is infinite or not a number; check its divisions and powers");
    return add_step(c, EXPRESSION_NUMBER, a->q.value);
}

/* Returns true if the operand o is a constant 0 written without a unit, which is compatible with every unit. */
static bool is_nothing(const struct operand *o) { return o->constant && o->q.bare && o->q.value == 0; }

/* Checks that the two topmost operands have the same unit; a 0 without a unit gets the unit of the other operand.
 * Returns true if they do. If the units differ, returns false with a message in c that names the operation
 * `operation_name` at position `operator_in_text` of c->text. */
bool compile_match_units_of_top_operands(struct expression_compiler *c, const char *operation_name,
                                         const char *operator_in_text)
{
    struct quantity *a = &operand_stack_entry_from_top(c, 1)->q, *b = &operand_stack_entry_from_top(c, 0)->q;
    if (is_nothing(operand_stack_entry_from_top(c, 1))) memcpy(a->twice, b->twice, sizeof a->twice);
    if (is_nothing(operand_stack_entry_from_top(c, 0))) memcpy(b->twice, a->twice, sizeof b->twice);
    if (same_unit(a, b)) return true;
    return compile_write_fault_and_return_false(
        c, "combines %s and %s by %s (character %d); give both operands the same unit", quantity_unit_name(a).text,
        quantity_unit_name(b).text, operation_name, expression_position_of_character(c, operator_in_text));
}

static bool unit_in_bounds(struct expression_compiler *c, const struct quantity *q)
{
    for (int k = 0; k < 3; k++)
        if (q->twice[k] > POWER_MOST || q->twice[k] < -POWER_MOST)
            return compile_write_fault_and_return_false(c, "has a unit with a power above %d; use lower powers",
                                                        POWER_MOST / 2);
    return true;
}

bool compile_append_negation(struct expression_compiler *c)
{
    const struct quantity unit = operand_stack_entry_from_top(c, 0)->q;
    return compile_append_step_that_applies_operation(c, EXPRESSION_MINUS, &unit);
}

bool compile_append_sum_or_difference(struct expression_compiler *c, char sign, const char *operator_in_text)
{
    const char word[2] = {sign, 0};
    if (!compile_match_units_of_top_operands(c, word, operator_in_text)) return false;
    const struct quantity unit = operand_stack_entry_from_top(c, 1)->q;
    return compile_append_step_that_applies_operation(c, sign == '+' ? EXPRESSION_ADD : EXPRESSION_SUBTRACT, &unit);
}

bool compile_append_product_or_quotient(struct expression_compiler *c, char sign, const char *operator_in_text)
{
    struct quantity unit = operand_stack_entry_from_top(c, 1)->q;
    const struct operand *b = operand_stack_entry_from_top(c, 0);
    for (int k = 0; k < 3; k++) unit.twice[k] += sign == '*' ? b->q.twice[k] : -b->q.twice[k];
    if (sign == '/' && b->constant && b->q.value == 0)
        return compile_write_fault_and_return_false(c, "divides by 0 (character %d); change the divisor",
                                                    expression_position_of_character(c, operator_in_text));
    return unit_in_bounds(c, &unit) &&
           compile_append_step_that_applies_operation(c, sign == '*' ? EXPRESSION_TIMES : EXPRESSION_OVER, &unit);
}

/* Raises *unit to the power `power`: multiplies the exponents of m, kg and s by the power. place: number of the
 * operator's character in the text, for the message. Returns false, with a message in c, if an exponent becomes neither
 * whole nor half, or twice the exponent exceeds POWER_MOST. */
static bool power_of_unit(struct expression_compiler *c, struct quantity *unit, real power, int place)
{
    for (int k = 0; k < 3; k++) {
        const real twice = unit->twice[k] * power;
        if (twice != floor(twice) || fabs(twice) > POWER_MOST)
            return compile_write_fault_and_return_false(c,
                                                        "raises %s (character %d) to a power whose unit cannot be "
                                                        "represented; use whole and half powers of m, kg and s",
                                                        quantity_unit_name(&operand_stack_entry_from_top(c, 1)->q).text,
                                                        place);
        unit->twice[k] = (int)twice;
    }
    return true;
}

/* Appends the operation a^b on the two topmost operands a, b. Returns false, with a message in c, if the exponent b has
 * a unit, or if a has a unit and b is not constant. operator_in_text: position of the operator in c->text. */
bool compile_append_power(struct expression_compiler *c, const char *operator_in_text)
{
    const struct operand *b = operand_stack_entry_from_top(c, 0);
    struct quantity unit = operand_stack_entry_from_top(c, 1)->q;
    const int place = expression_position_of_character(c, operator_in_text);
    const bool two = b->constant && b->q.value == 2;
    if (!quantity_is_dimensionless(&b->q))
        return compile_write_fault_and_return_false(c, "has %s as a power (character %d); give a plain number",
                                                    quantity_unit_name(&b->q).text, place);
    if (!quantity_is_dimensionless(&unit) && !b->constant)
        return compile_write_fault_and_return_false(
            c, "raises %s to a power that varies (character %d); use a constant power", quantity_unit_name(&unit).text,
            place);
    if (!quantity_is_dimensionless(&unit) && !power_of_unit(c, &unit, b->q.value, place)) return false;
    if (two) c->operands--, c->steps--; /* without the exponent 2 */
    return compile_append_step_that_applies_operation(c, two ? EXPRESSION_SQUARE : EXPRESSION_POWER, &unit);
}
