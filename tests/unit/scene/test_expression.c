/* Tests expressions of scenes: values against the same formulas in C, derivatives, units, stored texts, refusals, and
 * arbitrary bytes. */
#include "tests/support/near.h"

#include <stdio.h>
#include <stdlib.h>

#include "src/scene/scene_internal.h"

static struct scene scene = {.space = SPACE_SOLID, .dim = 3};
static struct reader reader = {.name = "test", .scene = &scene, .dim = 3};

static status compile(struct expression *e, const char *text, enum unit unit)
{
    struct yaml_node n = {
        .kind = NODE_SCALAR, .line = 1, .column = 2, .origin = -1, .key = "value", .text = (char *)text};
    struct key k = {.path = "value", .type = KEY_REAL, .unit = unit};
    const status result = read_expression(&reader, &k, &n, EXPRESS_SPACE | EXPRESS_TIME, e);
    arena_free(&reader);
    return result;
}

/* ---- values ------------------------------------------------------------------------------------------------------ */

#define PI 3.14159265358979323846
#define RAMP(a) ((a) < 0 ? 0 : (a) > 1 ? 1 : (a))

/* Formulas of x, y, z [m] and t [s], each in the notation of scenes and in C. */
#define FORMULAS(F)                                                                                                    \
    F(UNIT_NONE, "2 + 3*4^2/8 - 1", 2 + 3 * 16 / 8. - 1)                                                               \
    F(UNIT_NONE, "-2^2", -4.)                                                                                          \
    F(UNIT_NONE, "2^3^2", 512.)                                                                                        \
    F(UNIT_NONE, "2^-1*4", 2.)                                                                                         \
    F(UNIT_NONE, "8/4/2", 1.)                                                                                          \
    F(UNIT_NONE, "7 - 4 - 2", 1.)                                                                                      \
    F(UNIT_NONE, "2*-3", -6.)                                                                                          \
    F(UNIT_LENGTH, "x + 2*y - z/4", x + 2 * y - z / 4)                                                                 \
    F(UNIT_PRESSURE, "12 MPa * exp(-(t/3us)^2)", 12e6 * exp(-(t / 3e-6) * (t / 3e-6)))                                 \
    F(UNIT_SPEED, "22 m/s*sin(2*pi*x/(10 mm))", 22 * sin(2 * PI * x / 0.01))                                           \
    F(UNIT_SPEED, "22 m/s*sin(2*pi*x/10 mm)", 22 * sin(2 * PI * x / 0.01))                                             \
    F(UNIT_SPEED, "x/t - y/(2 us)", x / t - y / 2e-6)                                                                  \
    F(UNIT_SPEED, "3 mm/us/2", 1500.)                                                                                  \
    F(UNIT_LENGTH, "sqrt(x^2 + y^2 + z^2)", sqrt(x *x + y * y + z * z))                                                \
    F(UNIT_LENGTH, "(x^2 + y^2)^0.5", sqrt(x *x + y * y))                                                              \
    F(UNIT_TOUGHNESS, "60 MPa sqrt(m)*x/m", 60e6 * x)                                                                  \
    F(UNIT_TOUGHNESS, "60 MPa mm^0.5*x/m", 60e6 * sqrt(1e-3) * x)                                                      \
    F(UNIT_TOUGHNESS, "5 MPa*sqrt(pi*x)", 5e6 * sqrt(PI * x))                                                          \
    F(UNIT_NONE, "atan2(y, x) + atan(y/x)", atan2(y, x) + atan(y / x))                                                 \
    F(UNIT_LENGTH, "min(x, y, z) + 2*max(x, 3 mm)", fmin(x, fmin(y, z)) + 2 * fmax(x, 3e-3))                           \
    F(UNIT_LENGTH, "abs(x - 5 mm)", fabs(x - 5e-3))                                                                    \
    F(UNIT_LENGTH, "max(x - 5 mm, 0)", fmax(x - 5e-3, 0))                                                              \
    F(UNIT_NONE, "step(t - 3 us) - step(x - 1 m)", (t >= 3e-6) - (x >= 1.))                                            \
    F(UNIT_NONE, "sign(x - 5 mm)", (x > 5e-3) - (x < 5e-3))                                                            \
    F(UNIT_NONE, "step(y - y) + 10*sign(y - y) + 100*ramp((y - y)/m)", 1.)                                             \
    F(UNIT_NONE, "ramp(t/5us) + ramp(x/m - 1) + ramp(2)", RAMP(t / 5e-6) + RAMP(x - 1) + 1)                            \
    F(UNIT_NONE, "pulse(t/20us)", sin(PI *t / 20e-6) * sin(PI * t / 20e-6))                                            \
    F(UNIT_NONE, "pulse(-0.5) + pulse(1.5)", 0.)                                                                       \
    F(UNIT_NONE, "tanh(x/mm) + sinh(x/m) + cosh(x/m)", tanh(x / 1e-3) + sinh(x) + cosh(x))                             \
    F(UNIT_NONE, "tan(x/cm) + asin(x/m) + acos(y/m)", tan(x / 0.01) + asin(x) + acos(y))                               \
    F(UNIT_NONE, "log(x/mm) + floor(y/mm) + cos(z/mm)", log(x / 1e-3) + floor(y / 1e-3) + cos(z / 1e-3))               \
    F(UNIT_RATE, "1/t + 2 kHz + 100 1/s", 1 / t + 2000 + 100)                                                          \
    F(UNIT_DENSITY, "7.8 g/cm^3*(1 - 5 %)", 7800 * 0.95)                                                               \
    F(UNIT_TIME, "2 min - 1 h/60", 60.)                                                                                \
    F(UNIT_BODY_FORCE, "7800 kg/m^3*9.81 m/s^2*x/m", 7800 * 9.81 * x)                                                  \
    F(UNIT_NONE, "x^(2)/m^2", x *x)                                                                                    \
    F(UNIT_NONE, "x^2/m/m", x *x)                                                                                      \
    F(UNIT_NONE, "2^(x/m)", pow(2, x))                                                                                 \
    F(UNIT_NONE, "0.5 \u00b5m/\u00b5m", 0.5)

#define FORMULA(unit_, text_, value_) {unit_, text_},
static const struct {
    enum unit unit;
    const char *text;
} formulas[] = {FORMULAS(FORMULA)};

static void values_are_those_of_c(void **state)
{
    (void)state;
    for (int place = 0; place < 3; place++) {
        const real x = 3e-3 + 4e-3 * place, y = 2e-3, z = 0.7e-3 * (1 + place), t = 1.3e-6 * (1 + place);
#define VALUE(unit_, text_, value_) value_,
        const real value[] = {FORMULAS(VALUE)};
        for (size_t k = 0; k < COUNT_OF(formulas); k++) {
            struct expression e;
            if (compile(&e, formulas[k].text, formulas[k].unit) != OK) fail_msg("%s", status_message());
            assert_near(expression_evaluate(&e, (const real[]){x, y, z}, 3, t), value[k], 1e-14 * (1 + fabs(value[k])));
            expression_free(&e);
        }
    }
}

/* Compares the derivative of each formula with a central difference. Tolerance: squared step, and round-off over the
 * step. */
static void derivatives_follow(void **state)
{
    (void)state;
    static const char *const pairs[][2] = {
        {"sin(2*pi*t/7us)", "2*pi/7us*cos(2*pi*t/7us)"},
        {"exp(-(t/3us)^2)", "-2*t/(3us)^2*exp(-(t/3us)^2)"},
        {"tanh(t/4us)^3", "3*tanh(t/4us)^2*(1 - tanh(t/4us)^2)/4us"},
        {"log(1 + t/us)*sqrt(t/us)", "sqrt(t/us)/(t + 1us) + log(1 + t/us)*0.5/sqrt(t*us)"},
        {"pulse(t/9us)", "pi/9us*sin(2*pi*t/9us)"},
        {"atan(t/2us)", "1/(2us*(1 + (t/2us)^2))"}};
    for (size_t k = 0; k < COUNT_OF(pairs); k++) {
        struct expression f, slope;
        assert_int_equal(compile(&f, pairs[k][0], UNIT_NONE), OK);
        assert_int_equal(compile(&slope, pairs[k][1], UNIT_RATE), OK);
        const real step = 1e-10;
        for (real t = 0.5e-6; t < 6e-6; t += 0.7e-6) {
            const real rise = expression_evaluate(&f, NULL, 0, t + step) - expression_evaluate(&f, NULL, 0, t - step);
            assert_near(rise / (2 * step), expression_evaluate(&slope, NULL, 0, t), 1e-7 * 1e6);
        }
        expression_free(&f);
        expression_free(&slope);
    }
}

/* Checks that the stored text of an expression compiles to the same operations and is stored again unchanged. */
static void texts_read_back(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(formulas); k++) {
        struct expression a, b;
        assert_int_equal(compile(&a, formulas[k].text, formulas[k].unit), OK);
        assert_int_equal(compile(&b, a.text, formulas[k].unit), OK);
        assert_string_equal(a.text, b.text);
        assert_int_equal(a.n, b.n);
        for (int i = 0; i < a.n; i++)
            assert_true(a.step[i].op == b.step[i].op && reals_are_bitwise_equal(a.step[i].value, b.step[i].value));
        expression_free(&a);
        expression_free(&b);
    }
}

static void constants_are_folded(void **state)
{
    (void)state;
    struct expression e;
    assert_int_equal(compile(&e, "2*(3 mm + 4 mm)^2/7 mm", UNIT_LENGTH), OK);
    assert_true(e.n == 1 && !e.in_space && !e.in_time);
    expression_free(&e);
    assert_int_equal(compile(&e, "1/3 mm", UNIT_LENGTH), OK); /* a number with a unit, as in any key */
    assert_true(e.n == 1 && reals_are_bitwise_equal(expression_evaluate(&e, NULL, 0, 0), 1e-3 / 3));
    expression_free(&e);
    assert_int_equal(compile(&e, "2*pi*x + 0*t*m/s", UNIT_LENGTH), OK);
    assert_true(e.in_space && e.in_time);
    expression_free(&e);
}

/* ---- refusals ---------------------------------------------------------------------------------------------------- */

/* Checks the messages for formulas that are invalid or of the wrong unit, with the position of the error. */
static void faults_are_placed(void **state)
{
    (void)state;
    static const struct {
        enum unit unit;
        const char *text, *message;
    } wrong[] = {
        {UNIT_LENGTH, "x + t",
         "x + t combines a length and a time by + (character 3); give both operands the same unit"},
        {UNIT_LENGTH, "x + 3",
         "x + 3 combines a length and a plain number by + (character 3); give both operands the same unit"},
        {UNIT_NONE, "2*exp(x)", "2*exp(x) applies exp to a length (character 3); give a plain number, such as (t/5us)"},
        {UNIT_PRESSURE, "3 mm*x/m", "3 mm*x/m is a length; give a stress, such as 190 GPa"},
        {UNIT_PRESSURE, "12e6*sin(t/us)", "12e6*sin(t/us) is a plain number; give a stress, such as 190 GPa"},
        {UNIT_NONE, "x*x", "x*x is an area; give a plain number, such as 0.25"},
        {UNIT_NONE, "x*t", "x*t is in m^1 s^1; give a plain number, such as 0.25"},
        {UNIT_NONE, "2*(3 +",
         "2*(3 + ends where a number is expected (in a list, put a formula with a comma in quotes)"},
        {UNIT_NONE, "2*(3",
         "2*(3 ends where an operation or ) is expected (in a list, put a formula with a comma in quotes)"},
        {UNIT_NONE, "2*3)", "2*3) has ) at character 4, where an operation is expected"},
        {UNIT_NONE, "2**3", "2**3 has * at character 3, where a number is expected"},
        {UNIT_NONE, "--2", "--2 has - at character 2, where a number is expected"},
        {UNIT_NONE, "2*sinn(3)", "2*sinn(3) has an unknown function sinn (character 3); see `cleave help expression`"},
        {UNIT_NONE, "2*sin", "2*sin ends where ( and an operand is expected"},
        {UNIT_NONE, "2*tau",
         "2*tau has an unknown name tau, and the scene has no variables; define it by the key variables"},
        {UNIT_NONE, "3 mm*s1",
         "3 mm*s1 has an unknown name s1, and the scene has no variables; define it by the key variables"},
        {UNIT_NONE, "2*3 pounds",
         "2*3 pounds has an unknown unit pounds (character 5); write an operation, such as *, between a number and a "
         "name"},
        {UNIT_NONE, "min(x)/m", "min(x)/m has ) at character 6, where a comma and another operand is expected"},
        {UNIT_NONE, "sin(1, 2)", "sin(1, 2) has , at character 6, where an operation or ) is expected"},
        {UNIT_NONE, "2*1_000",
         "2*1_000 has no valid number at character 3: digits cannot be grouped by _; write 1000 or 1e3"},
        {UNIT_NONE, "2*007",
         "2*007 has no valid number at character 3: a leading 0 means octal elsewhere; write the decimal number "
         "without it"},
        {UNIT_NONE, "2/(1 - 1)", "2/(1 - 1) divides by 0 (character 2); change the divisor"},
        {UNIT_NONE, "log(-1)*t/s",
         "log(-1)*t/s has a part that is infinite or not a number; check its divisions and powers"},
        {UNIT_LENGTH, "x^t", "x^t has a time as a power (character 2); give a plain number"},
        {UNIT_LENGTH, "x^(t/s)", "x^(t/s) raises a length to a power that varies (character 2); use a constant power"},
        {UNIT_LENGTH, "x^0.3",
         "x^0.3 raises a length (character 2) to a power whose unit cannot be represented; use whole and half powers "
         "of m, kg and s"},
        {UNIT_LENGTH, "sqrt(sqrt(x))",
         "sqrt(sqrt(x)) takes the square root of in m^0.5 (character 1), whose unit has no square root; change the "
         "operand"},
        {UNIT_LENGTH, "2*1e20 m*1e20", "2*1e20 m*1e20 is above 1e30 in SI units; give a length, such as 0.5 mm"},
    };
    for (size_t k = 0; k < COUNT_OF(wrong); k++) {
        struct expression e = {0};
        char message[400];
        snprintf(message, sizeof message, "test:1:2: value: %s", wrong[k].message);
        if (compile(&e, wrong[k].text, wrong[k].unit) != REFUSED) fail_msg("not refused: %s", wrong[k].text);
        assert_string_equal(status_message(), message);
        assert_true(e.n == 0 && !e.step);
    }
}

/* Checks that deeply nested, long and wide texts are refused. */
static void size_is_bounded(void **state)
{
    (void)state;
    static const char *const open[] = {"(", "-(", "sin(", "2^", "1+", "1-(1*", "max(1,"};
    for (size_t k = 0; k < COUNT_OF(open); k++) {
        struct expression e;
        char *text = test_malloc(60001);
        size_t used = 0;
        while (used < 60000 - 10) used += (size_t)sprintf(text + used, "%s", open[k]);
        strcpy(text + used, "1");
        assert_int_equal(compile(&e, text, UNIT_NONE), REFUSED);
        text[3000] = '\0';
        assert_int_equal(compile(&e, text, UNIT_NONE), REFUSED);
        test_free(text);
    }
}

/* ---- arbitrary bytes --------------------------------------------------------------------------------------------- */

/* Returns a pseudo-random number of 31 bits and advances *seed. */
static uint32_t random_next(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(*seed >> 33);
}

/* Changes, removes, duplicates or exchanges random parts of a formula. text: of at most `room` bytes; *seed: state of
 * the random numbers. */
static void mutate(char *text, size_t room, uint64_t *seed)
{
    static const char letters[] = "()+-*/^.,0123456789eExyztmsk gPaN%_ \t\xc2\xb5\xff";
    for (int changes = 1 + (int)(random_next(seed) % 4); changes > 0; changes--) {
        const size_t length = strlen(text);
        if (length == 0) return;
        const size_t at = random_next(seed) % length, from = random_next(seed) % length;
        const uint32_t kind = random_next(seed) % 4;
        if (kind == 0) text[at] = letters[random_next(seed) % (sizeof letters - 1)];
        if (kind == 1) memmove(text + at, text + at + 1, length - at);
        if (kind == 2 && length + 2 < room) memmove(text + at + 1, text + at, length - at + 1);
        if (kind == 3 && 2 * length - from + 1 < room) memmove(text + length, text + from, length - from + 1);
        text[room - 1] = '\0';
    }
}

static void any_text_is_read_or_refused(void **state)
{
    (void)state;
    uint64_t seed = 25;
    int read = 0;
    for (int k = 0; k < 20000; k++) {
        char text[200] = "";
        struct expression e = {0}, again = {0};
        snprintf(text, sizeof text, "%s", formulas[(size_t)k % COUNT_OF(formulas)].text);
        mutate(text, sizeof text, &seed);
        const enum unit unit = formulas[(size_t)k % COUNT_OF(formulas)].unit;
        if (compile(&e, text, unit) != OK) {
            assert_null(strchr(status_message(), '\n'));
            continue;
        }
        read++;
        const real X[] = {1e-3, 2e-3, 3e-3}, value = expression_evaluate(&e, X, 3, 1e-6);
        if (compile(&again, e.text, unit) != OK) fail_msg("%s", status_message());
        assert_true(reals_are_bitwise_equal(value, expression_evaluate(&again, X, 3, 1e-6)) || isnan(value));
        expression_free(&e);
        expression_free(&again);
    }
    assert_true(read > 1000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_are_those_of_c),
        cmocka_unit_test(derivatives_follow),
        cmocka_unit_test(texts_read_back),
        cmocka_unit_test(constants_are_folded),
        cmocka_unit_test(faults_are_placed),
        cmocka_unit_test(size_is_bounded),
        cmocka_unit_test(any_text_is_read_or_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
