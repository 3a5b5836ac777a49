/* Computes the factors of bonds near faces by Newton's method on the dual of their least-squares problem
 * (surface_fit.c).
 *
 * Multipliers q_c = Q_c (M_c - goal_c), one for each moment of class c (particles with equal surroundings),
 * give the factor of a bond as
 *
 *     f = 1 - (sum_ends m . q_c)/prior, within its bounds,     m: moments of the bond from one of its ends
 *
 * (M_c, goal_c: moments and their targets; Q_c: quadratic form that weighs deviations.) At the minimum R_c =
 * Q_c^-1 q_c + goal_c - M_c(f) = 0. R is the gradient of a convex function of q, and is linear where no
 * factor meets a bound: Newton's method for such piecewise functions (Qi & Sun 1993) finds its zero in a few
 * steps. Each step is a linear system with the matrix Q_c^-1 + sum m m/prior over the bonds between bounds,
 * solved by conjugate gradients that are preconditioned by the block of each class. That takes a third to a
 * fifth of the products of conjugate gradients in the factors themselves. */
#include <math.h>

#include "base/memory.h"
#include "base/team.h"
#include "surface_parts.h"

#define CLOSE 1e-13 /* relative reduction of R at which the solver stops */
#define ROUGH 0.1   /* largest residual of a linear system divided by R [1] */
#define STEEP 0.1   /* largest slope after a step divided by the slope before the step [1] */
#define WORK 2.5e10 /* largest number of multiplications: 10 s on two cores */
/* Limits of the solver. SHORTENINGS: largest number of times that one Newton step is shortened. BLOCK: numbers in the
 * lower triangle of the matrix block of one class, which consists of particles with equal surroundings. TOGETHER:
 * number of classes whose blocks are stored interleaved, so that vector instructions solve with all of them at once. */
enum { SHORTENINGS = 20, BLOCK = MOMENTS * (MOMENTS + 1) / 2, TOGETHER = 4 };

/* State of the solver that fits the weights of bonds near faces. Vectors have one number for each moment of each class:
 * [classes width]. */
struct descent {
    const struct surface_fit_problem *fit;
    int64_t n; /* length of the vectors */
    /* number of moments of a class; number of products with A so far; its largest number; number of systems so far */
    int width, products, most, systems;
    /* multipliers q; residual R; Newton step; residual of the linear system; B^-1 times it; direction of conjugate
     * gradients; A times it; multipliers after a trial step; their residual */
    real *multiplier, *residual, *step, *left, *weighed, *direction, *image, *next, *next_residual;
    /* [classes/TOGETHER, BLOCK, TOGETHER] lower triangles of the Cholesky factors of the blocks */
    real (*block)[TOGETHER];
    uint8_t *images;  /* [classes offsets] number of bonds of the group in the class */
    real *factor;     /* [groups] factors of the bonds */
    uint8_t *between; /* [groups] 1: in the present linear system the factor is between its bounds */
    uint8_t *turned;  /* [groups] 1: `between` differs from that in the last linear system */
    uint8_t *changes; /* [classes offsets/2] 1: the factor of one of two opposite bonds is between its bounds */
    real *change;     /* [groups] change of the factors along `direction` */
    real *value;      /* [classes offsets] product of the moments of a bond with the multipliers of its class */
};

/* Two vectors whose scalar product is computed. */
struct pair {
    const real *a, *b;
};

static void pair_block(const void *context, int64_t first, int64_t end, real *sum)
{
    const struct pair *p = context;
    for (int64_t k = first; k < end; k++) sum[0] += p->a[k] * p->b[k];
}

static real inner(int64_t n, const real *a, const real *b)
{
    real sum;
    reproducible_sums(n, 1, pair_block, &(struct pair){a, b}, &sum);
    return sum;
}

/* ---- products ---------------------------------------------------------------------------------------------------- */

/* Computes value[offsets]: for the bond at each lattice offset of a class (particles with equal surroundings) the
 * scalar product of the moments of the bond and the vector by[thirds + fourths] of this class. The moments of a bond
 * are tensors of rank 3 and 4 formed of its direction; thirds, fourths: numbers of their components, known at compile
 * time. q: moments at all offsets; changes[offsets/2]: pairs of opposite bonds with the value 0 are skipped; NULL: none
 * is skipped. */
static ALWAYS_INLINE void class_back(const struct surface_fit_problem *q, const uint8_t *changes, const real *by,
                                     real *value, const int thirds, const int fourths)
{
    for (int k = 0; k < q->offsets / 2; k++) { /* opposite bonds have opposite third moments and equal fourth moments */
        if (changes && !changes[k]) continue;
        const real *of = q->of + (int64_t)k * (thirds + fourths);
        real odd[2] = {0}, even[2] = {0};
        for (int x = 0; x < thirds; x += 2)
            for (int l = 0; l < 2; l++) odd[l] += of[x + l] * by[x + l];
        for (int x = thirds; x < thirds + fourths; x += 2)
            for (int l = 0; l < 2; l++) even[l] += of[x + l] * by[x + l];
        value[k] = (even[0] + even[1]) + (odd[0] + odd[1]);
        value[q->offsets - 1 - k] = (even[0] + even[1]) - (odd[0] + odd[1]);
    }
}

/* Subtracts from to[thirds + fourths] the sum of x times the moments of the bond over all bonds of one class (particles
 * with equal surroundings). Moments of a bond: tensors of rank 3 and 4 formed of its direction; thirds, fourths:
 * numbers of their components, known at compile time. q: moments of the bonds at all lattice offsets; x[sets]: a number
 * for each set of bonds that share a factor on their weight; group[offsets]: set of the bond at each offset, -1 for
 * none (x = 0). changes[offsets/2]: pairs of opposite bonds with the value 0 are skipped, since their x is 0; NULL:
 * none is skipped. */
static ALWAYS_INLINE void class_sum(const struct surface_fit_problem *q, const uint8_t *changes, const int64_t *group,
                                    const real *x, real *to, const int thirds, const int fourths)
{
    real sum[MOMENTS] = {0};
    for (int k = 0; k < q->offsets / 2; k++) {
        const int64_t one = group[k], other = group[q->offsets - 1 - k];
        if (changes ? !changes[k] : one < 0 && other < 0) continue;
        const real a = one < 0 ? 0 : x[one], b = other < 0 ? 0 : x[other], odd = a - b, even = a + b;
        const real *of = q->of + (int64_t)k * (thirds + fourths);
        for (int m = 0; m < thirds; m++) sum[m] += odd * of[m];
        for (int m = thirds; m < thirds + fourths; m++) sum[m] += even * of[m];
    }
    for (int m = 0; m < thirds + fourths; m++) to[m] -= sum[m];
}

/* Computes the vector to = Q^-1 `of` of a class (particles with equal surroundings), both [thirds + fourths]. Q is the
 * quadratic form that weighs deviations of the moments of the bonds; c holds its inverse. thirds, fourths: numbers of
 * components of the third and fourth moments, known at compile time. */
static ALWAYS_INLINE void class_weigh(const struct class_fit *c, const real *of, real *to, const int thirds,
                                      const int fourths)
{
    for (int x = 0; x < thirds + fourths; x++) to[x] = 0;
    for (int y = 0; y < thirds; y++)
        for (int x = 0; x < thirds; x++) to[x] += c->third[y][x] * of[y];
    for (int y = 0; y < fourths; y++)
        for (int x = 0; x < fourths; x++) to[thirds + x] += c->fourth[y][x] * of[thirds + y];
}

/* Returns the part of the array changes[classes, offsets/2] that belongs to class number `class` (particles with equal
 * surroundings): the marks of its pairs of opposite bonds. q: has `offsets`, the number of lattice offsets. Returns
 * NULL if `changes` is NULL. */
static const uint8_t *marks_of(const struct surface_fit_problem *q, const uint8_t *changes, int32_t class)
{
    return changes ? changes + (int64_t) class * (q->offsets / 2) : NULL;
}

/* Computes d->value[classes, offsets], a number for each bond of each class (particles with equal surroundings): the
 * scalar product of the moments of the bond (tensors formed of its direction) and the part of the vector x[classes,
 * moments] that belongs to the class. changes[classes, offsets/2]: pairs of opposite bonds with the value 0 are
 * skipped; NULL: none is skipped. */
static void all_back(struct descent *d, const uint8_t *changes, const real *x)
{
    const struct surface_fit_problem *q = d->fit;
    const bool solid = q->thirds == THIRDS;
#pragma omp parallel for schedule(static)
    for (int32_t class = 1; class < q->alike->classes; class ++) {
        const uint8_t *marks = marks_of(q, changes, class);
        const real *by = x + (int64_t) class * d->width;
        real *value = d->value + (int64_t) class * q->offsets;
        if (solid)
            class_back(q, marks, by, value, THIRDS, FOURTHS);
        else
            class_back(q, marks, by, value, THIRDS_2D, FOURTHS_2D);
    }
}

/* Computes to = Q^-1 by - sum m x, plus the goals if `goals`, for each class (particles with equal surroundings) in
 * d->fit, the least-squares fit of the factors on the weights of bonds near faces. to, by: vectors [classes, d->width]
 * with a number for each bond moment of a class. m: moments of a bond of the class (components of tensors of rank 3 and
 * 4 formed of its direction), over which the sum extends; x[groups]: factor of each group of bonds that share one, or
 * its change. Q: quadratic form by which the fit weighs deviations of the moments from their target values, the goals.
 * changes[classes, offsets/2]: pairs of opposite bonds with the value 0 are skipped, since their x is 0; NULL: none is
 * skipped. */
static void all_sum(const struct descent *d, const uint8_t *changes, const real *by, const real *x, bool goals,
                    real *to)
{
    const struct surface_fit_problem *q = d->fit;
    const bool solid = q->thirds == THIRDS;
#pragma omp parallel for schedule(static)
    for (int32_t class = 1; class < q->alike->classes; class ++) {
        const int64_t at = (int64_t) class * d->width, *group = q->alike->group_of + (int64_t) class * q->offsets;
        const uint8_t *marks = marks_of(q, changes, class);
        if (solid)
            class_weigh(&q->class[class], by + at, to + at, THIRDS, FOURTHS);
        else
            class_weigh(&q->class[class], by + at, to + at, THIRDS_2D, FOURTHS_2D);
        for (int m = 0; m < d->width && goals; m++) to[at + m] += q->class[class].goal[m];
        if (solid)
            class_sum(q, marks, group, x, to + at, THIRDS, FOURTHS);
        else
            class_sum(q, marks, group, x, to + at, THIRDS_2D, FOURTHS_2D);
    }
}

/* Returns the sum of d->value over all entries (class of particles, lattice offset of the bond) that belong to g, a set
 * of bonds that share one factor. */
static real group_sum(const struct descent *d, int64_t g)
{
    const struct surface_fit_problem *q = d->fit;
    real sum = 0;
    for (int64_t k = q->first[g]; k < q->first[g + 1]; k++) sum += d->value[q->entry[k]];
    return sum;
}

/* Evaluates the dual of the least-squares problem that fits the weights of bonds near faces. x[classes, moments]: its
 * unknowns, one multiplier for each bond moment of a class of particles with equal surroundings. d->factor[sets]:
 * receives the factors on the weights of the bonds that follow from x, within their bounds, one for each set of bonds
 * that share a factor. residual[classes, moments]: receives the residual, which is 0 at the solution. */
static void residual_make(struct descent *d, const real *x, real *residual)
{
    const struct surface_fit_problem *q = d->fit;
    all_back(d, NULL, x);
#pragma omp parallel for schedule(static)
    for (int64_t g = 0; g < q->alike->groups; g++)
        d->factor[g] = fmin(fmax(1 - group_sum(d, g) / q->prior[g], q->low[g]), q->high[g]);
    all_sum(d, NULL, x, d->factor, true, residual);
    d->products++;
}

/* Computes d->image = A d->direction, both [classes, moments], where A is the matrix of the linear system for one
 * Newton step of the multipliers. A contains only bonds whose factors are between their bounds (d->between); the matrix
 * itself is not stored. */
static void image_make(struct descent *d)
{
    const struct surface_fit_problem *q = d->fit;
    all_back(d, d->changes, d->direction);
#pragma omp parallel for schedule(static)
    for (int64_t g = 0; g < q->alike->groups; g++) d->change[g] = d->between[g] ? -group_sum(d, g) / q->prior[g] : 0;
    all_sum(d, d->changes, d->direction, d->change, false, d->image);
    d->products++;
}

/* ---- preconditioner ---------------------------------------------------------------------------------------------- */

/* Replaces the lower triangle of the symmetric positive definite matrix a with n rows, stored by columns without gaps,
 * by its Cholesky factor with inverted diagonal. */
static void cholesky(real *a, int n)
{
    real *column = a;
    for (int c = 0; c < n; column += n - c, c++) {
        real *next = column + n - c;
        column[0] = 1 / sqrt(column[0]);
        for (int r = 1; r < n - c; r++) column[r] *= column[0];
        for (int k = 1; k < n - c; next += n - c - k, k++)
            for (int r = k; r < n - c; r++) next[r - k] -= column[k] * column[r];
    }
}

/* Solves A x = b for TOGETHER systems of n unknowns at once by vector instructions. a: lower triangles of the Cholesky
 * factors of the matrices A, stored by columns, with inverted diagonals; x[n]: right-hand sides b of all systems,
 * overwritten by the solutions. */
static void cholesky_solve(const real (*a)[TOGETHER], int n, real (*x)[TOGETHER])
{
    const real(*column)[TOGETHER] = a;
    for (int c = 0; c < n; column += n - c, c++) {
        for (int l = 0; l < TOGETHER; l++) x[c][l] *= column[0][l];
        for (int r = 1; r < n - c; r++)
            for (int l = 0; l < TOGETHER; l++) x[c + r][l] -= column[r][l] * x[c][l];
    }
    for (int c = n - 1; c >= 0; c--) {
        real odd[TOGETHER] = {0}, even[TOGETHER] = {0}, (*rest)[TOGETHER] = x + c;
        int r = 1;
        column -= n - c;
        for (; r + 1 < n - c; r += 2)
            for (int l = 0; l < TOGETHER; l++)
                odd[l] += column[r][l] * rest[r][l], even[l] += column[r + 1][l] * rest[r + 1][l];
        for (int l = 0; l < TOGETHER && r < n - c; l++) odd[l] += column[r][l] * rest[r][l];
        for (int l = 0; l < TOGETHER; l++) x[c][l] = (x[c][l] - (odd[l] + even[l])) * column[0][l];
    }
}

/* Stores in d->images, for each bond of class number `class` (particles with equal surroundings), how many bonds of the
 * class share its factor: the bond itself and its mirror images. */
static void images_count(const struct descent *d, int32_t class)
{
    const int n = d->fit->offsets;
    const int64_t *group = d->fit->alike->group_of + (int64_t) class * n;
    uint8_t *images = d->images + (int64_t) class * n;
    for (int k = 0; k < n; k++)
        for (int l = 0; l < n; l++) images[k] += group[l] == group[k];
}

/* Returns the weight of the bond at lattice offset number k in the diagonal block of class number `class` (particles
 * with equal surroundings) of the preconditioner. It is n/prior, where n bonds of the class, mirror images of each
 * other, have the factor of this bond, or 0 if the factor is at a bound or fixed. d: state of the solver. The weight is
 * exact for multipliers with the symmetry of the class. */
static real block_weight(const struct descent *d, int32_t class, int k)
{
    const int64_t at = (int64_t) class * d->fit->offsets + k, group = d->fit->alike->group_of[at];
    return group < 0 || !d->between[group] ? 0 : d->images[at] / d->fit->prior[group];
}

/* Computes the Cholesky factor of the diagonal block of class number `class` (particles with equal surroundings) in the
 * matrix of the linear system, for the preconditioner, and stores it in d->block. */
static void block_make(const struct descent *d, int32_t class)
{
    const struct surface_fit_problem *q = d->fit;
    const struct class_fit *c = &q->class[class];
    const int width = d->width, thirds = q->thirds;
    real block[BLOCK], (*all)[TOGETHER] = d->block + (int64_t)(class / TOGETHER) * BLOCK;
    for (int r = 0, at = 0; r < width; r++)
        for (int s = r; s < width; s++, at++)
            block[at] = s < thirds ? c->third[r][s] : r < thirds ? 0 : c->fourth[r - thirds][s - thirds];
    for (int k = 0; k < q->offsets / 2; k++) { /* of opposite bonds only mixed products have opposite signs */
        const real a = block_weight(d, class, k), b = block_weight(d, class, q->offsets - 1 - k);
        const real *of = q->of + (int64_t)k * width;
        real *to = block;
        if (a == 0 && b == 0) continue;
        for (int r = 0; r < width; to += width - r, r++) {
            const real same = (a + b) * of[r], mixed = (a - b) * of[r];
            const int odd = r < thirds ? thirds : r;
            for (int s = r; s < odd; s++) to[s - r] += same * of[s];
            for (int s = odd; s < width; s++) to[s - r] += (r < thirds ? mixed : same) * of[s];
        }
    }
    for (int r = 0, at = 0; r < width; at += width - r, r++) /* padding */
        if (block[at] == 0) block[at] = 1;
    cholesky(block, width);
    for (int at = 0; at < width * (width + 1) / 2; at++) all[at][class % TOGETHER] = block[at];
}

/* Returns true if the block of class number `class` (particles with equal surroundings) in the preconditioner must be
 * recomputed: a factor of one of its bonds has reached or left a bound since the last linear system of d was set up. */
static bool class_turned(const struct descent *d, int32_t class)
{
    const int n = d->fit->offsets;
    const int64_t *group = d->fit->alike->group_of + (int64_t) class * n;
    for (int k = 0; k < n; k++)
        if (group[k] >= 0 && d->turned[group[k]]) return true;
    return false;
}

/* Marks in d->changes the pairs of opposite bonds of class number `class` (particles with equal surroundings) that the
 * linear system contains: 1 if the factor of one of both is between its bounds, else 0. */
static void class_mark(struct descent *d, int32_t class)
{
    const int n = d->fit->offsets;
    const int64_t *group = d->fit->alike->group_of + (int64_t) class * n;
    for (int k = 0; k < n / 2; k++) {
        const int64_t one = group[k], other = group[n - 1 - k];
        d->changes[(int64_t) class * (n / 2) + k] = (one >= 0 && d->between[one]) || (other >= 0 && d->between[other]);
    }
}

/* Sets up the linear system of a Newton step for the present factors of bonds in d: marks the factors that are between
 * their bounds, and computes the preconditioner. Its block of a class (particles with equal surroundings) is kept if no
 * mark of a bond of this class has changed since the last linear system. */
static void system_make(struct descent *d)
{
#pragma omp parallel for schedule(static)
    for (int64_t g = 0; g < d->fit->alike->groups; g++) {
        const bool between = d->factor[g] > d->fit->low[g] && d->factor[g] < d->fit->high[g];
        d->turned[g] = d->between[g] != between;
        d->between[g] = between;
    }
#pragma omp parallel for schedule(dynamic, TOGETHER)
    for (int32_t class = 1; class < d->fit->alike->classes; class ++) {
        if (d->systems > 0 && !class_turned(d, class)) continue;
        class_mark(d, class);
        block_make(d, class);
    }
    d->systems++;
}

/* Computes d->weighed = B^-1 d->left, both [classes, moments]. d->left is the residual of the linear system. B is its
 * preconditioner: a block-diagonal matrix with one block for each class (particles with equal surroundings). */
static void left_weigh(struct descent *d)
{
    const int32_t classes = d->fit->alike->classes;
    const int width = d->width;
#pragma omp parallel for schedule(static)
    for (int32_t first = 0; first < classes; first += TOGETHER) {
        real x[MOMENTS][TOGETHER] = {{0}};
        const int64_t at = (int64_t)first * width;
        const int lanes = classes - first < TOGETHER ? classes - first : TOGETHER;
        for (int l = 0; l < lanes; l++)
            for (int m = 0; m < width; m++) x[m][l] = d->left[at + l * width + m];
        cholesky_solve(d->block + (int64_t)(first / TOGETHER) * BLOCK, width, x);
        for (int l = 0; l < lanes; l++)
            for (int m = 0; m < width; m++) d->weighed[at + l * width + m] = x[m][l];
    }
}

/* ---- Newton's method --------------------------------------------------------------------------------------------- */

/* Computes d->step, the Newton step of the multipliers of the dual problem, by preconditioned conjugate gradients.
 * Stops when the residual of the linear system is `share` [1] times the residual d->residual of the dual problem, or
 * when d->most products with the matrix are used up. */
static void step_solve(struct descent *d, real share)
{
    real before = 0;
    const real enough = square(share) * inner(d->n, d->residual, d->residual);
    system_make(d);
    array_fill_bytes(d->step, 0, d->n, sizeof(real));
    array_fill_bytes(d->direction, 0, d->n, sizeof(real));
    array_copy(d->left, d->residual, d->n, sizeof(real));
    while (d->products < d->most && inner(d->n, d->left, d->left) > enough) {
        left_weigh(d);
        const real now = inner(d->n, d->left, d->weighed), turn = before > 0 ? now / before : 0;
        before = now;
        for (int64_t k = 0; k < d->n; k++) d->direction[k] = d->weighed[k] + turn * d->direction[k];
        image_make(d);
        const real length = now / inner(d->n, d->direction, d->image);
        for (int64_t k = 0; k < d->n; k++) d->step[k] -= length * d->direction[k], d->left[k] -= length * d->image[k];
    }
}

/* Moves the multipliers of the dual problem along d->step, and updates the factors of bonds and the residual. The
 * residual is the gradient of a convex function of the multipliers. The step is too long if the slope of this function
 * at its end is positive and more than STEEP times the absolute slope at its start. It is then shortened and tried
 * again, at most SHORTENINGS times. */
static void step_take(struct descent *d)
{
    const real slope = inner(d->n, d->residual, d->step);
    real length = 1;
    for (int k = 0; k < SHORTENINGS; k++) {
        for (int64_t i = 0; i < d->n; i++) d->next[i] = d->multiplier[i] + length * d->step[i];
        residual_make(d, d->next, d->next_residual);
        const real now = inner(d->n, d->next_residual, d->step);
        if (!(now > -STEEP * slope)) break;
        length *= slope / (slope - now);
    }
    array_copy(d->multiplier, d->next, d->n, sizeof(real));
    array_copy(d->residual, d->next_residual, d->n, sizeof(real));
}

/* Makes Newton steps until the norm of the residual d->residual is at most CLOSE times its first value, or until
 * d->most products with the matrix are used up. Returns the norm of the last residual, divided by that of the first one
 * [1]; more than CLOSE if the steps have not converged. */
static real descend(struct descent *d)
{
    residual_make(d, d->multiplier, d->residual);
    const real first = sqrt(inner(d->n, d->residual, d->residual));
    real left = first > 0 ? 1 : 0;
    while (left > CLOSE && d->products < d->most) {
        step_solve(d, fmax(fmin(ROUGH, left), 0.5 * CLOSE / left));
        step_take(d);
        left = sqrt(inner(d->n, d->residual, d->residual)) / first;
    }
    return left;
}

real surface_fit_solve_least_squares(const struct surface_fit_problem *q, real *factor, int max_matrix_products)
{
    const int width = q->thirds + q->fourths;
    const int64_t classes = q->alike->classes, n = classes * width;
    const real work = 2.0 * (real)classes * q->offsets * width;
    struct descent d = {.fit = q, .n = n, .width = width, .factor = factor};
    real **const vector[] = {&d.multiplier, &d.residual, &d.step, &d.left,         &d.weighed,
                             &d.direction,  &d.image,    &d.next, &d.next_residual};
    real *all = NEW("surface.descent", n * (int64_t)COUNT_OF(vector), real);
    for (size_t k = 0; k < COUNT_OF(vector); k++) *vector[k] = all + (int64_t)k * n;
    d.block = memory_new("surface.block", (classes + TOGETHER - 1) / TOGETHER * BLOCK, sizeof *d.block);
    d.images = NEW("surface.images", classes * q->offsets, uint8_t);
#pragma omp parallel for schedule(static)
    for (int32_t class = 1; class < q->alike->classes; class ++) images_count(&d, class);
    d.change = NEW("surface.change", q->alike->groups, real);
    d.between = NEW("surface.between", q->alike->groups, uint8_t);
    d.turned = NEW("surface.turned", q->alike->groups, uint8_t);
    d.changes = NEW("surface.changes", classes * (q->offsets / 2), uint8_t);
    d.value = NEW("surface.value", classes * q->offsets, real);
    d.most = (int)fmin(max_matrix_products, WORK / work);
    const real left = q->alike->groups > 0 ? descend(&d) : 0;
    memory_free(all);
    memory_free(d.block);
    memory_free(d.images);
    memory_free(d.change);
    memory_free(d.between);
    memory_free(d.turned);
    memory_free(d.changes);
    memory_free(d.value);
    return left;
}
