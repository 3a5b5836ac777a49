/* Contact between particles: forces and energy compared with sums over all pairs without bonds, Newton's third law,
 * forces as the gradient of the energy, the stiffness of the contact law, and contact with a rigid ball. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "engine/engine.h"
#include "scene/scene_read.h"
#include "src/contact/contact_internal.h"
#include "tests/support/near.h"
#include "step/report.h"
#include "probes/diagnostics.h"
#include "step/stability.h"
#include "step/checks.h"

/* A body that hits a cracked one, whose crack closes. */
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
static const char line[] = "name: hit\nspace: line\nsection: 4 mm^2\nmethod: pd\nduration: 30 us\n"
                           "material: {young: 200 GPa, density: 8000}\n"
                           "bodies:\n  - {name: striker, shape: {box: {from: [-20 mm], to: [0]}}, velocity: [10 m/s]}\n"
                           "  - {name: target, shape: {box: {from: [0.02 mm], to: [20.02 mm]}}}\n"
                           "particles: {spacing: 1 mm}\ncontact: {between: all}\noutput: {frames: 1, samples: 10}\n";

/* A rotated box, whose side faces are staircases on the lattice, is cut through and sheared: columns of particles of
 * one half slide past those of the other. */
static const char turned[] =
    "name: turned\nspace: solid\nmethod: pd\nduration: 16 us\n"
    "material: {young: 110 GPa, density: 4430, energy_release_rate: 500 J/m^2}\n"
    "body: {box: {from: [0, 0, 0], to: [6 mm, 4 mm, 8 mm]}, rotate: {angle: 30 deg}}\nparticles: {spacing: 1 mm}\n"
    "cracks: [{polygon: [[-9 mm, -20 mm, 4 mm], [20 mm, -20 mm, 4 mm], [20 mm, 20 mm, 4 mm], [-9 mm, 20 mm, 4 mm]]}]\n"
    "boundary: [{fixed: all, region: {half-space: {point: [0, 0, 2 mm], normal: [0, 0, 1]}}}, "
    "{velocity: [free, 40 m/s, free], region: {half-space: {point: [0, 0, 6 mm], normal: [0, 0, -1]}}}]\n"
    "output: {frames: 1, samples: 1000}\n";

static struct run *contact_run(struct scene *s, const char *text, const char *law)
{
    const struct scene_override set = {"contact.law", law};
    struct run *run = NEW("test.engine", 1, struct run);
    if (scene_read_text(s, text, strlen(text), "contact.yaml", &set, 1) != OK) fail_msg("%s", status_message());
    assert_ok(run_set_up_from_scene(run, s, NULL));
    run->report->quiet = true;
    assert_ok(report_open_history_and_write_first_frame(run));
    return run;
}

static void contact_end(struct run *run, struct scene *s)
{
    run_free_memory(run);
    memory_free(run);
    scene_free(s);
}

static bool has_bond(const struct run *run, int64_t i, int64_t j)
{
    for (struct bond_iterator it = bond_iterator_of_row(&run->bonds, run->bonds.row_of[i]); bond_iterator_advance(&it);)
        if (it.bond.w != 0 && it.bond.nbr == j) return true;
    return false;
}

static real length(const struct particles *p, real *const *place, int64_t i, int64_t j)
{
    real r2 = 0;
    for (int d = 0; d < p->dim; d++) r2 += square(place[d][i] - place[d][j]);
    return sqrt(r2);
}

/* Returns the contact stiffness k of particles i and j [N/m]: 15 c V_i V_j/delta, with the micro-modulus c (for two
 * materials the harmonic mean), the volumes V and the horizon delta. */
static real plain_stiffness(const struct run *run, int64_t i, int64_t j)
{
    const struct particles *p = &run->part;
    struct family family = run->source.family;
    family_make_on_lattice(&family, family.space, family.spacing, 3.015, family.section);
    const real a = family_micro_modulus(&family, &run->scene->material[p->material[i]]);
    const real b = family_micro_modulus(&family, &run->scene->material[p->material[j]]);
    return 15 * (2 * a * b / (a + b)) * p->volume0[i] * p->volume0[j] / (3.015 * run->scene->spacing);
}

static bool may_meet(const struct run *run, int64_t i, int64_t j)
{
    const struct particles *p = &run->part;
    if (i == j || (run->scene->contact_between == CONTACT_BODIES && p->body[i] == p->body[j])) return false;
    return !has_bond(run, i, j);
}

/* Computes the contact of the law `pair` for all pairs of particles without a bond whose distance is less than one
 * spacing and less than in the reference state. f[dim n]: receives the forces [N]. Returns the energy [J]. */
static real plain_pairs(const struct run *run, real *f)
{
    const struct particles *p = &run->part;
    real energy = 0;
    memset(f, 0, (size_t)(p->n * p->dim) * sizeof *f);
    for (int64_t i = 0; i < p->n; i++)
        for (int64_t j = i + 1; j < p->n; j++) {
            const real r = length(p, p->x, i, j), d = real_min(run->scene->spacing, length(p, p->X, i, j));
            if (r >= d || !may_meet(run, i, j)) continue;
            const real k = plain_stiffness(run, i, j);
            energy += 0.5 * k * square(d - r);
            for (int x = 0; x < p->dim; x++) {
                const real push = k * (d - r) * (p->x[x][i] - p->x[x][j]) / r;
                f[x * p->n + i] += push, f[x * p->n + j] -= push;
            }
        }
    return energy;
}

/* ---- law `surface` ----------------------------------------------------------------------------------------------- */

/* Returns Wendland's kernel (1 - q)^4 (1 + 4 q) at the distance q, relative to its range; 0 beyond the range. */
static real wendland(real q) { return q < 1 ? pow(1 - q, 4) * (1 + 4 * q) : 0; }

/* Returns the density that particles of a plane layer have at the height s above one of them [spacings]: the number of
 * particles nearby, weighted by Wendland's kernel with a range of two spacings. */
static real above_layer(int dim, real s)
{
    real sum = 0;
    for (int a = -3; a <= 3; a++)
        for (int b = -3; b <= 3; b++)
            if ((dim > 1 || a == 0) && (dim > 2 || b == 0)) sum += wendland(0.5 * sqrt(a * a + b * b + s * s));
    return sum;
}

/* Returns the height above a layer of particles [spacings] at which its density (above_layer) has the value `density`,
 * by bisection. */
static real height_of(int dim, real density)
{
    real low = 0, high = 2;
    for (int k = 0; k < 60; k++) {
        const real middle = 0.5 * (low + high);
        if (above_layer(dim, middle) > density)
            low = middle;
        else
            high = middle;
    }
    return 0.5 * (low + high);
}

/* Returns by how much the distance of particle i from the surface of its body (ball or box) exceeds half a spacing
 * [spacings], within 0.6; 0 for particles farther inside. */
static real plain_rise(const struct run *run, int64_t i)
{
    const struct particles *p = &run->part;
    const struct solid *solid = run->scene->body[p->body[i]].shape.solid;
    real inside = INFINITY, r2 = 0;
    for (int d = 0; d < p->dim; d++) {
        r2 += square(p->X[d][i] - solid->centre[d]);
        inside = real_min(inside, real_min(p->X[d][i] - solid->from[d], solid->to[d] - p->X[d][i]));
    }
    if (solid->kind == SOLID_BALL) inside = solid->radius - sqrt(r2);
    const real rise = inside / run->scene->spacing - 0.5;
    return rise > 0.6 ? 0 : real_max(rise, -0.6);
}

/* Returns the height of particle i above the layer of particles near faces with which it may come into contact, minus
 * the mean of their plain_rise weighted by the kernel [spacings]. place[dim]: current or reference positions; *softest:
 * receives the stiffness of the softest pair [N/m]. */
static real plain_height(const struct run *run, int64_t i, real *const *place, real *softest)
{
    const struct contact *c = run->contact;
    real density = 0, rise = 0;
    *softest = INFINITY;
    for (int64_t k = 0; k < c->rows; k++) {
        const int32_t j = c->particle[k];
        if (!may_meet(run, i, j) || length(&run->part, run->part.x, i, j) > 2.3 * run->scene->spacing) continue;
        const real weight = wendland(0.5 * length(&run->part, place, i, j) / run->scene->spacing);
        density += weight, rise += weight * plain_rise(run, j);
        *softest = real_min(*softest, plain_stiffness(run, i, j));
    }
    return height_of(run->part.dim, density) - (density > 0 ? rise / density : 0);
}

/* Returns the contact energy of all particles by the law `surface` [J]: the sum of 1/4 k (zero - height)^2, with the
 * height of plain_height and the stiffness k of the softest pair. zero: height at which contact begins, 1 + plain_rise
 * [spacings], or the height in the reference state if that is less. */
static real plain_faces(const struct run *run)
{
    real energy = 0, softest;
    for (int64_t k = 0; k < run->contact->rows; k++) {
        const int32_t i = run->contact->particle[k];
        const real height = plain_height(run, i, run->part.x, &softest);
        if (height >= 1 + plain_rise(run, i)) continue;
        const real zero = real_min(1 + plain_rise(run, i), plain_height(run, i, run->part.X, &softest));
        if (height < zero) energy += 0.25 * softest * square((zero - height) * run->scene->spacing);
    }
    return energy;
}

/* Computes the forces of contact, without bonds and loads, into run->part.f. */
static void contact_alone(struct run *run)
{
    for (int d = 0; d < run->part.dim; d++) memset(run->part.f[d], 0, (size_t)run->part.n * sizeof(real));
    contact_restore_active_particles_after_restart(run->contact, &run->part, &run->bonds, &run->loads);
    contact_compute_forces(run->contact, &run->part, 0);
}

/* Checks that the sums of contact forces and of their moments vanish. Tolerance: round-off of the up to a dozen pairs
 * of a particle. */
static void check_third_law(const struct run *run)
{
    const struct particles *p = &run->part;
    real most = 0, sum[DIM_MAX] = {0}, moment[DIM_MAX] = {0};
    for (int64_t i = 0; i < p->n; i++)
        for (int d = 0; d < p->dim; d++) {
            const int a = (d + 1) % 3, b = (d + 2) % 3;
            most = real_max(most, fabs(p->f[d][i]));
            sum[d] += p->f[d][i];
            if (a < p->dim && b < p->dim) moment[d] += p->x[a][i] * p->f[b][i] - p->x[b][i] * p->f[a][i];
        }
    if (p->dim == 2)
        for (int64_t i = 0; i < p->n; i++) moment[2] += p->x[0][i] * p->f[1][i] - p->x[1][i] * p->f[0][i];
    for (int d = 0; d < 3; d++) {
        assert_near(sum[d], 0, 1e-13 * most * sqrt((real)p->n));
        assert_near(moment[d], 0, 1e-13 * most * sqrt((real)p->n) * 20e-3);
    }
}

/* Compares the contact of the run with sums over all pairs (plain_pairs, plain_faces). Law `pair`: forces and energy
 * agree to round-off. Law `surface`: the energy agrees within the error of the table of heights, 1e-6 spacings. */
static void check_plain(struct run *run)
{
    const struct particles *p = &run->part;
    real *f = NEW("test.f", p->n * p->dim, real), most = 0;
    contact_alone(run);
    const real found = contact_elastic_energy(run->contact, p);
    if (run->scene->contact_form == CONTACT_SURFACE) {
        const real energy = plain_faces(run);
        const real k = plain_stiffness(run, 0, 0) * square(run->scene->spacing);
        assert_near(found, energy, 1e-6 * sqrt(k * energy * (real)(run->contact->touching + 1)));
    } else {
        const real energy = plain_pairs(run, f);
        for (int64_t k = 0; k < p->n * p->dim; k++) most = real_max(most, fabs(f[k]));
        for (int d = 0; d < p->dim; d++)
            for (int64_t i = 0; i < p->n; i++) assert_near(p->f[d][i], f[d * p->n + i], 1e-12 * most);
        assert_near(found, energy, 1e-12 * energy);
    }
    check_third_law(run);
    memory_free(f);
}

/* Compares the contact force on the particle with the deepest overlap with -dE/dx, by a central difference over 1e-6 of
 * a spacing. Tolerance: pairs that open within the difference leave (1e-6)^2 k. */
static void check_gradient(struct run *run)
{
    struct particles *p = &run->part;
    contact_alone(run);
    const int32_t i = run->contact->deepest;
    const real h = 1e-6 * run->scene->spacing;
    real most = 0;
    for (int d = 0; d < p->dim; d++) most = real_max(most, fabs(p->f[d][i]));
    for (int d = 0; d < p->dim; d++) {
        const real x = p->x[d][i];
        p->x[d][i] = x + h;
        const real above = contact_elastic_energy(run->contact, p);
        p->x[d][i] = x - h;
        const real below = contact_elastic_energy(run->contact, p);
        p->x[d][i] = x;
        assert_near(p->f[d][i], (below - above) / (2 * h), 1e-4 * most);
    }
}

/* Runs the collision of the scene `text` with the contact law `law` and compares contact with the sums over all pairs
 * after every fourth step. Fails unless at least `pairs_least` pairs were in contact and contact lasted for 3
 * comparisons. */
static void check_collision(const char *text, const char *law, real pairs_least)
{
    struct scene s;
    struct run *run = contact_run(&s, text, law);
    int64_t seen = 0;
    while (run->clock.step < run->clock.steps) {
        assert_ok(run_adapt_mesh_and_advance_one_step(run));
        assert_ok(run_check_stability_after_step(run));
        if (run->clock.step % 4 > 0) continue;
        check_plain(run);
        if (run->contact->touching == 0) continue;
        check_gradient(run);
        seen++;
    }
    if (seen < 3 || (real)run->contact->pairs_most < pairs_least)
        fail_msg("seen %d times, %d pairs", (int)seen, (int)run->contact->pairs_most);
    contact_end(run, &s);
}

static void test_line(void **state)
{
    (void)state;
    check_collision(line, "pair", 1);
    check_collision(line, "surface", 1);
}

static void test_plane(void **state)
{
    (void)state;
    check_collision(plane, "pair", 8);
    check_collision(plane, "surface", 8);
}

static void test_space(void **state)
{
    (void)state;
    check_collision(space, "pair", 20);
    check_collision(space, "surface", 20);
}

/* Compares the forces of the law `surface` with the gradient of the energy, without the part that removes energy gained
 * by the time step (contact_balance.c). */
static void check_law_gradient(struct run *run)
{
    struct contact *c = run->contact;
    real *drag = NEW("test.drag", c->rows, real);
    for (int64_t row = 0; row < c->rows; row++) drag[row] = c->balance[row].drag, c->balance[row].drag = 0;
    check_gradient(run);
    for (int64_t row = 0; row < c->rows; row++) c->balance[row].drag = drag[row];
    memory_free(drag);
}

/* Checks surfaces far above their particles, which come into contact beyond the range in which the density of a face is
 * not zero: no energy may appear without work of a force. Tolerance 1 %: without contact the energy balance of this
 * run, whose grips start suddenly, is off by up to 0.81 %. */
static void test_steps(void **state)
{
    (void)state;
    struct scene s;
    struct run *run = contact_run(&s, turned, "surface");
    real most = 0;
    int64_t seen = 0;
    while (run->clock.step < run->clock.steps) {
        assert_ok(run_adapt_mesh_and_advance_one_step(run));
        most = real_max(most, fabs(run->diagnostics->now.balance_error));
        if (run->contact->touching == 0) continue;
        if (seen % 8 == 0) check_law_gradient(run);
        seen++;
    }
    if (seen < 20) fail_msg("in contact for %d steps", (int)seen);
    assert_near(most, 0, 0.01);
    contact_end(run, &s);
}

/* Checks the stiffness k of a pair of lattice particles against closed forms: 15/(3.015 6) E A/D = 5/6 E A/D in 1D (D:
 * spacing; neighbourhoods of 3 spacings), and 0.51 E h per column in 2D (h: thickness). Tolerance 3 % in 2D: weights by
 * direction change the micro-modulus. */
static void test_stiffness(void **state)
{
    (void)state;
    struct scene s;
    struct run *run = contact_run(&s, line, "pair");
    assert_near(run->contact->law.stiffness[0] * square(4e-6 * 1e-3), 15 / 3.015 / 6 * 200e9 * 4e-6 / 1e-3, 1);
    contact_end(run, &s);
    run = contact_run(&s, plane, "pair");
    assert_near(run->contact->law.stiffness[0] * square(2e-3 * 1e-6), 0.51 * 200e9 * 2e-3, 0.03 * 0.51 * 200e9 * 2e-3);
    contact_end(run, &s);
}

/* Checks for the contact law `law` that bodies at rest one spacing apart, and the faces of a crack, have exactly zero
 * velocity after 1000 steps. */
static void check_rest(const char *law)
{
    static const char text[] = "name: rest\nspace: plane stress\nthickness: 1 mm\nmethod: pd\nduration: 100 us\n"
                               "material: {young: 72 GPa, density: 2440}\n"
                               "bodies:\n  - {name: low, shape: {box: {from: [0, 0], to: [20 mm, 10 mm]}}}\n"
                               "  - {name: high, shape: {box: {from: [0, 10 mm], to: [20 mm, 20 mm]}}}\n"
                               "cracks: [{from: [5 mm, -1 mm], to: [5 mm, 8 mm]}]\nparticles: {spacing: 1 mm}\n"
                               "contact: {between: all}\ntime: {step: 0.1 us}\noutput: {frames: 1, samples: 10}\n";
    struct scene s;
    struct run *run = contact_run(&s, text, law);
    for (int step = 0; step < 1000; step++) assert_ok(run_adapt_mesh_and_advance_one_step(run));
    assert_true(run->contact->pairs > 50);
    for (int d = 0; d < 2; d++)
        for (int64_t i = 0; i < run->part.n; i++) assert_true(run->part.v[d][i] == 0);
    contact_end(run, &s);
}

static void test_rest(void **state)
{
    (void)state;
    check_rest("pair");
    check_rest("surface");
}

/* Checks the account of the error of leap-frog integration in the contact of one particle whose gap g becomes negative
 * and positive again. It must equal minus the work of the force over all steps n in contact, the sum of 1/2 K g_n
 * (g_n+1 - g_n-1)/2, since the energy is 0 before and after. */
static void test_account(void **state)
{
    (void)state;
    static const real gap[][6] = {{0.9, -0.3, -0.5, 0.1}, {0.7, -0.2, -0.6, -0.25, 0.05, 0.4}};
    static const int gaps[] = {4, 6};
    const real K = 7.3;
    for (int k = 0; k < 2; k++) {
        struct contact_leapfrog_error_account b = contact_leapfrog_error_carry_over_to_new_list(NULL, gap[k][0]);
        real work = 0;
        for (int n = 1; n < gaps[k]; n++) {
            if (gap[k][n] < 0) work += 0.5 * K * gap[k][n] * 0.5 * (gap[k][n + 1] - gap[k][n - 1]);
            assert_true(contact_leapfrog_error_correction_force(&b, K, gap[k][n], true) ==
                        0); /* the account is negative meanwhile */
        }
        assert_near(b.account, -work, 1e-14);
    }
}

/* Checks the contact size of particles, the edge of a cube of equal volume, and that a notch has its width between
 * particles of one body and 0 between particles of two. */
static void test_sizes(void **state)
{
    (void)state;
    const real h = 0.7e-3;
    for (int dim = 1; dim <= 3; dim++) {
        const struct region *shape[2] = {NULL, NULL};
        real corner[2][DIM_MAX] = {{-h, 0.5 * h}, {h, 0.5 * h}};
        const struct crack notch = {.n = 2, .corner = corner, .width = 0.31 * h};
        struct particles p;
        struct contact c = {.n = 3,
                            .rows = 3,
                            .particle = NEW("test", 3, int32_t),
                            .law = {.spacing = h,
                                    .section = dim == 1   ? 4e-6
                                               : dim == 2 ? 0.37e-3
                                                          : 1,
                                    .shape = shape,
                                    .crack = &notch,
                                    .cracks = dim == 2}};
        particles_make(&p, dim, 3, 0);
        for (int i = 0; i < 3; i++) {
            c.particle[i] = i;
            p.X[dim > 1][i] = i * h, p.body[i] = i == 2;
            p.volume0[i] = (i == 1 ? 0.3 : 1) * pow(h, dim) * c.law.section;
        }
        contact_list_set_spacings_and_surface_heights(&c, &p);
        assert_close(c.size[0], h, 1e-14);
        assert_close(c.size[1], dim == 1 ? 0.3 * h : dim == 2 ? sqrt(0.3) * h : cbrt(0.3) * h, 1e-12);
        assert_near(contact_width_of_widest_notch_between_particles(&c, &p, 0, 1), dim == 2 ? 0.31 * h : 0, 0);
        assert_near(contact_width_of_widest_notch_between_particles(&c, &p, 0, 2), 0, 0);
        memory_free(c.particle), memory_free(c.size), memory_free(c.rise), memory_free(c.root);
        particles_free(&p);
    }
}

/* Checks contact of particles with a rigid ball. Contact begins at a distance that follows a particle that moves
 * outwards, but not one that moves inwards (depth and zero). The size of the contact patch is the diagonal of the
 * bounding box of the overlapping particles. */
static void test_beside_a_ball(void **state)
{
    (void)state;
    static const real depth[] = {0.2, 0.35, 0.1, 0.3}, zero[] = {0.2, 0.2, 0.1, 0.1}; /* [spacings] */
    const real h = 0.7e-3, rest[DIM_MAX] = {0};
    static struct solid ball = {.kind = SOLID_BALL, .radius = 9e-3};
    static const struct region shape = {.n = 1, .solid = &ball};
    struct rigid_body rigid = {.name = "ball"};
    struct particles p;
    struct contact c[5] = {{.made = false}};
    assert_ok(rigid_make(&rigid, &shape, 2, 1.3, rest, h));
    particles_make(&p, 2, 3, 0);
    int32_t particle[] = {0, 1, 2};
    real size[] = {h, h, h}, rise[3] = {0};
    for (int k = 1; k < 5; k++) {
        c[k] = (struct contact){.made = true,
                                .n = 3,
                                .rows = 3,
                                .particle = particle,
                                .size = size,
                                .rise = rise,
                                .law = {.spacing = h, .section = 1},
                                .rigids = 1,
                                .rigid = &rigid};
        for (int i = 0; i < 3; i++) { /* on the ball at three angles, with equal depth */
            const real r = 9e-3 + (0.5 - depth[k - 1]) * h, angle = 0.2 + 0.4 * i;
            p.x[0][i] = r * cos(angle), p.x[1][i] = r * sin(angle);
        }
        contact_rigid_list_nearby_particles(&c[k], &c[k - 1], &p, 0.3 * h);
        assert_int_equal(c[k].near[0].n, 3);
        for (int q = 0; q < 3; q++) assert_near(c[k].near[0].zero[q], -zero[k - 1] * h, 1e-12 * h);
    }
    const real wide = p.x[0][0] - p.x[0][2], high = p.x[1][2] - p.x[1][0];
    assert_close(contact_patch_bounding_box_diagonal(&c[4], &p, 0), hypot(wide, high), 1e-12);
    for (int k = 1; k < 5; k++) {
        memory_free(c[k].near[0].row), memory_free(c[k].near[0].zero), memory_free(c[k].near[0].balance);
        memory_free(c[k].near);
    }
    particles_free(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_account), cmocka_unit_test(test_sizes),     cmocka_unit_test(test_beside_a_ball),
        cmocka_unit_test(test_line),    cmocka_unit_test(test_plane),     cmocka_unit_test(test_space),
        cmocka_unit_test(test_steps),   cmocka_unit_test(test_stiffness), cmocka_unit_test(test_rest)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
