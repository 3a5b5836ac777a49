/* Tests of probes, with particles, supports and bonds set by hand. */
#include <unistd.h>

#include "tests/support/bodies.h"
#include "probes/probes.h"

struct figure_list {
    int n;
    struct {
        char probe[NAME_MAX_LENGTH], quantity[NAME_MAX_LENGTH];
        real value;
    } entry[64];
};

static void figure_keep(void *context, const char *probe, const char *quantity, real value)
{
    struct figure_list *l = context;
    assert_true(l->n < 64);
    snprintf(l->entry[l->n].probe, NAME_MAX_LENGTH, "%s", probe);
    snprintf(l->entry[l->n].quantity, NAME_MAX_LENGTH, "%s", quantity), l->entry[l->n++].value = value;
}

static real figure(const struct figure_list *l, const char *probe, const char *quantity)
{
    for (int k = 0; k < l->n; k++)
        if (strcmp(l->entry[k].probe, probe) == 0 && strcmp(l->entry[k].quantity, quantity) == 0)
            return l->entry[k].value;
    return NAN;
}

static struct observed_run seen(const struct body *b)
{
    return (struct observed_run){.part = &b->p, .cells = &b->c, .spacing = 1, .thickness = 0.37};
}

static struct solid box(real x0, real y0, real x1, real y1)
{
    return (struct solid){.kind = SOLID_BOX, .from = {x0, y0}, .to = {x1, y1}};
}

static int column_named(const struct probes *probes, const char *name)
{
    for (int k = 0; k < probes->columns; k++)
        if (strcmp(probes->column[k].name, name) == 0) return k;
    fail_msg("no column %s", name);
    return -1;
}

static void probes_read_particles_and_regions(void **state)
{
    (void)state;
    struct body b;
    struct probes s;
    struct material m = steel(SPACE_PLANE_STRESS);
    struct figure_list l = {0};
    body_make(&b, 2, (const int[]){10, 10});
    struct observed_run o = seen(&b);
    o.material = &m;
    for (int64_t i = 0; i < b.p.n; i++) {
        b.p.x[0][i] = b.p.X[0][i] * 1.01;
        b.p.v[1][i] = 2;
        b.p.stress[2][i] = (real)i;
    }
    struct solid left = box(0, 0, 5, 10);
    struct probe_request request[] = {
        {.name = "gauge", .kind = PROBE_POINT, .has_at = true, .at = {3.4, 7.6}},
        {.name = "left", .kind = PROBE_MOMENTUM, .region = {.n = 1, .solid = &left}},
        {.name = "all", .kind = PROBE_ENERGY},
        {.name = "patch", .kind = PROBE_PATCH},
    };
    assert_ok(probes_make(&s, request, COUNT_OF(request), &o));
    probes_sample_position_dependent_values(&s, &o);
    probes_sample_energies(&s, &o);
    int64_t i = particle_at(&b, 3.5, 7.5, 0);
    assert_near(s.value[column_named(&s, "gauge.displacement_x")], 0.035, ROUND_OFF);
    assert_near(s.value[column_named(&s, "gauge.velocity_y")], 2, 0);
    assert_near(s.value[column_named(&s, "gauge.stress_xy")], (real)i, 0);
    assert_near(s.value[column_named(&s, "left.x")], 0, 0);
    assert_near(s.value[column_named(&s, "left.y")], 100 * BODY_MASS, 1e-10);
    assert_near(s.value[column_named(&s, "all.kinetic")], 200 * BODY_MASS, 1e-10);
    assert_string_equal(s.column[column_named(&s, "left.y")].unit, "kg m/s");

    struct grid grid = {.h = 2};
    o.grid = &grid, o.strain_stress = 5, o.thickness = 3, o.residual_step0 = 0.6;
    probes_visit_results(&s, &o, figure_keep, &l);
    assert_near(figure(&l, "patch", "residual_max"), 0.6 / (5 * 2 * 3), ROUND_OFF);
    assert_near(figure(&l, "gauge", "stress_xy"), (real)i, 0);
    assert_near(figure(&l, "left", "y"), 100 * BODY_MASS, 1e-10);
    probes_free(&s);
    body_free(&b);
}

static void probes_refuse_what_is_not_there(void **state)
{
    (void)state;
    struct body b;
    struct probes s;
    body_make(&b, 2, (const int[]){10, 10});
    struct boundary boundary[] = {{.name = "grip", .kind = BOUNDARY_VELOCITY},
                                  {.name = "pull", .kind = BOUNDARY_TRACTION}};
    struct load load[] = {{.boundary = &boundary[0]}, {.boundary = &boundary[1]}};
    struct loads loads = {.n = 2, .load = load};
    struct observed_run o = seen(&b);
    o.loads = &loads;
    struct solid outside = box(20, 20, 30, 30);
    struct {
        struct probe_request request;
        const char *says;
    } bad[] = {
        {{.name = "p", .kind = PROBE_POINT, .at = {11.6, 5}}, "point (11.6, 5) m is outside"},
        {{.name = "p", .kind = PROBE_BREAK, .region = {.n = 1, .solid = &outside}}, "contains no particle"},
        {{.name = "p", .kind = PROBE_REACTION, .boundary = "grap"},
         "no boundary is named \"grap\"; give one of these names: \"grip\""},
        {{.name = "p", .kind = PROBE_REACTION, .boundary = "pull"}, "prescribes no motion"},
        {{.name = "p", .kind = PROBE_LINE, .from = {20, 0}, .to = {20, 9}, .points = 5}, "whole line is outside"},
        {{.name = "p", .kind = PROBE_LINE}, "stations is 0, so its line has no position"},
    };
    for (size_t k = 0; k < COUNT_OF(bad); k++) {
        assert_refused(probes_make(&s, &bad[k].request, 1, &o), bad[k].says);
        assert_null(s.probe);
    }
    body_free(&b);
}

static void probe_of_a_support(void **state)
{
    (void)state;
    struct body b;
    struct probes s, again;
    struct figure_list l = {0};
    body_make(&b, 2, (const int[]){4, 4});
    struct boundary grip = {.name = "grip", .kind = BOUNDARY_VELOCITY};
    struct boundary other = {.name = "other", .kind = BOUNDARY_VELOCITY};
    struct load load[] = {{.boundary = &grip, .n = 1}, {.boundary = &other, .n = 1, .reaction = {100, 0}}};
    struct loads loads = {.n = 2, .load = load};
    struct observed_run o = seen(&b);
    o.loads = &loads;
    struct probe_request request = {.name = "reaction", .kind = PROBE_REACTION, .boundary = "grip"};
    assert_ok(probes_make(&s, &request, 1, &o));
    const real force[4][2] = {{3, 4}, {0, -1}, {0, 0}, {-6, 8}};
    for (int k = 0; k < 4; k++) {
        load[0].reaction[0] = force[k][0], load[0].reaction[1] = force[k][1];
        load[0].displacement[1] = -0.25 * k;
        o.load_step = k + 1;
        probes_update_break_spall_and_reaction_probes(&s, &o);
    }
    struct store store = {0};
    struct archive a = {.saving = true, .exchange = store_exchange, .file = &store};
    assert_ok(probes_save_or_load(&s, &a));
    a.saving = false;
    assert_ok(probes_make(&again, &request, 1, &o));
    assert_ok(probes_save_or_load(&again, &a));
    probes_sample_position_dependent_values(&again, &o);
    assert_near(again.value[column_named(&again, "reaction.force_x")], -6, 0);
    assert_near(again.value[column_named(&again, "reaction.displacement_y")], -0.75, 0);
    probes_visit_results(&again, &o, figure_keep, &l);
    assert_near(figure(&l, "reaction", "force_max"), 10, ROUND_OFF);
    assert_near(figure(&l, "reaction", "force_rms"), sqrt((25 + 1 + 100) / 4.0), ROUND_OFF);
    assert_near(figure(&l, "reaction", "displacement"), 0.75, ROUND_OFF);
    assert_near(figure(&l, "reaction", "force_max_displacement"), 0.75, ROUND_OFF);
    assert_near(figure(&l, "reaction", "force_max_step"), 4, 0);
    store_free(&store);
    probes_free(&s);
    probes_free(&again);
    body_free(&b);
}

/* Checks two boundaries with one name: the probe adds their forces and averages displacements over all particles. */
static void probe_of_two_supports(void **state)
{
    (void)state;
    struct body b;
    struct probes s;
    body_make(&b, 2, (const int[]){4, 4});
    struct boundary grip[] = {{.name = "grip", .kind = BOUNDARY_VELOCITY}, {.name = "grip", .kind = BOUNDARY_VELOCITY}};
    struct load load[] = {{.boundary = &grip[0], .n = 3, .reaction = {5, -1}, .displacement = {0.4, 0.1}},
                          {.boundary = &grip[1], .n = 5, .reaction = {-2, 4}, .displacement = {-0.2, 0.3}}};
    struct loads loads = {.n = 2, .load = load};
    struct observed_run o = seen(&b);
    o.loads = &loads;
    struct probe_request request = {.name = "r", .kind = PROBE_REACTION, .boundary = "grip"};
    assert_ok(probes_make(&s, &request, 1, &o));
    probes_update_break_spall_and_reaction_probes(&s, &o);
    probes_sample_position_dependent_values(&s, &o);
    assert_near(s.value[column_named(&s, "r.force_x")], 3, ROUND_OFF);
    assert_near(s.value[column_named(&s, "r.force_y")], 3, ROUND_OFF);
    assert_near(s.value[column_named(&s, "r.displacement_x")], (3 * 0.4 - 5 * 0.2) / 8, ROUND_OFF);
    assert_near(s.value[column_named(&s, "r.displacement_y")], (3 * 0.1 + 5 * 0.3) / 8, ROUND_OFF);
    probes_free(&s);
    body_free(&b);
}

/* Checks that the reflected part of a pulse is the motion before the interface less that without an interface. */
static void probe_of_a_pulse(void **state)
{
    (void)state;
    struct body b;
    struct probes s;
    struct figure_list l = {0};
    real still[20] = {0};
    struct baseline baseline = {.v = {still}, .energy_change = 0.01};
    body_make(&b, 1, (const int[]){20});
    struct observed_run o = seen(&b);
    struct probe_request request = {.name = "pulse", .kind = PROBE_PULSE, .at = {12}, .direction = {2}};
    b.p.v[0][4] = 0.8;
    assert_ok(probes_make(&s, &request, 1, &o));
    b.p.v[0][4] = 0, b.p.v[0][3] = -0.12, b.p.v[0][15] = 0.6, still[3] = -0.03, still[15] = 0.7;
    o.baseline = &baseline, o.energy_change = 0.03;
    probes_visit_results(&s, &o, figure_keep, &l);
    assert_near(figure(&l, "pulse", "reflected"), 0.09 / 0.8, ROUND_OFF);
    assert_near(figure(&l, "pulse", "transmitted"), 0.6 / 0.8, ROUND_OFF);
    assert_near(figure(&l, "pulse", "energy_change"), 0.02, ROUND_OFF);
    probes_free(&s);
    body_free(&b);
}

/* Checks a rotating body in plane strain: its largest stress may be the out-of-plane stress, whereas the shear stress
 * is that in the plane. */
static void probe_of_a_turning_body(void **state)
{
    (void)state;
    struct body b;
    struct probes s;
    struct material m = steel(SPACE_PLANE_STRAIN);
    body_make(&b, 2, (const int[]){3, 3});
    struct observed_run o = seen(&b);
    b.p.plane_strain = &m, b.p.out_of_plane = NEW("test.across", b.p.n, real);
    for (int64_t i = 0; i < b.p.n; i++) b.p.v[0][i] = 1.5 - b.p.X[1][i], b.p.v[1][i] = b.p.X[0][i] - 1.5;
    struct probe_request request = {.name = "turn", .kind = PROBE_RIGID};
    assert_ok(probes_make(&s, &request, 1, &o));
    b.p.stress[0][4] = 3, b.p.stress[1][4] = 1, b.p.stress[2][4] = 2, b.p.out_of_plane[7] = -9;
    for (int64_t i = 0; i < b.p.n; i++) {
        const real x = b.p.X[0][i] - 1.5, y = b.p.X[1][i] - 1.5, c = cos(0.3), n = sin(0.3);
        b.p.x[0][i] = 1.5 + c * x - n * y, b.p.x[1][i] = 1.5 + n * x + c * y;
        b.p.v[0][i] = -1.1 * (b.p.x[1][i] - 1.5), b.p.v[1][i] = 1.1 * (b.p.x[0][i] - 1.5);
    }
    probes_sample_position_dependent_values(&s, &o);
    probes_sample_velocity_dependent_values(&s, &o, &(struct velocity_time){0, 1});
    assert_near(s.value[column_named(&s, "turn.angle")], 0.3, 1e-12);
    assert_near(s.value[column_named(&s, "turn.stress_max")], 9, ROUND_OFF);
    assert_near(s.value[column_named(&s, "turn.shear_max")], sqrt(5), ROUND_OFF);
    assert_near(s.value[column_named(&s, "turn.angular_momentum_error")], 0.1, 1e-12);
    assert_near(s.value[column_named(&s, "turn.kinetic_energy_error")], 0.21, 1e-12);
    b.p.stress[0][4] = -3, b.p.stress[1][4] = -1, b.p.out_of_plane[7] = -4; /* now the largest is in the plane */
    probes_sample_position_dependent_values(&s, &o);
    assert_near(s.value[column_named(&s, "turn.stress_max")], 2 + sqrt(5), ROUND_OFF);
    probes_free(&s);
    body_free(&b);
}

static void probe_of_a_tip(void **state)
{
    (void)state;
    struct body b;
    struct crack_tips t;
    struct probes s;
    struct figure_list l = {0};
    notched_make(&b, &t, 4);
    struct observed_run o = seen(&b);
    o.tips = &t;
    struct probe_request request[] = {{.name = "tip", .kind = PROBE_TIP},
                                      {.name = "right", .kind = PROBE_TIP, .has_at = true, .at = {30, 10}}};
    assert_ok(probes_make(&s, request, 2, &o));
    for (int k = 0; k < 4; k++) hurt(&b, 10.5 + k, 10.5, 0);
    hurt(&b, 30.5, 5.5, 0), hurt(&b, 31.5, 5.5, 0);
    tips_update_from_damage(&t, &b.p, &b.c, 2);
    probes_sample_position_dependent_values(&s, &o);
    assert_near(s.value[column_named(&s, "tip.growth")], 3.5, ROUND_OFF);
    assert_near(s.value[column_named(&s, "right.x")], 31.5, ROUND_OFF);
    probes_visit_results(&s, &o, figure_keep, &l);
    assert_near(figure(&l, "tip", "length_end"), 3.5, ROUND_OFF);
    assert_near(figure(&l, "tip", "start_time"), 2, 0);
    assert_near(figure(&l, "right", "length_end"), 1, ROUND_OFF);
    assert_true(isnan(figure(&l, "tip", "speed_max"))); /* one sample has no speed: left out */
    probes_free(&s);
    notched_free(&b, &t);
}

/* ---- probes of broken bonds -------------------------------------------------------------------------------------- */

struct bar {
    struct body b;
    struct material m;
    struct bonds bonds;
    real stretch;
};

static void bar_bond(struct bar *bar)
{
    bar->m = steel(SPACE_LINE);
    bar->stretch = 1;
    struct bond_source source = {
        .cells = &bar->b.c, .material = &bar->m, .materials = 1, .limit = {&bar->stretch, 1, false}};
    family_make_on_lattice(&source.family, SPACE_LINE, 1, 3.015, 1);
    particles_rebuild_lists_by_kind(&bar->b.p);
    bonds_make(&bar->bonds, NULL, &bar->b.p, &source);
}

/* Breaks the bonds of `bar` across x = `plane` that are at least `shortest` spacings long, with the changes that the
 * bond kernel makes. */
static void bar_cut(struct bar *bar, real plane, real shortest)
{
    struct bonds *b = &bar->bonds;
    struct particles *p = &bar->b.p;
    for (int64_t row = 0; row < b->rows; row++) {
        int32_t i = b->particle[row];
        for (int64_t k = 0; k < b->column_count[row / LANES]; k++) {
            int64_t q = bond_copy_on_write_and_return_array_index(b, row / LANES, k, (int)(row % LANES));
            int32_t j = b->nbr[q];
            bool across = (p->X[0][i] < plane) != (p->X[0][j] < plane);
            if (b->w[q] == 0 || !across || fabs(p->X[0][i] - p->X[0][j]) < shortest - 0.5) continue;
            b->w[q] = 0;
            bond_update_cached_data_after_modification(b, row, q);
            b->broken[row]++;
            p->flag[i] |= FLAG_LOST_BOND | FLAG_CRACKED;
        }
    }
}

static struct observed_run bar_seen(const struct bar *bar, real t)
{
    struct observed_run o = seen(&bar->b);
    o.bonds = &bar->bonds, o.material = &bar->m, o.t = t;
    return o;
}

/* Creates the bonds of `bar` and the spall probe `probes`. Returns the state of the bar for probes at t = 1 s. */
static struct observed_run spall_probe_make(struct probes *probes, struct bar *bar)
{
    struct probe_request request = {.name = "spall", .kind = PROBE_SPALL};
    bar_bond(bar);
    const struct observed_run o = bar_seen(bar, 1);
    assert_ok(probes_make(probes, &request, 1, &o));
    return o;
}

/* Releases the probes of `bar`, its bonds and its particles. */
static void bar_probes_free(struct probes *probes, struct bar *bar)
{
    probes_free(probes);
    bonds_free(&bar->bonds);
    body_free(&bar->b);
}

/* Checks two adjacent bodies (0..6 and 6..30), which are separate from the start. The second one separates at 25 when
 * its last bond breaks. */
static void probe_of_a_spall(void **state)
{
    (void)state;
    struct bar bar;
    struct probes s;
    struct figure_list l = {0};
    body_make(&bar.b, 1, (const int[]){30});
    struct particles *p = &bar.b.p;
    for (int64_t i = 0; i < p->n; i++) {
        p->kind[i] = p->X[0][i] > 15 ? KIND_PD : KIND_MPM;
        p->body[i] = p->X[0][i] > 6;
        p->v[0][i] = p->X[0][i] > 25 ? 28 : p->X[0][i] < 6 ? 2 : -0.5;
        if (p->X[0][i] > 28) p->v[0][i] = 20, p->mass[i] = 3 * BODY_MASS;
    }
    struct observed_run o = spall_probe_make(&s, &bar);
    bar_cut(&bar, 25, 2);
    probes_update_break_spall_and_reaction_probes(&s, &o);
    probes_visit_results(&s, &o, figure_keep, &l);
    assert_int_equal(l.n, 0); /* its shortest bond is intact */
    bar_cut(&bar, 25, 1);
    o.t = 2;
    probes_update_break_spall_and_reaction_probes(&s, &o);
    bar_cut(&bar, 20, 1);
    o.t = 3;
    probes_update_break_spall_and_reaction_probes(&s, &o);
    probes_visit_results(&s, &o, figure_keep, &l);
    assert_near(figure(&l, "spall", "position"), 25, 1e-12);
    assert_near(figure(&l, "spall", "time"), 2, 0);
    assert_near(figure(&l, "spall", "speed"), (3 * 28 + 2 * 3 * 20) / 9.0, 1e-12); /* the mean by mass */
    assert_near(figure(&l, "spall", "speed_rest"), -0.5, 1e-12);
    bar_probes_free(&s, &bar);
}

/* Checks that adjacent planes that separate at the same time count as one fracture, at their middle. */
static void probe_of_a_wide_spall(void **state)
{
    (void)state;
    struct bar bar;
    struct probes s;
    struct figure_list l = {0};
    body_make(&bar.b, 1, (const int[]){30});
    for (int64_t i = 0; i < bar.b.p.n; i++) bar.b.p.kind[i] = KIND_PD;
    struct observed_run o = spall_probe_make(&s, &bar);
    for (int k = 23; k <= 25; k++) bar_cut(&bar, k, 1);
    probes_update_break_spall_and_reaction_probes(&s, &o);
    probes_visit_results(&s, &o, figure_keep, &l);
    assert_near(figure(&l, "spall", "position"), 24, 1e-12);
    bar_probes_free(&s, &bar);
}

/* Checks that a plane between material points within the reach of bonds counts as connected by the grid until a point
 * has lost a bond. */
static void probe_of_a_spall_knows_the_grid(void **state)
{
    (void)state;
    struct bar bar;
    struct probes s;
    struct figure_list l = {0};
    body_make(&bar.b, 1, (const int[]){30});
    struct particles *p = &bar.b.p;
    for (int64_t i = 0; i < p->n; i++) p->kind[i] = fabs(p->X[0][i] - 15) < 1 ? KIND_PD : KIND_MPM;
    struct observed_run o = spall_probe_make(&s, &bar);
    bar_cut(&bar, 15, 1);
    for (int64_t i = 0; i < p->n; i++)
        if (p->kind[i] == KIND_MPM) p->flag[i] = 0;
    probes_update_break_spall_and_reaction_probes(&s, &o);
    probes_visit_results(&s, &o, figure_keep, &l);
    assert_int_equal(l.n, 0);
    p->flag[particle_at(&bar.b, 13.5, 0, 0)] = FLAG_LOST_BOND;
    probes_update_break_spall_and_reaction_probes(&s, &o);
    probes_visit_results(&s, &o, figure_keep, &l);
    assert_near(figure(&l, "spall", "position"), 15, 1e-12);
    bar_probes_free(&s, &bar);
}

static void probe_of_a_break(void **state)
{
    (void)state;
    struct bar bar;
    struct probes s;
    struct figure_list l = {0};
    body_make(&bar.b, 1, (const int[]){30});
    struct particles *p = &bar.b.p;
    for (int64_t i = 0; i < p->n; i++) p->kind[i] = KIND_PD;
    bar_bond(&bar);
    struct solid right = box(15, 0, 30, 0);
    struct probe_request request[] = {{.name = "right", .kind = PROBE_BREAK, .region = {.n = 1, .solid = &right}},
                                      {.name = "all", .kind = PROBE_BREAK},
                                      {.name = "energy", .kind = PROBE_ENERGY}};
    struct observed_run o = bar_seen(&bar, 1);
    struct kernels kernels;
    kernels_choose(&kernels, 1, PD_BOND, SHAPE_LINEAR, TRANSFER_FLIP);
    o.horizon = 3, o.kernels = &kernels;
    assert_ok(probes_make(&s, request, 3, &o));
    bar_cut(&bar, 5, 1);
    probes_update_break_spall_and_reaction_probes(&s, &o);
    memset(p->flag, 0, (size_t)p->n);
    bar_cut(&bar, 25, 3); /* three bonds of length 3: 22.5-25.5, 23.5-26.5, 24.5-27.5 */
    o.t = 2;
    probes_update_break_spall_and_reaction_probes(&s, &o);
    probes_visit_results(&s, &o, figure_keep, &l);
    assert_near(figure(&l, "all", "first_time"), 1, 0);
    assert_near(figure(&l, "all", "x"), 5, 1e-12);
    assert_near(figure(&l, "all", "tied"), 1, 0);
    assert_near(figure(&l, "all", "bonds"), 6 + 3, 0);
    assert_near(figure(&l, "right", "first_time"), 2, 0);
    assert_near(figure(&l, "right", "x"), 25, 1e-12);
    assert_near(figure(&l, "right", "bonds"), 3, 0);

    /* Energy of the intact bonds under stretch e: 1/2 E e^2 for a complete neighbourhood, less at ends and cuts. */
    bonds_free(&bar.bonds);
    bar_bond(&bar);
    for (int64_t i = 0; i < p->n; i++) p->x[0][i] = p->X[0][i] * 1.001;
    real half_energy = 0, full = 0.5 * bar.m.young * square(1e-3);
    for (int64_t i = 0; i < p->n; i++)
        for (int64_t j = 0; j < p->n; j++)
            if (i != j && llabs(i - j) <= 3) half_energy += full * (real)llabs(i - j) / 12; /* 2 (1 + 2 + 3) = 12 */
    probes_sample_energies(&s, &o);
    assert_near(s.value[column_named(&s, "energy.strain")], half_energy, 1e-12 * half_energy);
    bar_probes_free(&s, &bar);
}

struct kept_profile {
    char name[64], text[4096];
};

static status profile_keep(void *context, const char *name, const char *text, size_t length)
{
    struct kept_profile *to = context;
    if (to->name[0]) return status_set(FAILED, "there is one already");
    snprintf(to->name, sizeof to->name, "%s", name);
    assert_true(length == strlen(text) && length < sizeof to->text);
    strcpy(to->text, text);
    return OK;
}

static void profile_of_a_line(void **state)
{
    (void)state;
    struct body b;
    struct probes s;
    struct kept_profile kept = {{0}, {0}};
    body_make(&b, 1, (const int[]){10});
    for (int64_t i = 0; i < b.p.n; i++) b.p.v[0][i] = (real)i;
    struct observed_run o = seen(&b);
    struct probe_request request = {.name = "a/b", .kind = PROBE_LINE, .from = {0.5}, .to = {12.5}, .points = 5};
    assert_ok(probes_make(&s, &request, 1, &o));
    assert_int_equal(probes_count_profiles(&s), 1);
    assert_ok(probes_write_profiles(&s, &o, profile_keep, &kept, 7));
    assert_string_equal(kept.name, "a_b_000007.csv");
    assert_string_equal(kept.text, "s [m],x [m],displacement_x [m],velocity_x [m/s],stress_xx [Pa],damage [1]\n"
                                   "0,0.5,0,0,0,0\n3,3.5,0,3,0,0\n6,6.5,0,6,0,0\n9,9.5,0,9,0,0\n");
    assert_failed(probes_write_profiles(&s, &o, profile_keep, &kept, 7), "there is one already");
    struct figure_list l = {0};
    probes_visit_results(&s, &o, figure_keep, &l);
    assert_near(figure(&l, "a/b", "velocity_x_max"), 9, 0);
    assert_near(figure(&l, "a/b", "velocity_x_min"), 0, 0);
    probes_free(&s);
    body_free(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(probes_read_particles_and_regions),
        cmocka_unit_test(probes_refuse_what_is_not_there),
        cmocka_unit_test(probe_of_a_support),
        cmocka_unit_test(probe_of_two_supports),
        cmocka_unit_test(probe_of_a_pulse),
        cmocka_unit_test(probe_of_a_turning_body),
        cmocka_unit_test(probe_of_a_tip),
        cmocka_unit_test(probe_of_a_spall),
        cmocka_unit_test(probe_of_a_wide_spall),
        cmocka_unit_test(probe_of_a_spall_knows_the_grid),
        cmocka_unit_test(probe_of_a_break),
        cmocka_unit_test(profile_of_a_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
