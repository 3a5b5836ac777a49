/* Scatter of strength in a run: bonds break and points convert according to the random strength of each particle. */
#include <omp.h>
#include <string.h>

#include "engine/engine.h"
#include "scene/scene_read.h"
#include "tests/support/near.h"
#include "step/report.h"
#include "coupling/coupling_part.h"

static void make(struct run *run, struct scene *s, const char *text)
{
    omp_set_num_threads(2);
    if (scene_read_text(s, text, strlen(text), "scatter.yaml", NULL, 0) != OK) fail_msg("%s", status_message());
    assert_ok(run_set_up_from_scene(run, s, NULL));
    run->report->quiet = true;
    assert_ok(report_open_history_and_write_first_frame(run));
}

static void drop(struct run *run, struct scene *s)
{
    run_free_memory(run);
    scene_free(s);
}

#define PLATE(method)                                                                                                  \
    "space: plane stress\nthickness: 1e-3\nduration: 5e-6\nmethod: " method "\n"                                       \
    "material: {young: 70e9, density: 2700, critical_stretch: 1e-3, scatter: {modulus: 6, length: 2e-3, seed: 4}}\n"   \
    "body: {box: {from: [0, 0], to: [20e-3, 20e-3]}}\nparticles: {spacing: 1e-3}\n"                                    \
    "boundary: [{mirror: {axis: x, at: 0}}]\ninitial: [{velocity_gradient: [400, 0, 0, 400]}]\n"                       \
    "contact: {between: none}\ntime: {step: 2e-8}\noutput: {frames: 0, samples: 1}\n"

/* Returns the smallest critical stretch of the intact bonds of row `row` of the run (the bonds of one particle), from
 * the strength of both particles; INFINITY if there is none. */
static real least_of(const struct run *run, int64_t row)
{
    const struct particles *p = &run->part;
    const int32_t i = run->bonds.particle[row];
    real least = INFINITY;
    for (struct bond_iterator it = bond_iterator_of_row(&run->bonds, row); bond_iterator_advance(&it);)
        if (it.bond.w != 0) least = real_min(least, 1e-3 * real_min(p->strength[i], p->strength[it.bond.nbr]));
    return least;
}

/* Checks that each row of a lattice has a limit of its own (the trigger: stretch from which its bonds are examined),
 * the smallest critical stretch of its bonds, although rows share storage. Mirror images have the strength of their
 * particles. */
static void test_rows_are_watched(void **state)
{
    (void)state;
    struct run e = {0};
    struct scene s;
    make(&e, &s, PLATE("pd"));
    assert_true(e.bonds.rows == e.part.n && e.loads.images > 0);
    for (int64_t row = 0; row < e.bonds.rows; row++) assert_close(e.bonds.trigger[row], least_of(&e, row), 1e-8);
    for (int64_t k = 0; k < e.loads.images; k++)
        assert_exact(e.part.strength[e.part.n + k], e.part.strength[e.loads.image[k].source]);
    drop(&e, &s);
}

static int64_t broken_in(const struct run *run)
{
    int64_t broken = 0;
    for (int64_t row = 0; row < run->bonds.rows; row++) broken += run->bonds.broken[row];
    return broken;
}

/* Runs the scene `text`. Checks that the first bond breaks when the uniform strain reaches the limit of the weakest
 * particle (10 %: waves from the edges, steps of 2 %), and every ten steps that no intact bond exceeds its limit by
 * more than 20 %. */
static void check_breaks(const char *text)
{
    struct run e = {0};
    struct scene s;
    make(&e, &s, text);
    const struct particles *p = &e.part;
    real weakest = INFINITY, first = NAN;
    for (int64_t i = 0; i < p->n; i++) weakest = real_min(weakest, p->strength[i]);
    while (e.clock.step + 1 < e.clock.steps && broken_in(&e) < 200) {
        assert_ok(run_adapt_mesh_and_advance_one_step(&e));
        if (isnan(first) && broken_in(&e) > 0) first = e.clock.t * 400 / (1e-3 * weakest);
        for (int64_t row = 0; row < e.bonds.rows && e.clock.step % 10 == 0; row++)
            for (struct bond_iterator it = bond_iterator_of_row(&e.bonds, row); bond_iterator_advance(&it);) {
                const int32_t i = e.bonds.particle[row], j = it.bond.nbr;
                real y2 = 0;
                for (int d = 0; d < 2; d++) y2 += square(p->x[d][j] - p->x[d][i]);
                const real stretch = sqrt(y2) * fabs(it.bond.inverse_length) - 1;
                if (it.bond.w == 0 || e.bonds.row_of[i] < 0) continue;
                assert_true(stretch <= 1e-3 * real_min(p->strength[i], p->strength[j]) * 1.2);
            }
    }
    assert_true(broken_in(&e) > 0);
    assert_near(first, 1, 0.1); /* uniform strain until waves arrive from the edges; steps of 2 % */
    drop(&e, &s);
}

static void test_weakest_breaks_first(void **state)
{
    (void)state;
    check_breaks(PLATE("pd"));
    check_breaks(PLATE("pd") "model: ospd\n");
}

/* Checks with the frame `frame` of the material points that conversion follows their random strength: the weakest point
 * is among the first to convert, which are less than a tenth of all, when the stress reaches its limit (10 %). */
static void check_points(const char *frame)
{
    struct run e = {0};
    struct scene s;
    char text[1024];
    snprintf(text, sizeof text, PLATE("adaptive") "conversion: {block: false}\nmpm: {frame: %s}\n", frame);
    make(&e, &s, text);
    const struct particles *p = &e.part;
    real weakest = INFINITY;
    int64_t weak = 0;
    for (int64_t i = 0; i < p->n; i++)
        if (p->strength[i] < weakest) weakest = p->strength[weak = i];
    while (e.clock.step + 1 < e.clock.steps && p->n_of[KIND_PD] == 0)
        assert_ok(run_adapt_mesh_and_advance_one_step(&e));
    assert_true(p->n_of[KIND_PD] > 0 && p->n_of[KIND_PD] < p->n / 10);
    assert_int_equal(p->kind[weak], KIND_PD);
    /* Uniform biaxial strain: sigma = E/(1 - nu) strain, nu = 1/3. */
    assert_near(e.clock.t * 400 * 1.5 / (0.95e-3 * weakest), 1, 0.1);
    drop(&e, &s);
}

static void test_points_convert_by_their_own(void **state)
{
    (void)state;
    check_points("current");
    check_points("reference");
}

/* Checks the stress at which points convert: alpha times the stress at the critical stretch, which is on the hardening
 * line for a yielding material. Also checks the interface damping per step, proportional to the number of cells that
 * the fastest wave crosses. */
static void test_triggers(void **state)
{
    (void)state;
    static const char text[] =
        "space: plane stress\nthickness: 0.37 mm\nduration: 5 us\nmethod: adaptive\nmaterials:\n"
        "  - {name: brittle, young: 70 GPa, density: 2700, critical_stretch: 1.3e-3}\n"
        "  - {name: ductile, young: 192 GPa, density: 7900, critical_stretch: 4e-3, yield_stress: 310 MPa,\n"
        "     yield_tangent: 23 GPa}\nbodies:\n"
        "  - {name: low, material: brittle, shape: {box: {from: [0, 0], to: [9 mm, 6 mm]}}}\n"
        "  - {name: high, material: ductile, shape: {box: {from: [0, 8 mm], to: [9 mm, 14 mm]}}}\n"
        "particles: {spacing: 1 mm}\nconversion: {alpha: 0.62}\ninterface_damping: 0.07\ntime: {step: 20 ns}\n"
        "pd: {region: {box: {from: [-inf, -inf], to: [3 mm, inf]}}}\n";
    struct run e = {0};
    struct scene s;
    make(&e, &s, text);
    assert_close(e.tables.elastic[0].trigger, 0.62 * 70e9 * 1.3e-3, 1e-12);
    assert_close(e.tables.elastic[1].trigger, 0.62 * (310e6 + 23e9 * (4e-3 - 310e6 / 192e9)), 1e-12);
    const real fastest = real_max(s.material[0].wave_speed, s.material[1].wave_speed);
    assert_close(e.coupling->damping_share, 0.07 * fastest * 20e-9 / (s.cell * 1e-3), 1e-12);
    drop(&e, &s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_triggers), cmocka_unit_test(test_rows_are_watched),
                                       cmocka_unit_test(test_weakest_breaks_first),
                                       cmocka_unit_test(test_points_convert_by_their_own)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
