/* floor 3: whom a boundary condition acts on, and with which share of its value. */
#include <math.h>
#include <stdlib.h>

#include "loads.h"
#include "memory.h"

#define LAYER_LEAST (0.5 - 1e-6)         /* depth at which a layer can end, from its outermost particle        */
#define LAYER_MOST 1.1                   /*                                                         [spacings] */
#define LAYERS_SEEN 1.5

/* Does the boundary act at a place `outward` [m] of particle i along its face's normal? */
static bool selects(const struct boundary *b, const struct particles *p, int64_t i, real spacing, real outward)
{
    real X[DIM_MAX];
    particle_place(p, i, X);
    if (b->body >= 0 && p->body[i] != b->body) return false;
    if (outward != 0) X[b->face] += b->side * outward;
    return region_contains(&b->region, X, p->dim, LOADS_TOLERANCE * spacing);
}

/* ---- the layers of a face --------------------------------------------------------------------------- */

/* Outermost coordinate of the selected particles along a traction's normal. */
static real face_place(const struct boundary *b, const struct particles *p, const uint8_t *selected)
{
    real place = -INFINITY;
    for (int64_t i = 0; i < p->n; i++)
        if (selected[i]) place = real_max(place, b->side * p->X[b->face][i]);
    return place;
}

static real depth_of(const struct boundary *b, const struct particles *p, int64_t i, real place)
{
    return place - b->side * p->X[b->face][i];
}

static int ascending(const void *a, const void *b)
{
    const real x = *(const real *)a, y = *(const real *)b;
    return (x > y) - (x < y);
}

/* Depth at which the outermost layer ends: the middle of the widest gap between half a spacing and a spacing deep. A
 * lattice that has been shaken has gaps between its layers, but they do not lie half a spacing below its outermost
 * particle. */
static real layer_end(const struct boundary *b, const struct particles *p, const uint8_t *selected, real place,
                      real spacing)
{
    real *depth = NEW("loads.depth", p->n + 1, real), widest = 0, end = 0.5 * spacing;
    int64_t n = 0;
    for (int64_t i = 0; i < p->n; i++) {
        const real here = depth_of(b, p, i, place);
        if (selected[i] && here < LAYERS_SEEN * spacing) depth[n++] = here;
    }
    depth[n++] = LAYERS_SEEN * spacing;
    qsort(depth, (size_t)n, sizeof *depth, ascending);
    for (int64_t k = 1; k < n; k++) {
        const real gap = depth[k] - depth[k - 1], middle = 0.5 * (depth[k] + depth[k - 1]);
        if (middle < LAYER_LEAST * spacing || middle > LAYER_MOST * spacing || gap <= widest) continue;
        widest = gap, end = middle;
    }
    memory_free(depth);
    return end;
}

static bool has_tangential(const struct boundary *b, int dim)
{
    bool found = false;
    for (int d = 0; d < dim; d++) found = found || (d != b->face && b->value[d] != 0);
    return found;
}

/* Marks the outermost layer 1 and, where the traction has a part along the face, the layer beneath it 2. */
static void select_layers(const struct boundary *b, const struct particles *p, uint8_t *selected, real spacing)
{
    const real place = face_place(b, p, selected), end = layer_end(b, p, selected, place, spacing);
    const bool two = has_tangential(b, p->dim);
    for (int64_t i = 0; i < p->n; i++) {
        const real depth = depth_of(b, p, i, place);
        if (depth <= end) continue;
        selected[i] = two && depth <= end + spacing && selects(b, p, i, spacing, spacing) ? 2 : 0;
    }
}

/* ---- shares ------------------------------------------------------------------------------------------- */

static real profile_at(const struct profile *f, const struct particles *p, int64_t i)
{
    real X[DIM_MAX], along = 0;
    if (f->kind == PROFILE_UNIFORM) return 1;
    particle_place(p, i, X);
    for (int d = 0; d < p->dim; d++) along += (X[d] - f->origin[d]) * f->direction[d];
    return sin(2 * M_PI * along / (sqrt(dot(f->direction, f->direction, p->dim)) * f->wavelength));
}

/* A traction acts on the face, half a spacing outside the outermost particles. For its normal part that makes no
 * difference; what it has along the face would make a moment: a plate of n particles a side in shear would bear
 * 1 + 1.3/n of the stress. So 3/2 of it act on the outermost layer and -1/2 on the next: linearly extrapolated, force
 * and first moment are those of the face. One layer bears all where there is no other. */
static void traction_shares(struct load *l, const struct particles *p, const uint8_t *selected, real spacing)
{
    real volume[3] = {0}, factor[3] = {0, 1, 0};
    for (int64_t k = 0; k < l->n; k++) volume[selected[l->particle[k]]] += p->volume0[l->particle[k]];
    if (volume[2] > 0.5 * volume[1]) factor[1] = 1.5, factor[2] = -0.5 * volume[1] / volume[2];
    for (int64_t k = 0; k < l->n; k++) {
        const int64_t i = l->particle[k];
        for (int d = 0; d < p->dim; d++)
            l->share[d][k] = p->volume0[i] / spacing * (d != l->boundary->face ? factor[selected[i]] : selected[i] == 1);
    }
}

static void body_shares(struct load *l, const struct particles *p)
{
#pragma omp parallel for schedule(static)
    for (int64_t k = 0; k < l->n; k++)
        l->share[0][k] = p->volume0[l->particle[k]] * profile_at(&l->boundary->profile, p, l->particle[k]);
}

static void shares_allocate(struct load *l, int dim)
{
    const bool alike = l->boundary->kind == BOUNDARY_BODY_FORCE;
    for (int d = 0; d < dim; d++) l->share[d] = d > 0 && alike ? l->share[0] : NEW("loads.share", l->n, real);
}

void load_select(struct load *l, const struct boundary *b, struct particles *p, real spacing)
{
    l->boundary = b;
    if (b->kind == BOUNDARY_MIRROR) return;
    uint8_t *selected = NEW("loads.selected", p->n, uint8_t);
    for (int64_t i = 0; i < p->n; i++) selected[i] = selects(b, p, i, spacing, 0);
    if (b->kind == BOUNDARY_TRACTION) select_layers(b, p, selected, spacing);
    for (int64_t i = 0; i < p->n; i++) l->n += selected[i] > 0;
    l->particle = NEW("loads.particle", l->n, int32_t);
    for (int64_t i = 0, k = 0; i < p->n; i++) {
        if (!selected[i]) continue;
        l->particle[k++] = (int32_t)i;
        if (b->kind == BOUNDARY_VELOCITY) p->flag[i] |= FLAG_DRIVEN;
    }
    if (b->kind != BOUNDARY_VELOCITY) shares_allocate(l, p->dim);
    if (b->kind == BOUNDARY_TRACTION) traction_shares(l, p, selected, spacing);
    if (b->kind == BOUNDARY_BODY_FORCE) body_shares(l, p);
    memory_free(selected);
}
