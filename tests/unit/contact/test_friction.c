/* Friction: the spring of a contact compared with Coulomb's law and its energies; contact of rigid bodies, whose forces
 * are the gradient of the contact energy and balance those on the particles; sliding bodies; weights of particles of
 * different sizes. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "engine/engine.h"
#include "scene/scene_read.h"
#include "src/contact/contact_internal.h"
#include "tests/support/near.h"
#include "step/report.h"
#include "rigid/rigid_part.h"
#include "step/sample.h"

/* Checks a friction spring of 3 kN/m on a face with the normal (0, 0.6, 0.8). It sticks up to 0.2 N and then slides
 * with this force; the work of the motion is stored or dissipated; at separation the stored energy is dissipated. */
static void spring_of_coulomb(void **state)
{
    (void)state;
    const real normal[] = {0, 0.6, 0.8}, k = 3000, most = 0.2, none[3] = {0};
    const real step[] = {3e-6, 0.8e-6, 5e-6}, along[] = {3e-6, 0.8e-6 - 0.6 * 4.48e-6, 5e-6 - 0.8 * 4.48e-6};
    const real size = sqrt(dot(along, along, 3));
    struct contact_spring s = {.stored = 0};
    real given = 0, drag = 0;
    for (int n = 1; n <= 40; n++) {
        contact_friction_spring_advance(&s, 3, normal, step, k, most);
        const real force = real_min(most, k * size * n);
        for (int d = 0; d < 3; d++) assert_near(s.drag[d], -force * along[d] / size, 1e-13);
        given += 0.5 * (drag + force) * size, drag = force;
        assert_near(s.stored, 0.5 * force * force / k, 1e-16);
    }
    assert_true(k * size * 40 > 1.5 * most);
    assert_close(s.stored + s.lost, given, 1e-12);
    contact_friction_spring_advance(&s, 3, none, none, k, 0); /* separated */
    assert_near(s.stored, 0, 0);
    assert_close(s.lost, given, 1e-12);
}

/* Checks that a friction spring is rotated with its face: it remains in the plane of the face, and its length and
 * energy are unchanged. */
static void spring_follows_its_face(void **state)
{
    (void)state;
    const real before[] = {0, 0, 1}, after[] = {0.6, 0, 0.8}, step[] = {4e-6, 3e-6, 0}, none[3] = {0};
    struct contact_spring s = {.stored = 0};
    contact_friction_spring_advance(&s, 3, before, step, 1000, 1);
    contact_friction_spring_advance(&s, 3, after, none, 1000, 1);
    assert_close(dot(s.length, s.length, 3), 25e-12, 1e-12);
    assert_near(dot(s.length, after, 3), 0, 1e-20);
    assert_close(s.stored, 0.5 * 1000 * 25e-12, 1e-12);
    assert_near(s.lost, 0, 1e-20);
}

/* ---- in a body --------------------------------------------------------------------------------------------------- */

/* Reads the scene `text` into *s and returns a new run of it before its first step. */
static struct run *body_begin(struct scene *s, const char *text)
{
    struct run *run = NEW("test.engine", 1, struct run);
    if (scene_read_text(s, text, strlen(text), "friction.yaml", NULL, 0) != OK) fail_msg("%s", status_message());
    assert_ok(run_set_up_from_scene(run, s, NULL));
    run->report->quiet = true;
    assert_ok(report_open_history_and_write_first_frame(run));
    return run;
}

static void body_end(struct run *run, struct scene *s)
{
    run_free_memory(run);
    memory_free(run);
    scene_free(s);
}

static void look(struct run *run)
{
    contact_update_pair_list_if_outdated(run->contact, &run->part, &run->bonds, &run->loads, &run->source.family, 0, 0,
                                         0);
}

static void forces_at(struct run *run, real dt)
{
    struct particles *p = &run->part;
    look(run);
    for (int d = 0; d < p->dim; d++) memset(p->f[d], 0, (size_t)p->n * sizeof(real));
    contact_compute_forces(run->contact, p, dt);
}

/* A block that is pressed into a disc by 0.1 spacings, off the centre of the disc. */
static const char pressed[] =
    "space: plane strain\nthickness: 0.37 m\nduration: 1 us\nmethod: pd\n"
    "material: {young: 3 GPa, poisson: 1/4, density: 1180}\nbodies:\n"
    "  - {name: block, shape: {box: {from: [0, 0], to: [12 mm, 6 mm]}}}\n"
    "  - {name: disc, rigid: true, mass: 2 kg, shape: {disc: {centre: [4 mm, 13 mm], radius: 7 mm}}}\n"
    "particles: {spacing: 1 mm}\n";

/* Checks that force and moment on a rigid body balance those on the particles, to round-off, and that the force on one
 * particle is the gradient of the contact energy (central difference, tolerance 1e-5). */
static void rigid_force_is_a_gradient(void **state)
{
    (void)state;
    struct scene s;
    struct run *run = body_begin(&s, pressed);
    struct particles *p = &run->part;
    struct rigid_body *r = &run->rigid->body[0];
    look(run);
    r->x[1] -= 0.1e-3;
    forces_at(run, 0);
    const real energy = contact_elastic_energy(run->contact, p), step = 1e-9;
    const real force[] = {r->force[0], r->force[1]}, moment = r->moment[2];
    real sum[2] = {0}, turning = 0, own[2] = {0};
    int32_t one = -1;
    for (int64_t i = 0; i < p->n; i++) {
        const real x = p->x[0][i] - r->x[0], y = p->x[1][i] - r->x[1];
        for (int d = 0; d < 2; d++) sum[d] -= p->f[d][i];
        turning -= x * p->f[1][i] - y * p->f[0][i];
        if (p->f[0][i] > 0) one = (int32_t)i, own[0] = p->f[0][i], own[1] = p->f[1][i];
    }
    assert_true(energy > 0 && force[1] > 0 && one >= 0);
    for (int d = 0; d < 2; d++) assert_near(force[d], sum[d], 1e-12 * force[1]);
    assert_near(moment, turning, 1e-12 * force[1] * 7e-3);
    for (int d = 0; d < 2; d++) {
        real work[2];
        for (int side = 0; side < 2; side++) {
            p->x[d][one] += (side ? -1 : 1) * step;
            work[side] = contact_elastic_energy(run->contact, p);
            p->x[d][one] -= (side ? -1 : 1) * step;
        }
        assert_near(own[d], -(work[0] - work[1]) / (2 * step), 1e-5 * hypot(own[0], own[1]));
    }
    body_end(run, &s);
}

/* A disc with an eccentric pivot, in contact with two separate bodies: the moment on it is not zero, unlike that on a
 * disc pivoted at its centre. */
static const char pivoted[] =
    "space: plane strain\nthickness: 0.37 m\nduration: 1 us\nmethod: pd\n"
    "material: {young: 3 GPa, poisson: 1/4, density: 1180}\nbodies:\n"
    "  - {name: block, shape: {box: {from: [0, 0], to: [12 mm, 6 mm]}}}\n"
    "  - {name: bar, rigid: true, mass: 2 kg, shape: {box: {from: [8 mm, 6 mm], to: [31 mm, 9 mm]}}}\n"
    "particles: {spacing: 1 mm}\n";

/* Checks that the moment on a rigid body about an eccentric pivot balances that of the forces on the particles. */
static void rigid_moment(void **state)
{
    (void)state;
    struct scene s;
    struct run *run = body_begin(&s, pivoted);
    struct particles *p = &run->part;
    struct rigid_body *r = &run->rigid->body[0];
    real force = 0, turning = 0;
    look(run);
    r->x[1] -= 0.1e-3;
    forces_at(run, 0);
    for (int64_t i = 0; i < p->n; i++) {
        force -= p->f[1][i];
        turning -= (p->x[0][i] - r->x[0]) * p->f[1][i] - (p->x[1][i] - r->x[1]) * p->f[0][i];
    }
    assert_true(force > 0 && turning < -5e-3 * force); /* pressed up on its left end: clockwise moment */
    assert_close(r->moment[2], turning, 1e-12);
    body_end(run, &s);
}

/* ---- faces that slide -------------------------------------------------------------------------------------------- */

/* Two blocks, one on the other. */
static const char blocks[] = "space: plane strain\nthickness: 0.37 m\nduration: 1 us\nmethod: pd\n"
                             "material: {young: 3 GPa, poisson: 1/4, density: 1180}\nbodies:\n"
                             "  - {name: low, shape: {box: {from: [0, 0], to: [20 mm, 5 mm]}}}\n"
                             "  - {name: high, shape: {box: {from: [4 mm, 5 mm], to: [14 mm, 9 mm]}}}\n"
                             "particles: {spacing: 1 mm}\ncontact: {between: bodies, friction: 0.3}\n";

/* Checks that bodies that move together have no friction, and that a sliding body experiences 0.3 times the normal
 * force against its motion. Tolerance 2 %: forces at the ends of the face are oblique. */
static void faces_rub(void **state)
{
    (void)state;
    struct scene s;
    struct run *run = body_begin(&s, blocks);
    struct particles *p = &run->part;
    real drag[2] = {0}, press[2] = {0};
    look(run);
    for (int64_t i = 0; i < p->n; i++) {
        if (p->body[i] == 1) p->x[1][i] -= 0.05e-3;
        p->v[0][i] = 7, p->v[1][i] = 2;
    }
    for (int k = 0; k < 3; k++) forces_at(run, 1e-7);
    assert_near(contact_friction_stored_energy(run->contact), 0, 1e-20);
    assert_near(contact_friction_dissipated_energy(run->contact), 0, 1e-20);
    for (int64_t i = 0; i < p->n; i++) p->v[0][i] = p->body[i] == 1 ? 9 : 7, p->v[1][i] = 0;
    for (int k = 0; k < 400; k++) forces_at(run, 1e-7); /* 80 um: all springs slide */
    for (int64_t i = 0; i < p->n; i++) drag[p->body[i]] += p->f[0][i], press[p->body[i]] += p->f[1][i];
    assert_true(press[1] > 0);
    assert_near(drag[0] + drag[1], 0, 1e-9 * press[1]);
    assert_close(drag[1], -0.3 * press[1], 0.02); /* forces at the ends of the face are oblique */
    assert_true(contact_friction_dissipated_energy(run->contact) > 0);
    body_end(run, &s);
}

/* A block under a rigid bar. */
static const char barred[] =
    "space: plane strain\nthickness: 0.37 m\nduration: 1 us\nmethod: pd\n"
    "material: {young: 3 GPa, poisson: 1/4, density: 1180}\nbodies:\n"
    "  - {name: block, shape: {box: {from: [0, 0], to: [12 mm, 6 mm]}}}\n"
    "  - {name: bar, rigid: true, mass: 2 kg, shape: {box: {from: [-3 mm, 6 mm], to: [31 mm, 9 mm]}}}\n"
    "particles: {spacing: 1 mm}\ncontact: {between: bodies, friction: 0.3}\n";

/* Sums the forces p->f of all particles (the block) into force[2] [N]. */
static void block_force(const struct particles *p, real *force)
{
    force[0] = force[1] = 0;
    for (int64_t i = 0; i < p->n; i++)
        for (int d = 0; d < 2; d++) force[d] += p->f[d][i];
}

/* Checks that particles that move and rotate with a rigid body experience no friction. If the body is faster along its
 * face, it exerts the friction coefficient times the normal force on them, and its moment balances theirs. The
 * dissipated energy is then 0.3 force 1.6 m/s time; a sample includes it in the dissipated energy of the run. */
static void rigid_body_rubs(void **state)
{
    (void)state;
    struct scene s;
    struct run *run = body_begin(&s, barred);
    struct particles *p = &run->part;
    struct rigid_body *r = &run->rigid->body[0];
    real force[2];
    look(run);
    r->x[1] -= 0.05e-3, r->v[0] = 7, r->v[1] = 2, r->spin[2] = 130;
    for (int64_t i = 0; i < p->n; i++) {
        p->v[0][i] = 7 - 130 * (p->x[1][i] - r->x[1]);
        p->v[1][i] = 2 + 130 * (p->x[0][i] - r->x[0]);
    }
    for (int k = 0; k < 3; k++) forces_at(run, 1e-7);
    assert_near(contact_friction_stored_energy(run->contact), 0, 1e-20);
    assert_near(contact_friction_dissipated_energy(run->contact), 0, 1e-20);
    r->spin[2] = 0;
    for (int64_t i = 0; i < p->n; i++) p->v[0][i] = 5.4, p->v[1][i] = 2;
    for (int k = 0; k < 400; k++) forces_at(run, 1e-7); /* 64 um: all springs slide */
    block_force(p, force);
    assert_true(force[1] < 0);
    assert_close(force[0], -0.3 * force[1], 1e-9);
    assert_close(r->force[0], 0.3 * force[1], 1e-9);
    real turning = 0;
    for (int64_t i = 0; i < p->n; i++)
        turning += (p->x[0][i] - r->x[0]) * p->f[1][i] - (p->x[1][i] - r->x[1]) * p->f[0][i];
    assert_near(r->moment[2], -turning, 1e-12 * fabs(force[1]) * 31e-3);
    const real before = contact_friction_dissipated_energy(run->contact), lost = -0.3 * force[1] * 1.6 * 7e-7;
    for (int k = 0; k < 7; k++) forces_at(run, 1e-7);
    assert_close(contact_friction_dissipated_energy(run->contact) - before, lost, 1e-9);
    run->report->sampling.due = true, run->damped = 0.021;
    history_sample_compute_energies(run);
    assert_close(run->report->sampling.energy.damped, 0.021 + before + lost, 1e-9);
    assert_true(lost > 1e-6 * 0.021); /* significant beside the other terms */
    body_end(run, &s);
}

/* Checks the kernel weights of pairs of particles of different sizes against the formula W = (1 - q)^4 (1 + 4 q) times
 * D_l/D (2D). q = r/(2 D); r: distance; D: mean of both sizes; D_l: size of the other particle. */
static void weights_of_sizes(void **state)
{
    (void)state;
    struct scene s;
    struct run *run = body_begin(&s, blocks);
    struct particles *p = &run->part;
    struct contact *c = run->contact;
    int tried = 0;
    for (int64_t i = 0; i < p->n; i++)
        if (p->body[i] == 1) p->volume0[i] *= square(1.3);
    c->due = true;
    look(run);
    for (int64_t row = 0; row < c->rows; row++)
        for (int64_t q = c->first[row]; q < c->first[row + 1]; q++) {
            const int32_t i = c->particle[row], l = c->other[q], j = c->particle[l];
            const real own = p->body[i] == 1 ? 1.3e-3 : 1e-3, felt = p->body[j] == 1 ? 1.3e-3 : 1e-3;
            const real mean = 0.5 * (own + felt), r = hypot(p->x[0][i] - p->x[0][j], p->x[1][i] - p->x[1][j]);
            const real z = r / (2 * mean), W = z < 1 ? square(square(1 - z)) * (1 + 4 * z) : 0;
            assert_near(contact_face_kernel_density_contribution_of_pair(c, p, row, l, 0).weight, felt / mean * W,
                        1e-9);
            tried += own != felt && W > 0;
        }
    assert_true(tried > 10);
    body_end(run, &s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spring_of_coulomb),
        cmocka_unit_test(spring_follows_its_face),
        cmocka_unit_test(rigid_force_is_a_gradient),
        cmocka_unit_test(rigid_moment),
        cmocka_unit_test(faces_rub),
        cmocka_unit_test(rigid_body_rubs),
        cmocka_unit_test(weights_of_sizes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
