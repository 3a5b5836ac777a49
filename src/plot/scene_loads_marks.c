/* Draws loads and supports of a scene at the particles on which they act. */
#include "scene_marks.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "rigid/rigid_part.h"

/* Largest numbers of arrows that are drawn for a load (ARROWS_MOST), for a body force or initial velocities
 * (ARROWS_FIELD), and for initial velocities in a bar (ARROWS_BAR). HOW, TEXT: capacities of texts [byte]. */
enum { ARROWS_MOST = 22, ARROWS_FIELD = 60, ARROWS_BAR = 4, HOW = 160, TEXT = 160 };

/* ---- words ------------------------------------------------------------------------------------------------------- */

/* Appends `words` to text[TEXT], whose present length is `length`; words that do not fit are cut. Returns the new
 * length. */
static int add_words(char *text, int length, const char *words)
{
    const int more = snprintf(text + length, (size_t)(TEXT - length), "%s", words);
    return length + more < TEXT ? length + more : TEXT - 1;
}

/* Appends a value with its unit to text[TEXT], for example ` 12 MPa`, and returns the new length. length: present
 * length of the text; unit: unit of the value without SI prefix, which is chosen here. */
static int add_value(char *text, int length, double value, const char *unit)
{
    char words[64];
    const struct unit u = unit_with_si_prefix_for_largest_value(value, unit);
    snprintf(words, sizeof words, " %.3g %s", value / u.factor, u.name);
    return add_words(text, length, words);
}

/* Returns the magnitude of the vector value[dim]. */
static double value_size(const real *value, int dim)
{
    double sum = 0;
    for (int d = 0; d < dim; d++) sum += square(value[d]);
    return sqrt(sum);
}

/* Returns true if the boundary condition b is a support at rest, i.e. prescribes a velocity of 0. dim: dimension of the
 * scene. */
static bool is_support(const struct boundary *b, int dim)
{
    return b->kind == BOUNDARY_VELOCITY && !b->rotates && value_size(b->value, dim) == 0;
}

static const char *unit_of_value(const struct boundary *b)
{
    if (b->kind == BOUNDARY_BODY_FORCE) return b->by_mass ? "m/s²" : "N/m³";
    if (b->kind == BOUNDARY_TRACTION || b->kind == BOUNDARY_PRESSURE) return "Pa";
    return b->displaces ? "m" : b->kind == BOUNDARY_VELOCITY ? "m/s" : "";
}

/* ---- loads ------------------------------------------------------------------------------------------------------- */

/* Load at the time at which its magnitude is largest. t: this time [s]; most: its magnitude then, in the unit in which
 * such loads are printed; particles: number of particles on which it is not 0; varies: true if the magnitude differs
 * between particles or times. */
struct acting {
    double t, most;
    int64_t particles;
    bool varies;
};

/* Returns the boundary condition of the scene of the run from which the load l was made. It is not always l->boundary,
 * since static solvers replace prescribed displacements in it by velocities. */
static const struct boundary *boundary_of(const struct run *run, const struct load *l)
{
    const int64_t number = l - run->loads.load;
    return number < run->scene->boundaries ? &run->scene->boundary[number] : l->boundary;
}

/* Computes vector[dim], the force density, displacement or velocity that the load l of the run prescribes for its
 * particle number k at time t [s], in the SI unit of this kind of load (such as Pa). Returns its magnitude in this
 * unit. For a pressure the vector has the direction of the force. */
static double vector_at(const struct run *run, const struct load *l, int64_t k, double t, real *vector)
{
    const struct particles *p = &run->part;
    const struct boundary *b = boundary_of(run, l);
    const int32_t i = l->particle[k];
    if (b->displaces) {
        load_prescribed_displacement_of_particle(&(struct load){.boundary = b, .particle = l->particle}, p, k, t,
                                                 vector);
    } else if (b->kind == BOUNDARY_VELOCITY) {
        real X[DIM_MAX];
        particle_reference_position(p, i, X);
        const struct prescribed_motion driving = boundary_prescribed_motion_in_step(b, p->dim, t, run->clock.dt);
        for (int d = 0; d < p->dim; d++)
            vector[d] = b->components >> d & 1 ? prescribed_velocity_component_at_position(&driving, X, d, true) : 0;
    } else if (b->kind == BOUNDARY_BODY_FORCE) {
        load_force_on_particle(l, p, k, t, vector);
        for (int d = 0; d < p->dim; d++) vector[d] /= b->by_mass ? p->mass[i] : p->volume0[i];
    } else {
        load_prescribed_value_at_particle(l, p, k, t, vector);
    }
    if (b->kind != BOUNDARY_PRESSURE) return value_size(vector, p->dim);
    const double pressure = fabs(vector[0]);
    load_force_on_particle(l, p, k, t, vector); /* average of corner normals */
    const double force = value_size(vector, p->dim);
    for (int d = 0; d < p->dim && force > 0; d++) vector[d] *= pressure / force;
    return force > 0 ? pressure : 0;
}

/* Returns the largest magnitude of load l of the run at time t [s] and the number of particles on which it is not 0.
 * Only every `every`-th particle of the load is evaluated. on[i]: 1 if particle i is included, else 0; if `on` is NULL,
 * all particles are included. */
static struct acting acting_at(const struct run *run, const struct load *l, const uint8_t *on, double t, int64_t every)
{
    struct acting a = {.t = t};
    double least = INFINITY;
    for (int64_t k = 0; k < l->n; k += every) {
        real vector[DIM_MAX] = {0};
        if (on && !on[l->particle[k]]) continue;
        const double size = vector_at(run, l, k, t, vector);
        if (!isfinite(size)) continue;
        a.particles += size > 0;
        a.most = fmax(a.most, size);
        if (size > 0) least = fmin(least, size);
    }
    a.varies = least < (1 - 1e-6) * a.most;
    return a;
}

/* Sets the flag of particle `particle`, which has a face under pressure, to 1. context: uint8_t array with a flag for
 * each particle. Called by pressure_boundary_visit_free_faces for each face; axis, side and area of the face are
 * ignored. */
static void face_on(void *context, int32_t particle, int axis, int side, real area)
{
    (void)axis, (void)side;
    ((uint8_t *)context)[particle] |= area > 0;
}

/* Returns an allocated array with 1 for each particle of the run that has a face under the pressure load l, else 0. A
 * pressure is distributed over two layers of particles, of which only the outer layer has a face. The caller releases
 * the array with memory_free. */
static uint8_t *faces_of_pressure(const struct run *run, const struct load *l)
{
    const struct particles *p = &run->part;
    uint8_t *selected = NEW("plot.selected", p->n, uint8_t), *on = NEW("plot.on", p->n, uint8_t);
    boundary_select_particles_in_region(l->boundary, p, run->scene->spacing, selected);
    const struct boundary *all = run->boundary ? run->boundary : run->scene->boundary;
    pressure_boundary_visit_free_faces(all, run->scene->boundaries, (int)(l - run->loads.load), p, run->scene->spacing,
                                       selected, face_on, on);
    memory_free(selected);
    return on;
}

/* Returns the state of load l of the run at the time at which its magnitude is largest, among evenly spaced times and
 * the characteristic times of its time function. on[i]: 1 if particle i is included, else 0; if `on` is NULL, all
 * particles are included. */
static struct acting acting_of(const struct run *run, const struct load *l, const uint8_t *on)
{
    enum { MOMENTS = 32, LOOKED_AT = 400 };
    const struct time_function *f = &boundary_of(run, l)->time;
    const bool fixed = l->boundary->frozen && boundary_applies_force(l->boundary);
    const int64_t every = 1 + l->n / LOOKED_AT;
    struct acting most = acting_at(run, l, on, fixed ? run->scene->duration : 0, every);
    bool changes = false;
    for (int k = 0; k < MOMENTS + f->n + 3 && !fixed; k++) {
        const double own[] = {f->from, 0.5 * (f->from + f->until), f->until};
        const double t = k < MOMENTS          ? (k + 1) * run->scene->duration / MOMENTS
                         : k < MOMENTS + f->n ? f->t[k - MOMENTS]
                                              : own[k - MOMENTS - f->n];
        if (!(t >= 0 && t <= run->scene->duration)) continue;
        const struct acting now = acting_at(run, l, on, t, every);
        changes = changes || fabs(now.most - most.most) > 1e-6 * most.most;
        if (now.most > (1 + 1e-6) * most.most) most = now;
    }
    most = acting_at(run, l, on, most.t, 1);
    most.varies = most.varies || changes;
    return most;
}

/* Writes the description of a boundary condition for the key (legend) into text[TEXT]: name, kind, largest value,
 * components or face and, unless `plain` is true, the number of particles. acting: state of the load at its largest
 * magnitude. b: the boundary condition. */
static void describe_boundary(char *text, const struct boundary *b, int dim, const struct acting *acting, bool plain)
{
    char face[16], many[64];
    int length = snprintf(text, TEXT, "%.40s:", b->name);
    snprintf(face, sizeof face, ", %c%c", 'x' + b->face, b->side > 0 ? '+' : '-');
    if (b->kind == BOUNDARY_MIRROR) {
        const struct unit metre = unit_for_length(fmax(fabs(b->at), 1e-3));
        snprintf(many, sizeof many, " %s %c = %.4g %s", b->hold_tangential ? "clamped at" : "mirror", 'x' + b->axis,
                 b->at / metre.factor, metre.name);
        add_words(text, length, many);
        return;
    }
    if (b->kind == BOUNDARY_TRACTION) length = add_words(text, length, " traction");
    if (b->kind == BOUNDARY_BODY_FORCE) length = add_words(text, length, b->by_mass ? " gravity" : " body force");
    if (b->kind == BOUNDARY_PRESSURE) length = add_words(text, length, " pressure");
    if (b->kind == BOUNDARY_ABSORBING) length = add_words(text, length, " absorbing");
    if (b->kind == BOUNDARY_VELOCITY)
        length = add_words(text, length, b->rotates ? " turning" : is_support(b, dim) ? " held" : " driven");
    if (*unit_of_value(b) && !is_support(b, dim)) {
        if (acting->varies) length = add_words(text, length, " up to");
        length = add_value(text, length, acting->most, unit_of_value(b));
    }
    for (int d = 0; d < dim && b->kind == BOUNDARY_VELOCITY && !b->rotates; d++)
        if (b->components >> d & 1) length = add_words(text, length, (const char *[]){" x", " y", " z"}[d]);
    if (b->kind == BOUNDARY_TRACTION || b->kind == BOUNDARY_ABSORBING) length = add_words(text, length, face);
    snprintf(many, sizeof many, " (%lld)", (long long)acting->particles);
    if (!plain) add_words(text, length, many);
}

/* ---- marks ------------------------------------------------------------------------------------------------------- */

/* Returns the smallest stride with which at most `most` of n elements are selected. */
static int64_t stride_for(int64_t n, int64_t most) { return n > most ? (n + most - 1) / most : 1; }

/* Particles of a load at which arrows are drawn: those on every `every`-th layer of the lattice along each axis, so
 * that the arrows cover the whole load. layers[d]: number of layers along axis d; from[d]: coordinate of the first
 * layer [m]; spacing: distance of layers [m]. */
struct chosen {
    double from[DIM_MAX], spacing;
    int64_t layers[DIM_MAX], every;
};

/* Returns true if the arrow of particle i of p is drawn: along every axis the particle is on one of the lattice layers
 * that the selection c draws. */
static bool chosen_has(const struct chosen *c, const struct particles *p, int32_t i)
{
    real X[DIM_MAX];
    bool on = true;
    particle_reference_position(p, i, X);
    for (int d = 0; d < p->dim; d++) {
        const int64_t layer = (int64_t)floor((X[d] - c->from[d]) / c->spacing + 0.5);
        const int64_t first = ((c->layers[d] - 1) % c->every) / 2; /* centred between both ends */
        on = on && layer % c->every == first;
    }
    return on;
}

static int64_t chosen_count(const struct chosen *c, const struct particles *p, const struct load *l)
{
    int64_t n = 0;
    for (int64_t k = 0; k < l->n; k++) n += chosen_has(c, p, l->particle[k]);
    return n;
}

/* Selects the particles of load l whose arrows are drawn in the picture m. Along each axis they are on every n-th layer
 * of the lattice, with the smallest n for which at most `most` particles are selected. Returns the selection. */
static struct chosen choose_particles(const struct scene_overlay *overlay, const struct load *l, int64_t most)
{
    const struct particles *p = &overlay->engine->part;
    struct chosen c = {.spacing = overlay->engine->scene->spacing, .every = 1};
    for (int d = 0; d < p->dim && l->n > 0; d++) {
        double from = INFINITY, to = -INFINITY;
        for (int64_t k = 0; k < l->n; k++) {
            real X[DIM_MAX];
            particle_reference_position(p, l->particle[k], X);
            from = fmin(from, X[d]), to = fmax(to, X[d]);
        }
        c.from[d] = from, c.layers[d] = (int64_t)floor((to - from) / c.spacing + 1.5);
    }
    const int64_t longest = (int64_t)fmax(fmax((double)c.layers[0], (double)c.layers[1]), (double)c.layers[2]);
    while (l->n > most && c.every < longest && chosen_count(&c, p, l) > most) c.every++;
    while (c.every > 1 && chosen_count(&c, p, l) == 0) c.every--;
    return c;
}

/* Draws the arrows of load l at its particles in the picture m. An arrow of tension begins at the particle, an arrow of
 * compression ends at it. on[i]: 1 if particle i is included, else 0; if `on` is NULL, all particles are included.
 * acting: time for which the arrows are drawn, and largest magnitude of the load at this time, which is drawn with full
 * length. */
static void arrows_of_load(struct scene_overlay *overlay, const struct load *l, const uint8_t *on,
                           const struct acting *acting)
{
    const struct particles *p = &overlay->engine->part;
    const struct boundary *b = l->boundary;
    const struct chosen chosen =
        choose_particles(overlay, l, b->kind == BOUNDARY_BODY_FORCE ? ARROWS_FIELD : ARROWS_MOST);
    for (int64_t k = 0; k < l->n; k++) {
        real X[DIM_MAX], acts[DIM_MAX] = {0};
        double vector[DIM_MAX] = {0};
        if (!chosen_has(&chosen, p, l->particle[k]) || (on && !on[l->particle[k]])) continue;
        const double size = vector_at(overlay->engine, l, k, acting->t, acts);
        if (!(size > 0 && isfinite(size))) continue;
        const bool inward = b->kind != BOUNDARY_TRACTION || acts[b->face] * b->side <= 0;
        particle_reference_position(p, l->particle[k], X);
        for (int d = 0; d < p->dim; d++) vector[d] = overlay->arrow * acts[d] / acting->most;
        for (int d = 0; d < p->dim && inward; d++) X[d] -= vector[d];
        scene_overlay_add_point(overlay, X, vector);
    }
}

static void points_of_load(struct scene_overlay *overlay, const struct load *l)
{
    const struct chosen chosen = choose_particles(overlay, l, 3 * ARROWS_MOST);
    for (int64_t k = 0; k < l->n; k++) {
        real X[DIM_MAX];
        if (!chosen_has(&chosen, &overlay->engine->part, l->particle[k])) continue;
        particle_reference_position(&overlay->engine->part, l->particle[k], X);
        scene_overlay_add_point(overlay, X, NULL);
    }
}

/* Draws the plane of symmetry of boundary b in the picture overlay: a line across it in 2D, in 3D a rectangle a little
 * larger than the body. */
static void mirror_plane_mark(struct scene_overlay *overlay, const struct boundary *b)
{
    const struct particles *p = &overlay->engine->part;
    real low[DIM_MAX] = {0}, high[DIM_MAX] = {0}, X[DIM_MAX];
    for (int d = 0; d < p->dim; d++) particles_coordinate_range(p, p->n, d, &low[d], &high[d]);
    const int a = b->axis == 0 ? 1 : 0, c = b->axis == 2 ? 1 : 2;
    for (int k = 0; k < (p->dim == 3 ? 5 : 2); k++) {
        const bool up = k == 1 || k == 2, far = k == 2 || k == 3;
        for (int d = 0; d < DIM_MAX; d++) X[d] = low[d];
        X[b->axis] = b->at;
        if (p->dim > 1) X[a] = up ? high[a] + overlay->arrow : low[a] - overlay->arrow;
        if (p->dim == 3) X[c] = far ? high[c] + overlay->arrow : low[c] - overlay->arrow;
        scene_overlay_add_point(overlay, X, NULL);
    }
}

/* Returns the colour of the boundary condition with the index `number`: the colours of the first CURVE_COLOURS + 5
 * differ, then they repeat. */
static const char *colour_of_load(int number)
{
    static const char *const further[] = {"#882255", "#117733", "#332288", "#999933", "#aa4499"};
    const int k = number % (CURVE_COLOURS + (int)COUNT_OF(further));
    return k < CURVE_COLOURS ? curve_colour[k] : further[k - CURVE_COLOURS];
}

/* Draws the boundary condition with the index `number` in the picture in a colour of its own, as arrows, points or a
 * plane of symmetry, and adds its description to the key (legend). */
static void boundary_mark(struct scene_overlay *overlay, int number)
{
    const struct scene *s = overlay->engine->scene;
    const struct load *l = &overlay->engine->loads.load[number];
    const struct boundary *b = boundary_of(overlay->engine, l);
    const char *colour = colour_of_load(number);
    char text[TEXT], how[HOW];
    struct acting acting = {.particles = l->n};
    uint8_t *on = b->kind == BOUNDARY_PRESSURE ? faces_of_pressure(overlay->engine, l) : NULL;
    if (*unit_of_value(b) && !is_support(b, s->dim)) acting = acting_of(overlay->engine, l, on);
    describe_boundary(text, b, s->dim, &acting, overlay->plain);
    scene_overlay_begin_data_block(overlay);
    if (b->kind == BOUNDARY_MIRROR) {
        mirror_plane_mark(overlay, b);
        snprintf(how, sizeof how, "with lines lw 2 dt (12,4,3,4) lc rgb '%s'", colour);
    } else if (is_support(b, s->dim) || b->kind == BOUNDARY_ABSORBING) {
        points_of_load(overlay, l);
        const int point = b->kind == BOUNDARY_ABSORBING ? 6 : 9;
        snprintf(how, sizeof how, "with points pt %d ps 1.1 lc rgb '%s'", point, colour);
    } else {
        arrows_of_load(overlay, l, on, &acting);
        snprintf(how, sizeof how, "using 1:2:3:4 with vectors %s size screen 0.012,22 lw 1.8 lc rgb '%s'",
                 b->kind == BOUNDARY_VELOCITY ? "head empty" : "head filled", colour);
    }
    scene_overlay_end_data_block(overlay, how, text);
    memory_free(on);
}

/* Draws all loads and supports in the picture, first those with arrows and then supports drawn as points, since arrows
 * would hide points. */
void scene_overlay_draw_load_symbols(struct scene_overlay *overlay)
{
    const struct run *run = overlay->engine;
    for (int pass = 0; pass < 2; pass++)
        for (int b = 0; b < run->loads.n; b++)
            if (is_support(run->loads.load[b].boundary, run->scene->dim) == pass) boundary_mark(overlay, b);
}

/* ---- motion at the start ----------------------------------------------------------------------------------------- */

/* Returns the initial speed [m/s] of particle i of p. */
static double speed_at_start(const struct particles *p, int64_t i)
{
    double sum = 0;
    for (int d = 0; d < p->dim; d++) sum += square(p->v[d][i]);
    return sqrt(sum);
}

/* Draws an arrow from the centre of each moving rigid body along its velocity: adds it to the current line of marks m.
 * Its length is overlay->arrow times its speed divided by `fastest` [m/s]. */
static void rigid_arrows(struct scene_overlay *overlay, double fastest)
{
    const struct scene *s = overlay->engine->scene;
    for (int k = 0; k < s->rigids; k++) {
        const real *v = s->body[s->bodies + k].velocity;
        double vector[DIM_MAX] = {0};
        for (int d = 0; d < s->dim; d++) vector[d] = overlay->arrow * v[d] / fastest;
        if (value_size(v, s->dim) > 0) scene_overlay_add_point(overlay, overlay->engine->rigid->body[k].x, vector);
    }
}

void scene_overlay_draw_velocity_arrows(struct scene_overlay *overlay)
{
    const struct particles *p = &overlay->engine->part;
    const struct scene *s = overlay->engine->scene;
    double fastest = 0;
    int64_t moving = 0;
    char text[TEXT];
    for (int k = 0; k < s->rigids; k++) fastest = fmax(fastest, value_size(s->body[s->bodies + k].velocity, s->dim));
    for (int64_t i = 0; i < p->n; i++) {
        const double v = speed_at_start(p, i);
        fastest = fmax(fastest, v);
        moving += v > 0;
    }
    if (fastest == 0) return;
    scene_overlay_begin_data_block(overlay);
    const int64_t stride = stride_for(moving, p->dim == 1 ? ARROWS_BAR : ARROWS_FIELD);
    for (int64_t i = 0, k = 0; i < p->n; i++) {
        double vector[DIM_MAX];
        real X[DIM_MAX];
        if (speed_at_start(p, i) == 0 || k++ % stride != 0) continue;
        for (int d = 0; d < p->dim; d++) X[d] = p->x[d][i], vector[d] = overlay->arrow * p->v[d][i] / fastest;
        scene_overlay_add_point(overlay, X, vector);
    }
    rigid_arrows(overlay, fastest);
    add_value(text, snprintf(text, sizeof text, "velocity, at most"), fastest, "m/s");
    scene_overlay_end_data_block(
        overlay, "using 1:2:3:4 with vectors head filled size screen 0.009,20 lw 1.3 lc rgb '#222222'", text);
}
