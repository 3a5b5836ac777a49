/* An expression of x, y, z, t, compiled: steps that a small stack works through. Scenes compile them and check their
 * units (scene_expression.c); loads and fields ask for values. */
#ifndef CLEAVE_EXPRESSION
#define CLEAVE_EXPRESSION

#include "base/base.h"

enum expression_op {
    EXPRESSION_NUMBER, /* puts its value on the stack       */
    EXPRESSION_X,
    EXPRESSION_Y,
    EXPRESSION_Z,
    EXPRESSION_T, /* puts a component of X, or t there */
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
    EXPRESSION_PULSE, /* replaces the topmost              */
    EXPRESSION_ADD,
    EXPRESSION_SUBTRACT,
    EXPRESSION_TIMES,
    EXPRESSION_OVER,
    EXPRESSION_POWER,
    EXPRESSION_ATAN2,
    EXPRESSION_MIN,
    EXPRESSION_MAX /* replaces the two topmost          */
};

enum { EXPRESSION_STACK = 32, EXPRESSION_STEPS = 400 }; /* the most of both */

struct expression_step {
    enum expression_op op;
    real value;
}; /* value [SI] of a NUMBER */

/* No step: no expression. Its text is in SI units and units of the scene, without variables of the scene: what it
 * reads back from is what it was. */
struct expression {
    int n;
    struct expression_step *step;
    char *text;
    bool in_space, in_time; /* it contains x, y or z; it contains t */
};

/* Takes over a copy of the steps and the text. */
void expression_make(struct expression *e, const struct expression_step *step, int n, const char *text);
/* A number for an expression, with its text. */
void expression_constant(struct expression *e, real value, const char *text);
void expression_free(struct expression *e);

/* Value [SI] at X, [dim, m], and t [s]. X may be NULL if it is not in space. Pure; values may be infinite or no number
 * where the formula is. */
real expression_at(const struct expression *e, const real *X, int dim, real t);

/* What an operation makes of one operand a, or of two [SI]. Not for those that put a value on the stack. */
real expression_operate(enum expression_op op, real a, real b);
static inline bool expression_is_leaf(enum expression_op op) { return op <= EXPRESSION_T; }
static inline bool expression_has_two(enum expression_op op) { return op >= EXPRESSION_ADD; }

#endif
