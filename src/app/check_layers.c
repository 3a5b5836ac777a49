/* Counts the layers of particles across thin parts of bodies of any shape. Reports errors of the stiffness that follow
 * from incomplete neighbourhoods, from cells whose points have one dilatation (locking), and from layers that a support
 * moves as one. */
#include <math.h>

#include "base/memory.h"
#include "check_parts.h"

#define CELLS_MOST 2e7   /* largest number of cells of the bounding box of a body; more take too long */
#define SHARE_LEAST 0.5  /* least share of particles in thin parts; a smaller one are edges and steps of faces */
enum { RUNS_MOST = 64 }; /* largest number of layers that are counted */

/* Lattice sites in the bounding box of the particles of one body; filled[site] is 1 if a particle is at the site.
 * n[dim]: number of sites along each axis; stride[dim]: step of the site index along each axis. */
struct layer_map {
    int dim;
    int64_t n[DIM_MAX], stride[DIM_MAX];
    real low[DIM_MAX], spacing; /* [m] */
    uint8_t *filled;            /* [sites] */
    bool mirror[DIM_MAX][2];    /* a plane of symmetry is behind the lowest, the highest site of an axis */
};

static int64_t layer_site(const struct layer_map *m, const struct particles *p, int64_t i)
{
    int64_t site = 0;
    for (int d = 0; d < m->dim; d++) site += m->stride[d] * llround((p->X[d][i] - m->low[d]) / m->spacing);
    return site;
}

/* Finds which lattice sites in the bounding box of body number `body` of the run are filled by particles of this body.
 * Stores the result in m, with m->filled[sites] 1 or 0. Returns false, with nothing to release, for more than
 * CELLS_MOST sites. Otherwise the caller frees m->filled with memory_free. */
static bool layer_map_make(struct layer_map *m, const struct run *run, int body)
{
    const struct particles *p = &run->part;
    real high[DIM_MAX], sites = 1;
    *m = (struct layer_map){.dim = p->dim, .spacing = run->scene->spacing};
    for (int d = 0; d < p->dim; d++) {
        m->low[d] = INFINITY, high[d] = -INFINITY;
        for (int64_t i = 0; i < p->n; i++)
            if (p->body[i] == body)
                m->low[d] = real_min(m->low[d], p->X[d][i]), high[d] = real_max(high[d], p->X[d][i]);
        sites *= (high[d] - m->low[d]) / m->spacing + 2;
    }
    if (!(sites <= CELLS_MOST)) return false;
    int64_t all = 1;
    for (int d = 0; d < p->dim; d++) {
        m->n[d] = llround((high[d] - m->low[d]) / m->spacing) + 1, m->stride[d] = all, all *= m->n[d];
        for (int k = 0; k < run->source.mirrors; k++) {
            const struct mirror_plane *plane = &run->source.mirror[k];
            if (plane->axis != d) continue;
            m->mirror[d][0] |= fabs(plane->at - m->low[d]) < 0.6 * m->spacing;
            m->mirror[d][1] |= fabs(plane->at - high[d]) < 0.6 * m->spacing;
        }
    }
    m->filled = NEW("check.layers", all, uint8_t);
    for (int64_t i = 0; i < p->n; i++)
        if (p->body[i] == body) m->filled[layer_site(m, p, i)] = 1;
    return true;
}

/* Counts consecutive lattice sites of m with particles along `axis` in the direction `way` (1 or -1), beginning with
 * the neighbour of the site from[dim] (indices along the axes). Returns their number, at most RUNS_MOST. *mirrored:
 * receives whether the count ends at a face of the body's bounding box that is on a plane of symmetry. */
static int layer_run(const struct layer_map *m, const int64_t *from, int axis, int way, bool *mirrored)
{
    int64_t at = from[axis], site = 0;
    int run = 0;
    for (int d = 0; d < m->dim; d++) site += from[d] * m->stride[d];
    for (*mirrored = false; run < RUNS_MOST; run++) {
        at += way, site += way * m->stride[axis];
        if (at < 0 || at >= m->n[axis]) {
            *mirrored = m->mirror[axis][way > 0];
            return run;
        }
        if (!m->filled[site]) return run;
    }
    return run;
}

/* Returns the number of particle layers across the body at the lattice site with the indices at[dim] in m: the smallest
 * of the counts along the axes. A count that ends at a plane of symmetry is doubled. For parts that are slanted to the
 * axes the number is up to 1.4 times too large. */
static double site_layers(const struct layer_map *m, const int64_t *at)
{
    double least = RUNS_MOST;
    for (int d = 0; d < m->dim; d++) {
        bool mirrored[2];
        const int up = layer_run(m, at, d, 1, &mirrored[1]), down = layer_run(m, at, d, -1, &mirrored[0]);
        if (mirrored[0] && mirrored[1]) continue;
        least = fmin(least, (1 + up + down) * (mirrored[0] || mirrored[1] ? 2 : 1));
    }
    return least;
}

/* Returns the median number of particle layers across the thin parts of body number `body` of the run. A particle is in
 * a thin part if the body has fewer than `most` layers there, counted along the axis with the smallest count. Returns
 * INFINITY if less than the share SHARE_LEAST of the particles are in thin parts, or if the bounding box of the body
 * has more than CELLS_MOST lattice sites. */
static double body_layers(const struct run *run, int body, double most)
{
    const struct particles *p = &run->part;
    int64_t count[RUNS_MOST + 1] = {0}, all = 0, thin = 0, seen = 0;
    struct layer_map m;
    if (!layer_map_make(&m, run, body)) return INFINITY;
    for (int64_t i = 0; i < p->n; i++) {
        int64_t at[DIM_MAX] = {0};
        if (p->body[i] != body) continue;
        const int64_t site = layer_site(&m, p, i);
        for (int d = 0; d < m.dim; d++) at[d] = site / m.stride[d] % m.n[d];
        const double layers = site_layers(&m, at);
        all++;
        if (layers < most) thin++, count[(int)layers]++;
    }
    memory_free(m.filled);
    int half = 0;
    while (half < RUNS_MOST && 2 * (seen += count[half]) < thin) half++;
    return (double)thin < SHARE_LEAST * (double)all ? INFINITY : half;
}

double count_particle_layers_across_thin_parts(const struct run *run, int body_index, double max_layers)
{
    const struct scene *s = run->scene;
    real least = INFINITY;
    bool known =
        s->body[body_index].joined == body_index && s->body[body_index].shape.n == 1 && !s->body[body_index].file;
    for (int b = 0; b < s->bodies; b++) known = known && (b == body_index || s->body[b].joined != body_index);
    if (s->body[body_index].joined != body_index) return INFINITY;
    if (known) least = solid_smallest_edge(run, &s->body[body_index].shape.solid[0]) / s->spacing;
    if (isfinite(least)) return least < max_layers ? least : INFINITY;
    /* steps of curved faces take some of the counted layers: only half of max_layers counts as thin */
    return body_layers(run, body_index, real_min(0.5 * max_layers, RUNS_MOST - 1));
}

/* ---- nearly incompressible bodies -------------------------------------------------------------------------------- */

/* Returns the relative error of the stiffness in bending of nearly incompressible peridynamic bodies [%], in plane
 * strain and 3D. layers: particle layers across the body; poisson: Poisson's ratio. The error was measured with 10
 * layers, in static bending with the models ospd and mospd, and decreases as 1/layers. */
static double soft_families(double poisson, double layers) { return (poisson > 0.47 ? 30 : 15) * 10 / layers; }

/* Returns the relative error of the deflection in bending of a body of material points [%], if all points of a cell
 * have one dilatation: such cells resist the bending of a thin body less than cells of linear functions. layers:
 * particle layers across the body, N; poisson: Poisson's ratio nu. The error is a/N^2 + b/N^4, where an odd N counts as
 * the next even one, with a = 170 and b = 760 + 6100 (nu - 0.3), or b = 760 for nu below 0.3. It is an empirical fit,
 * within a sixth of the error, to load steps of cantilevers in plane strain, of length 80, height 8 and 2 to 24 layers
 * with nu = 0.3, 0.45 and 0.49. Bars of square section bend less. */
static double soft_cells(double poisson, double layers)
{
    const double even = 2 * ceil(0.5 * layers), square = even * even;
    return 170 / square + (760 + 6100 * fmax(poisson - 0.3, 0)) / (square * square);
}
#define SOFT_FAMILIES 0.4 /* Poisson's ratios up to which nothing is reported for neighbourhoods */
#define SOFT_MOST 2.0     /* least error that is reported [%] */

/* Returns the largest Poisson's ratio among the materials of body number `body_index` of scene s (the input file), for
 * advice on nearly incompressible bodies. families: true for peridynamics, where all materials count, but 0 is returned
 * unless the ratio exceeds SOFT_FAMILIES; false for material points, where only materials count for which all points of
 * a cell have one dilatation. Returns 0 if no material counts. */
static real largest_poisson_ratio(const struct scene *s, int body_index, bool families)
{
    real poisson = 0;
    for (int m = 0; m < s->materials; m++)
        if (scene_body_can_have_material(&s->body[body_index], m) &&
            (families || material_uses_mean_dilatation(&s->material[m], s->space)))
            poisson = real_max(poisson, s->material[m].poisson);
    return poisson > (families ? SOFT_FAMILIES : 0) ? poisson : 0;
}

void print_advice_on_incompressible_bodies(const struct run *run, FILE *out)
{
    const struct scene *s = run->scene;
    const bool families = s->method == METHOD_PD;
    if ((families && s->model == MODEL_BOND) || (s->space != SPACE_PLANE_STRAIN && s->dim < 3)) return;
    for (int b = 0; b < s->bodies; b++) {
        const real poisson = largest_poisson_ratio(s, b, families);
        if (!(poisson > 0) || s->body[b].joined != b) continue;
        const double layers = fmin(count_particle_layers_across_thin_parts(run, b, 2 * RUNS_MOST), RUNS_MOST);
        const double off = families ? soft_families(poisson, layers) : soft_cells(poisson, layers);
        if (!(off >= SOFT_MOST)) continue;
        fprintf(out,
                "accuracy       body %s: at a Poisson's ratio of %.4g %s, so %s%.0f layers bend up to %.0f %% too %s; "
                "use more layers (a smaller particles.spacing)\n",
                s->body[b].name, poisson,
                families ? "particles near faces are too stiff" : "the points of a cell have the same change of volume",
                layers < RUNS_MOST - 1 ? "" : "more than ", layers, off, families ? "little" : "much");
    }
}

/* ---- layers behind faces ----------------------------------------------------------------------------------------- */

/* Shortening of a body of bonds by a layer that moves as one, less the depth of the layer [spacings], by dimension:
 * measured, inputs/loads.md. */
static const real layer_shortening[] = {[1] = -0.65, [2] = -0.75, [3] = -0.75};
#define SHORTENED 0.03 /* share of the length from which on it is reported; 10 % of the stiffness in bending [1] */

/* Returns true if load l of scene s (the input file) is a support that moves a layer of peridynamic particles as one:
 * it prescribes the same motion, normal to a face, for all particles behind this face to a depth of one horizon (the
 * default depth), and none of these particles moves with the nodes of a grid or mesh. p: particles. */
static bool holds_layer_of_bonds(const struct scene *s, const struct load *l, const struct particles *p)
{
    const struct boundary *b = l->boundary;
    bool bonds = l->n > 0;
    if (b->kind != BOUNDARY_VELOCITY || b->side == 0 || !(b->components >> b->face & 1)) return false;
    if (fabs(b->depth / (s->horizon * s->spacing) - 1) > 1e-9 || boundary_motion_varies_in_space(b)) return false;
    for (int64_t k = 0; k < l->n && bonds; k++) bonds = !particle_is_moved_by_grid_or_mesh_nodes(p, l->particle[k]);
    return bonds;
}

void print_advice_on_stiffening_by_prescribed_motion(const struct run *run, FILE *out)
{
    const struct scene *s = run->scene;
    const struct particles *p = &run->part;
    for (int k = 0; k < run->loads.n && !scene_is_dynamic(s); k++) {
        const struct load *l = &run->loads.load[k];
        if (!holds_layer_of_bonds(s, l, p)) continue;
        const int axis = l->boundary->face, body = p->body[l->particle[0]];
        real low = INFINITY, high = -INFINITY;
        for (int64_t i = 0; i < p->n; i++)
            if (s->body[p->body[i]].joined == s->body[body].joined)
                low = real_min(low, p->X[axis][i]), high = real_max(high, p->X[axis][i]);
        const real length = high - low + s->spacing;
        const real shorter = (floor(s->horizon) + layer_shortening[s->dim]) * s->spacing, left = 1 - shorter / length;
        if (!(left > 0) || 1 - left < SHORTENED || s->horizon < 2) continue;
        fprintf(
            out,
            "accuracy       boundary %s: the layer behind its face, a horizon deep, moves as a rigid layer, so the "
            "body of %.4g m acts as if it were %.3g m shorter along %c. Its stiffness is off by %+.2g %% in tension, "
            "%+.2g %% in bending; set depth: %s, use a smaller spacing, or make the body longer by that length\n",
            l->boundary->name, length, shorter, "xyz"[axis], 100 * (1 / left - 1), 100 * (pow(left, -3) - 1),
            length_text_with_unit(s->spacing, 3, s->spacing).text);
    }
}
