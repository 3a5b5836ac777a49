/* Finds the problem of the cost-accuracy table that a scene resembles, from the content of the scene, and the feature
 * that its spacing has to resolve. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "auto.h"

enum { STEP, PULSE, WAVE_P, WAVE_S, SQUARE, CUBE, HOLE, EDGE, INCLINED, SUDDEN, MOVING, SPALL, IMPACT, PULLED };

enum { TRACTION = 1 << BOUNDARY_TRACTION, DRIVE = 1 << BOUNDARY_VELOCITY, FORCE = 1 << BOUNDARY_BODY_FORCE };

/* per_resolution, travel, slow and ring describe the runs of bench/accuracy/accuracy_*.c: a pulse of 0.4 m at 50
 * particles per metre has 20 spacings, ..; known: bench/accuracy/accuracy_reference.h. */
static const struct auto_kind kinds[] = {
    [STEP] = {"bar", "step", "a bar loaded at once", "the bar's length", 1, 0.75, 0, true, 0, 0, TRACTION},
    [PULSE] = {"bar", "pulse", "a pulse in a bar", "the pulse's width", 0.4, 1, 0, true, 0, 0, TRACTION},
    [WAVE_P] = {"wave", NULL, "a plane pressure wave", "the packet's width", 0.2, 1, 0, true, 0, 0, 0},
    [WAVE_S] = {"wave", NULL, "a plane shear wave", "the packet's width", 0.2, 0.577, 0, true, 0, 0, 0},
    [SQUARE] = {"square", "plane stress", "a smooth motion under body forces", "the wavelength", 2, 0.28, 0, true, 0, 0,
                FORCE},
    [CUBE] = {"cube", "solid", "a smooth motion under body forces", "the wavelength", 2, 0.28, 0, true, 0, 0, FORCE},
    [HOLE] = {"hole", "pulled", "a plate with a hole, at rest", "the hole's radius", 0.1, 0, 30, false, 0, 0, TRACTION},
    [EDGE] = {"cracks", "edge crack", "an edge crack at rest", "the crack's length", 0.5, 0, 200, false, 0.4, 0,
              TRACTION},
    [INCLINED] = {"cracks", "inclined crack", "a crack at rest", "half the crack's length", 0.3, 0, 200, false, 2.0 / 3,
                  0, TRACTION},
    [SUDDEN] = {"sudden", "at rest", "a suddenly loaded crack", "the waves' way to it", 1, 2.735, 0, false, 0.4, 0,
                TRACTION},
    [MOVING] = {"sudden", "at 1000 m/s", "a loaded crack that grows", "the waves' way to it", 1, 2.735, 0, false, 0.4,
                0, TRACTION},
    [SPALL] = {"spall", "spall", "a bar that spalls", "the pulse's length", 0.4, 3.5, 0, false, 0, 0, 0},
    [IMPACT] = {"fracture", "Kalthoff", "a struck plate that cracks", "the plate's width", 1, 2.62, 0, false, 0, 0.025,
                TRACTION | DRIVE},
    [PULLED] = {"fracture", "pulled plate", "a pulled plate that cracks", "the plate's width", 1, 1.56, 0, false, 0,
                0.027, TRACTION | DRIVE},
};

/* Factor on errors in space: the critical step of cells is shorter than in the plane, so that the step compensates less
 * of the waves' delay by the grid. 1.2 times the error of the plane was measured (a column with Poisson's ratio
 * 1/4). */
#define SOLID_GROWTH 1.3

/* Factor on errors of other materials: all runs of the table in more than one dimension have C12/C11 = 1/3 (bonds have
 * no other). With another ratio critical steps and the components' shares in an error differ: up to 1.2 times the error
 * was measured (Poisson's ratio 0.1, 0.3, 0.45). */
#define MATERIAL_GROWTH 1.2

static status no_match(const char *what)
{
    return status_set(REFUSED, "the cost-accuracy table has no problem like this one: %s", what);
}

/* ---- content of a scene ------------------------------------------------------------------------------------------ */

real auto_extent(const struct scene *s, int body, int axis)
{
    const struct region *shape = &s->body[body].shape;
    if (shape->n == 0 || !solid_is(&shape->solid[0], SOLID_BOX)) return 0;
    return shape->solid[0].to[axis] - shape->solid[0].from[axis];
}

static real narrowest(const struct scene *s)
{
    real least = INFINITY;
    for (int d = 0; d < s->dim; d++) least = real_min(least, auto_extent(s, 0, d));
    return least;
}

static bool breaks(const struct scene *s) { return isfinite(s->material[0].critical_stretch); }

/* Radius of the smallest round hole; INFINITY: none. */
static real hole_radius(const struct scene *s)
{
    real least = INFINITY;
    for (int b = 0; b < s->bodies; b++)
        for (int k = 0; k < s->body[b].shape.n; k++) {
            const struct solid *a = &s->body[b].shape.solid[k];
            if (a->subtract && solid_is(a, SOLID_BALL)) least = real_min(least, a->radius);
        }
    return least;
}

static bool is_inside(const struct scene *s, const real *X)
{
    const struct solid *a = &s->body[0].shape.solid[0];
    for (int d = 0; d < s->dim; d++)
        if (X[d] <= a->from[d] || X[d] >= a->to[d]) return false;
    return true;
}

/* Length of a crack inside the body [m]: from its tip to the edge, or half of it where both ends are tips
 * (*embedded). */
static real crack_length(const struct scene *s, const struct crack *c, bool *embedded)
{
    const real *a = c->corner[0], *b = c->corner[1];
    const bool tip[2] = {is_inside(s, a), is_inside(s, b)};
    const real length = hypot(b[0] - a[0], b[1] - a[1]);
    *embedded = tip[0] && tip[1];
    if (*embedded) return 0.5 * length;
    if (!tip[0] && !tip[1]) return 0;
    real inside = 0, part = 1;               /* bisection: where it leaves the body */
    for (int k = 0; k < 50; k++) {
        const real share = 0.5 * (inside + part);
        real X[DIM_MAX] = {0};
        for (int d = 0; d < 2; d++) X[d] = tip[0] ? a[d] + share * (b[d] - a[d]) : b[d] + share * (a[d] - b[d]);
        if (is_inside(s, X)) inside = share;
        else part = share;
    }
    return inside * length;
}

/* True if the boundary has a value; supports have none. */
static bool is_load(const struct boundary *b, int dim)
{
    return b->kind != BOUNDARY_MIRROR && dot(b->value, b->value, dim) > 0;
}

static const struct boundary *find_boundary(const struct scene *s, enum boundary_kind kind)
{
    for (int k = 0; k < s->boundaries; k++)
        if (s->boundary[k].kind == kind && is_load(&s->boundary[k], s->dim)) return &s->boundary[k];
    return NULL;
}

static const struct wave_pulse *first_pulse(const struct scene *s)
{
    const struct wave_pulse *least = NULL;
    for (int k = 0; k < s->initials; k++)
        if (s->initial[k].sets_pulse && (!least || s->initial[k].pulse.width < least->width))
            least = &s->initial[k].pulse;
    return least;
}

static real size_of(const real *value, int dim) { return sqrt(dot(value, value, dim)); }

/* ---- kinds ------------------------------------------------------------------------------------------------------- */

/* Sets kind, feature [m] and growth of the error. `distance`: travel of waves during the scene [m]. Phase errors grow
 * in proportion to it; errors of a front (step load on a bar, spall) grow with its square root, since they are of order
 * 1/2 in the spacing and depend on two lengths only. A shorter distance gives no smaller error. */
static void set_kind(struct auto_match *m, int kind, real feature, real distance)
{
    const real farther = kinds[kind].travel > 0 ? distance / feature / kinds[kind].travel : 1;
    m->kind = &kinds[kind], m->feature = feature, m->travel = distance / feature;
    const bool front = kind == STEP || kind == SPALL;
    m->growth = front ? sqrt(real_max(1, farther)) : m->kind->smooth ? real_max(1, farther) : 1;
    if (m->kind->at) m->cases = 1, m->at[0] = m->kind->at;
}

/* Cases for the direction of a wave: errors vary as cos(4 angle) on a square lattice, and the cases of the table are at
 * its values 1, 0 and -1. Between two cases the worse counts. */
static void wave_cases(struct auto_match *m, const struct wave_pulse *w)
{
    static const char *const at[2][3] = {{"P 0 deg", "P 22.5 deg", "P 45 deg"}, {"S 0 deg", "S 22.5 deg", "S 45 deg"}};
    const real place = 1 - cos(4 * atan2(w->direction[1], w->direction[0]));
    const int low = place < 1 - 1e-6 ? 0 : place < 2 - 1e-6 ? 1 : 2;
    m->cases = 0;
    m->at[m->cases++] = at[w->transverse][low];
    if (place > low + 1e-6) m->at[m->cases++] = at[w->transverse][low + 1];
}

/* True if pulses differ in type or direction (opposite directions are equal): the problem of the table has one
 * pulse. */
static bool pulses_differ(const struct scene *s, const struct wave_pulse *w)
{
    bool differ = false;
    for (int k = 0; k < s->initials; k++) {
        const struct wave_pulse *other = &s->initial[k].pulse;
        if (!s->initial[k].sets_pulse) continue;
        differ |= other->transverse != w->transverse || fabs(dot(other->direction, w->direction, s->dim)) < 1 - 1e-6;
    }
    return differ;
}

/* Initial pulses: the feature is the width of the narrowest. */
static status match_pulse(struct auto_match *m, const struct scene *s, const struct wave_pulse *w)
{
    const struct material *a = &s->material[0];
    const real speed = w->transverse ? a->shear_speed : a->wave_speed, distance = speed * s->duration;
    if (pulses_differ(s, w)) return no_match("pulses of several directions or kinds");
    m->strain = fabs(w->velocity) / speed;
    if (s->dim == 1) set_kind(m, PULSE, w->width, distance);
    else if (s->dim == 2) set_kind(m, w->transverse ? WAVE_S : WAVE_P, w->width, distance), wave_cases(m, w);
    else {
        /* along an axis each layer of material points moves as in the plane; families of bonds differ */
        for (int d = 0; d < 3; d++)
            if (fabs(w->direction[d]) > 1e-9 && fabs(w->direction[d]) < 1 - 1e-9)
                return no_match("a pulse in a solid, not along an axis; nearest is one that is");
        set_kind(m, w->transverse ? WAVE_S : WAVE_P, w->width, distance);
        m->cases = 1, m->at[0] = w->transverse ? "S 0 deg" : "P 0 deg", m->points_only = true,
        m->growth *= SOLID_GROWTH;
    }
    return OK;
}

/* Bar under traction: the feature is its length for a constant load, the length of the pulse for a pulse. */
static status match_bar(struct auto_match *m, const struct scene *s)
{
    const struct boundary *load = find_boundary(s, BOUNDARY_TRACTION);
    const real c = s->material[0].wave_speed;
    if (!load) return no_match("a bar without initial pulse and without traction; nearest is one with one of them");
    m->strain = fabs(load->value[0]) / s->material[0].young;
    if (load->time.kind == TIME_CONSTANT) set_kind(m, STEP, auto_extent(s, 0, 0), c * s->duration);
    else if (load->time.kind == TIME_PULSE)
        set_kind(m, PULSE, c * (load->time.until - load->time.from), c * s->duration);
    else return no_match("a traction that is neither constant nor a pulse; nearest is time: {pulse: ..}");
    return OK;
}

/* Sine of body force in two or three dimensions: the feature is the wavelength along an axis. */
static status match_forced(struct auto_match *m, const struct scene *s)
{
    real least = INFINITY;
    for (int k = 0; k < s->boundaries; k++) {
        const struct boundary *b = &s->boundary[k];
        if (b->kind != BOUNDARY_BODY_FORCE || b->profile.kind != PROFILE_SINE) continue;
        /* a wave along a diagonal measures L/sqrt(dim) from crest to crest and L along each axis */
        const real *a = b->profile.direction;
        real most = 0;
        for (int d = 0; d < s->dim; d++) most = real_max(most, fabs(a[d]) / size_of(a, s->dim));
        least = real_min(least, b->profile.wavelength / most);
    }
    if (!isfinite(least) || s->dim == 1)
        return no_match("neither pulse, crack, hole nor a sine of body force in two or three dimensions");
    set_kind(m, s->dim == 2 ? SQUARE : CUBE, least, s->material[0].wave_speed * s->duration);
    return OK;
}

/* Equilibrium of a plate: the feature is the radius of its hole or the length of its crack. */
static status match_static(struct auto_match *m, const struct scene *s)
{
    const struct boundary *load = find_boundary(s, BOUNDARY_TRACTION);
    const real hole = hole_radius(s), strain = load ? size_of(load->value, s->dim) / s->material[0].young : 0;
    bool embedded = false;
    if (s->dim != 2 || (s->cracks == 0 && !isfinite(hole)))
        return no_match("at rest it knows plates with a round hole or a crack");
    m->strain = 3 * strain;                  /* at a hole's ends */
    if (s->cracks == 0) {
        set_kind(m, HOLE, hole, hole);
        return OK;
    }
    real least = INFINITY;
    bool any = false;
    for (int k = 0; k < s->cracks; k++) {
        const real length = crack_length(s, &s->crack[k], &embedded);
        if (length > 0 && length < least) least = length, any = embedded;
    }
    if (!isfinite(least)) return no_match("none of its cracks ends in the first box of its body");
    set_kind(m, any ? INCLINED : EDGE, least, least);
    return OK;
}

/* Suddenly loaded crack: the feature is the distance from the loaded face to the crack. */
static status match_sudden(struct auto_match *m, const struct scene *s)
{
    const struct boundary *load = find_boundary(s, BOUNDARY_TRACTION);
    if (!load) return no_match("a crack that cannot break and no traction; nearest is one that waves from a face load");
    const struct solid *a = &s->body[0].shape.solid[0];
    const real face = load->side > 0 ? a->to[load->face] : a->from[load->face];
    real way = INFINITY;
    for (int k = 0; k < s->cracks; k++) way = real_min(way, fabs(s->crack[k].corner[1][load->face] - face));
    if (!(way > 0)) return no_match("a crack that ends on the loaded face");
    m->strain = size_of(load->value, s->dim) / s->material[0].young;
    set_kind(m, s->growths > 0 ? MOVING : SUDDEN, way, s->material[0].wave_speed * s->duration);
    return OK;
}

/* Spalling bar: the pulse is twice as long as the flyer, which is the region of an initial velocity or a body that has
 * one. */
static status match_spall(struct auto_match *m, const struct scene *s)
{
    real from[DIM_MAX], to[DIM_MAX], least = INFINITY, fastest = 0;
    for (int k = 0; k < s->initials; k++)
        if (s->initial[k].sets_velocity && s->initial[k].region.n > 0 &&
            region_bounds(&s->initial[k].region, 1, from, to))
            least = real_min(least, to[0] - from[0]), fastest = real_max(fastest, fabs(s->initial[k].velocity[0]));
    for (int b = 0; b < s->bodies; b++)
        if (s->body[b].velocity[0] != 0)
            least = real_min(least, auto_extent(s, b, 0)), fastest = real_max(fastest, fabs(s->body[b].velocity[0]));
    if (!isfinite(least))
        return no_match("a bar that may break and nothing that flies; nearest is a spall by an impact");
    m->strain = 0.5 * fastest / s->material[0].wave_speed;
    set_kind(m, SPALL, 2 * least, s->material[0].wave_speed * s->duration);
    return OK;
}

/* Cracking plate: pulled if the load acts across the first crack, struck if it acts along it. */
static status match_fracture(struct auto_match *m, const struct scene *s)
{
    const struct boundary *drive = find_boundary(s, BOUNDARY_VELOCITY), *load = find_boundary(s, BOUNDARY_TRACTION);
    const struct boundary *b = drive ? drive : load;
    if (s->dim != 2 || s->cracks == 0 || !b)
        return no_match("of what breaks it knows bars that spall and plates with cracks that are driven or pulled");
    const real *c0 = s->crack[0].corner[0], *c1 = s->crack[0].corner[1], way[2] = {c1[0] - c0[0], c1[1] - c0[1]};
    const bool along = fabs(dot(way, b->value, 2)) > fabs(way[0] * b->value[1] - way[1] * b->value[0]);
    set_kind(m, along ? IMPACT : PULLED, narrowest(s), s->material[0].wave_speed * s->duration);
    return OK;
}

/* True for one crack along an axis, from the edge of a body that is one box. */
static bool may_be_gap(const struct scene *s)
{
    if (s->dim != 2 || s->cracks != 1 || s->bodies != 1 || s->body[0].shape.n != 1 || s->has_pd_region) return false;
    const real *a = s->crack[0].corner[0], *b = s->crack[0].corner[1];
    return (a[0] == b[0]) != (a[1] == b[1]) && is_inside(s, a) != is_inside(s, b);
}

/* ---- proportions ------------------------------------------------------------------------------------------------- */

/* True if two mirrors make the body endless along an axis. */
static bool is_endless(const struct scene *s, int axis)
{
    int mirrors = 0;
    for (int k = 0; k < s->boundaries; k++)
        mirrors += s->boundary[k].kind == BOUNDARY_MIRROR && s->boundary[k].axis == axis;
    return mirrors > 1;
}

/* From the tip of an edge crack along it to the far edge [m]. */
static real ligament(const struct scene *s, const struct crack *c)
{
    bool embedded = false;
    const real length = crack_length(s, c, &embedded);
    if (embedded || !(length > 0)) return INFINITY;
    const int along = fabs(c->corner[1][0] - c->corner[0][0]) < fabs(c->corner[1][1] - c->corner[0][1]);
    return auto_extent(s, 0, along) - length;
}

/* REFUSED for bodies that are thinner beside the feature, or have a shorter ligament, than those of the table. */
static status check_proportions(const struct auto_match *m, const struct scene *s)
{
    const bool forced = m->kind == &kinds[SQUARE] || m->kind == &kinds[CUBE];
    const bool wave = m->kind == &kinds[WAVE_P] || m->kind == &kinds[WAVE_S];
    const real least = (forced ? 0.5 : wave ? 1 : 0) * m->feature * (1 - 1e-6);
    for (int d = 0; d < s->dim; d++)
        if (auto_extent(s, 0, d) < least && !is_endless(s, d))
            return no_match(forced ? "a body thinner than half the wavelength"
                                   : "a body thinner than the packet's width");
    for (int k = 0; k < s->cracks && m->kind == &kinds[EDGE]; k++)
        if (ligament(s, &s->crack[k]) < m->feature * (1 - 1e-6))
            return no_match("an edge crack that is longer than what is left before it");
    return OK;
}

/* ---- all --------------------------------------------------------------------------------------------------------- */

/* Does a formula say how large something is? Its value is not known here. */
static bool scales_by_formula(const struct scene *s)
{
    int steps = 0;
    for (int d = 0; d < s->dim; d++) {
        for (int k = 0; k < s->boundaries; k++) steps += s->boundary[k].formula[d].n;
        for (int k = 0; k < s->initials; k++) steps += s->initial[k].formula[d].n;
    }
    return steps > 0;
}

/* REFUSED for what no problem of the table has. */
static status check_ordinary(const struct scene *s)
{
    if (s->materials > 1) return no_match("several materials");
    if (scene_scatters(s)) return no_match("a strength that scatters");
    if (s->irregularity > 0) return no_match("a shaken lattice (particles.irregularity)");
    for (int b = 0; b < s->bodies; b++) {
        const struct region *shape = &s->body[b].shape;
        if (s->body[b].file) return no_match("a body from a particle list");
        if (shape->n == 0 || !solid_is(&shape->solid[0], SOLID_BOX))
            return no_match("a body whose first solid is no box");
        for (int k = 0; k < shape->n; k++)
            if (shape->solid[k].kind > SOLID_HALF_SPACE || shape->solid[k].images > 0 || shape->solid[k].intersect)
                return no_match("a body of other solids than boxes, balls and half-spaces where they are");
    }
    if (material_yields(&s->material[0])) return no_match("a material that yields");
    for (int k = 0; k < s->boundaries; k++)
        if (s->boundary[k].displaces && is_load(&s->boundary[k], s->dim))
            return no_match("a prescribed displacement; nearest is a velocity");
    if (scales_by_formula(s)) return no_match("a load or an initial velocity by a formula");
    return OK;
}

/* Selects the problem by content of the scene. `at_rest`: the scene has a static solver. */
static status auto_match_problem(struct auto_match *m, const struct scene *s, bool at_rest)
{
    const struct wave_pulse *pulse = first_pulse(s);
    const bool several = s->bodies > 1 && !(s->dim == 1 && breaks(s));
    TRY(check_ordinary(s));
    if (several) return no_match("several bodies; nearest is a bar struck by another");
    if (at_rest) return match_static(m, s);
    if (s->growths == 0 && breaks(s)) return s->dim == 1 ? match_spall(m, s) : match_fracture(m, s);
    if (s->cracks > 0 && s->dim != 2) return no_match("a crack that is loaded in time, not in the plane");
    if (s->cracks > 0) return match_sudden(m, s);
    if (isfinite(hole_radius(s)))
        return no_match("a hole that is loaded in time; nearest is one at rest (solver: static)");
    if (pulse) return match_pulse(m, s, pulse);
    return s->dim == 1 ? match_bar(m, s) : match_forced(m, s);
}

/* REFUSED for loads and initial motion that the matched problem does not have. */
static status check_loads(const struct auto_match *m, const struct scene *s)
{
    bool moves = false;
    for (int k = 0; k < s->boundaries; k++)
        if (is_load(&s->boundary[k], s->dim) && !(m->kind->loads >> s->boundary[k].kind & 1))
            return no_match(
                "a load that its nearest problem does not have (bar and plate waves: initial pulses alone)");
    for (int k = 0; k < s->initials; k++) moves |= s->initial[k].sets_velocity || s->initial[k].sets_strain;
    for (int b = 0; b < s->bodies; b++) moves |= dot(s->body[b].velocity, s->body[b].velocity, s->dim) > 0;
    if (moves && m->kind != &kinds[SPALL])
        return no_match("an initial velocity or strain; nearest is a bar that spalls");
    return OK;
}

status auto_match_find(struct auto_match *m, const struct scene *s, bool at_rest)
{
    *m = (struct auto_match){0};
    TRY(auto_match_problem(m, s, at_rest));
    TRY(check_loads(m, s));
    TRY(check_proportions(m, s));
    if (!(m->feature > 0)) return no_match("what its spacing would resolve has no length");
    const struct material *a = &s->material[0];
    if (s->dim > 1 && fabs(a->c12 / a->c11 - 1.0 / 3) > 1e-3) m->growth *= MATERIAL_GROWTH;
    const bool bonds = s->growths > 0 || (breaks(s) && !at_rest) || scene_watches_bonds(s);
    m->at_rest = at_rest;
    m->gap = !bonds && may_be_gap(s);
    m->needs_bonds = bonds || s->cracks > 0;
    return OK;
}
