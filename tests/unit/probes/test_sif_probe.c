/* Tests the probe of stress-intensity factors: choice of the crack tip, refusals, a stationary and a moving tip. */
#include "tests/support/bodies.h"
#include "tests/support/glass.h"
#include "probes/probes.h"
#include "src/probes/probes_parts.h"

enum { WIDTH = 72, HEIGHT = 60 };

/* A plate of glass of 72 x 60 with a crack from its left edge to (30, 30), between two rows of particles. */
struct plate {
    struct body body;
    struct crack_tips tips;
    struct material material[2];
    real corner[2][2][DIM_MAX];
    struct crack crack[2];
    struct observed_run o;
};

static void plate_make(struct plate *p, int cracks, const real *tip)
{
    memset(p, 0, sizeof *p);
    body_make(&p->body, 2, (const int[]){WIDTH, HEIGHT});
    for (int64_t i = 0; i < p->body.p.n; i++) p->body.p.volume0[i] = 0.37; /* thickness [m] */
    for (int k = 0; k < 2; k++) {
        p->material[k] = (struct material){.young = 75.629e9, .poisson = 0.286, .density = 2456};
        material_compute_derived_constants(&p->material[k], SPACE_PLANE_STRAIN);
        p->crack[k] = (struct crack){.n = 2, .corner = p->corner[k]};
    }
    p->corner[0][0][0] = -WIDTH, p->corner[0][0][1] = tip[1], p->corner[0][1][0] = tip[0], p->corner[0][1][1] = tip[1];
    p->corner[1][0][0] = tip[0] + 10, p->corner[1][1][0] = tip[0] + 10;
    p->corner[1][0][1] = 10, p->corner[1][1][1] = 50;
    tips_make_at_precrack_ends(&p->tips, &p->body.p, &p->body.c, p->crack, cracks, 1, 1);
    p->o = (struct observed_run){.part = &p->body.p,
                                 .cells = &p->body.c,
                                 .tips = &p->tips,
                                 .material = p->material,
                                 .spacing = 1,
                                 .thickness = 0.37,
                                 .space = SPACE_PLANE_STRAIN,
                                 .horizon = 3.015,
                                 .crack = p->crack,
                                 .cracks = cracks};
}

static void plate_free(struct plate *p)
{
    tips_free(&p->tips);
    body_free(&p->body);
}

/* Sets the displacements of k, or the velocities if `velocities`, to the field with factors K of a tip at `place` that
 * moves along x with the speed v. */
static void plate_field(struct plate *k, const real K[MODES], const real *place, real v, bool velocities)
{
    struct particles *p = &k->body.p;
    const struct crack_medium m = crack_medium_of_material(&k->material[0], SPACE_PLANE_STRAIN);
    for (int64_t i = 0; i < p->n; i++) {
        const real x[2] = {p->X[0][i] - place[0], p->X[1][i] - place[1]};
        real u[2] = {0}, w[2] = {0};
        for (int mode = 0; mode < MODES; mode++) {
            struct crack_field f;
            crack_tip_unit_sif_field_at_any_speed(&m, mode, v, x, &f);
            for (int d = 0; d < 2; d++) u[d] += K[mode] * f.displacement[d], w[d] += K[mode] * f.state.velocity[d];
        }
        for (int d = 0; d < 2; d++) {
            if (velocities)
                p->v[d][i] = w[d];
            else
                p->x[d][i] = p->X[d][i] + u[d];
        }
    }
}

static const real start[2] = {30, 30};

static int column_named(const struct probes *probes, const char *name)
{
    for (int k = 0; k < probes->columns; k++)
        if (strcmp(probes->column[k].name, name) == 0) return k;
    fail_msg("no column %s", name);
    return -1;
}

static real value_of(const struct probes *probes, const char *name)
{
    return probes->value[column_named(probes, name)];
}

struct figures {
    int n;
    real value[16];
};

static void figure_keep(void *context, const char *probe, const char *quantity, real value)
{
    static const char *const names[SIF_FIGURES] = {"K_I", "K_II", "J", "contour_spread"};
    struct figures *f = context;
    (void)probe;
    for (int k = 0; k < SIF_FIGURES; k++)
        if (strcmp(quantity, names[k]) == 0) f->value[k] = value, f->n++;
}

/* Checks the factors of a static field, measured by probes that find the tip and by one with a given position, and a
 * probe in a body without a crack. */
static void tip_at_rest(void **state)
{
    (void)state;
    const real K[MODES] = {3e3, -2e3};
    const struct probe_request request[] = {
        {.name = "found", .kind = PROBE_SIF, .speed = NAN},
        {.name = "told", .kind = PROBE_SIF, .has_at = true, .at = {30, 30}, .outer = 16, .gradient = GRADIENT_PDDO},
        {.name = "bare", .kind = PROBE_SIF, .has_at = true, .at = {30, 30}, .has_direction = true, .direction = {5, 0}},
    };
    for (int cracks = 1; cracks >= 0; cracks--) {
        struct plate p;
        struct probes s;
        struct figures f = {0};
        plate_make(&p, cracks, start);
        plate_field(&p, K, start, 0, false);
        assert_ok(probes_make(&s, cracks ? request : request + 2, cracks ? 3 : 1, &p.o));
        assert_string_equal(s.column[s.columns - 4].name, "bare.K_I");
        assert_string_equal(s.column[s.columns - 4].unit, "Pa m^(1/2)");
        probes_sample_position_dependent_values(&s, &p.o);
        probes_sample_velocity_dependent_values(&s, &p.o, &(struct velocity_time){0, 1});
        const char *const names[] = {"bare", "told", "found"};
        for (int k = 0; k < (cracks ? 3 : 1); k++) {
            char name[4][32];
            for (int c = 0; c < SIF_FIGURES; c++) snprintf(name[c], 32, "%s.%.16s", names[k], sif_figure[c].name);
            assert_near(value_of(&s, name[0]), K[0], 2); /* 0.03 % at 16 spacings */
            assert_near(value_of(&s, name[1]), K[1], 2);
            assert_close(value_of(&s, name[2]), (K[0] * K[0] + K[1] * K[1]) / (75.629e9 / (1 - 0.286 * 0.286)), 1e-3);
            assert_near(value_of(&s, name[3]), 0, 3e-3); /* the smallest ring has 9.6 spacings */
            assert_true(value_of(&s, name[3]) > 0);
        }
        probes_visit_results(&s, &p.o, figure_keep, &f);
        assert_int_equal(f.n, 4 * (cracks ? 3 : 1));
        assert_exact(f.value[0], value_of(&s, "bare.K_I"));
        probes_free(&s);
        plate_free(&p);
    }
}

static void refused(struct plate *p, const struct probe_request *request, const char *says)
{
    struct probes s;
    struct probe_request r = *request;
    strcpy(r.name, "k");
    r.kind = PROBE_SIF;
    assert_refused(probes_make(&s, &r, 1, &p->o), says);
    assert_null(s.probe);
}

static void bad_requests_are_refused(void **state)
{
    (void)state;
    struct plate p, two, corner;
    plate_make(&p, 0, start);
    refused(&p, &(struct probe_request){.inner = 0}, "no pre-crack ends inside a body");
    refused(&p, &(struct probe_request){.has_at = true, .at = {30, 30}}, "give `direction`");
    refused(&p, &(struct probe_request){.has_at = true, .at = {90, 30}, .has_direction = true, .direction = {1, 0}},
            "no particle is ahead");
    plate_free(&p);
    plate_make(&p, 1, start);
    refused(&p, &(struct probe_request){.outer = 31}, "leaves the body at (");
    refused(&p, &(struct probe_request){.outer = 5}, "narrower than 3 spacings; use sif: {outer: 10 m}, or more");
    refused(&p, &(struct probe_request){.outer = 9.99}, "or more");
    refused(&p, &(struct probe_request){.outer = 12, .inner = 10}, "narrower than 3 spacings; use sif: {outer: 30 m");
    refused(&p, &(struct probe_request){.outer = 5.5}, "the ring from 2.75 to 5.5 m is narrower");
    /* Rings for comparison are scaled from those of the figures: 0.8 and 5/17 of their outer radii. */
    refused(&p, &(struct probe_request){.outer = 17, .inner = 13.6}, "the ring from 8.16 to 10.2 m is narrower");
    real radius[] = {11.9, 3.4};
    refused(&p, &(struct probe_request){.outer = 17, .inner = 5, .contours = {2, radius}},
            "the ring from 1 to 3.4 m is narrower");
    radius[1] = 33.7;
    refused(&p, &(struct probe_request){.outer = 17, .inner = 5, .contours = {2, radius}}, "the ring of radius 33.7 m");
    p.o.part->material[40 * WIDTH + 30] = 1;
    refused(&p, &(struct probe_request){.outer = 20}, "another material");
    p.o.part->material[40 * WIDTH + 30] = 0;
    plate_make(&two, 2, start); /* its ends are (10, -20) and (10, 20) away */
    refused(&two, &(struct probe_request){.outer = 24}, "another crack's tip at (40, ");
    refused(&two, &(struct probe_request){.outer = 24}, "radius 24 m; use sif: {outer: 22.1 m}, or less");
    plate_make(&corner, 1, (const real[]){8, 30});
    refused(&corner, &(struct probe_request){.outer = 20}, "; use sif: {outer: 8 m}, or less");
    refused(&corner, &(struct probe_request){.inner = 7.3}, "the ring of radius 20 m");
    plate_free(&corner);
    plate_make(&corner, 1, (const real[]){13, 30}); /* the default radius of 20 is reduced until the ring fits */
    struct probes fitted;
    real tip[2], radius_fitted;
    assert_ok(probes_make(&fitted, &(struct probe_request){.name = "k", .kind = PROBE_SIF}, 1, &corner.o));
    assert_true(probes_locate_sif_contour(&fitted, 0, &corner.o, tip, &radius_fitted));
    assert_close(radius_fitted, 12, 1e-12);
    probes_free(&fitted);
    plate_free(&corner);
    plate_free(&two);
    plate_free(&p);
}

/* Checks a tip that has advanced by 12 at 1000 m/s. Acceleration and velocity follow from velocities half a step before
 * and after. Speed, position and direction must be those of the tip. The state in a checkpoint must be sufficient to
 * continue. */
static void tip_in_motion(void **state)
{
    (void)state;
    const real K[MODES] = {3e3, -2e3}, v = 1000, dt = 1e-5;
    const struct probe_request request = {.name = "sif", .kind = PROBE_SIF, .outer = 16, .core = NAN, .speed = NAN};
    struct plate p;
    struct probes s, again;
    plate_make(&p, 1, start);
    assert_ok(probes_make(&s, &request, 1, &p.o));
    assert_ok(probes_make(&again, &request, 1, &p.o));
    struct crack_tip *tip = &p.tips.tip[0];
    p.tips.samples = 13;
    p.tips.time = NEW("test.time", 13, real), p.tips.growth = NEW("test.growth", 13 * TIPS_MAX, real);
    for (int k = 0; k < 13; k++) p.tips.time[k] = 1e-3 * k, p.tips.growth[k * TIPS_MAX] = k;
    p.tips.window = 5e-3;
    assert_close(tips_average_speed(&p.tips, 0), v, 1e-12);
    tip->growth = 12, tip->place[0] = p.corner[0][1][0] = 42; /* no bonds here that would hide particles */
    p.o.t = 12e-3, p.o.t_velocity = p.o.t - 0.5 * dt;
    for (int round = 0; round < 2; round++) {
        const real before[2] = {42 - 0.5 * dt * v, 30}, after[2] = {42 + 0.5 * dt * v, 30};
        struct probes *now = round == 0 ? &s : &again;
        plate_field(&p, K, tip->place, v, false);
        plate_field(&p, K, before, v, true);
        probes_store_motion_before_step(now, &p.o);
        plate_field(&p, K, after, v, true);
        probes_sample_velocity_dependent_values(now, &p.o, &(struct velocity_time){p.o.t + 0.5 * dt, 1});
        const struct crack_medium m = crack_medium_of_material(&p.material[0], SPACE_PLANE_STRAIN);
        const real A[MODES] = {crack_tip_speed_universal_function(&m, MODE_I, v),
                               crack_tip_speed_universal_function(&m, MODE_II, v)};
        assert_near(value_of(now, "sif.K_I"), K[0], 5); /* 0.14 %; a stationary crack would be 5 % off */
        assert_near(value_of(now, "sif.K_II"), K[1], 5);
        assert_close(value_of(now, "sif.J"), (A[0] * K[0] * K[0] + A[1] * K[1] * K[1]) / m.modulus, 0.003);
        struct store store = {0};
        struct archive a = {.saving = true, .exchange = store_exchange, .file = &store};
        assert_ok(probes_save_or_load(&s, &a));
        a.saving = false;
        assert_ok(probes_save_or_load(&again, &a));
        store_free(&store);
    }
    assert_exact(value_of(&again, "sif.K_II"), value_of(&s, "sif.K_II"));
    tip->place[0] = 60; /* 12 from the edge */
    probes_sample_velocity_dependent_values(&s, &p.o, &(struct velocity_time){p.o.t, 1});
    assert_true(isnan(value_of(&s, "sif.K_I")));
    p.tips.growth[12 * TIPS_MAX] = 0; /* the tip has come to rest there */
    p.tips.samples = 0;
    probes_sample_velocity_dependent_values(&s, &p.o, &(struct velocity_time){p.o.t, 1});
    assert_true(isnan(value_of(&s, "sif.K_I")));
    struct warnings said = {.silent = true};
    struct probe *contours_differ = &again.probe[0];
    contours_differ->memory.factors[3] = 0.21;
    for (int time = 0; time < 2; time++) {
        probes_warn_of_meaningless_sif(&s, false, p.o.t, &said);
        probes_warn_of_meaningless_sif(&again, false, p.o.t, &said);
    }
    assert_true(isnan(sif_probe_last_sample_value_or_nan(contours_differ, 0)) &&
                sif_probe_last_sample_value_or_nan(contours_differ, 3) == 0.21);
    assert_int_equal(said.n, 2);
    assert_non_null(strstr(said.text[0], "its ring leaves the body"));
    assert_non_null(strstr(said.text[1], "on its contours differ by 21 % (contour_spread, at most 20 %)"));
    warnings_free(&said);
    probes_free(&again);
    probes_free(&s);
    plate_free(&p);
}

/* Checks a crack that has turned by 45 degrees: the local axes are those of its last spacings. */
static void tip_that_turned(void **state)
{
    (void)state;
    struct plate p;
    struct probes s;
    const struct probe_request request = {.name = "sif", .kind = PROBE_SIF, .outer = 12, .speed = NAN};
    plate_make(&p, 1, start);
    assert_ok(probes_make(&s, &request, 1, &p.o));
    struct crack_tip *tip = &p.tips.tip[0];
    for (int k = 1; k <= 20; k++) {
        tip->place[0] = 30 + 0.6 * k, tip->place[1] = 30 + 0.6 * k, tip->growth = 0.6 * sqrt(2) * k;
        probes_sample_velocity_dependent_values(&s, &p.o, &(struct velocity_time){0, 1});
    }
    const real *trail = s.probe[0].memory.trail[0];
    assert_near(atan2(tip->place[1] - trail[1], tip->place[0] - trail[0]), pi / 4, 1e-12);
    probes_free(&s);
    plate_free(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tip_at_rest),
        cmocka_unit_test(bad_requests_are_refused),
        cmocka_unit_test(tip_in_motion),
        cmocka_unit_test(tip_that_turned),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
