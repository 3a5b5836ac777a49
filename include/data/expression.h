/* Compiled expressions of x, y, z and t: lists of steps that are evaluated with a small stack. The reader of input
 * files compiles expressions and checks their units (scene_expression.c); loads and fields evaluate them. */
#ifndef CLEAVE_EXPRESSION
#define CLEAVE_EXPRESSION

#include "base/base.h"

/* Operations of a compiled formula, on a stack of numbers. */
enum expression_op {
    EXPRESSION_NUMBER, /* push a number */
    EXPRESSION_X,
    EXPRESSION_Y,
    EXPRESSION_Z,
    EXPRESSION_T, /* push a component of X, or t */
    EXPRESSION_MINUS,
    EXPRESSION_SQUARE,
    EXPRESSION_SIN,
    EXPRESSION_COS,
    EXPRESSION_TAN,
    EXPRESSION_ASIN,
    EXPRESSION_ACOS,
    EXPRESSION_ATAN,
    EXPRESSION_SINH,
    EXPRESSION_COSH,
    EXPRESSION_TANH,
    EXPRESSION_EXP,
    EXPRESSION_LOG,
    EXPRESSION_SQRT,
    EXPRESSION_ABS,
    EXPRESSION_FLOOR,
    EXPRESSION_SIGN,
    EXPRESSION_STEP,
    EXPRESSION_RAMP,
    EXPRESSION_PULSE, /* replace the topmost value */
    EXPRESSION_ADD,
    EXPRESSION_SUBTRACT,
    EXPRESSION_TIMES,
    EXPRESSION_OVER,
    EXPRESSION_POWER,
    EXPRESSION_ATAN2,
    EXPRESSION_MIN,
    EXPRESSION_MAX /* replace the two topmost values */
};

enum { EXPRESSION_STACK = 32, EXPRESSION_STEPS = 400 }; /* largest stack and largest number of steps */

/* One step of a compiled expression, with the operation op: it pushes a value on a stack, or replaces the topmost one
 * or two values by a result. */
struct expression_step {
    enum expression_op op;
    real value; /* value of a NUMBER [SI] */
};

/* A compiled expression of x, y, z and t: the steps step[n], evaluated on a stack; n = 0: there is no expression. text:
 * source of the expression with its units, in which variables of the scene are replaced by their values; compiling
 * `text` gives an equal expression. */
struct expression {
    int n;
    struct expression_step *step;
    char *text;
    bool in_space, in_time; /* contains x, y or z; contains t */
};

/* Creates the expression e from a copy of steps[step_count], its steps in the order of evaluation on a stack, and a
 * copy of `text`, the source from which it was compiled. Release with expression_free. */
void expression_make(struct expression *e, const struct expression_step *steps, int step_count, const char *text);

/* Creates in *e an expression that is the constant `value` (SI units), with a copy of its text `text`. Release with
 * expression_free. */
void expression_make_constant(struct expression *e, real value, const char *text);

/* Releases the steps and the text of the expression e. */
void expression_free(struct expression *e);

/* Returns the value (SI units) of the expression e at the position X (dim components [m]) and the time t [s]. X may be
 * NULL if the expression does not contain x, y or z. The value may be infinite or NaN, for example after a division by
 * 0. */
real expression_evaluate(const struct expression *e, const real *X, int dim, real t);

/* Returns the result of the operation op on the operands a and b (SI units); b is ignored by functions of one argument.
 * op must not be an operation that pushes a value on the stack (a number, a coordinate, the time). */
real expression_op_apply(enum expression_op op, real a, real b);

/* Returns true if the operation op has no operands: it pushes a number, a coordinate or the time on the stack. */
static inline bool expression_op_has_no_operands(enum expression_op op) { return op <= EXPRESSION_T; }

/* Returns true if the operation op has two operands, which it replaces on the stack by their result. */
static inline bool expression_op_is_binary(enum expression_op op) { return op >= EXPRESSION_ADD; }

#endif
