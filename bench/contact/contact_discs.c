/* Discs that meet obliquely without friction: only the normal part of their velocity may change, nothing may turn. */
#include <math.h>
#include <string.h>

#include "contact_bench.h"

/* Velocity and spin of a body of discs or spheres about its centre of mass. */
struct contact_motion contact_motion_of(const struct engine *e, int body)
{
    const struct particles *p = &e->part;
    struct contact_motion m = {0};
    double x[DIM_MAX] = {0}, inertia = 0;
    for (int64_t i = 0; i < p->n; i++) {
        if (p->body[i] != body) continue;
        m.mass += p->mass[i];
        for (int d = 0; d < p->dim; d++) x[d] += p->mass[i] * p->x[d][i], m.v[d] += p->mass[i] * p->v[d][i];
    }
    for (int d = 0; d < p->dim; d++) m.x[d] = x[d] / m.mass, m.v[d] /= m.mass;
    for (int64_t i = 0; i < p->n && p->dim > 1; i++) {
        if (p->body[i] != body) continue;
        const double a = p->x[0][i] - m.x[0], b = p->x[1][i] - m.x[1];
        m.spin += p->mass[i] * (a * (p->v[1][i] - m.v[1]) - b * (p->v[0][i] - m.v[0]));
        inertia += p->mass[i] * (a * a + b * b);
    }
    if (inertia > 0) m.spin /= inertia;
    return m;
}

static const double WAVE = 5000;         /* sqrt(E/rho) [m/s] */

static void discs_text(FILE *to, const struct contact_discs *c)
{
    const double D = 1e-3, R = c->radius * D, v = c->speed * WAVE, angle = asin(0.5 * c->offset);
    const double gap = 0.3 * D, far = (2 * R + gap), turn = c->turn;
    /* line of centres at `turn`, velocities at `turn` - angle to it */
    const double nx = cos(turn), ny = sin(turn), vx = v * cos(turn - angle), vy = v * sin(turn - angle);
    const double until = gap / (2 * v * cos(angle)) + 40 * c->radius * D / WAVE * (1 - 0.1 * log10(c->speed / 0.01));
    fprintf(to,
            "name: discs\nspace: plane stress\nthickness: 1 mm\nmethod: pd\nmodel: %s\nduration: %.9g\n"
            "material: {young: 200 GPa, poisson: 1/3, density: 8000}\nparticles: {spacing: 1 mm}\nbodies:\n"
            "  - {name: a, shape: {ball: {centre: [%.9g, %.9g], radius: %.9g}}, velocity: [%.9g, %.9g]}\n"
            "  - {name: b, shape: {ball: {centre: [%.9g, %.9g], radius: %.9g}}, velocity: [%.9g, %.9g]}\n"
            "contact: {between: bodies, law: %s}\noutput: {frames: 0, samples: 100}\n",
            c->model, until, -0.5 * far * nx, -0.5 * far * ny, R, vx, vy, 0.5 * far * nx, 0.5 * far * ny, R, -vx, -vy,
            c->law);
    if (c->safety > 0) fprintf(to, "time: {safety: %.9g}\n", c->safety);
}

status contact_discs_run(struct contact_discs *c)
{
    char text[2048];
    struct engine e;
    struct scene s;
    FILE *to = fmemopen(text, sizeof text, "w");
    discs_text(to, c);
    fclose(to);
    TRY(bench_engine_make(&e, &s, "discs", text, NULL, 0));
    const double angle = asin(0.5 * c->offset), v = c->speed * WAVE, nx = cos(c->turn), ny = sin(c->turn);
    const status ran = engine_run(&e);
    if (ran == OK) {
        const struct contact_motion a = contact_motion_of(&e, 0), b = contact_motion_of(&e, 1);
        const double wx = b.v[0] - a.v[0], wy = b.v[1] - a.v[1];
        c->restitution = (wx * nx + wy * ny) / (2 * v * cos(angle));
        c->tangential = angle != 0 ? (-wx * ny + wy * nx) / (2 * v * sin(angle)) : wy * nx - wx * ny;
        c->spin = 0.5 * (a.spin + b.spin) * c->radius * 1e-3 / v;
        c->energy = e.diagnostics.now.balance_error;
        c->overlap = e.contact.overlap_most / 1e-3;
    }
    bench_engine_free(&e, &s);
    return ran;
}
