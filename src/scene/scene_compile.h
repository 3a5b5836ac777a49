/* Compiles an expression to steps of a stack machine, and tracks the units of the operands. */
#ifndef CLEAVE_SCENE_COMPILE
#define CLEAVE_SCENE_COMPILE

#include "scene_internal.h"

enum { EXPRESSION_TEXT = 4000 }; /* longest text, variables written out as numbers */

/* An operand on the stack while an expression is compiled: its unit and, if `constant` is true, its value. A constant
 * operand is pushed by a single step of the compiled expression. */
struct operand {
    struct quantity q;
    bool constant;
};

/* State of the compilation of one expression of an input file: from its text to a list of steps of a stack machine. */
struct expression_compiler {
    struct reader *r;           /* reader of the scene, which has the variables; borrowed */
    unsigned of;                /* allowed variables of the expression: EXPRESS_SPACE | EXPRESS_TIME */
    const char *text, *at;      /* the expression; the next character to compile */
    int depth, steps, operands; /* depth of nested brackets; number of entries of `step` and of `operand` */
    struct expression_step step[EXPRESSION_STEPS]; /* [steps] operations in the order of evaluation */
    struct operand operand[EXPRESSION_STACK];      /* [operands] stack of the operands of the next operations */
    char kept[EXPRESSION_TEXT + 1]; /* copy of the text with numbers in place of variables of the scene */
    size_t used;                    /* length of `kept` [byte] */
    const char *copied;             /* end of the part of `text` that has been copied to `kept` */
    char *what;                     /* [room] message about a fault: the rest of a sentence that begins with the text */
    size_t room;
};

/* Writes a message about a fault in the expression, composed as by printf from `format`, to c->what, which has space
 * for c->room bytes. Always returns false, so that callers can return the result. */
bool compile_write_fault_and_return_false(struct expression_compiler *c, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Returns the number, from 1, of the character to which `character` points in c->text, the text of the expression. */
int expression_position_of_character(const struct expression_compiler *c, const char *character);

/* The name of a unit as text for a message; a struct, so that functions can return the text by value. */
struct unit_name_text {
    char text[64];
};

/* Returns the unit of the quantity q as text for a message. */
struct unit_name_text quantity_unit_name(const struct quantity *q);

/* Returns true if the quantity q is a pure number, i.e. all exponents of its unit are 0. */
bool quantity_is_dimensionless(const struct quantity *q);

/* Returns the operand that is `entries_below_top` entries below the topmost one (0: the topmost itself) on the operand
 * stack of c, the compilation of an expression, as a pointer into the stack. The stack must have this many entries. */
struct operand *operand_stack_entry_from_top(struct expression_compiler *c, int entries_below_top);

/* Appends a step to the compiled expression c that pushes a value on the stack: a number or variable (`operation` is
 * EXPRESSION_NUMBER), a coordinate or the time. quantity: unit and, for a number, value. Returns false, with a message
 * in c->what, if the expression is too long or the stack too deep. */
bool compile_append_step_that_pushes_operand(struct expression_compiler *c, enum expression_op operation,
                                             const struct quantity *quantity);

/* Appends a step to the compiled expression c that applies `operation` to the topmost operand, or to two of them for a
 * binary operation. result_unit: unit of the result. Returns false, with a message in c->what, if the expression is too
 * long or a constant result is not finite. */
bool compile_append_step_that_applies_operation(struct expression_compiler *c, enum expression_op operation,
                                                const struct quantity *result_unit);

/* Appends a step to the compiled expression c that negates the topmost operand. Returns false, with a message in
 * c->what, if the expression is too long. */
bool compile_append_negation(struct expression_compiler *c);

/* Appends a step to the compiled expression c that adds (sign '+') or subtracts (sign '-') the two topmost operands.
 * operator_in_text: position of the operator in the text, for messages. Returns false, with a message in c->what, if
 * their units differ. */
bool compile_append_sum_or_difference(struct expression_compiler *c, char sign, const char *operator_in_text);

/* Appends a step to the compiled expression c that multiplies (sign '*') or divides (sign '/') the two topmost operands
 * and their units. operator_in_text: position of the operator in the text, for messages. Returns false, with a message
 * in c->what, if the result is invalid. */
bool compile_append_product_or_quotient(struct expression_compiler *c, char sign, const char *operator_in_text);

/* Appends a step to the compiled expression c that raises the second topmost operand to the power of the topmost one.
 * operator_in_text: position of the operator in the text, for messages. Returns false, with a message in c->what, if
 * the exponent has a unit or the result has no valid unit. */
bool compile_append_power(struct expression_compiler *c, const char *operator_in_text);

/* Checks that the two topmost operands of the compiled expression c have the same unit. A constant 0 without unit first
 * receives the unit of the other operand. operation_name: name of the operation, and operator_in_text: its position in
 * the text, for the message. Returns false, with a message in c->what, if the units differ. */
bool compile_match_units_of_top_operands(struct expression_compiler *c, const char *operation_name,
                                         const char *operator_in_text);

#endif
