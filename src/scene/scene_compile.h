/* What compiles an expression: the steps made so far, and the operands that they leave, with their units. */
#ifndef CLEAVE_SCENE_COMPILE
#define CLEAVE_SCENE_COMPILE

#include "scene_internal.h"

enum { EXPRESSION_TEXT = 4000 }; /* longest text, variables written out as numbers */

/* A value on the stack at the time of compiling; a constant one is the last step. */
struct operand {
    struct quantity q;
    bool constant;
};

struct compile {
    struct reader *r;
    unsigned of; /* EXPRESS_SPACE | EXPRESS_TIME */
    const char *text, *at;
    int depth, steps, operands;
    struct expression_step step[EXPRESSION_STEPS];
    struct operand operand[EXPRESSION_STACK];
    char kept[EXPRESSION_TEXT + 1]; /* the text, numbers in place of variables */
    size_t used;
    const char *copied; /* up to here the text is in it */
    char *what;
    size_t room;
};

/* Writes the rest of a sentence that begins with the text; false. */
bool compile_wrong(struct compile *c, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* Number of the character at a place of the text, from 1. */
int character_of(const struct compile *c, const char *place);
/* The unit of an operand for a message. */
struct named {
    char text[64];
};
struct named unit_named(const struct quantity *q);
bool is_plain(const struct quantity *q);
struct operand *topmost(struct compile *c, int below);

/* Each adds a step and says what it makes of units; false with a complaint. `at`: where it stands in the text. */
bool add_leaf(struct compile *c, enum expression_op op, const struct quantity *q);
bool add_operation(struct compile *c, enum expression_op op, const struct quantity *unit);
bool add_minus(struct compile *c);
bool add_sum(struct compile *c, char sign, const char *at);
bool add_product(struct compile *c, char sign, const char *at);
bool add_power(struct compile *c, const char *at);
/* Makes the two topmost have one unit: a bare 0 has every unit. */
bool equal_units(struct compile *c, const char *word, const char *at);

#endif
