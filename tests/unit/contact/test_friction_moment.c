/* Friction between particles of two bodies: it conserves momentum and angular momentum, its work is the energy that
 * springs store and dissipate, and bodies that rotate together have none. */
#include <math.h>
#include <string.h>

#include "scene/scene_read.h"
#include "base/memory.h"
#include "engine/engine.h"
#include "src/contact/contact_internal.h"
#include "tests/support/near.h"
#include "step/report.h"

/* A block on another one of a different material. */
static const char plane[] =
    "space: plane strain\nthickness: 0.37 mm\nduration: 1 us\nmethod: pd\n"
    "materials:\n  - {name: hard, young: 200 GPa, poisson: 1/4, density: 8000}\n"
    "  - {name: soft, young: 3 GPa, poisson: 1/4, density: 1180}\nbodies:\n"
    "  - {name: low, material: hard, shape: {box: {from: [0, 0], to: [20 mm, 5 mm]}}}\n"
    "  - {name: high, material: soft, shape: {box: {from: [4.3 mm, 5 mm], to: [14.3 mm, 9 mm]}}}\n"
    "particles: {spacing: 1 mm}\ncontact: {between: bodies, friction: 0.3}\n";
static const char space[] =
    "space: solid\nduration: 1 us\nmethod: pd\n"
    "materials:\n  - {name: hard, young: 200 GPa, poisson: 1/4, density: 8000}\n"
    "  - {name: soft, young: 3 GPa, poisson: 1/4, density: 1180}\nbodies:\n"
    "  - {name: low, material: hard, shape: {box: {from: [0, 0, 0], to: [9 mm, 8 mm, 3 mm]}}}\n"
    "  - {name: high, material: soft, shape: {box: {from: [2.3 mm, 4.4 mm, 3 mm], to: [7.3 mm, 10.4 mm, 6 mm]}}}\n"
    "particles: {spacing: 1 mm}\ncontact: {between: bodies, friction: 0.3}\n";

/* Rotates the vector v[3] by `angle` [rad] about the unit vector axis[3] (Rodrigues' formula). */
static void rotate(const real *axis, real angle, real *v)
{
    real across[3];
    vector_product(axis, v, across);
    const real along = dot(axis, v, 3) * (1 - cos(angle));
    for (int d = 0; d < 3; d++) v[d] = v[d] * cos(angle) + across[d] * sin(angle) + axis[d] * along;
}

static void position(const struct particles *p, int64_t i, real *x)
{
    for (int d = 0; d < 3; d++) x[d] = d < p->dim ? p->x[d][i] : 0;
}

/* Rotates the particles of p that belong to body `body`, or to all bodies (-1), by `angle` [rad] about the point
 * `centre` and the unit vector `axis`. */
static void body_rotate(struct particles *p, int body, const real *centre, const real *axis, real angle)
{
    for (int64_t i = 0; i < p->n; i++) {
        real x[3];
        if (body >= 0 && p->body[i] != body) continue;
        position(p, i, x);
        for (int d = 0; d < p->dim; d++) x[d] -= centre[d];
        rotate(axis, angle, x);
        for (int d = 0; d < p->dim; d++) p->x[d][i] = centre[d] + x[d];
    }
}

static const real *axis_of(int dim)
{
    static const real across[3] = {0, 0, 1}, odd[3] = {0.48, -0.6, 0.64};
    return dim == 2 ? across : odd;
}

/* Reads the scene `text` into *s and creates its run, finds the pairs in contact, presses the upper block obliquely
 * into the lower one, and rotates both together by 0.7 rad. Returns the run. */
static struct run *pressed_begin(struct scene *s, const char *text)
{
    struct run *run = NEW("test.engine", 1, struct run);
    struct particles *p = &run->part;
    if (scene_read_text(s, text, strlen(text), "friction.yaml", NULL, 0) != OK) fail_msg("%s", status_message());
    assert_ok(run_set_up_from_scene(run, s, NULL));
    run->report->quiet = true;
    assert_ok(report_open_history_and_write_first_frame(run));
    contact_update_pair_list_if_outdated(run->contact, p, &run->bonds, &run->loads, &run->source.family, 0, 0, 0);
    for (int64_t i = 0; i < p->n; i++)
        if (p->body[i] == 1) p->x[p->dim - 1][i] -= 0.12e-3;
    body_rotate(p, 1, (const real[]){7e-3, 6e-3, 4e-3}, axis_of(p->dim), 0.013);
    body_rotate(p, -1, (const real[]){3e-3, 11e-3, -2e-3}, axis_of(p->dim), 0.7);
    return run;
}

static void pressed_end(struct run *run, struct scene *s)
{
    run_free_memory(run);
    memory_free(run);
    scene_free(s);
}

/* Computes the forces of contact into run->part.f after a step of dt [s], by whose motion the friction springs are
 * stretched; dt = 0: without stretching them. */
static void forces_after(struct run *run, real dt)
{
    struct particles *p = &run->part;
    contact_update_pair_list_if_outdated(run->contact, p, &run->bonds, &run->loads, &run->source.family, 0, 0, 0);
    for (int d = 0; d < p->dim; d++) memset(p->f[d], 0, (size_t)p->n * sizeof(real));
    contact_compute_forces(run->contact, p, dt);
}

/* Moves the particles of the run by a step dt [s] and computes the friction forces drag[dim n] [N], i.e. contact forces
 * minus those without springs. Returns the power of friction at the velocities of this step [W], with the mean of the
 * forces before (drag as passed) and after the step. */
static real slide(struct run *run, real dt, real *drag)
{
    struct particles *p = &run->part;
    struct contact *c = run->contact;
    real power = 0;
    for (int d = 0; d < p->dim; d++)
        for (int64_t i = 0; i < p->n; i++) {
            power += 0.5 * drag[d * p->n + i] * p->v[d][i];
            p->x[d][i] += p->v[d][i] * dt;
        }
    forces_after(run, dt);
    for (int d = 0; d < p->dim; d++) memcpy(drag + d * p->n, p->f[d], (size_t)p->n * sizeof(real));
    struct contact_spring *spring = c->spring;
    c->spring = NULL;
    forces_after(run, 0);
    c->spring = spring;
    for (int d = 0; d < p->dim; d++)
        for (int64_t i = 0; i < p->n; i++) {
            drag[d * p->n + i] -= p->f[d][i];
            power += 0.5 * drag[d * p->n + i] * p->v[d][i];
        }
    return power;
}

/* Checks that the sums of the forces f[dim n] on the particles p, and of their moments, vanish, relative to the sums of
 * their magnitudes. */
static void check_sums(const struct particles *p, const real *f)
{
    real force[3] = {0}, moment[3] = {0}, size = 0, far = 0;
    for (int64_t i = 0; i < p->n; i++) {
        real x[3], own[3] = {0}, turning[3];
        position(p, i, x);
        for (int d = 0; d < p->dim; d++) own[d] = f[d * p->n + i];
        vector_product(x, own, turning);
        for (int d = 0; d < 3; d++) force[d] += own[d], moment[d] += turning[d];
        size += sqrt(dot(own, own, 3)), far = real_max(far, sqrt(dot(x, x, 3)));
    }
    assert_true(size > 0);
    for (int d = 0; d < 3; d++) {
        assert_near(force[d], 0, 1e-13 * size);
        assert_near(moment[d], 0, 1e-13 * size * far);
    }
}

static real friction_energy(const struct contact *c)
{
    return contact_friction_stored_energy(c) + contact_friction_dissipated_energy(c);
}

/* Sets the velocities of p: the upper block slides and rotates on the lower one, which rotates in the opposite
 * direction; each particle has an additional small motion. */
static void set_moving(struct particles *p)
{
    const real *axis = axis_of(p->dim);
    for (int64_t i = 0; i < p->n; i++) {
        real x[3], turning[3];
        position(p, i, x);
        vector_product(axis, x, turning);
        for (int d = 0; d < p->dim; d++)
            p->v[d][i] = (p->body[i] == 1 ? 240 : -130) * turning[d] + (p->body[i] == 1 ? 2 - d : 0) +
                         0.3 * sin(12.9 * (real)(i + 1) * (d + 1));
    }
}

/* Runs the scene `text` for `steps` steps over `time` [s] and checks the sums of friction forces after each step
 * (check_sums). Returns the relative difference between the work of friction and the energy that springs have stored
 * and dissipated. */
static real work_error(const char *text, real time, int steps)
{
    struct scene s;
    struct run *run = pressed_begin(&s, text);
    struct particles *p = &run->part;
    real *drag = NEW("test.drag", p->n * p->dim, real), work = 0;
    forces_after(run, 0);
    set_moving(p);
    for (int k = 0; k < steps; k++) {
        work -= slide(run, time / steps, drag) * time / steps;
        check_sums(p, drag);
    }
    const real energy = friction_energy(run->contact);
    assert_true(contact_friction_dissipated_energy(run->contact) > 0.3 * energy &&
                contact_friction_stored_energy(run->contact) > 0);
    memory_free(drag);
    pressed_end(run, &s);
    return work / energy - 1;
}

/* Checks that the work of friction in the scene `text` equals the energy of the springs, to 3e-4 in 40 steps and 1e-4
 * in 160. Measured in 40 steps: 1.4e-4 in 2D, where the spring rotates with its face by 1e-3 per step, and 6e-7 in 3D;
 * the difference is proportional to the step. */
static void check_sliding(const char *text)
{
    assert_near(work_error(text, 20e-6, 40), 0, 3e-4);
    assert_near(work_error(text, 20e-6, 160), 0, 1e-4);
}

static void sliding_in_the_plane(void **state) { (void)state, check_sliding(plane); }
static void sliding_in_space(void **state) { (void)state, check_sliding(space); }

/* Checks that two bodies of the scene `text` that rotate together by 0.1 rad in 100 steps have no friction energy.
 * Tolerance: chords instead of arcs cause a slip of 1e-9 of the arm per step. A slip relative to the mean velocity of
 * neighbours a spacing away would be 1e-3 of a spacing. */
static void check_turning(const char *text)
{
    struct scene s;
    struct run *run = pressed_begin(&s, text);
    struct particles *p = &run->part;
    const struct contact *c = run->contact;
    const real centre[] = {-2e-3, 5e-3, 1e-3}, dt = 1e-7;
    real k = 0;
    forces_after(run, 0);
    for (int64_t row = 0; row < c->rows; row++) k = real_max(k, 0.5 * c->face[row].stiffness);
    for (int step = 0; step < 100; step++) {
        for (int d = 0; d < p->dim; d++) memcpy(p->v[d], p->x[d], (size_t)p->n * sizeof(real));
        body_rotate(p, -1, centre, axis_of(p->dim), 1e-3);
        for (int d = 0; d < p->dim; d++)
            for (int64_t i = 0; i < p->n; i++) p->v[d][i] = (p->x[d][i] - p->v[d][i]) / dt;
        forces_after(run, dt);
    }
    assert_true(c->touching > 5);
    assert_near(friction_energy(c), 0, 1e-12 * k);
    pressed_end(run, &s);
}

static void turning_together(void **state)
{
    (void)state;
    check_turning(plane);
    check_turning(space);
}

/* ---- particles in a line ----------------------------------------------------------------------------------------- */

#define H 0.7e-3 /* spacing [m] */

/* Computes the friction of a particle at the height H above `felt` particles along x, whose y alternates between
 * `aside` and -aside [m]: it moves by 1 um along the axis `along` and sticks. The moment of friction about these
 * particles is balanced by a couple of forces on them. Returns the largest of these forces divided by the friction
 * force. *balance: receives the fraction of the moment that the couple balances. */
static real couple_of(int felt, real aside, int along, real *balance)
{
    struct particles p;
    struct contact_face face = {.stiffness = 3, .push = -1000};
    struct contact_spring spring = {.stored = 0};
    struct contact_reaction reaction;
    int32_t particle[4] = {0, 1, 2, 3}, other[3] = {1, 2, 3};
    int64_t first[2] = {0, felt};
    real size[4] = {H, H, H, H}, rise[4] = {0}, most = 0, moment[3], sum = 0, force[3];
    struct contact c = {.law = {.friction = 1},
                        .n = 4,
                        .rows = 1,
                        .particle = particle,
                        .root = particle,
                        .size = size,
                        .rise = rise,
                        .first = first,
                        .other = other,
                        .pairs = felt,
                        .face = &face,
                        .spring = &spring,
                        .reaction = &reaction};
    particles_make(&p, 3, 4, 0);
    p.x[2][0] = H, p.v[along][0] = 10;
    for (int j = 0; j < felt; j++) p.x[0][j + 1] = (j - (felt - 1) / 2) * H, p.x[1][j + 1] = j == 1 ? -aside : aside;
    contact_face_advance_friction_spring(&c, &p, 0, 1e-7);
    vector_product(reaction.arm, spring.drag, moment);
    for (int j = 0; j < felt; j++) {
        const struct contact_density_contribution w =
            contact_face_kernel_density_contribution_of_pair(&c, &p, 0, j + 1, 0);
        real r[3], turning[3];
        for (int d = 0; d < 3; d++) r[d] = reaction.arm[d] - w.apart[d];
        vector_product(reaction.turn, r, force);
        for (int d = 0; d < 3; d++) force[d] *= w.weight / spring.density;
        vector_product(r, force, turning);
        sum += dot(turning, moment, 3);
        most = real_max(most, sqrt(dot(force, force, 3)));
    }
    particles_free(&p);
    *balance = sum / dot(moment, moment, 3);
    return most / sqrt(dot(spring.drag, spring.drag, 3));
}

/* Checks the couple that balances the moment of friction on particles in a line. It balances a moment across the line,
 * but not one along it; almost none if the particles hardly deviate from the line, and all of it if they deviate by 0.4
 * spacings. No force may exceed sqrt(10) times the friction force. */
static void felt_in_a_line(void **state)
{
    (void)state;
    real balance;
    assert_near(couple_of(1, 0, 0, &balance), 0, 1e-12);
    assert_near(balance, 0, 1e-12);
    assert_true(couple_of(3, 0, 0, &balance) < 1);
    assert_near(balance, 1, 1e-12);
    assert_near(couple_of(3, 0, 1, &balance), 0, 1e-12);
    assert_near(balance, 0, 1e-12);
    assert_near(couple_of(3, 0.02 * H, 1, &balance), 0, 1e-3);
    assert_true(couple_of(3, 0.4 * H, 1, &balance) < sqrt(10));
    assert_near(balance, 1, 1e-12);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(sliding_in_the_plane), cmocka_unit_test(sliding_in_space),
                                       cmocka_unit_test(turning_together), cmocka_unit_test(felt_in_a_line)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
