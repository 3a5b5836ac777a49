/* Contact: forces and energy beside a plain sum over all pairs without bonds, the third law, forces as the gradient of
 * the energy, and the stiffness of the law. */
#include <math.h>
#include <string.h>

#include "auto/scene_read.h"
#include "base/memory.h"
#include "engine/engine.h"
#include "tests/support/near.h"

/* A body that flies at a cracked one, whose crack closes. */
static const char plane[] =
    "name: hit\nspace: plane stress\nthickness: 2 mm\nmethod: pd\nduration: 30 us\n"
    "materials:\n  - {name: hard, young: 200 GPa, poisson: 1/3, density: 8000}\n"
    "  - {name: soft, young: 70 GPa, poisson: 1/3, density: 2700}\n"
    "bodies:\n  - {name: striker, material: hard, shape: {ball: {centre: [-6.2 mm, 0.3 mm], radius: 6 mm}}, "
    "velocity: [60 m/s, 0]}\n"
    "  - {name: target, material: soft, shape: {box: {from: [0, -10 mm], to: [12 mm, 10 mm]}}}\n"
    "cracks: [{from: [4 mm, -12 mm], to: [4 mm, 6 mm]}]\nparticles: {spacing: 1 mm}\n"
    "contact: {between: all}\noutput: {frames: 1, samples: 10}\n";
static const char space[] =
    "name: hit\nspace: solid\nmethod: pd\nduration: 10 us\n"
    "material: {young: 70 GPa, density: 2700}\n"
    "bodies:\n  - {name: striker, shape: {box: {from: [-6 mm, 1 mm, 2 mm], to: [-0.1 mm, 7 mm, 6 mm]}}, "
    "velocity: [50 m/s, 0, 5 m/s]}\n"
    "  - {name: target, shape: {box: {from: [0, 0, 0], to: [5 mm, 8 mm, 8 mm]}}}\n"
    "particles: {spacing: 1 mm}\ncontact: {between: bodies}\noutput: {frames: 1, samples: 10}\n";
static const char line[] =
    "name: hit\nspace: line\nsection: 4 mm^2\nmethod: pd\nduration: 30 us\n"
    "material: {young: 200 GPa, density: 8000}\n"
    "bodies:\n  - {name: striker, shape: {box: {from: [-20 mm], to: [0]}}, velocity: [10 m/s]}\n"
    "  - {name: target, shape: {box: {from: [0.02 mm], to: [20.02 mm]}}}\n"
    "particles: {spacing: 1 mm}\ncontact: {between: all}\noutput: {frames: 1, samples: 10}\n";

static struct engine *contact_run(struct scene *s, const char *text)
{
    struct engine *e = NEW("test.engine", 1, struct engine);
    if (scene_read_text(s, text, strlen(text), "contact.yaml", NULL, 0) != OK) fail_msg("%s", status_message());
    assert_ok(engine_make(e, s, NULL));
    e->report.quiet = true;
    assert_ok(engine_report_start(e));
    return e;
}

static void contact_end(struct engine *e, struct scene *s)
{
    engine_free(e);
    memory_free(e);
    scene_free(s);
}

static bool has_bond(const struct engine *e, int64_t i, int64_t j)
{
    for (struct bond_iterator it = bonds_of_row(&e->bonds, e->bonds.row_of[i]); bond_next(&it);)
        if (it.bond.w != 0 && it.bond.nbr == j) return true;
    return false;
}

static real length(const struct particles *p, real *const *place, int64_t i, int64_t j)
{
    real r2 = 0;
    for (int d = 0; d < p->dim; d++) r2 += square(place[d][i] - place[d][j]);
    return sqrt(r2);
}

/* Sum over all pairs of particles without a bond, closer than a spacing and than they were: 15 c V V/delta (d - r), of
 * two materials the harmonic mean. f: [dim n]; returns the energy [J]. */
static real plain_sum(const struct engine *e, real *f)
{
    const struct particles *p = &e->part;
    struct family family = e->source.family;
    real c[2], energy = 0;
    family_make(&family, family.space, family.spacing, 3.015, family.section);
    for (int m = 0; m < e->scene->materials; m++) c[m] = family_micro_modulus(&family, &e->scene->material[m]);
    memset(f, 0, (size_t)(p->n * p->dim) * sizeof *f);
    for (int64_t i = 0; i < p->n; i++)
        for (int64_t j = i + 1; j < p->n; j++) {
            const real r = length(p, p->x, i, j), d = real_min(e->scene->spacing, length(p, p->X, i, j));
            if (r >= d || has_bond(e, i, j)) continue;
            if (e->scene->contact_between == CONTACT_BODIES && p->body[i] == p->body[j]) continue;
            const real a = c[p->material[i]], b = c[p->material[j]];
            const real k = 15 * (2 * a * b / (a + b)) * p->volume0[i] * p->volume0[j] / (3.015 * e->scene->spacing);
            energy += 0.5 * k * square(d - r);
            for (int x = 0; x < p->dim; x++) {
                const real push = k * (d - r) * (p->x[x][i] - p->x[x][j]) / r;
                f[x * p->n + i] += push, f[x * p->n + j] -= push;
            }
        }
    return energy;
}

/* Forces of contact alone, into part.f. */
static void contact_alone(struct engine *e)
{
    for (int d = 0; d < e->part.dim; d++) memset(e->part.f[d], 0, (size_t)e->part.n * sizeof(real));
    contact_force(&e->contact, &e->part);
}

/* Round-off of forces of up to a dozen pairs. */
static void check_plain(struct engine *e)
{
    const struct particles *p = &e->part;
    real *f = NEW("test.f", p->n * p->dim, real), most = 0;
    const real energy = plain_sum(e, f);
    contact_alone(e);
    for (int64_t k = 0; k < p->n * p->dim; k++) most = real_max(most, fabs(f[k]));
    for (int d = 0; d < p->dim; d++) {
        real sum = 0;
        for (int64_t i = 0; i < p->n; i++) {
            assert_near(p->f[d][i], f[d * p->n + i], 1e-12 * most);
            sum += p->f[d][i];
        }
        assert_near(sum, 0, 1e-13 * most * sqrt((real)p->n));
    }
    assert_near(contact_energy(&e->contact, p), energy, 1e-12 * energy);
    memory_free(f);
}

/* -dE/dx of the particle with the deepest overlap, by a central difference over 1e-6 of a spacing: pairs that open in
 * it leave (1e-6)^2 of k. */
static void check_gradient(struct engine *e)
{
    struct particles *p = &e->part;
    contact_alone(e);
    const int32_t i = e->contact.deepest;
    const real h = 1e-6 * e->scene->spacing;
    real most = 0;
    for (int d = 0; d < p->dim; d++) most = real_max(most, fabs(p->f[d][i]));
    for (int d = 0; d < p->dim; d++) {
        const real x = p->x[d][i];
        p->x[d][i] = x + h;
        const real above = contact_energy(&e->contact, p);
        p->x[d][i] = x - h;
        const real below = contact_energy(&e->contact, p);
        p->x[d][i] = x;
        assert_near(p->f[d][i], (below - above) / (2 * h), 1e-4 * most);
    }
}

/* Through a collision: beside the plain sum after every fourth step. */
static void check_collision(const char *text, real pairs_least)
{
    struct scene s;
    struct engine *e = contact_run(&s, text);
    int64_t seen = 0;
    while (e->clock.step < e->clock.steps) {
        assert_ok(engine_step(e));
        assert_ok(engine_stability_check(e));
        if (e->clock.step % 4 > 0) continue;
        check_plain(e);
        if (e->contact.touching == 0) continue;
        check_gradient(e);
        seen++;
    }
    if (seen < 3 || (real)e->contact.pairs_most < pairs_least)
        fail_msg("seen %d times, %d pairs", (int)seen, (int)e->contact.pairs_most);
    contact_end(e, &s);
}

static void test_line(void **state) { (void)state; check_collision(line, 1); }
static void test_plane(void **state) { (void)state; check_collision(plane, 8); }
static void test_space(void **state) { (void)state; check_collision(space, 20); }

/* k of a pair of lattice particles: 5/6 E A/D in a line (families of 3: E A/D is 6 k1, and k is 15/3.015 k1), and 0.51
 * E h a column in the plane, to 3 % (shell weights change c). */
static void test_stiffness(void **state)
{
    (void)state;
    struct scene s;
    struct engine *e = contact_run(&s, line);
    assert_near(e->contact.law.stiffness[0] * square(4e-6 * 1e-3), 15 / 3.015 / 6 * 200e9 * 4e-6 / 1e-3, 1);
    contact_end(e, &s);
    e = contact_run(&s, plane);
    assert_near(e->contact.law.stiffness[0] * square(2e-3 * 1e-6), 0.51 * 200e9 * 2e-3, 0.03 * 0.51 * 200e9 * 2e-3);
    contact_end(e, &s);
}

/* Bodies one spacing apart at rest, and a crack: no force, and nothing moves, to the last bit. */
static void test_rest(void **state)
{
    (void)state;
    static const char text[] =
        "name: rest\nspace: plane stress\nthickness: 1 mm\nmethod: pd\nduration: 100 us\n"
        "material: {young: 72 GPa, density: 2440}\n"
        "bodies:\n  - {name: low, shape: {box: {from: [0, 0], to: [20 mm, 10 mm]}}}\n"
        "  - {name: high, shape: {box: {from: [0, 10 mm], to: [20 mm, 20 mm]}}}\n"
        "cracks: [{from: [5 mm, -1 mm], to: [5 mm, 8 mm]}]\nparticles: {spacing: 1 mm}\n"
        "contact: {between: all}\ntime: {step: 0.1 us}\noutput: {frames: 1, samples: 10}\n";
    struct scene s;
    struct engine *e = contact_run(&s, text);
    for (int step = 0; step < 1000; step++) assert_ok(engine_step(e));
    assert_true(e->contact.pairs > 50);
    for (int d = 0; d < 2; d++)
        for (int64_t i = 0; i < e->part.n; i++) assert_true(e->part.v[d][i] == 0);
    contact_end(e, &s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_line), cmocka_unit_test(test_plane),
                                       cmocka_unit_test(test_space), cmocka_unit_test(test_stiffness),
                                       cmocka_unit_test(test_rest)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
