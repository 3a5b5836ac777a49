/* floor 3: boundary conditions at work: who is loaded, mirror images, forces, walls, and their impulse and work. */
#include "loads.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "memory.h"
#include "team.h"

#define PLACE_TOLERANCE 1e-9             /* of a spacing: points on a region's border belong to it */

/* ---- who is loaded --------------------------------------------------------------------------------- */

static bool load_selects(const struct boundary *b, const struct particles *p, int64_t i, real spacing)
{
    real X[DIM_MAX];
    particle_place(p, i, X);
    if (b->body >= 0 && p->body[i] != b->body) return false;
    return region_contains(&b->region, X, p->dim, PLACE_TOLERANCE * spacing);
}

/* Outermost coordinate of the selected particles along a traction's normal. */
static real face_place(const struct boundary *b, const struct particles *p, const uint8_t *selected)
{
    real place = -INFINITY;
    for (int64_t i = 0; i < p->n; i++)
        if (selected[i]) place = real_max(place, b->side * p->X[b->face][i]);
    return place;
}

static real profile_at(const struct profile *f, const struct particles *p, int64_t i)
{
    real X[DIM_MAX], along = 0;
    if (f->kind == PROFILE_UNIFORM) return 1;
    particle_place(p, i, X);
    for (int d = 0; d < p->dim; d++) along += (X[d] - f->origin[d]) * f->direction[d];
    return sin(2 * M_PI * along / (sqrt(dot(f->direction, f->direction, p->dim)) * f->wavelength));
}

static real load_share(const struct boundary *b, const struct particles *p, int64_t i, real spacing)
{
    return p->volume0[i] * (b->kind == BOUNDARY_TRACTION ? 1 / spacing : profile_at(&b->profile, p, i));
}

static void load_make(struct load *l, const struct boundary *b, struct particles *p, real spacing)
{
    l->boundary = b;
    if (b->kind == BOUNDARY_MIRROR) return;
    uint8_t *selected = NEW("loads.selected", p->n, uint8_t);
    for (int64_t i = 0; i < p->n; i++) selected[i] = load_selects(b, p, i, spacing);
    if (b->kind == BOUNDARY_TRACTION) {      /* the outermost layer only: within half a spacing of the farthest */
        real place = face_place(b, p, selected);
        for (int64_t i = 0; i < p->n; i++)
            selected[i] = selected[i] && b->side * p->X[b->face][i] > place - 0.5 * spacing;
    }
    for (int64_t i = 0; i < p->n; i++) l->n += selected[i];
    l->particle = NEW("loads.particle", l->n, int32_t);
    l->share = NEW("loads.share", l->n, real);
    l->before = NEW("loads.before", l->n * p->dim, real);
    for (int64_t i = 0, k = 0; i < p->n; i++) {
        if (!selected[i]) continue;
        l->particle[k] = (int32_t)i;
        l->share[k++] = load_share(b, p, i, spacing);
        if (b->kind == BOUNDARY_VELOCITY) p->flag[i] |= FLAG_DRIVEN;
    }
    memory_free(selected);
}

/* ---- mirrors --------------------------------------------------------------------------------------- */

/* Adds the images of one mirror: of everything near its plane, images of earlier mirrors included, so that corners get
 * theirs. Nothing on the plane itself: such a particle is its own image. */
static void mirror_make(struct loads *l, int which, const struct boundary *b, struct particles *p, real reach,
                        int optional)
{
    int64_t before = p->n_all, images = 0, have = l->images;
    for (int pass = 0; pass < 2; pass++) {
        images = 0;
        for (int64_t i = 0; i < before; i++) {
            real distance = fabs(p->X[b->axis][i] - b->at);
            if (distance > reach || distance <= PLACE_TOLERANCE * l->spacing) continue;
            if (b->body >= 0 && p->body[i] != b->body) continue;
            if (pass == 1) l->image[have + images] = (struct image){(int32_t)i, (uint8_t)which};
            images++;
        }
        if (pass == 0) l->image = memory_resize("loads.image", l->image, have, have + images, sizeof *l->image);
    }
    particles_add_images(p, images, optional);
    l->images += images;
    for (int64_t k = have; k < l->images; k++) {
        int64_t g = p->n + k, i = l->image[k].source;
        for (int d = 0; d < p->dim; d++) p->X[d][g] = d == b->axis ? 2 * b->at - p->X[d][i] : p->X[d][i];
        p->volume0[g] = p->volume0[i], p->volume[g] = p->volume[i], p->mass[g] = p->mass[i];
        p->material[g] = p->material[i], p->body[g] = p->body[i], p->id[g] = p->id[i];
    }
}

void loads_mirror(const struct loads *l, struct particles *p)
{
    for (int64_t k = 0; k < l->images; k++) {
        int64_t g = p->n + k, i = l->image[k].source;
        const struct boundary *b = l->load[l->image[k].load].boundary;
        for (int d = 0; d < p->dim; d++) {
            real sign = d == b->axis || b->hold_tangential ? -1 : 1;
            p->x[d][g] = p->X[d][g] + sign * (p->x[d][i] - p->X[d][i]);
            p->v[d][g] = sign * p->v[d][i];
        }
        p->kind[g] = p->kind[i];
        p->flag[g] = p->flag[i] & FLAG_DRIVEN;
    }
}

/* A mirror with body on both sides would lay images upon particles. */
static status mirror_checked(const struct boundary *b, const struct particles *p, real spacing)
{
    bool below = false, above = false;
    for (int64_t i = 0; i < p->n; i++) {
        if (b->body >= 0 && p->body[i] != b->body) continue;
        below = below || p->X[b->axis][i] < b->at - PLACE_TOLERANCE * spacing;
        above = above || p->X[b->axis][i] > b->at + PLACE_TOLERANCE * spacing;
    }
    if (!(below && above)) return OK;
    return status_set(REFUSED, "boundary %s: the mirror at %c = %.6g m cuts the body; a mirror stands at its border",
                      b->name, "xyz"[b->axis], b->at);
}

/* The side of a mirror that holds no body: -1 below, +1 above. */
static int mirror_outside(const struct boundary *b, const struct particles *p)
{
    real sum = 0;
    for (int64_t i = 0; i < p->n; i++)
        if (b->body < 0 || p->body[i] == b->body) sum += p->X[b->axis][i] - b->at;
    return sum > 0 ? -1 : 1;
}

/* ---- set-up ---------------------------------------------------------------------------------------- */

status loads_make(struct loads *l, const struct boundary *boundary, int n, struct particles *p, real spacing,
                  real reach, int optional)
{
    assert(n <= BOUNDARIES_MAX);
    memset(l, 0, sizeof *l);
    l->n = n;
    l->spacing = spacing;
    l->load = NEW("loads.load", n, struct load);
    for (int b = 0; b < n; b++) {
        load_make(&l->load[b], &boundary[b], p, spacing);
        if (boundary[b].kind == BOUNDARY_MIRROR) {
            TRY(mirror_checked(&boundary[b], p, spacing));
            l->load[b].outside = mirror_outside(&boundary[b], p);
            mirror_make(l, b, &boundary[b], p, reach, optional);
        }
    }
    for (int b = 0; b < n; b++)
        if (l->load[b].n == 0 && (boundary[b].kind == BOUNDARY_TRACTION || boundary[b].kind == BOUNDARY_BODY_FORCE))
            return status_set(REFUSED, "boundary %s: no particle lies in its region", boundary[b].name);
    loads_mirror(l, p);
    return OK;
}

void loads_free(struct loads *l)
{
    for (int b = 0; b < l->n; b++) {
        memory_free(l->load[b].particle);
        memory_free(l->load[b].share);
        memory_free(l->load[b].before);
    }
    memory_free(l->load);
    memory_free(l->image);
    memory_free(l->share);
    memory_free(l->held.held);
    memory_free(l->held_mesh.held);
    memset(l, 0, sizeof *l);
}

/* ---- forces on particles --------------------------------------------------------------------------- */

void loads_clear(struct loads *l, struct particles *p)
{
    for (int b = 0; b < l->n; b++)
        for (int64_t k = 0; k < l->load[b].n; k++)
            for (int d = 0; d < p->dim; d++) p->f[d][l->load[b].particle[k]] = 0;
}

/* Driven peridynamic particles get the force that gives them their velocity; what it differs from the bonds' is the
 * reaction of the support. */
static void drive(struct loads *l, struct load *load, struct particles *p, real factor, real dt_velocity)
{
    const struct boundary *b = load->boundary;
    real given[DIM_MAX] = {0}, work = 0;
    for (int64_t k = 0; k < load->n; k++) {
        int32_t i = load->particle[k];
        if (particle_on_grid(p, i)) continue;
        for (int d = 0; d < p->dim; d++) {
            if (!(b->components >> d & 1)) continue;
            real target = factor * b->value[d], before = p->v[d][i];
            real needed = p->mass[i] * (target - before) / dt_velocity, reaction = needed - p->f[d][i];
            load->reaction[d] -= p->f[d][i];     /* without the driven particles' own inertia: what a load cell reads */
            p->f[d][i] = needed;
            given[d] += reaction * dt_velocity;
            work += reaction * dt_velocity * 0.5 * (before + target);
        }
    }
    for (int d = 0; d < p->dim; d++) l->impulse[d] += given[d];
    l->held_work += work;
}

struct force_sum { const struct particles *p; int component; };

static real force_term(const void *context, int64_t i)
{
    const struct force_sum *s = context;
    return s->p->f[s->component][i];
}

/* Bonds between particles add up to no force; what is left across a mirror is what its images gave, the support's
 * impulse. Along a mirror that leaves tangential motion free the images' forces cancel in pairs, so there the
 * account of momentum stays a check. */
static void mirror_impulse(struct loads *l, const struct particles *p, real dt_velocity)
{
    bool held[DIM_MAX] = {false};
    for (int b = 0; b < l->n; b++)
        for (int d = 0; d < p->dim; d++)
            if (l->load[b].boundary->kind == BOUNDARY_MIRROR)
                held[d] = held[d] || d == l->load[b].boundary->axis || l->load[b].boundary->hold_tangential;
    for (int d = 0; d < p->dim; d++)
        if (held[d]) l->impulse[d] += dt_velocity * team_sum(p->n, force_term, &(struct force_sum){p, d});
}

/* Adds an applied force. What a step gives is summed before it joins what all steps gave: round-off then grows with the
 * number of steps, not of steps times particles. */
static void apply(struct loads *l, struct load *load, struct particles *p, real factor, real dt_velocity)
{
    real given[DIM_MAX] = {0};
    for (int64_t k = 0; k < load->n; k++)
        for (int d = 0; d < p->dim; d++) {
            real force = factor * load->boundary->value[d] * load->share[k];
            load->before[k * p->dim + d] = p->x[d][load->particle[k]];
            p->f[d][load->particle[k]] += force;
            given[d] += force;
        }
    for (int d = 0; d < p->dim; d++) l->impulse[d] += given[d] * dt_velocity;
}

/* Mean over the kick that ends at t, by the trapezoidal rule: the kick lies round the instant of the forces, and the
 * value at its end alone would be half a step late, an error of first order. What switches at a whole step then gives
 * its full impulse, too: half of it in the kick that the switch divides. */
static real kick_factor(const struct time_function *f, real t, real dt_velocity)
{
    return 0.5 * (time_function_at(f, t - dt_velocity) + time_function_at(f, t));
}

void loads_apply(struct loads *l, struct particles *p, real t, real dt, real dt_velocity)
{
    if (l->images > 0) mirror_impulse(l, p, dt_velocity);
    for (int c = 0; c < l->n; c++) {
        struct load *load = &l->load[c];
        const struct boundary *b = load->boundary;
        memset(load->reaction, 0, sizeof load->reaction);
        if (b->kind != BOUNDARY_TRACTION && b->kind != BOUNDARY_BODY_FORCE) continue;
        apply(l, load, p, kick_factor(&b->time, t, dt_velocity), dt_velocity);
    }
    for (int c = 0; c < l->n; c++) {         /* after all forces: what holds a particle sees them */
        struct load *load = &l->load[c];
        if (load->boundary->kind != BOUNDARY_VELOCITY) continue;
        real factor = time_function_at(&load->boundary->time, t);
        for (int d = 0; d < p->dim; d++)
            if (load->boundary->components >> d & 1) load->displacement[d] += factor * load->boundary->value[d] * dt;
        drive(l, load, p, factor, dt_velocity);
    }
}

/* ---- after the gather ------------------------------------------------------------------------------- */

static void hold(struct loads *l, const struct load *load, struct particles *p, real factor)
{
    const struct boundary *b = load->boundary;
    for (int64_t k = 0; k < load->n; k++) {
        int32_t i = load->particle[k];
        if (!particle_on_grid(p, i) || p->flag[i] & FLAG_MESHED) continue;      /* the mesh holds its nodes */
        for (int d = 0; d < p->dim; d++) {
            if (!(b->components >> d & 1)) continue;
            real target = factor * b->value[d], given = p->mass[i] * (target - p->v[d][i]);
            l->impulse[d] += given;
            l->held_work += given * 0.5 * (target + p->v[d][i]);
            p->v[d][i] = target;
        }
    }
}

/* Work of applied forces over the way their particles went. */
static void applied_work(struct loads *l, const struct load *load, const struct particles *p, real factor)
{
    real work = 0;
    for (int64_t k = 0; k < load->n; k++)
        for (int d = 0; d < p->dim; d++)
            work += factor * load->boundary->value[d] * load->share[k] *
                    (p->x[d][load->particle[k]] - load->before[k * p->dim + d]);
    l->work += work;
}

void loads_react(struct loads *l, const struct grid *g, real dt_velocity)
{
    for (int64_t q = 0; q < g->walls; q++)
        l->load[g->wall[q].load].reaction[g->wall[q].component] += g->wall[q].reaction / dt_velocity;
    for (int64_t q = 0; q < g->folds; q++)
        for (int d = 0; d < g->dim; d++)
            l->load[g->fold[q].load].reaction[d] += g->fold[q].reaction[d] / dt_velocity;
}

void loads_hold(struct loads *l, struct grid *g, struct particles *p, real t, real dt_velocity)
{
    loads_react(l, g, dt_velocity);
    for (int c = 0; c < l->n; c++) {
        struct load *load = &l->load[c];
        real factor = time_function_at(&load->boundary->time, t);
        if (load->boundary->kind == BOUNDARY_VELOCITY) hold(l, load, p, factor);
        else if (load->boundary->kind != BOUNDARY_MIRROR) applied_work(l, load, p, factor);
    }
}

status loads_archive(struct loads *l, struct archive *a)
{
    ARCHIVE_VALUE(a, "loads/impulse", l->impulse);
    ARCHIVE_VALUE(a, "loads/work", l->work);
    ARCHIVE_VALUE(a, "loads/held_work", l->held_work);
    for (int b = 0; b < l->n; b++) {
        char name[48];
        snprintf(name, sizeof name, "loads/displacement%d", b);
        ARCHIVE_VALUE(a, name, l->load[b].displacement);
    }
    return OK;
}
