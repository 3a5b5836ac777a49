/* floor 3: boundary conditions at work: mirror images, forces, walls, and their impulse and work. */
#include "loads.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "memory.h"
#include "team.h"

#define PLACE_TOLERANCE 1e-9             /* of a spacing: points on a region's border belong to it */

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
        load_select(&l->load[b], &boundary[b], p, spacing);
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
    memory_free(l->held);
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
            real force = factor * load->boundary->value[d] * load->share[k * p->dim + d];
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

/* ---- walls of the grid ----------------------------------------------------------------------------- */

static void held_add(struct loads *l, int64_t node, int component, int load)
{
    if (l->helds == l->held_room) {
        int64_t room = l->held_room ? 2 * l->held_room : 256;
        l->held = memory_resize("loads.held", l->held, l->held_room, room, sizeof *l->held);
        l->held_room = room;
    }
    l->held[l->helds++] = (struct held){(int32_t)node, (uint8_t)component, (uint8_t)load};
}

static bool node_held(const struct load *load, const real *x, int dim, real tolerance, int component)
{
    const struct boundary *b = load->boundary;
    if (b->kind == BOUNDARY_VELOCITY)
        return b->body < 0 && (b->components >> component & 1) && region_contains(&b->region, x, dim, tolerance);
    return b->kind == BOUNDARY_MIRROR && (component == b->axis || b->hold_tangential) &&
           load->outside * (x[b->axis] - b->at) >= -tolerance;
}

bool mirror_on_nodes(const struct boundary *b, const struct grid *g, real spacing)
{
    const real steps = 2 * (b->at - g->anchor[b->axis]) / g->h;
    return fabs(steps - nearbyint(steps)) * g->h <= 2 * PLACE_TOLERANCE * spacing;
}

/* Node k of the box reflected in a mirror that it lies beyond, within reach of the widest shape: places and components
 * turn round. False if it lies beyond but has no image. */
static bool node_reflect(const struct load *load, const struct grid *g, real spacing, int64_t *k, struct fold *f)
{
    const struct boundary *b = load->boundary;
    if (b->kind != BOUNDARY_MIRROR) return true;
    const real away = b->at - grid_position(g, b->axis, k[b->axis]);
    if (-load->outside * away <= PLACE_TOLERANCE * spacing) return true;
    const int64_t whole = llround(2 * away / g->h);
    if (!mirror_on_nodes(b, g, spacing) || whole < -4 || whole > 4) return false;
    k[b->axis] += whole;
    for (int d = 0; d < DIM_MAX; d++)
        if (d == b->axis || b->hold_tangential) f->sign[d] = (int8_t)-f->sign[d];
    return k[b->axis] >= 0 && k[b->axis] < g->count[b->axis];
}

/* Does a node beyond mirrors move as the image of another? */
static bool node_folded(const struct loads *l, const struct grid *g, int64_t I, struct fold *f)
{
    int64_t k[DIM_MAX] = {0}, image = 0;
    *f = (struct fold){.node = (int32_t)I, .sign = {1, 1, 1}};
    for (int d = 0; d < g->dim; d++) k[d] = I / g->stride[d] % g->count[d];
    for (int b = 0; b < l->n; b++) {
        const int64_t before = k[l->load[b].boundary->axis];
        if (!node_reflect(&l->load[b], g, l->spacing, k, f)) return false;
        if (k[l->load[b].boundary->axis] != before) f->load = (uint8_t)b;
    }
    for (int b = 0; b < l->n; b++) {             /* between two mirrors an image may lie beyond the other one */
        struct fold none = *f;
        int64_t again[DIM_MAX];
        memcpy(again, k, sizeof k);
        if (!node_reflect(&l->load[b], g, l->spacing, again, &none) || memcmp(again, k, sizeof k) != 0) return false;
    }
    for (int d = 0; d < g->dim; d++) image += k[d] * g->stride[d];
    f->image = (int32_t)image;
    return image != I;
}

/* Nodes held wherever the body is, and nodes that follow their images: found once for each box of the grid. */
static void held_find(struct loads *l, struct grid *g)
{
    struct fold fold;
    l->helds = 0;
    g->folds = 0;
    for (int d = 0; d < g->dim; d++) l->held_first[d] = g->first[d], l->held_count[d] = g->count[d];
    for (int64_t I = 0; I < g->n; I++) {
        real x[DIM_MAX];
        if (node_folded(l, g, I, &fold)) {
            grid_add_fold(g, &fold);
            continue;
        }
        for (int d = 0; d < g->dim; d++) x[d] = grid_position(g, d, I / g->stride[d] % g->count[d]);
        for (int b = 0; b < l->n; b++)
            for (int d = 0; d < g->dim; d++)
                if (node_held(&l->load[b], x, g->dim, PLACE_TOLERANCE * l->spacing, d)) held_add(l, I, d, b);
    }
}

static bool held_is_current(const struct loads *l, const struct grid *g)
{
    for (int d = 0; d < g->dim; d++)
        if (l->held_first[d] != g->first[d] || l->held_count[d] != g->count[d]) return false;
    return true;
}

/* Mass that a load's driven material points give to the nodes; returns their number. */
static int64_t driven_share(struct loads *l, const struct load *load, const struct grid *g, const struct particles *p,
                            const struct kernels *k, real half_width)
{
    int32_t *list = NEW("loads.driven", load->n, int32_t);
    real *mass = NEW("loads.driven_mass", load->n, real);
    int64_t n = 0;
    for (int64_t q = 0; q < load->n; q++)
        if (particle_on_grid(p, load->particle[q])) {
            list[n] = load->particle[q];
            mass[n++] = p->mass[load->particle[q]];
        }
    if (n > 0) {
        if (l->share_room < g->n) {
            l->share = memory_resize("loads.share", l->share, l->share_room, g->n, sizeof *l->share);
            l->share_room = g->n;
        }
        memset(l->share, 0, (size_t)g->n * sizeof *l->share);
        k->spread(g, p, half_width, list, n, mass, l->share);
    }
    memory_free(list);
    memory_free(mass);
    return n;
}

static void driven_walls(struct loads *l, int which, struct grid *g, real velocity_factor, real change_factor)
{
    const struct boundary *b = l->load[which].boundary;
    for (int64_t I = 0; I < g->n; I++) {
        if (l->share[I] <= 0 || l->share[I] < 0.5 * (1 - 1e-9) * g->mass[I]) continue;
        for (int d = 0; d < g->dim; d++)
            if (b->components >> d & 1)
                grid_add_wall(g, I, d, velocity_factor * b->value[d], change_factor * b->value[d], which);
    }
}

void loads_walls(struct loads *l, struct grid *g, const struct particles *p, const struct kernels *k, real half_width,
                 real t, real dt)
{
    g->walls = 0;
    if (l->n == 0) return;
    if (!held_is_current(l, g)) held_find(l, g);
    real velocity[BOUNDARIES_MAX], change[BOUNDARIES_MAX];
    for (int b = 0; b < l->n; b++) {
        velocity[b] = time_function_at(&l->load[b].boundary->time, t);
        change[b] = t > dt ? velocity[b] - time_function_at(&l->load[b].boundary->time, t - dt) : 0;
    }
    for (int64_t q = 0; q < l->helds; q++) {
        const struct held *h = &l->held[q];
        if (g->mass[h->node] <= 0) continue;
        const struct boundary *b = l->load[h->load].boundary;
        real value = b->kind == BOUNDARY_VELOCITY ? b->value[h->component] : 0;
        grid_add_wall(g, h->node, h->component, velocity[h->load] * value, change[h->load] * value, h->load);
    }
    for (int b = 0; b < l->n; b++)
        if (l->load[b].boundary->kind == BOUNDARY_VELOCITY && driven_share(l, &l->load[b], g, p, k, half_width) > 0)
            driven_walls(l, b, g, velocity[b], change[b]);
}

/* ---- after the gather ------------------------------------------------------------------------------- */

static void hold(struct loads *l, const struct load *load, struct particles *p, real factor)
{
    const struct boundary *b = load->boundary;
    for (int64_t k = 0; k < load->n; k++) {
        int32_t i = load->particle[k];
        if (!particle_on_grid(p, i)) continue;
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
            work += factor * load->boundary->value[d] * load->share[k * p->dim + d] *
                    (p->x[d][load->particle[k]] - load->before[k * p->dim + d]);
    l->work += work;
}

void loads_hold(struct loads *l, struct grid *g, struct particles *p, real t, real dt_velocity)
{
    for (int64_t q = 0; q < g->walls; q++)
        l->load[g->wall[q].load].reaction[g->wall[q].component] += g->wall[q].reaction / dt_velocity;
    for (int64_t q = 0; q < g->folds; q++)
        for (int d = 0; d < g->dim; d++)
            l->load[g->fold[q].load].reaction[d] += g->fold[q].reaction[d] / dt_velocity;
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
