/* Tests the closed forms for bars against the method of characteristics, jump conditions and the wave equation. Also
 * tests the force across a section by bonds against all pairs, and the values of an exact probe for fields set here. */
#include <stdlib.h>

#include "tests/support/cloud.h"
#include "tests/support/near.h"
#include "probes/probes.h"
#include "src/probes/probes_parts.h"
#include "loads/mirrors.h"

/* ---- step bar: characteristics ----------------------------------------------------------------------------------- */

enum { CELLS = 40, TRANSITS = 5 };

/* State of the method of characteristics, exact for step loads, with cells that a wave crosses in one time step.
 * Characteristic values sigma - rho c v (right) and sigma + rho c v (left) move by a cell per step. Boundary
 * conditions: sigma = F at the loaded end, v = 0 or sigma = 0 at the other. */
struct waves {
    real right[CELLS], left[CELLS], displacement[CELLS];
};

static void waves_step(struct waves *w, const struct exact *e, real impedance, real dt)
{
    real right[CELLS], left[CELLS];
    int in = e->loaded > 0 ? CELLS - 1 : 0, far = CELLS - 1 - in;
    for (int k = 0; k + 1 < CELLS; k++) right[k + 1] = w->right[k], left[k] = w->left[k + 1];
    real *enters = e->loaded > 0 ? &left[in] : &right[in], *reversions = e->loaded > 0 ? &right[far] : &left[far];
    *enters = 2 * e->load - (e->loaded > 0 ? w->right[in] : w->left[in]); /* sigma = F */
    *reversions = e->reflection[e->loaded > 0 ? 0 : 1] * (e->loaded > 0 ? w->left[far] : w->right[far]);
    for (int k = 0; k < CELLS; k++) { /* a wave passes the middle of its cell at half a step */
        real old = (w->left[k] - w->right[k]) / (2 * impedance), now = (left[k] - right[k]) / (2 * impedance);
        w->displacement[k] += 0.5 * dt * (old + now);
        w->right[k] = right[k], w->left[k] = left[k];
    }
}

static void step_bar_by_characteristics(void **state)
{
    (void)state;
    for (int which = 0; which < 4; which++) {
        int loaded = which & 1 ? 1 : -1, far = which & 2 ? 1 : -1;
        struct exact e = {.form = EXACT_STEP_BAR,
                          .left = -0.5,
                          .right = 1.5,
                          .young = 1e4,
                          .density = 4,
                          .reflection = {loaded > 0 ? far : -1, loaded > 0 ? -1 : far},
                          .loaded = loaded,
                          .load = -3};
        real dx = 2.0 / CELLS, c = 50, impedance = 200; /* sqrt(1e4 / 4), 4 x 50 */
        struct waves w = {{0}, {0}, {0}};
        for (int step = 1; step <= TRANSITS * CELLS + 7; step++) {
            waves_step(&w, &e, impedance, dx / c);
            for (int k = 0; k < CELLS; k++) {
                struct exact_values v = bar_exact_solution_at_position(&e, -0.5 + (k + 0.5) * dx, step * dx / c);
                assert_near(v.stress, 0.5 * (w.right[k] + w.left[k]), 1e-12 * 3);
                assert_near(v.velocity, (w.left[k] - w.right[k]) / (2 * impedance), 1e-13);
                assert_near(v.displacement, w.displacement[k], 1e-12);
                assert_near(v.strain, v.stress / 1e4, 1e-18);
            }
        }
    }
}

/* Returns the solution `form` for a bar of length 1 fixed at 0 with c = 100, the data of Zeng et al. 2021, section
 * 5.1. */
static struct exact unit_bar(enum exact_form form)
{
    return (struct exact){.form = form,
                          .right = 1,
                          .young = 1e4,
                          .tangent = 5e3,
                          .yield = 0.5,
                          .density = 1,
                          .reflection = {1, -1},
                          .loaded = 1,
                          .load = 1};
}

static void step_bar_fronts_and_plateaus(void **state)
{
    (void)state;
    struct exact e = unit_bar(EXACT_STEP_BAR);
    struct exact_front f[EXACT_FRONTS];
    static const struct {
        real t, place;
        int ahead;
        real before, behind;
        bool plateau;
        real from, to;
    } want[] = {{0.005, 0.5, -1, 0, 1, true, 0.6, 0.9},    {0.0125, 0.25, 1, 1, 2, true, 0.1, 0.15},
                {0.0025, 0.75, -1, 0, 1, true, 0.85, 0.9}, {0.015, 0.5, 1, 1, 2, true, 0.1, 0.4},
                {0.0275, 0.25, -1, 2, 1, true, 0.35, 0.9}, {0.0325, 0.25, 1, 1, 0, true, 0.1, 0.15},
                {0.001, 0.9, -1, 0, 1, false, 0, 0}};
    for (size_t k = 0; k < COUNT_OF(want); k++) {
        real from, to;
        assert_int_equal(bar_exact_solution_compute_stress_fronts(&e, want[k].t, f), 1);
        assert_near(f[0].position, want[k].place, 1e-12);
        assert_int_equal(f[0].ahead, want[k].ahead);
        assert_near(f[0].before, want[k].before, 1e-12);
        assert_near(f[0].behind, want[k].behind, 1e-12);
        assert_near(bar_exact_solution_at_position(&e, f[0].position + 1e-6 * f[0].ahead, want[k].t).stress,
                    f[0].before, 1e-12);
        assert_near(bar_exact_solution_at_position(&e, f[0].position - 1e-6 * f[0].ahead, want[k].t).stress,
                    f[0].behind, 1e-12);
        assert_int_equal(bar_exact_solution_find_constant_stress_range(&e, want[k].t, EXACT_PLATEAU, &from, &to),
                         want[k].plateau);
        assert_false(
            bar_exact_solution_find_constant_stress_range(&e, want[k].t, EXACT_PRECURSOR, &(real){0}, &(real){0}));
        if (!want[k].plateau) continue;
        assert_near(from, want[k].from, 1e-12);
        assert_near(to, want[k].to, 1e-12);
    }
    assert_near(bar_exact_solution_at_position(&e, 1, 0.0125).displacement, 1.25e-4, 1e-18);
}

/* ---- plastic bar: jump conditions -------------------------------------------------------------------------------- */

/* Checks a plastic bar loaded at either end: the jump conditions of momentum and continuity at both fronts, stress and
 * strain behind them, and the ranges of constant stress in the published figures, to a tenth of a spacing. */
static void plastic_bar_jumps(void **state)
{
    (void)state;
    for (int side = -1; side <= 1; side += 2) {
        struct exact e = unit_bar(EXACT_PLASTIC_BAR);
        struct exact_front f[EXACT_FRONTS];
        const real t = 0.0075, speed[2] = {100, 70.710678118654755}, place[2] = {0.25, 1 - 0.0075 * 70.710678118654755};
        e.loaded = side, e.load = -1, e.reflection[0] = -side, e.reflection[1] = side;
        assert_int_equal(bar_exact_solution_compute_stress_fronts(&e, t, f), 2);
        for (int k = 0; k < 2; k++) {
            struct exact_values a = bar_exact_solution_at_position(&e, f[k].position + 1e-9 * f[k].ahead, t);
            struct exact_values b = bar_exact_solution_at_position(&e, f[k].position - 1e-9 * f[k].ahead, t);
            real along = f[k].ahead * speed[k]; /* velocity of the front */
            assert_int_equal(f[k].ahead, -side);
            assert_near(f[k].position, side > 0 ? place[k] : 1 - place[k], 1e-12);
            assert_near(b.stress - a.stress, -1 * along * (b.velocity - a.velocity), 1e-12); /* momentum */
            assert_near(b.velocity - a.velocity, -along * (b.strain - a.strain), 1e-13);     /* continuity */
            assert_near(b.displacement, a.displacement, 1e-10);
            assert_near(a.stress, f[k].before, 0);
            assert_near(b.stress, f[k].behind, 0);
        }
        struct exact_values first = bar_exact_solution_at_position(&e, side > 0 ? 0.37 : 0.63, t);
        struct exact_values second = bar_exact_solution_at_position(&e, side > 0 ? 0.7 : 0.3, t);
        assert_near(first.stress, -0.5, 0);
        assert_near(first.strain, -5e-5, 1e-18);
        assert_near(second.stress, -1, 0);
        assert_near(second.strain, -1.5e-4, 1e-18);
        real from, to, h = 1e-5; /* velocity is the rate of displacement */
        for (real X = 0.3; X < 0.71; X += 0.1)
            assert_near((bar_exact_solution_at_position(&e, X, t + h).displacement -
                         bar_exact_solution_at_position(&e, X, t - h).displacement) /
                            (2 * h),
                        bar_exact_solution_at_position(&e, X, t).velocity, 1e-12);
        assert_true(bar_exact_solution_find_constant_stress_range(&e, t, EXACT_PRECURSOR, &from, &to));
        assert_near(side > 0 ? from : 1 - to, 0.32, 5e-4); /* the windows of the published figures, to a tenth of a
                                                            * spacing */
        assert_near(side > 0 ? to : 1 - from, 0.42, 5e-4); /* of 5e-3 */
        assert_true(bar_exact_solution_find_constant_stress_range(&e, t, EXACT_PLATEAU, &from, &to));
        assert_near(side > 0 ? from : 1 - to, 0.55, 5e-4);
        assert_near(side > 0 ? to : 1 - from, 0.9, 5e-4);
        assert_true(isnan(bar_exact_solution_at_position(&e, 0.5, 0.0101).stress) &&
                    bar_exact_solution_compute_stress_fronts(&e, 0.0101, f) == 0);
        e.load = -0.4; /* no plastic front below the yield stress */
        assert_int_equal(bar_exact_solution_compute_stress_fronts(&e, t, f), 1);
        assert_near(bar_exact_solution_at_position(&e, 0.5, t).strain, -4e-5, 1e-18);
    }
}

/* ---- smooth forms: the wave equation ----------------------------------------------------------------------------- */

/* Compares finite differences of the displacement of e at (X, t) with velocity, strain and, if `wave`, the wave
 * equation, within `tolerance` times `scale`. Central differences have an error of h^2/6 times the third derivative. In
 * the wave equation with c k = h these errors cancel, up to the round-off of distances up to 5 with strains up to 0.02:
 * 4 x 5 x 0.02 x 2^-53/h^2, where u_xx is of order 1. */
static void check_smooth(const struct exact *e, real X, real t, real scale, real tolerance, bool wave)
{
    real c = sqrt(e->young / e->density), h = 1e-3 * scale, k = h / c;
    struct exact_values here = bar_exact_solution_at_position(e, X, t);
    real right = bar_exact_solution_at_position(e, X + h, t).displacement,
         left = bar_exact_solution_at_position(e, X - h, t).displacement;
    real later = bar_exact_solution_at_position(e, X, t + k).displacement,
         earlier = bar_exact_solution_at_position(e, X, t - k).displacement;
    assert_near((later - earlier) / (2 * k), here.velocity, tolerance * c);
    assert_near((right - left) / (2 * h), here.strain, tolerance);
    assert_near(here.stress, e->young * here.strain, 1e-12 * e->young * tolerance);
    if (wave) assert_near((right + left - later - earlier) / (h * h), 0, 0.4 * 0x1p-53 / (h * h));
}

static void pulses_obey_the_wave_equation(void **state)
{
    (void)state;
    const struct wave_pulse pulse[] = {{{0.3}, {1}, 0.2, 2, {1}, false}, {{0.6}, {-1}, 0.12, -1, {-1}, false}};
    for (int ends = 0; ends < 4; ends++) {
        struct exact e = {.form = EXACT_PULSE,
                          .left = 0,
                          .right = 1,
                          .young = 1e4,
                          .density = 1,
                          .reflection = {ends & 1 ? 1 : -1, ends & 2 ? 1 : -1},
                          .pulse = pulse,
                          .pulses = 2};
        for (real X = 0.02; X < 1; X += 0.0531) {
            real first = exp(-square((X - 0.3) / 0.05)), second = exp(-square((X - 0.6) / 0.03));
            struct exact_values v = bar_exact_solution_at_position(&e, X, 0);
            assert_near(v.velocity, 2 * first + second, 1e-9);         /* along their characteristics */
            assert_near(v.strain, (-2 * first + second) / 100, 1e-11); /* f' = -v/c */
            for (real t = 1e-3; t < 0.05; t += 1.713e-3) check_smooth(&e, X, t, 0.03, 4e-8, true);
        }
        for (real t = 0; t < 0.05; t += 1e-3) /* boundary conditions */
            for (int end = 0; end < 2; end++) {
                struct exact_values v = bar_exact_solution_at_position(&e, end, t);
                assert_near(e.reflection[end] > 0 ? v.velocity : 100 * v.strain, 0, 1e-9);
            }
    }
}

static void manufactured_is_its_formula(void **state)
{
    (void)state;
    struct exact e = {.form = EXACT_MANUFACTURED,
                      .right = 1,
                      .young = 1e4,
                      .density = 1,
                      .amplitude = 1e-3,
                      .period = 0.02,
                      .wavelength = 0.5,
                      .origin = 0.1};
    assert_near(bar_exact_solution_at_position(&e, 0.225, 0.01).displacement, 1e-3,
                1e-15); /* a quarter wave later, at its peak */
    for (real X = 0; X < 1; X += 0.07) {
        struct exact_values v = bar_exact_solution_at_position(&e, X, 0);
        assert_near(fabs(v.displacement) + fabs(v.velocity) + fabs(v.stress), 0, 0);
        for (real t = 1e-3; t < 0.03; t += 2.3e-3) check_smooth(&e, X, t, 0.05, 1e-8, false);
    }
}

/* ---- force across a section by bonds ----------------------------------------------------------------------------- */

/* Compares the force across sections with a sum over all pairs, for an irregular row with mirror images at a wall at 0.
 * About a third of the particles are material points; every pair within the horizon has a bond unless both are material
 * points. */
static void flux_is_the_force_across(void **state)
{
    (void)state;
    const struct cloud_plan plan = {.space = SPACE_LINE,
                                    .count = {40},
                                    .horizon = 3.2,
                                    .shake = 0.3,
                                    .seed = 5,
                                    .calibration = CALIBRATION_CONTINUUM};
    const struct boundary wall = {.kind = BOUNDARY_MIRROR, .name = "wall"};
    struct particle_cloud c;
    struct loads l;
    struct bar bar = {0};
    struct particles *p = &c.p;
    real flux[40], scale = 0;
    uint64_t seed = 3;
    particle_cloud_make(&c, &plan);
    assert_ok(loads_make_from_boundaries(&l, &wall, 1, p, CLOUD_SPACING, c.source.family.cutoff, 0));
    for (int i = 0; i < 40; i++) {
        p->x[0][i] = p->X[0][i] + cloud_between(&seed, -0.01, 0.01) * CLOUD_SPACING;
        p->kind[i] = i > 20 && i < 33 ? KIND_MPM : KIND_PD;
        p->stress[0][i] = i;
    }
    loads_update_mirror_images_of_particles(&l, p);
    c.source.image = l.image;
    cloud_bonds(&c);
    bar.n = 40, bar.order = NEW("order", 40, int32_t), bar.rank = NEW("rank", 40, int32_t);
    for (int i = 0; i < 40; i++) bar.order[i] = bar.rank[i] = i;
    struct observed_run o = {.part = p, .bonds = &c.bonds, .thickness = c.source.family.section};
    bar_probe_compute_bond_flux_stress(&bar, &o, flux);

    real modulus = family_micro_modulus(&c.source.family, &c.material[0]);
    for (int k = 0; k < 40; k++) {
        real sum = 0;
        if (p->kind[k] == KIND_MPM) {
            assert_exact(flux[k], k);
            continue;
        }
        for (int i = 0; i < 40; i++)
            for (int j = 0; j < p->n_all; j++) {
                real r = fabs(p->X[0][j] - p->X[0][i]), X = p->X[0][k];
                if (j <= i || r > c.source.family.cutoff || (p->kind[i] == KIND_MPM && p->kind[j] == KIND_MPM))
                    continue;
                real low = real_min(p->X[0][i], p->X[0][j]), high = real_max(p->X[0][i], p->X[0][j]);
                real share = X > low && X < high ? 1 : k == i || k == j ? 0.5 : 0;
                sum += share * modulus * p->volume0[i] * p->volume0[j] * (fabs(p->x[0][j] - p->x[0][i]) / r - 1);
            }
        sum /= c.source.family.section;
        scale = real_max(scale, fabs(sum));
        assert_near(flux[k], sum, 1e-12 * scale + 1);
    }
    assert_true(scale > 1e7); /* 1 Pa is negligible */
    memory_free(bar.order), memory_free(bar.rank);
    loads_free(&l);
    particle_cloud_free(&c);
}

/* ---- the probe --------------------------------------------------------------------------------------------------- */

/* Names and values that a probe has reported. */
struct figures {
    int n;
    char name[32][NAME_MAX_LENGTH];
    real value[32];
};

static void keep(void *context, const char *probe, const char *quantity, real value)
{
    struct figures *f = context;
    assert_string_equal(probe, "bar");
    snprintf(f->name[f->n], NAME_MAX_LENGTH, "%s", quantity);
    f->value[f->n++] = value;
}

static real figure(const struct figures *f, const char *name)
{
    for (int k = 0; k < f->n; k++)
        if (strcmp(f->name[k], name) == 0) return f->value[k];
    return NAN;
}

/* A bar of 200 material points on [0, 1], fixed at 0, loaded at 1 with F = 1, E = 1e4, rho = 1. */
struct lab {
    struct particles p;
    struct material material;
    struct boundary boundary[4];
    struct load load[4];
    struct loads loads;
    int32_t first, last;
    struct observed_run o;
};

static void lab_make(struct lab *b)
{
    *b = (struct lab){.last = 199};
    particles_make(&b->p, 1, 200, 0);
    for (int i = 0; i < 200; i++) b->p.x[0][i] = b->p.X[0][i] = (i + 0.5) / 200;
    b->material = (struct material){.young = 1e4, .density = 1, .yield_stress = 0.5, .yield_tangent = 5e3};
    b->boundary[0] = (struct boundary){.kind = BOUNDARY_MIRROR};
    b->boundary[1] = (struct boundary){.kind = BOUNDARY_TRACTION, .value = {1}, .side = 1};
    b->load[0] = (struct load){.boundary = &b->boundary[0]};
    b->load[1] = (struct load){.boundary = &b->boundary[1], .n = 1, .particle = &b->last};
    b->load[2].boundary = &b->boundary[2], b->load[3].boundary = &b->boundary[3];
    b->loads = (struct loads){.n = 2, .load = b->load};
    b->o = (struct observed_run){
        .part = &b->p, .loads = &b->loads, .material = &b->material, .spacing = 0.005, .thickness = 1};
}

static void measured(struct lab *b, enum exact_form form, real t, struct figures *f)
{
    const struct probe_request r = {.name = "bar", .kind = PROBE_EXACT, .form = form};
    struct probes s;
    assert_ok(probes_make(&s, &r, 1, &b->o));
    *f = (struct figures){0};
    real stress[200];
    for (int i = 0; i < 200; i++) stress[i] = b->p.stress[0][i];
    struct exact e = unit_bar(form);
    for (int i = 0; i < 200; i++) { /* the exact motion; the stress is set by the test */
        struct exact_values v = bar_exact_solution_at_position(&e, b->p.X[0][i], t);
        b->p.x[0][i] = b->p.X[0][i] + v.displacement, b->p.v[0][i] = v.velocity + 0.25, b->p.stress[0][i] += v.stress;
    }
    b->o.t = b->o.t_velocity = t;
    probes_visit_results(&s, &b->o, keep, f);
    probes_sample_position_dependent_values(&s, &b->o);
    assert_int_equal(s.columns, bar_probe_value_count(form));
    for (int k = 0; k < s.columns; k++) { /* columns are the figures */
        real value = figure(f, strchr(s.column[k].name, '.') + 1);
        assert_true(isnan(value) ? isnan(s.value[k]) : value == s.value[k]);
    }
    for (int i = 0; i < 200; i++) b->p.x[0][i] = b->p.X[0][i], b->p.v[0][i] = 0, b->p.stress[0][i] = stress[i];
    probes_free(&s);
}

static void figures_of_a_made_up_field(void **state)
{
    (void)state;
    struct lab b;
    struct figures f;
    lab_make(&b);
    for (int i = 0; i < 200; i++) b.p.stress[0][i] = i % 2 ? 0.01 : -0.02; /* around the exact stress */
    measured(&b, EXACT_STEP_BAR, 0.005, &f);
    assert_near(figure(&f, "L1"), 0.015, 1e-15);
    assert_near(figure(&f, "L2"), sqrt(0.5 * (1e-4 + 4e-4)), 1e-15);
    assert_near(figure(&f, "plateau"), 0.995, 1e-12);
    assert_near(figure(&f, "L1_velocity"), 0.25, 1e-14);
    assert_near(figure(&f, "L2_velocity"), 0.25, 1e-14);
    assert_near(figure(&f, "L2_displacement"), 0, 1e-16);          /* round-off of x - X */
    assert_near(figure(&f, "end_displacement"), 0.4975e-4, 1e-15); /* ct - s, s half a spacing */
    /* Particles 99 (0.01 off) and 100 (-0.02): 0.01 to 0.98 over a spacing from 0.4975. */
    assert_near(figure(&f, "front"), 0.4975 + 0.005 * 0.49 / 0.97, 1e-12);
    /* The kink is midway between them: central differences of 1/4 and 3/4 of the strain, 2 of 200 particles. */
    assert_near(figure(&f, "L1_strain"), 2 * 0.25 / 200, 1e-10);
    assert_near(figure(&f, "front_strain"), 0.5, 1e-9);
    assert_near(figure(&f, "plateau_strain"), 1, 1e-9);
    assert_true(isnan(figure(&f, "strain_plastic")));

    measured(&b, EXACT_STEP_BAR, 0.0125, &f); /* reflected: from 1 to 2, at 0.25 */
    assert_near(figure(&f, "front"), 0.25, 0.0051);
    assert_near(figure(&f, "plateau"), 1.995, 1e-12);
    measured(&b, EXACT_PLASTIC_BAR, 0.0075, &f);
    assert_near(figure(&f, "front"), 0.25, 0.0051);
    assert_near(figure(&f, "front_plastic"), 0.4697, 0.0051);
    assert_near(figure(&f, "strain_elastic"), 5e-5, 1e-14);
    assert_near(figure(&f, "strain_plastic"), 1.5e-4, 1e-14);
    assert_near(figure(&f, "plateau"), 0.995, 1e-12);
    assert_true(isnan(figure(&f, "plateau_strain")));
    measured(&b, EXACT_PLASTIC_BAR, 0.011, &f); /* no solution, no figure */
    assert_true(isnan(figure(&f, "L1")) && isnan(figure(&f, "front")) && isnan(figure(&f, "strain_plastic")));
    particles_free(&b.p);
}

/* Checks that the mirrored bar, fixed at 1 and loaded at 0, has no errors if it moves as the mirror image of the exact
 * solution. */
static void bars_drawn_at_the_left(void **state)
{
    (void)state;
    struct lab b;
    struct figures f = {0};
    struct probes s;
    lab_make(&b);
    const struct probe_request r = {.name = "bar", .kind = PROBE_EXACT, .form = EXACT_STEP_BAR};
    const struct exact e = unit_bar(EXACT_STEP_BAR);
    const real t = 0.73e-2;
    b.boundary[0].at = 1;
    b.boundary[1] = (struct boundary){.kind = BOUNDARY_TRACTION, .value = {-1}, .side = -1};
    b.load[1].particle = &b.first;
    assert_ok(probes_make(&s, &r, 1, &b.o));
    for (int i = 0; i < 200; i++) {
        const struct exact_values v = bar_exact_solution_at_position(&e, 1 - b.p.X[0][i], t);
        b.p.x[0][i] = b.p.X[0][i] - v.displacement + 3e-7, b.p.v[0][i] = -v.velocity, b.p.stress[0][i] = v.stress;
    }
    b.o.t = b.o.t_velocity = t;
    probes_visit_results(&s, &b.o, keep, &f);
    assert_near(figure(&f, "L1"), 0, 1e-9);
    assert_near(figure(&f, "L1_velocity"), 0, 1e-9);
    assert_near(figure(&f, "plateau"), 1, 1e-9);
    assert_close(figure(&f, "L2_displacement"), 3e-7, 1e-6);
    probes_free(&s);
    particles_free(&b.p);
}

static void refused(struct lab *b, enum exact_form form, const char *why)
{
    const struct probe_request r = {.name = "bar", .kind = PROBE_EXACT, .form = form, .period = 1, .wavelength = 1};
    struct probes s;
    assert_refused(probes_make(&s, &r, 1, &b->o), why);
}

static void bars_that_have_no_closed_form(void **state)
{
    (void)state;
    struct lab b;
    lab_make(&b);
    b.o.loads = NULL, refused(&b, EXACT_STEP_BAR, "no boundary is a traction"), b.o.loads = &b.loads;
    b.loads.n = 3, b.boundary[2] = b.boundary[1];
    refused(&b, EXACT_STEP_BAR, "more than one boundary is a traction");
    b.boundary[2] = (struct boundary){.kind = BOUNDARY_BODY_FORCE};
    refused(&b, EXACT_STEP_BAR, "body_force");
    b.boundary[2] = (struct boundary){.kind = BOUNDARY_VELOCITY, .value = {1}};
    refused(&b, EXACT_STEP_BAR, "drives the bar");
    b.boundary[2] = (struct boundary){.kind = BOUNDARY_VELOCITY}, b.load[2].n = 1, b.load[2].particle = &b.last;
    refused(&b, EXACT_STEP_BAR, "the loaded end is held");
    b.loads.n = 2, b.last = 150, refused(&b, EXACT_STEP_BAR, "does not act on the end of the bar"), b.last = 199;
    b.boundary[1].time.kind = TIME_RAMP, refused(&b, EXACT_STEP_BAR, "changes with time");
    b.boundary[1].time.kind = TIME_CONSTANT, b.boundary[1].value[0] = 0, refused(&b, EXACT_STEP_BAR, "traction is 0");
    b.boundary[1].value[0] = 1, b.p.v[0][7] = 1, refused(&b, EXACT_STEP_BAR, "let it start at rest"), b.p.v[0][7] = 0;
    b.material.yield_tangent = 0, refused(&b, EXACT_PLASTIC_BAR, "without hardening");
    b.material.yield_stress = INFINITY, refused(&b, EXACT_PLASTIC_BAR, "does not yield");
    refused(&b, EXACT_PULSE, "the scene starts none; add a pulse");
    const struct wave_pulse pulse = {{0.5}, {1}, 0.1, 1, {1}, false};
    b.o.pulse = &pulse, b.o.pulses = 1, refused(&b, EXACT_PULSE, "a traction acts");
    b.loads.n = 1, refused(&b, EXACT_PULSE, "must be pulses alone"), b.loads.n = 2;
    b.p.material[3] = 1, refused(&b, EXACT_MANUFACTURED, "several materials"), b.p.material[3] = 0;
    b.p.X[0][199] = 1.2, refused(&b, EXACT_STEP_BAR, "do not touch");
    particles_free(&b.p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(step_bar_by_characteristics),
        cmocka_unit_test(step_bar_fronts_and_plateaus),
        cmocka_unit_test(plastic_bar_jumps),
        cmocka_unit_test(pulses_obey_the_wave_equation),
        cmocka_unit_test(manufactured_is_its_formula),
        cmocka_unit_test(flux_is_the_force_across),
        cmocka_unit_test(figures_of_a_made_up_field),
        cmocka_unit_test(bars_drawn_at_the_left),
        cmocka_unit_test(bars_that_have_no_closed_form),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
