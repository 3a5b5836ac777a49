/* Evaluates expressions of the input file that have been compiled to a list of operations. */
#include "data/expression.h"

#include <math.h>

#include "base/memory.h"

static const real pi = 3.14159265358979323846;

/* Returns a, limited to 0 .. 1. */
static real ramp_of(real a) { return a <= 0 ? 0 : a >= 1 ? 1 : a; }

/* Returns sin^2(pi a) for 0 < a < 1, else 0: the function `pulse` of expressions, a load that rises and falls
 * smoothly. */
static real pulse_at(real a) { return a > 0 && a < 1 ? square(sin(pi * a)) : 0; }

/* Returns the value of the operation `op` of an expression with its only operand a. */
static real one_operand(enum expression_op op, real a)
{
    switch (op) {
    case EXPRESSION_MINUS:
        return -a;
    case EXPRESSION_SQUARE:
        return a * a;
    case EXPRESSION_SIN:
        return sin(a);
    case EXPRESSION_COS:
        return cos(a);
    case EXPRESSION_TAN:
        return tan(a);
    case EXPRESSION_ASIN:
        return asin(a);
    case EXPRESSION_ACOS:
        return acos(a);
    case EXPRESSION_ATAN:
        return atan(a);
    case EXPRESSION_SINH:
        return sinh(a);
    case EXPRESSION_COSH:
        return cosh(a);
    case EXPRESSION_TANH:
        return tanh(a);
    case EXPRESSION_EXP:
        return exp(a);
    case EXPRESSION_LOG:
        return log(a);
    case EXPRESSION_SQRT:
        return sqrt(a);
    case EXPRESSION_ABS:
        return fabs(a);
    case EXPRESSION_FLOOR:
        return floor(a);
    case EXPRESSION_SIGN:
        return a > 0 ? 1 : a < 0 ? -1 : 0;
    case EXPRESSION_STEP:
        return a >= 0 ? 1 : 0;
    case EXPRESSION_RAMP:
        return ramp_of(a);
    default:
        return pulse_at(a);
    }
}

real expression_op_apply(enum expression_op op, real a, real b)
{
    switch (op) {
    case EXPRESSION_ADD:
        return a + b;
    case EXPRESSION_SUBTRACT:
        return a - b;
    case EXPRESSION_TIMES:
        return a * b;
    case EXPRESSION_OVER:
        return a / b;
    case EXPRESSION_POWER:
        return pow(a, b);
    case EXPRESSION_ATAN2:
        return atan2(a, b);
    case EXPRESSION_MIN:
        return real_min(a, b);
    case EXPRESSION_MAX:
        return real_max(a, b);
    default:
        return one_operand(op, a);
    }
}

/* Returns the value of a step of an expression that has no operands: a number, the time t [s], or a coordinate of the
 * position X[dim] [m]. The coordinate is 0 if X is NULL or has no such component. */
static real leaf(const struct expression_step *step, const real *X, int dim, real t)
{
    if (step->op == EXPRESSION_NUMBER) return step->value;
    if (step->op == EXPRESSION_T) return t;
    const int d = (int)step->op - EXPRESSION_X;
    return X && d < dim ? X[d] : 0;
}

real expression_evaluate(const struct expression *e, const real *X, int dim, real t)
{
    real stack[EXPRESSION_STACK + 1];
    int top = -1;
    for (const struct expression_step *step = e->step, *end = step + e->n; step < end; step++) {
        if (expression_op_has_no_operands(step->op)) {
            stack[++top] = leaf(step, X, dim, t);
        } else if (expression_op_is_binary(step->op)) {
            top--;
            stack[top] = expression_op_apply(step->op, stack[top], stack[top + 1]);
        } else {
            stack[top] = one_operand(step->op, stack[top]);
        }
    }
    return top == 0 ? stack[0] : NAN;
}

void expression_make(struct expression *e, const struct expression_step *steps, int step_count, const char *text)
{
    const size_t length = strlen(text) + 1;
    *e = (struct expression){.n = step_count,
                             .step = NEW("expression", step_count, struct expression_step),
                             .text = NEW("expression", length, char)};
    array_copy(e->step, steps, step_count, sizeof *steps);
    memcpy(e->text, text, length);
    for (int k = 0; k < step_count; k++) {
        e->in_time |= steps[k].op == EXPRESSION_T;
        e->in_space |= expression_op_has_no_operands(steps[k].op) && steps[k].op != EXPRESSION_NUMBER &&
                       steps[k].op != EXPRESSION_T;
    }
}

void expression_make_constant(struct expression *e, real value, const char *text)
{
    expression_make(e, &(struct expression_step){EXPRESSION_NUMBER, value}, 1, text);
}

void expression_free(struct expression *e)
{
    memory_free(e->step);
    memory_free(e->text);
    *e = (struct expression){0};
}
