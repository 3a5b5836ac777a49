/* A compiled expression of x, y, z, t: steps evaluated with a small stack. Scenes compile expressions and check their
 * units (scene_expression.c); loads and fields evaluate them. */
#ifndef CLEAVE_EXPRESSION
#define CLEAVE_EXPRESSION

#include "base/base.h"

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

/* One step of an expression. */
struct expression_step {
    enum expression_op op;
    real value; /* value of a NUMBER [SI] */
};

/* An expression; n = 0: none. `text` has SI units and units of the scene, without variables of the scene: parsing it
 * gives an equal expression. */
struct expression {
    int n;
    struct expression_step *step;
    char *text;
    bool in_space, in_time; /* contains x, y or z; contains t */
};

/* Creates an expression from copies of n steps and the text. Release with expression_free. */
void expression_make(struct expression *e, const struct expression_step *step, int n, const char *text);

/* Creates an expression that is a number, with its text. Release with expression_free. */
void expression_make_constant(struct expression *e, real value, const char *text);

/* Releases steps and text. */
void expression_free(struct expression *e);

/* Returns the value [SI] at X [dim] [m] and t [s]. X may be NULL if the expression is not in space. May be infinite or
 * NaN where the formula is. */
real expression_evaluate(const struct expression *e, const real *X, int dim, real t);

/* Returns the result of an operation on operand a, or on a and b [SI]. Not for operations that push a value. */
real expression_apply_operation(enum expression_op op, real a, real b);

/* Returns true if the operation pushes a value. */
static inline bool expression_is_leaf(enum expression_op op) { return op <= EXPRESSION_T; }

/* Returns true if the operation has two operands. */
static inline bool expression_has_two(enum expression_op op) { return op >= EXPRESSION_ADD; }

#endif
